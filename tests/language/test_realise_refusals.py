"""Refusals, small talk, help and clarification: what is wrong, and what can be asked."""

from dataclasses import replace
from typing import get_args

import pytest

from xavi_dialogue.explain.explanation import Facts, NoExplanation, Reason
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.context import SpeechContext, VehicleWords
from xavi_dialogue.language.questions import question
from xavi_dialogue.language.realise import MAX_WORDS, realise
from xavi_dialogue.language.refusals import (
    realise_clarification,
    realise_help,
    realise_not_understood,
    realise_smalltalk,
)

QUIET = SpeechContext()
AFTER_A_CHANGE = SpeechContext(done=("change-left",))
OUT_OF_SCOPE = (
    "off-topic",
    "command",
    "injection",
    "non-english",
    "capability",
    "perception",
    "legality",
    "blame",
    "unsupported-condition",
    "abuse",
    "unknown-vehicle",
)


def refuse(query: Query, why: Reason, **facts: str | float | tuple[str, ...]) -> str:
    refusal = NoExplanation(reason=why, facts=dict(facts))
    return realise(query, refusal, QUIET).text.partition(" You could ask:")[0]


def test_every_reason_has_its_own_words() -> None:
    query = Query(type="why", factual=("change-left",))
    texts = {reason: refuse(query, reason) for reason in get_args(Reason)}
    assert len(set(texts.values())) == len(texts)


def test_refusals_are_short_too() -> None:
    query = Query(type="why", actor="vehicle:1", factual=("change-left", "exit-left"))
    facts: Facts = {"time": 71.5, "distinct": 3, "needed": 11, "reason": "there is no such road"}
    for reason in get_args(Reason):
        refusal = NoExplanation(reason=reason, facts=facts)
        text = realise(query, refusal, AFTER_A_CHANGE).text
        assert len(text.split()) <= MAX_WORDS
        assert text[-1] in ".?"


def test_every_kind_of_out_of_scope_has_its_own_words() -> None:
    texts = {
        topic: refuse(Query(type="out_of_scope", reason=topic), "out-of-scope")
        for topic in OUT_OF_SCOPE
    }
    assert len(set(texts.values())) == len(OUT_OF_SCOPE)
    assert texts["command"].startswith("I take questions, not orders")


def test_what_happened_instead() -> None:
    query = Query(type="why", factual=("exit-left",))
    assert refuse(
        query, "did-not-happen", asked="exit-left", happened=("change-left",), time=12.4
    ) == ("I did not turn left. I moved to the left lane at 0:12.")


def test_what_is_yet_to_come() -> None:
    query = Query(type="why", factual=("exit-left",))
    assert refuse(query, "did-not-happen", asked="exit-left", planned=True) == (
        "I have not turned left yet, but I plan to."
    )


def test_another_vehicle_did_not_do_it() -> None:
    query = Query(type="why", actor="vehicle:1", factual=("stop",))
    assert refuse(query, "did-not-happen") == "Vehicle 1 did not stop."


def test_the_foil_is_what_was_done() -> None:
    query = Query(type="why_not", counterfactual=("change-left",))
    assert refuse(query, "did-not-happen", did=True, time=75.0) == (
        "That is just what I did: I moved to the left lane at 1:15."
    )


@pytest.mark.parametrize(
    ("reason", "said"),
    [
        ("there is no lane to the left", "there is no lane to the left"),
        ("its lane does not lead to the right", "my lane does not lead to the right"),
        ("it is already inside the junction", "I am already inside the junction"),
        (
            "that is no choice: it follows from the road",
            "that is no choice; it follows from the road",
        ),
    ],
)
def test_the_planners_reason_is_given(reason: str, said: str) -> None:
    query = Query(type="why_not", counterfactual=("change-left",))
    assert refuse(query, "not-applicable", reason=reason) == (
        f"I could not move to the left lane: {said}."
    )


