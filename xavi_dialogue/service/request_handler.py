"""Requests of passengers: checked, admitted, and laid on the desk of the car they are about."""

import logging
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import TypeVar

import msgspec

from planner.record import trace as plan_trace
from xavi_dialogue.bus.health import Alive
from xavi_dialogue.bus.interface import Call, vehicle_in
from xavi_dialogue.bus.messages import (
    KIB,
    AskRequest,
    CancelReply,
    CancelRequest,
    EvidenceRequest,
    Failure,
    ForgetReply,
    ForgetRequest,
    HistoryReply,
    HistoryRequest,
    MessageError,
    PastTurn,
    pack,
    unpack,
)
from xavi_dialogue.dialogue.mind import Mind
from xavi_dialogue.domain.answers import Reason
from xavi_dialogue.service.ownership import UNKNOWN, Owners
from xavi_dialogue.service.requests import Question
from xavi_dialogue.service.vehicle_session import Desk
from xavi_dialogue.storage.turn_log import Memory

_LOG = logging.getLogger(__name__)
MAX_CARS = 64  # that are known of; of those that are gone, the one heard of first is dropped first
MAX_AGAIN = 8  # times that a request may come again while it is open
MAX_OPEN = 4  # questions of a session
MAX_EARLY = 500  # questions about one car that wait for the record: others need not wait for these
HOPE = 0.7  # share of its deadline that a question may have to wait for its turn; see Reception.ask
LEARNT = 0.1  # weight of the latest question in the pace
UNREADABLE = "whose conversation this is cannot be read at the moment; ask again soon"
UNHEARD = "no decision of this ride that is still remembered has this id"
FOREIGN = "this conversation belongs to somebody else; begin another with --session NAME"

Told = TypeVar("Told", AskRequest, HistoryRequest, ForgetRequest, CancelRequest, EvidenceRequest)
Wanted = TypeVar("Wanted", AskRequest, HistoryRequest, ForgetRequest, CancelRequest)


class Refusal(Exception):
    """A request is not taken up."""

    def __init__(self, reason: Reason, detail: str) -> None:
        super().__init__(detail)
        self.failure = Failure(reason=reason, detail=detail)


