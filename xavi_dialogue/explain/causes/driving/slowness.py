"""Slowness: why the ego drives slowly or stays behind another, not why it slowed down.

Driving slowly is judged against the limit. A vehicle that drives in front of us within some seconds
is the reason if it is no faster than we are and planning without it is faster.
"""

from collections.abc import Collection
from dataclasses import dataclass, replace

from msgspec.structs import replace as changed

from planner.record.trace import PlanTrace
from sim.scene import EGO, Signal
from xavi_dialogue.causal.model import Actions
from xavi_dialogue.domain.answers import Cause, Evidence, Mechanism, MotionCause, NotRecorded
from xavi_dialogue.domain.facts import Episode, Look
from xavi_dialogue.domain.terms import Ego, Feature, Vehicle
from xavi_dialogue.explain.causes.driving.driving import beside, of_road
from xavi_dialogue.explain.causes.driving.restrained import as_driven
from xavi_dialogue.explain.causes.driving.roadside import limit_at, road_causes, setting_off
from xavi_dialogue.explain.causes.driving.stated_reasons import (
    FASTER,
    Reasons,
    as_of,
    motion_cause,
)
from xavi_dialogue.explain.causes.driving.traffic_lights import light_causes
from xavi_dialogue.explain.causes.driving.yielding import kept
from xavi_dialogue.explain.causes.plans.contrast import evidence, factual
from xavi_dialogue.explain.causes.vehicles.involved import expected_actions, holding_up
from xavi_dialogue.explain.causes.vehicles.necessity import proven
from xavi_dialogue.explain.facts.traffic_lights import told
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.nearing import speed_at
from xavi_dialogue.explain.history.restraints import restraint_at
from xavi_dialogue.explain.history.ride import Ride, Unanswered
from xavi_dialogue.explain.history.traffic_lights import ahead, shown

SLOW = 0.85  # share of the limit below which driving is slow
AT_LIMIT = 0.93  # share of the limit from which the ego drives at it
HEADWAY = 5.0  # [s] within which somebody in front sets the pace
NEAR = 12.0  # [m] minimum of that distance, however slow we are
ASIDE = 2.0  # [m] maximum offset sideways of somebody in front of us
LIGHT_NEAR = 80.0  # [m] maximum distance of a red light for which those ahead brake
BRAKED = 10.0  # [m/s] maximum speed of a driver who has begun to
AROUND = 3.0  # [s] of the plan that count as now


@dataclass(frozen=True, slots=True)
class Slowness:
    """How the ego drove at a time, and why."""

    deed: Episode
    reasons: Reasons
    limit: float | None  # [m/s]
    is_slow: bool | None  # None: the limit is not known


def slowness(ride: Ride, world: World, time: float) -> Slowness:
    """Find why the ego drove no faster at a time [s].

    Raises:
        Unanswered: the record lacks it; or rollouts are needed.
    """
    trace = ride.at(time) or next(iter(ride.traces), None)
    speed = speed_at(ride, time)
    if trace is None or speed is None:
        raise Unanswered(NotRecorded("before-record", since=time))
    limit = limit_at(ride, time)
    ahead = leader(ride, world, time)
    deed = Episode(
        Ego(),
        "follow" if ahead is not None else "move",
        begin=time,
        end=None if time >= ride.now - 0.5 else time,
        object=None if ahead is None else Vehicle(ahead.vehicle),
        speed_from=speed,
        speed_to=speed,
    )
    is_slow = None if limit is None else speed < SLOW * limit
    behind = ahead is not None and limit is not None and ahead.speed <= limit - FASTER
    if limit is not None and speed >= AT_LIMIT * limit and not behind:
        reasons = Reasons((MotionCause("limit", value=limit),), None, _recorded(trace), trace)
        return Slowness(deed, reasons, limit, is_slow=False)
    reasons = _reasons(ride, world, trace, deed, ahead)
    if behind and is_slow is False and not any(c.vehicle for c in reasons.causes):
        reasons = replace(reasons, causes=(MotionCause("limit", value=limit),))
    if ahead is not None and behind and not reasons.causes and _restrains(ride, ahead, time):
        reasons = replace(reasons, causes=(_plain(ahead),), causation=None)
    return Slowness(deed, reasons, limit, is_slow)