def test_unknown_vehicles_and_those_known() -> None:
    query = Query(type="why", actor="vehicle:9", factual=("stop",))
    assert refuse(query, "unknown-vehicle", known=("1", "2")) == (
        "I know of no vehicle 9. I have seen vehicle 1 and vehicle 2."
    )


def test_of_many_vehicles_those_in_view_are_named() -> None:
    known = tuple(str(number) for number in range(1, 31))
    refusal = NoExplanation(reason="unknown-vehicle", facts={"vehicle": 99, "known": known})
    near = SpeechContext(vehicles={number: VehicleWords() for number in (7, 8, 9, 20, 30)})
    said = realise(Query(type="what", actor="vehicle:99"), refusal, near).text
    assert "I have seen 30 vehicles, among them vehicle 7, vehicle 8, vehicle 9" in said
    assert "vehicle 1," not in said


@pytest.mark.parametrize(
    ("query", "why", "facts", "text"),
    [
        (
            Query(type="why", factual=("change-left",), underspecified="direction"),
            "did-not-happen",
            {"asked": ("change-left",), "happened": ("exit-right",), "time": 5.0},
            "I did not change lanes. I turned right at 0:05.",
        ),
        (
            Query(type="why", factual=("exit-left",), underspecified="direction"),
            "did-not-happen",
            {"asked": ("exit-left",), "happened": ("continue",)},
            "I did not turn; so far I have only gone straight on.",
        ),
        (
            Query(type="why", factual=("exit-left",), tense="future"),
            "did-not-happen",
            {"asked": ("exit-left",), "happened": ("exit-right",), "time": 5.0},
            "I do not plan to turn left.",
        ),
        (
            Query(type="what_if", actor="vehicle:1", counterfactual=("stop",)),
            "too-little-evidence",
            {"asked": ("exit-right",), "distinct": 0, "needed": 11, "coverage": 0.0},
            "I have not tried what would come of vehicle 1 stopping, so I will not guess.",
        ),
        (
            Query(type="why_not", counterfactual=("stop",)),
            "too-little-evidence",
            {"asked": ("stop",), "distinct": 9, "needed": 11, "coverage": 0.31},
            "I have tried that in only 9 different situations (about 30 % of what might happen) "
            "and would need 11 to be sure, so I will not guess.",
        ),
        (
            Query(type="why", hypothesised_cause="vehicle:3"),
            "no-influence",
            {"vehicle": 3, "bits": 0.0, "seen": True},
            "Vehicle 3 had nothing to do with that: I expected no delay from it, and would have "
            "chosen the same whatever it did.",
        ),
        (
            Query(type="what_if", counterfactual=("give-way",), negated=True),
            "not-applicable",
            {"asked": ("give-way",), "undone": True, "reason": "it follows from the road"},
            "I could not have done without giving way: it follows from the road.",
        ),
    ],
)
def test_refusals_are_exact(query: Query, why: Reason, facts: Facts, text: str) -> None:
    said = realise(query, NoExplanation(reason=why, facts=facts), QUIET).text
    assert said.partition(" You could ask:")[0] == text


def test_what_would_be_declined_is_not_suggested() -> None:
    first = Query(type="why", factual=("change-left",))
    closed = replace(AFTER_A_CHANGE, closed=(first,))
    said = realise_help(closed)
    assert "Why did you move to the left lane?" not in said.suggestions
    given = NoExplanation(reason="out-of-scope", suggestions=(first,))
    query = Query(type="out_of_scope", reason="off-topic")
    assert "Why did you move to the left lane?" not in realise(query, given, closed).suggestions


def test_what_is_not_an_action() -> None:
    query = Query(type="out_of_scope", reason="not-an-action")
    assert refuse(query, "not-an-action", verb="fly") == "I cannot fly, so I never considered it."
    assert "never considered it" in refuse(query, "not-an-action")
    said = Query(type="out_of_scope", reason="not-an-action", event="do a U-turn")
    assert refuse(said, "not-an-action") == "I cannot do a U-turn, so I never considered it."


