"""What the car asks its passenger, what it says to the reply, and what it hears in one."""

import re
from dataclasses import dataclass
from typing import Literal

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.language.realise_cases import contexts, explanations
from tests.language.test_realise_properties import DOUBLED, JARGON, UNTIDY
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.context import SpeechContext, VehicleWords
from xavi_dialogue.language.quizzing import realise_no_quiz, realise_quiz, realise_verdict
from xavi_dialogue.language.retorts import Named, retort

Kind = Literal["vehicle", "deed", "sooner"]
Judgement = Literal["right", "wrong", "passed"]


@dataclass(frozen=True)
class Asking:
    kind: Kind
    about: Query


REMOVED = Query(type="what_if", actor="vehicle:1", negated=True, intervention="remove")
CHANGED = Query(type="why", factual=("change-left",))
STAYED = Query(type="what_if", factual=("change-left",), counterfactual=("continue",))


def now(query: Query) -> Query:
    return Query(**{f: getattr(query, f) for f in query.__struct_fields__} | {"tense": "present"})


@pytest.mark.parametrize(
    ("kind", "about", "text"),
    [
        ("deed", REMOVED, "What would I have done if vehicle 1 had not been there?"),
        ("deed", now(REMOVED), "What would I do if vehicle 1 were not there?"),
        ("vehicle", CHANGED, "Which vehicle made me move to the left lane?"),
        ("sooner", STAYED, "Would staying in my lane have got us there sooner or later?"),
        ("sooner", now(STAYED), "Would staying in my lane get us there sooner or later?"),
        (
            "deed",
            Query(type="what_if", actor="vehicle:2", counterfactual=("exit-straight",)),
            "What would I have done if vehicle 2 had gone straight on?",
        ),
        (
            "deed",
            Query(type="what_if", actor="vehicle:2", counterfactual=("stop",), negated=True),
            "What would I have done if vehicle 2 had not stopped?",
        ),
    ],
)
def test_questions(kind: Kind, about: Query, text: str) -> None:
    assert realise_quiz(Asking(kind, about), SpeechContext()).text == text


def test_a_vehicle_new_to_the_conversation_is_described() -> None:
    context = SpeechContext(vehicles={1: VehicleWords(description="the car ahead")})
    said = realise_quiz(Asking("deed", REMOVED), context)
    assert said.text == "What would I have done if the car ahead (vehicle 1) had not been there?"
    assert said.mentioned == (1,)


def test_where_there_is_nothing_to_ask_something_else_is_offered() -> None:
    said = realise_no_quiz(SpeechContext())
    assert said.text == (
        "I have nothing to ask you about yet. You can ask me: What will you do next?"
    )
    assert said.suggestions[0] == "What will you do next?"
    asked = (
        Query(type="what", tense="future"),
        Query(type="where_goal", tense="present"),
        Query(type="confidence", tense="present"),
    )
    assert realise_no_quiz(SpeechContext(asked=asked)).suggestions == ()


quizzes = st.sampled_from(
    [Asking("deed", REMOVED), Asking("vehicle", CHANGED), Asking("sooner", STAYED)]
)
judgements: st.SearchStrategy[Judgement] = st.sampled_from(["right", "wrong", "passed"])
OPENINGS: dict[Judgement, str] = {
    "right": r"(That is right|Exactly|You are right): ",
    "wrong": r"(Not quite|Not this time): ",
    "passed": r"(No matter|Never mind): ",
}


@settings(max_examples=300)
@given(quizzes, judgements, explanations, contexts)
def test_verdicts_are_tidy_and_say_which_they_are(
    quiz: Asking, judgement: Judgement, found: Explanation, context: SpeechContext
) -> None:
    said = realise_verdict(quiz, judgement, found, context)
    assert re.match(OPENINGS[judgement], said.text)
    assert said.text[-1] == "."
    assert UNTIDY.search(said.text) is None
    assert DOUBLED.search(said.text) is None
    assert JARGON.search(said.text) is None
    assert {int(n) for n in re.findall(r"[Vv]ehicle (\d+)", said.text)} == set(said.mentioned)
    assert said == realise_verdict(quiz, judgement, found, context)


@given(explanations)
def test_openings_take_turns(found: Explanation) -> None:
    asked = tuple(Query(type="smalltalk") for _ in range(3))
    said = {
        realise_verdict(
            Asking("deed", REMOVED), "right", found, SpeechContext(asked=asked[:n])
        ).text.partition(":")[0]
        for n in range(3)
    }
    assert said == {"That is right", "Exactly", "You are right"}


@pytest.mark.parametrize(
    ("text", "part", "heard"),
    [
        ("vehicle 1", "vehicles", (Named(("1",)),)),
        ("one", "vehicles", (Named(("1",)),)),
        ("the truck on the left", "vehicles", (Named(("truck", "left")),)),
        ("not 2 but vehicle 1", "vehicles", (Named(("2",), denied=True), Named(("1",)))),
        ("a car", "vehicles", (Named(("other",)),)),
        ("no idea", "passed", True),
        ("nobody", "nobody", True),
        ("it was you", "nobody", True),
        ("later, not sooner", "sooner", False),
        ("about 5 seconds slower", "sooner", False),
        ("sooner or later", "torn", True),
        ("stop or turn left", "torn", True),
        ("nothing would change", "same", True),
        ("nothing would change", "deeds", ()),
        ("something else", "same", False),
        ("I do not think so", "yes", False),
        ("turned left", "deeds", (("exit-left",),)),
        ("left", "deeds", (("exit-left", "change-left"),)),
        ("changed lanes", "deeds", (("change-left", "change-right"),)),
        ("you'd still have stopped", "deeds", (("stop", "give-way"),)),
        ("you would not have stopped", "denied", (("stop", "give-way"),)),
    ],
)
def test_what_is_heard(text: str, part: str, heard: object) -> None:
    said = retort(text)
    assert said is not None
    assert getattr(said, part) == heard


@pytest.mark.parametrize(
    "text",
    [
        *("why?", "what do you mean?", "tell me about vehicle 1", "and if it had stopped?"),
        *("is vehicle 1 turning?", "quiz me", "/forget", "", "...", "I don't know what you mean"),
        *("stop asking me", "could you say that again", "x" * 2000, "no idea why you stopped"),
    ],
)
def test_what_is_no_reply(text: str) -> None:
    assert retort(text) is None


WORDS = "you vehicle 1 2 the one not or , ? left right lane stay would have later same know why"


@settings(max_examples=300)
@given(st.text(max_size=60) | st.lists(st.sampled_from(WORDS.split())).map(" ".join))
def test_any_text_can_be_heard(text: str) -> None:
    assert retort(text) == retort(text)
