"""Where "it", "the red one" and what is done at a light mean a traffic light, and where not."""

import pytest
from msgspec.structs import replace

from sim.scene import VehicleState
from tests.explain.lit import record
from xavi_dialogue.domain.discourse import Discourse, Mention
from xavi_dialogue.domain.meaning import Ask, HowMany
from xavi_dialogue.domain.rewriting import first, parts
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Event,
    Feature,
    Has,
    Pronoun,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.nlu.grounding.acts.acts import act
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.grounder import TermGrounder
from xavi_dialogue.nlu.grounding.salience import mentions_of
from xavi_dialogue.nlu.parse import Parser

LIGHT = Feature("light")
PARSER = Parser()


def grounded(text, now=20.0, *mentions, known=None):
    """The act of a text, grounded in the ride to the light, and what grounding it cost."""
    spoken = PARSER.read(text)[0].acts[0]
    world = World(Ride(known or record(now)))
    g = TermGrounder(Context(world, Discourse(mentions=tuple(mentions))))
    return act(spoken, g), g.notes


def of(thing, salience=0.9):
    return Mention(thing, 0, False, salience)


@pytest.mark.parametrize("text", ["Is it red?", "How long has it been red?", "Was it green?"])
def test_what_is_red_is_the_light_where_nobody_was_spoken_of(text):
    found, _ = grounded(text)
    assert first(found, Has).thing == LIGHT


def test_what_is_red_is_the_vehicle_that_was_spoken_of():
    traces = record(20.0).traces
    seen = VehicleState((120.0, 0.0), 0.0, 0.0, 0.0, 4.5, 1.8, colour="red")
    last = traces[-1]
    scene = {**last.scene, 1: seen}
    known = Record(20.0, (*traces[:-1], replace(last, scene=scene, history={**last.history})))
    found, _ = grounded("Is it red?", 20.0, of(Vehicle(1)), known=known)
    assert first(found, Has).thing != LIGHT


def test_where_no_light_was_seen_it_is_none_if_a_vehicle_was_spoken_of():
    found, _ = grounded("Is it red?", 1.0, of(Vehicle(1)))
    assert first(found, Has).thing != LIGHT
    found, _ = grounded("Is it red?", 1.0)
    assert first(found, Has).thing == LIGHT


def test_only_lights_turn_green_but_it_costs_to_say_so_where_there_is_none():
    found, notes = grounded("When did it turn green?", 35.0)
    assert first(found, Event).actor == LIGHT
    none, other = grounded("When did it turn green?", 1.0)
    assert first(none, Event).actor == LIGHT
    assert other.cost > notes.cost


@pytest.mark.parametrize("text", ["Where is it?", "Can you see it?", "How far away is it?"])
def test_it_is_the_light_that_was_spoken_of(text):
    found, _ = grounded(text, 20.0, of(LIGHT))
    assert LIGHT in list(parts(found, Feature))
    assert not list(parts(found, Pronoun))


@pytest.mark.parametrize("text", ["Why did you stop at the light?", "Did you wait at the light?"])
def test_stopping_at_a_light_is_stopping_for_it(text):
    event = first(grounded(text, 40.0)[0], Event)
    assert event.object == LIGHT
    assert event.where is None


def test_going_on_amber_is_passing_a_light():
    event = first(grounded("Did you go over the line on amber?", 40.0)[0], Event)
    assert (event.action, event.object) == ("pass", Feature("light", colour="amber"))
    assert event.where is None


def test_when_we_crossed_is_when_we_passed_the_light():
    found, notes = grounded("Was the light green when we crossed?", 40.0)
    assert isinstance(first(found, Has).time, At | Between)
    assert notes.span is not None
    assert notes.span.begin == pytest.approx(32.2, abs=1.0)


def test_the_red_one_is_a_light_where_lights_are_spoken_of():
    found, _ = grounded("Can you see the red one?", 20.0, of(LIGHT))
    assert first(found, Related).to == Feature("light", colour="red")
    other, _ = grounded("Can you see the red one?", 20.0)
    assert not list(parts(other, Feature))


def test_a_light_that_was_spoken_of_is_mentioned():
    found, _ = grounded("Is the light red?")
    assert isinstance(found, Ask)
    assert [m.thing for m in mentions_of(found, 1)] == [LIGHT]


def test_how_many_of_them_were_red_is_asked_of_lights_where_these_were_spoken_of():
    found, _ = grounded("How many of them were red?", 20.0, of(LIGHT))
    assert found.question == HowMany(Feature("light", colour="red"))
    found, _ = grounded("How many of them were red?", 20.0)
    assert found.question != HowMany(Feature("light", colour="red"))


@pytest.mark.parametrize(
    "text", ["How much time did the light cost us?", "How much did the red light delay us?"]
)
def test_what_a_light_cost_us_is_how_long_we_waited_at_it(text):
    found, _ = grounded(text, 20.0, of(LIGHT))
    assert found.question.of.action == "wait"
    assert found.question.of.object == LIGHT


@pytest.mark.parametrize(
    "text", ["How long does the red last?", "How long is the green going to last?"]
)
def test_the_red_that_lasts_is_a_light_whoever_was_spoken_of(text):
    found, _ = grounded(text, 20.0, of(Vehicle(1)))
    assert first(found, Feature).kind == "light"
    none, _ = grounded(text, 1.0)
    assert first(none, Feature) is None
