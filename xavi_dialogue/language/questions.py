"""Questions: a Query back into the passenger's words."""

from dataclasses import dataclass

from xavi_dialogue.explain.query import Query, Tense
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.doings import doing
from xavi_dialogue.language.generator import expand
from xavi_dialogue.language.morphology import YOU, Doing, Vehicle, inflect
from xavi_dialogue.language.orthography import capitalise, join
from xavi_dialogue.language.rules import load_grammar
from xavi_dialogue.language.wording import lexicon


@dataclass(frozen=True, slots=True)
class Question:
    """What `grammars/answer_questions.rules` says of a query."""

    type: str
    mine: bool  # about the car itself
    who: Vehicle | str
    deed: Doing | None  # the actions it asks about
    other: Doing | None  # what they are contrasted with
    tense: Tense
    negated: bool


def question(query: Query) -> str:
    """The query as a question that the passenger might ask."""
    tokens = expand(load_grammar("answer_questions"), "QUESTION", _content(query))
    words, _ = inflect(tokens, SpeechContext())
    return capitalise(join(words))


def questions(queries: tuple[Query, ...], limit: int = 3) -> tuple[str, ...]:
    """The first few of the queries as questions, none twice."""
    return tuple(dict.fromkeys(map(question, queries)))[:limit]


def _content(query: Query) -> Question:
    who, number = _who(query.actor)
    factual, foil = query.factual or (), query.counterfactual or ()
    about = {"why": factual, "why_not": foil, "what_if": foil}
    deed = about.get(query.type, factual or foil)
    lane_change = any(a.startswith("change") for a in (*factual, *foil))
    in_lane = query.type == "why" and lane_change
    return Question(
        type=query.type,
        mine=number == YOU,
        who=who,
        deed=doing(number, deed, query.tense, in_lane),
        other=doing(number, foil, query.tense, in_lane) if query.type == "why" else None,
        tense=query.tense,
        negated=query.negated,
    )


def _who(actor: str) -> tuple[Vehicle | str, int]:
    """How the actor is spoken of, and its number for agreement (YOU: the car itself)."""
    kind, _, tail = actor.partition(":")
    if kind != "vehicle" or tail == "0":
        return "you", YOU
    if tail.isdecimal():
        return Vehicle(int(tail)), int(tail)
    described = lexicon().described
    return described.get(tail, described["default"].format(tail)), 1
