"""Driving: why the ego slowed down, stood, waited or gave way, and who held it up.

The rollouts of the decision that was in force, and the events, show to whom the ego gave way and
who stood or drove in its way. Each of these vehicles is tested by planning without it. If nobody
was in the way, the road gives the reason: a turn, a line to give way at, the end of the trip.
"""

import math
from collections.abc import Collection

from msgspec.structs import replace

from planner.record.events import Event as RideEvent
from planner.record.trace import PlanTrace
from xavi_dialogue.causal.holdups import hold_ups
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.domain.answers import Cause, Evidence, Mechanism, MotionCause, NotRecorded
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.driving.hidden_areas import hidden_causes
from xavi_dialogue.explain.causes.driving.ready import given_up, next_move, ready_for
from xavi_dialogue.explain.causes.driving.restrained import as_driven
from xavi_dialogue.explain.causes.driving.roadside import road_causes
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons, as_of, motion_cause
from xavi_dialogue.explain.causes.driving.traffic_lights import light_causes
from xavi_dialogue.explain.causes.driving.yielding import close_leader, goes_first, kept, leads
from xavi_dialogue.explain.causes.plans.contrast import evidence, factual
from xavi_dialogue.explain.causes.vehicles.hindsight import in_hindsight
from xavi_dialogue.explain.causes.vehicles.involved import LIKELY, expected_actions, holding_up
from xavi_dialogue.explain.causes.vehicles.necessity import proven
from xavi_dialogue.explain.facts.episodes.light_waits import held_then
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.nearing import speed_at, with_lowest
from xavi_dialogue.explain.history.ride import Ride, Unanswered

BEFORE = 3.0  # [s] by which giving way may precede the standing or slowing that it explains
JUST_OVER = 1.0  # [s] after its end for which an episode counts as still going on
MUCH = 0.8  # share of the longest hold-up; the last decision that reaches it is taken
AHEAD = 0.5  # [s] by which a decision may come before the braking that it explains
LEEWAY = 1.0  # [s] by which a hold-up may precede or follow the change of speed that it explains
STOPPING = 0.5  # [s] by which braking may go on after a stop was given up
LATELY = 2.5  # [s] after which a stop that was given up is no longer what is asked about
SLOWING = frozenset[ActionName](("slow-down", "brake"))
ROAD = frozenset(
    ("turn", "bend", "roundabout", "limit")
)  # kinds of reasons that explain slowing even if somebody is in the way


def reasons_for(ride: Ride, world: World, deed: Episode, at: float | None = None) -> Reasons:
    """Find why the ego drove as it did in an episode of braking, standing, waiting, or the like.

    Args:
        ride: the record.
        world: its facts.
        deed: the episode.
        at: [s] the moment of it that is asked about; None: its middle.

    Raises:
        Unanswered: the record lacks the decision; or rollouts are needed.
    """
    end = ride.now if deed.end is None else deed.end
    moment = (deed.begin + end) / 2.0 if at is None else min(max(at, deed.begin), end)
    driven = as_driven(ride, world, deed, moment)
    return _as_planned(ride, world, deed, moment) if driven is None else driven


def _as_planned(ride: Ride, world: World, deed: Episode, moment: float) -> Reasons:
    """Find why the ego drove so by decisions alone.

    Raises:
        Unanswered: the record lacks the decision; or rollouts are needed.
    """
    end = ride.now if deed.end is None else deed.end
    wait = _waited(ride, world, deed, end)
    lit = light_causes(ride, world, deed, moment) if wait is None else None
    if lit is not None:
        return Reasons(lit[0], None, Evidence(traces=(lit[1].trace_id,)), lit[1])
    trace = _decision(ride, deed, end, wait, moment)
    model = ride.model(trace)
    try:
        plan = factual(model, trace)
    except Unanswered:
        road = road_causes(ride, trace, deed)
        return Reasons(road, None, Evidence(traces=(trace.trace_id,)), trace)
    braked = deed.action != "speed-up"  # what cleared the way is not recorded
    window = (deed.begin - LEEWAY, end + LEEWAY)
    plan = in_hindsight(ride, model, plan)
    found = holding_up(model, plan, window) if braked else ()
    waited = None if wait is None else wait.vehicle
    ranked = _first(model, found, waited)
    road = road_causes(ride, trace, deed)
    free = all(cause.kind == "plan" for cause in road)
    tried = kept(proven(ride, model, ranked, plan), ranked, trace, waited, alone=free)
    causes = tuple(motion_cause(ride, world, cause, trace, deed.begin) for cause in tried.causes)
    over = deed.end is not None and ride.now - deed.end > JUST_OVER
    causes = as_of(ride, causes, deed.begin if over else ride.now)
    if deed.end is not None:
        causes = with_lowest(ride, causes, deed.begin - LEEWAY, deed.end)
    rests_on = evidence(ride, model, plan)
    if not causes:
        causes = beside(of_road(ride, world, trace, deed, plan, tried.cleared), tried.cleared)
        lead = None
        if braked and any(c.kind == "give-way-line" and not c.vehicle for c in causes[:1]):
            lead = close_leader(world, model, plan, deed.begin, speed_at(ride, deed.begin))
        if lead is not None:
            causes = (motion_cause(ride, world, lead, trace, deed.begin), *causes)
        unseen = hidden_causes(ride, deed)
        if unseen is not None:
            return Reasons(unseen[0], None, Evidence(traces=(unseen[1].trace_id,)), unseen[1])
    elif deed.action in SLOWING:
        causes = (*causes, *(cause for cause in road if cause.kind in ROAD))
    return Reasons(causes, tried.causation, rests_on, trace)


