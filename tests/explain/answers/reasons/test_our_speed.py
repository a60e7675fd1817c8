"""Whether it is of our speed that is asked, whether we slow down, and what speaks for stopping."""

from typing import Any

import pytest

from tests.explain.answers.stated import did, driven, scene
from xavi_dialogue.domain.answers import Verdict
from xavi_dialogue.domain.evidence import Cause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Not,
    Quantity,
    Vehicle,
)
from xavi_dialogue.explain.answers.propositions import reasons
from xavi_dialogue.explain.answers.reasons import motions as room

IT = Vehicle(1)


def driving(speed: float) -> dict[int, Any]:
    """Our motion at a speed up to 20 s."""
    return {0: driven((0.0,) * 21, speed=speed)}


@pytest.mark.parametrize(
    ("more", "alone", "beside"),
    [
        ({"collision": 0.04}, True, False),
        ({"collision": 0.05}, True, True),
        ({"collision": 0.06, "fact_collision": 0.02}, True, False),
        ({"collision": 0.005}, False, False),
        ({"close": True, "collision": 0.2}, True, True),
        ({"close": True}, False, False),
        ({"decisive": "late", "causes": (Cause(1, (), 0.5),)}, True, False),
        ({"decisive": "time", "causes": (Cause(1, (), 0.5),)}, True, False),
        ({"decisive": "late"}, False, False),
        ({"decisive": "comfort", "causes": (Cause(1, (), 0.5),)}, False, False),
        ({"decisive": "dead"}, True, False),
    ],
)
def test_what_driving_on_would_come_to_may_be_the_reason(
    more: Any, alone: bool, beside: bool
) -> None:
    class Against:
        collision, fact_collision, close = 0.0, 0.0, False
        decisive, causes = "collision" if "collision" in more else "effort", ()

    for name, value in more.items():
        setattr(Against, name, value)
    against: Any = Against()
    assert room._speaks(against, somebody=False) is alone
    assert room._speaks(against, somebody=True) is beside


@pytest.mark.parametrize(
    ("of", "ours"),
    [
        (Compares(Measured("speed"), "more", Quantity(10.0)), True),
        (Compares(Measured("speed", IT), "more", Measured("speed")), True),
        (Compares(Measured("speed", IT), "more", Quantity(10.0)), False),
        (Compares(Measured("speed", IT), "more", Measured("speed", Vehicle(2))), False),
        (Compares(Measured("gap"), "more", Quantity(10.0)), False),
    ],
)
def test_our_speed_is_compared(of: Compares, ours: bool) -> None:
    assert room.is_our_speed(of) is ours


@pytest.mark.parametrize(
    ("episode", "speed", "slowing"),
    [
        (did("brake", 18.0), 5.0, True),
        (did("slow-down", 5.0), 0.3, True),
        (did("brake", 18.0), 0.2, False),
        (did("brake", 18.0, 19.9), 5.0, False),
        (did("stop", 18.0), 5.0, False),
    ],
)
def test_we_are_slowing_down_while_we_drive(episode: Episode, speed: float, slowing: bool) -> None:
    assert room.is_slowing(scene(episodes=(episode,), motions=driving(speed))) is slowing
    assert room.is_slowing(scene(episodes=(episode,))) is False


@pytest.mark.parametrize(
    "of",
    [
        Is("stationary", Ego(), tense="present"),
        Not(Is("moving", Ego(), tense="present")),
        Not(Happens(Event("move", tense="present"))),
    ],
)
@pytest.mark.parametrize(("speed", "told"), [(9.0, True), (2.4, False), (0.0, False)])
def test_that_we_stand_is_denied_where_we_drive(
    of: Any, speed: float, told: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("slow", "standing_or_slow", "motion"):
        monkeypatch.setattr(room, name, lambda *_, **__: "why")
    asked = scene(values={("speed", 0): speed}, motions=driving(speed))
    found = reasons.why(Why(of), asked)
    assert (found != "why") is told
    if told:
        assert isinstance(found, Verdict)
        assert (found.that, found.holds) == (Is("stationary", Ego(), tense="present"), False)


def test_why_we_do_not_go_somewhere_is_no_question_of_standing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(room, "slow", lambda *_: "why")
    asked = scene(values={("speed", 0): 9.0}, motions=driving(9.0))
    slowly = Event("move", tense="present", manner=("slowly",))
    assert reasons.why(Why(Not(Happens(slowly))), asked) == "why"
