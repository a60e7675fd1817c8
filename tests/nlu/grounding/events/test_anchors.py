"""When what a time hangs on was: places, lights, people and what is yet to come."""

from typing import Any

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, did, road
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    At,
    Back,
    Between,
    Ego,
    Event,
    Exit,
    Feature,
    Junction,
    Next,
    Relative,
    Road,
    Tense,
    Time,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.context import Context, Window
from xavi_dialogue.nlu.grounding.events.windows import startling, window
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

CROSS, RING = Junction("junction", time=10.0), Junction("roundabout", time=20.0)
LIGHT, LINE, SIDE = Feature("light"), Feature("line"), Road("side")
PASSED = (
    did("exit-left", 10.0, 12.0, side="left", place=CROSS),
    did("enter", 20.0, 20.0, place=RING),
    did("leave", 26.0, 26.0, place=RING),
)
COMING = Window(40.0, 55.0, Next(), (40.0, 55.0), said=True, ahead=True)
NOWHERE = Window(2.0, 40.0, Unsaid(), (2.0, 40.0))


def grounder(*happened: Episode, said: Discourse | None = None) -> TermGrounder:
    cars = {1: Car(20.0), 2: Car(50.0, seen=(2.0, 9.0))}
    world = FakeWorld(cars, happened, now=40.0, begin=2.0, facts=road("junction"))
    return TermGrounder(Context(world, said or Discourse()))


@pytest.mark.parametrize("anchor", [SIDE, LINE, Exit(), Junction("junction")])
@pytest.mark.parametrize("relation", ["before", "until"])
def test_before_a_place_is_yet_to_come_unless_it_is_told_as_past(
    anchor: Any, relation: Any
) -> None:
    for tense in ("present", "future"):
        g = grounder(*PASSED)
        assert window(Relative(relation, anchor), tense, g) == COMING
        assert g.notes.cost == 0.0
    g = grounder(*PASSED)
    found = window(Relative(relation, anchor), "past", g)
    assert found.end <= 20.0
    assert not found.ahead
    assert g.notes.presupposed


@pytest.mark.parametrize("anchor", [SIDE, LINE, Exit(), Junction("junction")])
def test_after_a_place_that_we_never_came_to_is_ahead_or_it_never_was(anchor: Any) -> None:
    coming, never = grounder(), grounder()
    assert window(Relative("after", anchor), "future", coming) == COMING
    assert coming.notes.presupposed
    assert window(Relative("after", anchor), "past", never) == NOWHERE
    assert not never.notes.presupposed
    assert never.notes.cost == pytest.approx(0.6)


def test_before_a_junction_that_we_never_came_to_is_of_late() -> None:
    g = grounder()
    found = window(Relative("before", Junction("junction")), "past", g)
    assert (found.begin, found.end) == (32.0, 40.0)
    assert g.notes.presupposed


@pytest.mark.parametrize(
    ("happened", "begin", "end"),
    [
        ((did("wait", 6.0, 9.0), did("pass", 12.0, 13.0)), 6.0, 9.0),  # rather where it held us
        ((did("pass", 12.0, 13.0),), 12.0, 13.0),
    ],
)
def test_at_the_light_is_when_it_held_us_and_else_when_we_passed_it(
    happened: tuple[Episode, ...], begin: float, end: float
) -> None:
    found = window(Relative("during", LIGHT), "past", grounder(*happened))
    assert (found.begin, found.end) == (begin, end)
    # Leaving it stays as it was said.
    left = Relative("during", Event("leave", Ego(), LIGHT, tense="past"))
    found = window(left, "past", grounder(*happened))
    assert (found.begin, found.end) == (begin, end)


def test_there_never_was_a_light() -> None:
    g = grounder()
    assert window(Relative("during", LIGHT), "past", g) == NOWHERE
    assert not g.notes.presupposed


@pytest.mark.parametrize(
    ("anchor", "tense", "ahead"),
    [
        (Ego(), "future", True),
        (Ego(), "present", True),
        (Vehicle(1), "future", True),  # "once he is past"
        (Vehicle(2), "future", False),  # out of view: when he was there
        (Vehicle(1), "past", False),
    ],
)
def test_after_somebody_is_once_he_is_past(anchor: Any, tense: Tense, ahead: bool) -> None:
    happened = (did("brake", 4.0, 6.0, who=2), did("brake", 30.0, 31.0, who=1))
    found = window(Relative("after", anchor), tense, grounder(*happened))
    assert (found == COMING) is ahead