def test_unfit_facts_are_left_out() -> None:
    query = Query(type="why_not", counterfactual=("change-left",))
    facts = {"asked": "levitate", "time": float("nan"), "reason": "", "vehicle": "none"}
    text = realise(query, NoExplanation(reason="did-not-happen", facts=facts), QUIET).text
    assert "I did not move to the left lane." in text


def test_suggestions_come_from_the_refusal_and_then_from_the_situation() -> None:
    query = Query(type="out_of_scope", reason="off-topic")
    offered = (Query(type="why", factual=("exit-right",)),)
    given = realise(query, NoExplanation(reason="out-of-scope", suggestions=offered), QUIET)
    assert given.suggestions[0] == "Why did you turn right?"
    assert given.text.endswith("You could ask: Why did you turn right?")
    own = realise(query, NoExplanation(reason="out-of-scope"), AFTER_A_CHANGE)
    assert own.suggestions[0] == "Why did you move to the left lane?"


def test_a_refused_question_is_not_suggested() -> None:
    query = Query(type="why", factual=("change-left",))
    said = realise(query, NoExplanation(reason="effect-too-small"), AFTER_A_CHANGE)
    assert "Why did you move to the left lane?" not in said.suggestions


def test_several_readings_become_choices() -> None:
    readings = (
        Query(type="why", factual=("change-left",)),
        Query(type="why", factual=("exit-left",)),
    )
    said = realise_not_understood("ambiguous", QUIET, readings)
    assert said.choices == ("Why did you move to the left lane?", "Why did you turn left?")
    assert said.text == (
        "Which of these do you mean? (1) Why did you move to the left lane? "
        "(2) Why did you turn left?"
    )


def test_clarification_numbers_its_choices() -> None:
    said = realise_clarification(("Why?", "Where?"), QUIET)
    assert said.text.endswith("(1) Why? (2) Where?")


@pytest.mark.parametrize("cause", ["empty", "too-long", "gibberish", "no-question", "anything"])
def test_what_is_not_understood_gets_a_suggestion(cause: str) -> None:
    said = realise_not_understood(cause, AFTER_A_CHANGE)
    assert said.suggestions
    assert said.text.endswith("You could ask: Why did you move to the left lane?")


@pytest.mark.parametrize("topic", ["greeting", "thanks", "assent", "identity", None])
def test_small_talk_is_short(topic: str | None) -> None:
    text = realise_smalltalk(topic, AFTER_A_CHANGE).text
    assert text[-1] in ".?"
    assert len(text.split()) <= 45


def test_help_gives_examples() -> None:
    said = realise_help(AFTER_A_CHANGE)
    assert "Why did you move to the left lane?" in said.suggestions


@pytest.mark.parametrize(
    ("query", "text"),
    [
        (
            Query(type="why", factual=("change-left",), counterfactual=("continue",)),
            "Why did you move to the left lane instead of staying in your lane?",
        ),
        (Query(type="why", factual=("stop",), tense="present"), "Why are you stopping?"),
        (
            Query(type="why", actor="vehicle:2", factual=("stop",), tense="future"),
            "Why will vehicle 2 stop?",
        ),
        (Query(type="why_not", counterfactual=("exit-left",)), "Why did you not turn left?"),
        (Query(type="what_if", counterfactual=("stop",)), "What if you had stopped?"),
        (
            Query(type="what_if", actor="vehicle:1", counterfactual=("stop",), negated=True),
            "What if vehicle 1 had not stopped?",
        ),
        (
            Query(type="what_if", actor="vehicle:1", negated=True, intervention="remove"),
            "What if vehicle 1 had not been there?",
        ),
        (
            Query(type="what", actor="vehicle:front", tense="present"),
            "What is the car in front doing?",
        ),
        (Query(type="what", actor="vehicle:blue"), "What did the blue car do?"),
        (Query(type="where_goal", actor="vehicle:1"), "Where is vehicle 1 going?"),
        (Query(type="help"), "What can I ask you?"),
    ],
)
def test_queries_as_questions(query: Query, text: str) -> None:
    assert question(query) == text
