"""How somebody drives: speed, acceleration, jerk, lights."""

import math

import pytest

from planner.record.places import LightChange, RoadFacts, RoadPlace, RouteStep
from tests.explain.facts.scenes import Actor, Path_, made, speeds, straight
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Thing, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.explain.facts.measures.driving import jerk_at
from xavi_dialogue.explain.facts.measures.measuring import measure
from xavi_dialogue.explain.facts.states import States

US, ONE, TWO = Ego(), Vehicle(1), Vehicle(2)


def middle(x: float, y: float, speed: float, turn: float = 0.0) -> Path_:
    heading = math.radians(turn)
    return straight(x + 2.4 * math.cos(heading), y + 2.4 * math.sin(heading), speed, heading)


def states(*others: Path_, ours: Path_ | None = None, until: float = 4.0) -> States:
    own = middle(0.0, 0.0, 10.0) if ours is None else ours
    return States(made({k: Actor(p) for k, p in enumerate((own, *others))}, until))


def of(
    found: States,
    attribute: Attribute,
    thing: Thing = US,
    to: Thing | None = None,
    at: float = 4.0,
) -> Measure:
    return measure(found, attribute, thing, at, to)


def test_speed_and_its_changes() -> None:
    marks = ((0.0, 10.0), (2.0, 10.0), (6.0, 18.0), (9.0, 9.0))
    place = RoadPlace("main", 0, 1, 14.0, False, False)
    found = States(made({0: Actor(speeds(0.0, 0.0, marks)), 1: Actor(speeds(0.0, 9.0, marks))}, 9.0,
                        roads=lambda _: RoadFacts({0: place})))  # fmt: skip
    speed = of(found, "speed")
    assert (speed.value, speed.reference) == (14.0, 14.0)
    assert of(found, "speed", ONE).reference is None
    assert (of(found, "excess", at=5.0).value, of(found, "excess").reference) == (2.0, 14.0)
    assert of(found, "excess", at=1.0).value == -4.0
    assert of(found, "excess", ONE).gap == "not-recorded"
    assert of(found, "acceleration").value == 2.0
    assert of(found, "deceleration").value == 0.0
    assert of(found, "acceleration", at=7.0).value == -3.0
    assert of(found, "deceleration", at=7.0).value == 3.0
    comfort = of(found, "comfort", at=7.0)
    assert (comfort.value, comfort.attribute) == (3.0, "comfort")
    assert of(found, "limit", ONE).gap == "not-recorded"


def test_jerk_is_the_change_of_acceleration_over_six_tenths_of_a_second() -> None:
    """From 0 to 2 m/s2 at 2 s: between 1.7 (as of 1.6) and 2.3 (2.2) s it changes by 2 m/s2."""
    marks = ((0.0, 10.0), (2.0, 10.0), (6.0, 18.0))
    found = States(made({0: Actor(speeds(0.0, 0.0, marks))}, 5.0))
    assert jerk_at(found, 0, 2.0) == pytest.approx(2.0 / 0.6, abs=0.1)
    assert of(found, "jerk", at=2.0).value == pytest.approx(2.0 / 0.6, abs=0.1)
    assert jerk_at(found, 0, 4.0) == pytest.approx(0.0, abs=1e-6)
    assert jerk_at(found, 0, 0.2) is None
    assert jerk_at(found, 7, 2.0) is None
    slower = ((0.0, 10.0), (2.0, 10.0), (4.0, 6.0))
    assert jerk_at(
        States(made({0: Actor(speeds(0.0, 0.0, slower))}, 5.0)), 0, 2.0
    ) == pytest.approx(-2.0 / 0.6, abs=0.1)
    ending = States(made({0: Actor(speeds(0.0, 0.0, ((0.0, 10.0), (4.6, 10.0), (5.0, 9.2))))}, 5.0))
    assert jerk_at(ending, 0, 5.0) == pytest.approx(-2.0 / 0.6, abs=0.1)


@pytest.mark.parametrize(
    ("shown", "word", "sides", "brake"),
    [
        (("left",), "left", ("left",), "off"),
        (("brake", "right"), "right", ("right",), "on"),
        (("left", "right"), "both", ("left", "right"), "off"),
        (("brake",), "none", (), "on"),
        ((), "none", (), "off"),
    ],
)
def test_lights(shown: tuple[str, ...], word: str, sides: tuple[str, ...], brake: str) -> None:
    other = Actor(straight(0.0, 9.0, 10.0), lights=(LightChange(0.0, shown),))
    found = States(made({0: Actor(straight(0.0, 0.0, 10.0)), 1: other}, 4.0))
    indicator, brakes = of(found, "indicator", ONE), of(found, "brake-lights", ONE)
    assert (indicator.word, indicator.lights, indicator.value) == (word, sides, None)
    assert (brakes.word, brakes.lights) == (brake, ("brake",) if brake == "on" else ())


def test_of_several_the_first_is_measured() -> None:
    found = states(middle(30.0, 0.0, 5.0), middle(-18.0, 0.0, 8.0))
    assert of(found, "speed", Vehicles((2, 1))).value == 8.0
    assert of(found, "speed", Vehicles(())).value == 10.0
    assert of(found, "gap", ONE, Ego()).value == 5.2
    assert of(found, "speed", Vehicle(5)).gap == "out-of-view"
    assert of(found, "gap", US, Vehicle(5)).gap == "out-of-view"
    assert of(found, "acceleration", Vehicle(5)).gap == "out-of-view"


def test_a_value_of_after_the_last_sample_is_that_of_then() -> None:
    other = Actor(middle(30.0, 0.0, 5.0), until=3.0)
    found = States(made({0: Actor(middle(0.0, 0.0, 10.0)), 1: other}, 4.0))
    assert of(found, "speed", ONE, at=3.6).time == 3.0
    assert of(found, "speed", ONE, at=2.5).time == 2.5


def ring(time: float) -> RoadFacts:
    """On a roundabout from 4 to 6 s, which is left by the second exit; another one is far off."""
    inside = 4.0 <= time <= 6.0
    first = RouteStep(40.0 - 10.0 * time, "roundabout", "exit-left", 2, 4, 4, "give-way")
    other = RouteStep(400.0 - 10.0 * time, "roundabout", "exit-left", 3, 5, 4, "give-way")
    near = () if time > 6.0 else (first,)
    place = RoadPlace(f"{inside}", 0, 1, 14.0, False, inside)
    return RoadFacts({0: place}, (*near, *(() if time > 8.0 else (other,))))


@pytest.mark.parametrize(
    ("at", "value", "time", "count"),
    [(2.0, 2.0, 2.0, 4), (5.0, 2.0, 5.0, 4), (7.0, 3.0, 7.0, 5), (9.5, 2.0, 6.5, None)],
)
def test_which_exit_is_or_was_taken(at: float, value: float, time: float, count: int) -> None:
    found = States(made({0: Actor(straight(0.0, 0.0, 10.0))}, 10.0, roads=ring))
    told = of(found, "exit-number", at=at)
    assert (told.value, told.time, told.count) == (value, time, count)


def test_an_acceleration_has_two_decimals() -> None:
    """4 m/s within 3 s, between samples two hundredths off at most."""
    found = States(made({0: Actor(speeds(0.0, 0.0, ((0.0, 10.0), (3.0, 14.0))))}, 4.0))
    value = of(found, "acceleration", at=1.0).value
    assert value is not None
    assert value == round(value, 2) == pytest.approx(4.0 / 3.0, abs=0.03)
