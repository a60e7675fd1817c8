"""Avoidance: which option could have avoided something unpleasant that happened.

The decisions of the last seconds before it are examined, with their options that were tried often
enough. An option avoids it if it seldom happens in its rollouts, up to the time at which it did
happen, and if it happens markedly more often under what was chosen.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from planner.record.events import Event as RideEvent
from planner.record.trace import Action, PlanTrace, Rollout
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.domain.answers import Avoidance, NotRecorded
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.plans.chances import either_way
from xavi_dialogue.explain.causes.plans.contrast import alone, alternatives, factual, sides
from xavi_dialogue.explain.causes.plans.ranges import table
from xavi_dialogue.explain.causes.vehicles.course import HARD, brakes, lines, speed_mark, stands
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.ride import ROUNDING, Ride, Unanswered, planned

SLOWING: tuple[ActionName, ...] = ("stop", "slow-down", "give-way")  # not avoided by a stop
BEFORE = 10.0  # [s] before something happens, in which decisions may have avoided it
LEEWAY = 2.0  # [s] by which it may happen later in a rollout than it did
SELDOM = 0.25  # probability up to which an option avoids it
LESS = 0.25  # probability by which it must be rarer than under what was chosen

Occurs: TypeAlias = Callable[[Rollout, Motion | None], bool | None]  # None: not recorded


@dataclass(frozen=True, slots=True)
class _Way:
    """An option at a decision, with the risk of the mishap."""

    model: CausalModel
    here: Intervention  # what was chosen
    there: Intervention
    foil: tuple[Action, ...]
    risk: float  # under what was chosen
    other: float  # under the option


def avoiding(ride: Ride, mishap: ActionName, moment: float) -> Avoidance:
    """Find which option would have avoided what happened at a time [s], or that none would.

    Args:
        ride: the record.
        mishap: collide, brake (hard), stop, slow-down or give-way.
        moment: [s] when it happened.

    Raises:
        Unanswered: the record lacks the decisions before it.
    """
    occurs = _occurs(mishap, moment + LEEWAY)
    looked: list[PlanTrace] = []
    ways: list[_Way] = []
    for trace in ride.traces:
        early = moment - BEFORE <= trace.sim_time < moment - ROUNDING
        if early and trace.under_way is None and (found := _ways(ride, trace, occurs)) is not None:
            looked.append(trace)
            ways += found
    if not looked:
        raise Unanswered(NotRecorded("gap-in-record", since=moment - BEFORE, until=moment))
    better = (w for w in ways if w.other <= SELDOM and w.risk - w.other >= LESS)
    good = [w for w in better if _sound(w) and not (mishap in SLOWING and w.foil[:1] == ("stop",))]
    if good:
        best = max(good, key=lambda w: (w.there.value - w.here.value, w.model.trace.sim_time))
        return _told(ride, mishap, best, looked, len(ways), possible=True)
    if ways:
        least = min(ways, key=lambda w: (w.other, -w.model.trace.sim_time))
        return _told(ride, mishap, least, looked, len(ways), possible=False)
    return _without_options(ride, mishap, moment, looked)


def crashed(ride: Ride) -> RideEvent | None:
    """Find the last collision, if there was one."""
    return next((event for event in reversed(ride.events) if event.kind == "collided"), None)


def impact_of(crash: RideEvent) -> Episode:
    """Return a collision as an episode."""
    other = None if crash.vehicle is None else Vehicle(crash.vehicle)
    return Episode(Ego(), "collide", crash.sim_time, crash.sim_time, object=other)


def _occurs(mishap: ActionName, until: float) -> Occurs:
    """Return a check whether a mishap occurs in a rollout up to a time [s]."""

    def occurs(rollout: Rollout, line: Motion | None) -> bool | None:
        if mishap == "collide":
            return rollout.outcome == "collision"
        if mishap == "give-way":
            stretches = (s for s in rollout.held_up if s.how == "right-of-way")
            return any(s.since <= until for s in stretches)
        if line is None:
            return None
        part = line.until(until)
        if mishap == "brake":
            return brakes(part) >= HARD
        if mishap in ("stop", "stand", "wait"):
            return stands(part)
        return speed_mark(part, "slow-down") is not None

    return occurs


def _ways(ride: Ride, trace: PlanTrace, occurs: Occurs) -> list[_Way] | None:
    """Return the alternatives of a decision; None if the risk of what was chosen is not known."""
    model, plan = ride.model(trace), planned(trace)
    try:
        here = factual(model, trace)
    except Unanswered:
        return None
    known = lines(trace)
    risk = _risk(here, occurs, known)
    if risk is None:
        return None
    found = []
    for foil, there in alternatives(model, plan[0]):
        other = _risk(there, occurs, known)
        if other is not None:
            found.append(_Way(model, here, there, foil, risk, other))
    return found


def _risk(plan: Intervention, occurs: Occurs, known: Mapping[int, Motion]) -> float | None:
    """Return the probability of a mishap under a plan; None if too little is recorded."""
    bad = total = 0.0
    for result, weight in zip(plan.results, plan.weights, strict=True):
        there = occurs(result.rollout, known.get(result.rollout.index))
        if there is not None:
            total += weight
            bad += weight * there
    return min(bad / total, 1.0) if total >= 0.5 else None


def _chance(mishap: ActionName, share: float) -> float:
    """Return the probability of a mishap from its share of the rollouts, with their model error."""
    return table().trusted("collision", share) if mishap == "collide" else either_way(share)


def _sound(way: _Way) -> bool:
    """Check whether an option is no worse a choice: it neither collides nor loses the way."""
    return all(
        way.there.outcomes[name] <= max(way.here.outcomes[name], 0.05)
        for name in ("collision", "dead")
    )


def _told(
    ride: Ride,
    mishap: ActionName,
    way: _Way,
    looked: Sequence[PlanTrace],
    options: int,
    *,
    possible: bool,
) -> Avoidance:
    return Avoidance(
        mishap,
        possible,
        happened=True,
        risk=_chance(mishap, way.risk),
        other=_chance(mishap, way.other),
        decisions=len(looked),
        options=options,
        contrast=sides(ride, way.model, way.here, way.there, way.foil),
    )


def _without_options(
    ride: Ride, mishap: ActionName, moment: float, looked: Sequence[PlanTrace]
) -> Avoidance:
    """Return the answer that there was nothing else to do."""
    trace = looked[-1]
    model = ride.model(trace)
    here = factual(model, trace)
    risk = _chance(mishap, _risk(here, _occurs(mishap, moment + LEEWAY), lines(trace)) or 0.0)
    contrast = alone(ride, model, here)
    count = len(looked)
    return Avoidance(mishap, False, True, risk, risk, count, 0, contrast)