@pytest.mark.parametrize(
    ("relation", "of", "tense", "ahead"),
    [
        ("before", "present", "present", True),
        ("until", "present", "future", True),
        ("before", "present", "past", False),
        ("before", "past", "present", False),
        ("after", "present", "future", True),
        ("after", "perfect", "present", True),
        ("after", "perfect", "past", False),
        ("during", "present", "present", False),
    ],
)
def test_before_or_after_we_do_something_is_yet_to_come(
    relation: Any, of: Tense, tense: Tense, ahead: bool
) -> None:
    time = Relative(relation, Event("brake", tense=of))
    found = window(time, tense, grounder(did("brake", 38.0, 39.0)))
    assert (found == COMING) is ahead


@pytest.mark.parametrize(
    ("of", "tense", "ahead"),
    [("future", "past", True), ("perfect", "past", True), ("past", "future", True),
     ("past", "past", False)],
)  # fmt: skip
def test_what_has_not_happened_may_yet_unless_all_is_told_as_past(
    of: Tense, tense: Tense, ahead: bool
) -> None:
    found = window(Relative("during", Event("overtake", tense=of)), tense, grounder())
    assert found == (COMING if ahead else NOWHERE)


def test_a_deed_named_within_a_time_is_looked_for_there() -> None:
    happened = (did("brake", 6.0, 8.0), did("brake", 30.0, 32.0))
    early = Event("brake", time=Between(3.0, 10.0), tense="past")
    found = window(Relative("during", early), "past", grounder(*happened))
    assert (found.begin, found.end) == (6.0, 8.0)
    plain = Event("brake", tense="past")
    found = window(Relative("during", plain), "past", grounder(*happened))
    assert (found.begin, found.end) == (30.0, 32.0)


def test_what_goes_on_lasts_until_now() -> None:
    going = did("wait", 33.0, going_on=True)
    found = window(Relative("during", Event("wait", tense="past")), "past", grounder(going))
    assert (found.begin, found.end) == (33.0, 40.0)


@pytest.mark.parametrize(
    ("tense", "found"),
    [
        ("future", Window(40.0, 55.0, Next(), (40.0, 55.0), ahead=True)),
        ("past", Window(2.0, 40.0, Unsaid(), (2.0, 40.0), said=True)),
    ],
)
def test_before_it_may_be_yet_to_come(tense: Tense, found: Window) -> None:
    assert window(Back("before"), tense, grounder()) == found


BRAKING: list[tuple[float | None, float, float, bool]] = [
    (4.0, 36.0, 38.0, True),
    (5.0, 30.0, 35.0, True),  # it ended 5 s ago
    (5.0, 30.0, 34.9, False),
    (3.9, 36.0, 38.0, False),  # gently
    (None, 36.0, 38.0, False),
]


@pytest.mark.parametrize(("peak", "begin", "end", "startles"), BRAKING)
def test_what_startles_is_our_hard_braking_of_just_now(
    peak: float | None, begin: float, end: float, startles: bool
) -> None:
    braked = Episode(Ego(), "brake", begin, end, peak=peak)
    his = Episode(Vehicle(1), "brake", 37.0, 38.0, peak=8.0)
    swerved = Episode(Ego(), "swerve", 36.0, 38.0, peak=8.0)
    found = startling(grounder(braked, his, swerved).context)
    told = Event("brake", Ego(), time=Between(begin, end), tense="past")
    assert found == (told if startles else None)


def test_of_two_that_startle_it_is_the_last() -> None:
    rows = ((36.0, 36.5), (38.0, 39.0))
    found = startling(grounder(*(Episode(Ego(), "brake", *x, peak=6.0) for x in rows)).context)
    assert found is not None
    assert found.time == Between(38.0, 39.0)


@pytest.mark.parametrize(
    ("time", "ahead"), [(At(40.5), False), (At(40.6), True), (Between(40.0, 44.0), False)]
)
def test_a_time_after_now_is_ahead(time: Time, ahead: bool) -> None:
    assert window(time, "past", grounder()).ahead is ahead
