"""Freed: what held the ego up before it set off or sped up, and no longer does."""

import dataclasses

from sim.scene import EGO
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Feature
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.driving.driving import reasons_for
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons
from xavi_dialogue.explain.facts.episodes.light_waits import holds
from xavi_dialogue.explain.facts.traffic_lights import told
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.explain.history.traffic_lights import shown

LATELY = 4.0  # [s] after a hold-up in which its end still explains why we drive on
FASTER = 1.0  # [m/s] by which somebody must have sped up to count as moved on
HELD: tuple[ActionName, ...] = ("stop", "stand", "wait", "give-way", "slow-down", "brake")


def driven_for(ride: Ride, world: World, deed: Episode, at: float | None = None) -> Reasons:
    """Find why the ego drove as it did; if it sped up, what held it up until then comes first.

    Raises:
        Unanswered: the record lacks the decision; or rollouts are needed.
    """
    found = reasons_for(ride, world, deed, at)
    released = freed(ride, world, deed.begin) if deed.action == "speed-up" else None
    if released is None:
        return found
    rest = (cause for cause in found.causes if cause.kind != "starting")
    return dataclasses.replace(found, causes=(released, *rest))


def freed(ride: Ride, world: World, time: float) -> MotionCause | None:
    """Find what held us up until shortly before a time [s], and no longer does.

    Raises:
        Unanswered: rollouts are needed.
    """
    green = _green(ride, time)
    if green is not None:
        return green
    before = world.episodes(Ego(), HELD, time - LATELY, time)
    held = max(before, key=lambda e: e.begin, default=None)
    if held is None:
        return None
    end = time if held.end is None else min(held.end, time)
    cause = next(iter(reasons_for(ride, world, held, end).causes), None)
    if cause is None or cause.vehicle is None:
        return None
    if cause.kind == "right-of-way":
        return MotionCause("let-go", cause.vehicle)
    look = world.look(cause.vehicle, time)
    lowest = world.look(cause.vehicle, end)
    moves = look is not None and lowest is not None and look.speed > lowest.speed + FASTER
    return MotionCause("moved-on", cause.vehicle) if moves else None


def _green(ride: Ride, time: float) -> MotionCause | None:
    """Find the light that held us until it turned green."""
    for hold in reversed(holds(ride, EGO)):
        if time - 2.0 * LATELY <= hold.end <= time + LATELY and hold.begin < time:
            now = shown(ride, hold.signal, time)
            seen = None if now is None else told(ride, hold.signal, now, Feature("light"))
            if seen is not None and seen.colour == "green" and seen.begun:
                return MotionCause("light", shown=seen)
    return None
