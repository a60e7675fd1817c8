"""Stretches in which a rollout is held up: what the steps of its legs are joined into."""

from typing import Any, cast

import numpy as np
import pytest

from planner.motion.forward import DT
from planner.motion.obstacles import HOW
from planner.record.trace import HeldUp
from planner.rollouts.rollout import GRACE, Leg, held_up

LEADER, RIGHT, CUT_IN = (HOW.index(name) for name in ("leader", "right-of-way", "cut-in"))
BLOCKED = HOW.index("blocked")
START = 100.0  # [s]


class Columns:
    """The hindered steps of one leg, a column for each quantity."""

    def __init__(self, *steps: tuple[int, int, int, float]) -> None:
        table = np.array(steps, dtype=float).reshape(-1, 4)
        self.step, self.vehicle, self.how = (table[:, k].astype(int) for k in range(3))
        self.speed = table[:, 3]


class Hindered:
    """A leg of which only the hindrances count."""

    def __init__(self, *steps: tuple[int, int, int, float]) -> None:
        self.hindrances = Columns(*steps)


def joined(*legs: Any) -> tuple[HeldUp, ...]:
    return held_up(cast("list[Leg]", list(legs)), START)


def at(step: int) -> float:
    return pytest.approx(START + DT * step)


def test_steps_in_turn_are_one_stretch() -> None:
    (found,) = joined(Hindered((5, 1, LEADER, 9.0), (6, 1, LEADER, 4.0), (7, 1, LEADER, 6.0)))
    assert (found.vehicle, found.how) == (1, "leader")
    assert (found.since, found.until) == (at(5), at(8))
    assert (found.speed_from, found.speed_to) == (9.0, 4.0)


def test_a_stretch_goes_on_across_legs() -> None:
    (found,) = joined(Hindered((5, 1, LEADER, 9.0)), Hindered((6, 1, LEADER, 8.0)))
    assert (found.since, found.until) == (at(5), at(7))


def test_a_short_break_does_not_end_it_and_a_longer_one_does() -> None:
    (found,) = joined(Hindered((5, 1, LEADER, 9.0), (5 + GRACE, 1, LEADER, 8.0)))
    assert found.until == at(6 + GRACE)
    one, other = joined(Hindered((5, 1, LEADER, 9.0), (6 + GRACE, 1, LEADER, 8.0)))
    assert (one.until, other.since) == (at(6), at(6 + GRACE))


def test_giving_way_is_a_stretch_of_its_own_and_leading_and_blocking_are_not() -> None:
    one, other = joined(Hindered((5, 1, LEADER, 9.0), (6, 1, RIGHT, 8.0)))
    assert (one.how, other.how) == ("leader", "right-of-way")
    (found,) = joined(Hindered((5, 1, LEADER, 9.0), (6, 1, BLOCKED, 8.0)))
    assert found.how == "leader"


def test_every_vehicle_has_its_own_in_the_order_of_their_beginning() -> None:
    legs = Hindered(
        (5, 2, LEADER, 9.0), (5, 1, RIGHT, 3.0), (4, 3, LEADER, 2.0), (6, 2, LEADER, 8.0)
    )
    assert [(h.since, h.vehicle) for h in joined(legs)] == [(at(4), 3), (at(5), 1), (at(5), 2)]


@pytest.mark.parametrize(
    ("low", "how"), [(9.0, "cut-in"), (8.0, "cut-in"), (7.9, "leader"), (2.0, "leader")]
)
def test_who_cut_in_and_then_brakes_by_more_than_two_metres_a_second_leads(
    low: float, how: str
) -> None:
    (found,) = joined(Hindered((5, 1, CUT_IN, 10.0), (6, 1, CUT_IN, low), (7, 1, CUT_IN, 10.0)))
    assert found.how == how
    assert found.speed_to == low


def test_nobody_in_the_way_is_no_stretch() -> None:
    assert joined(Hindered()) == ()
    assert joined() == ()


def test_times_and_speeds_are_recorded_to_the_hundredth() -> None:
    leg = cast("Leg", Hindered((5, 1, LEADER, 9.128), (6, 1, LEADER, 8.254)))
    (found,) = held_up([leg], 100.047)
    assert (found.since, found.until) == (101.05, 101.45)
    assert (found.speed_from, found.speed_to) == (9.13, 8.25)
