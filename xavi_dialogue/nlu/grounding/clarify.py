"""Clarification: when to ask back, and what is offered."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final, cast

from msgspec.structs import replace

from xavi_dialogue.domain.answers import WhichOne
from xavi_dialogue.domain.meaning import Act, Ask, Claim, Feel, Request, Whether
from xavi_dialogue.domain.rewriting import first, rewrite
from xavi_dialogue.domain.terms import (
    Described,
    Destination,
    Ego,
    Event,
    Exit,
    Happens,
    Has,
    Is,
    Junction,
    Lane,
    Measured,
    Proposition,
    Related,
    Thing,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.nlu.grounding.completion.discussion import interval, proposition_of
from xavi_dialogue.nlu.grounding.context import Context, Unclear

THINGS: Final = (Vehicle, Vehicles, Described, Ego, Junction, Exit, Lane, Destination)
CLOSE: Final = 0.15  # difference of cost up to which what the world tells may decide
LEVEL: Final = 0.06  # difference of cost up to which two readings are as good


@dataclass(frozen=True, slots=True)
class Clarification:
    """A question back, with what the next turn can pick."""

    which: WhichOne
    offers: tuple[Act, ...]
    things: tuple[Thing, ...] = ()


def essence(acts: Sequence[Act]) -> tuple[Act, ...]:
    """Strip what makes no difference to an answer: tense where the time is known, tags, manner."""
    return tuple(_bare(act) for act in acts)


def _bare(act: Act) -> Act:
    if isinstance(act, Claim):
        act = Ask(Whether(act.that))

    def change(part: Any) -> Any:
        match part:
            case Event():
                if part.tense != "past" or part.manner or part.modal:
                    return rewrite(replace(part, tense="past", manner=(), modal=None), change)
            case Measured() | Related() | Is() | Has():
                if part.tense != "present":
                    return rewrite(replace(part, tense="present"), change)
            case Whether(tag=True):
                return rewrite(replace(part, tag=False), change)
        return part

    return rewrite(act, change)


def gist(act: Act) -> Proposition | Thing | None:
    """Give what an act is about, to name it in a question back."""
    match act:
        case Ask(question=question):
            found = proposition_of(question)
            if found is not None:
                return found
            event = first(question, Event)
            if event is not None:
                return Happens(event)
            return cast(Thing | None, first(question, THINGS))
        case Claim(that=that):
            return that
        case Request(event=event):
            return Happens(event)
        case Feel(about=about):
            return about
    return None


def between_meanings(best: Sequence[Act], other: Sequence[Act]) -> Clarification | None:
    """Offer the first acts in which two readings differ; None where that cannot be named."""
    if len(best) != len(other):
        return None
    for one, two in zip(best, other, strict=True):
        if _bare(one) == _bare(two):
            continue
        gists = gist(one), gist(two)
        if gists[0] is None or gists[1] is None or _alike(gists[0], gists[1]):
            return None
        meant = (gists[0], gists[1])
        which = WhichOne(readings=meant, between="meanings", acts=(one, two))
        return Clarification(which, (one, two))
    return None


def apart(best: Sequence[Act], other: Sequence[Act]) -> bool:
    """Tell whether two readings ask the same of events that came about at different times.

    Only then are their answers different ones, and sensible both.
    """
    if len(best) != len(other):
        return False
    pairs = [pair for pair in zip(best, other, strict=True) if _bare(pair[0]) != _bare(pair[1])]
    return len(pairs) == 1 and _apart(*pairs[0])


def _apart(one: Act, other: Act) -> bool:
    if not isinstance(one, Ask) or not isinstance(other, Ask):
        return False
    events = first(one.question, Event), first(other.question, Event)
    if type(one.question) is not type(other.question) or events[0] is None or events[1] is None:
        return False
    whens = interval(events[0]), interval(events[1])
    if whens[0] is None or whens[1] is None or events[0].action == events[1].action:
        return False
    return whens[0][1] <= whens[1][0] or whens[1][1] <= whens[0][0]


def _alike(one: Proposition | Thing, two: Proposition | Thing) -> bool:
    return _bare(Feel("curious", one)) == _bare(Feel("curious", two))


def between_vehicles(unclear: Unclear, offers: Sequence[Act], context: Context) -> Clarification:
    """Offer the vehicles that a reference may mean."""
    things = tuple(Vehicle(n) for n in unclear.options)
    looks = (context.look(n, unclear.moment) for n in unclear.options)
    known = tuple(look for look in looks if look is not None)
    which = WhichOne(readings=things, looks=known, between="vehicles")
    return Clarification(which, tuple(offers), things)
