"""Limits: whether somebody keeps to the speed limit, is fast, or slow."""

from dataclasses import replace

from msgspec import structs

from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.terms import Ego, Is, Thing
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, known, unknown
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window, instant, window
from xavi_dialogue.explain.answers.reference.naming import is_us, somebodies

OVER = 0.5  # [m/s] above the limit that does not count
SOON = 5.0  # [s] before slowing down that we are about to begin
SLOWING: tuple[ActionName, ...] = ("slow-down", "brake")
SLOW = 0.6  # share of the limit below which a vehicle is slow


def within_limit(asked: Asked, thing: Thing, at: float, *, allowed: bool) -> Finding:
    """Check whether a vehicle keeps to the limit (`allowed`), or drives faster."""
    who = (somebodies(asked, thing, at) or (Ego(),))[0]
    speed = asked.world.measure("speed", who, at)
    limit = asked.world.measure("limit", who, at)
    if speed.value is None or limit.value is None:
        return unknown(speed.gap or limit.gap or "not-recorded", *known(speed, limit))
    beside = Measure("speed", who, at, value=speed.value, reference=limit.value)
    over = speed.value > limit.value + OVER
    return Finding(over != allowed, (beside,))


def fast(of: Is, asked: Asked) -> Finding:
    """Check whether a vehicle is fast, over the limit, or slow, far below it."""
    at = instant(asked, of.time, of.tense)
    about = window(asked, of.time, of.tense)
    if of.state == "fast" and of.tense in ("past", "perfect") and not about.instant:
        return _ever_fast(asked, _whose(of), about)
    if of.state == "fast":
        found = within_limit(asked, _whose(of), at, allowed=False)
        ours = is_us(_whose(of)) and asked.now - at < SHORT
        return replace(found, facts=(*found.facts, *slowing(asked))) if ours else found
    found = within_limit(asked, _whose(of), at, allowed=True)
    speed = next((f for f in found.facts if isinstance(f, Measure)), None)
    if speed is None or speed.value is None or speed.reference is None:
        return found
    return Finding(speed.value < SLOW * speed.reference, found.facts)


def _ever_fast(asked: Asked, thing: Thing, about: Window) -> Finding:
    """Check whether a vehicle was over the limit at its fastest in a stretch of the ride."""
    who = (somebodies(asked, thing, about.end) or (Ego(),))[0]
    fastest = asked.world.extreme("speed", who, "highest", about.begin, about.end)
    limit = asked.world.measure("limit", who, fastest.time)
    if fastest.value is None or limit.value is None:
        return unknown(fastest.gap or limit.gap or "not-recorded", *known(fastest, limit))
    over = fastest.value > limit.value + OVER
    return Finding(over, (fastest, limit))


def slowing(asked: Asked) -> tuple[Episode, ...]:
    """Return our slowing down that is under way, without its speeds."""
    found = asked.world.episodes(actor=Ego(), actions=SLOWING)
    going = [e for e in found if e.end is None and e.begin <= asked.now]
    return tuple(structs.replace(e, speed_from=None, speed_to=None) for e in going[-1:])


def _whose(of: Is) -> Thing:
    """Return whose speed is meant; ours if nobody is named."""
    if of.thing is not None:
        return of.thing
    return Ego() if of.event is None else of.event.actor
