"""Documents that a browser fetches over HTTP: JSON.

SI units, radians anticlockwise from east, seconds of simulation time.
"""

from typing import TypeAlias

import msgspec

from planner.record.trace import Action
from xavi_dialogue.dashboard.web.websocket_messages import HiddenShown, LightShown, Seen

Line: TypeAlias = tuple[float, ...]  # [m] x, y, x, y, ...


class LaneShown(msgspec.Struct, frozen=True, kw_only=True):
    """One lane."""

    id: str
    edge: str
    index: int  # 0 is the rightmost
    width: float  # [m]
    internal: bool  # inside a junction
    line: Line  # centreline in driving direction
    use: str = "cars"  # who may use it: cars, bicycles, people, rails, others


class CrossingShown(msgspec.Struct, frozen=True, kw_only=True):
    """A pedestrian crossing."""

    line: Line  # its middle, from kerb to kerb
    width: float  # [m]
    signal: str | None  # id of its light


class LinkShown(msgspec.Struct, frozen=True, kw_only=True):
    """One way through a junction."""

    id: int
    junction: str
    from_lane: str
    to_lane: str
    via: tuple[str, ...]  # lanes
    direction: str  # left, straight, right, turnaround
    yields_to: tuple[int, ...]  # ids of links
    signal: str | None = None  # id of its light


class Roads(msgspec.Struct, frozen=True, kw_only=True):
    """GET /api/roads/HASH: the network."""

    hash: str
    bounds: tuple[float, float, float, float]  # [m] left, bottom, right, top
    lanes: tuple[LaneShown, ...]
    links: tuple[LinkShown, ...]
    junctions: tuple[Line, ...]  # outlines
    others: tuple[LaneShown, ...] = ()  # lanes that cars may not use
    crossings: tuple[CrossingShown, ...] = ()


class Past(msgspec.Struct, frozen=True, kw_only=True):
    """GET /api/past: the scenes of this ride so far, at most 5 a second."""

    ride: str
    #: t, vehicles, lights, hidden stretches (null: not known); in order of time
    scenes: tuple[
        tuple[
            float, tuple[Seen, ...], tuple[LightShown, ...] | None, tuple[HiddenShown, ...] | None
        ],
        ...,
    ]


class Drive(msgspec.Struct, frozen=True, kw_only=True):
    """A line that is or would be driven."""

    t: float  # [s] of the first point
    dt: float  # [s] between points
    path: Line
    speed: tuple[float, ...]  # [m/s] at each point
    outcome: str | None = None  # done, collision, termination, dead; null of others' lines
    probability: float = 1.0  # of this line among those of its kind
    collided_with: int | None = None


class Way(msgspec.Struct, frozen=True, kw_only=True):
    """A way in which a vehicle may reach a goal."""

    probability: float  # of goal and way together
    line: Drive | None  # null: not in the record


class GoalShown(msgspec.Struct, frozen=True, kw_only=True):
    """A possible goal of another vehicle."""

    kind: Action
    words: str  # "turns left"
    place: str
    prior: float
    probability: float
    ways: tuple[Way, ...]


class Predicted(msgspec.Struct, frozen=True, kw_only=True):
    """The prediction of another vehicle."""

    vehicle: int
    goals: tuple[GoalShown, ...]  # likeliest first


class TimeRange(msgspec.Struct, frozen=True, kw_only=True):
    """A difference in time to the goal [s] against the chosen plan; positive: later."""

    delta: float
    low: float  # weighted 5 % point
    high: float  # weighted 95 % point


class Alternative(msgspec.Struct, frozen=True, kw_only=True):
    """A first action, the chosen one among them."""

    action: Action
    words: str  # "change to the left lane"
    chosen: bool
    outcomes: dict[str, float]  # share of rollouts by outcome; {} if it was not tried
    time: TimeRange | None  # null of the chosen one, and if unknown
    arrival: float | None  # [s] expected time to the goal
    value: float | None  # expected reward
    rollouts: int
    distinct: int  # distinct samples behind it
    line: Drive | None
    reason: str | None  # why it was inapplicable: "there is no lane to the left"


