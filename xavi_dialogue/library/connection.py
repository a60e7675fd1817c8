"""A car on a bus that can be asked, from programs that wait and from those that do not."""

import asyncio
from contextlib import ExitStack, suppress
from datetime import datetime
from functools import cached_property
from pathlib import Path
from secrets import token_hex
from types import TracebackType
from typing import Self

from planner.record.trace import PlanTrace
from planner.record.trace_reading import LATEST
from sim.roads.netfile import NetworkError
from sim.roads.network import Network
from xavi_dialogue.bus.interface import Keys, NoAnswer, call
from xavi_dialogue.bus.link import Link
from xavi_dialogue.chat.client import Client, ServiceLost, new_request
from xavi_dialogue.chat.remote_backend import BRIEFLY, RemoteBackend, RemoteCar, meet
from xavi_dialogue.dashboard.views import map as roads
from xavi_dialogue.dashboard.views.evidence import traces_of
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.library.answers import Answer, answer, told_so_far
from xavi_dialogue.library.arguments import check_style, path_of, question_of, real
from xavi_dialogue.library.decisions import Decision
from xavi_dialogue.library.errors import LibraryError
from xavi_dialogue.library.trajectories import compared
from xavi_dialogue.nlg.context import Style
from xavi_dialogue.security.client_token import Passenger, default_path, own_secret, token_of
from xavi_dialogue.security.preflight import check
from xavi_dialogue.storage import resume
from xavi_dialogue.vehicle.map_server import NETWORK

ROADS_PATIENCE = 5.0  # [s] for a car to send its roads
MOMENTS = f"a time [s] of the ride, 0 to {LATEST:g}"
PATIENCES = f"seconds from 0 to {LATEST:g}"


class Car:
    """A car on a bus, and one conversation with it; `connect` makes it.

    It is a context manager, with `with` or `async with`, that takes leave of the bus at its end.
    """

    def __init__(self, there: RemoteCar, session: str, patience: float) -> None:
        """Join the bus.

        Raises:
            XaviError: see `connect`.
        """
        self.vehicle = there.vehicle
        self.session = session
        self.answers: tuple[Answer, ...] = ()
        self._stack = ExitStack()
        secret = own_secret(default_path())
        passenger = Passenger(session, token_of(secret, session))
        met: tuple[RemoteBackend, Client] = self._stack.enter_context(
            meet(there, passenger, patience)
        )
        self._backend, self._client = met

    @property
    def now(self) -> float | None:
        """The latest time [s] of the ride that is known."""
        return self._client.now()

    def ask(self, question: str, at: float | None = None, style: Style = "passenger") -> Answer:
        """Return the answer to a question, which may refer to those before.

        Args:
            question: in plain English.
            at: [s] the time that it is about. Default: now.
            style: `passenger`, or `paper` for the wording of the paper.

        Raises:
            XaviError: there is no such time or style, the service does not answer, or the
                connection is closed.
        """
        text, time = self._asked(question, at, style)
        return self._answer(text, self._client.ask(text, time, style))

    async def ask_async(
        self, question: str, at: float | None = None, style: Style = "passenger"
    ) -> Answer:
        """Do the same as `ask` without blocking; a task that is cancelled takes it back.

        Raises:
            XaviError: see `ask`.
        """
        text, time = self._asked(question, at, style)
        request = new_request()
        loop = asyncio.get_running_loop()
        coming: asyncio.Future[Reply | ServiceLost] = loop.create_future()

        def settle(came: Reply | ServiceLost) -> None:
            if not coming.done():
                coming.set_result(came)

        def done(came: Reply | ServiceLost) -> None:
            with suppress(RuntimeError):  # the loop is closed: nobody waits any more
                loop.call_soon_threadsafe(settle, came)

        self._client.send(text, done, at=time, style=style, request=request)
        try:
            came = await coming
        except asyncio.CancelledError:
            self._client.cancel(request)
            raise
        if isinstance(came, ServiceLost):
            raise came
        return await asyncio.to_thread(self._answer, text, came)

    def close(self) -> None:
        """Take leave of the bus; doing so twice has no effect."""
        self._stack.close()

    @cached_property
    def network(self) -> Network | None:
        """The roads, if the car tells them."""
        try:
            packed = call(self._backend.bus, Keys(self.vehicle).of(NETWORK), b"", ROADS_PATIENCE)
            return roads.read(packed)[0]
        except (NoAnswer, NetworkError):
            return None

    def _asked(self, question: str, at: float | None, style: Style) -> tuple[str, float | None]:
        """Return a question and its time [s] as they are sent.

        Raises:
            LibraryError: there is no such question, time or style, or no connection.
        """
        text = question_of(question)
        check_style(style)
        time = None if at is None else real(at, "at", MOMENTS)
        if time is not None and not 0.0 <= time <= LATEST:
            raise LibraryError(f"at is {at!r}; give {MOMENTS}")
        if not self._backend.bus.linked:
            raise LibraryError("there is no connection to the bus; connect again")
        return text, time

    def _answer(self, question: str, reply: Reply) -> Answer:
        own = () if reply.trace_id is None else (reply.trace_id,)
        wanted = dict.fromkeys((*own, *traces_of(reply)))
        traces = {name: found for name in wanted if (found := self._trace(name)) is not None}
        lines = compared(reply, traces.values())
        taken = traces.get(reply.trace_id or "")
        decision = None if taken is None else Decision(taken, self.network)
        told = answer(question, reply, decision, lines)
        self.answers = (*self.answers, told)
        return told

    def _trace(self, name: str) -> PlanTrace | None:
        try:
            return self._client.evidence(name)
        except ServiceLost:  # no longer in the record
            return None

    def __repr__(self) -> str:
        return f"<Car {self.vehicle}, conversation {self.session}>"

    def _repr_html_(self) -> str:
        return told_so_far(self, self.answers)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await asyncio.to_thread(self.close)


