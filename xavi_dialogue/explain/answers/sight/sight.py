"""Sight: whether we see, saw or will see somebody, and whether somebody comes or sees us."""

from xavi_dialogue.domain.answers import Located
from xavi_dialogue.domain.facts import Fact
from xavi_dialogue.domain.terms import Ego, Event, Is, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.foreseen import came_of
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, unknown
from xavi_dialogue.explain.answers.reference.moments import instant, is_ahead, window
from xavi_dialogue.explain.answers.reference.naming import (
    first_look,
    is_us,
    look_of,
    looks,
    number,
    somebodies,
)

MANY = 6  # vehicles in view from which it is busy
#: What a driver does for another one whom he sees.
KIND: tuple[ActionName, ...] = (
    "give-way",
    "let-go",
    "wait",
    "slow-down",
    "brake",
    "stop",
    "swerve",
)


def sees(asked: Asked, event: Event) -> Finding:
    """Tell whether we saw somebody; of others it can only be told how they behaved towards us."""
    if is_us(event.actor):
        vehicle = number(event.object)
        at = window(asked, event.time, event.tense).end
        if vehicle is None:
            seen = somebodies(asked, event.object, at)
            return Finding(bool(seen)) if seen else unknown("not-sensed")
        if is_ahead(asked, event.time, event.tense):
            return _sees_again(asked, vehicle)
        first = first_look(asked, vehicle, asked.world.begin)
        now = asked.world.look(vehicle, at)
        if event.tense == "present" and now is not None:
            lost = Located(Vehicle(vehicle), (now,), gap="out-of-view")
            return Finding(now.in_view, (now,), answer=None if now.in_view else lost)
        shown = () if now is None else (now,)
        return Finding(first is not None and first.time <= at, shown)
    vehicle = number(event.actor)
    if vehicle is None:
        return unknown("others-thoughts")
    return others_mind(asked, vehicle)


def _sees_again(asked: Asked, vehicle: int) -> Finding:
    """Tell what bears on whether we are going to see a vehicle: where it is, or which way it went.

    A prediction of where vehicles are later than the plan reaches is in no record.
    """
    look = asked.world.look(vehicle, asked.now)
    went = None if look is None else came_of(asked, vehicle, asked.world.begin)
    known: tuple[Fact | None, ...] = (went, look)
    facts = tuple(fact for fact in known if fact is not None)
    return unknown("in-future", *facts)


def minded(of: Is, asked: Asked) -> Finding:
    """Tell what bears on how a driver feels, or attends to the road: what he did for us."""
    vehicle = number(of.thing)
    if vehicle is None:
        return unknown("others-thoughts")
    return unknown("others-thoughts", *others_mind(asked, vehicle).facts[:1])


def busy(of: Is, asked: Asked) -> Finding:
    """Tell whether many vehicles are in view."""
    at = instant(asked, of.time, of.tense)
    seen = looks(asked, asked.world.in_view(at), at)
    return Finding(len(seen) >= MANY, seen)


def others_mind(asked: Asked, vehicle: int) -> Finding:
    """Tell what bears on what a driver knows of us: what he did for us, and where he was."""
    behaved = [
        e
        for e in asked.world.episodes(actor=Vehicle(vehicle), actions=KIND)
        if e.action in ("slow-down", "brake", "stop") or isinstance(e.object, Ego)
    ]
    for_us = [e for e in behaved if isinstance(e.object, Ego)]
    look = asked.world.look(vehicle, asked.now)
    facts: tuple[Fact, ...] = (*(for_us or behaved)[-1:], *(() if look is None else (look,)))
    return unknown("others-thoughts", *facts)


def comes(asked: Asked, event: Event) -> Finding | None:
    """Tell whether somebody comes towards us, or for our way from a side; None of other things."""
    if event.object is not None and not is_us(event.object):
        return None
    look = look_of(asked, event.actor, asked.now)
    if look is None or not look.in_view or asked.past is not None:
        return None
    return Finding(look.oncoming or look.bearing.startswith("crossing"), (look,))
