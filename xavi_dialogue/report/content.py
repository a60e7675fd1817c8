"""The content of an incident report: frozen values without words or layout.

SI units, radians anticlockwise from east, seconds of simulation time. Road users are named by
their numbers in the record; 0 is the reporting car.
"""

from typing import Literal

import msgspec

from planner.record.places import First, Rule
from planner.record.trace import Action, Costs, Outcome, RewardTerm, Settings
from sim.scene import Point
from xavi_dialogue.report.decisions.alternatives import Avoidability, Cases
from xavi_dialogue.report.figures import Figure, Source

SCHEMA = "xavi.report/1"

MomentKind = Literal["collision", "hardest-braking", "closest-approach", "red-light", "time"]
Role = Literal[
    "collided", "near", "gave-way", "in-the-way", "held-up", "leader", "right-of-way", "follower"
]  # fmt: skip
ChangeKind = Literal[
    "plan", "in-view", "road", "signals", "light", "speed", "expected", "moved", "turned"
]
Examined = Literal["in-force", "last-change", "changed", "last-chance", "last-way"]
Limit = Literal[
    "no-roads", "other-roads", "no-scenes", "ends-early", "begins-late", "lost", "lacks",
    "unseen", "not-predicted", "not-planned", "other-program", "hidden", "rollout-lines", "model",
    "others-inside", "perfect-sight", "simulated",
]  # fmt: skip


class Chosen(msgspec.Struct, frozen=True):
    """The moment that a report is about."""

    kind: MomentKind
    time: float  # [s]
    asked: str  # as it was asked for; "" for the default
    figures: dict[str, Figure]  # why it: deceleration, gap, speed
    vehicle: int | None = None  # the other one of a collision or an approach


class Party(msgspec.Struct, frozen=True):
    """A road user that is involved."""

    vehicle: int
    kind: str
    colour: str | None
    length: float | None  # [m] None: it was never seen; an event alone names it
    width: float | None  # [m]
    roles: tuple[Role, ...]
    source: Source
    nearest: Figure | None = None  # [m] least distance of the bodies in the window
    nearest_at: float | None = None  # [s]


class Entry(msgspec.Struct, frozen=True, omit_defaults=True):
    """One line of the timeline."""

    time: float  # [s]
    kind: str  # of an event, or: decision, episode, light, belief, peak
    source: Source
    vehicle: int | None = None  # the actor; None: what the road or a light does
    what: str = ""  # action, light state or goal
    place: str = ""  # of a goal, in words
    other: int | None = None
    until: float | None = None  # [s]
    plan: tuple[Action, ...] = ()
    figures: dict[str, Figure] = {}
    lit: bool = False  # of what restrains this car: a traffic light does so, too


class Body(msgspec.Struct, frozen=True):
    """A road user on a map."""

    vehicle: int
    position: Point  # [m] centre of the front bumper
    heading: float  # [rad]
    length: float  # [m]
    width: float  # [m]
    speed: float  # [m/s]


class LightShown(msgspec.Struct, frozen=True):
    """A traffic light on a map, at the end of a lane."""

    position: Point  # [m]
    state: str  # a letter, as in traces


class Frame(msgspec.Struct, frozen=True):
    """One map of the strip."""

    time: float  # [s]
    bodies: tuple[Body, ...]
    lights: tuple[LightShown, ...]
    source: Source


class RoadShown(msgspec.Struct, frozen=True):
    """A lane on the maps."""

    line: tuple[Point, ...]  # [m]
    width: float  # [m]
    inside: bool  # of a junction


class Map(msgspec.Struct, frozen=True):
    """The map strip."""

    centre: Point  # [m]
    reach: float  # [m] from the centre to the edges
    roads: tuple[RoadShown, ...]  # () if the roads are not known
    frames: tuple[Frame, ...]
    tracks: dict[int, tuple[Point, ...]]  # [m] of those involved, through the window


class Course(msgspec.Struct, frozen=True):
    """The motion of one road user through the window; lists of one length."""

    vehicle: int
    time: tuple[float, ...]  # [s]
    speed: tuple[float, ...]  # [m/s]
    rate: tuple[float, ...]  # [m/s2] change of speed
    source: Source


class Gaps(msgspec.Struct, frozen=True):
    """The distance between the bodies of the car and another through the window."""

    vehicle: int
    time: tuple[float, ...]  # [s]
    distance: tuple[float, ...]  # [m]
    closing: tuple[float, ...]  # [m/s] at which it shrinks
    source: Source


class LightSpan(msgspec.Struct, frozen=True):
    """A stretch in which the light ahead on the car's way showed one state."""

    controller: str
    place: int
    state: str  # a letter, as in traces
    since: float  # [s]
    until: float  # [s] as far as it was seen
    change_seen: bool  # whether it was seen to change to this at `since`
    decision: int  # the first that has it so in the window
    distance: Figure  # [m] from the car to the junction, then


class Precedence(msgspec.Struct, frozen=True):
    """The right of way at the next junction, by one decision."""

    decision: int
    time: float  # [s]
    rule: Rule | None  # of the car's way through it
    distance: Figure | None  # [m] to it
    first: dict[int, First]  # who goes first, by the other road user on a lane
    source: Source
    crossing: dict[int, Figure] = {}  # who may cross on foot, and how probably; it goes first


class BeliefPoint(msgspec.Struct, frozen=True):
    """The probability of a goal in one decision."""

    time: float  # [s]
    probability: float
    source: Source


