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

from planner.record.hidden_record import HeldByHidden, Phantom, PhantomSample
from planner.record.light_record import HeldByLight, LightPrediction, LightSample, LightSupposed
from planner.record.places import LightChange, RoadFacts
from sim.scene import Point, VehicleState

SCHEMA = "xavi.plan_trace/2"
READABLE = ("xavi.plan_trace/1", SCHEMA)  # the older ones lack what was added since
LARGEST = 1e6  # maximum of a component, in its unit; no real drive exceeds it
MAX_BYTES = 1024 * 1024  # that readers accept
#: Bytes beyond which a trace goes without lines (planner.record.fitting); what it cannot go
#: without may take more than this in a crowd, where a rollout has a sample of each road user.
ROOM = 256 * 1024
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
    "cross",  # of people on foot alone: walk over the road
]
Outcome = Literal["done", "collision", "termination", "dead"]
Component = Literal[
    "time",  # [s] to the goal
    "jerk",  # [m/s3] mean absolute value
    "angular-acceleration",  # [rad/s2] mean absolute value
    "curvature",  # [1/m] mean absolute value
]
HoldUp = Literal["leader", "right-of-way", "cut-in", "blocked"]
#: The terms of the reward of a rollout. A collision, or losing the way to the goal (dead), is then
#: the only term. Running out of time costs a penalty (late), and the rest of the way (left).
RewardTerm = Literal[Component, "effort", "late", "left", "collision", "dead"]

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
#: Kinds of people outside of vehicles.
ON_FOOT = ("pedestrian", "wheelchair", "scooter")
OUTCOMES: tuple[Outcome, ...] = ("done", "collision", "termination", "dead")
COMPONENTS: tuple[Component, ...] = ("time", "jerk", "angular-acceleration", "curvature")
UNITS: dict[Component, str] = {
    "time": "s",
    "jerk": "m/s3",
    "angular-acceleration": "rad/s2",
    "curvature": "1/m",
}


class Costs(msgspec.Struct, frozen=True):
    """The weights of the reward, in seconds of travelling time; see planner.rollouts.reward."""

    weights: dict[Component, float]  # per unit of a component's total over the drive
    penalties: dict[Outcome, float]  # [s] of the outcomes that have one
    effort: dict[Action, float]  # [s] of the actions that cost something by themselves


#: The costs of traces that do not record them.
FORMER = Costs(
    {"time": 1.0, "jerk": 0.05, "angular-acceleration": 4.0, "curvature": 20.0},
    {"collision": 200.0, "dead": 150.0, "termination": 10.0},
    {"stop": 2.0, "change-left": 1.0, "change-right": 1.0},
)


class Settings(msgspec.Struct, frozen=True):
    """The settings of the planner; all budgets are counts."""

    rollouts: int = 100  # drawn by the search
    min_rollouts: int = 12  # for every applicable first action; the missing ones are forced
    comparisons: int = 24  # maximum number of joint samples to compare first actions
    depth: int = 4  # macro actions in a row
    horizon: float = 30.0  # [s] a rollout that lasts longer terminates
    period: float = 1.0  # [s] between decisions
    recognition: bool = True  # False: goals keep their prior
    rationality: float = 1.5  # beta in p(track | goal) = exp(beta * reward difference)
    view_radius: float = 100.0  # [m]
    #: whether the others of a rollout brake for the ego; unset in older traces: they do not
    reacting: bool | msgspec.UnsetType = msgspec.UNSET
    #: search trees that share the rollouts, and may grow in parallel; unset: one
    trees: int | msgspec.UnsetType = msgspec.UNSET


class EgoGoal(msgspec.Struct, frozen=True):
    """The destination of the ride, or a place on the way there."""

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
    #: [s] from when it was lost from sight until it was seen again, or now: samples are assumed
    assumed: tuple[tuple[float, float], ...] = ()


class HeldUp(msgspec.Struct, frozen=True):
    """A stretch of a rollout or predicted drive in which another road user held the driver up."""

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
    held_up: tuple[HeldUp, ...] = ()  # by others or the ego; left out if by nobody
    held_by_lights: tuple[HeldByLight, ...] = ()  # in their likeliest courses


