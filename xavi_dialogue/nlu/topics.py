"""Topics: "this red lorry, he has to wait": what is named first is what the pronoun means."""

from typing import Any

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Doing,
    Elliptic,
    Fault,
    HowDecide,
    HowMuch,
    Identify,
    Peak,
    Repair,
    Request,
    WhatIf,
    Where,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Believed,
    Caused,
    Described,
    Destination,
    Ego,
    Event,
    Exists,
    Exit,
    Feature,
    Happens,
    Is,
    Junction,
    Lane,
    Measured,
    Nobody,
    Not,
    Pronoun,
    Related,
    Road,
    That,
    Thing,
    Unknown,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
)

_HELD = frozenset({"brake", "slow-down", "stop", "wait", "give-way"})
_FORMS = frozenset({"it", "he", "she", "that"})
_SEVERAL = frozenset({"they", "them-all", "those"})
_NEAREST = tuple(Peak("closeness", time) for time in (Unsaid(), WholeRide()))
Owners = list[int | None]


def fold(acts: list[Act], owners: Owners) -> tuple[list[Act], Owners]:
    """Put a thing that is named by itself into the next act, where a pronoun stands for it."""
    moved: Owners
    for index in range(len(acts) - 1):
        later = acts[index + 1]
        under = _under(acts[index], later)
        if under is not None:
            rest = [*acts[:index], under, *acts[index + 2 :]]
            return fold(rest, [o - 1 if o is not None and o > index else o for o in owners])
        if _told_already(acts[index], later):
            moved = [o - 1 if o is not None and o > index else o for o in owners]
            return fold([*acts[: index + 1], *acts[index + 2 :]], moved)
        spoken = getattr(acts[index], "thing", None)
        place = isinstance(spoken, PLACES) and isinstance(later, Ask)
        opinion = _is_opinion(acts[index]) and isinstance(later, Claim | Ask)
        if opinion or ((place or isinstance(spoken, Unknown)) and _topic_only(acts[index])):
            moved = [
                None if o == index else o - 1 if o is not None and o > index else o for o in owners
            ]
            return fold([*acts[:index], *acts[index + 1 :]], moved)
        topic = _topic(acts[index])
        if topic is None or not isinstance(later, Ask | Claim):
            continue
        told: Any = _replaced(later, topic)
        if told is not later:
            rest = [*acts[:index], told, *acts[index + 2 :]]
            moved = [o - 1 if o is not None and o > index else o for o in owners]
            return fold(rest, moved)
    return acts, owners


