"""Events: inputs and outputs of the dialogue manager. No clock: times are given."""

from dataclasses import dataclass
from typing import TypeAlias

from planner.record.events import Event
from planner.record.trace import PlanTrace
from sim.scene import Scene
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.domain.answers import NeedRollout, Reason
from xavi_dialogue.nlg.context import Style


@dataclass(frozen=True, slots=True)
class TraceRecorded:
    """The planner made a decision."""

    trace: PlanTrace
    first: str | None = None  # of the ride, as its name; None: `trace`, if none was before


@dataclass(frozen=True, slots=True)
class EventRecorded:
    """Something happened to the ego."""

    event: Event


@dataclass(frozen=True, slots=True)
class SceneSeen:
    """The scene in view at a moment, also between decisions."""

    scene: Scene


@dataclass(frozen=True, slots=True)
class RecordMissing:
    """Some reports between two moments did not arrive, and are not going to."""

    since: float  # [s]
    until: float  # [s]


@dataclass(frozen=True, slots=True)
class RideEnded:
    """Nothing more will be recorded."""

    at: float  # [s]


@dataclass(frozen=True, slots=True)
class Asked:
    """A passenger asks a question; the record is complete up to `at`."""

    request: str  # identifies the question until it is answered
    session: str
    text: str
    at: float  # [s] the moment at which it is asked
    style: Style = "passenger"


@dataclass(frozen=True, slots=True)
class TurnedAway:
    """A passenger asked, and the shell could not have the question answered."""

    asked: Asked
    reason: Reason


@dataclass(frozen=True, slots=True)
class RolloutsArrived:
    """The planner has planned again for the question."""

    request: str
    session: str
    trace: PlanTrace


@dataclass(frozen=True, slots=True)
class PlannedAhead:
    """The planner has planned again without a question."""

    need: NeedRollout
    trace: PlanTrace


@dataclass(frozen=True, slots=True)
class RolloutsFailed:
    """The planner has not planned again."""

    request: str
    session: str
    reason: Reason
    roadless: bool = False  # the record holds no roads on which anything could be planned


@dataclass(frozen=True, slots=True)
class Cancelled:
    """The passenger no longer wants the answer."""

    request: str
    session: str


@dataclass(frozen=True, slots=True)
class Resumed:
    """An earlier conversation goes on; this input comes before its first new question."""

    session: str
    turns: tuple[Turn, ...]  # oldest first


@dataclass(frozen=True, slots=True)
class Forgotten:
    """The passenger wants the conversation to be forgotten."""

    session: str


Input: TypeAlias = (
    TraceRecorded
    | EventRecorded
    | SceneSeen
    | RecordMissing
    | RideEnded
    | Asked
    | TurnedAway
    | RolloutsArrived
    | RolloutsFailed
    | PlannedAhead
    | Cancelled
    | Resumed
    | Forgotten
)


@dataclass(frozen=True, slots=True)
class Answered:
    """The reply to a question, and the turn to be kept."""

    request: str
    session: str
    reply: Reply
    turn: Turn | None = None


@dataclass(frozen=True, slots=True)
class RolloutsWanted:
    """The question needs the planner to plan again."""

    request: str
    session: str
    need: NeedRollout


Output: TypeAlias = Answered | RolloutsWanted
