"""Blaming: questions for a reason that take what they are of, or whom they blame, from beside them.

"Stop again at 26.7: is that because of the bus or of the lorry?" is one question, and so is "the
middle lane is free now, what is stopping you?".
"""

from typing import Any

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Doing,
    Elliptic,
    HowMuch,
    Identify,
    Request,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Both,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Lane,
    Measured,
    Not,
    Pronoun,
    Proposition,
    Related,
    Road,
    That,
    Unsaid,
    Vehicle,
    Wanted,
)

PASSING = frozenset({"pass", "overtake", "move"})
_CHANGES = frozenset({"arrive", "head", "go", "move", "change-lane", "pull-out"})
HELD = frozenset({"brake", "slow-down", "stop", "wait", "give-way"})


def asked_with(first: Act, later: Act) -> Act | None:
    """Make one question for a reason of two acts; None where they are no such question."""
    if isinstance(first, Ask) and isinstance(first.question, Why):
        return _blamed(first.question, later)
    if (cost := _cost_of(first, later)) is not None:
        return cost
    question = later.question if isinstance(later, Ask) else None
    bare = isinstance(first, Elliptic) and question == Why(That())
    if (bare or _wonders(question)) and (of := _told(first)) is not None:
        return Ask(Why(of))
    if isinstance(question, Why) and isinstance(question.of, That) and question.suspect is not None:
        of = _told(first)
        return None if of is None else Ask(structs.replace(question, of=of))
    match first, later:
        case (
            Claim(that=Happens(event=Event(action=action, actor=Ego())) as of),
            Elliptic(thing=Described() | Feature() as who)
            | Ask(question=Whether(that=Exists(thing=Feature() as who))),
        ) if action in HELD and later in (Elliptic(who), Ask(Whether(Exists(who)))):
            return Ask(Why(of, suspect=who))  # "and this slowing down, another light?"
    match first, _coloured(question):
        case Claim(that=Happens(event=Event(action=action, actor=Ego())) as of), Described() as who:
            if action in HELD:
                return Ask(Why(of, suspect=who))  # "we have stopped. Is it the red one?"
    return _not_done(first, question)


def _cost_of(first: Act, later: Act) -> Act | None:
    """Ask "how much time did we lose because of him?" of what he cost us."""
    match first, later:
        case (
            Ask(HowMuch(Measured("delay", Ego(), event=None) as of) as question),
            Ask(Why(That() | Compares(Measured("delay")), suspect=who)),
        ) if who is not None:
            return Ask(structs.replace(question, of=structs.replace(of, thing=who)))
    return None


def _wonders(question: object) -> bool:
    """Say whether it is asked what the matter is: "what is it this time?"."""
    match question:
        case Doing(actor=None, time=Unsaid(), tense="present", besides=None):
            return True
        case Identify(thing=Pronoun(form="it")):
            return True
    return False


def is_clear(that: Proposition) -> bool:
    """Check whether only room, or nobody, is stated: nobody asks why of that."""
    return isinstance(that, Is) and that.state == "free" and isinstance(that.thing, Lane | Road)


def _blamed(question: Why, later: Act) -> Act | None:
    """Add whom the passenger takes for the cause: "is it because of the bus?", "or of him?"."""
    rival = question.suspect is not None and question.rival is None
    match later:
        case Elliptic(thing=other, event=None, form="why", negated=False) if (
            rival and other is not None
        ):
            return Ask(structs.replace(question, rival=other))
        case Elliptic(thing=Described() | Vehicle() as other, event=None, form="same") if (
            rival and later == Elliptic(other)
        ):  # "was that for the bus, the lorry, or something else?"
            return Ask(structs.replace(question, rival=other))
        case Ask(
            question=Why(of=That(), suspect=suspect)
            | Whether(that=Related(relation="same-as", thing=Pronoun(), to=suspect)) as asked
        ) if question.suspect is None and suspect is not None:
            other = asked.rival if isinstance(asked, Why) else None
            return Ask(structs.replace(question, suspect=suspect, rival=other))
        case Ask(question=Why(of=of, suspect=other)) if (
            rival and other is not None and of in (That(), question.of)
        ):
            return Ask(structs.replace(question, rival=other))  # "..., or did he scare you?"
        case Ask(question=Whether(that=Both((of, Happens(event=Event(object=other))), "or"))) if (
            rival and other is not None and of == question.of
        ):  # "is it the light that you are waiting for, or the people?"
            return Ask(structs.replace(question, rival=other))
        case Ask(question=asked) if question.suspect is None:
            shown = _coloured(asked)  # "is it that blue one?"
            return None if shown is None else Ask(structs.replace(question, suspect=shown))
    return None


