"""How much the episodes of a ride matter, and which of them say the same."""

from typing import Any

import pytest

from tests.explain.answers.stated import did, scene, they
from xavi_dialogue.domain.terms import (
    Vehicle,
)
from xavi_dialogue.explain.answers.events.accounts import (
    select,
)

ONE, TWO = Vehicle(1), Vehicle(2)


def chosen(told: Any, most: int = 6, **facts: Any) -> list[str]:
    return [e.action for e in select(scene(**facts), told, most)]


# --- how much matters ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("more", "less"),
    [
        (they(1, "collide", 5.0, 5.0), did("nearly-collide", 4.0, 4.0)),
        (they(1, "nearly-collide", 5.0, 5.0), did("arrive", 4.0, 4.0)),
        (they(1, "nearly-collide", 5.0, 5.0), did("give-way", 4.0, 4.0)),
        (they(1, "nearly-collide", 5.0, 5.0), did("cut-in", 4.0, 4.0)),
        (did("give-way", 5.0, 5.0), did("overtake", 4.0, 4.0)),
        (did("give-way", 5.0, 5.0), did("leave", 4.0, 4.0)),
        (did("give-way", 5.0, 5.0), did("wait", 4.0, 4.0)),
        (did("arrive", 5.0, 5.0), did("stop", 4.0, 4.0)),
        (did("cut-in", 5.0, 5.0), did("exit-left", 4.0, 4.0)),
        (did("cut-in", 5.0, 5.0), did("exit-right", 4.0, 4.0)),
        (did("cut-in", 5.0, 5.0), did("continue-next-exit", 4.0, 4.0)),
        (did("overtake", 5.0, 5.0), did("stand", 4.0, 4.0)),
        (did("wait", 5.0, 5.0), did("change-left", 4.0, 4.0)),
        (did("exit-left", 5.0, 5.0), did("change-right", 4.0, 4.0)),
        (did("leave", 5.0, 5.0), did("pull-out", 4.0, 4.0)),
        (did("exit-right", 5.0, 5.0), did("brake", 4.0, 4.0)),
        (did("stand", 5.0, 5.0), did("enter", 4.0, 4.0)),
        (did("change-left", 5.0, 5.0), did("exit-straight", 4.0, 4.0)),
        (did("pull-out", 5.0, 5.0), did("change-plan", 4.0, 4.0)),
        (did("brake", 5.0, 5.0), did("cross", 4.0, 4.0)),
        (did("enter", 5.0, 5.0), did("pass", 4.0, 4.0)),
        (did("cross", 5.0, 5.0), did("slow-down", 4.0, 4.0)),
        (they(1, "pass", 5.0, 5.0), did("speed-up", 4.0, 4.0)),
        (did("follow", 5.0, 15.0), they(1, "speed-up", 4.0, 4.0)),
        (did("follow", 4.0, 4.0), did("brake", 5.0, 5.0)),
        (did("follow", 5.0, 15.0), they(1, "appear", 4.0, 4.0)),
        (did("follow", 5.0, 15.0), they(1, "disappear", 4.0, 4.0)),
    ],
)
def test_the_weightier_of_two_is_told(more: Any, less: Any) -> None:
    assert chosen([less, more], 1) == [more.action]


def test_what_we_do_weighs_half_as_much_again() -> None:
    assert chosen([did("stop", 5.0, 5.0), they(1, "cut-in", 4.0, 4.0)], 1) == ["stop"]


def test_firm_braking_weighs_more() -> None:
    hard, soft = did("brake", 5.0, 5.0, peak=4.0), did("brake", 5.0, 5.0, peak=3.9)
    assert chosen([did("wait", 9.0, 9.0), hard], 1) == ["brake"]
    assert chosen([did("wait", 9.0, 9.0), soft], 1) == ["wait"]
    other = they(1, "brake", 5.0, 5.0, peak=6.0)  # 4 + 3 against 5 * 1.5
    assert chosen([did("wait", 9.0, 9.0), other], 1) == ["wait"]


def test_what_lasts_weighs_a_little_more() -> None:
    assert chosen([did("stop", 4.0, 4.0), did("wait", 5.0, 15.0)], 1) == ["wait"]
    endless = they(1, "wait", 1.0, 60.0)  # 5 + 0.5 at most, against 6
    assert chosen([endless, they(2, "cut-in", 3.0, 3.0)], 1, now=300.0) == ["cut-in"]
    assert chosen([did("wait", 2.0, 4.0), did("stop", 6.0, 12.0)], 1) == ["stop"]
    going = did("follow", 9.0)
    assert chosen([did("speed-up", 4.0, 4.0), going], 1) == ["follow"]


def test_of_as_weighty_ones_the_first_is_told() -> None:
    assert chosen([did("wait", 9.0, 9.0), did("leave", 4.0, 4.0)], 1) == ["leave"]


# --- what is one thing --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "other", "kept"),
    [
        (did("stop", 4.0, 8.0), did("brake", 3.0, 4.5), ["stop"]),
        (did("stop", 4.0, 8.0), did("brake", 1.0, 3.0), ["brake", "stop"]),
        (did("stop", 4.0, 8.0), they(1, "brake", 3.0, 4.5), ["brake", "stop"]),
        (did("wait", 4.0, 8.0), did("slow-down", 3.0, 4.5), ["wait"]),
        (did("give-way", 4.0, 8.0), did("stand", 5.0, 8.0), ["give-way"]),
        (did("give-way", 4.0, 8.0), did("brake", 3.0, 4.5), ["brake", "give-way"]),
        (they(1, "cut-in", 4.0, 8.0), they(1, "change-left", 4.0, 8.0), ["cut-in"]),
        (did("change-left", 4.0, 8.0), did("change-right", 7.0, 9.0), ["change-left"]),
        (did("change-left", 4.0, 8.0), did("brake", 4.0, 8.0), ["brake", "change-left"]),
        (did("pass", 4.0, 8.0), did("pass", 5.0, 9.0), ["pass"]),
        (did("pass", 4.0, 8.0), did("cross", 5.0, 9.0), ["pass", "cross"]),
        (did("give-way", 4.0, 8.0, object=ONE), did("give-way", 4.0, 8.0, object=TWO),
         ["give-way", "give-way"]),
        (did("give-way", 4.0, 8.0, object=ONE), did("give-way", 5.0, 9.0, object=ONE),
         ["give-way"]),
    ],
)  # fmt: skip
def test_what_says_the_same_is_told_once(one: Any, other: Any, kept: list[str]) -> None:
    assert sorted(chosen([other, one])) == sorted(kept)


def test_giving_way_is_told_after_what_began_with_it() -> None:
    told = [did("give-way", 4.0, 8.0), did("brake", 4.0, 8.0), did("enter", 3.0, 3.0)]
    assert chosen(told) == ["enter", "brake", "give-way"]
