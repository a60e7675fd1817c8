"""What goes on as it does, signals that are lights, and what is counted or let go."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Claim, HowLong, HowMuch, Social, WhatIf, When, Whether
from xavi_dialogue.domain.terms import (
    Believed,
    Compares,
    Described,
    Ego,
    Event,
    Feature,
    Happens,
    Has,
)
from xavi_dialogue.nlu.parse import Parser


@pytest.fixture(scope="module")
def parser() -> Parser:
    return Parser()


def questions(parser: Parser, text: str) -> list[object]:
    acts = parser.read(text)[0].acts
    return [act.question for act in acts if isinstance(act, Ask)]


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("If we carry on like this, when do we arrive?", When),
        ("So how many minutes still, if we stay behind like this?", HowMuch),
        ("How long till we get there if we stay behind him?", HowMuch),
        ("How many minutes still if nothing changes?", HowMuch),
        ("If we stop now, when do we arrive?", WhatIf),
    ],
)
def test_to_go_on_as_we_do_supposes_nothing(parser: Parser, text: str, kind: type) -> None:
    assert [type(question) for question in questions(parser, text)] == [kind]


def test_the_signal_is_the_light(parser: Parser) -> None:
    colour, lasts = questions(parser, "What colour is our signal, and how long has it been so?")
    assert isinstance(colour, HowMuch)
    assert colour.of.thing == Feature("light")
    assert isinstance(lasts, HowLong | HowMuch)
    assert questions(parser, "Was your signal on?") == [
        Whether(Has("indicator", "on", Ego(), tense="past"))
    ]


def test_a_first_turn_is_no_right_of_way(parser: Parser) -> None:
    assert questions(parser, "What if we had taken the first right?") == [
        WhatIf(Happens(Event("exit-right", tense="perfect")))
    ]


def test_we_have_got_it_now(parser: Parser) -> None:
    asked = questions(parser, "We've got the right of way, haven't we?")[0]
    assert isinstance(asked, Whether)
    assert getattr(asked.that, "tense", None) == "present"


@pytest.mark.parametrize("what", ["I counted four cars that we let go first.",
                                  "That makes two lorries we overtook, right?"])  # fmt: skip
def test_what_is_counted_is_compared(parser: Parser, what: str) -> None:
    act = parser.read(what)[0].acts[0]
    that = act.question.that if isinstance(act, Ask) else getattr(act, "that", None)  # type: ignore[union-attr]
    assert isinstance(that, Compares)
    assert that.left.attribute == "count"
    assert isinstance(that.left.thing, Described)
    assert that.left.thing.doing is not None
    assert not that.left.thing.doing.manner


@pytest.mark.parametrize(
    "text",
    [
        "Suppose the bus brakes hard. Can you stop in time?",
        "Say the truck stops dead. Do you stop in time or do we hit it?",
        "If the bike fell over now, would you stop in time or run him over?",
    ],
)
def test_whether_we_stop_is_asked_of_the_world_that_is_supposed(parser: Parser, text: str) -> None:
    (question,) = questions(parser, text)
    assert isinstance(question, WhatIf)
    assert isinstance(question.then, Whether)
    assert isinstance(question.then.that, Happens)
    assert question.then.that.event.action == "stop"


def test_what_it_felt_like_is_no_feeling(parser: Parser) -> None:
    (claim,) = parser.read("Felt like we nearly hit him.")[0].acts
    assert isinstance(claim, Claim)


def test_to_consider_that_something_may_come_is_to_expect_it(parser: Parser) -> None:
    (question,) = questions(parser, "Did you consider that the lorry might take that exit?")
    assert isinstance(question, Whether)
    assert isinstance(question.that, Believed)
    assert isinstance(question.that.content, Happens)


@pytest.mark.parametrize(
    "text", ["Does it annoy you, all these cyclists in your way?", "Do these cyclists annoy you?"]
)
def test_what_annoys_the_car_is_no_comfort_of_the_ride(parser: Parser, text: str) -> None:
    act = parser.read(text)[0].acts[0]
    assert isinstance(act, Social)
    assert act.kind == "feelings"
