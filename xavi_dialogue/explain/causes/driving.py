"""Driving: why the ego slowed down, stood, waited or gave way: who held it up under its own plan.

Whose way was given, and who stood or drove in the way, is told by the rollouts of the decision
that was in force, and by the events; each vehicle is tried by planning without it. Where nobody
was in the way, the road tells: a turn, a line to give way at, the end of the trip.
"""

from dataclasses import dataclass

from msgspec.structs import replace

from planner.events import Event as RideEvent
from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.holdups import hold_ups
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.domain.answers import Cause, Evidence, Mechanism, MotionCause, NotRecorded
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.actions import CHANGES, EXITS
from xavi_dialogue.explain.causes.contrast import evidence, factual
from xavi_dialogue.explain.causes.involved import LIKELY, expected_actions, holding_up
from xavi_dialogue.explain.causes.necessity import Proven, proven
from xavi_dialogue.explain.causes.roadside import road_causes
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.ride import Ride, Unanswered

BEFORE = 3.0  # [s] by which way may be given before the ego stands or slows for it
SOON, FAR = 2.0, 5.0  # [s] after a decision within which it shows that one is slower for somebody
LEEWAY = 1.0  # [s] by which a hold-up may lie beside the change of speed that it explains
SLOWING = frozenset[ActionName](("slow-down", "brake"))
ROAD = frozenset(
    ("turn", "bend", "roundabout", "limit")
)  # what one slows for beside somebody in the way
SINCE: tuple[ActionName, ...] = (*EXITS, *CHANGES, "stop")


@dataclass(frozen=True, slots=True)
class Reasons:
    """Why the ego drove so in one episode."""

    causes: tuple[MotionCause, ...]
    cleared: tuple[int, ...]
    evidence: Evidence
    trace: PlanTrace


def reasons_for(ride: Ride, world: World, deed: Episode) -> Reasons:
    """Find why the ego drove as it did in an episode of braking, standing, waiting, or the like.

    Raises:
        Unanswered: the record lacks the decision; or rollouts are needed.
    """
    end = ride.now if deed.end is None else deed.end
    wait = _waited(ride, deed, end)
    trace = _decision(ride, deed, end, wait)
    model = ride.model(trace)
    try:
        plan = factual(model, trace)
    except Unanswered:
        road = road_causes(ride, trace, deed)
        return Reasons(road, (), Evidence(traces=(trace.trace_id,)), trace)
    braked = deed.action != "speed-up"  # what freed the way is not recorded
    window = (deed.begin - LEEWAY, end + LEEWAY)
    found = holding_up(model, plan, window) if braked else ()
    ranked = _first(model, found, None if wait is None else wait.vehicle)
    slow_at = min(max(end, trace.sim_time + SOON), trace.sim_time + FAR)
    tried = proven(ride, model, ranked, plan, at=slow_at)
    tried = _with_wait(tried, wait)
    causes = tuple(motion_cause(ride, world, cause, trace, deed.begin) for cause in tried.causes)
    rests_on = evidence(ride, model, plan)
    if not causes:
        causes = beside(road_causes(ride, trace, deed), tried.cleared)
    elif deed.action in SLOWING:
        road = road_causes(ride, trace, deed)
        causes = (*causes, *(cause for cause in road if cause.kind in ROAD))
    return Reasons(causes, tried.cleared, rests_on, trace)


def beside(found: tuple[MotionCause, ...], cleared: tuple[int, ...]) -> tuple[MotionCause, ...]:
    """Leave out that the plan calls for it where somebody is in the way who makes no difference.

    Without the one another would be in the way, so that none is known to be the reason.
    """
    return () if cleared and all(cause.kind == "plan" for cause in found) else found


