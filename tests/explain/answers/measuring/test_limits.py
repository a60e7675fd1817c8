"""Whether somebody keeps to the limit, is fast, or slow."""

from typing import Any

import pytest
from msgspec import structs

from tests.explain.answers.stated import did, look, scene
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import At, Between, Ego, Event, Is, Lane, Vehicle
from xavi_dialogue.explain.answers.measuring import limits

LOOKS = {1: look(1)}


def driving(speed: Any, limit: Any = 10.0, who: int = 0, **more: Any) -> Any:
    values = {("speed", who): speed, ("limit", who): limit}
    return scene(looks=LOOKS, values=values, **more)


@pytest.mark.parametrize(("speed", "over"), [(8.0, False), (10.4, False), (10.6, True)])
@pytest.mark.parametrize("who", [0, 1])
def test_half_a_metre_per_second_over_is_no_more_than_rounding(
    speed: float, over: bool, who: int
) -> None:
    asked, thing = driving(speed, who=who), Vehicle(who) if who else Ego()
    kept = limits.within_limit(asked, thing, 20.0, allowed=True)
    assert kept.holds is not over
    assert kept.facts == (Measure("speed", thing, 20.0, value=speed, reference=10.0),)
    assert limits.within_limit(asked, thing, 20.0, allowed=False).holds is over


def test_a_place_has_our_speed() -> None:
    assert limits.within_limit(driving(8.0), Lane("own"), 20.0, allowed=True).holds is True


@pytest.mark.parametrize(
    ("speed", "limit", "gap", "known"),
    [
        (None, 10.0, "not-recorded", [10.0]),
        (8.0, None, "not-recorded", [8.0]),
        ({"gap": "out-of-view"}, None, "out-of-view", []),
        (8.0, {"gap": "out-of-view"}, "out-of-view", [8.0]),
    ],
)
def test_without_a_speed_or_a_limit_it_cannot_be_told(
    speed: Any, limit: Any, gap: str, known: list[float]
) -> None:
    found = limits.within_limit(driving(speed, limit), Ego(), 20.0, allowed=True)
    assert (found.holds, found.gap) == (None, gap)
    assert [m.value for m in found.facts] == known  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("of", "speed", "holds"),
    [
        (Is("fast", Ego()), 12.0, True),
        (Is("fast", Ego()), 9.0, False),
        (Is("fast"), 12.0, True),
        (Is("slow", Ego()), 5.9, True),
        (Is("slow", Ego()), 6.0, False),
        (Is("slow"), 9.0, False),
        (Is("slow", event=Event("go")), 5.0, True),
        (Is("slow", Ego()), None, None),
    ],
)
def test_fast_is_over_the_limit_and_slow_far_below(of: Is, speed: Any, holds: Any) -> None:
    assert limits.fast(of, driving(speed)).holds is holds


def test_fast_in_the_past_is_over_the_limit_at_the_fastest() -> None:
    asked = driving(lambda at: 12.0 if at == 5.0 else 8.0)
    was = limits.fast(Is("fast", Ego(), time=Between(2.0, 9.0), tense="past"), asked)
    assert was.holds is True
    assert [(m.attribute, m.time, m.value) for m in was.facts] == [  # type: ignore[union-attr]
        ("speed", 5.0, 12.0),
        ("limit", 5.0, 10.0),
    ]
    assert limits.fast(Is("fast", Ego()), asked).holds is False


def test_another_one_is_fast_by_its_own_limit() -> None:
    asked = scene(
        looks=LOOKS,
        values={("speed", 1): 20.0, ("limit", 1): 10.0, ("speed", 0): 5.0, ("limit", 0): 10.0},
    )
    assert limits.fast(Is("fast", Vehicle(1)), asked).holds is True
    assert limits.fast(Is("fast", event=Event("go", Vehicle(1))), asked).holds is True
    assert limits.fast(Is("fast"), asked).holds is False


BRAKES = did("brake", 18.0, speed_from=14.0, speed_to=5.0)
GOING_ON = structs.replace(BRAKES, speed_from=None, speed_to=None)
OVER = did("brake", 15.0, 19.0)


@pytest.mark.parametrize(
    ("episodes", "shown"),
    [
        ((BRAKES,), (GOING_ON,)),
        ((did("slow-down", 17.0), BRAKES), (GOING_ON,)),
        ((OVER,), ()),
        ((), ()),
    ],
)
def test_where_we_are_fast_our_braking_is_told_without_the_speed_to_come(
    episodes: Any, shown: Any
) -> None:
    asked = driving(12.0, episodes=episodes)
    assert limits.fast(Is("fast", Ego()), asked).facts[1:] == shown
    assert limits.fast(Is("slow", Ego()), asked).facts[1:] == ()
    before = limits.fast(Is("fast", Ego(), time=At(18.0), tense="past"), asked)
    assert before.facts[1:] == ()
    just = limits.fast(Is("fast", Ego(), time=At(19.0), tense="past"), asked)
    assert just.facts[1:] == shown