def _restrains(ride: Ride, ahead: Look, time: float) -> bool:
    """Check whether somebody ahead is recorded as what keeps us from driving faster."""
    found = restraint_at(ride, time)
    return found is not None and (found.by, found.vehicle) == ("leader", ahead.vehicle)


def leader(ride: Ride, world: World, time: float) -> Look | None:
    """Find the nearest vehicle in front of the ego at a time [s], within seconds of driving."""
    reach = max(NEAR, HEADWAY * (speed_at(ride, time) or 0.0))
    return next(iter(in_lane_ahead(ride, world, time, reach)), None)


def with_nearest(
    ride: Ride, world: World, reasons: Reasons, time: float
) -> tuple[MotionCause, ...]:
    """Add to a leader that is the reason who drives between it and us, and the light before both.

    Passengers see the nearer vehicle first. If the reason is the nearest vehicle itself, and the
    one right before it counts as well, the latter holds up both, and becomes the reason. A driver
    who comes to a red light brakes for it.

    Args:
        ride: the record.
        world: its facts.
        reasons: as found.
        time: [s] the moment.
    """
    causes = [_farther(ride, world, cause, time, reasons.counted) for cause in reasons.causes]
    named = {cause.vehicle for cause in causes}
    found = []
    for cause in causes:
        seen = None if cause.vehicle is None else world.look(cause.vehicle, time)
        leads = cause.kind == "blocked" and seen is not None and _in_front(seen, NEAR + NEAR)
        if seen is not None and (cause.kind == "leader" or leads):
            near = leader(ride, world, time)
            between = near is not None and near.distance < seen.distance
            if between and near is not None and near.vehicle not in named:
                found.append(changed(cause, kind="leader", between=near.vehicle))
                continue
        found.append(cause)
    if any(cause.kind == "light" for cause in found):
        return tuple(found)
    return tuple(_before_red(ride, world, cause, time) for cause in found)


def _before_red(ride: Ride, world: World, cause: MotionCause, time: float) -> MotionCause:
    """Add to somebody who holds us up the next light on our way, if it is red beyond both."""
    leads = cause.kind in ("leader", "blocked") and cause.vehicle is not None
    look = world.look(cause.vehicle, time) if leads and cause.vehicle is not None else None
    near = next(iter(ahead(ride, time)), None)
    if look is None or near is None or look.speed > BRAKED:
        return cause
    if not look.ahead < near.distance <= LIGHT_NEAR:
        return cause
    signal = Signal(near.controller, near.place)
    one = shown(ride, signal, time)
    seen = None if one is None else told(ride, signal, one, Feature("light"))
    return cause if seen is None or seen.colour != "red" else changed(cause, shown=seen)


def _farther(
    ride: Ride, world: World, cause: MotionCause, time: float, counted: Collection[int]
) -> MotionCause:
    """Replace the nearest leader by the one before it, if that counts too and is not faster."""
    reach = max(NEAR, HEADWAY * (speed_at(ride, time) or 0.0))
    ahead = in_lane_ahead(ride, world, time, reach)[:2]
    if cause.kind != "leader" or len(ahead) < 2 or cause.vehicle != ahead[0].vehicle:
        return cause
    near, far = ahead
    if far.vehicle not in counted or far.speed > near.speed + FASTER:
        return cause
    return MotionCause("leader", far.vehicle, speed=far.speed)


def in_lane_ahead(
    ride: Ride, world: World, time: float, reach: float, at: float | None = None
) -> list[Look]:
    """List the vehicles in front of the ego at a time within a distance [m], the nearest first.

    Args:
        ride: the record.
        world: its facts.
        time: [s] the moment.
        reach: [m] how far.
        at: [s] the moment of which our lane counts; None: the same moment.
    """
    lane_at = time if at is None else at
    looks = [look for v in world.in_view(time) if (look := world.look(v, time)) is not None]
    if at is not None and at < time:
        ahead = [look for look in looks if _was_lane(ride, look, lane_at, time, reach)]
    else:
        ahead = [look for look in looks if _in_front(look, reach) and _same_lane(ride, look, time)]
    return sorted(ahead, key=lambda look: look.distance)


