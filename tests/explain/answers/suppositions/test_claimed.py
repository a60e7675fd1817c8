"""What a question takes a choice to gain or cost, and what a start or a stop ahead means."""

import pytest

from xavi_dialogue.domain.terms import At, Compares, Ego, Measured, Quantity, Unsaid
from xavi_dialogue.explain.answers.suppositions.own_suppositions import claimed_in
from xavi_dialogue.explain.answers.suppositions.reacting import STARTING
from xavi_dialogue.explain.causes.plans.contrast import OPPOSITE


def delay(right=None, time=None):
    left = Measured("delay", Ego(), time=Unsaid() if time is None else time, tense="past")
    return Compares(left, "more", right)


@pytest.mark.parametrize(
    ("that", "length"),
    [
        (delay(Quantity(300.0, "s")), 300.0),
        (delay(time=At(300.0)), None),
        (delay(), None),
        (None, None),
    ],
)
def test_a_claimed_length_is_read(that, length):
    assert claimed_in(that) == length


def test_going_on_is_no_sudden_start():
    assert "continue" not in STARTING
    assert {"go", "move"} <= STARTING


def test_a_change_of_lanes_is_undone_by_the_other():
    assert all(OPPOSITE[OPPOSITE[action]] == action for action in OPPOSITE)
