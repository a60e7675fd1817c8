"""A passenger's side of the bus: the latest scene, and questions to the service."""

from collections.abc import Callable
from functools import partial
from typing import TypeAlias, TypeVar

from planner.errors import TraceError
from planner.record import trace_reading
from planner.record.trace import PlanTrace
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.interface import Bus, Keys, NoAnswer, Outcome, Refused, TooLate, call
from xavi_dialogue.bus.messages import (
    MAX_TEXT,
    MAX_TURNS,
    AskReply,
    AskRequest,
    CancelRequest,
    EventReport,
    EvidenceRequest,
    Failure,
    ForgetReply,
    ForgetRequest,
    HistoryReply,
    HistoryRequest,
    Message,
    PastTurn,
    SceneReport,
    pack,
    unpack,
)
from xavi_dialogue.bus.sanitize import clean
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.domain.answers import Reason, Unavailable
from xavi_dialogue.nlg.context import SpeechContext, Style
from xavi_dialogue.process.exit_status import RunFault
from xavi_dialogue.runtime import system

DEADLINE = 10.0  # [s] for an answer
GRACE = 0.5  # [s] allowed for the transport of a reply
PATIENCE = 3.0  # [s] for requests that need no planning
NONSENSE = "the dialogue service sent nonsense"
REFUSED = "the dialogue service refused"
POLL = 0.1  # [s] between checks while waiting

T = TypeVar("T")
OnEvent: TypeAlias = Callable[[EventReport], None]


class ServiceLost(RunFault):
    """The service does not answer."""


class Client:
    """One passenger on the bus."""

    def __init__(
        self,
        bus: Bus,
        keys: Keys,
        session: str,
        on_event: OnEvent | None = None,
        *,
        token: str | None = None,
        share: bool = False,
    ) -> None:
        """Begin to listen.

        Args:
            bus: of the car and the service.
            keys: of the car.
            session: name of the conversation.
            on_event: gets events, on a thread of the bus.
            token: of the session, see security.client_token; None: open to all.
            share: whether others may read the session.
        """
        self._token, self._share = token, share
        self.scene: SceneReport | None = None  # the latest
        self._bus, self._keys, self._session = bus, keys, session
        self._changed = system.condition()
        self._latest: EventReport | None = None
        self._on_event = on_event
        bus.subscribe(keys.of("scene"), self._on_scene)
        if on_event is not None:
            bus.subscribe(keys.of("event"), self._on_report, kept=True)

    def now(self) -> float | None:
        """Return the latest time [s] that the passenger has seen; None before the first scene.

        An event may be shown before the next scene is received. The time of the event counts too,
        since a halted car sends no later scene to wait for.
        """
        scene, latest = self.scene, self._latest
        if scene is None:
            return None
        if latest is None or latest.ride != scene.ride or scene.state == "paused":
            return scene.sim_time
        return max(scene.sim_time, latest.sim_time)

    def send(
        self,
        text: str,
        done: Callable[[Reply | ServiceLost], None],
        *,
        at: float | None = None,
        style: Style = "passenger",
        request: str | None = None,
    ) -> None:
        """Send a question; `done` gets the reply or an error, on a thread of the bus.

        If the service does not answer within the deadline, the reply says that it timed out. If the
        service rejects the question, or its answer cannot be read, the reply is in brackets.
        """
        asked = AskRequest(
            request=request or new_request(),
            session=self._session,
            text=text[:MAX_TEXT],
            style=style,
            deadline_ms=DEADLINE * 1000.0,
            at=at,
            token=self._token,
            share=self._share,
        )
        key = self._keys.of("@rpc/ask")

        def settle(came: Outcome) -> None:
            done(_late(at, style) if isinstance(came, TooLate) else _reply(came, at))

        self._bus.request(key, pack(asked), DEADLINE + GRACE, settle)

    def ask(
        self,
        text: str,
        at: float | None = None,
        style: Style = "passenger",
        request: str | None = None,
    ) -> Reply:
        """Ask and wait for the reply; a request of the same name is answered once.

        Raises:
            ServiceLost: there is no reply.
        """
        replies: system.Queue[Reply | ServiceLost] = system.new_queue()
        self.send(text, replies.put, at=at, style=style, request=request)
        reply = replies.get()
        if isinstance(reply, ServiceLost):
            raise reply
        return reply

    def cancel(self, request: str) -> None:
        """Tell the service that an answer is no longer wanted."""
        wanted = CancelRequest(request=request, session=self._session, token=self._token)
        self._bus.request(self._keys.of("@rpc/cancel"), pack(wanted), 1.0, lambda _: None)

    def probe(self) -> None:
        """Check that the service answers at all; wait for its reply.

        Raises:
            ServiceLost: it does not.
        """
        nothing = CancelRequest(request=new_request(), session=self._session, token=self._token)
        try:
            call(self._bus, self._keys.of("@rpc/cancel"), pack(nothing), PATIENCE)
        except Refused:
            return
        except NoAnswer as error:
            raise _lost(error) from error

    def history(self, turns: int = MAX_TURNS) -> tuple[PastTurn, ...]:
        """Return the latest turns of the session, oldest first; waits for them.

        Args:
            turns: greatest number of turns, 1 to 100.

        Raises:
            ServiceLost: there is no reply.
        """
        wanted = HistoryRequest(session=self._session, token=self._token, turns=turns)
        read = partial(unpack, kind=HistoryReply)
        return self._call("@rpc/history", wanted, read).turns

    def evidence(self, trace_id: str) -> PlanTrace:
        """Return a decision of the present ride, or one planned again, by its id; waits for it.

        Raises:
            ServiceLost: there is no reply, or the decision is no longer in the record.
        """
        wanted = EvidenceRequest(request=new_request(), trace_id=trace_id)
        return self._call("@rpc/evidence", wanted, trace_reading.decode)

    def forget(self) -> ForgetReply:
        """Erase the session; wait for the result.

        Raises:
            ServiceLost: the service does not answer, or refuses.
        """
        wanted = ForgetRequest(request=new_request(), session=self._session, token=self._token)
        return self._call("@rpc/forget", wanted, partial(unpack, kind=ForgetReply))

    def _call(self, tail: str, wanted: Message, read: Callable[[bytes], T]) -> T:
        try:
            return read(call(self._bus, self._keys.of(tail), pack(wanted), PATIENCE))
        except (MessageError, TraceError) as error:
            raise ServiceLost(f"{NONSENSE}: {error}") from error
        except NoAnswer as error:
            raise _lost(error) from error

    def wait_for(
        self, wanted: Callable[[SceneReport], bool], going_on: Callable[[], None], patience: float
    ) -> SceneReport | None:
        """Wait for a scene.

        Args:
            wanted: tests a scene.
            going_on: called repeatedly; raises to stop waiting.
            patience: [s] without any new scene after which None is returned.
        """
        give_up = system.monotonic() + patience
        latest = None
        with self._changed:
            while self.scene is None or not wanted(self.scene):
                if self.scene is not latest:
                    latest, give_up = self.scene, system.monotonic() + patience
                if system.monotonic() > give_up:
                    return None
                self._changed.wait(POLL)
                going_on()
            return self.scene

    def _on_scene(self, _: str, payload: bytes) -> None:
        try:
            report = unpack(payload, SceneReport)
        except MessageError:
            return
        with self._changed:
            if self.scene is not None and report.sim_time < self.scene.sim_time:
                self._latest = None  # a recording went back to an earlier time
            self.scene = report
            self._changed.notify_all()

    def _on_report(self, _: str, payload: bytes) -> None:
        try:
            report = unpack(payload, EventReport)
        except MessageError:
            return
        self._latest = report
        if self._on_event is not None:
            self._on_event(report)