class GoalBelief(msgspec.Struct, frozen=True):
    """How the belief in one goal of another moved."""

    kind: Action
    place: str  # in words, as recorded
    edge: str | None
    points: tuple[BeliefPoint, ...]
    came: bool | None  # whether it took that road in the record; None: not seen


class SpeedExpected(msgspec.Struct, frozen=True):
    """How fast a decision expected another to drive at a later time."""

    decision: int
    time: float  # [s] of the decision
    at: float  # [s] of which the speed is
    speed: Figure  # [m/s] mean over goals and trajectories, by probability
    driven: Figure | None  # [m/s] as it was seen then


class Beliefs(msgspec.Struct, frozen=True):
    """What was believed of one road user."""

    vehicle: int
    goals: tuple[GoalBelief, ...]
    unpredicted: tuple[int, ...]  # decisions that had it in view without a prediction
    speeds: tuple[SpeedExpected, ...] = ()  # by the decisions that are examined


class Change(msgspec.Struct, frozen=True, omit_defaults=True):
    """Something that was seen or planned otherwise at one decision than at the one before."""

    kind: ChangeKind
    vehicle: int | None = None
    was: Figure | None = None
    now: Figure | None = None
    words: tuple[str, str] = ("", "")  # before and now, of what is no figure
    source: Source | None = None  # of what is no figure


class Jump(msgspec.Struct, frozen=True, omit_defaults=True):
    """A probability that moved far from one decision to the next, and what changed in between."""

    vehicle: int | None  # whose goal it is; None: of a collision, see `goal`
    before: int  # number of the decision
    number: int  # of the next one
    was: Figure | None  # None: the decision before did not ascribe that goal
    now: Figure | None  # None: the next one does not ascribe it
    goal: Action | None = None  # of a collision: the option that was given up; None: the plan
    place: str = ""
    changes: tuple[Change, ...] = ()  # (): the record shows none


class Choice(msgspec.Struct, frozen=True):
    """A first action that a decision compared."""

    action: Action
    chosen: bool
    value: Figure  # [s] expected reward
    chances: dict[Outcome, Figure]
    hit: dict[int, Figure]  # probability of a collision with another, likeliest first
    told: Figure | None  # probability of a collision, with the error of the model
    time: Figure | None  # [s] to the goal
    braking: Figure | None  # [m/s2] hardest
    terms: dict[RewardTerm, Figure]  # [s] expected cost
    behind: Figure | None  # [s] by which the chosen one is better
    samples: int
    rollouts: int


class Decided(msgspec.Struct, frozen=True):
    """One decision, in full."""

    number: int
    why: tuple[Examined, ...]  # why it is shown in full
    time: float  # [s]
    trace: str
    plan: tuple[Action, ...]
    under_way: Action | None
    choices: tuple[Choice, ...]  # the chosen one first, then best first
    ruled_out: dict[Action, str]
    costs: Costs
    by_weights: bool  # whether the figures are those that the decision went by
    kept: Figure | None = None  # [s] standard error that the lead of a better option is within


class DecisionRow(msgspec.Struct, frozen=True):
    """One decision of the window, in short."""

    number: int
    time: float  # [s]
    trace: str
    plan: tuple[Action, ...]
    under_way: Action | None
    changed: bool  # whether the first action differs from that of the decision before
    speed: Figure
    collision: Figure | None  # its probability under the plan, by the rollouts
    value: Figure | None  # [s] expected reward


class Limitation(msgspec.Struct, frozen=True, omit_defaults=True):
    """Something that the record cannot show."""

    kind: Limit
    detail: str = ""
    vehicles: tuple[int, ...] = ()
    decisions: tuple[int, ...] = ()
    time: float | None = None  # [s]
    figure: Figure | None = None


class TraceHash(msgspec.Struct, frozen=True):
    """The id of one decision."""

    number: int
    time: float  # [s]
    trace: str


class Hashes(msgspec.Struct, frozen=True):
    """What the report was made from, and by what; hexadecimal SHA-256."""

    ride: str  # of the ride's decisions and events
    file: str | None  # of the file; None: it was driven, not opened
    network: str  # of the roads, as traces have it
    traces: tuple[TraceHash, ...]  # of the window: the first 16 digits
    program: str  # of the files of the program
    version: str


class Subject(msgspec.Struct, frozen=True):
    """The ride."""

    scenario: str
    seed: int
    car: str
    begin: float  # [s] of the record
    end: float  # [s]
    decisions: int
    scenes: int
    settings: Settings


class Incident(msgspec.Struct, frozen=True):
    """An incident report."""

    schema: str
    subject: Subject
    moment: Chosen
    since: float  # [s] the window
    until: float  # [s]
    involved: tuple[Party, ...]
    bystanders: tuple[int, ...]  # others in view in the window
    timeline: tuple[Entry, ...]
    map: Map
    motions: tuple[Course, ...]
    gaps: tuple[Gaps, ...]
    lights: tuple[LightSpan, ...]
    precedence: tuple[Precedence, ...]
    beliefs: tuple[Beliefs, ...]
    jumps: tuple[Jump, ...]
    decisions: tuple[DecisionRow, ...]
    decided: tuple[Decided, ...]  # those that are shown in full, oldest first
    cases: tuple[Cases, ...]  # of those of them that were planned again
    avoidability: Avoidability | None
    limits: tuple[Limitation, ...]
    hashes: Hashes


def encode(report: Incident) -> bytes:
    """Return a report as JSON; the same report gives the same bytes."""
    return msgspec.json.encode(report)
