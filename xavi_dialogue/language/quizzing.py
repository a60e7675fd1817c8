"""Quizzing: the questions that the car asks its passenger, and what it says to the replies."""

from dataclasses import dataclass, replace
from typing import Literal, Protocol

from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query, Tense
from xavi_dialogue.language.context import SpeechContext, Utterance
from xavi_dialogue.language.doings import LANE_CHANGES, doing, vehicle_of
from xavi_dialogue.language.generator import Token, expand
from xavi_dialogue.language.morphology import EGO, Doing, Vehicle, inflect
from xavi_dialogue.language.orthography import capitalise, join
from xavi_dialogue.language.questions import questions
from xavi_dialogue.language.realise import realise
from xavi_dialogue.language.rules import load_grammar
from xavi_dialogue.language.suggestions import from_situation

_OPENINGS = 3  # ways to begin a verdict, of each kind


class Asking(Protocol):
    """What a question of ours is about."""

    @property
    def kind(self) -> Literal["vehicle", "deed", "sooner"]: ...

    @property
    def about(self) -> Query: ...


@dataclass(frozen=True, slots=True)
class Asked:
    """What `grammars/answer_quiz.rules` says of a question of ours."""

    kind: str
    tense: Tense
    vehicle: Vehicle | None  # that something is supposed of
    deed: Doing | None  # what we did
    foil: Doing | None  # what we, or that vehicle, might have done; None: it had not been there
    negated: bool


@dataclass(frozen=True, slots=True)
class Verdict:
    """What it says to a reply."""

    judgement: str  # right, wrong or passed
    turn: int  # which of the openings, from 0
    answer: str


@dataclass(frozen=True, slots=True)
class Nothing:
    """What it says where there is nothing to ask."""

    suggestion: str | None
    asked: bool  # the passenger has been asked before


def realise_quiz(quiz: Asking, context: SpeechContext, *, again: bool = False) -> Utterance:
    """The question as the car puts it: "What would I have done if ...?".

    Args:
        quiz: the question.
        context: the situation.
        again: it was put before, and the reply was no answer.
    """
    about = quiz.about
    actor = vehicle_of(about.actor)
    in_lane = any(action in LANE_CHANGES for action in about.factual or ())
    removed = about.intervention == "remove"
    foil = () if removed else about.counterfactual or ()
    content = Asked(
        kind=quiz.kind,
        tense=about.tense,
        vehicle=None if actor is None else Vehicle(actor),
        deed=doing(EGO, about.factual or (), about.tense),
        foil=doing(actor or EGO, foil, about.tense, in_lane=in_lane and actor is None),
        negated=about.negated,
    )
    return _speak(
        expand(load_grammar("answer_quiz"), "AGAIN" if again else "QUIZ", content), context
    )


def realise_verdict(
    quiz: Asking,
    judgement: Literal["right", "wrong", "passed"],
    found: Explanation,
    context: SpeechContext,
) -> Utterance:
    """Whether the reply was right, and the answer in few words.

    Args:
        quiz: the question.
        judgement: what the reply came to; "passed": it was not known.
        found: the explanation of `quiz.about`.
        context: the situation.
    """
    answer = realise(quiz.about, found, replace(context, style="passenger", detail="less"))
    verdict = Verdict(judgement, len(context.asked) % _OPENINGS, answer.text)
    said = _speak(expand(load_grammar("answer_quiz"), "VERDICT", verdict), context)
    return replace(said, mentioned=answer.mentioned, suggestions=answer.suggestions)


def realise_no_quiz(context: SpeechContext, *, asked: bool = False) -> Utterance:
    """That there is nothing to ask about, and what the passenger may ask instead.

    Args:
        context: the situation.
        asked: the passenger has been asked before.
    """
    offered = questions(from_situation(context))
    content = Nothing(next(iter(offered), None), asked)
    said = _speak(expand(load_grammar("answer_quiz"), "NOTHING", content), context)
    return replace(said, suggestions=offered)


def _speak(tokens: tuple[Token, ...], context: SpeechContext) -> Utterance:
    words, mentioned = inflect(tokens, context)
    return Utterance(capitalise(join(words)), mentioned)
