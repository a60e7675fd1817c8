"""Mind: the faculties that the dialogue rests on, and how what is said comes about. Pure."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol, TypeAlias

import msgspec

from planner.trace import PlanTrace
from xavi_dialogue.dialogue.chain import BOTTOM
from xavi_dialogue.dialogue.events import Asked
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.dialogue.memory import Memory
from xavi_dialogue.dialogue.referents import PREFIX, vehicle_words
from xavi_dialogue.dialogue.reply import Kind, Reply
from xavi_dialogue.dialogue.turn import Quiz, Turn
from xavi_dialogue.explain.explanation import Explanation, NeedRollout, NoExplanation, Reason
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.when import Focus
from xavi_dialogue.language.context import SpeechContext, Utterance
from xavi_dialogue.language.realise import realise
from xavi_dialogue.language.suggestions import about_vehicle, from_situation


class NotUnderstood(Protocol):
    """What a parser returns instead of a query."""

    @property
    def cause(self) -> str: ...

    @property
    def readings(self) -> tuple[Query, ...]: ...


Parse: TypeAlias = Callable[[str, frozenset[int], Query | None], Query | NotUnderstood]
Explain: TypeAlias = Callable[[Query, Record], Explanation | NoExplanation | NeedRollout]


@dataclass(frozen=True, slots=True)
class Mind:
    """The two faculties that the dialogue rests on, as functions."""

    parse: Parse  # text, vehicles that exist, the question before
    explain: Explain


@dataclass(frozen=True, slots=True)
class Situation:
    """A question, and all there is to answer it from."""

    mind: Mind
    memory: Memory
    asked: Asked
    record: Record


@dataclass(frozen=True, slots=True)
class Said:
    """A reply, and what the conversation keeps of it."""

    query: Query | None
    reply: Reply
    leans: Query | None = None
    focus: Focus | None = None
    mentioned: tuple[int, ...] = ()
    choices: tuple[Query, ...] = ()
    quiz: Quiz | None = None
    answered: Quiz | None = None
    right: bool | None = None
    turned_away: bool = False

    def turn(self, asked: Asked, ride: str | None) -> Turn:
        """The turn to be kept."""
        return Turn(
            text=asked.text,
            query=self.query,
            reply=self.reply,
            ride=ride,
            leans=self.leans,
            focus=self.focus,
            mentioned=self.mentioned,
            choices=self.choices,
            quiz=self.quiz,
            answered=self.answered,
            right=self.right,
            turned_away=self.turned_away,
        )


def speech(now: Situation, trace: PlanTrace | None = None) -> SpeechContext:
    """The situation in which something is said: about `trace`, or else about now."""
    record, memory = now.record, now.memory
    if trace is None and record.traces:
        trace = record.traces[-1]
    done = tuple(e.action for e in carried_out(record.events) if e.action is not None)
    return SpeechContext(
        style=now.asked.style,
        vehicles={} if trace is None else vehicle_words(trace.scene),
        named=memory.named,
        detail=memory.detail,
        now=record.now,
        done=done,
        asked=memory.asked,
        turn=len(memory.turns),
        told=memory.told,
        suggested=memory.suggested,
    )


def inviting(now: Situation, context: SpeechContext, more: tuple[Query, ...] = ()) -> SpeechContext:
    """The situation with what of all that might be suggested would be declined."""
    offered = (*more, *from_situation(context))
    explain, record = now.mind.explain, replace(now.record, focus=None)
    closed = [q for q in offered if isinstance(explain(q, record), NoExplanation)]
    return replace(context, closed=tuple(closed))


def refuse(now: Situation, query: Query, why: NoExplanation) -> Said:
    """Say why there is no answer."""
    context = speech(now)
    more = (*why.suggestions, *about_vehicle(query, context))
    utterance = realise(query, why, inviting(now, context, more))
    reply = reply_of(now.record, utterance, why.reason, query)
    return Said(
        query,
        reply,
        leans=_corrected(query, why),
        focus=now.record.focus,
        mentioned=topics(query, utterance),
    )


def bottom(now: Situation, query: Query) -> Said:
    """Say that there are no further reasons; what was spoken of remains so."""
    last = now.memory.last
    said = refuse(now, msgspec.structs.replace(query, detail=None), BOTTOM)
    return replace(said, focus=None if last is None else last.focus)


def turn_away(now: Situation, reason: Reason) -> Said:
    """Say that the question cannot be taken up at all."""
    context = inviting(now, speech(now))
    utterance = realise(Query(type="what"), NoExplanation(reason=reason), context)
    return Said(None, reply_of(now.record, utterance, reason), turned_away=True)


def topics(query: Query, utterance: Utterance) -> tuple[int, ...]:
    """The vehicles that question and reply name, the most recent last."""
    tail = query.actor.removeprefix(PREFIX)
    asked = (int(tail),) if tail.isdecimal() and int(tail) != 0 else ()
    return (*utterance.mentioned, *asked)


def reply_of(
    record: Record, utterance: Utterance, reason: Reason | None, query: Query | None = None
) -> Reply:
    """The reply that says it: an answer where there is no reason against one."""
    kind: Kind = "answer" if reason is None else "refusal"
    if reason == "ambiguous":
        kind = "clarification"
    return Reply(
        text=utterance.text,
        kind=kind,
        reason=reason,
        query=query,
        choices=utterance.choices,
        suggestions=utterance.suggestions,
        sim_time=record.now,
    )


def _corrected(query: Query, why: NoExplanation) -> Query | None:
    """What a follow-up leans on after a refusal.

    Where a wrong premise was put right, on what did happen; where the foil was declined, on the
    question without it.
    """
    if why.reason in ("not-applicable", "too-little-evidence", "effect-too-small"):
        return msgspec.structs.replace(query, counterfactual=None, negated=False)
    happened = why.facts.get("happened")
    if why.reason != "did-not-happen" or not isinstance(happened, tuple) or not happened:
        return None
    if why.facts.get("planned") is True:
        return None
    return msgspec.convert(
        {
            **msgspec.to_builtins(Query(type="why", actor=query.actor, tense="past")),
            "factual": happened,
        },
        Query,
    )
