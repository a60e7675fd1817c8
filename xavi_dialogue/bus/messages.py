"""Messages on the bus: JSON, checked by the receiver.

Every message carries its schema, a sequence number of its sender, simulation time [s] and wall
time [s since 1970]; requests carry a name and a deadline instead.

    MessageError
    ├── TooLarge       more bytes than its kind allows
    ├── WrongSchema    another message, or an unknown version
    └── Malformed      not JSON, or a field is missing or wrong
"""

from typing import Annotated, ClassVar, Literal, TypeAlias, TypeVar

import msgspec

from planner.record.events import Event
from planner.record.foreign_text import unprintable
from planner.record.light_record import LightSupposed
from planner.record.trace import MAX_BYTES, Action, PlanTrace
from planner.record.trace_reading import fault_of
from sim.scene import EGO, Light, PersonState, Scene, Unseen, VehicleState
from xavi_dialogue.bus.errors import Malformed, TooLarge, WrongSchema
from xavi_dialogue.bus.sanitize import clean, one_line
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.domain.answers import Reason
from xavi_dialogue.nlg.context import Style

Name = Annotated[str, msgspec.Meta(min_length=1, max_length=64, pattern=r"^[A-Za-z0-9_.-]+$(?!\n)")]
# Integers that every language reads exactly (RFC 8259, section 6).
Whole = Annotated[int, msgspec.Meta(ge=1 - 2**53, le=2**53 - 1)]
Token = Annotated[
    str, msgspec.Meta(min_length=16, max_length=128, pattern=r"^[A-Za-z0-9_-]+$(?!\n)")
]
Count = Annotated[int, msgspec.Meta(ge=0, le=2**53 - 1)]
Seconds = Annotated[float, msgspec.Meta(ge=0.0, le=1e7)]
DeadlineMs = Annotated[float, msgspec.Meta(gt=0.0, le=600_000.0)]
Actions = Annotated[tuple[Action, ...], msgspec.Meta(max_length=8)]
Gone = Annotated[tuple[Whole, ...], msgspec.Meta(max_length=64)]
Faster = Annotated[float, msgspec.Meta(ge=-100.0, le=100.0)]
Supposed = Annotated[tuple[LightSupposed, ...], msgspec.Meta(max_length=8)]
Place = Annotated[str, msgspec.Meta(min_length=1, max_length=128)]
Folder = Annotated[str, msgspec.Meta(min_length=1, max_length=4096)]
CarState = Literal["driving", "paused", "ended"]

KIB = 1024
MAX_TEXT = 4096  # characters of a question
MAX_TURNS = 100  # of a session, in a history
MAX_CHARACTER = 12  # bytes of one in JSON: two escapes such as \ud83d\ude00


class Message(msgspec.Struct, frozen=True, kw_only=True):
    """Base of all messages. `schema` has a default when made, but must be present when read."""

    LIMIT: ClassVar[int]  # bytes

    schema: str


class Report(Message, frozen=True, kw_only=True):
    """Base of all messages of the car."""

    ride: Name  # changes with every start of the car
    seq: Count  # of this key, without gaps from 0
    sim_time: Seconds
    wall_time: float


class SceneReport(Report, frozen=True, kw_only=True):
    """The present scene, with the numbers of the latest reports."""

    LIMIT = 256 * KIB

    schema: Literal["xavi.scene/1"] = "xavi.scene/1"
    vehicles: dict[Whole, VehicleState]
    lights: tuple[Light, ...] = ()
    people: dict[Whole, PersonState] = {}
    unseen: tuple[Unseen, ...] = ()  # stretches of lanes that something tall hides
    state: CarState
    speed_factor: float  # simulated seconds per second; 0: as fast as possible
    plan: tuple[Action, ...]
    traces: Count  # reports on key `trace` so far
    events: Count  # reports on key `event` so far
    orders: Count = 0  # commands on standard input that the car has carried out
    scenario: Folder | None = None  # name or folder, and seed: to drive the ride again
    seed: Count | None = None

    def scene(self) -> Scene:
        """Return the scene."""
        return Scene(self.sim_time, self.vehicles, self.lights, self.people, self.unseen)


