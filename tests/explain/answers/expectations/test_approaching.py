"""How close a vehicle is going to come: bodies along our planned line and its predicted way."""

from types import SimpleNamespace
from typing import Any

import pytest

from sim.scene import VehicleState
from xavi_dialogue.explain.answers.expectations import approaching, precedence


def state(x: float, y: float, heading: float = 0.0) -> VehicleState:
    return VehicleState(
        position=(x, y), heading=heading, speed=10.0, acceleration=0.0, length=4.0, width=2.0,
        kind="car",
    )  # fmt: skip


def test_the_smallest_distance_is_between_bodies_from_now_on() -> None:
    trace: Any = SimpleNamespace(sim_time=10.0)
    # We drive along y = 0 to x = 20; it stands at x = 30 with its rear at x = 26.
    ours: Any = SimpleNamespace(position=tuple((2.0 * k, 0.0) for k in range(11)))
    way: Any = SimpleNamespace(path=((30.0, 0.0),) * 11)
    both = (state(0.0, 0.0), state(30.0, 0.0))
    assert approaching._closest(trace, both, ours, way, 10.0) == pytest.approx((6.0, 12.0))
    # What lies before now does not count: coming towards us on the other lane, it is past.
    back: Any = SimpleNamespace(path=tuple((20.0 - 4.0 * k, 3.0) for k in range(11)))
    beside = (state(0.0, 0.0), state(20.0, 3.0, 3.14159265))
    apart, time = approaching._closest(trace, beside, ours, back, 10.0) or (0.0, 0.0)
    assert apart == pytest.approx(1.0, abs=0.01)
    later, at = approaching._closest(trace, beside, ours, back, 11.8) or (0.0, 0.0)
    assert later > apart
    assert at >= 11.8 > time


def test_who_passes_long_before_us_does_not_come_in_front_of_us(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    trace: Any = SimpleNamespace(sim_time=0.0)
    way: Any = SimpleNamespace(path=((0.0, 5.0), (0.0, 0.0)), speed=(5.0, 5.0))
    monkeypatch.setattr(precedence, "planned_line", lambda trace: "ours")
    for there, before in ((0.1, False), (0.2, True), (4.2, True), (4.3, False)):
        reached = {(0.0, 0.0): there}
        monkeypatch.setattr(precedence, "_reached", lambda ours, p, r=reached: r.get(p))
        assert precedence.before_us(trace, way) is before
    monkeypatch.setattr(precedence, "planned_line", lambda trace: None)
    assert precedence.before_us(trace, way) is None