class GoalPrediction(msgspec.Struct, frozen=True):
    """One goal that a vehicle may have."""

    kind: Action  # the macro action that ends at it: exit-right, continue, stop, ...
    place: str  # in words: "the exit on the right"
    edge: str | None  # None for stopping
    prior: float
    likelihood: float  # of the observed track, relative to the most rational one
    probability: float
    trajectories: tuple[TrajectoryPrediction, ...]
    indicators: float = 1.0  # p(indicators shown | goal), a factor of the likelihood


class VehiclePrediction(msgspec.Struct, frozen=True):
    """The possible goals of one road user; their probabilities sum to 1."""

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


class Rollout(msgspec.Struct, frozen=True, omit_defaults=True):
    """One simulation of the search.

    Many rollouts drive the very same line at the same speeds. It is recorded once: the later
    ones carry `same_as`, the index of the first, and null path and speed. Where a trace would
    grow beyond ROOM, further rollouts go without their line (planner.record.fitting).
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
    reward: float  # [s] minus the sum of the terms, to the millisecond
    collided_with: int | None
    held_up: tuple[HeldUp, ...]
    terms: dict[RewardTerm, float] = {}  # [s] that are not 0; empty in traces without costs
    weight: float | None = None  # in the comparison of first actions, if it is part of it
    braking: tuple[int, ...] = ()  # those that brake for the ego, or for one that does
    lights: tuple[LightSample, ...] = ()  # courses drawn for the traffic lights
    held_by_lights: tuple[HeldByLight, ...] = ()
    phantoms: tuple[PhantomSample, ...] = ()  # draws of whether each phantom comes
    held_by_hidden: tuple[HeldByHidden, ...] = ()


class NotApplicable(msgspec.Struct, frozen=True):
    """An action that could not be taken at a node of the search, with the reason."""

    node: tuple[Action, ...]  # actions that lead to the node; () is the root
    action: Action
    reason: str  # a clause in words: "there is no lane to the left"


class PlannedAction(msgspec.Struct, frozen=True):
    """One macro action of the chosen plan with its value in the search."""

    action: Action
    value: float  # of the first: expected reward, by the weights of rollouts; else in the search
    visits: int  # unforced rollouts through it


class WhatIf(msgspec.Struct, frozen=True):
    """The changes of a decision that is planned again; see planner.counterfactuals.whatif."""

    actions: tuple[Action, ...] = ()  # that the ego takes first
    removed: int | tuple[int, ...] | None = None  # a vehicle that is not there, or several
    vehicle: int | None = None  # another vehicle that acts as supposed:
    goal: str | None = None  # its goal: a kind, or an edge
    vehicle_actions: tuple[Action, ...] = ()  # its first actions
    rollouts: int = 40  # drawn with the ego's forced actions
    faster: float | msgspec.UnsetType = msgspec.UNSET  # [m/s] by which it drives faster
    lights: tuple[LightSupposed, ...] | msgspec.UnsetType = msgspec.UNSET
    seen_past: tuple[int, ...] | msgspec.UnsetType = msgspec.UNSET  # phantoms that are not there

    @property
    def gone(self) -> frozenset[int]:
        """The vehicles that are removed."""
        if self.removed is None:
            return frozenset()
        return frozenset((self.removed,) if isinstance(self.removed, int) else self.removed)


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
    waypoint: EgoGoal | None = None  # the aim of rollouts if the goal is too far
    road: RoadFacts | None = None  # places of all on it, and the way ahead
    what_if: WhatIf | None = None  # only if planned again
    costs: Costs | None = None  # None in older traces, with costs FORMER
    lights: tuple[LightPrediction, ...] = ()  # the traffic lights in view, by controller
    phantoms: tuple[Phantom, ...] = ()  # possible ones, in hidden parts of the road
    driving: Action | None = None  # being driven, can be abandoned; kept if as good

    @property
    def shows_deeds(self) -> bool:
        """Whether it can show what the ego carries out: an action under way, or its place."""
        return self.under_way is not None or self.road is not None

    @property
    def reckoned(self) -> Costs:
        """The costs that its rewards were computed with."""
        return self.costs or FORMER

    @cached_property
    def trace_id(self) -> str:
        """16 hex digits of the SHA-256 of the canonical JSON."""
        return hashlib.sha256(encode(self)).hexdigest()[:16]


def encode(trace: PlanTrace) -> bytes:
    """Return the canonical JSON of a trace: the same trace gives the same bytes.

    Vehicles are in increasing order of their numbers, as in `Scene`.
    """
    return msgspec.json.encode(trace)
