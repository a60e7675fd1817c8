"""Races: questions for who is first where two ways meet: "will it get there before us?"."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import HowSure, Question, Whether, Which, Why
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Happens,
    Is,
    Junction,
    Passenger,
    Pronoun,
    Proposition,
    Related,
    Relative,
    Thing,
    Time,
    Unsaid,
    Vehicle,
    Wanted,
)

_REACHING: Final = frozenset(
    ("arrive", "enter", "go", "come", "cross", "pass", "head", "move", "turn")
)
_OURS: Final = (Ego(), Passenger())
_THEIRS: Final = (Described, Pronoun, Vehicle)


def race(spoken: Question) -> Question | None:
    """Ask who goes first in the place of who gets to a place first; None: it is not asked."""
    match spoken:
        case Whether(that=that) if (first := _first(that)) is not None:
            return replace(spoken, that=first)
        case HowSure(of=of) if of is not None and (first := _first(of)) is not None:
            return replace(spoken, of=first)
        case Which(thing=Wanted(), such=Happens(event=event)) if (
            event.action == "arrive" and "first" in event.manner and event.tense != "past"
        ):
            return replace(spoken, such=_goes(Wanted(), Ego()))
        case Why(
            of=Happens(event=Event(action=action, actor=Ego(), manner=("first",)) as event),
            instead=Happens(event=Event(action=same, actor=other)),
        ) if action == same and isinstance(other, _THEIRS):
            before = None if isinstance(other, Pronoun) else other
            return replace(spoken, of=Happens(replace(event, object=before)), instead=None)
    return None


def _first(of: Proposition) -> Happens | None:
    match of:
        case Happens(event=event) if event.tense in ("present", "future"):
            return _of_event(event)
        case (
            Related(relation="near" | "on" | "to", thing=thing, to=Junction(), time=time)
            | Is(state="present" | "over", thing=thing, time=time)
        ) if of.tense in ("present", "future"):
            other = _sooner(time)
            return None if other is None or thing is None else _between(thing, other)
    return None


def _of_event(event: Event) -> Happens | None:
    """Read "gets there before us", "arrives first" and "is past before we come"."""
    if event.action not in _REACHING or not isinstance(event.object, Junction | None):
        return None
    match event.where:
        case Related(relation="ahead-of", to=Ego() | Passenger()) if event.action == "arrive":
            return _between(event.actor, Ego())
    other = _sooner(event.time)
    if other is not None:
        return _between(event.actor, other)
    first = event.action == "arrive" and "first" in event.manner
    return _between(event.actor, Ego()) if first and isinstance(event.time, Unsaid) else None


def _sooner(time: Time) -> Thing | None:
    """Give who comes after whom: of "before we get there", us."""
    match time:
        case Relative(relation="before", anchor=Event(action=action, actor=actor, tense=tense)):
            near = action in _REACHING or action == "do"
            return actor if near and tense in ("present", "future", "perfect") else None
        case Relative(
            relation="before", anchor=Ego() | Passenger() | Described() | Pronoun() as who
        ):
            return who
    return None


def _between(one: Thing, other: Thing) -> Happens | None:
    """Ask whether one of us and another vehicle goes first; None of any other pair."""
    if one in _OURS and isinstance(other, _THEIRS):
        return _goes(Ego(), other)
    return _goes(one, Ego()) if other in _OURS and isinstance(one, _THEIRS) else None


def _goes(one: Thing, other: Thing) -> Happens:
    return Happens(Event("go", one, other, manner=("first",), tense="future"))