class Branch(msgspec.Struct, frozen=True, kw_only=True):
    """One action at one node of the search tree."""

    action: Action
    words: str
    chosen: bool
    visits: int  # rollouts of the search
    forced: int  # rollouts added for comparison
    value: float | None
    arrival: float | None  # [s] mean time to the goal of the rollouts that reach it
    outcomes: dict[str, float]  # share by outcome
    held_up: tuple[tuple[int, str, float], ...]  # vehicle, how in words, share of the rollouts
    children: tuple["Branch", ...]
    refused: tuple[tuple[Action, str], ...]  # at the node that it leads to, and why


class RightOfWay(msgspec.Struct, frozen=True, kw_only=True):
    """Right of way at the next junction."""

    junction: str
    ego: int  # id of its link
    goes_first: tuple[int, ...]  # links that the ego gives way to
    vehicles: tuple[int, ...]  # that are on these


class ImaginedShown(msgspec.Struct, frozen=True, kw_only=True):
    """A road user that may come out of a hidden stretch of road."""

    position: tuple[float, float]  # [m] of its front
    heading: float  # [rad]
    probability: float  # that there is one
    behind: int | None  # the vehicle that hides the place; null: a building


class DecisionShown(msgspec.Struct, frozen=True, kw_only=True):
    """GET /api/decisions/ID: one decision, whole."""

    id: str
    t: float
    number: int
    seed: int
    words: str
    plan: tuple[tuple[Action, str, float, int], ...]  # action, in words, value, visits
    under_way: str | None  # in words: what has to be finished first
    goal: tuple[float, float] | None  # [m] the passenger's destination
    view_radius: float  # [m]
    ego: Drive | None  # the likeliest line of the plan
    alternatives: tuple[Alternative, ...]  # the chosen one first, then best first
    predictions: tuple[Predicted, ...]
    root: tuple[Branch, ...]  # branches of the root
    refused: tuple[tuple[Action, str], ...]  # actions that could not be taken first, and why
    right_of_way: RightOfWay | None
    imagined: tuple[ImaginedShown, ...]
    rollouts: int


class Run(msgspec.Struct, frozen=True, kw_only=True):
    """A rollout, and how often one like it was drawn."""

    index: int
    draws: int
    words: str  # of its actions
    outcome: str
    arrival: float | None  # [s]
    samples: tuple[tuple[int, str, float], ...]  # vehicle, what it does, probability of that
    held_up: tuple[tuple[int, str, float], ...]  # vehicle, how in words, seconds
    collided_with: int | None


class Side(msgspec.Struct, frozen=True, kw_only=True):
    """One side of a contrast: the fact or the foil."""

    title: str  # "my plan", "what you asked about", "what I would have done instead"
    brief: str  # what tells it from the other side: "move to the left lane"
    words: str  # "change to the left lane, then turn left"
    outcomes: dict[str, float]  # share of rollouts by outcome
    arrival: float | None  # [s]
    lines: tuple[Drive, ...]  # likeliest first, 5 at most
    runs: tuple[Run, ...]  # those that differ, 100 at most
    rollouts: int


class EffectShown(msgspec.Struct, frozen=True, kw_only=True):
    """One effect: counterfactual minus factual."""

    words: str  # "time to the goal"
    unit: str
    delta: float
    low: float
    high: float
    n: int
    n_distinct: int


class CauseShown(msgspec.Struct, frozen=True, kw_only=True):
    """One vehicle that is a cause."""

    vehicle: int
    words: str  # "is likely to slow down and turn right"
    probability: float
    how: str | None  # how it held us up, in words
    influence: float | None  # [bit]
    checked: str | None  # what planning without it showed, in words


class EvidenceShown(msgspec.Struct, frozen=True, kw_only=True):
    """GET /api/turns/N/evidence: the evidence of an answer."""

    n: int
    decision: str  # trace id
    t: float  # of the decision
    method: str  # in words: "the recorded search", "planning again"
    rollouts: int
    distinct: int
    factual: Side | None
    counterfactual: Side | None  # null where the question has none
    effects: tuple[EffectShown, ...]
    causes: tuple[CauseShown, ...]
    traces: tuple[str, ...]
    missing: str | None  # in words: parts that are no longer in the record