class TraceReport(Report, frozen=True, kw_only=True):
    """One decision."""

    LIMIT = MAX_BYTES + KIB

    schema: Literal["xavi.trace/1"] = "xavi.trace/1"
    trace: PlanTrace
    first: Name | None = None  # id of the ride's first trace: equal for equal rides

    def __post_init__(self) -> None:
        fault = fault_of(self.trace)
        if EGO not in self.trace.scene or EGO not in self.trace.history:
            fault = "there is no ego"
        if fault is not None:
            raise ValueError(f"no plan trace: {fault}")


class EventReport(Report, frozen=True, kw_only=True):
    """One event of the ego."""

    LIMIT = 4 * KIB

    schema: Literal["xavi.event_report/1"] = "xavi.event_report/1"
    event: Event


class AskRequest(Message, frozen=True, kw_only=True):
    """A passenger's question."""

    LIMIT = MAX_TEXT * MAX_CHARACTER + 4 * KIB

    schema: Literal["xavi.ask/1"] = "xavi.ask/1"
    request: Name
    session: Name
    text: Annotated[str, msgspec.Meta(max_length=MAX_TEXT)]
    style: Style = "passenger"
    deadline_ms: DeadlineMs = 10_000.0
    at: Seconds | None = None  # simulation time; null: now
    token: Token | None = None  # see HistoryRequest
    share: bool = False  # others may read this turn, on key `dialogue/<session>/turn`

    def __post_init__(self) -> None:
        msgspec.structs.force_setattr(self, "text", one_line(self.text))


class AskReply(Reply, frozen=True, kw_only=True):
    """The answer: a reply, with the fields of every message."""

    LIMIT: ClassVar[int] = 256 * KIB

    schema: Literal["xavi.reply/2"] = "xavi.reply/2"
    request: Name
    seq: Count
    wall_time: float

    def reply(self) -> Reply:
        """Return the reply alone, safe to print."""
        fields = {name: getattr(self, name) for name in Reply.__struct_fields__}
        return Reply(**{**fields, "text": clean(self.text)})


class HistoryRequest(Message, frozen=True, kw_only=True):
    """Asks for the turns of a session.

    A session belongs to the client that begins it. All later requests about it must carry the
    token of its first question; a session that began without a token is open to all.
    """

    LIMIT = 4 * KIB

    schema: Literal["xavi.history/1"] = "xavi.history/1"
    session: Name
    token: Token | None = None
    turns: Annotated[int, msgspec.Meta(ge=1, le=MAX_TURNS)] = MAX_TURNS  # the latest ones alone


class PastTurn(msgspec.Struct, frozen=True):
    """One question and its reply."""

    text: str
    reply: Reply


class HistoryReply(Message, frozen=True, kw_only=True):
    """The latest turns of a session, oldest first."""

    LIMIT = 1024 * KIB

    schema: Literal["xavi.history_reply/2"] = "xavi.history_reply/2"
    session: Name
    seq: Count
    sim_time: Seconds
    wall_time: float
    total: Count = 0  # turns that are remembered, of which these are the latest; 200 at most
    turns: tuple[PastTurn, ...]


class TurnReport(Message, frozen=True, kw_only=True):
    """A turn that the passenger shares with others."""

    LIMIT = 256 * KIB + 4 * KIB

    schema: Literal["xavi.turn/2"] = "xavi.turn/2"
    session: Name
    seq: Count  # of the service's shared turns about this car
    sim_time: Seconds  # at which it was asked
    wall_time: float
    turn: PastTurn


class ForgetRequest(Message, frozen=True, kw_only=True):
    """Asks to erase a session, on disk and in memory."""

    LIMIT = 4 * KIB

    schema: Literal["xavi.forget/1"] = "xavi.forget/1"
    request: Name
    session: Name
    token: Token | None = None


class ForgetReply(Message, frozen=True, kw_only=True):
    """The result of erasing."""

    LIMIT = 4 * KIB

    schema: Literal["xavi.forget_reply/1"] = "xavi.forget_reply/1"
    request: Name
    session: Name
    turns: Count  # that were erased
    forgotten: bool  # false: something is left on disk, until it can be written again


class CancelRequest(Message, frozen=True, kw_only=True):
    """The passenger no longer wants an answer."""

    LIMIT = 4 * KIB

    schema: Literal["xavi.cancel/1"] = "xavi.cancel/1"
    request: Name
    session: Name
    token: Token | None = None


