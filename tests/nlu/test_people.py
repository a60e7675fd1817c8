"""Tests of how people on foot are spoken of, and of one of a group."""

import pytest

from xavi_dialogue.domain.meaning import Ask, HowMany, Identify, Whether, Which
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Described, Ego, Event, Happens
from xavi_dialogue.nlu.interpret import interpret


def question(text: str) -> object:
    """Return the first question of a text, of which every word has a part."""
    best = interpret(text)[0]
    assert not best.unknown
    assert not best.unread
    act = best.acts[0]
    assert isinstance(act, Ask)
    return act.question


@pytest.mark.parametrize(
    "text",
    [
        "Have those two people got across?",
        "Is that man going to step out?",
        "Is somebody walking in front of us?",
        "Is anybody on the crossing?",
        "is anyone on the zebra crossing",
        "is anyone on the crosswalk?",
        "Have the children walked across?",
        "Are those people crossing the road?",
        "Is the person on the right crossing?",
        "Will any of the kids still walk out?",
    ],
)
def test_people_cross(text: str) -> None:
    asked = question(text)
    assert isinstance(asked, Whether)
    assert isinstance(asked.that, Happens)
    assert asked.that.event.action == "cross"


def test_who_walks_is_on_foot() -> None:
    event = first(question("Is that man walking across?"), Event)
    assert event is not None
    assert event.actor == Described(kind="pedestrian")
    who = question("Who is walking across?")
    assert isinstance(who, Which)
    assert first(who, Event).action == "cross"


def test_who_is_at_a_junction_does_not_cross() -> None:
    asked = question("Is anybody on the roundabout?")
    assert first(asked, Event) is None


def test_we_change_lanes_and_people_do_not() -> None:
    event = first(question("Did you get over to the left lane?"), Event)
    assert event is not None
    assert event.actor == Ego()
    assert event.action == "change-left"


@pytest.mark.parametrize(
    ("text", "group"),
    [
        ("Where is the first of the two cars?", Described("car", number=2, rank=1)),
        ("Where is the last of those three lorries?", Described("truck", number=3, rank=-1)),
        ("Where is the slowest of the cars?", Described("car", extreme="slowest")),
    ],
)
def test_one_of_a_group_takes_in_its_number(text: str, group: Described) -> None:
    assert first(question(text), Described) == group


def test_two_people_are_described_and_no_pronoun() -> None:
    asked = question("Who are those two people?")
    assert asked == Identify(Described(kind="pedestrian", plural=True, number=2))


def test_turns_until_we_are_there_are_ours() -> None:
    asked = question("How many turns until we get there?")
    assert isinstance(asked, HowMany)
    assert isinstance(asked.of, Event)
    assert asked.of.action == "turn"
    assert asked.of.actor == Ego()


def test_misspelt_count_is_no_list() -> None:
    assert isinstance(question("hwo many more trns"), HowMany)


def test_one_single_car() -> None:
    assert first(question("Did we overtake one single car?"), Described) == Described(
        "car", definite=False
    )


@pytest.mark.parametrize(
    "text",
    [
        "who are you letting pass",
        "Whom did you let pass?",
        "who do you have to let pass",
        "who are you letting through",
    ],
)
def test_whom_we_let_pass_is_one_question(text: str) -> None:
    asked = question(text)
    assert isinstance(asked, Which)
    assert isinstance(asked.such, Happens)
    assert asked.such.event.action == "let-go"
    assert len(interpret(text)[0].acts) == 1
