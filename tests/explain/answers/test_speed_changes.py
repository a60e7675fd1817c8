"""By how much a speed changed: over the time said, else in the latest change."""

from tests.explain.answers.propositions.test_attributes import ONE, told, values
from tests.explain.answers.stated import (
    US,
    did,
)
from xavi_dialogue.domain.answers import (
    DidNotHappen,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Event,
    Measured,
    WholeRide,
)

# --- changes of speed ---------------------------------------------------------------------------

SPEEDS = {("speed", 0): lambda t: 15.0 - 0.5 * t, ("speed", 1): lambda t: 5.0 + t}
CHANGES = (did("slow-down", 2.0, 6.0), did("speed-up", 8.0, 9.0), did("stop", 16.0))


def test_the_change_is_that_of_the_time_said() -> None:
    of = Measured("speed-change", time=Between(3.0, 7.0), tense="past")
    found = told(of, values=SPEEDS, episodes=CHANGES).measures[0]
    assert (found.value, found.low, found.high) == (-2.0, 13.5, 11.5)
    assert (found.time, found.until, found.thing) == (3.0, 7.0, US)
    span = Span(2.0, 4.0, said=True)
    assert values(told(Measured("speed-change"), span, values=SPEEDS)) == [-1.0]


def test_otherwise_it_is_that_of_the_latest_change() -> None:
    found = told(Measured("speed-change"), values=SPEEDS, episodes=CHANGES).measures[0]
    assert (found.time, found.until, found.value) == (16.0, 20.0, -2.0)
    of = Measured("speed-change", time=At(8.0), tense="past")
    found = told(of, values=SPEEDS, episodes=CHANGES).measures[0]
    assert (found.time, found.until) == (8.0, 9.0)
    of = Measured("speed-change", time=At(6.7), tense="past")  # up to 1.5 s later
    assert told(of, values=SPEEDS, episodes=CHANGES).measures[0].time == 8.0
    of = Measured("speed-change", time=At(6.4), tense="past")
    assert told(of, values=SPEEDS, episodes=CHANGES).measures[0].time == 2.0
    of = Measured("speed-change", tense="past")
    found = told(of, Span(1.0, 9.0), values=SPEEDS, episodes=CHANGES).measures[0]
    assert found.time == 8.0  # the span was not said


def test_the_change_of_an_event_is_its_own() -> None:
    of = Measured("speed-change", event=Event("slow-down"), tense="past")
    found = told(of, values=SPEEDS, episodes=CHANGES[:2]).measures[0]
    assert (found.time, found.until, found.value) == (2.0, 6.0, -2.0)
    assert told(of, values=SPEEDS, episodes=CHANGES).measures[0].time == 16.0
    missing = told(of, values=SPEEDS, episodes=CHANGES[1:2])
    assert isinstance(missing, DidNotHappen)
    assert missing.asked == Event("slow-down")
    of = Measured("speed-change", event=Event("stop"), time=Between(3.0, 18.0), tense="past")
    assert told(of, values=SPEEDS, episodes=CHANGES).measures[0].time == 16.0


def test_the_change_of_another_is_told_of_it() -> None:
    of = Measured("speed-change", ONE, time=Between(3.0, 7.0), tense="past")
    found = told(of, values=SPEEDS).measures[0]
    assert (found.thing, found.value) == (ONE, 4.0)
    missing = told(Measured("speed-change", ONE), values=SPEEDS, episodes=CHANGES)
    assert isinstance(missing, DidNotHappen)
    assert missing.asked == Event("slow-down", ONE)


def test_a_change_between_unknown_speeds_is_not_told() -> None:
    of = Measured("speed-change", time=Between(3.0, 7.0), tense="past")
    for known, time in ((3.0, 7.0), (7.0, 3.0)):
        speeds = {("speed", 0): lambda t, x=known: 9.0 if t == x else None}
        found = told(of, values=speeds).measures[0]
        assert (found.attribute, found.time, found.gap) == ("speed", time, "not-recorded")


def test_measures_of_the_whole_ride_are_of_all_of_it() -> None:
    of = Measured("speed-change", time=WholeRide(), tense="past")
    found = told(of, values=SPEEDS, episodes=CHANGES).measures[0]
    assert (found.time, found.until, found.value) == (0.0, 20.0, -10.0)
