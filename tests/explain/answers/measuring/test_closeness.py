"""How near a vehicle came: in which stretch, which one, and whether it was never nearer."""

from typing import Any

import pytest

from tests.explain.answers.stated import aim, decision, look, scene
from tests.explain.trust import trusted
from tests.traces import End
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.explain.answers.measuring.closeness import (
    closeness,
    nearest_vehicle,
    shortest_time,
)
from xavi_dialogue.explain.answers.reference.moments import Window

#: The first comes as near as 2 m at 4 s and 3 m at 16 s, the second stays 8 m away.
NEAR = {
    ("distance", 0, 1): lambda t: min(2.0 + abs(t - 4.0), 3.0 + abs(t - 16.0)),
    ("distance", 0, 2): 6.0,
    ("time-to-collision", 0, 1): lambda t: 9.0 if t == 15.0 else None,
    ("time-to-collision", 0, 2): 11.0,
}
LOOKS = {1: look(1), 2: look(2), 3: look(3)}


def close(vehicle: int | None, about: Window, how: Any = "close", **more: Any) -> Any:
    return closeness(scene(values=NEAR, looks=LOOKS), vehicle, about, how, **more)


def test_the_smallest_distance_of_a_stretch() -> None:
    found = close(1, Window(1.0, 9.0))
    assert (found.vehicle, found.closest.value, found.closest.time) == (1, 2.0, 4.0)
    assert (found.asked, found.time, found.past, found.ever) == ("close", 9.0, True, None)
    found = close(1, Window(12.0, 18.0))
    assert (found.closest.value, found.closest.time, found.ever.time) == (3.0, 16.0, 4.0)


def test_half_a_metre_makes_no_difference() -> None:
    for nearer, overall in ((3.5, True), (3.4, False)):
        values = {("distance", 0, 1): lambda t, d=nearer: d if t == 4.0 else 4.0}
        asked = scene(values=values, looks=LOOKS)
        assert (closeness(asked, 1, Window(12.0, 18.0), "safe").ever is None) is overall


def test_a_moment_is_not_taken_exactly() -> None:
    found = close(1, Window(2.5, 2.5))
    assert (found.closest.value, found.closest.time) == (2.0, 4.0)
    found = close(1, Window(1.0, 2.6))
    assert (found.closest.value, found.time) == (3.5, 2.6)


def test_of_now_the_distance_is_that_of_now() -> None:
    found = close(1, Window(2.0, 9.0), past=False)
    assert (found.closest.value, found.closest.time) == (7.0, 20.0)
    assert (found.past, found.ever.value) == (False, 2.0)


def test_where_nobody_is_named_it_is_whoever_came_nearest() -> None:
    assert close(None, Window(2.0, 6.0)).vehicle == 1
    assert close(None, Window(8.5, 11.0)).vehicle == 2
    assert close(None, Window(2.0, 6.0), past=False).vehicle == 2  # 6 m away now
    nobody = closeness(scene(), None, Window(2.0, 6.0), "hit")
    assert (nobody.vehicle, nobody.closest, nobody.ttc, nobody.risk) == (None, None, None, None)
    assert (nobody.asked, nobody.time, nobody.past) == ("hit", 6.0, True)
    assert nearest_vehicle(scene(values=NEAR), Window(0.0, 9.0)) is None


def test_whoever_has_no_distance_is_not_the_nearest() -> None:
    values = {("distance", 0, 2): 50.0}
    assert nearest_vehicle(scene(values=values, looks=LOOKS), Window(0.0, 9.0)) == 2


@pytest.mark.parametrize(
    ("vehicle", "about", "value"),
    [
        (1, Window(12.0, 18.0), 9.0),
        (1, Window(2.0, 9.0), None),
        (2, Window(2.0, 9.0), None),  # never short
        (1, Window(14.5, 30.0), 9.0),
        (1, Window(-3.0, 16.0), 9.0),
    ],
)
def test_a_time_to_collision_is_told_where_it_was_short(
    vehicle: int, about: Window, value: float | None
) -> None:
    asked = scene(values=NEAR, looks=LOOKS)
    found = shortest_time(asked, vehicle, about)
    assert (None if found is None else found.value) == value
    told = closeness(asked, vehicle, about, "safe").ttc
    assert (None if told is None else told.value) == value


def test_ten_seconds_are_short() -> None:
    for value, short in ((10.0, True), (10.1, False)):
        asked = scene(values={("time-to-collision", 0, 1): value}, looks=LOOKS)
        assert (shortest_time(asked, 1, Window(2.0, 9.0)) is not None) is short


def test_the_risk_is_the_highest_of_the_plans_of_that_time() -> None:
    aims = {1: (aim("exit-left", 0.3), aim("continue", 0.7)), 2: (aim("continue", 1.0),)}

    def crash(chosen: Any) -> Any:
        return End("collision", collided_with=1) if chosen[1][0] == "exit-left" else End()

    traces = [decision(2.0), decision(5.0, aims=aims, ends={("continue",): crash}), decision(18.0)]
    asked = scene(values=NEAR, looks=LOOKS, traces=traces)
    for vehicle, about, past, risk in (
        (1, Window(6.0, 19.0), True, 0.3),
        (None, Window(6.0, 19.0), True, 0.3),
        (2, Window(6.0, 19.0), True, 0.0),
        (1, Window(3.0, 19.0), True, 0.3),
        (1, Window(3.0, 4.0), True, 0.0),
        (1, Window(6.0, 19.0), False, 0.0),
    ):
        found = closeness(asked, vehicle, about, "safe", past=past)
        assert found.risk == pytest.approx(trusted(risk))
    assert found.vehicle == Vehicle(1).number


def test_what_lies_further_back_counts_no_less_unless_it_is_to_fade() -> None:
    values = {
        ("distance", 0, 1): lambda t: 2.0 + abs(t - 4.0),
        ("distance", 0, 2): lambda t: 5.0 + abs(t - 9.0),
    }
    asked = scene(values=values, looks=LOOKS)
    assert nearest_vehicle(asked, Window(0.0, 9.0)) == 1
    assert nearest_vehicle(asked, Window(0.0, 9.0), 1.0) == 2  # 2 m five seconds ago, 5 m now
