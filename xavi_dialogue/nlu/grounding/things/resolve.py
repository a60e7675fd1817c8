"""Resolve: one thing as spoken to one thing as grounded, by its sort."""

from dataclasses import replace as fields
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.answers import NoSuchVehicle
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Feature,
    Junction,
    Lane,
    Passenger,
    Pronoun,
    Related,
    Thing,
    Together,
    Unknown,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.nlu.grounding.context import Fits, Grounder, Window
from xavi_dialogue.nlu.grounding.things import places
from xavi_dialogue.nlu.grounding.things.descriptions import KNOWN, MISSING, described
from xavi_dialogue.nlu.grounding.things.pronouns import pronoun
from xavi_dialogue.nlu.grounding.things.scene import nearest

BEFORE: Final = 4.0  # [s] before a junction that belong to it
UNKNOWN: Final = 1.5  # cost of a reading that speaks of what has no sense here


def resolve(thing: Thing, g: Grounder, window: Window, fits: Fits | None = None) -> Thing:
    """Ground a thing; what cannot be found is noted, and stays as it was."""
    match thing:
        case Passenger():
            return Ego()
        case Vehicle(number=0):
            return Ego()
        case Vehicle() | Vehicles():
            return _numbered(thing, g, window)
        case Described(such=Related("on", Wanted(), Junction(rank=int(), time=None) as place)):
            there = _when_at(place, g, window)
            return described(replace(thing, such=None), g, there, fits)
        case Described():
            return described(thing, g, window, fits)
        case Together(members=members):
            return _together(tuple(resolve(one, g, window, fits) for one in members), thing)
        case Feature(kind="light", of=of) if of is not None:
            owner = g.thing(of, window)
            return replace(thing, of=None if isinstance(owner, Ego) else owner)
        case Pronoun(form="who"):
            return Wanted()
        case Pronoun():
            return pronoun(thing, g, window, fits)
        case Junction():
            return places.junction(thing, g, window)
        case Lane():
            return places.lane(thing, g, window)
        case Unknown(words=words):
            g.notes.unknown.append(words)
            g.notes.cost += UNKNOWN
    return thing


def _when_at(place: Junction, g: Grounder, window: Window) -> Window:
    """Take the time at which we were at a junction for the one of whom was there then."""
    found = places.junction(place, g, window)
    visit = places.visit_of(g.context, found)
    if visit is None:
        return window
    return fields(window, begin=max(visit.begin - BEFORE, g.context.begin), end=visit.end)


def _together(found: tuple[Thing, ...], thing: Thing) -> Thing:
    """Join the vehicles that were found for those named one by one."""
    numbers: dict[int, None] = {}
    for one in found:
        match one:
            case Vehicle(number=number):
                numbers[number] = None
            case Vehicles(numbers=several):
                numbers |= dict.fromkeys(several)
    if len(numbers) > 1:
        return Vehicles(tuple(numbers))
    return next((one for one in found if isinstance(one, Vehicle)), found[0] if found else thing)


def _numbered(thing: Vehicle | Vehicles, g: Grounder, window: Window) -> Thing:
    numbers = (thing.number,) if isinstance(thing, Vehicle) else thing.numbers
    absent = [n for n in numbers if n not in g.context.world.vehicles]
    if not absent:
        return thing
    moment = min(window.end, g.context.now)
    near = nearest(g.context, g.context.in_view(g.context.now), g.context.now)
    g.notes.missing.append(NoSuchVehicle(thing=Vehicle(absent[0]), time=moment, known=near[:KNOWN]))
    g.notes.cost += MISSING
    return thing
