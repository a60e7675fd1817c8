"""Which light is meant, how it was expected to go on, and who waits at it."""

import pytest

from tests.explain.lit import GREEN, OBEYS, SIGNAL, STANDS, Story, record
from xavi_dialogue.domain.terms import Ego, Event, Feature, Vehicle
from xavi_dialogue.explain.facts.traffic_lights import crossed, foreseen, meant, shown_at
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.explain.history.traffic_lights import passings

LIGHT = Feature("light")


def world(now, story=OBEYS):
    return World(Ride(record(now, story)))


def test_the_light_is_the_one_ahead_then_the_one_passed():
    ride = Ride(record(40.0))
    assert meant(ride, LIGHT, 20.0) == SIGNAL
    assert meant(ride, LIGHT, 34.0) == SIGNAL
    assert meant(ride, LIGHT, 1.0) is None
    assert meant(ride, Feature("light", rank=2), 20.0) is None
    assert meant(ride, Feature("light", rank=-1), 40.0) == SIGNAL
    assert meant(ride, Feature("light", rank=-2), 40.0) is None
    assert meant(ride, Feature("light", rank=-2), 20.0) is None


def test_the_light_of_another_is_not_ours():
    assert shown_at(Ride(record(20.0)), Feature("light", of=Vehicle(3)), 20.0) is None


def test_an_expectation_has_the_chances_of_the_courses():
    found = foreseen(Ride(record(20.0)), SIGNAL, 20.0)
    assert found.to == "green"
    assert found.chance == pytest.approx(0.7)
    assert (found.low, found.middle, found.high) == (26.0, 32.0, None)
    assert found.came is None
    assert not found.cycle


def test_an_expectation_knows_what_came():
    found = foreseen(Ride(record(35.0)), SIGNAL, 20.0)
    assert found.came == GREEN


def test_nothing_is_expected_of_a_light_that_is_not_in_view():
    assert foreseen(Ride(record(45.0)), SIGNAL, 45.0) is None
    assert foreseen(Ride(record(1.0)), SIGNAL, 1.0) is None


def test_a_light_that_is_so_already_is_not_expected_to_become_so():
    assert foreseen(Ride(record(20.0)), SIGNAL, 20.0, "red") is None


def test_standing_at_red_is_waiting_for_the_light():
    waits = [e for e in world(25.0).episodes(Ego(), "wait") if e.object == LIGHT]
    assert [w.end for w in waits] == [None]
    assert waits[0].begin == pytest.approx(STANDS, abs=1.0)


def test_the_wait_ends_when_it_turns_green():
    (wait,) = [e for e in world(40.0).episodes(Ego(), "wait") if e.object == LIGHT]
    assert wait.end == pytest.approx(GREEN, abs=1.1)


def test_who_is_not_held_does_not_wait_for_a_light():
    assert world(14.0, Story(obeys=False)).episodes(Ego(), "wait") == ()


def test_a_light_turns_and_shows_as_episodes():
    known = world(35.0)
    turned = known.holds(Event("turn-colour", LIGHT), 0.0, 35.0)
    assert [(e.begin, e.object.colour) for e in turned] == [(GREEN, "green")]
    red = known.holds(Event("show", LIGHT, Feature("light", colour="red")), 0.0, 35.0)
    assert [(e.begin, e.end) for e in red] == [(2.0, GREEN)]
    assert known.holds(Event("turn-colour", LIGHT, Feature("light", colour="red")), 0.0, 35.0) == ()


def test_passing_a_light_is_an_episode_of_its_colour():
    known = world(40.0)
    assert len(known.holds(Event("pass", Ego(), LIGHT), 0.0, 40.0)) == 1
    assert known.holds(Event("pass", Ego(), Feature("light", colour="red")), 0.0, 40.0) == ()
    ran = world(14.0, Story(obeys=False))
    assert len(ran.holds(Event("cross", Ego(), Feature("light", colour="red")), 0.0, 14.0)) == 1


def test_stopping_for_a_light_is_one_only_while_it_holds():
    known = world(40.0)
    stops = known.holds(Event("stop", Ego(), LIGHT), 0.0, 40.0)
    assert [round(e.begin) for e in stops] == [round(STANDS)]
    assert known.holds(Event("speed-up", Ego(), LIGHT), 0.0, 40.0) == ()


def test_amber_is_passed_where_it_came_too_late_to_stop():
    late = crossed(*last_passed(Story(turns=9.0, to="y", obeys=False)))
    assert (late.shown.colour, late.late) == ("amber", True)
    early = crossed(*last_passed(Story(turns=5.0, to="y", obeys=False)))
    assert (early.shown.colour, early.late) == ("amber", False)


def last_passed(story):
    ride = Ride(record(14.0, story))
    return ride, passings(ride)[-1]
