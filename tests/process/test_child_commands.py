import io
import math
import queue

import pytest

from tests.fakes import s1_moments
from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import SceneReport, unpack
from xavi_dialogue.process.child_commands import (
    ChildCommandError,
    Order,
    Orders,
    Pause,
    Quit,
    Resume,
    Speed,
    Until,
    read,
    write,
)
from xavi_dialogue.vehicle.episode import Moment
from xavi_dialogue.vehicle.node import Pace, VehicleNode
from xavi_dialogue.vehicle.telemetry import Reporter


@pytest.mark.parametrize(
    "order", [Pause(), Resume(), Quit(), Speed(2.5), Until(8.1), Until(None), Speed(0.0)]
)
def test_orders_come_through_as_they_were(order: Order) -> None:
    assert read(write(order) + "\n") == order


@pytest.mark.parametrize(
    "line", ["", "fly", "speed", "speed -1", "speed inf", "until noon", "1 2 3"]
)
def test_what_is_no_order_is_refused(line: str) -> None:
    with pytest.raises(ChildCommandError):
        read(line)


def drive(
    *orders: Order, running: bool, stays: bool, quit_at: float = math.inf
) -> tuple[list[float], list[SceneReport]]:
    """The times of the moments driven, and the scenes shown."""
    waiting: Orders = queue.SimpleQueue()
    for order in orders:
        waiting.put(order)
    hub, keys = MemoryHub(), Keys()
    shown: list[SceneReport] = []
    hub.connect().subscribe(
        keys.of("scene"), lambda _, payload: shown.append(unpack(payload, SceneReport))
    )
    times: list[float] = []

    def record(moment: Moment) -> None:
        times.append(moment.scene.time)
        if moment.scene.time >= quit_at:
            waiting.put(Quit())

    car = VehicleNode(
        ride=s1_moments(),
        step=0.5,
        records=(record,),
        reporter=Reporter(hub.connect(), keys),
        orders=waiting,
        pace=Pace(0.0, running=running),
        stays=stays,
    )
    car.run()
    return times, shown


def test_a_car_by_itself_drives_to_the_end() -> None:
    times, shown = drive(running=True, stays=False)
    assert times[-1] == 7.0
    assert shown[-1].state == "ended"
    assert (shown[-1].traces, shown[-1].events) == (4, 6)


def test_a_car_that_waits_for_orders_drives_up_to_where_it_is_told() -> None:
    times, shown = drive(Until(2.0), running=False, stays=True, quit_at=2.0)
    assert times == [0.0, 0.5, 1.0, 1.5, 2.0]
    assert (shown[0].state, shown[0].orders) == ("paused", 0)
    assert (shown[-1].state, shown[-1].sim_time, shown[-1].orders) == ("paused", 2.0, 2)


def test_a_car_halts_by_itself_after_the_first_manoeuvre() -> None:
    times, shown = drive(Until(None), running=False, stays=True, quit_at=7.0)
    assert times[-1] == 7.0  # where the lane change ends
    assert "paused" in {scene.state for scene in shown}


def test_after_the_ride_a_car_stays_until_told_to_quit() -> None:
    _, shown = drive(Resume(), running=False, stays=True, quit_at=7.0)
    assert (shown[-1].state, shown[-1].orders) == ("ended", 2)


def test_a_car_told_to_quit_before_it_starts_does_not_start() -> None:
    times, _ = drive(Quit(), running=False, stays=True)
    assert times == [0.0]


def test_a_halt_in_the_past_is_now() -> None:
    times, shown = drive(Until(0.0), Quit(), running=False, stays=True)
    assert times == [0.0]
    assert {scene.state for scene in shown} <= {"paused", "driving"}


def test_listening_ends_with_the_stream(monkeypatch: pytest.MonkeyPatch) -> None:
    from xavi_dialogue.process import child_commands

    monkeypatch.setattr(child_commands, "PATIENCE", 3600.0)  # the thread would end this process
    orders: Orders = queue.SimpleQueue()
    child_commands.listen(io.StringIO("pause\nnonsense\nspeed 3\n"), orders)
    assert [orders.get(timeout=2.0) for _ in range(3)] == [Pause(), Speed(3.0), Quit()]


def test_lines_that_are_no_orders_are_told_to_who_wants_to_know(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from xavi_dialogue.process import child_commands

    monkeypatch.setattr(child_commands, "PATIENCE", 3600.0)  # the thread would end this process
    orders, refused = queue.SimpleQueue[Order](), list[str]()
    lines = io.StringIO(f"bogus\nspeed -3\n\n{'x' * 1000}\n\x1b[2J\npause\n")
    child_commands.listen(lines, orders, refused.append)
    assert [orders.get(timeout=2.0) for _ in range(2)] == [Pause(), Quit()]
    such = "is not a command; write one such as pause, resume or speed 2.0"
    assert refused == [
        f"'bogus' {such}",
        "'-3' is not a number of 0 or more",
        f"'{'x' * child_commands.SHOWN}' {such}",
        f"'\\x1b[2J' {such}",
    ]