def new_request() -> str:
    """Return a name for a request."""
    return system.token(8)


def _reply(came: Outcome, at: float | None) -> Reply | ServiceLost:
    if isinstance(came, Refused):
        failure = _failure(came)
        return _bracketed(
            _refusal(failure), "planner-failed" if failure is None else failure.reason, at
        )
    if isinstance(came, NoAnswer):
        return _lost(came)
    try:
        return unpack(came, AskReply).reply()
    except MessageError as error:
        return _bracketed(f"{NONSENSE}: {error}", "planner-failed", at)


def _bracketed(text: str, reason: Reason, at: float | None) -> Reply:
    """Make a reply that is not an answer of the car; the conversation continues."""
    return Reply(text=f"({clean(text)})", kind="refusal", reason=reason, sim_time=at or 0.0)


def _late(at: float | None, style: Style) -> Reply:
    """Make the reply of a service that missed its deadline."""
    # Imported late: a service that hangs is rare, and wording takes a while to load.
    from xavi_dialogue.nlg.say import say

    said = say(Unavailable("timed-out"), SpeechContext(style=style))
    return Reply(text=said.text, kind="refusal", reason="timed-out", sim_time=at or 0.0)


def _lost(came: NoAnswer) -> ServiceLost:
    if isinstance(came, Refused):
        return ServiceLost(_refusal(_failure(came)))
    return ServiceLost("the dialogue service does not answer")


def _failure(came: Refused) -> Failure | None:
    """Decode the reason for a rejection; None if it cannot be read."""
    try:
        return unpack(came.payload, Failure)
    except MessageError:
        return None


def _refusal(failure: Failure | None) -> str:
    if failure is None:
        return REFUSED
    detail = clean(failure.detail)
    if failure.reason == "out-of-scope" and detail:  # the detail explains itself
        return detail
    return f"{REFUSED}: {detail or failure.reason}"