def motion_cause(
    ride: Ride, world: World, cause: Cause, trace: PlanTrace, time: float
) -> MotionCause:
    """Tell a vehicle that held us up as a reason for how we drove."""
    how = cause.mechanism.how if cause.mechanism is not None else "leader"
    if how in ("leader", "cut-in") and _goes_first(trace, cause.vehicle):
        how = "right-of-way"  # it will be ahead of us only once we have let it go first
    since = world.episodes(Vehicle(cause.vehicle), SINCE, trace.sim_time, ride.now)
    since = tuple(e for e in since if e.begin >= trace.sim_time)
    speeds = ride.motion(cause.vehicle).until(time).speed
    return MotionCause(
        kind="blocked" if how == "collision" else how,
        vehicle=cause.vehicle,
        actions=cause.actions,
        probability=cause.probability,
        speed=speeds[-1] if speeds else None,
        did=since[0] if since else None,
        necessary=cause.necessary,
    )


def _goes_first(trace: PlanTrace, vehicle: int) -> bool:
    """Whether a vehicle whose way crosses ours has right of way."""
    facts = () if trace.road is None else trace.road.priority
    return any(fact.vehicle == vehicle and fact.who == "vehicle" for fact in facts)


def _waited(ride: Ride, deed: Episode, end: float) -> RideEvent | None:
    """The giving way within an episode, or shortly before it."""
    if deed.action == "speed-up":
        return None
    waits = [event for event in ride.events if event.kind == "gave-way"]
    near = [e for e in waits if deed.begin - BEFORE <= e.sim_time <= end]
    if isinstance(deed.object, Vehicle):
        near = [e for e in near if e.vehicle == deed.object.number] or near
    return near[-1] if near else None


def _decision(ride: Ride, deed: Episode, end: float, wait: RideEvent | None) -> PlanTrace:
    """The decision under which it happened.

    That is the last one before way was given; else, of those taken meanwhile, the one whose plan
    is held up most, or the last one before the middle of what was seen.
    """
    middle = (deed.begin + end) / 2.0
    trace = ride.at(middle if wait is None else wait.sim_time) or next(iter(ride.traces), None)
    if trace is None:
        raise Unanswered(NotRecorded("gap-in-record", since=deed.begin))
    if wait is not None or deed.action == "speed-up":
        return trace
    window = (deed.begin - LEEWAY, end + LEEWAY)
    meanwhile = [t for t in ride.traces if deed.begin - LEEWAY <= t.sim_time <= end]
    return max((trace, *meanwhile), key=lambda t: _held(ride, t, window))


def _held(ride: Ride, trace: PlanTrace, window: tuple[float, float]) -> float:
    """How long [s] the plan of a decision is held up by somebody, at the most."""
    try:
        plan = factual(ride.model(trace), trace)
    except Unanswered:
        return 0.0
    found = hold_ups(plan, window).values()
    return max((held.expected for held in found if held.share >= LIKELY), default=0.0)


def _first(
    model: CausalModel, causes: tuple[Cause, ...], waited_for: int | None
) -> tuple[Cause, ...]:
    """The vehicle that was given way to goes first."""
    if waited_for is None:
        return causes
    mechanism = Mechanism("right-of-way", None, None, None, 1.0)  # as the events tell
    known = [
        c if c.mechanism and c.mechanism.how == "right-of-way" else replace(c, mechanism=mechanism)
        for c in causes
        if c.vehicle == waited_for
    ]
    if not known and waited_for in model.vehicles:
        choices = model.choices(waited_for)
        likeliest = max(choices, key=lambda choice: choices[choice])
        actions, probability = expected_actions(model, waited_for, likeliest)
        known = [Cause(waited_for, actions, probability, mechanism)]
    return (*known, *(cause for cause in causes if cause.vehicle != waited_for))


def _with_wait(tried: Proven, wait: RideEvent | None) -> Proven:
    """The vehicle that was given way to leads, unless it made no difference."""
    if wait is None:
        return tried
    ranked = sorted(tried.causes, key=lambda cause: cause.vehicle != wait.vehicle)
    return Proven(tuple(ranked), tried.cleared)


def ego_speed(ride: Ride, time: float) -> float | None:
    """Tell how fast the ego was at a time [m/s]."""
    speeds = ride.motion(EGO).until(time).speed
    return speeds[-1] if speeds else None