def of_road(
    ride: Ride,
    world: World,
    trace: PlanTrace,
    deed: Episode,
    plan: Intervention,
    cleared: Collection[int],
) -> tuple[MotionCause, ...]:
    """Return what on the road explains an episode, and to whom the ego must be ready to give way.

    A waiting line that is already reached, with nobody to give way to, comes last: what lies
    beyond it is the reason. Vehicles that make no difference are not mentioned.
    """
    found = [_to_whom(trace, plan, one, cleared) for one in road_causes(ride, trace, deed)]
    if all(one.kind == "plan" for one in found):
        first = None
        if deed.action != "speed-up":
            first = ready_for(ride, world, deed, cleared)
            first = first or next_move(ride, trace, deed) or given_up(ride, deed)
        found = found if first is None else [first]
    line = [one.kind == "give-way-line" and not (one.vehicle or one.value) for one in found]
    return tuple(one for _, one in sorted(zip(line, found, strict=True), key=lambda pair: pair[0]))


def _to_whom(
    trace: PlanTrace, plan: Intervention, cause: MotionCause, cleared: Collection[int]
) -> MotionCause:
    """Add to a give-way line the vehicle that the ego may have to give way to, if one is known."""
    if cause.kind != "give-way-line":
        return cause
    shares = {
        v: h.share for v, h in hold_ups(plan).items() if v not in cleared and goes_first(trace, v)
    }
    facts = () if trace.road is None else trace.road.priority
    known = [f.vehicle for f in facts if f.who == "vehicle" and f.vehicle not in cleared]
    alone = known[0] if len(known) == 1 else None
    first = max(shares, key=lambda v: shares[v], default=alone)
    return cause if first is None else replace(cause, vehicle=first)


def beside(found: tuple[MotionCause, ...], cleared: tuple[int, ...]) -> tuple[MotionCause, ...]:
    """Drop "the plan calls for it" as the only reason if vehicles in the way make no difference.

    Without one of them, another would be in the way, so none is known to be the reason.
    """
    return () if cleared and all(cause.kind == "plan" for cause in found) else found


def _waited(ride: Ride, world: World, deed: Episode, end: float) -> RideEvent | None:
    """Return the event of giving way within an episode, or shortly before it."""
    if deed.action == "speed-up":
        return None
    waits = [event for event in ride.events if event.kind == "gave-way"]
    waits = [event for event in waits if not held_then(ride, event.sim_time)]
    near = [e for e in waits if deed.begin - BEFORE <= e.sim_time <= end]
    near = [e for e in near if e.sim_time >= deed.begin or not leads(world, e.vehicle, deed.begin)]
    if isinstance(deed.object, Vehicle):
        near = [e for e in near if e.vehicle == deed.object.number] or near
    return near[-1] if near else None


def _decision(
    ride: Ride, deed: Episode, end: float, wait: RideEvent | None, at: float
) -> PlanTrace:
    """Return the decision that explains an episode.

    A decision to stop that explains it comes first. Otherwise it is, of those around the episode,
    the latest whose plan is held up nearly the longest; if there are none, the last one before the
    ego gave way, or before the middle of the episode.
    """
    halt = _stop_of(ride, deed, end, at)
    if halt is not None:
        return halt
    middle = (deed.begin + end) / 2.0
    trace = ride.at(middle if wait is None else wait.sim_time) or next(iter(ride.traces), None)
    if trace is None:
        raise Unanswered(NotRecorded("gap-in-record", since=deed.begin))
    if deed.action == "speed-up":
        return trace
    braked = wait is not None or deed.action == "stop"
    begin = deed.begin - (BEFORE if braked else AHEAD)
    window = (begin + AHEAD - LEEWAY, end + LEEWAY)
    meanwhile = [t for t in ride.traces if begin <= t.sim_time <= end]
    if wait is not None and wait.vehicle is not None:
        meanwhile = [t for t in meanwhile if wait.vehicle in t.scene]
    held = {t.trace_id: _held(ride, t, window) for t in meanwhile}
    most = max(held.values(), default=0.0)
    return next((t for t in reversed(meanwhile) if held[t.trace_id] >= MUCH * most), trace)


def _stop_of(ride: Ride, deed: Episode, end: float, at: float) -> PlanTrace | None:
    """Find the decision to stop that made the ego brake, or stand, at a time [s]."""
    if deed.action not in (*SLOWING, "stop", "stand"):
        return None
    known = [d for d in ride.begun if d.action == "stop"]
    until = {d.started: math.inf if d.ended is None else d.ended for d in known}
    meant = [d for d in known if d.started <= end and until[d.started] >= deed.begin - STOPPING]
    last = [d for d in meant if d.started <= at + LEEWAY and until[d.started] >= at - LATELY]
    return ride.choice_of(last[-1]) if last else None


def _held(ride: Ride, trace: PlanTrace, window: tuple[float, float]) -> float:
    """Return how long [s] others hold up the plan of a decision: the sum over probable ones."""
    try:
        model = ride.model(trace)
        plan = in_hindsight(ride, model, factual(model, trace))
    except Unanswered:
        return 0.0
    found = hold_ups(plan, window).values()
    return sum(held.expected for held in found if held.share >= LIKELY)


def _first(
    model: CausalModel, causes: tuple[Cause, ...], waited_for: int | None
) -> tuple[Cause, ...]:
    """Return the causes, headed by the vehicle that the ego gave way to."""
    if waited_for is None:
        return causes
    mechanism = Mechanism("right-of-way", None, None, None, 1.0)  # as the events show
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
