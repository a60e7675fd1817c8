"""Quizzes: questions of ours to the passenger, and our judgement of the replies."""

from typing import Any

from xavi_dialogue.domain.answers import Judged, NothingToAsk, Posed
from xavi_dialogue.domain.meaning import WhatIf, Why
from xavi_dialogue.domain.terms import Happens, Not, Proposition
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.propositions import clause_of
from xavi_dialogue.nlg.content.talk.refusals import proposed
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import message
from xavi_dialogue.nlg.surface.values import Clause, Tense

WORDINGS = 3  # number of wordings of a verdict, which take turns


def plan_posed(answer: Posed, context: SpeechContext) -> Plan:
    """Plan a question of ours: who made us do it, what we would have done, or when be there."""
    match answer.about:
        case Why(of=about) | WhatIf(supposed=about):
            past = _past(about)
        case _:
            return Plan((message("NOTHING_TO_ASK", asked=False),))
    tense: Tense = "past"
    if answer.kind == "deed" and past:
        tense = "past-perfect"
    deed: Clause = clause_of(about, context.now, tense=tense)
    return Plan((message("POSED", kind=answer.kind, past=past, deed=deed, again=answer.again),))


def _past(about: Proposition) -> bool:
    inner: Any = about
    while isinstance(inner, Not):
        inner = inner.content
    told = inner.event if isinstance(inner, Happens) else inner
    return getattr(told, "tense", "past") in ("past", "perfect")


def plan_judged(answer: Judged, context: SpeechContext) -> Plan:
    """Plan whether a reply was right, and the solution."""
    verdict = message("JUDGED", judgement=answer.judgement, turn=context.turn % WORDINGS)
    return Plan((verdict, answer.answer))


def plan_nothing_to_ask(answer: NothingToAsk, context: SpeechContext) -> Plan:
    """Plan that there is no question left to ask, and what the passenger can ask instead."""
    shown, found = proposed(context)
    return Plan((message("NOTHING_TO_ASK", asked=answer.asked),), shown, (), (), found)