def _was_lane(ride: Ride, look: Look, before: float, time: float, reach: float) -> bool:
    """Check whether a vehicle is ahead in the lane that was ours before, by the recorded road."""
    first, then = ride.at(before), ride.at(time)
    ours = None if first is None or first.road is None else first.road.places.get(EGO)
    theirs = None if then is None or then.road is None else then.road.places.get(look.vehicle)
    if ours is None or theirs is None or look.oncoming:
        return False
    on_it = ours.edge == theirs.edge and ours.lane == theirs.lane
    return on_it and look.ahead > 0.0 and look.distance <= reach


def _in_front(look: Look, reach: float) -> bool:
    straight = look.ahead > 0.0 and abs(look.left) <= max(ASIDE, 0.08 * look.ahead)
    return look.in_view and not look.oncoming and straight and look.distance <= reach


def _same_lane(ride: Ride, look: Look, time: float) -> bool:
    """Check whether a vehicle is on our lane, as far as the road is recorded."""
    trace = ride.at(time)
    if trace is None or trace.road is None:
        return abs(look.left) <= ASIDE
    ours, theirs = trace.road.places.get(EGO), trace.road.places.get(look.vehicle)
    if ours is None or theirs is None or ours.edge != theirs.edge:
        return True
    return ours.lane is None or theirs.lane is None or ours.lane == theirs.lane


def _reasons(
    ride: Ride, world: World, trace: PlanTrace, deed: Episode, ahead: Look | None
) -> Reasons:
    driven = as_driven(ride, world, deed, deed.begin)
    if driven is not None:
        return driven
    lit = light_causes(ride, world, deed, deed.begin)
    if lit is not None:
        return Reasons(lit[0], None, _recorded(lit[1]), lit[1])
    model = ride.model(trace)
    try:
        plan = factual(model, trace)
    except Unanswered:
        own = () if ahead is None else (_plain(ahead),)
        return Reasons(own or road_causes(ride, trace, deed), None, _recorded(trace), trace)
    window = (deed.begin - 1.0, deed.begin + AROUND)
    found = list(holding_up(model, plan, window))
    paced = ahead is not None and ahead.speed <= (deed.speed_to or 0.0) + FASTER
    if ahead is not None and paced and ahead.vehicle not in [c.vehicle for c in found]:
        found.append(_as_leader(ride, trace, ahead))
    tried = kept(proven(ride, model, found, plan), found, trace)
    held = tuple(motion_cause(ride, world, c, trace, deed.begin) for c in tried.causes)
    causes = list(as_of(ride, held, deed.begin))
    if setting_off(ride, deed.begin):
        causes.append(MotionCause("starting"))
    if not causes:
        road = of_road(ride, world, trace, deed, plan, tried.cleared)
        causes = list(beside(road, tried.cleared))
    return Reasons(tuple(causes), tried.causation, evidence(ride, model, plan), trace)


def _as_leader(ride: Ride, trace: PlanTrace, ahead: Look) -> Cause:
    model = ride.model(trace)
    actions: Actions = ()
    probability = 0.0
    if ahead.vehicle in model.vehicles:
        choices = model.choices(ahead.vehicle)
        likeliest = max(choices, key=lambda choice: choices[choice])
        actions, probability = expected_actions(model, ahead.vehicle, likeliest)
    mechanism = Mechanism("leader", ahead.speed, ahead.speed, None, 1.0, present=True)
    return Cause(ahead.vehicle, actions, probability, mechanism)


def _plain(ahead: Look) -> MotionCause:
    return MotionCause("leader", vehicle=ahead.vehicle, speed=ahead.speed)


def _recorded(trace: PlanTrace) -> Evidence:
    return Evidence(traces=(trace.trace_id,))
