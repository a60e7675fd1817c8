"""Pipeline: the stages of a reply as functions, and the making of a reply with them. Pure."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from xavi_dialogue.dialogue.explanation import as_json, evidence_of, explanation_of
from xavi_dialogue.dialogue.joining import joined
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.standing import REFUSALS, failed, standing_of
from xavi_dialogue.dialogue.state.events import Asked
from xavi_dialogue.dialogue.state.memory import Memory
from xavi_dialogue.dialogue.state.turn import Offer, Part, Quiz, Turn
from xavi_dialogue.domain.answers import Answer, Comforting, NeedRollout, Reason, Refusal, TakenAs
from xavi_dialogue.domain.discourse import Discourse, GroundedAct
from xavi_dialogue.domain.meaning import Reading
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.nlg.context import Looks, SpeechContext, Utterance
from xavi_dialogue.nlu.grounding.result import Grounding
from xavi_dialogue.nlu.grounding.salience import named_time
from xavi_dialogue.nlu.projection import project

Read: TypeAlias = Callable[[str], tuple[Reading, ...]]
Ground: TypeAlias = Callable[[tuple[Reading, ...], Record, Discourse], Grounding]
Explain: TypeAlias = Callable[[GroundedAct, Record], Answer | Refusal | NeedRollout]
Say: TypeAlias = Callable[[Answer | Refusal, SpeechContext], Utterance]
See: TypeAlias = Callable[[Record], Looks]


@dataclass(frozen=True, slots=True)
class Pipeline:
    """The stages of a reply, as functions: read, ground, explain, say."""

    read: Read  # text into readings, best first
    ground: Ground  # readings into acts about this world and conversation
    explain: Explain
    say: Say
    see: See  # looks of vehicles, for their descriptions


@dataclass(frozen=True, slots=True)
class Situation:
    """A question, and all that it can be answered from."""

    pipeline: Pipeline
    memory: Memory
    asked: Asked
    record: Record


@dataclass(frozen=True, slots=True)
class Said:
    """A reply, and what the conversation keeps from it."""

    reply: Reply
    parts: tuple[Part, ...] = ()
    mentioned: tuple[int, ...] = ()
    offer: Offer | None = None
    quiz: Quiz | None = None
    answered: Quiz | None = None
    right: bool | None = None
    turned_away: bool = False

    def turn(self, asked: Asked, ride: str | None) -> Turn:
        """Return the turn to be kept."""
        return Turn(
            text=asked.text,
            parts=self.parts,
            reply=self.reply,
            ride=ride,
            mentioned=self.mentioned,
            offer=self.offer,
            quiz=self.quiz,
            answered=self.answered,
            right=self.right,
            turned_away=self.turned_away,
        )


def speech(now: Situation) -> SpeechContext:
    """Return the context for wording an answer."""
    memory = now.memory
    return SpeechContext(
        style=now.asked.style,
        now=now.record.now,
        looks=now.pipeline.see(now.record),
        named=memory.named,
        detail=memory.detail,
        turn=sum(not turn.turned_away for turn in memory.turns),
        told=memory.told,
        suggested=memory.suggested,
    )


def speak(
    now: Situation, said: Sequence[Part], offer: Offer | None = None, taken_as: str = ""
) -> Said:
    """Put results into words, one after the other, without repetition.

    Args:
        now: the question and all that it can be answered from.
        said: the results.
        offer: what a clarification offers.
        taken_as: the plain question as which an unclear one was understood, stated first.
    """
    context = speech(now)
    utterances: list[Utterance] = []
    for part in said:
        repeated = part.act is not None and now.memory.answered(part.act, part.result)
        detail = "less" if len(said) > 1 and _is_aside(part.result) else context.detail
        own = replace(context, repeated=repeated, detail=detail, then=_is_named(part.act, now))
        one = now.pipeline.say(part.result, own)
        context = replace(context, named=context.named | frozenset(one.mentioned))
        utterances.append(one)
    whole = joined(utterances)
    if taken_as and any(not isinstance(part.result, REFUSALS) for part in said):
        before = Part(None, TakenAs(taken_as))
        said = (before, *said)
        whole = replace(whole, text=f"{now.pipeline.say(before.result, context).text} {whole.text}")
    open_offer = offer if whole.choices else None
    return Said(reply_of(now, said, whole), tuple(said), whole.mentioned, open_offer)


def _is_named(act: GroundedAct | None, now: Situation) -> bool:
    """Check whether an act names a time in the past."""
    return act is not None and named_time(act, now.record.now) is not None


def _is_aside(result: Answer | Refusal) -> bool:
    """Check whether a result only precedes another: sympathy without a fact of its own."""
    return isinstance(result, Comforting) and result.fact is None


def reply_of(now: Situation, said: Sequence[Part], whole: Utterance) -> Reply:
    """Return the reply for results and their words."""
    results = tuple(part.result for part in said)
    acts = tuple(dict.fromkeys(part.act for part in said if part.act is not None))
    kind, reason = standing_of(results)
    evidence = evidence_of(results)
    return Reply(
        text=whole.text,
        kind=kind,
        reason=reason,
        query=project(tuple(act.act for act in acts)) if acts else None,
        explanation=explanation_of(results) if kind == "answer" else None,
        acts=tuple(as_json(act) for act in acts),
        answers=tuple(as_json(result) for result in results),
        choices=whole.choices,
        suggestions=whole.suggestions,
        trace_id=None if evidence is None else evidence.traces[0],
        sim_time=now.record.now,
    )


def turn_away(now: Situation, reason: Reason) -> Said:
    """Reply that the question cannot be answered now."""
    return replace(speak(now, (Part(None, failed(reason)),)), turned_away=True)
