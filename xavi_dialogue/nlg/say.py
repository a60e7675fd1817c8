"""Say: the realiser, which turns answers and refusals into English.

Stages: content planning (a planner for each type of answer), expansion of the grammars into
tokens, morphology, orthography. Wording depends only on the answer and the context, never on
chance.

Errors: GrammarError and WordingError mean that a file of the grammars is at fault. No answer
raises them, whatever values it lacks.
"""

from contextlib import suppress
from dataclasses import replace

from xavi_dialogue.domain import answers
from xavi_dialogue.domain.answers import Again, Answer, Refusal
from xavi_dialogue.nlg.content.causal_tables import CAUSES, REFUSALS
from xavi_dialogue.nlg.content.clauses.plan import Part, Plan, Planner
from xavi_dialogue.nlg.content.tables import FACTS
from xavi_dialogue.nlg.context import Detail, SpeechContext, Utterance
from xavi_dialogue.nlg.paper import mentioned as mentioned_in
from xavi_dialogue.nlg.paper import paper_text
from xavi_dialogue.nlg.surface.generator import ExpansionError
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.orthography import capitalise
from xavi_dialogue.nlg.surface.realiser import realised
from xavi_dialogue.nlg.surface.referring import ReferringContext

#: The planner of each type of answer and refusal.
PLANNERS: dict[type, Planner] = {**FACTS, **CAUSES, **REFUSALS}
DETAILS: dict[str, Detail] = {
    "repeat": "usual",
    "simpler": "simpler",
    "shorter": "less",
    "longer": "more",
}
#: Types of answers that are never introduced as a repetition.
QUIET = (answers.Sociable, answers.Helpful, answers.Acknowledged, answers.Comforting,
         answers.Declined, answers.TakenAs, answers.Unfamiliar, answers.Posed, answers.Judged,
         answers.NothingToAsk, answers.WhichOne, Again)  # fmt: skip
USUAL = 3  # maximum of sentences of an answer, unless more is wanted


def say(answer: Answer | Refusal, context: SpeechContext) -> Utterance:
    """Return what the car says: an answer or a refusal in words."""
    wanted = context
    if isinstance(answer, Again):
        wanted = replace(context, detail=DETAILS[answer.how])
    paper = paper_text(answer, wanted) if wanted.style == "paper" else None
    if paper is not None:
        return Utterance(paper, mentioned_in(paper))
    plan = planned(answer, wanted)
    said = _picked(answer, plan, wanted)
    text, named = _told(said, wanted)
    if isinstance(answer, Again) and answer.how != "repeat" and answer.answer is not None:
        before, _ = _told(_picked(answer, planned(answer, context), context), context)
        if text == before:
            lead = message("NOT_OTHERWISE", how=answer.how, it=said[0])
            text, named = _told([lead, *said[1:]], wanted)
    choices = tuple(
        realised(m, wanted, ReferringContext(wanted, passenger=True)).removesuffix(".")
        for m in plan.choices
    )
    return Utterance(capitalise(text), named, choices, plan.suggestions)


def _told(said: list[Message], context: SpeechContext) -> tuple[str, tuple[int, ...]]:
    """Return the sentences of messages, and the vehicles that they name.

    A message that lacks a value that its rule needs is left out.
    """
    speaker = ReferringContext(context)
    found: list[str] = []
    for one in said:
        with suppress(ExpansionError):
            found.append(realised(one, context, speaker))
    text = " ".join(found) or realised(message("NO_WORDS"), context, speaker)
    return text, tuple(speaker.mentioned)


def planned(answer: Answer | Refusal, context: SpeechContext) -> Plan:
    """Return the messages of an answer, with those of the answers within it."""
    plan = PLANNERS.get(type(answer), _unplanned)(answer, context)
    core: list[Message] = []
    details, more, choices = plan.details, plan.more, plan.choices
    suggestions = plan.suggestions
    for part in plan.core:
        if isinstance(part, Message):
            core.append(part)
            continue
        inner = planned(part, context)
        core += [one for one in inner.core if isinstance(one, Message)]
        details, more = (*inner.details, *details), (*inner.more, *more)
        choices, suggestions = (*choices, *inner.choices), (*suggestions, *inner.suggestions)
    return Plan(tuple(core), details, more, choices, suggestions)


def _picked(answer: Answer | Refusal, plan: Plan, context: SpeechContext) -> list[Message]:
    """Return the messages to be said, by the level of detail that the passenger wants."""
    parts: list[Part] = list(plan.core)
    if context.detail == "more":
        parts += [*plan.details, *plan.more]
    elif context.detail == "usual":
        parts += plan.details[: max(USUAL - len(parts), 0)]
    said = [part for part in parts if isinstance(part, Message)]
    if context.repeated and said and not isinstance(answer, QUIET):
        said[0] = message("AS_SAID", it=said[0])
    return said


def _unplanned(answer: Answer | Refusal, context: SpeechContext) -> Plan:
    """Plan the statement that there are no words for an answer of this type."""
    return Plan((message("NO_WORDS"),))
