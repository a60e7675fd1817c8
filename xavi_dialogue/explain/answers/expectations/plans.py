"""Plans: what the ego is going to do, when, and how long that takes, by its rollouts."""

import itertools
import math
from collections.abc import Callable

import numpy as np

from planner.record.trace import Action, PlanTrace, Rollout
from xavi_dialogue.causal.effects import quantile
from xavi_dialogue.causal.model import Intervention
from xavi_dialogue.domain.answers import PlanAhead
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Destination, Ego, Event, Junction, Thing
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.explain.answers.expectations.foreseen import (
    EXPECTED,
    HALTS,
    STARTS,
    YIELDS,
    macros,
    sided,
)
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.causes.plans.contrast import factual
from xavi_dialogue.explain.causes.vehicles.course import Expected, begins, expected, lines, moves_on
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.ride import planned

#: Actions that are stated as under way before what comes next.
MOVES: frozenset[Action] = frozenset(
    ("change-left", "change-right", "exit-left", "exit-right", "exit-straight")
)
AHEAD: tuple[Attribute, ...] = ("turn", "exit-number", "distance", "time-to-go")
STANDSTILL = 8.0  # [s] maximum time from braking to a standstill for it to be a stop
REGAINED = 0.5  # [m/s] above the lowest speed, from which the ego is faster again
HELD = 5.0  # [s] for which a light holds the ego if it stops for it, more or less
WALKING = 1.5  # [m/s] up to which the ego stops for a light, if only to roll up to the line
Mark = Callable[[Rollout, Motion], float | None]


def plan_ahead(asked: Asked, *, measures: bool = True) -> PlanAhead:
    """Return what the ego does next, with what it comes to on its way."""
    ride, world = asked.ride, asked.world
    if ride.arrived or not ride.traces:
        return PlanAhead((), arrived=ride.arrived)
    known: tuple[Measure, ...] = ()
    if measures:
        rotary = Junction("roundabout", 1)
        to: dict[Attribute, Thing] = {"time-to-go": Destination(), "distance": rotary}
        found = (world.measure(a, Ego(), asked.now, to.get(a)) for a in AHEAD)
        known = tuple(m for m in found if m.gap is None)
    begun = ride.under_way
    going = begun is not None and begun.action in MOVES and begun.ended is None
    return PlanAhead(steps(asked), known, begun=begun.action if begun and going else None)


def steps(asked: Asked) -> tuple[tuple[Action, float], ...]:
    """List the actions of the plan still to begin, with when [s] they are expected to."""
    begun = asked.ride.under_way
    found: list[tuple[Action, float]] = []
    for action in dict.fromkeys(planned(asked.ride.latest)):
        time = foreseen(asked, Event(action))
        same = begun is not None and begun.action == action
        under_way = (
            begun is not None
            and same
            and (begun.committed is not None or action in ("continue", "stop"))
        )
        if time is not None and not under_way:
            found.append((action, max(time.moment, asked.now)))
    if not found and begun is not None and begun.action == "continue":
        found.append(("continue", asked.now))
    return tuple(sorted(found, key=lambda step: step[1]))


def current_plan(asked: Asked) -> tuple[PlanTrace, Intervention] | None:
    """Return the last decision, and the results of its plan; None: too little evidence."""
    if not asked.ride.traces:
        return None
    trace = asked.ride.latest
    try:
        return trace, factual(asked.ride.model(trace), trace)
    except Unanswered:
        return None


def foreseen(asked: Asked, event: Event) -> Expected | None:
    """Return when the ego does something under its plan; None if no rollout shows that."""
    return _read(asked, _mark(event))


def covers(asked: Asked, distance: float) -> Expected | None:
    """Return when the ego has gone a distance [m] from where it is now, under its plan."""

    def gone(_: Rollout, motion: Motion) -> float | None:
        left = distance
        later = list(motion.within(asked.now, math.inf))
        for before, k in itertools.pairwise(later):
            left -= math.dist(motion.position[before], motion.position[k])
            if left <= 0.0:
                return motion.time[k]
        return None

    return _read(asked, gone)


def stopping_at_light(asked: Asked) -> float:
    """Return the probability that a light holds the ego down to walking pace under its plan."""
    known = current_plan(asked)
    if known is None:
        return 0.0
    drawn = lines(known[0])
    rows = list(zip(known[1].results, known[1].weights, strict=True))
    held = sum(w for one, w in rows if _is_held(one.rollout, drawn.get(one.rollout.index)))
    total = sum(weight for _, weight in rows)
    return float(held / total) if total > 0.0 else 0.0


def _is_held(rollout: Rollout, motion: Motion | None) -> bool:
    """Check whether a light holds the ego down to walking pace in a rollout.

    Without its line, which a large trace lacks, it counts for how long the light holds it.
    """
    for held in rollout.held_by_lights:
        if motion is None or not motion.time:
            if held.until - held.since >= HELD:
                return True
        elif any(motion.speed[k] < WALKING for k in motion.within(held.since, held.until)):
            return True
    return False


def is_halting(asked: Asked) -> bool:
    """Check whether the ego brakes, and stands still soon under its plan."""
    if occasion(asked, Event("brake", tense="present")) is None:
        return False
    found = foreseen(asked, Event("stop"))
    soon = found is not None and found.moment <= asked.now + STANDSTILL
    return found is not None and soon and found.share >= EXPECTED


def moving_on(asked: Asked) -> Expected | None:
    """Return when the ego, which stands, drives on."""
    return _read(asked, moves_on)


def horizon(asked: Asked) -> float | None:
    """Return up to when [s] the plan is known."""
    known = current_plan(asked)
    if known is None:
        return None
    return max((m.time[-1] for m in lines(known[0]).values() if m.time), default=None)


def slowest_ahead(asked: Asked) -> float | None:
    """Return the speed [m/s] that the ego slows down to next under its plan; None: not known."""
    known = current_plan(asked)
    if known is None:
        return None
    drawn = lines(known[0])
    found, weights = [], []
    for result, weight in zip(known[1].results, known[1].weights, strict=True):
        motion = drawn.get(result.rollout.index)
        if motion is not None and weight > 0.0 and motion.speed:
            found.append(_first_low(motion, asked.now))
            weights.append(weight)
    return quantile(np.array(found), np.array(weights), 0.5) if found else None


def _first_low(motion: Motion, now: float) -> float:
    """Return the lowest speed [m/s] of a line before it picks up speed again."""
    inside = motion.within(now, math.inf)
    low = motion.speed[inside[0] if inside else -1]
    for k in inside:
        if motion.speed[k] > low + REGAINED and low < motion.speed[inside[0]] - REGAINED:
            break
        low = min(low, motion.speed[k])
    return low


def _read(asked: Asked, mark: Mark) -> Expected | None:
    known = current_plan(asked)
    return None if known is None else expected(*known, mark)


def _mark(event: Event) -> Mark:
    """Return a function that finds when [s] an event begins in a rollout."""
    action, names = sided(event), macros(event)
    if action in YIELDS:
        return lambda rollout, _: next(
            (held.since for held in rollout.held_up if held.how == "right-of-way"), None
        )
    if action in HALTS:
        return begins("stop", ("stop",))
    if action in ("slow-down", "brake"):
        return begins("slow-down", ())
    if action == "speed-up":
        return begins("speed-up", ())
    if action in ("collide", "arrive"):
        outcome = "collision" if action == "collide" else "done"
        return lambda rollout, motion: motion.time[-1] if rollout.outcome == outcome else None
    if action in STARTS:
        return moves_on
    return begins(action, names)
