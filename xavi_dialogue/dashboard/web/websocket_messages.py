"""Messages between browser and dashboard over a WebSocket: JSON.

Each message has a `type`. SI units, radians anticlockwise from east, seconds of simulation time.
Large documents that are needed seldom are fetched over HTTP instead: see `http_documents`.
"""

from typing import Annotated, Literal, TypeAlias

import msgspec

from planner.record.trace import Action
from xavi_dialogue.bus.messages import KIB, MAX_CHARACTER, MAX_TEXT, CarState, Name, Seconds
from xavi_dialogue.dialogue.reply import Reply

MAX_INCOMING = MAX_TEXT * MAX_CHARACTER + 4 * KIB  # bytes of a message of a browser

#: id, x [m], y [m], heading [rad], speed [m/s], length [m], width [m], kind, colour, signals.
Seen: TypeAlias = tuple[
    int, float, float, float, float, float, float, str, str | None, tuple[str, ...]
]
#: id of the signal, state (see sim.scene.LightState, in small letters).
LightShown: TypeAlias = tuple[str, str]
#: lane, from where to where [m] along it nobody can be seen.
HiddenShown: TypeAlias = tuple[str, float, float]
#: awaited: not seen yet; coming: starting or restarting, and driving to its starting time.
Presence: TypeAlias = Literal["there", "gone", "awaited", "coming"]


# --- to the browser -------------------------------------------------------------------------


class Outgoing(msgspec.Struct, frozen=True, kw_only=True, tag_field="type"):
    """Base of all messages to a browser."""


class Welcome(Outgoing, frozen=True, kw_only=True, tag="welcome"):
    """The first message of every connection."""

    version: str  # of the program; a page of another one reloads itself
    vehicle: str  # name of the car on the bus
    session: str  # the conversation that is talked in
    recording: bool = False  # whether a recorded ride is played
    max_text: int = MAX_TEXT  # characters of a question


class Ride(Outgoing, frozen=True, kw_only=True, tag="ride"):
    """A ride begins, or is under way; it replaces any other ride."""

    ride: str
    scenario: str | None
    seed: int | None
    roads: str | None  # hash, for GET /api/roads/HASH; null: not known yet


class SceneShown(Outgoing, frozen=True, kw_only=True, tag="scene"):
    """The present scene, up to 10 times a second; a slow browser gets fewer."""

    seq: int  # to acknowledge with `seen`
    t: float
    wall: float  # [s since 1970] when the car published it
    state: CarState
    speed: float  # simulated seconds per second; 0: as fast as possible
    plan: tuple[Action, ...]
    vehicles: tuple[Seen, ...]  # the ego is 0; people on foot are among them
    lights: tuple[LightShown, ...] = ()
    hidden: tuple[HiddenShown, ...] = ()


class Belief(msgspec.Struct, frozen=True):
    """The prediction of one other vehicle."""

    vehicle: int
    goals: tuple[tuple[str, float], ...]  # in words, probability; they sum to 1


class Decision(msgspec.Struct, frozen=True, kw_only=True):
    """One decision, in short."""

    id: str  # trace id, for GET /api/decisions/ID
    t: float
    number: int
    plan: tuple[Action, ...]
    words: str  # of the plan: "Change to the left lane, then turn left"
    changed: bool  # whether it differs from the plan before
    beliefs: tuple[Belief, ...]


class Decisions(Outgoing, frozen=True, kw_only=True, tag="decisions"):
    """Decisions that the browser does not know yet, in order of time."""

    decisions: tuple[Decision, ...]


class Happened(msgspec.Struct, frozen=True, kw_only=True):
    """One event."""

    t: float
    kind: str  # see planner.record.events
    action: Action | None
    vehicle: int | None
    words: str  # "I began to change lanes to the left"


class Events(Outgoing, frozen=True, kw_only=True, tag="events"):
    """Events that the browser does not know yet, in order of time."""

    events: tuple[Happened, ...]


class Status(Outgoing, frozen=True, kw_only=True, tag="status"):
    """The state of the connections. Sent with the welcome, and after every change."""

    hub: Presence
    car: Presence
    service: Presence
    dropped: int  # scenes that this browser was too slow for, since it connected
    browsers: int  # that are connected


class TurnShown(msgspec.Struct, frozen=True, kw_only=True):
    """One turn of the conversation."""

    n: int  # number within the conversation, from 0
    text: str
    reply: Reply
    vehicles: tuple[int, ...]  # that the answer speaks of
    evidence: bool  # whether GET /api/turns/N/evidence has contents


class Turns(Outgoing, frozen=True, kw_only=True, tag="turns"):
    """Turns that are new to the browser, from any client; `reset`: drop those before."""

    turns: tuple[TurnShown, ...]
    reset: bool = False


class Thinking(Outgoing, frozen=True, kw_only=True, tag="thinking"):
    """A question was sent to the service; for the browser that asked."""

    request: Name


class AnsweredHere(Outgoing, frozen=True, kw_only=True, tag="answered"):
    """The result of a question, for the browser that asked."""

    request: Name
    n: int | None  # the turn that holds it, which was sent before this
    reply: Reply | None  # why there is no turn (busy, no service, ...); else null


class Suggestions(Outgoing, frozen=True, kw_only=True, tag="suggestions"):
    """Suggested questions, most interesting first, about what has just happened."""

    t: float
    questions: tuple[str, ...]


class Trouble(Outgoing, frozen=True, kw_only=True, tag="trouble"):
    """A message of the browser was rejected; the reason is a text for users."""

    request: Name | None
    text: str


# --- from the browser -----------------------------------------------------------------------


class Here(msgspec.Struct, frozen=True, kw_only=True, tag="here", tag_field="type"):
    """The welcome has arrived; who never says anything may lose its place to another browser."""


class Ask(msgspec.Struct, frozen=True, kw_only=True, tag="ask", tag_field="type"):
    """A question."""

    request: Name  # chosen by the browser, random
    text: Annotated[str, msgspec.Meta(max_length=MAX_TEXT)]
    at: Seconds | None = None  # the moment it is about; null: now


class Cancel(msgspec.Struct, frozen=True, kw_only=True, tag="cancel", tag_field="type"):
    """An answer is no longer wanted."""

    request: Name


class SeenScene(msgspec.Struct, frozen=True, kw_only=True, tag="seen", tag_field="type"):
    """A scene has been drawn; missing acknowledgements delay the next scenes."""

    seq: int


class Suggest(msgspec.Struct, frozen=True, kw_only=True, tag="suggest", tag_field="type"):
    """Requests suggestions for another time; the reply is of type suggestions."""

    at: Seconds


Incoming: TypeAlias = Ask | Cancel | Here | SeenScene | Suggest