def _coloured(question: object) -> Described | None:
    """Give whom "is it still the red one, or ...?" names by a colour."""
    that = question.that if isinstance(question, Whether) else None
    named = that.contents[0] if isinstance(that, Both) and that.join == "or" else that
    match named:
        case Has(attribute="colour", value=str() as colour, thing=Pronoun(form="it" | "that")):
            return Described(colour=colour)
    return None


def _told(first: Act) -> Proposition | None:
    """Give what is stated before "is that because of him?"."""
    match first:
        case Request(event=event, negated=False):  # "stop at 26.7"
            return Happens(event)
        case Elliptic(thing=None, event=Event() as event, negated=False, form="same"):
            return Happens(event)  # "left again"
        case Claim(that=Happens(event=event) as that):
            vague = isinstance(event.actor, Described) and not event.actor.definite
            return None if vague else that
    return None


def _not_done(first: Act, question: object) -> Act | None:
    """Read why we do not do what is spoken of: use a lane or a gap, go past as another does."""
    foil: Event | None = None
    if (lane := _lane_told(first)) is not None and _is_in_it(question):
        return Ask(Why(Not(Happens(Event("change-lane", object=lane, tense="present")))))
    match first, question:
        case Claim(that=Is(state="free" | "possible", thing=Lane(which=which) as lane)), Which(
            thing=Wanted(), such=Happens(event=Event(action="block" | "stop", object=Ego()))
        ) if which != "own":  # "the middle lane is free now, what is stopping you?"
            foil = Event("change-lane", object=lane, tense="present")
        case (
            (
                Claim(that=Is(state="free", thing=Lane(which="left" | "right" | "other") as lane))
                | Ask(
                    question=Whether(
                        that=Is(state="free", thing=Lane(which="left" | "right" | "other") as lane)
                    )
                )
            ),
            (
                Why(of=That(), suspect=None)
                | Why(
                    of=Not(
                        content=Happens(
                            event=Event(
                                action="go" | "move" | "change-lane" | "pull-out" | "do",
                                actor=Ego(),
                                side=None,
                            )
                        )
                    )
                )
            ),
        ):  # "it is empty on our left, so why didn't you go?"
            foil = Event("change-lane", object=lane, tense="present")
        case (
            (Claim(that=that) | Ask(question=Whether(that=that))),
            Why(of=Not(content=Happens(event=Event(action="do", actor=Ego(), object=Pronoun())))),
        ):
            foil = _likewise(that)
    return None if foil is None else Ask(Why(Not(Happens(foil))))


def _lane_told(first: Act) -> Lane | None:
    """Give the lane that is said to be free or to move."""
    that = first.that if isinstance(first, Claim) else None
    if isinstance(first, Ask) and isinstance(first.question, Whether):
        that = first.question.that
    match that:
        case Is(thing=Lane() as lane) | Happens(event=Event(actor=Lane() as lane)):
            return None if lane.which == "own" else lane
    return None


def _is_in_it(question: object) -> bool:
    """Say whether it is asked why we are not in the lane just named: "why aren't we in it?"."""
    match question:
        case Why(of=Not(content=Related(relation="on" | "in", thing=Ego(), to=Pronoun()))):
            return True
        case Why(of=Not(content=Happens(event=Event(action=action, actor=Ego(), side=None)))):
            return action in _CHANGES
    return False


def _likewise(that: Proposition) -> Event | None:
    """Give what we would do who use a gap, or go past others as another vehicle does."""
    match that:
        case Is(state="roomy"):
            return Event("go", tense="present")
        case Happens(event=event) if event.action in PASSING and not isinstance(event.actor, Ego):
            aside = event.where.relation if isinstance(event.where, Related) else ""
            sides: dict[str, Any] = {"left-of": "change-left", "right-of": "change-right"}
            return Event(sides.get(aside, "overtake"), tense="present")
    return None