class CancelReply(Message, frozen=True, kw_only=True):
    """The reply to a cancellation: whether there was an open question."""

    LIMIT = 4 * KIB

    schema: Literal["xavi.cancel_reply/1"] = "xavi.cancel_reply/1"
    request: Name
    cancelled: bool


class EvidenceRequest(Message, frozen=True, kw_only=True):
    """Asks for a decision that an answer names as evidence; the reply is a PlanTrace."""

    LIMIT = 4 * KIB

    schema: Literal["xavi.evidence/1"] = "xavi.evidence/1"
    request: Name
    trace_id: Name


class WhatIfRequest(Message, frozen=True, kw_only=True):
    """Plan again from a recorded decision; the reply is a PlanTrace."""

    LIMIT = 4 * KIB

    schema: Literal["xavi.whatif/1"] = "xavi.whatif/1"
    request: Name
    trace_id: Name
    actions: Actions = ()  # that the ego takes first
    removed: Whole | Gone | None = None  # vehicles to leave out
    vehicle: Whole | None = None  # another vehicle that acts as supposed:
    goal: Place | None = None  # its goal: a kind, or an edge
    vehicle_actions: Actions = ()  # its first action
    faster: Faster | msgspec.UnsetType = msgspec.UNSET  # [m/s] by which it drives faster
    lights: Supposed | msgspec.UnsetType = msgspec.UNSET  # the states of traffic lights
    seen_past: Gone | msgspec.UnsetType = msgspec.UNSET  # imagined road users
    rollouts: Annotated[int, msgspec.Meta(ge=1, le=1000)] = 40  # with the ego's forced actions
    deadline_ms: DeadlineMs = 10_000.0


class AliveReport(Message, frozen=True, kw_only=True):
    """The health of a component: the reply to a request to its key `alive/<component>`."""

    LIMIT = 16 * KIB

    schema: Literal["xavi.alive/1"] = "xavi.alive/1"
    component: Name  # car, service, dashboard, recorder
    version: str  # of the program
    seq: Count  # of these reports
    sim_time: Seconds  # the latest that it knows of
    wall_time: float
    uptime_s: float
    counters: dict[str, float]  # since the start, in order of names


class Failure(Message, frozen=True, kw_only=True):
    """The reply to a request that failed: the reason."""

    LIMIT = 4 * KIB

    schema: Literal["xavi.failure/1"] = "xavi.failure/1"
    reason: Reason
    detail: str = ""


AnyMessage: TypeAlias = Message | AskReply
M = TypeVar("M", bound=AnyMessage)


_SCHEMAS: dict[type, str] = {}  # it is wanted for every message, and reading a class takes long


def schema_name(kind: type[msgspec.Struct]) -> str:
    """Return the field `schema` of a message, such as `xavi.ask/1`."""
    if kind not in _SCHEMAS:
        fields = {field.name: field.default for field in msgspec.structs.fields(kind)}
        _SCHEMAS[kind] = str(fields["schema"])
    return _SCHEMAS[kind]


class _Label(msgspec.Struct):
    schema: str


def decode(data: bytes, kind: type[M]) -> M:
    """Read a message whose schema is known; `unpack` checks it."""
    return msgspec.json.decode(data, type=kind)


def pack(message: AnyMessage) -> bytes:
    """Return the message as JSON."""
    return msgspec.json.encode(message)


def unpack(data: bytes, kind: type[M]) -> M:
    """Read and check a message.

    Raises:
        TooLarge: it has more bytes than its kind allows.
        WrongSchema: it is another message, or of an unknown version.
        Malformed: it is not JSON, or a field is missing or wrong.
    """
    name = schema_name(kind)
    if len(data) > kind.LIMIT:
        raise TooLarge(f"{len(data)} bytes; a {name} has at most {kind.LIMIT}")
    try:
        if not data.startswith(b'{"schema":"%s",' % name.encode()):  # as `pack` writes it
            schema = msgspec.json.decode(data, type=_Label).schema
            if schema != name:
                raise WrongSchema(f"schema {one_line(schema)[:64]!r}; {name!r} is read here")
        if issubclass(kind, Report) and (strange := unprintable(data)) is not None:
            raise Malformed(f"no {name}: {strange}")
        return decode(data, kind)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError) as error:
        raise Malformed(f"no {name}: {one_line(str(error))}") from error