@dataclass
class Reception:
    """Takes requests, one at a time."""

    mind: Mind
    memory: Memory
    owners: Owners
    alive: Alive
    repeat: Callable[[str, AskRequest], bytes | None]  # what was replied not long ago
    forgotten: Callable[[str], None]  # is told of a session that is no more
    desks: dict[str, Desk] = field(default_factory=dict)  # by car
    pace: float = 0.0  # [s] that a question takes, on a running average

    def __post_init__(self) -> None:
        self.nowhere = Desk("nowhere", self.mind)  # of all cars that were never heard of

    def desk(self, vehicle: str) -> Desk:
        """The desk of a car.

        Raises:
            Refusal: there are too many cars.
        """
        if vehicle not in self.desks:
            if len(self.desks) >= MAX_CARS:
                self._make_room()
            self.desks[vehicle] = Desk(vehicle, self.mind)
        return self.desks[vehicle]

    def all_desks(self) -> list[Desk]:
        """Those of cars, and that of all others."""
        return [*self.desks.values(), self.nowhere]

    def waiting(self) -> int:
        """How many questions are open."""
        return sum(len(desk.waiting.open) for desk in self.all_desks())

    def ready(self) -> int:
        """How many questions wait for nothing but their turn."""
        return sum(desk.waiting.ready for desk in self.all_desks())

    def learn(self, taken: float) -> None:
        """Learn how long [s] a question took."""
        self.pace += LEARNT * (taken - self.pace)

    def ask(self, call: Call, came: float) -> None:
        """Lay a question on the desk, if its turn can be hoped to come in time.

        Else it is told so at once: when more is asked than can be answered, a queue that grows
        makes everybody late.

        Args:
            call: the question.
            came: when it came in [s], on the monotonic clock.

        Raises:
            Refusal: it is not taken up.
        """
        desk, asked = self._admitted(call, AskRequest)
        if (known := desk.waiting.open.get((asked.session, asked.request))) is not None:
            if known.asked == asked and len(known.again) < MAX_AGAIN:
                known.again.append(call)  # it came twice, and is answered once
                return
            raise Refusal("busy", "a request of this name is open in this session")
        if (said := self.repeat(desk.vehicle, asked)) is not None:
            call.reply(said)
            return
        wait = self.pace * self.ready()
        early = len(desk.waiting.open) - desk.waiting.ready >= MAX_EARLY and desk.is_early(asked)
        late = wait > HOPE * asked.deadline_ms / 1000.0
        if early or late or len(desk.waiting.of(asked.session)) >= MAX_OPEN:
            raise Refusal("busy", "too many questions are waiting; ask again in a moment")
        self._know(desk, asked.session)
        self._claim(asked)
        desk.take(Question(call, asked, came))

    def cancel(self, call: Call) -> None:
        """Drop a question.

        Raises:
            Refusal: the request is not taken up.
        """
        desk, wanted = self._admitted(call, CancelRequest)
        dropped = desk.cancel(wanted)
        if dropped is not None:
            dropped.drop()
        call.reply(pack(CancelReply(request=wanted.request, cancelled=dropped is not None)))

    def forget(self, call: Call) -> None:
        """Erase a session.

        Raises:
            Refusal: the request is not taken up.
        """
        _, wanted = self._admitted(call, ForgetRequest, erasing=True)
        known = self.put_away(wanted.session)
        erased = self.memory.forget(wanted.session)
        self.owners.release(wanted.session)
        reply = ForgetReply(
            request=wanted.request,
            session=wanted.session,
            turns=known if erased is None else max(erased, known),
            forgotten=erased is not None,
        )
        call.reply(pack(reply))

    def put_away(self, session: str) -> int:
        """Forget what is in memory of a session; how many turns of it were known."""
        known = 0
        for desk in self.all_desks():  # it may have been about several cars
            turns, dropped = desk.forget(session)
            known += turns
            for question in dropped:
                question.drop()
        self.forgotten(session)
        return known

    def history(self, call: Call, seq: int) -> None:
        """Tell what was said in a session.

        Raises:
            Refusal: the request is not taken up.
        """
        desk, wanted = self._admitted(call, HistoryRequest)
        past = desk.past.get(wanted.session)
        turns = self.memory.recall(wanted.session) if past is None else past
        shown = (PastTurn(turn.text, turn.reply) for turn in turns[-wanted.turns :])
        scene = None if desk.ledger is None else desk.ledger.scene
        reply = HistoryReply(
            session=wanted.session,
            seq=seq,
            sim_time=0.0 if scene is None else scene.sim_time,
            wall_time=time.time(),
            total=len(turns),
            turns=latest(shown, HistoryReply.LIMIT - KIB),
        )
        call.reply(pack(reply))

    def evidence(self, call: Call) -> None:
        """Tell a decision of the present ride, or what was planned from one again.

        Raises:
            Refusal: the request is not taken up, or there is no such decision.
        """
        vehicle, wanted = self._read(call, EvidenceRequest)
        found = self.desks.get(vehicle, self.nowhere).decision(wanted.trace_id)
        if found is None:
            raise Refusal("outside-record", UNHEARD)
        call.reply(plan_trace.encode(found))

    def _admitted(
        self, call: Call, kind: type[Wanted], *, erasing: bool = False
    ) -> tuple[Desk, Wanted]:
        """The desk and the request, of somebody who may make it.

        Raises:
            Refusal: it cannot be read, or the session belongs to somebody else.
        """
        vehicle, wanted = self._read(call, kind)
        begun = erasing or self._is_begun(wanted.session)
        if not self.owners.admits(wanted.session, wanted.token, begun=begun):
            if self.owners.of(wanted.session) == UNKNOWN:
                raise Refusal("busy", UNREADABLE)
            self.alive.count("foreign")
            _LOG.warning("a wrong token", extra={"vehicle": vehicle, "session": wanted.session})
            raise Refusal("out-of-scope", FOREIGN)
        return self.desks.get(vehicle, self.nowhere), wanted

    def _read(self, call: Call, kind: type[Told]) -> tuple[str, Told]:
        """The car that a request is about, and the request.

        Raises:
            Refusal: it cannot be read.
        """
        vehicle = vehicle_in(call.key)
        if vehicle is None:
            raise Refusal("not-understood", "name one car in the key")
        try:
            return vehicle, unpack(call.payload, kind)
        except MessageError as error:
            self.alive.count("rejected")
            raise Refusal("not-understood", str(error)) from error

    def _claim(self, asked: AskRequest) -> None:
        """Let a session belong to whoever begins it; one that was begun as open remains so."""
        if not self._is_begun(asked.session):
            desks = self.all_desks()
            held = lambda: {session for desk in desks for session in desk.past}  # noqa: E731
            self.owners.claim(asked.session, asked.token, held)

    def _is_begun(self, session: str) -> bool:
        """Whether anything of a session is in memory."""
        desks = self.all_desks()
        return any(desk.past.get(session) or desk.waiting.of(session) for desk in desks)

    def _know(self, desk: Desk, session: str) -> None:
        """Make sure that the desk knows what was said in a session before."""
        if session not in desk.past:
            desk.resume(session, self.memory.recall(session))

    def _make_room(self) -> None:
        for vehicle, desk in self.desks.items():
            if not desk.car_alive and not desk.waiting.open:
                del self.desks[vehicle]
                return
        raise Refusal("busy", f"this service talks about {MAX_CARS} cars already")


def latest(turns: Iterable[PastTurn], limit: int) -> tuple[PastTurn, ...]:
    """As many of the latest turns as have so many bytes."""
    kept: list[PastTurn] = []
    taken = 0
    for turn in reversed([*turns]):
        taken += len(msgspec.json.encode(turn)) + 1
        if taken > limit:
            break
        kept.append(turn)
    return tuple(reversed(kept))
