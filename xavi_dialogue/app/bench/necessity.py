"""Whether a vehicle was necessary: the decision, or the whole ride, once more without it."""

from collections.abc import Sequence
from random import Random

import msgspec

from planner.trace import PlanTrace, WhatIf
from planner.whatif import WhatIfError, replan
from sim.network import Network
from sim.scene import EGO
from xavi_dialogue.app.bench.asking import Ridden
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.explain.causes.contrast import factual
from xavi_dialogue.explain.history.ride import Unanswered

PLAN_LATER = 0.5  # [s] of expected time by which a plan differs
RIDE_LATER = 1.0  # [s] of arrival by which a ride differs


class Removal(msgspec.Struct, frozen=True):
    """What it makes of a difference that a vehicle is not there."""

    vehicle: int
    named: bool  # among the causes
    plan: bool | None  # planned again without it, the decision differs; None: cannot be planned
    ride: bool | None  # driven again without it, the ride differs; None: not driven
    delay: float | None = None  # [s] by which the ride then takes longer, where both arrive


def plan_changes(trace: PlanTrace, network: Network, vehicle: int) -> bool | None:
    """Whether a decision differs without a vehicle: first action, outcome or expected time.

    Returns:
        None where it cannot be planned again, or either plan lacks evidence.
    """
    try:
        again = replan(trace, network, WhatIf(removed=vehicle))
        here, there = (factual(_model(one), one) for one in (trace, again))
    except (WhatIfError, Unanswered):
        return None
    if here.plan[:1] != there.plan[:1] or here.likeliest != there.likeliest:
        return True
    times = here.expectation("time"), there.expectation("time")
    if times[0] is None or times[1] is None:
        return times[0] is not times[1]
    return abs(times[0] - times[1]) >= PLAN_LATER


def ride_changes(ridden: Ridden, other: Ridden) -> bool:
    """Whether two rides differ: in how they end, in manoeuvres, or in when they arrive."""
    if (ridden.ending, ridden.manoeuvres) != (other.ending, other.manoeuvres):
        return True
    return abs(ridden.time[-1] - other.time[-1]) >= RIDE_LATER


def delay(ridden: Ridden, other: Ridden) -> float | None:
    """By how much [s] the second ride takes longer; None where one does not arrive."""
    if ridden.ending != "arrived" or other.ending != "arrived":
        return None
    return round(other.time[-1] - ridden.time[-1], 3)


def compared(trace: PlanTrace, named: Sequence[int], seed: int) -> tuple[int, ...]:
    """As many vehicles that are in view and not named as there are named ones, at random."""
    rest = [vehicle for vehicle in trace.scene if vehicle != EGO and vehicle not in named]
    return tuple(sorted(Random(f"unnamed/{seed}").sample(rest, min(len(named), len(rest)))))


def _model(trace: PlanTrace) -> CausalModel:
    return CausalModel(trace)
