"""Aspects: what a question asks for beyond its type, and of whom."""

import pytest

from tests.language.annotated import query
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.aspects import aspects, with_aspect


@pytest.mark.parametrize(
    ("text", "aspect", "actor"),
    [
        ("how fast are you going?", "speed", "ego"),
        ("whats the speed", "speed", "ego"),
        ("how fast is vehicle 1", "speed", "vehicle:1"),
        ("How fast is the car ahead going right now?", "speed", "vehicle:front"),
        ("how far away is it", "distance", "vehicle:it"),
        ("how far are we from vehicle 2", "distance", "vehicle:2"),
        ("how close is the car behind", "distance", "vehicle:behind"),
        ("how many cars are there", "count", "ego"),
        ("what colour is the truck", "colour", "vehicle:truck"),
        ("where is vehicle 1 now?", "place", "vehicle:1"),
        ("Where's the truck?", "place", "vehicle:truck"),
        ("why are we in this lane", "lane", "ego"),
        ("why are you still in the right lane?", "lane", "ego"),
        ("did you have to?", "necessary", "ego"),
        ("was that necessary", "necessary", "ego"),
        ("did you have to change lanes", "necessary", "ego"),
        ("was there a better way of doing that?", "better-way", "ego"),
        ("what was the second best option", "second", "ego"),
        ("what was the worst", "worst", "ego"),
        ("what else could you have done", "options", "ego"),
        ("couldn't vehicle 2 just speed up", "could", "vehicle:2"),
    ],
)
def test_words_tell_what_is_asked_for(text: str, aspect: str, actor: str) -> None:
    found = query(text)
    assert (found.event, found.actor) == (aspect, actor)
    assert aspect in aspects()


@pytest.mark.parametrize(
    "text",
    [
        "how fast can you go",
        "how far is it",
        "what colour is the traffic light",
        "where is vehicle 1 going",
        "where are we going",
        "how many lanes are there",
        "why did you change to the left lane",
        "why did you have to stop",
        "did vehicle 1 have to stop",
        "why was that the best option",
        "could you have stopped",
        "why did vehicle 2 not stop",
        "how far is it to our destination",
    ],
)
def test_other_questions_have_none(text: str) -> None:
    assert query(text).event not in aspects()


def test_a_pronoun_is_the_vehicle_spoken_of_last() -> None:
    found = query("where is it now", "why did vehicle 2 slow down?")
    assert (found.actor, found.event) == ("vehicle:2", "place")


def test_our_lane_is_ours_whoever_was_spoken_of_before() -> None:
    found = query("why are we in this lane", "what is vehicle 1 doing?")
    assert (found.type, found.actor, found.tense) == ("why", "ego", "present")


def test_an_aspect_ends_with_its_question() -> None:
    taken_over = Query(type="compare", event="necessary", refers_to_previous=True)
    assert with_aspect(taken_over, ("why",)).event is None
    assert with_aspect(taken_over, ("and", "before", "that")).event == "necessary"


def test_whether_we_had_to_is_no_order() -> None:
    found = query("did you have to slow down?")
    assert (found.type, found.factual, found.event) == ("what", ("slow-down",), "necessary")
    assert query("you have to slow down").reason == "command"
