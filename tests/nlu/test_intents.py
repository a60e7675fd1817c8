"""Intents: plain questions are read, the weights fit the texts, and the grammar has its say."""

import tomllib
from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path
from typing import Any

import pytest

from benchmarks.language.learning import Asked, Example, learnt, read
from xavi_dialogue.domain.meaning import Ask, Why
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import At, AtDecision, Described, Ego, Event, Happens, Vehicle
from xavi_dialogue.nlu.intents.classifier import Intent, judge, model
from xavi_dialogue.nlu.intents.features import features
from xavi_dialogue.nlu.intents.frames import is_of, plain
from xavi_dialogue.nlu.intents.mentions import at_time_of, mentioned
from xavi_dialogue.nlu.interpret import interpret
from xavi_dialogue.nlu.parse import Parser

SETS = read(Path(__file__).parent / "intents")
TABLE: dict[str, Any] = tomllib.loads((files("grammars") / "intents.toml").read_text("utf-8"))
TENSES = ("past", "now", "next", "if", "any")


def _texts(table: dict[str, Any]) -> Iterator[str]:
    for key, entry in table.items():
        if isinstance(entry, dict):
            yield from _texts(entry)
        elif key in TENSES:
            yield from [entry] if isinstance(entry, str) else entry


@pytest.mark.parametrize("text", sorted(set(_texts(TABLE))))
def test_the_grammar_reads_every_plain_question(text: str) -> None:
    reading = Parser().read(text.replace("{x}", "vehicle 0"))[0]

    assert reading.acts
    assert not reading.unknown
    assert not reading.unread
    assert ("{x}" in text) == (Vehicle(0) in _things(reading.acts))


def _things(value: Any) -> list[Any]:
    from xavi_dialogue.domain.rewriting import parts

    return list(parts(value, Vehicle))


def test_every_intent_of_the_table_is_one_that_texts_were_annotated_with() -> None:
    annotated = {intent for texts in SETS.values() for e in texts for intent in e.intents}

    assert set(TABLE) <= annotated
    assert set(model().intent.classes) == annotated


def test_the_weights_tell_most_texts_that_they_were_learnt_from() -> None:
    texts = SETS["panels-4-6"]
    right = sum(_told(example) in example.intents for example in texts)

    assert right / len(texts) >= 0.9


def _told(example: Example) -> str:
    found = features(example.text, Parser().read(example.text)[0])
    return judge(found)[0].name


def test_what_is_learnt_from_one_kind_of_text_tells_it_from_another() -> None:
    when = ("now", "then", "again", "here")
    braking = [Example(f"why are we braking {word}", (Asked("why-brake"),)) for word in when]
    speed = [Example(f"how fast is he {word}", (Asked("x-speed"),)) for word in when]
    heads = learnt([*braking, *speed] * 20)

    found = features("why are we braking", Parser().read("why are we braking")[0])
    shares = heads.intent.probabilities(found)

    assert shares["why-brake"] > shares["x-speed"]


def test_an_act_is_of_the_intents_whose_plain_questions_ask_the_same() -> None:
    (why,) = Parser().read("Why are we braking so hard?")[0].acts

    assert is_of(why, "why-brake")
    assert not is_of(why, "eta")
    assert not is_of(why, "why-stop")


def test_a_plain_question_takes_the_other_vehicle() -> None:
    asked = plain(Intent("x-will", "next", "stop", 0.9), Vehicle(3))

    assert asked is not None
    assert asked.acts == Parser().read("Will vehicle 3 stop?")[0].acts


def test_there_is_no_plain_question_about_a_vehicle_where_none_is_named() -> None:
    assert plain(Intent("x-will", "next", "stop", 0.9), None) is None


def test_a_question_that_the_grammar_reads_well_stays_as_it_is() -> None:
    for text in ("Why did we brake?", "How far is it to our destination?", "Will vehicle 2 stop?"):
        assert interpret(text)[0].acts == Parser().read(text)[0].acts


def test_a_question_put_in_a_new_way_becomes_the_plain_one() -> None:
    text = "Why did you just jab the brakes? The junction's still miles off."
    (act, *_) = interpret(text)[0].acts

    assert isinstance(act, Ask)
    assert isinstance(act.question, Why)
    assert isinstance(act.question.of, Happens)
    assert (act.question.of.event.action, act.question.of.event.actor) == ("brake", Ego())


def test_a_word_that_nobody_knows_keeps_a_text_from_being_taken_for_another() -> None:
    text = "Why did you frobnicate left?"

    assert interpret(text) == Parser().read(text)


def test_who_is_asked_about_goes_before_who_is_told_of() -> None:
    reading = Parser().read("The red car has gone. Why is the blue van so slow?")[0]
    thing = mentioned(reading)

    assert isinstance(thing, Described)
    assert thing.colour == "blue"


def test_a_time_that_is_named_is_that_of_the_plain_question() -> None:
    reading = Parser().read("Decision 4, change-left. Why did you do that?")[0]
    (act,) = at_time_of(Parser().read("Why did we change lanes?")[0].acts, reading)

    assert isinstance(act, Ask)
    assert isinstance(act.question, Why)
    assert act.question.of == Happens(Event("change-lane", time=AtDecision(4)))


def test_a_time_that_was_not_read_is_not_dropped() -> None:
    for text in ("What was the risk of the option you rejected at 10 s?",
                 "What was the risk of the option you rejected at 0:10?"):  # fmt: skip
        assert all(first(one.acts, At) == At(10.0) for one in interpret(text)[:1])
