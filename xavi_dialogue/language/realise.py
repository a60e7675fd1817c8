"""Realiser: explanations and refusals into English.

Four stages, each of which can be looked at (`stages`): content selection, expansion of an answer
grammar into tokens, morphology, orthography. All sentences stand in `grammars/`; wording varies
with what is said and with the context, never by chance.

The errors that the stages raise (GrammarError, FormError, WordingError) mean that a language
file is at fault; no explanation raises them as long as the grammars provide for all its values.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from xavi_dialogue.explain.explanation import Explanation, NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.content import AnyContent, select
from xavi_dialogue.language.context import SpeechContext, Utterance
from xavi_dialogue.language.generator import Token, expand
from xavi_dialogue.language.impact import ImpactPoint
from xavi_dialogue.language.morphology import inflect
from xavi_dialogue.language.options import NeedPoint, OptionsPoint, StayPoint
from xavi_dialogue.language.orthography import capitalise, count_sentences, count_words, join
from xavi_dialogue.language.paper import PaperContent, select_paper
from xavi_dialogue.language.points import (
    ActivityPoint,
    Budget,
    Constraint,
    Contrast,
    Evasion,
    Factor,
    GroundsPoint,
    Method,
    Motive,
    Plan,
    Supposition,
    Sureness,
    Time,
    Unmoved,
)
from xavi_dialogue.language.quantities import Quantity
from xavi_dialogue.language.questions import questions
from xavi_dialogue.language.ranking import Comparison
from xavi_dialogue.language.refusals import refuse
from xavi_dialogue.language.rules import load_grammar
from xavi_dialogue.language.sights import SightPoint
from xavi_dialogue.language.suggestions import follow_ups
from xavi_dialogue.language.wording import rewrite

#: The rule of `grammars/answer_passenger.rules` for each kind of content that has but one.
RULES: dict[type, str] = {
    Constraint: "CONSTRAINT",
    Time: "WHEN",
    Supposition: "SUPPOSE",
    Motive: "MOTIVE",
    GroundsPoint: "GROUNDS",
    Plan: "PLAN",
    Method: "METHOD",
    Sureness: "SURENESS",
    Evasion: "EVASION",
    ImpactPoint: "IMPACT",
    Factor: "FACTOR",
    Unmoved: "UNMOVED",
    Comparison: "COMPARISON",
    SightPoint: "SIGHT",
    OptionsPoint: "OPTIONS",
    NeedPoint: "NEED",
    StayPoint: "LANE",
}
WAYS = 3  # in which answers are worded
MAX_WORDS = 45
MAX_SENTENCES = 3
MAX_WORDS_MORE = 110


@dataclass(frozen=True, slots=True)
class Stages:
    """One answer in every stage of its making."""

    content: AnyContent | PaperContent
    tokens: tuple[Token, ...]
    words: tuple[str, ...]
    text: str
    mentioned: tuple[int, ...]


def realise(query: Query, result: Explanation | NoExplanation, context: SpeechContext) -> Utterance:
    """What the car says to `query`: an answer from an explanation, or a refusal."""
    detail = query.detail or context.detail
    context = replace(context, detail=detail)
    if isinstance(result, NoExplanation):
        return refuse(query, result, context)
    made = stages(query, result, context)
    return Utterance(
        text=made.text,
        mentioned=made.mentioned,
        suggestions=questions(follow_ups(query, result, made.mentioned, context.asked)),
    )


def stages(query: Query, found: Explanation, context: SpeechContext) -> Stages:
    """The answer to `query` in all its stages.

    Style `paper` applies to contrasts, of which alone the paper has sentences. Style `passenger`
    takes the fullest wording that keeps within its limits of words and sentences.
    """
    if context.style == "paper" and _contrasts(found):
        return _paper(found, context)
    more = context.detail == "more"
    limit = MAX_WORDS_MORE if more else MAX_WORDS
    for budget in _budgets(context):
        made = _passenger(query, found, context, budget)
        short = more or count_sentences(made.text) <= MAX_SENTENCES
        if short and count_words(made.text) <= limit:
            break
    return made


def _contrasts(found: Explanation) -> bool:
    return bool(found.counterfactual) and found.outcome is not None and found.impact is None


def _budgets(context: SpeechContext) -> Iterator[Budget]:
    """Ways to answer, from the fullest to the barest."""
    if context.detail == "more":
        yield Budget(max(3, context.max_effects), max(3, context.max_causes), more=True)
        yield Budget(2, 2, more=True)
        yield Budget(1, 1, more=True)
    brief = context.detail == "less" or (context.repeated and context.detail is None)
    full = Budget(
        context.max_effects,
        context.max_causes,
        purpose=context.detail != "less",
        told=frozenset() if context.detail == "more" else context.told,
    )
    if not brief:
        yield full
    yield replace(full, particulars=False)
    yield replace(full, particulars=False, describe=False)
    barest = Budget(min(1, full.effects), min(1, full.causes), full.purpose, False, False)
    yield barest
    yield replace(barest, purpose=False)
    yield replace(barest, purpose=False, causes=0)


def _passenger(query: Query, found: Explanation, context: SpeechContext, budget: Budget) -> Stages:
    content = select(query, found, budget, context.now)
    content = _worded(content, 0 if found.then is not None else context.turn % WAYS)
    grammar = load_grammar("answer_passenger")
    tokens = expand(grammar, _rule(content), content)
    plain = found.suspect is None and found.need is None and found.sight is None
    if found.then is not None and plain:
        at = Quantity(found.then, "clock")
        decided = query.type == "why" and found.then == found.sim_time
        about = "decision" if decided and found.counterfactual else query.tense
        tokens = (*expand(grammar, "AT_TIME", at, about), *tokens)
    tokens = (*expand(grammar, "AGAIN", context), *tokens)
    words, mentioned = inflect(tokens, context, describe=budget.describe)
    text = capitalise(rewrite(join(words), "passenger"))
    return Stages(content, tokens, words, text, mentioned)


def _worded(content: AnyContent, way: int) -> AnyContent:
    """The content, to be worded in one of several ways where there are some for its kind."""
    if isinstance(content, Contrast | Constraint | Supposition | Motive | ActivityPoint):
        return replace(content, way=way)
    return content


def _rule(content: AnyContent) -> str:
    if isinstance(content, Contrast | ActivityPoint):
        return content.rule
    return RULES[type(content)]


def _paper(found: Explanation, context: SpeechContext) -> Stages:
    content = select_paper(found, context.max_effects, context.max_causes)
    grammar = load_grammar("answer_paper")
    tokens = expand(grammar, "S", content.scenario, content.effects, content.causes)
    words, mentioned = inflect(tokens, context)
    text = capitalise(rewrite(join(words), "paper"))
    return Stages(content, tokens, words, text, mentioned)
