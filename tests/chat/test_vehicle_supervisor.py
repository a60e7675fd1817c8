"""A car whose program ends is driven again to where it was, on a bus within one process."""

import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

import pytest

from tests.fakes import EGO
from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import CarState, SceneReport, pack
from xavi_dialogue.chat import vehicle_supervisor
from xavi_dialogue.chat.client import Client
from xavi_dialogue.chat.vehicle_supervisor import AGAIN, NO_MORE, STANDING, VehicleSupervisor
from xavi_dialogue.process import child_commands
from xavi_dialogue.process.subprocesses import ChildFailed, OptionalChild
from xavi_dialogue.terminal.slash_commands import CommandError

KEYS = Keys()
PATIENCE = 10.0  # [s] before a test gives up on what never comes


def until(condition: Callable[[], bool]) -> bool:
    give_up = time.monotonic() + PATIENCE
    while time.monotonic() < give_up:
        if condition():
            return True
        time.sleep(0.01)
    return False


@dataclass
class FakeProcess:
    """A car that shows a scene when it is told to; see Child."""

    hub: MemoryHub
    ride: str
    ordered: int = 0
    orders: list[child_commands.Order] = field(default_factory=list)
    failed: bool = False
    stopped: bool = False

    def order(self, order: child_commands.Order) -> int:
        self.check()
        self.ordered += 1
        self.orders.append(order)
        return self.ordered

    def check(self) -> None:
        if self.failed:
            raise ChildFailed("the car has ended (signal 9)")

    def kill(self) -> None:
        self.failed = True

    def stop(self) -> None:
        self.stopped = True

    def show(self, at: float, state: CarState, obeyed: int | None = None) -> None:
        report = SceneReport(
            ride=self.ride,
            seq=0,
            sim_time=at,
            wall_time=0.0,
            vehicles={0: EGO},
            state=state,
            speed_factor=1.0,
            plan=(),
            traces=0,
            events=0,
            orders=self.ordered if obeyed is None else obeyed,
        )
        self.hub.connect().publisher(KEYS.of("scene")).put(pack(report))


@dataclass
class Garage:
    """Starts cars, and what the passenger was told of it."""

    hub: MemoryHub = field(default_factory=MemoryHub)
    started: list[FakeProcess] = field(default_factory=list)
    told: list[str] = field(default_factory=list)

    def start(self) -> FakeProcess:
        self.started.append(FakeProcess(self.hub, f"r{len(self.started)}"))
        return self.started[-1]

    def again(self, number: int) -> FakeProcess:
        """The car that was started anew for so manyeth time, once it has its orders."""
        assert until(lambda: len(self.started) > number and self.started[number].ordered == 2)
        return self.started[number]


@pytest.fixture
def garage() -> Garage:
    return Garage()


@pytest.fixture
def client(garage: Garage) -> Client:
    return Client(garage.hub.connect(), KEYS, "ada")


@pytest.fixture
def car(
    garage: Garage, client: Client, monkeypatch: pytest.MonkeyPatch
) -> Iterator[VehicleSupervisor]:
    monkeypatch.setattr(vehicle_supervisor, "POLL", 0.01)
    with VehicleSupervisor(garage.start, 1.0, garage.told.append) as car:  # type: ignore[arg-type]
        yield car
    assert garage.started[-1].stopped


def ride(car: VehicleSupervisor, garage: Garage, client: Client) -> FakeProcess:
    """A ride that is under way."""
    first = garage.started[0]
    first.show(0.0, "paused")
    car.follow(client)
    car.order(child_commands.Speed(4.0))
    car.order(child_commands.Resume())
    first.show(8.0, "driving")
    return first


def test_a_car_that_never_was_on_the_road_is_not_started_anew(
    car: VehicleSupervisor, garage: Garage
) -> None:
    garage.started[0].kill()
    with pytest.raises(ChildFailed, match="signal 9"):
        car.check()
    with pytest.raises(ChildFailed, match="signal 9"):
        car.order(child_commands.Resume())
    assert len(garage.started) == 1


