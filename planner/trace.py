"""PlanTrace: the record of one decision, and the planner's only product.

Everything that explanations rest on stands here: what was seen, what was predicted, every
rollout of the search, and the plan that followed. SI units, radians anticlockwise from east,
seconds of simulation time. An absent component is null, never NaN. The trace holds no wall
time; `trace_id` is the hash of its canonical JSON, so equal decisions have equal names.
"""

import hashlib
from functools import cached_property
from typing import Literal

import msgspec

from planner.road import LightChange, RoadFacts
from sim.scene import Point, VehicleState

SCHEMA = "xavi.plan_trace/2"
READABLE = ("xavi.plan_trace/1", SCHEMA)  # the older ones lack what was added since
LARGEST = 1e6  # of a component, in its unit; nothing that a car does is beyond it
MAX_BYTES = 256 * 1024
IMPROBABLE = (0.1, 0.2, 0.35, 0.5)  # probabilities up to which predicted lines are dropped first
SAMPLE_PERIOD = 0.2  # [s] of histories, predictions and rollouts (5 Hz)

Action = Literal[
    "continue",
    "change-left",
    "change-right",
    "exit-left",
    "exit-right",
    "exit-straight",
    "continue-next-exit",
    "stop",
]
Outcome = Literal["done", "collision", "termination", "dead"]
Component = Literal[
    "time",  # [s] to the goal
    "jerk",  # [m/s3] mean absolute value
    "angular-acceleration",  # [rad/s2] mean absolute value
    "curvature",  # [1/m] mean absolute value
]
HoldUp = Literal["leader", "right-of-way", "cut-in", "blocked"]

ACTIONS: tuple[Action, ...] = (
    "continue",
    "change-left",
    "change-right",
    "exit-left",
    "exit-right",
    "exit-straight",
    "continue-next-exit",
    "stop",
)
OUTCOMES: tuple[Outcome, ...] = ("done", "collision", "termination", "dead")
COMPONENTS: tuple[Component, ...] = ("time", "jerk", "angular-acceleration", "curvature")
UNITS: dict[Component, str] = {
    "time": "s",
    "jerk": "m/s3",
    "angular-acceleration": "rad/s2",
    "curvature": "1/m",
}


class Settings(msgspec.Struct, frozen=True):
    """What the planner was told to do; all budgets are counts."""

    rollouts: int = 100  # drawn by the search
    min_rollouts: int = 12  # for every applicable first action; the missing ones are forced
    comparisons: int = 12  # rollouts of every first action through the same samples
    depth: int = 4  # macro actions in a row
    horizon: float = 30.0  # [s] a rollout that lasts longer terminates
    period: float = 1.0  # [s] between decisions
    recognition: bool = True  # False: goals keep their prior
    rationality: float = 1.5  # beta in p(track | goal) = exp(beta * reward difference)
    view_radius: float = 100.0  # [m]


class EgoGoal(msgspec.Struct, frozen=True):
    """Where the passenger wants to go."""

    edge: str
    position: float  # [m] along the edge
    lane: int | None  # None: any lane counts


class Track(msgspec.Struct, frozen=True, omit_defaults=True):
    """One vehicle as observed, at 5 Hz; the lists of samples have the same length N >= 1."""

    start: float  # [s] time of the first sample
    position: tuple[Point, ...]  # [m] [N]
    heading: tuple[float, ...]  # [rad] [N]
    speed: tuple[float, ...]  # [m/s] [N]
    lights: tuple[LightChange, ...] = ()  # at its start, and every change since; () unknown


class HeldUp(msgspec.Struct, frozen=True):
    """A stretch of a drive, imagined or predicted, in which another vehicle held one up."""

    vehicle: int
    since: float = msgspec.field(name="from")  # [s] simulation time
    until: float = msgspec.field(name="to")  # [s]
    how: HoldUp
    speed_from: float  # [m/s] that vehicle's speed at the start of the stretch
    speed_to: float  # [m/s] and its lowest speed within it


class TrajectoryPrediction(msgspec.Struct, frozen=True, omit_defaults=True):
    """One way in which a vehicle may reach one goal, from the scene on, at 5 Hz."""

    probability: float  # given the goal
    actions: tuple[Action, ...]
    path: tuple[Point, ...]  # [m] [N]
    speed: tuple[float, ...]  # [m/s] [N]
    held_up: tuple[HeldUp, ...] = ()  # by whom, the ego among them; left out where by nobody


