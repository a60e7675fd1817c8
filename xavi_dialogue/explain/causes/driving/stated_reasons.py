"""Stated reasons: the reasons for how the ego drives, and vehicles in the way as such."""

from dataclasses import dataclass

from msgspec.structs import replace

from planner.record.trace import PlanTrace
from xavi_dialogue.domain.answers import Cause, Evidence, MotionCause
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.driving.passed import has_passed
from xavi_dialogue.explain.causes.driving.yielding import goes_first, leads
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES, EXITS
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.nearing import speed_at, with_speeds
from xavi_dialogue.explain.history.ride import Ride

FASTER = 2.0  # [m/s] by which a leader may be faster and still be in the way
BARRED = 0.5  # probability of a collision from which an action is out of the question
SINCE: tuple[ActionName, ...] = (*EXITS, *CHANGES, "stop")


@dataclass(frozen=True, slots=True)
class Reasons:
    """Why the ego drove as it did in one episode."""

    causes: tuple[MotionCause, ...]
    causation: Causation | None  # None: nobody was suspected
    evidence: Evidence
    trace: PlanTrace

    @property
    def cleared(self) -> tuple[int, ...]:
        """The vehicles that make no difference."""
        return () if self.causation is None else self.causation.cleared

    @property
    def counted(self) -> tuple[int, ...]:
        """The vehicles that the ego's driving depends on."""
        return () if self.causation is None else self.causation.vehicles


def motion_cause(
    ride: Ride, world: World, cause: Cause, trace: PlanTrace, time: float
) -> MotionCause:
    """Turn a vehicle that held us up into a reason for how we drove."""
    how = cause.mechanism.how if cause.mechanism is not None else "leader"
    joins = how in ("leader", "cut-in") and goes_first(trace, cause.vehicle)
    if joins and not leads(world, cause.vehicle, time):
        how = "right-of-way"  # it will be ahead of us only once we have let it go first
    elif how == "leader" and set(cause.actions[:1]) & set(CHANGES):
        how = how if leads(world, cause.vehicle, time) else "cut-in"  # only once it has moved over
    since = world.episodes(Vehicle(cause.vehicle), SINCE, trace.sim_time, ride.now)
    since = tuple(e for e in since if e.begin >= trace.sim_time)
    return MotionCause(
        kind="no-room" if how == "collision" else how,
        vehicle=cause.vehicle,
        actions=cause.actions,
        probability=cause.probability,
        did=since[0] if since else None,
        necessary=cause.necessary,
    )


def as_of(ride: Ride, causes: tuple[MotionCause, ...], time: float) -> tuple[MotionCause, ...]:
    """Add the speeds at a time [s] to causes, and drop who was out of our way then.

    These are leaders that were drawing away, and those who had been let go first and had passed.
    """
    ours, found = speed_at(ride, time), []
    for told in with_speeds(ride, causes, time):
        if told.kind == "right-of-way" and has_passed(ride, told.vehicle, time):
            continue
        theirs = told.speed if told.kind == "leader" else None
        if theirs is None or ours is None or theirs <= ours + FASTER:
            found.append(told)
    return tuple(found)


def in_force(ride: Ride, cause: MotionCause, time: float) -> MotionCause:
    """Name whom a change of lanes would hit at a time [s], if that is another than before."""
    trace = ride.at(time)
    if cause.kind != "no-room" or trace is None:
        return cause
    model = ride.model(trace)
    plans = (model.intervene((action,)) for action in CHANGES if action in model.options())
    struck = [found for plan in plans if plan is not None for found in (plan.collisions(),)]
    if any(cause.vehicle in found for found in struck):
        return cause
    worst = max((item for found in struck for item in found.items()),
                key=lambda item: item[1], default=None)  # fmt: skip
    if worst is None or worst[1] < BARRED:
        return cause
    return replace(cause, vehicle=worst[0], actions=(), probability=None, did=None, necessary=None)
