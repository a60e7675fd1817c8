"""Traffic lights as causes: one holds us, as the rollouts of a decision show.

Whether it matters is tested by planning that decision again with the light green for good. It
matters if this saves time. Who stands before us in the queue is stated as well.
"""

from collections.abc import Iterable

from planner.record.light_record import LightSupposed
from planner.record.trace import PlanTrace
from sim.scene import EGO, LightState, Signal
from xavi_dialogue.domain.answers import MotionCause, NeedRollout
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Feature, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.plans.replanned import gets_further, replanned, saves_time
from xavi_dialogue.explain.facts.episodes.light_waits import Hold, holding
from xavi_dialogue.explain.facts.episodes.waiting import top_holders
from xavi_dialogue.explain.facts.traffic_lights import told
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.nearing import with_speeds
from xavi_dialogue.explain.history.ride import ROUNDING, Ride
from xavi_dialogue.explain.history.traffic_lights import ahead, shown

HELD = frozenset[ActionName](("slow-down", "brake", "stop", "stand", "wait", "move", "follow"))
STILL = frozenset[ActionName](("stop", "stand", "wait"))
GREEN = LightState.GREEN.value


def light_causes(
    ride: Ride, world: World, deed: Episode, at: float
) -> tuple[tuple[MotionCause, ...], PlanTrace] | None:
    """Find the traffic light for which the ego slowed down or stood, and the decision.

    Args:
        ride: the record.
        world: its facts.
        deed: the slowing or standing.
        at: [s] the moment of it that is asked about.

    Returns:
        The light and who stands before us at it; the latter alone once the light lets us go. None
        if no light holds us, or it does not matter.

    Raises:
        Unanswered: the decision must be planned again first.
    """
    end = ride.now if deed.end is None else deed.end
    yielded = deed.action == "give-way" and isinstance(deed.object, Vehicle)
    hold = None if yielded or deed.action not in HELD else holding(ride, EGO, deed.begin, end)
    if hold is not None and deed.end is None and not hold.goes_on and at > hold.end + ROUNDING:
        last = ride.at(at)  # it lets us go by now, but a vehicle before us still holds us
        queue = () if last is None else tuple(_queue(world, last))
        if last is not None and queue:
            return with_speeds(ride, queue, at), last
    trace = None if hold is None else _decision(ride, hold, deed, at)
    if hold is None or trace is None:
        return None
    needed = matters(ride, trace, hold.signal)
    if needed is False:
        return None
    until = ride.now if hold.goes_on else hold.end
    time = min(max(at, hold.begin), until) if deed.action in STILL else trace.sim_time
    if deed.end is None and hold.goes_on:
        time = ride.now  # what goes on is stated as of now
    one = shown(ride, hold.signal, time) or shown(ride, hold.signal, trace.sim_time)
    if one is None:
        return None
    far = [x.distance for x in ahead(ride, time) if _signal(x) == hold.signal]
    seen = told(ride, hold.signal, one, Feature("light"))
    cause = MotionCause("light", necessary=needed, value=next(iter(far), None), shown=seen)
    return (cause, *_queue(world, trace)), trace


def _signal(light: object) -> Signal:
    return Signal(light.controller, light.place)  # type: ignore[attr-defined]


def _decision(ride: Ride, hold: Hold, deed: Episode, at: float) -> PlanTrace | None:
    """Return a decision at which a light held us: for standing, the last one, else the first.

    Those that had a choice are preferred.
    """
    known = [
        t
        for t in ride.traces
        if hold.begin - ROUNDING <= t.sim_time <= hold.end + ROUNDING
        and t.sim_time >= deed.begin - 1.0
    ]
    if deed.action in STILL:
        known = [t for t in known if t.sim_time <= at + ROUNDING][::-1] or known
    return next((t for t in known if t.under_way is None), next(iter(known), None))


def matters(ride: Ride, trace: PlanTrace, signal: Signal) -> bool | None:
    """Check whether a decision would save time if a light were green; None if that is not known.

    It also counts if the ego gets further until a light beyond holds it.

    Raises:
        Unanswered: the decision must be planned again first.
    """
    again = with_light(ride, trace, signal, GREEN)
    saves = saves_time(ride, trace, again)
    if again is None or saves is not False:
        return saves
    return gets_further(ride, trace, again)


def with_light(ride: Ride, trace: PlanTrace, signal: Signal, state: str) -> PlanTrace | None:
    """Find the plan made again from a decision with a light that shows a state for good.

    A green light lets us through its junction, so the later ones on our way there are green, too.
    None if the planner could not make it.

    Raises:
        Unanswered: it must be made first.
    """
    places = [signal.index]
    if state == GREEN and trace.road is not None:
        way = [x.place for x in trace.road.lights if x.controller == signal.controller]
        places += way[way.index(signal.index) + 1 :] if signal.index in way else []
    supposed = tuple(LightSupposed(signal.controller, place, state) for place in places)
    need = NeedRollout(trace_id=trace.trace_id, lights=supposed)
    return replanned(ride, trace, need)


def _queue(world: World, trace: PlanTrace) -> Iterable[MotionCause]:
    """Yield who stands right before us at the light."""
    for vehicle, how in top_holders(world.states, trace, EGO)[:1]:
        if how == "leader":
            yield MotionCause("leader", vehicle, speed=trace.scene[vehicle].speed)


def light_of_other(ride: Ride, vehicle: int, begin: float, end: float) -> MotionCause | None:
    """Find the traffic light for which another vehicle slowed or stood, as predicted."""
    hold = holding(ride, vehicle, begin, end)
    one = None if hold is None else shown(ride, hold.signal, min(max(begin, hold.begin), end))
    if hold is None or one is None:
        return None
    seen = told(ride, hold.signal, one, Feature("light", of=Vehicle(vehicle)))
    return MotionCause("light", probability=hold.share, shown=seen)
