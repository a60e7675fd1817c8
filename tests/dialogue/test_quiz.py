"""Questions to the passenger: which are asked, what their answers are, and what replies come to."""

import dataclasses
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import get_args

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.language.realise_cases import cause, effect, explanations
from xavi_dialogue.dialogue.quiz import candidates, filled, judged
from xavi_dialogue.dialogue.referents import vehicle_words
from xavi_dialogue.dialogue.turn import Judgement, Quiz
from xavi_dialogue.explain.bearings import Vehicles
from xavi_dialogue.explain.engine import explain
from xavi_dialogue.explain.explanation import (
    Evidence,
    Explanation,
    NeedRollout,
    NoExplanation,
    OutcomeEstimate,
)
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.quizzing import realise_quiz, realise_verdict
from xavi_dialogue.transports import ride_file

RIDES = sorted((Path(__file__).parents[2] / "transcripts").rglob("*.ride.jsonl.gz"))
CHANGED = Query(type="why", factual=("change-left",))
REMOVED = Query(type="what_if", actor="vehicle:1", negated=True, intervention="remove")
STAYED = Query(type="what_if", factual=("change-left",), counterfactual=("continue",))
WHO = Quiz(kind="vehicle", about=CHANGED, vehicle=1)
DEED = Quiz(kind="deed", about=REMOVED, actions=("continue",), same=False)
SAME = Quiz(kind="deed", about=REMOVED, actions=("exit-right",), same=True, sooner=True)
TIME = Quiz(kind="sooner", about=STAYED, sooner=False)


@cache
def ride(path: Path) -> ride_file.RecordedRide:
    return ride_file.load(path.read_bytes())


def record(path: Path, now: float) -> Record:
    known = ride(path)
    return Record(
        now,
        tuple(t for t in known.traces if t.sim_time <= now),
        tuple(e for e in known.events if e.sim_time <= now),
        extra=tuple(known.whatifs.values()),
    )


@cache
def s1() -> Record:
    return record(next(path for path in RIDES if path.name.startswith("s1")), 6.0)


def scene_of(known: Record, found: Explanation | None = None) -> Vehicles:
    wanted = found.evidence.traces if found else ()
    traces = [t for t in known.traces if t.trace_id in wanted] or [known.traces[-1]]
    return traces[0].scene


def changing() -> Vehicles:
    """Where everybody was when the lane change of s1 was decided."""
    return next(t.scene for t in s1().traces if t.sim_time >= 3.0)


def asked_back() -> Iterator[tuple[Quiz, Explanation, Record]]:
    """Every question that may be put on the recorded rides, with its answer."""
    for path in RIDES:
        for now in sorted({t.sim_time for t in ride(path).traces})[::3]:
            known = record(path, now)
            talks = ((), (CHANGED,), (REMOVED,))
            pool = {q: None for talk in talks for q in candidates(talk, talk, (), known)}
            for quiz in pool:
                found = explain(quiz.about, known)
                complete = filled(quiz, found) if isinstance(found, Explanation) else None
                if complete is not None and isinstance(found, Explanation):
                    yield complete, found, known


@cache
def posed() -> tuple[tuple[Quiz, Explanation, Record], ...]:
    return tuple(asked_back())


PHRASES = {
    "continue": ("you would have stayed in your lane", "keep going", "straight on"),
    "exit-right": ("turn right", "you'd have turned right I think", "taken the right turn"),
    "exit-left": ("turn left", "you'd have turned left I think", "taken the left turn"),
    "change-left": ("moved to the left lane", "change left", "you'd have changed lanes"),
    "change-right": ("moved to the right lane", "change right", "you'd have changed lanes"),
    "exit-straight": ("straight on", "gone straight ahead"),
    "continue-next-exit": ("taken the next exit", "you'd have driven past this exit"),
    "stop": ("stopped", "you'd have waited"),
}


def true_replies(quiz: Quiz) -> tuple[str, ...]:
    match quiz.kind:
        case "vehicle":
            return f"vehicle {quiz.vehicle}", f"{quiz.vehicle}", f"I think it was {quiz.vehicle}"
        case "deed":
            same = ("the same", "nothing would change", "what you did") if quiz.same else ()
            return (*PHRASES[quiz.actions[0]], *same)
        case "sooner":
            return ("sooner", "faster I guess") if quiz.sooner else ("later", "about 5s slower")