class GoalPrediction(msgspec.Struct, frozen=True):
    """One goal that a vehicle may have."""

    kind: Action  # the macro action that ends at it: exit-right, continue, stop, ...
    place: str  # in words: "the exit on the right"
    edge: str | None  # None for stopping
    prior: float
    likelihood: float  # of the observed track, relative to the most rational one
    probability: float
    trajectories: tuple[TrajectoryPrediction, ...]


class VehiclePrediction(msgspec.Struct, frozen=True):
    """What one vehicle may do; goal probabilities sum to 1."""

    vehicle: int
    goals: tuple[GoalPrediction, ...]


class Sample(msgspec.Struct, frozen=True):
    """The goal and trajectory drawn for one vehicle, as indices into its prediction."""

    vehicle: int
    goal: int
    trajectory: int


class TimedAction(msgspec.Struct, frozen=True):
    """One macro action of the ego in a rollout."""

    action: Action
    start: float  # [s] simulation time


class Rollout(msgspec.Struct, frozen=True):
    """One simulation of the search.

    Many rollouts drive the very same line at the same speeds. It is recorded once: the later
    ones carry `same_as`, the index of the first, and null path and speed. In a crowd, where a
    trace would grow beyond MAX_BYTES, further rollouts go without their line (see `fitted`).
    """

    index: int
    forced: bool  # drawn for a first action that the search visited too rarely
    samples: tuple[Sample, ...]
    actions: tuple[TimedAction, ...]
    path: tuple[Point, ...] | None  # [m] [N] of the ego, at 5 Hz
    speed: tuple[float, ...] | None  # [m/s] [N]
    same_as: int | None
    outcome: Outcome
    components: dict[Component, float | None]  # all null unless the outcome is done
    reward: float
    collided_with: int | None
    held_up: tuple[HeldUp, ...]


class NotApplicable(msgspec.Struct, frozen=True):
    """Why an action could not be taken at a node of the search."""

    node: tuple[Action, ...]  # actions that lead to the node; () is the root
    action: Action
    reason: str  # a clause in words: "there is no lane to the left"


class PlannedAction(msgspec.Struct, frozen=True):
    """One macro action of the chosen plan with its value in the search."""

    action: Action
    value: float  # of the first: mean reward over the samples tried with all; else in the search
    visits: int  # unforced rollouts through it


class WhatIf(msgspec.Struct, frozen=True):
    """What is changed when a decision is planned again; see planner.whatif."""

    actions: tuple[Action, ...] = ()  # that the ego takes first
    removed: int | None = None  # a vehicle that is not there
    vehicle: int | None = None  # another vehicle that acts as supposed:
    goal: str | None = None  # where it goes: the kind of a goal, or its edge
    vehicle_actions: tuple[Action, ...] = ()  # what it does first
    rollouts: int = 40  # drawn with the ego's forced actions


class PlanTrace(msgspec.Struct, frozen=True, omit_defaults=True, dict=True):
    """The record of one decision."""

    schema: str
    vehicle: str  # the car's id on the bus
    sim_time: float  # [s]
    decision: int  # running number
    seed: int
    settings: Settings
    network: str  # hash of the road network
    goal: EgoGoal
    under_way: TimedAction | None  # a macro action that must be finished first
    history: dict[int, Track]
    scene: dict[int, VehicleState]
    predictions: tuple[VehiclePrediction, ...]
    rollouts: tuple[Rollout, ...]
    not_applicable: tuple[NotApplicable, ...]
    plan: tuple[PlannedAction, ...]
    unseen: dict[int, float] = {}  # hidden vehicles in the scene, and when [s] they were seen last
    waypoint: EgoGoal | None = None  # what rollouts aim for where the goal is too far for them
    road: RoadFacts | None = None  # where everybody is on it, and what the ego comes to
    what_if: WhatIf | None = None  # of a decision planned again; left out where it was taken

    @cached_property
    def trace_id(self) -> str:
        """16 hex digits of the SHA-256 of the canonical JSON."""
        return hashlib.sha256(encode(self)).hexdigest()[:16]


