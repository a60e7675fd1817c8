"""Restrained: the reasons for how the ego drove, by what its driving recorded as in its way.

In each step, the driver knows what keeps the ego from driving faster. That is what explains an
episode: for slowing down, what took most of the speed; for standing, what lasted longest. While an
episode goes on, its last seconds count. Rides without such a record, and stops that the plan
decided, are explained by decisions alone (`driving`).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from msgspec import structs

from planner.record.events import RestraintKind
from planner.record.trace import HoldUp, PlanTrace
from xavi_dialogue.causal.model import Actions, CausalModel
from xavi_dialogue.domain.answers import Cause, Evidence, Mechanism, MotionCause, NeedRollout
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.driving.hidden_areas import hidden_causes
from xavi_dialogue.explain.causes.driving.passed import has_passed
from xavi_dialogue.explain.causes.driving.roadside import (
    TURNS,
    bends_first,
    limit_at,
    road_causes,
)
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons, in_force, motion_cause
from xavi_dialogue.explain.causes.driving.traffic_lights import light_causes
from xavi_dialogue.explain.causes.driving.yielding import kept
from xavi_dialogue.explain.causes.plans.contrast import evidence, factual
from xavi_dialogue.explain.causes.vehicles.hindsight import in_hindsight
from xavi_dialogue.explain.causes.vehicles.involved import expected_actions
from xavi_dialogue.explain.causes.vehicles.necessity import proven
from xavi_dialogue.explain.causes.vehicles.profile import SHOWN
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.nearing import speed_at, with_lowest, with_speeds
from xavi_dialogue.explain.history.restraints import SHARE, Restraint, lasted, restraints, slowed
from xavi_dialogue.explain.history.ride import Ride, Unanswered

LEEWAY = 1.0  # [s] before an episode from which on the speeds of its reasons count
BEFORE = 2.0  # [s] before a standstill, in which the ego braked for it
LATELY = 2.0  # [s] of an episode that goes on, which explain it
AT_ONCE = 0.6  # [s] around a moment that explain a speed then
SLOWING = frozenset[ActionName](("slow-down", "brake"))
STATES = frozenset[ActionName](("move", "follow"))
#: Restraints by the road, as the kinds of reasons that they are.
ON_ROAD: Mapping[RestraintKind, tuple[str, ...]] = {
    "bend": ("turn", "bend", "roundabout"),
    "limit": ("limit",),
    "road-end": ("destination", "lane-end"),
}
#: Restraints by another road user, as how it holds the ego up.
HOLDING: Mapping[RestraintKind, HoldUp] = {
    "leader": "leader",
    "right-of-way": "right-of-way",
    "cut-in": "cut-in",
    "moves-in": "cut-in",
    "blocked": "blocked",
}
#: Restraints that say nothing of why: they leave it to the decision.
#: What of the road itself makes us slow down.
ROADS = frozenset[RestraintKind](("bend", "limit", "stands-first", "road-end"))
OPEN = frozenset[RestraintKind](("stop", "nothing"))


@dataclass(frozen=True, slots=True)
class Restraining:
    """What kept the ego from driving faster in an episode, the most important first."""

    found: tuple[Restraint, ...]
    time: float  # [s] of the episode that it explains
    minor: tuple[Restraint, ...] = ()  # the others, which took less

    @property
    def vehicles(self) -> tuple[int, ...]:
        """The road users in the way, most important first."""
        held = (one.vehicle for one in self.found if one.by in HOLDING)
        return tuple(dict.fromkeys(vehicle for vehicle in held if vehicle is not None))

    def has(self, *kinds: RestraintKind) -> bool:
        """Check whether one of some kinds of restraint is among them."""
        return any(one.by in kinds for one in self.found)


def restraining(ride: Ride, deed: Episode, at: float) -> Restraining | None:
    """Find what kept the ego from driving faster in an episode.

    Args:
        ride: the record.
        deed: the episode.
        at: [s] the moment of it that is asked about.

    Returns:
        None if the record does not have it, or if it was the plan to stop.
    """
    if deed.action == "speed-up":
        return None
    end = ride.now if deed.end is None else deed.end
    begin = deed.begin - (BEFORE if deed.action == "stop" else 0.0)
    if deed.action in STATES:
        begin, end = deed.begin - AT_ONCE, deed.begin
    elif deed.end is None:
        begin, end = max(begin, min(at, end) - LATELY), min(at, end)
    braked = slowed(ride, begin, end) if deed.action in SLOWING else {}
    braked = {one: lost for one, lost in braked.items() if one.by != "nothing"}
    shares = braked or lasted(ride, begin, end)
    total = sum(shares.values())
    ranked = sorted(shares, key=lambda one: -shares[one])  # as much: in order of time
    found = tuple(one for one in ranked if shares[one] >= SHARE * total > 0.0)
    if not found or found[0].by in OPEN:
        return None
    minor = tuple(one for one in ranked if one not in found and one.by in ROADS)
    found = tuple(one for one in found if one.by not in OPEN)
    return Restraining(found, (begin + end) / 2.0, minor)


def _still(ride: Ride, held: Restraining, at: float) -> Restraining | None:
    """Leave out whom the ego let go first and who has passed by a time [s]; None: all have."""
    left = tuple(
        one
        for one in held.found
        if one.by != "right-of-way" or not has_passed(ride, one.vehicle, at)
    )
    return replace(held, found=left) if left else None


def suspects(
    ride: Ride, model: CausalModel, trace: PlanTrace, found: Restraining
) -> tuple[Cause, ...]:
    """Return the road users that were in the way as causes, most important first."""
    return tuple(
        _cause(ride, model, one, found.time)
        for vehicle in found.vehicles
        for one in [next(r for r in found.found if r.vehicle == vehicle and r.by in HOLDING)]
        if vehicle in trace.scene
    )


def _cause(ride: Ride, model: CausalModel, one: Restraint, time: float) -> Cause:
    vehicle = one.vehicle or 0
    speed = speed_at(ride, time, vehicle)
    actions: Actions = ()
    probability = 0.0
    if vehicle in model.vehicles:
        choices = model.choices(vehicle)
        likeliest = max(choices, key=lambda choice: choices[choice])
        actions, probability = expected_actions(model, vehicle, likeliest)
    mechanism = Mechanism(HOLDING[one.by], speed, speed, None, 1.0, present=True)
    return Cause(vehicle, actions, probability, mechanism)


def as_driven(ride: Ride, world: World, deed: Episode, at: float) -> Reasons | None:
    """Find why the ego drove as it did by what was in the way of driving faster.

    Each road user in the way is tested by planning without it; one that makes no difference is
    left out.

    Args:
        ride: the record.
        world: its facts.
        deed: the episode.
        at: [s] the moment of it that is asked about.

    Returns:
        None if the record does not have it, or nothing of it holds: decisions alone explain it.

    Raises:
        Unanswered: rollouts are needed.
    """
    held = restraining(ride, deed, at)
    if held is not None and (deed.end is None or deed.action in STATES):
        held = _still(ride, held, at)
    trace = None if held is None else _decision(ride, deed, held)
    if held is None or trace is None:
        return None
    tested = _tested(ride, world, deed, held, trace)
    parts = [_stated(ride, world, deed, one, tested, at) for one in held.found]
    if not any(parts) and all(one.by == "hidden" for one in held.found):  # it made no difference
        parts = [_stated(ride, world, deed, one, tested, at) for one in held.minor]
    others = tuple(tested.causes.values()) if tested.either else ()
    causation = tested.causation
    if deed.end is None or deed.action in STATES:
        others, causation = _in_force(ride, others, causation, at)
    causes = tuple(dict.fromkeys([cause for part in parts for cause in part] + list(others)))
    if not causes:
        return None
    return Reasons(causes, causation, tested.evidence, trace)


def _in_force(
    ride: Ride, others: tuple[MotionCause, ...], causation: Causation | None, at: float
) -> tuple[tuple[MotionCause, ...], Causation | None]:
    """Name whom leaving the lane would hit now instead of who was in the way of it before."""
    told = tuple(in_force(ride, one, at) for one in others)
    gone = {a.vehicle for a, b in zip(others, told, strict=True) if a.vehicle != b.vehicle}
    if causation is None or not gone:
        return told, causation
    left = tuple(vehicle for vehicle in causation.vehicles if vehicle not in gone)
    return told, structs.replace(causation, kind="one", vehicles=left)


def _decision(ride: Ride, deed: Episode, held: Restraining) -> PlanTrace | None:
    """Return the decision to test; of a state, one so old that it shows how we drove since.

    Plans may expect more of the ego than its driving makes of them.
    """
    known = ride.now - SHOWN
    if deed.action not in STATES or known >= held.time:
        return ride.at(held.time)
    since = next((r.begin for r in restraints(ride) if r.begin <= held.time < r.end), held.time)
    return ride.at(known if known >= since else held.time)


@dataclass(frozen=True, slots=True)
class _Tested:
    """The road users in the way, tested by planning without them."""

    causes: Mapping[int, MotionCause]
    causation: Causation | None
    evidence: Evidence

    @property
    def either(self) -> bool:
        """Whether others are as much a reason as those that were in the way."""
        return self.causation is not None and self.causation.kind in ("either", "both")


def _tested(
    ride: Ride, world: World, deed: Episode, held: Restraining, trace: PlanTrace
) -> _Tested:
    nothing = _Tested({}, None, Evidence(traces=(trace.trace_id,)))
    if not held.vehicles:
        return nothing
    model = ride.model(trace)
    found = suspects(ride, model, trace, held)
    try:
        plan = in_hindsight(ride, model, factual(model, trace))
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        told = [(one.vehicle, motion_cause(ride, world, one, trace, held.time)) for one in found]
        return _Tested(dict(told), None, nothing.evidence)
    waited = next((one.vehicle for one in held.found if one.by == "right-of-way"), None)
    tried = kept(proven(ride, model, found, plan), found, trace, waited, alone=True)
    causes = tuple(motion_cause(ride, world, one, trace, held.time) for one in tried.causes)
    if deed.end is None or deed.action in STATES:
        causes = with_speeds(ride, causes, held.time)
    else:
        causes = with_lowest(ride, causes, deed.begin - LEEWAY, deed.end)
    known = {cause.vehicle: cause for cause in causes if cause.vehicle is not None}
    return _Tested(known, tried.causation, evidence(ride, model, plan))


def _stated(
    ride: Ride, world: World, deed: Episode, one: Restraint, tested: _Tested, at: float
) -> tuple[MotionCause, ...]:
    """Return one restraint as reasons; none if planning without it shows that it is none."""
    lit = light_causes(ride, world, deed, at) if one.light is not None else None
    ahead = () if lit is None else tuple(c for c in lit[0] if c.kind == "light")
    trace = ride.at(at)
    if one.by in HOLDING:
        held = None if one.vehicle is None else tested.causes.get(one.vehicle)
        return ahead if held is None else (*ahead, held)
    if one.by == "light":
        return ahead
    if one.by == "stands-first":
        return (MotionCause("give-way-line", one.vehicle),)
    if one.by == "beside-crossing":
        return (MotionCause("hidden", one.vehicle, side="ahead"),)
    if one.by == "hidden":
        unseen = hidden_causes(ride, deed)
        return () if unseen is None else unseen[0]
    return () if trace is None else _of_road(ride, trace, deed, one.by)


def _of_road(
    ride: Ride, trace: PlanTrace, deed: Episode, by: RestraintKind
) -> tuple[MotionCause, ...]:
    """Return what the road demands: a turn or bend, the limit, or the end of the lane."""
    end = ride.now if deed.end is None else deed.end
    bends = [r for r in restraints(ride) if r.restraint.by == "bend" and r.begin <= end]
    if by == "bend" and bends and bends_first(ride, bends[-1].begin):
        return (MotionCause("bend"),)
    told = [cause for cause in road_causes(ride, trace, deed) if cause.kind in ON_ROAD[by]]
    turn = _turn(ride, deed) if by == "bend" else None
    if turn is not None and turn.kind == "given-up":
        return (turn,)
    named = [cause for cause in told if turn is None or cause.kind != "bend"]
    if named:
        return tuple(named)
    if by == "bend":
        return (turn or MotionCause("bend"),)
    limit = limit_at(ride, deed.begin)
    if by == "limit" and deed.action in STATES and limit is not None:
        return (MotionCause("limit", value=limit),)
    return (MotionCause("lane-end"),) if by == "road-end" else ()


def _turn(ride: Ride, deed: Episode) -> MotionCause | None:
    """Return the turn that was being driven when a bend first restrained the ego; None if none."""
    end = ride.now if deed.end is None else deed.end
    bends = [r for r in restraints(ride) if r.restraint.by == "bend"]
    first = next((r.begin for r in bends if r.begin <= end and r.end >= deed.begin), None)
    if first is None:
        return None
    under_way = (d for d in ride.begun if d.started <= first < (d.ended or math.inf))
    turning = next((d for d in under_way if d.action in TURNS), None)
    if turning is None:
        return None
    if turning.ended is not None and not turning.carried_out:
        return MotionCause("given-up", actions=(turning.action,))
    return MotionCause("turn")