def test_the_ride_is_driven_to_where_it_was_and_then_on_as_wished(
    car: VehicleSupervisor, garage: Garage, client: Client
) -> None:
    first = ride(car, garage, client)
    first.kill()
    second = garage.again(1)
    assert first.stopped
    assert garage.told == [AGAIN]
    assert second.orders == [child_commands.Speed(0.0), child_commands.Until(8.0)]
    second.show(2.0, "driving", obeyed=2)
    assert not car.obeyed(client.scene)  # type: ignore[arg-type]
    assert car.catching_up
    assert car.now(client.now()) == 8.0  # the passenger thinks of what was told
    second.show(8.0, "paused", obeyed=2)
    assert until(lambda: not car.catching_up)
    assert second.orders[2:] == [child_commands.Speed(4.0), child_commands.Resume()]
    assert not car.obeyed(client.scene)  # type: ignore[arg-type]
    second.show(8.1, "driving")
    assert car.obeyed(client.scene)  # type: ignore[arg-type]
    assert car.now(client.now()) == 8.1


def test_what_is_ordered_meanwhile_is_done_afterwards(
    car: VehicleSupervisor, garage: Garage, client: Client
) -> None:
    first = ride(car, garage, client)
    first.kill()
    car.order(child_commands.Pause())  # in vain, and remembered
    second = garage.again(1)
    car.order(child_commands.Speed(2.0))
    car.order(child_commands.Until(9.0))
    second.show(8.0, "paused", obeyed=2)
    assert until(lambda: not car.catching_up)
    assert second.orders[2:] == [child_commands.Speed(2.0), child_commands.Until(9.0)]


def test_a_scene_of_the_ride_that_broke_off_obeys_nothing(
    car: VehicleSupervisor, garage: Garage, client: Client
) -> None:
    first = ride(car, garage, client)
    first.kill()
    garage.again(1)
    first.show(8.0, "paused", obeyed=99)
    assert client.scene is not None
    assert not car.obeyed(client.scene)
    assert car.catching_up


def test_one_that_ends_again_on_its_way_goes_for_where_the_first_was(
    car: VehicleSupervisor, garage: Garage, client: Client
) -> None:
    ride(car, garage, client).kill()
    second = garage.again(1)
    second.show(3.0, "driving", obeyed=2)
    second.kill()
    assert garage.again(2).orders[1] == child_commands.Until(8.0)


def test_after_the_third_time_the_ride_is_over_and_that_is_told_once(
    car: VehicleSupervisor, garage: Garage, client: Client
) -> None:
    ride(car, garage, client).kill()
    for number in (1, 2, 3):
        assert car.trouble() != STANDING
        garage.again(number).kill()
    assert until(lambda: car.trouble() == STANDING)
    assert garage.told == [AGAIN] * 3 + [f"The car has ended (signal 9). {NO_MORE}"]
    car.check()  # the conversation goes on
    for order in (child_commands.Resume(), child_commands.Until(9.0)):
        with pytest.raises(CommandError, match="cannot go on"):
            car.order(order)
    with pytest.raises(CommandError, match="cannot go on"):
        car.hope()
    assert car.now(5.0) == 5.0  # no moment will come that is not recorded


def test_one_that_says_nothing_is_ended_and_started_anew(
    car: VehicleSupervisor, garage: Garage, client: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(vehicle_supervisor, "PATIENCE", 0.2)
    ride(car, garage, client).kill()
    second = garage.again(1)
    garage.again(2)
    assert second.failed


def test_the_end_of_the_chat_waits_for_no_car(garage: Garage, client: Client) -> None:
    car = VehicleSupervisor(garage.start, 1.0, garage.told.append)  # type: ignore[arg-type]
    with car:
        ride(car, garage, client).kill()
        garage.again(1)
    assert all(one.stopped for one in garage.started)
    assert not any(one.name == "keeper" for one in threading.enumerate())


def test_the_end_of_one_that_can_be_spared_is_told_once(garage: Garage) -> None:
    recorder = garage.start()
    spared = OptionalChild(recorder, garage.told.append)  # type: ignore[arg-type]
    spared.check()
    assert garage.told == []
    recorder.kill()
    spared.check()
    spared.check()
    assert garage.told == ["the car has ended (signal 9); the ride goes on without it"]
