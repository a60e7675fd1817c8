"""A dashboard's board between a bus and browsers, all within one process."""

import asyncio
import threading
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import Any, TypeVar

import msgspec
import pytest

from tests.fakes import s1_moments
from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.chat.client import Client
from xavi_dialogue.dashboard.controller import Controller
from xavi_dialogue.dashboard.web import websocket_messages as wire
from xavi_dialogue.security.client_token import Passenger
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.service.server import Service
from xavi_dialogue.vehicle.telemetry import Reporter

KEYS = Keys()
PATIENCE = 20.0  # [s]
T = TypeVar("T", bound=wire.Outgoing)


@dataclass
class Browsers:
    """All browsers, or one: remembers what it is told."""

    told: list[wire.Outgoing] = field(default_factory=list)
    browsers: int = 1

    def tell(self, message: wire.Outgoing) -> None:
        self.told.append(message)

    def soon(self, function: Callable[..., None], *arguments: Any) -> None:
        self.loop.call_soon_threadsafe(function, *arguments)

    def of(self, kind: type[T]) -> list[T]:
        return [one for one in self.told if isinstance(one, kind)]

    async def until(self, found: Callable[[], object]) -> None:
        self.loop = asyncio.get_running_loop()
        async with asyncio.timeout(PATIENCE):
            while not found():
                await asyncio.sleep(0.01)


@dataclass
class Setting:
    """A board on a bus with a service and a car."""

    hub: MemoryHub
    controller: Controller
    all: Browsers

    def drive(self, until: float = 7.0) -> None:
        car = self.hub.connect()
        car.appear(KEYS.of("alive/car"))
        reporter = Reporter(car, KEYS, "s1", 4)
        for moment in s1_moments():
            reporter.record(moment)
            reporter.show(moment, "ended" if moment.ending else "driving", 1.0)
            if moment.scene.time >= until:
                break

    async def ask(self, text: str, at: float | None = None) -> wire.AnsweredHere:
        one = Browsers()
        self.controller.ask(one, wire.Ask(request=f"r{len(text)}", text=text, at=at))  # type: ignore[arg-type]
        await self.all.until(lambda: one.of(wire.AnsweredHere))
        return one.of(wire.AnsweredHere)[0]


@asynccontextmanager
async def running(*, served: bool = True, session: str = "ada") -> AsyncIterator[Setting]:
    hub, everybody = MemoryHub(), Browsers()
    everybody.loop = asyncio.get_running_loop()
    controller = Controller(KEYS, Passenger(session, "t" * 20))
    controller.attach(everybody)
    over = threading.Event()
    serving = threading.Thread(target=lambda: _serve(hub, over))
    if served:
        serving.start()
        await everybody.until(lambda: KEYS.of("alive/service") in hub.alive)
    controller.join(hub.connect())
    watching = asyncio.get_running_loop().create_task(controller.watch())
    try:
        yield Setting(hub, controller, everybody)
    finally:
        watching.cancel()
        over.set()
        if served:
            await asyncio.to_thread(serving.join)


def _serve(hub: MemoryHub, over: threading.Event) -> None:
    service = Service(hub.connect(), make_pipeline())
    service.open()
    while not over.is_set():
        service.work(0.05)


def runs(test: Callable[[], Awaitable[None]]) -> None:
    asyncio.run(test())  # type: ignore[arg-type]


def test_a_question_becomes_a_turn_that_all_see() -> None:
    async def test() -> None:
        async with running() as here:
            here.drive()
            answered = await here.ask("Why did you chnage lanes?")
            assert answered.n == 0
            assert answered.reply is None
            [turns] = here.all.of(wire.Turns)
            [turn] = turns.turns
            assert (turn.n, turn.text) == (0, "Why did you chnage lanes?")
            assert turn.reply.kind == "answer"
            assert 1 in turn.vehicles

    runs(test)


def test_what_is_asked_elsewhere_is_seen_here() -> None:
    async def test() -> None:
        async with running() as here:
            here.drive()
            await here.ask("What are you doing?")
            terminal = Client(here.hub.connect(), KEYS, "ada", token="t" * 20)
            await asyncio.to_thread(terminal.ask, "Where are you going?")
            seen = lambda: [t.text for one in here.all.of(wire.Turns) for t in one.turns]  # noqa: E731
            await here.all.until(lambda: len(seen()) == 2)
            assert seen() == ["What are you doing?", "Where are you going?"]

    runs(test)


