"""What a dashboard asks others on the bus for, awaited on its event loop."""

import asyncio
from dataclasses import dataclass

from planner.record import trace as plan_trace
from planner.record.trace import PlanTrace, TraceError
from xavi_dialogue.bus.interface import Bus, Keys, NoAnswer, Outcome
from xavi_dialogue.bus.messages import (
    EvidenceRequest,
    HistoryReply,
    HistoryRequest,
    MessageError,
    pack,
    unpack,
)
from xavi_dialogue.chat.client import PATIENCE, new_request
from xavi_dialogue.dashboard.web.interfaces import Audience
from xavi_dialogue.security.client_token import Passenger


class Unanswered(Exception):
    """There is no answer, or none that can be read."""


@dataclass(frozen=True)
class Asking:
    """Requests about one car, as one passenger."""

    bus: Bus
    keys: Keys
    audience: Audience  # on whose event loop is waited
    passenger: Passenger

    async def history(self, turns: int) -> HistoryReply:
        """The latest so many turns.

        Raises:
            Unanswered: they cannot be had.
        """
        session, token = self.passenger.session, self.passenger.token
        wanted = HistoryRequest(session=session, token=token, turns=turns)
        try:
            return unpack(await self.request("@rpc/history", pack(wanted)), HistoryReply)
        except MessageError as error:
            raise Unanswered(str(error)) from error

    async def evidence(self, trace_id: str) -> PlanTrace:
        """A decision of the present ride, or one planned again.

        Raises:
            Unanswered: it cannot be had, or is not known any more.
        """
        wanted = EvidenceRequest(request=new_request(), trace_id=trace_id)
        try:
            return plan_trace.decode(await self.request("@rpc/evidence", pack(wanted)))
        except TraceError as error:
            raise Unanswered(str(error)) from error

    async def request(self, tail: str, payload: bytes, patience: float = PATIENCE) -> bytes:
        """What is replied to a request to a key of the car, within `patience` [s].

        Raises:
            Unanswered: nothing is.
        """
        waiting: asyncio.Future[Outcome] = asyncio.get_running_loop().create_future()

        def settle(outcome: Outcome) -> None:
            if not waiting.done():  # nobody waits any more
                waiting.set_result(outcome)

        done = lambda outcome: self.audience.soon(settle, outcome)  # noqa: E731
        self.bus.request(self.keys.of(tail), payload, patience, done)
        outcome = await waiting
        if isinstance(outcome, NoAnswer):
            raise Unanswered(str(outcome)) from outcome
        return outcome
