"""Stretches in which lights hold a rollout up, and legs that are cut short."""

from typing import Any, cast

import numpy as np
import pytest

from planner.motion.forward import DT, Hindrances, Stops
from planner.record.light_record import HeldByLight
from planner.record.trace import HeldUp
from planner.rollouts.rollout import GRACE, Leg, held_by_lights, held_up, hindered
from sim.scene import Signal

START = 100.0  # [s]
NEAR, FAR = Signal("J", 4), Signal("K", 1)


class Stopped:
    """A leg of which only the steps count in which one of two lights holds it up."""

    def __init__(self, *steps: tuple[int, int]) -> None:
        table = np.array(steps, dtype=np.int64).reshape(-1, 2)
        self.stops = Stops(table[:, 0], table[:, 1], (NEAR, FAR))


def joined(*legs: Any) -> tuple[HeldByLight, ...]:
    return held_by_lights(cast("list[Leg]", list(legs)), START)


def stretch(light: Signal, first: int, last: int) -> HeldByLight:
    since, until = cast(
        "list[float]", [pytest.approx(START + DT * step) for step in (first, last + 1)]
    )
    return HeldByLight(light.controller, light.index, since, until)


def test_steps_at_one_light_are_one_stretch() -> None:
    assert joined(Stopped((5, 0), (6, 0), (7, 0))) == (stretch(NEAR, 5, 7),)


def test_a_stretch_at_a_light_goes_on_across_legs() -> None:
    assert joined(Stopped((5, 0), (6, 0)), Stopped(), Stopped((7, 0))) == (stretch(NEAR, 5, 7),)


def test_a_short_break_at_a_light_does_not_end_a_stretch_and_a_longer_one_does() -> None:
    assert joined(Stopped((5, 0), (5 + GRACE, 0))) == (stretch(NEAR, 5, 5 + GRACE),)
    # The break counts from the last step, not from the first.
    assert joined(Stopped((5, 0), (7, 0), (7 + GRACE, 0))) == (stretch(NEAR, 5, 7 + GRACE),)
    found = joined(Stopped((5, 0), (7, 0), (8 + GRACE, 0), (9 + GRACE, 0)))
    assert found == (stretch(NEAR, 5, 7), stretch(NEAR, 8 + GRACE, 9 + GRACE))


def test_another_light_begins_a_stretch_of_its_own() -> None:
    found = joined(Stopped((5, 0), (6, 1), (7, 1)), Stopped((8, 0)))
    assert found == (stretch(NEAR, 5, 5), stretch(FAR, 6, 7), stretch(NEAR, 8, 8))


def test_no_light_holds_up_who_never_stops() -> None:
    assert joined(Stopped()) == joined() == ()


def test_times_at_lights_are_recorded_to_the_hundredth() -> None:
    (found,) = held_by_lights([cast("Leg", Stopped((5, 0), (6, 0)))], 100.047)
    assert (found.since, found.until) == (101.05, 101.45)


def test_of_a_leg_cut_short_only_the_stops_before_count() -> None:
    stops = Stops(np.array([3, 4, 7]), np.array([0, 1, 0]), (NEAR, FAR))
    found = stops.before(7)
    assert (found.step.tolist(), found.which.tolist()) == ([3, 4], [0, 1])
    assert found.signals == (NEAR, FAR)
    assert stops.before(8).step.tolist() == [3, 4, 7]
    assert stops.before(5).step.tolist() == [3, 4]
    assert stops.before(4).which.tolist() == [0]
    assert stops.before(3).step.tolist() == []
    none = Stops(np.empty(0, np.int64), np.empty(0, np.int64), ())
    assert none.before(3).step.tolist() == []


class Held:
    """A leg of which only the steps count in which others hold it up."""

    def __init__(self, *steps: tuple[int, int]) -> None:
        table = np.array(steps, dtype=np.int64).reshape(-1, 2)
        nil = np.zeros(len(table))
        self.hindrances = Hindrances(table[:, 0], table[:, 1], nil.astype(np.int64), nil)


@pytest.mark.parametrize(("join", "who"), [(hindered, [-1, 0, 3]), (held_up, [0, 3])])
def test_phantoms_hold_up_but_are_no_vehicles(join: Any, who: list[int]) -> None:
    found: tuple[HeldUp, ...] = join([Held((5, -1), (5, 3)), Held((6, 3), (9, 0))], START)
    assert sorted(one.vehicle for one in found) == who
    (third,) = (one for one in found if one.vehicle == 3)
    assert third.until == pytest.approx(START + 7 * DT)
