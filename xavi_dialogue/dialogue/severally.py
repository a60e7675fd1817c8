"""Severally: a question about several vehicles together becomes one question for each."""

from collections.abc import Sequence
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.dialogue.state.assertions import event_of
from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Ask, Doing, HowMuch, Listing, Whether, Which, Whither, Why
from xavi_dialogue.domain.terms import Event, Happens, Is, Measured, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import ActionName

EACH: Final = 4  # maximum of occasions whose reasons are stated
MOST: Final = 3  # maximum of vehicles that are answered one by one
#: Actions in which each vehicle may go its own way, or none.
OWN: Final = frozenset[ActionName]((
    "go", "leave", "turn", "exit-left", "exit-right", "exit-straight", "continue",
    "change-left", "change-right", "change-lane", "disappear", "approach", "come", "pass", "cross",
))  # fmt: skip
WAITING: Final = frozenset[ActionName](("wait", "give-way", "let-go"))


def severally(act: GroundedAct) -> tuple[GroundedAct, ...]:
    """Return one act for each of a few vehicles that an act asks about; else the act itself."""
    match act.act:
        case Ask(question=Why(of=Happens(event=Event(actor=Vehicles(numbers=many)) as event)) as q):
            if "first" in event.manner or len(many) > MOST:
                return (act,)
            return tuple(replace(act, act=Ask(replace(q, of=of))) for of in _each(event, many))
        case Ask(question=Why(of=Is(thing=Vehicles(numbers=many)) as of) as q) if len(many) <= MOST:
            states = (replace(of, thing=Vehicle(n)) for n in many)
            return tuple(replace(act, act=Ask(replace(q, of=one))) for one in states)
        case Ask(
            question=HowMuch(of=Measured(attribute="turn", thing=Vehicles(numbers=many)) as of) as q
        ) if len(many) <= MOST:
            ways = (replace(of, thing=Vehicle(n)) for n in many)
            return tuple(replace(act, act=Ask(replace(q, of=one))) for one in ways)
        case Ask(
            question=Whether(that=Happens(event=Event(actor=Vehicles(numbers=many)) as event)) as q
        ) if _own(event) and len(many) <= MOST:
            return tuple(replace(act, act=Ask(replace(q, that=of))) for of in _each(event, many))
        case Ask(
            question=Which(such=Happens(event=Event(actor=Vehicles(numbers=many)) as event)) as q
        ) if event.action in WAITING and len(many) <= MOST:
            return tuple(replace(act, act=Ask(replace(q, such=of))) for of in _each(event, many))
        case Ask(
            question=Doing(actor=Vehicles(numbers=many))
            | Whither(actor=Vehicles(numbers=many)) as q
        ) if len(many) <= MOST:
            return tuple(replace(act, act=Ask(replace(q, actor=Vehicle(n)))) for n in many)
    return (act,)


def _own(event: Event) -> bool:
    """Check whether each of several does something by itself; those who crossed did so together."""
    crossed = event.action == "cross" and event.tense in ("past", "perfect")
    return event.action in OWN and event.modal in (None, "will") and not crossed


def _each(event: Event, many: tuple[int, ...]) -> tuple[Happens, ...]:
    return tuple(Happens(replace(event, actor=Vehicle(n))) for n in many)


def listed(act: GroundedAct) -> GroundedAct | None:
    """Return the act that lists the occasions whose reasons an act asks for; None of other acts."""
    match act.act:
        case Ask(question=Listing(of="reasons", event=Event(action=action)) as asked):
            if action == "do":
                return replace(act, act=Ask(replace(asked, of="decisions", event=None)))
            return replace(act, act=Ask(replace(asked, of="events")))
    return None


def whys(act: GroundedAct, deeds: Sequence[Episode], now: float) -> tuple[GroundedAct, ...]:
    """Return the questions why each of the last few actions was done, at its time."""
    spans = ((d, Span(d.begin, now if d.end is None else d.end, said=True)) for d in deeds[-EACH:])
    return tuple(
        replace(act, act=Ask(Why(Happens(event_of(deed)))), span=span, listed=act.span)
        for deed, span in spans
    )
