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
    """The planner took a decision."""

    trace: PlanTrace
    first: str | None = None  # id of the ride's first, which names it; None: this one, if any


@dataclass(frozen=True, slots=True)
class EventRecorded:
    """Something happened to the ego."""

    event: Event


@dataclass(frozen=True, slots=True)
class SceneSeen:
    """What is in view at a moment, between decisions too."""

    scene: Scene


@dataclass(frozen=True, slots=True)
class RecordMissing:
    """What was recorded between two moments did not all arrive, and will not any more."""

    since: float  # [s]
    until: float  # [s]


@dataclass(frozen=True, slots=True)
class RideEnded:
    """Nothing more will be recorded."""

    at: float  # [s]


@dataclass(frozen=True, slots=True)
class Asked:
    """A passenger asks; the record is complete up to `at`."""

    request: str  # names the question until it is answered
    session: str
    text: str
    at: float  # [s] the moment at which it is asked
    style: Style = "passenger"


@dataclass(frozen=True, slots=True)
class TurnedAway:
    """A passenger asked, and the shell cannot have the question answered."""

    asked: Asked
    reason: Reason


@dataclass(frozen=True, slots=True)
class RolloutsArrived:
    """The planner planned again, as wanted for the question."""

    request: str
    session: str
    trace: PlanTrace


@dataclass(frozen=True, slots=True)
class PlannedAhead:
    """The planner planned again what nobody has asked about yet."""

    need: NeedRollout
    trace: PlanTrace


@dataclass(frozen=True, slots=True)
class RolloutsFailed:
    """The planner did not plan again."""

    request: str
    session: str
    reason: Reason


@dataclass(frozen=True, slots=True)
class Cancelled:
    """The passenger no longer wants the answer."""

    request: str
    session: str


@dataclass(frozen=True, slots=True)
class Resumed:
    """A conversation of before goes on; to be stated before its first question."""

    session: str
    turns: tuple[Turn, ...]  # oldest first


@dataclass(frozen=True, slots=True)
class Forgotten:
    """The passenger wants the conversation forgotten."""

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
    """The reply to a question, and the turn to be kept; None of one that was turned away."""

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
