"""Several services on one bus: each answers about its own cars, and the first one about a car."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from tests.dialogue.scripted import scripted_pipeline
from tests.fakes import s1_moments
from xavi_dialogue.bus.interface import Bus, Keys, NoAnswer, Outcome, vehicle_in
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import (
    AliveReport,
    AskReply,
    AskRequest,
    ForgetReply,
    ForgetRequest,
    Message,
    pack,
    unpack,
)
from xavi_dialogue.bus.shards import Shard, home
from xavi_dialogue.service.membership import Place
from xavi_dialogue.service.server import Service
from xavi_dialogue.storage.turn_log import Retention, TurnLog
from xavi_dialogue.vehicle.telemetry import Reporter

CARS = tuple(f"shuttle-{number}" for number in range(6))


@dataclass
class Fleet:
    """Services on one hub."""

    folder: Path
    hub: MemoryHub = field(default_factory=MemoryHub)
    services: list[Service] = field(default_factory=list)
    buses: list[Bus] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def serve(self, shard: Shard) -> Service:
        bus = self.hub.connect()
        file = self.folder / f"{len(self.services)}.sqlite3"
        memory = TurnLog(Retention(file, days=1))
        service = Service(bus, scripted_pipeline(), memory, Place(shard), self.notes.append)
        service.open()
        self.services.append(service)
        self.buses.append(bus)
        return service

    def work(self) -> None:
        for service in self.services:
            service.work()

    def drive(self, vehicle: str) -> None:
        car, keys = self.hub.connect(), Keys(vehicle)
        car.appear(keys.of("alive/car"))
        self.work()
        reporter = Reporter(car, keys, "s1", 4)
        for moment in s1_moments():
            reporter.record(moment)
            reporter.show(moment, "driving", 1.0)
            if moment.scene.time >= 1.0:
                break
        self.work()

    def call(self, vehicle: str, tail: str, wanted: Message | None = None) -> list[Outcome]:
        came: list[Outcome] = []
        payload = b"" if wanted is None else pack(wanted)
        self.hub.connect().request(Keys(vehicle).of(tail), payload, 1.0, came.append)
        self.work()
        return came

    def ask(self, vehicle: str, session: str = "ann") -> list[Outcome]:
        name = f"r{len(self.services)}-{vehicle}-{session}"
        wanted = AskRequest(request=name, session=session, text="answer")
        return self.call(vehicle, "@rpc/ask", wanted)

    def shown(self) -> set[str | None]:
        """The cars that a service shows itself at."""
        return {vehicle_in(key) for key in self.hub.alive if key.endswith("/alive/service")}


@pytest.fixture
def fleet(tmp_path: Path) -> Fleet:
    return Fleet(tmp_path)


def kind(came: list[Outcome]) -> str:
    [outcome] = came
    return (
        type(outcome).__name__ if isinstance(outcome, NoAnswer) else unpack(outcome, AskReply).kind
    )


def test_each_shard_answers_about_its_own_cars(fleet: Fleet) -> None:
    shards = [fleet.serve(Shard(number, 3)) for number in (1, 2, 3)]
    for car in CARS:
        fleet.drive(car)
    assert [kind(fleet.ask(car)) for car in CARS] == ["answer"] * len(CARS)
    for number, service in enumerate(shards, 1):
        assert {*service.handler.vehicles} == {car for car in CARS if home(car, 3) == number}
    assert fleet.shown() - {"car"} == {*CARS}
    assert fleet.notes == []


def test_nobody_answers_about_the_cars_of_a_shard_that_is_missing(fleet: Fleet) -> None:
    fleet.serve(Shard(1, 2))
    for car in CARS:
        fleet.drive(car)
    wanted = ["answer" if home(car, 2) == 1 else "TooLate" for car in CARS]
    assert [kind(fleet.ask(car)) for car in CARS] == wanted


def test_the_second_service_says_so_and_is_silent_until_the_first_is_gone(fleet: Fleet) -> None:
    first, second = fleet.serve(Shard()), fleet.serve(Shard())
    fleet.drive("car")
    assert kind(fleet.ask("car")) == "answer"
    assert first.alive.counted("questions") == 1.0
    assert second.alive.counted("questions") == 0.0
    assert len(fleet.notes) == 1
    assert "silent" in fleet.notes[0]
    fleet.buses[0].close()
    fleet.services.remove(first)
    second.work()
    assert len(fleet.notes) == 2
    assert "is gone" in fleet.notes[1]
    assert kind(fleet.ask("car", "bob")) == "answer"
    assert second.alive.counted("questions") == 1.0
    assert fleet.shown() == {"car"}


def test_a_service_of_all_cars_is_silent_about_those_of_an_earlier_shard(fleet: Fleet) -> None:
    part, rest = fleet.serve(Shard(1, 2)), fleet.serve(Shard())
    for car in CARS:
        fleet.drive(car)
        assert kind(fleet.ask(car)) == "answer"
    own = sum(home(car, 2) == 1 for car in CARS)
    assert part.alive.counted("questions") == own
    assert rest.alive.counted("questions") == len(CARS) - own


def test_who_answers_about_a_car_tells_how_it_fares(fleet: Fleet) -> None:
    for number in (1, 2):
        fleet.serve(Shard(number, 2))
    for car in CARS:
        fleet.drive(car)
    for car in CARS:
        [outcome] = fleet.call(car, "alive/service")
        assert isinstance(outcome, bytes)
        cars = unpack(outcome, AliveReport).counters["cars"]
        assert cars == sum(home(one, 2) == home(car, 2) for one in CARS)


def test_a_session_is_erased_in_every_shard(fleet: Fleet) -> None:
    for number in (1, 2):
        fleet.serve(Shard(number, 2))
    one, other = (next(car for car in CARS if home(car, 2) == number) for number in (1, 2))
    for car in (one, other):
        fleet.drive(car)
        assert kind(fleet.ask(car)) == "answer"
    [outcome] = fleet.call(one, "@rpc/forget", ForgetRequest(request="f", session="ann"))
    assert isinstance(outcome, bytes)
    assert unpack(outcome, ForgetReply).forgotten
    for number, service in enumerate(fleet.services):
        assert all("ann" not in vehicle.past for vehicle in service.handler.all_vehicles())
        service._memory.close()
        assert b"ann" not in (fleet.folder / f"{number}.sqlite3").read_bytes()


def test_a_shard_hears_a_car_no_more_that_it_does_not_remember(fleet: Fleet) -> None:
    service = fleet.serve(Shard(1, 2))
    mine = next(car for car in CARS if home(car, 2) == 1)
    heard: Callable[[], int] = lambda: sum(map(len, fleet.hub.subscribers.values()))  # noqa: E731
    before = heard()
    service.membership.follow(mine)
    assert heard() == before + 3
    service.membership.keep(())
    assert heard() == before
