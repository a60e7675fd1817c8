"""What is replied to a feeling: the fact that bears on it."""

from typing import Any

import pytest

from planner.record.trace import PlanTrace
from tests.explain.answers.given import NOW, Given, deed, plan
from xavi_dialogue.domain.answers import Comforting, Measures, NotRecorded
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Feel
from xavi_dialogue.domain.terms import (
    Compares,
    Destination,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Lane,
    Measured,
    Not,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers import talk
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window

ONE = Vehicle(1)
SPEEDS = {("speed", Ego()): 12.0, ("limit", Ego()): 13.89}
STANDS = (plan(NOW, speed=0.0),)
WAIT = Measure("waiting-time", Ego(), NOW, value=4.0)
LEFT = Measure("time-to-go", Ego(), NOW, value=30.0, to=Destination())


class Near:
    """What came close, at a distance [m]."""

    def __init__(self, asked: Any, vehicle: Any, about: Window, how: Any) -> None:
        assert how == "safe"
        self.vehicle, self.about = vehicle, about
        value = asked.world.given.measures.get(("distance", Ego()))
        self.closest = None if value is None else Measure("distance", Ego(), NOW, value=value)
        if value == "hidden":
            self.closest = Measure("distance", Ego(), NOW, gap="hidden")


class Hard:
    """How hard a stretch of the ride was [m/s2]."""

    def __init__(self, asked: Any, about: Window, episode: Any = None) -> None:
        self.about, self.episode = about, episode
        peak = asked.world.given.measures.get(("deceleration", Ego()))
        if peak == "lost":
            raise Unanswered(NotRecorded("gap-in-record"))
        self.peak = Measure("deceleration", Ego(), NOW, value=peak)


@pytest.fixture(autouse=True)
def facts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(talk, "closeness", Near)
    monkeypatch.setattr(talk, "comfort_of", Hard)
    monkeypatch.setattr(talk, "activity", lambda asked, who, at: ("doing", who, at))
    monkeypatch.setattr(talk, "remaining_wait", lambda asked: WAIT)
    monkeypatch.setattr(talk, "time_to_go", lambda asked, at: LEFT)


def fact(
    feeling: Any, about: Any = None, span: Span | None = None, near: Any = None, hard: Any = None,
    traces: tuple[PlanTrace, ...] = (), **more: Any,
) -> Any:  # fmt: skip
    measures = SPEEDS | {("distance", Ego()): near, ("deceleration", Ego()): hard}
    asked = Given(measures=measures, traces=traces, **more).asked(span)
    found = talk.feel(Feel(feeling, about), asked)
    assert isinstance(found, Comforting)
    assert found.feel == Feel(feeling, about)
    return found.fact


BRAKE = Happens(Event("brake"))
SPEED = Measures((Measure("speed", Ego(), NOW, value=12.0, reference=13.89),))
LATELY = Window(NOW - 6.0, NOW)


@pytest.mark.parametrize(
    "about",
    [
        ONE,
        Is("close", ONE),
        Is("fast", ONE),
        Happens(Event("brake", ONE)),
        Happens(Event("follow", object=ONE)),
        Compares(Measured("distance", ONE), "too-much"),
        Related("near", ONE),
        Related("behind", Ego(), ONE),
        Has("colour", "red", ONE),
        Exists(ONE),
        Not(Exists(ONE)),
    ],
)
def test_a_feeling_about_a_vehicle_is_met_with_how_close_it_came(about: Any) -> None:
    found = fact("afraid", about)
    assert isinstance(found, Near)
    assert (found.vehicle, found.about) == (1, LATELY)
    past = fact("afraid", about, Span(5.0, 8.0, said=True))
    assert past.about == Window(5.0, 8.0, True)


@pytest.mark.parametrize(
    ("about", "speedy"),
    [
        (Is("fast"), True),
        (Is("slow", Ego()), True),
        (Is("close"), False),
        (Happens(Event("go", manner=("fast",))), True),
        (Happens(Event("go")), False),
        (Compares(Measured("speed"), "too-much"), True),
        (Compares(Measured("limit"), "too-much"), True),
        (Compares(Measured("excess"), "too-much"), True),
        (Compares(Measured("delay"), "too-much"), False),
        (Related("on", Ego(), Lane("left")), False),
        (Exists(Lane("left")), False),
        (Lane("left"), False),
        (None, False),
    ],
)
def test_a_feeling_about_our_speed_is_met_with_it(about: Any, speedy: bool) -> None:
    assert (fact("happy", about, near=3.0) == SPEED) is speedy


def test_our_speed_is_told_beside_the_limit_where_both_are_known() -> None:
    one = talk.speed_of(Given(measures={("speed", Ego()): 12.0}).asked())
    assert one == Measures((Measure("speed", Ego(), NOW, value=12.0),))
    no_speed = talk.speed_of(Given(measures={("limit", Ego()): 12.0}).asked())
    assert no_speed == Measures((Measure("speed", Ego(), NOW, gap="not-recorded"),))


def test_a_fright_comes_of_who_was_near_or_of_braking_or_of_speed() -> None:
    for feeling in ("afraid", "nervous", "startled", "distrustful"):
        assert isinstance(fact(feeling, near=8.0, hard=5.0), Near)
        assert isinstance(fact(feeling, near=8.1, hard=2.0), Hard)
        assert isinstance(fact(feeling, near="hidden", hard=2.0), Hard)
        assert isinstance(fact(feeling, hard=2.0), Hard)
        assert fact(feeling, hard=1.9) == SPEED
        assert fact(feeling) == SPEED
    assert fact("afraid", near=3.0).vehicle is None
    assert fact("afraid", near=3.0).about == LATELY
    assert fact("afraid", near=3.0, begin=17.0).about == Window(17.0, NOW)
    assert fact("afraid", near=3.0, span=Span(5.0, 8.0)).about == Window(5.0, 8.0)


def test_other_feelings_have_facts_of_their_own() -> None:
    sick = fact("sick", hard=1.0)
    assert isinstance(sick, Hard)
    assert sick.about == LATELY
    assert isinstance(fact("disliking", hard=2.0), Hard)
    assert fact("disliking", hard=1.9) is None
    assert fact("disliking") is None
    for feeling in ("surprised", "confused"):
        assert fact(feeling) == ("doing", Ego(), NOW)
    assert fact("happy") is None
    assert fact("sick", hard="lost") is None


def test_who_is_in_a_hurry_is_told_how_long_it_takes() -> None:
    for feeling in ("impatient", "bored", "tired"):
        assert fact(feeling, traces=STANDS) == Measures((WAIT, LEFT))
        assert fact(feeling) == Measures((LEFT,))
    for feeling in ("annoyed", "angry"):
        assert fact(feeling, traces=STANDS) == Measures((WAIT, LEFT))
        assert fact(feeling) is None


def test_what_we_did_is_met_with_how_hard_or_how_close_it_was() -> None:
    braked, changed = deed("brake", 8.0, 10.0), deed("change-left", 12.0)
    found = fact("annoyed", BRAKE, deeds=(braked,))
    assert (found.about, found.episode) == (Window(8.0, 10.0), braked)
    moved = fact("nervous", Happens(Event("change-left")), deeds=(changed,))
    assert isinstance(moved, Near)
    assert (moved.vehicle, moved.about) == (None, Window(12.0, NOW))
    never = fact("nervous", Happens(Event("stop")), near=3.0)
    assert isinstance(never, Near)
    assert never.about == LATELY


def test_waiting_is_met_with_how_long_it_takes_for_who_is_in_a_hurry() -> None:
    for action in ("wait", "stand", "stop"):
        about = Happens(Event(action))
        assert fact("bored", about) == Measures((LEFT,))
        assert fact("nervous", about) == SPEED
    assert isinstance(fact("bored", BRAKE, deeds=(deed("brake", 8.0, 10.0),)), Hard)


def test_who_likes_a_vehicle_is_told_how_close_it_is() -> None:
    for feeling in ("liking", "happy", "impressed", "afraid"):
        assert fact(feeling, ONE).about == LATELY
        assert fact(feeling, ONE, Span(5.0, 8.0)).about == Window(5.0, 8.0)
