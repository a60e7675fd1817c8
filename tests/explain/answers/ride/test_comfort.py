"""How hard the ride was: over which stretch, and because of which braking."""

from typing import Any

import pytest

from tests.explain.answers.stated import US, did, result, scene, they
from xavi_dialogue.domain.answers import DidNotHappen, NotRecorded
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import At, Between, Event
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.ride.comfort import asked_stretch, comfort, comfort_of, stretch

#: Braking that is hardest at 6 s and again at 12 s.
HARDEST = {6.0: 4.0, 12.0: 3.9, 13.5: 5.0}
VALUES = {
    ("deceleration", 0): lambda t: HARDEST.get(t, 0.5),
    ("jerk", 0): lambda t: 2.0 if t == 7.0 else 1.0,
}
BRAKED = (did("slow-down", 1.0, 3.0), did("brake", 5.0, 7.0), they(1, "brake", 5.0, 7.0))


@pytest.mark.parametrize(
    ("about", "peak", "time", "hard"),
    [
        (Window(2.0, 8.0), 4.0, 6.0, True),
        (Window(8.0, 12.5), 3.9, 12.0, False),
        (Window(14.0, 30.0), 0.5, 14.0, False),
        (Window(-5.0, 4.0), 0.5, 0.0, False),
        (Window(4.5, 4.5), 4.0, 6.0, True),  # 1.5 s to either side
        (Window(4.0, 4.0), 0.5, 2.5, False),
    ],
)
def test_the_hardest_of_a_stretch(about: Window, peak: float, time: float, hard: bool) -> None:
    found = comfort_of(scene(values=VALUES), about)
    assert (found.peak.value, found.peak.time, found.hard) == (peak, time, hard)


def test_the_jerk_is_told_where_it_is_known() -> None:
    found = comfort_of(scene(values=VALUES), Window(2.0, 8.0))
    assert found.jerk is not None
    assert (found.jerk.value, found.jerk.time) == (2.0, 7.0)
    only = {key: value for key, value in VALUES.items() if key[0] == "deceleration"}
    assert comfort_of(scene(values=only), Window(2.0, 8.0)).jerk is None


def test_without_motion_nothing_is_told() -> None:
    found = result(comfort_of, scene(), Window(-2.0, 8.0))
    assert found == NotRecorded("not-recorded", US, 0.0, 8.0, "comfort")


def test_the_braking_of_the_hardest_moment_is_told() -> None:
    assert comfort_of(scene(values=VALUES, episodes=BRAKED), Window(2.0, 8.0)).episode == BRAKED[1]
    stop = (did("brake", 5.0, 7.0), did("stop", 6.0, 9.0))
    assert comfort_of(scene(values=VALUES, episodes=stop), Window(2.0, 8.0)).episode == stop[1]
    other = (did("speed-up", 5.0, 7.0), did("brake", 7.5, 8.0))
    assert comfort_of(scene(values=VALUES, episodes=other), Window(2.0, 8.0)).episode is None


def test_of_an_event_its_own_stretch_is_told() -> None:
    facts: dict[str, Any] = {"values": VALUES, "episodes": BRAKED}
    found = comfort(scene(**facts), Event("slow-down", time=At(2.0)), Window(5.0, 7.0))
    assert (found.peak.value, found.episode) == (0.5, BRAKED[0])
    found = comfort(scene(**facts), None, Window(5.0, 7.0))
    assert (found.peak.value, found.episode) == (4.0, BRAKED[1])
    missing = result(comfort, scene(**facts), Event("turn"), Window(5.0, 7.0))
    assert isinstance(missing, DidNotHappen)


def test_what_goes_on_lasts_up_to_now() -> None:
    assert stretch(scene(), did("stop", 4.0)) == Window(4.0, 20.0)
    assert stretch(scene(), did("stop", 4.0, 9.0)) == Window(4.0, 9.0)


def test_the_stretch_asked_about() -> None:
    said = scene(Span(4.0, 5.0, said=True))
    inferred = scene(Span(4.0, 5.0))
    assert asked_stretch(scene(), None) == Window(0.0, 20.0)
    assert asked_stretch(said, None) == Window(4.0, 5.0, True)
    assert asked_stretch(inferred, None) == Window(0.0, 20.0)  # a moment that nobody said
    assert asked_stretch(scene(Span(4.0, 8.0)), None) == Window(4.0, 8.0)
    event = Event("stop", time=Between(2.0, 3.0))
    assert asked_stretch(inferred, event) == Window(2.0, 3.0, True)
    assert asked_stretch(scene(), Event("stop", tense="present")) == Window(20.0, 20.0)