def false_replies(quiz: Quiz) -> tuple[str, ...]:
    match quiz.kind:
        case "vehicle":
            return "vehicle 9", "nobody", f"not {quiz.vehicle}"
        case "deed":
            others = [a for a in ("exit-left", "stop") if a != quiz.actions[0]]
            same = () if quiz.same else ("same thing", "nothing would be different")
            return (*(PHRASES[a][0] for a in others), *same)
        case "sooner":
            return ("later", "slower", "the same") if quiz.sooner else ("sooner", "same time")


def test_the_rides_give_questions_of_every_kind() -> None:
    kinds = {(quiz.kind, quiz.same) for quiz, _, _ in posed()}
    assert {("vehicle", None), ("sooner", None), ("deed", True), ("deed", False)} <= kinds


def test_the_truth_is_right_and_anything_else_is_wrong() -> None:
    for quiz, found, known in posed():
        scenes = (scene_of(known, found), scene_of(known))
        for text in true_replies(quiz):
            assert judged(quiz, text, scenes) == "right", (quiz, text)
        for text in false_replies(quiz):
            assert judged(quiz, text, scenes) == "wrong", (quiz, text)


def test_questions_and_verdicts_can_be_said() -> None:
    for quiz, found, _ in posed():
        asked = realise_quiz(quiz, SpeechContext()).text
        assert asked.endswith("?")
        assert asked.count("?") == 1
        for judgement in get_args(Judgement):
            assert realise_verdict(quiz, judgement, found, SpeechContext()).text.endswith(".")


def test_the_answer_follows_from_the_explanation_alone() -> None:
    for quiz, found, _ in posed():
        blank = Quiz(kind=quiz.kind, about=quiz.about)
        assert filled(blank, found) == quiz


def test_what_was_asked_before_is_not_asked_again() -> None:
    first, *rest = candidates((), (), (), s1())
    assert candidates((), (), (first,), s1())[: len(rest)] == tuple(rest)


def test_what_the_last_answer_told_comes_last() -> None:
    kinds = [quiz.kind for quiz in candidates((CHANGED,), (CHANGED,), (), s1())]
    assert kinds[0] == "deed"
    later = candidates((CHANGED, REMOVED), (CHANGED, REMOVED), (), s1())
    assert later[0].kind == "vehicle"
    assert later[-1].about == REMOVED


def test_there_is_nothing_to_ask_without_a_record() -> None:
    assert candidates((), (), (), Record(0.0)) == ()


EVIDENCE = Evidence("tree", 60, 20, ("0123456789abcdef",))
STAYING = Explanation(
    factual=("change-left",),
    counterfactual=("continue",),
    outcome=OutcomeEstimate("done", 1.0),
    effects=(effect("time", 5.0),),
    causes=(cause(1, ("exit-right",), 0.9),),
    evidence=EVIDENCE,
)


def with_time(delta: float, spread: float) -> Explanation:
    return Explanation(
        factual=("change-left",),
        counterfactual=("continue",),
        outcome=OutcomeEstimate("done", 1.0),
        effects=(effect("time", delta, spread),),
        causes=(),
        evidence=EVIDENCE,
    )


@pytest.mark.parametrize(
    ("delta", "spread", "sooner"),
    [(5.0, 1.0, False), (-5.0, 1.0, True), (0.9, 0.1, None), (5.0, 6.0, None)],
)
def test_times_are_asked_for_where_they_are_clear(
    delta: float, spread: float, sooner: bool | None
) -> None:
    complete = filled(Quiz(kind="sooner", about=STAYED), with_time(delta, spread))
    assert (complete and complete.sooner) is sooner


def test_no_vehicle_is_asked_for_where_two_are_to_blame() -> None:
    asked = Quiz(kind="vehicle", about=CHANGED)
    two = (*STAYING.causes, cause(2, ("stop",), 0.9))
    both = Explanation(
        factual=STAYING.factual,
        counterfactual=STAYING.counterfactual,
        outcome=STAYING.outcome,
        effects=STAYING.effects,
        causes=two,
        evidence=EVIDENCE,
    )
    complete = filled(asked, STAYING)
    assert complete is not None
    assert complete.vehicle == 1
    assert filled(asked, both) is None