def test_evidence_and_decisions_can_be_fetched() -> None:
    async def test() -> None:
        async with running() as here:
            here.drive()
            answered = await here.ask("Why did you change lanes?")
            assert answered.n is not None
            document = await here.controller.evidence(answered.n)
            assert document is not None
            evidence = msgspec.json.decode(document)
            assert evidence["counterfactual"] is not None
            [decisions] = [
                one for one in here.controller.record.all() if isinstance(one, wire.Decisions)
            ]
            for decision in decisions.decisions:
                found = here.controller.decision(decision.id)
                assert found is not None
                assert msgspec.json.decode(found)["id"] == decision.id
            assert here.controller.decision("unknown") is None
            assert await here.controller.evidence(99) is None
            assert msgspec.json.decode(here.controller.past())["scenes"]

    runs(test)


def test_an_earlier_moment_can_be_asked_about() -> None:
    async def test() -> None:
        async with running() as here:
            here.drive()
            await here.ask("What are you doing?", at=2.0)
            [turns] = here.all.of(wire.Turns)
            assert turns.turns[0].reply.sim_time == 2.0

    runs(test)


def test_without_a_service_a_question_is_answered_with_that() -> None:
    async def test() -> None:
        async with running(served=False) as here:
            answered = await here.ask("Hello?")
            assert answered.n is None
            assert answered.reply is not None
            assert answered.reply.reason == "planner-unavailable"

    runs(test)


def test_a_conversation_of_somebody_else_is_not_shown() -> None:
    async def test() -> None:
        async with running() as here:
            here.drive()
            other = Client(here.hub.connect(), KEYS, "bob", token="u" * 20)
            await asyncio.to_thread(other.ask, "Where are you going?")
            await here.controller.refresh()
            assert here.all.of(wire.Turns) == []

        async with running(session="bob") as here:
            here.drive()
            other = Client(here.hub.connect(), KEYS, "bob", token="u" * 20)
            await asyncio.to_thread(other.ask, "Where are you going?")
            answered = await here.ask("Where are you going?")
            assert answered.n is None
            assert answered.reply is not None
            assert "somebody else" in answered.reply.text
            assert here.controller.conversation.turns == []

    runs(test)


def test_who_is_there_is_told_when_it_changes() -> None:
    async def test() -> None:
        async with running() as here:
            await here.all.until(lambda: here.all.of(wire.Status))
            assert here.all.of(wire.Status)[-1].car == "awaited"
            here.drive()
            await here.all.until(lambda: here.all.of(wire.Status)[-1].car == "there")
            await here.all.until(lambda: here.all.of(wire.Status)[-1].hub == "there")
            told = len(here.all.of(wire.Status))
            here.hub.tell(KEYS.of("alive/car"), False)
            await here.all.until(lambda: here.all.of(wire.Status)[-1].car == "gone")
            assert len(here.all.of(wire.Status)) == told + 1

    runs(test)


def test_who_comes_is_told_everything_and_the_ride_may_begin() -> None:
    async def test() -> None:
        async with running() as here:
            begun: list[bool] = []
            here.controller.first_seen = lambda: begun.append(True)
            here.drive()
            await here.all.until(lambda: here.controller.record.scene is not None)
            one = Browsers()
            kinds = [type(message) for message in here.controller.greet(one)]  # type: ignore[arg-type]
            assert kinds[:2] == [wire.Welcome, wire.Status]
            assert {wire.Ride, wire.Decisions, wire.Events, wire.SceneShown} <= set(kinds)
            assert begun == [True]

    runs(test)


def test_a_car_that_is_coming_is_shown_once_it_is_there() -> None:
    async def test() -> None:
        async with running() as here:
            coming = [True]
            here.controller.coming = lambda: coming[0]
            here.drive(until=5.0)
            await here.all.until(lambda: here.controller.record.scene is not None)
            one = Browsers()
            kinds = [type(message) for message in here.controller.greet(one)]  # type: ignore[arg-type]
            assert wire.Ride not in kinds
            assert here.controller.status().car == "coming"
            assert here.all.of(wire.SceneShown) == here.all.of(wire.Ride) == []
            coming[0] = False
            here.drive()
            await here.all.until(lambda: here.all.of(wire.Ride))
            told = [type(message) for message in here.all.told]
            assert told.index(wire.Ride) < told.index(wire.Decisions) < told.index(wire.SceneShown)
            assert here.controller.status().car == "there"

    runs(test)


@pytest.mark.parametrize("payload", [b"", b"{}", b"\xff", b'{"schema": "xavi.scene/1"}'])
def test_nonsense_on_the_bus_is_counted_and_left_at_that(payload: bytes) -> None:
    async def test() -> None:
        async with running() as here:
            for key in ("scene", "trace", "event"):
                here.hub.connect().send(KEYS.of(key), payload)
            here.drive()
            await here.all.until(lambda: here.controller.record.scene is not None)
            assert here.controller.alive.counted("rejected") == 3

    runs(test)