def connect(
    endpoint: str | None = None,
    vehicle: str = "car",
    session: str | None = None,
    zenoh: str | Path | None = None,
    patience: float = BRIEFLY,
) -> Car:
    """Join a car that is under way, and begin or go on with a conversation.

    Args:
        endpoint: of the hub, such as `tcp/127.0.0.1:7447`. Default: the local one.
        vehicle: the name of the car.
        session: of a conversation of yours to go on with. Default: a new one.
        zenoh: a Zenoh configuration with the key of a passenger, from `xavi keys`.
        patience: [s] to wait for each of hub, service and car.

    Raises:
        XaviError: there is no hub, service or car, or the key may not ask.
    """
    _check(endpoint or "", vehicle, session or "", patience)
    link = Link.to_hub(endpoint, None if zenoh is None else path_of(zenoh, "zenoh"))
    check(link, "ask")
    name = session or resume.fresh(datetime.now().astimezone(), token_hex(2)).session
    return Car(RemoteCar(link, vehicle), name, patience)


def _check(endpoint: object, vehicle: object, session: object, patience: object) -> None:
    """Check the kinds of arguments.

    Raises:
        LibraryError: one of them is of another kind.
    """
    for name, given in (("endpoint", endpoint), ("vehicle", vehicle), ("session", session)):
        if not isinstance(given, str):
            raise LibraryError(f"{name} is {given!r}; give a text")
    if not 0.0 <= real(patience, "patience", PATIENCES) <= LATEST:
        raise LibraryError(f"patience is {patience!r}; give {PATIENCES}")


async def connect_async(
    endpoint: str | None = None,
    vehicle: str = "car",
    session: str | None = None,
    zenoh: str | Path | None = None,
    patience: float = BRIEFLY,
) -> Car:
    """Do the same as `connect` without blocking.

    Raises:
        XaviError: see `connect`.
    """
    return await asyncio.to_thread(connect, endpoint, vehicle, session, zenoh, patience)