def _under(supposed: Act, later: Act) -> Act | None:
    """Put "how would that have gone", or "is that right?", to what was said before it."""
    match supposed, later:
        case Ask(question=Why(suspect=None) as question), Ask(
            question=Why(of=That(), suspect=suspect)
        ) if suspect is not None:  # "why did you stop, is it because of the bus?"
            return Ask(structs.replace(question, suspect=suspect))
        case Ask(
            question=Doing(actor=None, tense="present")
            | Why(of=That() | Happens(event=Event(action="do")), suspect=None)
        ), Ask(question=Why(of=Happens())):  # "what is the matter, why have we stopped?"
            return later
        case Ask(question=Why(of=Happens(event=Event(action="do")), suspect=None)), Elliptic(
            event=Event() as event, thing=None, form="same"
        ):  # "what are you doing that for, slowing down?"
            return Ask(Why(Happens(event)))
        case Claim(that=that), (
            Repair(kind="why")
            | Elliptic(thing=None, event=None, time=Unsaid(), negated=False, form="why")
            | Ask(question=Why(of=That() | Believed(content=That()), suspect=None))
        ) if not isinstance(that, Caused):
            return Ask(Why(that))  # "we are going faster, why is that?"
        case Ask(question=Why(of=Not(content=Happens(event=Event(actor=Ego()) as event)))), Ask(
            question=Where(of=Ego())
        ) if event.action in ("stand", "keep-lane"):  # "why don't we stay where we were?"
            return Ask(Why(Not(Happens(structs.replace(event, action="keep-lane")))))
        case Repair(kind="why"), Request(event=event, negated=False):
            return Ask(Why(Happens(event)))  # "and why crawl along?"
        case Ask(question=WhatIf(then=None) as question), Ask(
            question=Whether(that=Happens(event=Event(modal="would" | "could"))) as then
        ):
            return Ask(structs.replace(question, then=then))
        case Claim(that=that), Ask(
            question=Whether(that=Is(state="right", thing=None | Pronoun(), event=None))
        ):
            return Ask(Whether(that, tag=True))
        case Claim(that=that), Ask(
            question=Which(thing=Wanted(), such=Is(thing=Wanted(), event=None))
        ):
            return Ask(Whether(that, tag=True))  # "..., which is fine, isn't it?"
        case Claim(that=Happens(event=Event(action=action, actor=Ego())) as that), Claim(
            that=Related(thing=Nobody()) | Is(thing=Nobody()) | Not(content=Exists())
        ) if action in _HELD:
            return Ask(Why(that))  # "you braked although nobody was there"
        case Ask(question=HowMuch()) as named, Ask(question=Identify(thing=Pronoun(form="it"))):
            return named  # "the limit, what is it"
        case Claim(that=that), Elliptic() if later == Elliptic():
            return Ask(Whether(that, tag=True))
        case Ask(question=WhatIf(then=None) as question), Ask(
            question=HowDecide(of=Happens(event=Event(action="go", actor=Pronoun())))
            | Doing(actor=None)
        ):
            return Ask(structs.replace(question, then=Doing(None)))
        case Ask(question=WhatIf(then=None) as question), Ask(question=Doing(actor=Ego()) as doing):
            return Ask(structs.replace(question, then=doing))
    return None


PLACES = (Junction, Exit, Lane, Road, Feature, Destination)


def _told_already(act: Act, later: Act) -> bool:
    """Say whether a bare "and why", or an opinion, asks what the answer before it tells anyway."""
    if isinstance(act, Claim) and _is_opinion(later):
        return True
    nearest = isinstance(act, Ask) and act.question in _NEAREST
    if nearest and later == Ask(HowMuch(Measured("distance", Pronoun("it")))):
        return True
    bare = later in (Repair(kind="why"), Elliptic(form="why"), Elliptic(form="when"))
    return bare and isinstance(act, Ask) and isinstance(act.question, Peak)


def _is_opinion(act: Act) -> bool:
    """Say whether it is only said that what happened was unfair, rude or silly."""
    return isinstance(act, Ask) and act.question == Fault(That())


def _topic_only(act: Act) -> bool:
    """Say whether a thing without a sense is named and nothing more."""
    return isinstance(act, Elliptic) and act.event is None and act.form == "same"


def _topic(act: Act) -> Thing | None:
    match act:
        case Elliptic(thing=Vehicle() | Described() as thing, event=None, time=Unsaid(),
                      negated=False, form="same", besides=False):  # fmt: skip
            return structs.replace(thing, definite=True) if isinstance(thing, Described) else thing
    return None


def _replaced(value: Any, topic: Thing) -> Any:
    """Replace each pronoun in a term; the term itself where there is none."""
    if isinstance(value, Pronoun):
        plural = isinstance(topic, Described) and topic.plural
        return topic if value.form in (_SEVERAL if plural else _FORMS) else value
    if isinstance(value, tuple):
        parts = tuple(_replaced(part, topic) for part in value)
        return parts if any(a is not b for a, b in zip(parts, value, strict=True)) else value
    changes = {
        name: new
        for name in getattr(value, "__struct_fields__", ())
        if (new := _replaced(old := getattr(value, name), topic)) is not old
    }
    return structs.replace(value, **changes) if changes else value