class TraceError(ValueError):
    """A PlanTrace that cannot be read or written."""


def encode(trace: PlanTrace) -> bytes:
    """The canonical JSON of a trace: the same trace gives the same bytes.

    Vehicles stand in increasing order of their names, as in `Scene`.
    """
    return msgspec.json.encode(trace)


def fitted(trace: PlanTrace) -> PlanTrace:
    """The trace without the lines that it has no room for.

    Where it is larger than MAX_BYTES, the less probable predictions lose path, speed and who
    holds them up, then the rollouts recorded last lose path and speed, then all predictions do;
    what rollouts came to, and why, always stays.
    """
    for below in IMPROBABLE:
        if len(encode(trace)) > MAX_BYTES:
            trace = _without_lines(trace, below)
    excess = len(encode(trace)) - MAX_BYTES
    if excess <= 0:
        return trace
    rollouts = list(trace.rollouts)
    for k in range(len(rollouts) - 1, -1, -1):
        if excess > 0 and rollouts[k].path is not None:
            bare = msgspec.structs.replace(rollouts[k], path=None, speed=None)
            excess -= len(msgspec.json.encode(rollouts[k])) - len(msgspec.json.encode(bare))
            rollouts[k] = bare
    trace = msgspec.structs.replace(trace, rollouts=tuple(rollouts))
    return trace if excess <= 0 else _without_lines(trace, 1.0)


def _without_lines(trace: PlanTrace, below: float) -> PlanTrace:
    """The trace without the predicted lines that are at most as probable as `below`."""

    def stripped(goal: GoalPrediction) -> GoalPrediction:
        ways = (
            msgspec.structs.replace(way, path=(), speed=(), held_up=())
            if goal.probability * way.probability <= below
            else way
            for way in goal.trajectories
        )
        return msgspec.structs.replace(goal, trajectories=tuple(ways))

    predictions = tuple(
        VehiclePrediction(known.vehicle, tuple(map(stripped, known.goals)))
        for known in trace.predictions
    )
    return msgspec.structs.replace(trace, predictions=predictions)


def decode(data: bytes) -> PlanTrace:
    """Read a trace from JSON.

    Raises:
        TraceError: too large, not JSON, not of this schema, or a field is wrong.
    """
    if len(data) > MAX_BYTES:
        raise TraceError(f"trace of {len(data)} bytes; at most {MAX_BYTES} are accepted")
    try:
        trace = msgspec.json.decode(data, type=PlanTrace)
    except (msgspec.ValidationError, msgspec.DecodeError) as error:
        raise TraceError(f"not a plan trace: {error}") from error
    if trace.schema not in READABLE:
        known = " and ".join(repr(name) for name in READABLE)
        raise TraceError(f"trace schema is {trace.schema!r}; this version reads {known}")
    fault = fault_of(trace)
    if fault is not None:
        raise TraceError(f"not a plan trace: {fault}")
    return trace


def fault_of(trace: PlanTrace) -> str | None:
    """What in a trace does not fit together, if anything."""
    numbers = (value for one in trace.rollouts for value in one.components.values())
    if any(value is not None and abs(value) > LARGEST for value in numbers):
        return f"a component beyond {LARGEST:g}"
    for vehicle, track in trace.history.items():
        if not len(track.position) == len(track.heading) == len(track.speed) > 0:
            return f"the history of vehicle {vehicle} has lists of different lengths, or is empty"
    ways = {
        known.vehicle: [len(g.trajectories) for g in known.goals] for known in trace.predictions
    }
    for vehicle, counts in ways.items():
        if not counts or min(counts) == 0:
            return f"vehicle {vehicle} has no goal, or one with no trajectory"
    known = () if trace.road is None else trace.road.places.keys()
    told = () if trace.road is None else {fact.vehicle for fact in trace.road.priority}
    for vehicle in {*known, *told} - trace.scene.keys():
        return f"vehicle {vehicle} is on the road and not in the scene"
    for rollout in trace.rollouts:
        for s in rollout.samples:
            counts = ways.get(s.vehicle, [])
            if not (0 <= s.goal < len(counts) and 0 <= s.trajectory < counts[s.goal]):
                return f"rollout {rollout.index} samples what is not predicted"
    return None