@settings(max_examples=300)
@given(st.sampled_from([WHO, DEED, TIME]), explanations)
def test_any_explanation_gives_a_whole_answer_or_none(quiz: Quiz, found: Explanation) -> None:
    complete = filled(Quiz(kind=quiz.kind, about=quiz.about), found)
    if complete is not None:
        given = {
            "vehicle": complete.vehicle in {c.vehicle for c in found.causes},
            "deed": len(complete.actions) == 1 and complete.same is not None,
            "sooner": complete.sooner is not None,
        }
        assert given[quiz.kind]
    assert complete == filled(Quiz(kind=quiz.kind, about=quiz.about), found)


REPLIES: list[tuple[Quiz, Judgement | None, str]] = [
    (WHO, "right", "vehicle 1|the one on the left|car one|1|not 2 but 1|1, because it slowed"),
    (WHO, "right", "vehicle 1?|the car ahead on the left|erm, vehicel 1|vehicle 1, right?"),
    (WHO, "wrong", "vehicle 2|two|you did|nobody|vehicles 1 and 2|both|the car from the right"),
    (WHO, "passed", "no idea|I don't know which one|a car|you tell me|pass|what's the answer?"),
    (WHO, None, "why?|thanks|is vehicle 1 turning?|tell me about vehicle 1|quiz me|yes|"),
    (DEED, "right", "stay|you'd have stayed in your lane|just driven on|not changed lanes"),
    (DEED, "wrong", "same thing|nothing would change|overtake|left|stopped|what you did"),
    (DEED, "passed", "something else|not the same|stay or change lanes|beats me"),
    (DEED, None, "why?|would you have stayed?|yes|vehicle 1|what did you say?"),
    (SAME, "right", "the same thing|turned right|gone faster|it wouldn't have changed anything"),
    (SAME, "wrong", "turn left|something else|slower|change lanes"),
    (TIME, "right", "later|slower|no|about 5 seconds slower|not sooner|no, later|it'd take longer"),
    (TIME, "wrong", "sooner I guess|yes|not later|the same|no difference|about 3 seconds faster"),
    (TIME, "passed", "sooner or later|hard to say|who knows"),
    (TIME, None, "why later?|when will we arrive|how much later?|vehicle 2|ok"),
]


@pytest.mark.parametrize(
    ("quiz", "judgement", "text"),
    [(quiz, verdict, text) for quiz, verdict, texts in REPLIES for text in texts.split("|")],
)
def test_replies(quiz: Quiz, judgement: Judgement | None, text: str) -> None:
    assert judged(quiz, text, (changing(),)) == judgement


def test_a_description_of_several_vehicles_is_no_answer_yet() -> None:
    scene = changing()
    assert judged(WHO, "the other car", (scene,)) == "passed"
    alone = {name: state for name, state in scene.items() if name != 2}
    assert judged(WHO, "the other car", (alone,)) == "right"


def test_a_vehicle_can_be_called_what_we_call_it() -> None:
    scene = changing()
    for name, words in vehicle_words(scene).items():
        quiz = Quiz(kind="vehicle", about=CHANGED, vehicle=name)
        assert words.description is not None
        assert judged(quiz, words.description, (scene,)) in ("right", "passed")


WORDS = "you vehicle 1 2 the car not or , ? left right lane stay would have later same know why"


@settings(max_examples=300)
@given(
    st.sampled_from([WHO, DEED, SAME, TIME]),
    st.text(max_size=60) | st.lists(st.sampled_from(WORDS.split())).map(" ".join),
)
def test_any_reply_is_judged(quiz: Quiz, text: str) -> None:
    scenes = (scene_of(s1()),)
    verdict = judged(quiz, text, scenes)
    assert verdict in (*get_args(Judgement), None)
    assert verdict == judged(quiz, text, scenes)


def test_rides_lack_some_of_what_might_be_asked() -> None:
    """Else nothing above would show that such candidates are passed over."""
    known = dataclasses.replace(s1(), extra=())
    found = [explain(quiz.about, known) for quiz in candidates((), (), (), known)]
    assert any(isinstance(one, NoExplanation) for one in found)
    assert any(isinstance(one, NeedRollout) for one in found)
