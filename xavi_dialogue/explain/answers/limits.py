"""Limits: whether somebody keeps to the speed limit, is fast, or slow."""

from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Is, Thing
from xavi_dialogue.explain.answers.asked import Asked
from xavi_dialogue.explain.answers.findings import Finding, known, unknown
from xavi_dialogue.explain.answers.moments import instant
from xavi_dialogue.explain.answers.naming import (
    somebodies,
)

OVER = 0.5  # [m/s] above the limit that is no more than rounding
SLOW = 0.6  # share of the limit below which a vehicle is slow


def within_limit(asked: Asked, thing: Thing, at: float, *, allowed: bool) -> Finding:
    """Tell whether somebody keeps to the limit, or drives faster than it."""
    who = (somebodies(asked, thing, at) or (Ego(),))[0]
    speed = asked.world.measure("speed", who, at)
    limit = asked.world.measure("limit", who, at)
    if speed.value is None or limit.value is None:
        return unknown(speed.gap or limit.gap or "not-recorded", *known(speed, limit))
    beside = Measure("speed", who, at, value=speed.value, reference=limit.value)
    over = speed.value > limit.value + OVER
    return Finding(over != allowed, (beside,))


def fast(of: Is, asked: Asked) -> Finding:
    """Tell whether somebody is fast, over the limit, or slow, far below it."""
    at = instant(asked, of.time, of.tense)
    if of.state == "fast":
        return within_limit(asked, _whose(of), at, allowed=False)
    found = within_limit(asked, _whose(of), at, allowed=True)
    speed = next((f for f in found.facts if isinstance(f, Measure)), None)
    if speed is None or speed.value is None or speed.reference is None:
        return found
    return Finding(speed.value < SLOW * speed.reference, found.facts)


def _whose(of: Is) -> Thing:
    """Tell whose speed it is: ours where nobody is named."""
    if of.thing is not None:
        return of.thing
    return Ego() if of.event is None else of.event.actor
