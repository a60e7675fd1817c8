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
from xavi_dialogue.explain.answers.sight.attention import attending

MANY = 6  # minimum of vehicles in view on a busy road
#: Actions of a driver for another one that they see.
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
    """Weigh that we saw somebody; for others, only their conduct towards us can be stated."""
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
    """Return facts on whether we will see a vehicle: where it is, or which way it went.

    The record has no prediction of where vehicles are beyond the horizon of the plan.
    """
    look = asked.world.look(vehicle, asked.now)
    went = None if look is None else came_of(asked, vehicle, asked.world.begin)
    known: tuple[Fact | None, ...] = (went, look)
    facts = tuple(fact for fact in known if fact is not None)
    return unknown("in-future", *facts)


def minded(of: Is, asked: Asked) -> Finding:
    """Return facts on how a driver feels, or attends to the road: what they did for us."""
    if of.state == "awake" and is_us(of.thing):
        return Finding(None, answer=attending(of, asked))
    vehicle = number(of.thing)
    if vehicle is None:
        return unknown("others-thoughts")
    return unknown("others-thoughts", *others_mind(asked, vehicle).facts[:1])


def busy(of: Is, asked: Asked) -> Finding:
    """Weigh that many vehicles are in view."""
    at = instant(asked, of.time, of.tense)
    seen = sorted(looks(asked, asked.world.in_view(at), at), key=lambda x: (x.distance, x.vehicle))
    return Finding(len(seen) >= MANY, tuple(seen))


def others_mind(asked: Asked, vehicle: int) -> Finding:
    """Return facts on what a driver knows about us: what they did for us, and where they were."""
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
    """Weigh that somebody comes towards us, or from a side into our way; None for other things."""
    if event.object is not None and not is_us(event.object):
        return None
    look = look_of(asked, event.actor, asked.now)
    if look is None or not look.in_view or asked.past is not None:
        return None
    return Finding(look.oncoming or look.bearing.startswith("crossing"), (look,))
