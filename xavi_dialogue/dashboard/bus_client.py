"""Requests of a dashboard over the bus, awaited on its event loop."""

import asyncio
from dataclasses import dataclass

from planner.errors import TraceError
from planner.record import trace_reading
from planner.record.trace import PlanTrace
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.interface import Bus, Keys, NoAnswer, Outcome
from xavi_dialogue.bus.messages import EvidenceRequest, HistoryReply, HistoryRequest, pack, unpack
from xavi_dialogue.chat.client import PATIENCE, new_request
from xavi_dialogue.dashboard.web.interfaces import Browsers
from xavi_dialogue.errors import XaviError
from xavi_dialogue.security.client_token import Passenger


class Unanswered(XaviError):
    """A request without an answer, or with one that cannot be read."""


@dataclass(frozen=True)
class BusClient:
    """Requests about one car, as one passenger."""

    bus: Bus
    keys: Keys
    clients: Browsers  # with the event loop on which requests are awaited
    passenger: Passenger

    async def history(self, turns: int) -> HistoryReply:
        """Return the latest turns.

        Raises:
            Unanswered: there is no answer.
        """
        session, token = self.passenger.session, self.passenger.token
        wanted = HistoryRequest(session=session, token=token, turns=turns)
        try:
            return unpack(await self.request("@rpc/history", pack(wanted)), HistoryReply)
        except MessageError as error:
            raise Unanswered(str(error)) from error

    async def evidence(self, trace_id: str) -> PlanTrace:
        """Return a decision of the present ride, or one planned again.

        Raises:
            Unanswered: there is no answer, or the decision is no longer known.
        """
        wanted = EvidenceRequest(request=new_request(), trace_id=trace_id)
        try:
            return trace_reading.decode(await self.request("@rpc/evidence", pack(wanted)))
        except TraceError as error:
            raise Unanswered(str(error)) from error

    async def request(self, tail: str, payload: bytes, patience: float = PATIENCE) -> bytes:
        """Return the reply to a request to a key of the car, within `patience` [s].

        Raises:
            Unanswered: nothing is.
        """
        waiting: asyncio.Future[Outcome] = asyncio.get_running_loop().create_future()

        def settle(outcome: Outcome) -> None:
            if not waiting.done():  # the request was abandoned
                waiting.set_result(outcome)

        done = lambda outcome: self.clients.soon(settle, outcome)  # noqa: E731
        self.bus.request(self.keys.of(tail), payload, patience, done)
        outcome = await waiting
        if isinstance(outcome, NoAnswer):
            raise Unanswered(str(outcome)) from outcome
        return outcome
