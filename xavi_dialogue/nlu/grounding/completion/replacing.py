"""Replacing: put a new thing, event or time where one of its sort stands in a term."""

from typing import Any, TypeVar

import msgspec
from msgspec.structs import replace

from xavi_dialogue.domain.rewriting import first, rewrite, substitute
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exit,
    Feature,
    Happens,
    Junction,
    Lane,
    Measured,
    Nobody,
    Pronoun,
    Thing,
    Time,
    Unsaid,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.nlu.grounding.completion.discussion import PROPOSITIONS
from xavi_dialogue.nlu.grounding.context import Context

T = TypeVar("T")
_USERS = (Vehicle, Vehicles, Described, Pronoun, Nobody)
_PLACES = (Exit, Junction, Lane, Feature)


def with_thing(term: T, thing: Thing, context: Context) -> T:
    """Put a thing in the place of the one of its sort: a vehicle for a vehicle, else for us."""
    for sorts in (_PLACES, _USERS):
        if isinstance(thing, (*sorts, Ego) if sorts is _USERS else sorts):
            old = first(term, sorts)
            if old is not None:
                return substitute(term, old, thing)
    if isinstance(thing, Ego):
        return term
    event = first(term, Event)
    if isinstance(thing, _PLACES):
        return term if event is None else with_event(term, replace(event, object=thing))
    return substitute(term, Ego(), thing) if first(term, Ego) is not None else _subject(term, thing)


def _subject(term: T, thing: Thing) -> T:
    """Make a thing what a term is about where the term names nobody."""
    if not isinstance(term, msgspec.Struct):
        return term
    for name in ("actor", "about", "thing"):
        if name in term.__struct_fields__ and getattr(term, name) is None:
            return replace(term, **{name: thing})
    return term


def with_event(term: Any, event: Event) -> Any:
    """Put an event in the place of the one there is; its actor stays where none is said."""
    old = first(term, Event)
    if old is None:
        return Happens(event) if term is None or isinstance(term, PROPOSITIONS) else term
    new = event
    if isinstance(event.actor, Ego) and event.actor != old.actor and event != old:
        new = replace(event, actor=old.actor)
    if isinstance(new.time, Unsaid) and new.tense == old.tense and new.action == old.action:
        new = replace(new, time=old.time)
    return substitute(term, old, new)


def with_time(term: Any, time: Time) -> Any:
    """Ask of another time: of the outermost times, those are replaced that are of its event."""
    if isinstance(term, Event | Measured) or hasattr(term, "time"):
        return replace(term, time=time)

    def change(part: Any) -> Any:
        if isinstance(part, msgspec.Struct) and "time" in part.__struct_fields__:
            if isinstance(part, Junction):
                return part
            return replace(part, time=time)
        return part

    return rewrite(term, change)
