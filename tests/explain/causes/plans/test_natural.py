"""The foil that one thinks of first, and the way to the destination as a reason."""

import pytest

from planner.record.places import RoadFacts, RouteStep
from tests.explain.causes.rides import recorded, told
from tests.explain.facts.scenes import Actor, made, straight
from tests.nlg.scenery import CONTEXT
from xavi_dialogue.domain.answers import ChoiceReason, Contrast, Evidence, OutcomeEstimate
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import Event, Happens
from xavi_dialogue.explain.causes.plans.natural import DIRECTIONS, on_route
from xavi_dialogue.nlg.say import say


def step(kind, turn, exit_=None):
    return RouteStep(20.0, kind, turn, exit_, 4 if exit_ else None, 3, "give-way")


def road(*steps):
    return RoadFacts(places={}, route=steps)


@pytest.mark.parametrize("name", ["s2-0", "s2-2"])
def test_a_turn_is_told_against_another_direction_and_never_against_a_stop(name):
    found = told(recorded(name), Why(Happens(Event("turn", tense="past"))), 9.0)
    assert isinstance(found, ChoiceReason)
    foil = found.contrast.foil
    assert all(action in (*DIRECTIONS, "continue") for action in foil[-1:])
    assert foil
    assert found.contrast.way


def test_a_way_that_led_there_until_somebody_came_into_it_is_told_by_that():
    found = told(recorded("town-0"), Why(Happens(Event("turn", tense="past"))), 30.0)
    assert isinstance(found, ChoiceReason)
    assert found.contrast.foil == ("continue",)
    assert (found.contrast.decisive, found.contrast.collided_with) == ("collision", 5)
    assert not found.contrast.way


def test_a_lane_change_is_told_against_staying():
    found = told(recorded("s1-0"), Why(Happens(Event("change-left", tense="past"))), 8.0)
    assert isinstance(found, ChoiceReason)
    assert found.contrast.foil == ("continue",)
    assert not found.contrast.way


def test_the_route_tells_which_direction_is_the_way():
    facts = road(step("roundabout", "exit-straight", 2), step("junction", "exit-left"))
    ride = made({0: Actor(straight(0.0, 0.0, 10.0))}, 1.0, roads=lambda _: facts)
    trace = ride.latest
    assert on_route(trace, "continue-next-exit")
    assert not on_route(trace, "exit-right")
    assert on_route(trace, "exit-right", ("continue-next-exit",))
    assert on_route(trace, "exit-left", ("continue-next-exit", "exit-right"))
    assert not on_route(trace, "exit-right", ("continue-next-exit", "exit-right"))


def test_without_a_map_no_direction_is_known_to_be_the_way():
    ride = made({0: Actor(straight(0.0, 0.0, 10.0))}, 1.0)
    assert not on_route(ride.latest, "exit-right")


@pytest.mark.parametrize(
    ("foil", "outcome", "text"),
    [
        ((), None, "I plan to turn right, because that is the way to our destination."),
        (
            ("exit-left",),
            OutcomeEstimate("dead", 1.0),
            "I plan to turn right, because that is the way to our destination.",
        ),
    ],
)
def test_the_way_is_said_first(foil, outcome, text):
    contrast = Contrast(("exit-right",), foil, outcome, (), (), Evidence(), 10.0, way=True)
    answer = ChoiceReason("why", None, contrast, past=False)
    assert say(answer, CONTEXT).text == text
