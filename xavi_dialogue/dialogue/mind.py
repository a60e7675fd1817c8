"""From a question to what is said: understand, refer, explain, put into words. Pure."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol, TypeAlias

import msgspec

from planner.trace import PlanTrace
from xavi_dialogue.dialogue.bearings import Vehicles
from xavi_dialogue.dialogue.choices import chosen
from xavi_dialogue.dialogue.events import Asked
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.dialogue.referents import (
    PREFIX,
    Scope,
    candidates,
    described,
    scenes_of,
    vehicle_words,
)
from xavi_dialogue.dialogue.reply import Kind, Reply
from xavi_dialogue.dialogue.state import Session, Understood
from xavi_dialogue.explain.engine import settled
from xavi_dialogue.explain.explanation import Explanation, NeedRollout, NoExplanation, Reason
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.language.context import SpeechContext, Utterance
from xavi_dialogue.language.questions import questions
from xavi_dialogue.language.realise import realise
from xavi_dialogue.language.refusals import (
    MAX_CHOICES,
    realise_clarification,
    realise_help,
    realise_not_understood,
    realise_smalltalk,
)
from xavi_dialogue.language.suggestions import about_vehicle, from_situation

CONTEXT_TURNS = 6  # earlier turns that a question may lean on


class NotUnderstood(Protocol):
    """What a parser returns instead of a query."""

    @property
    def cause(self) -> str: ...

    @property
    def readings(self) -> tuple[Query, ...]: ...


Parse: TypeAlias = Callable[[str, frozenset[int], tuple[str, ...]], Query | NotUnderstood]
Explain: TypeAlias = Callable[[Query, Record], Explanation | NoExplanation | NeedRollout]


@dataclass(frozen=True, slots=True)
class Mind:
    """The two faculties that the dialogue rests on, as functions."""

    parse: Parse  # text, vehicles that exist, earlier turns
    explain: Explain


@dataclass(frozen=True, slots=True)
class Said:
    """A reply, and what the conversation keeps of it."""

    text: str  # the question, as later turns may lean on it
    query: Query | None
    reply: Reply
    mentioned: tuple[int, ...] = ()
    choices: tuple[Query, ...] = ()


def understand(mind: Mind, session: Session, asked: Asked, record: Record) -> Understood | Said:
    """What is asked, or what to say where that is not clear."""
    pick = chosen(asked.text, len(session.choices)) if session.choices else None
    if pick is not None:
        query = session.choices[pick]
        return _refer(mind, session, asked, record, questions((query,))[0], query)
    text = asked.text
    earlier = tuple(turn.text for turn in session.turns if turn.query is not None)
    vehicles = frozenset(vehicle for trace in record.traces for vehicle in trace.scene) | {0}
    parsed = mind.parse(text, vehicles, earlier[-CONTEXT_TURNS:])
    if isinstance(parsed, Query):
        return _refer(mind, session, asked, record, text, parsed)
    context = _inviting(mind, record, speech(session, asked, record))
    readings = parsed.readings[:MAX_CHOICES]
    utterance = realise_not_understood(parsed.cause, context, readings)
    reason: Reason = "ambiguous" if utterance.choices else "not-understood"
    reply = _reply(record, utterance, reason)
    return Said(text, None, reply, choices=readings if utterance.choices else ())


def answer(
    mind: Mind, session: Session, asked: Asked, record: Record, understood: Understood
) -> Said | NeedRollout:
    """The reply to a question that was understood, or what it takes to find it."""
    understood = replace(understood, query=settled(understood.query, record))
    text, query = understood.text, understood.query
    if query.type in ("smalltalk", "help", "ambiguous"):
        return _chat(mind, session, asked, record, understood)
    found = mind.explain(query, record)
    if isinstance(found, NeedRollout):
        return found
    if isinstance(found, NoExplanation):
        return refuse(mind, session, asked, record, understood, found)
    trace = explained_trace(found, record)
    context = speech(session, asked, record, trace)
    utterance = realise(query, found, context)
    reply = _reply(record, utterance, None, query)
    trace_id = found.evidence.traces[0] if found.evidence.traces else None
    reply = msgspec.structs.replace(reply, explanation=found, trace_id=trace_id)
    return Said(text, query, reply, _topics(query, utterance))


def _chat(
    mind: Mind, session: Session, asked: Asked, record: Record, understood: Understood
) -> Said:
    """What to say to small talk, to a request for help, and where it is not clear what is meant."""
    query = understood.query
    context = _inviting(mind, record, speech(session, asked, record))
    reason: Reason | None = None
    if query.type == "smalltalk":
        utterance = realise_smalltalk(query.event, context)
    elif query.type == "help":
        utterance = realise_help(context)
    else:
        utterance, reason = realise_not_understood("ambiguous", context), "ambiguous"
    return Said(understood.text, query, _reply(record, utterance, reason, query))


def refuse(
    mind: Mind,
    session: Session,
    asked: Asked,
    record: Record,
    understood: Understood,
    why: NoExplanation,
) -> Said:
    """Say why there is no answer."""
    query = understood.query
    context = speech(session, asked, record)
    more = (*why.suggestions, *about_vehicle(query, context))
    utterance = realise(query, why, _inviting(mind, record, context, more))
    reply = _reply(record, utterance, why.reason, query)
    return Said(understood.text, query, reply, _topics(query, utterance))


def turn_away(mind: Mind, session: Session, asked: Asked, record: Record, reason: Reason) -> Said:
    """Say that the question cannot be taken up at all."""
    context = _inviting(mind, record, speech(session, asked, record))
    utterance = realise(Query(type="what"), NoExplanation(reason=reason), context)
    return Said(asked.text, None, _reply(record, utterance, reason))


def speech(
    session: Session, asked: Asked, record: Record, trace: PlanTrace | None = None
) -> SpeechContext:
    """The situation in which something is said: about `trace`, or else about now."""
    if trace is None and record.traces:
        trace = record.traces[-1]
    done = tuple(e.action for e in carried_out(record.events) if e.action is not None)
    return SpeechContext(
        style=asked.style,
        vehicles={} if trace is None else vehicle_words(trace.scene),
        named=session.named,
        now=record.now,
        done=done,
        asked=tuple(turn.query for turn in session.turns if turn.query is not None),
    )


def _inviting(
    mind: Mind, record: Record, context: SpeechContext, more: tuple[Query, ...] = ()
) -> SpeechContext:
    """The situation with what of all that might be suggested would be declined."""
    offered = (*more, *from_situation(context))
    closed = [q for q in offered if isinstance(mind.explain(q, record), NoExplanation)]
    return replace(context, closed=tuple(closed))


def explained_trace(found: Explanation, record: Record) -> PlanTrace | None:
    """The recorded decision that an explanation is about."""
    wanted = frozenset(found.evidence.traces)
    known = (*record.traces, *record.extra)
    return next((trace for trace in known if trace.trace_id in wanted), None)


def _refer(
    mind: Mind, session: Session, asked: Asked, record: Record, text: str, query: Query
) -> Understood | Said:
    """Put numbers in the place of descriptions of vehicles.

    Of several that a suspected one may be, none is asked about: the answer names the causes.
    """
    scope = Scope(_scenes(query, record), session.topic)
    suspected, acting = described(query.hypothesised_cause or ""), described(query.actor)
    suspects = None if suspected is None else candidates(suspected, scope)
    if suspects is not None and len(suspects) == 1:
        query = msgspec.structs.replace(query, hypothesised_cause=f"{PREFIX}{suspects[0]}")
    found = None if acting is None else candidates(acting, scope)
    if suspects == () or found == ():
        known = {name for trace in record.traces for name in trace.scene} - {0}
        facts = {"known": tuple(f"vehicle {name}" for name in sorted(known))}
        unseen = acting if found == () else suspected
        why = NoExplanation(reason="unknown-vehicle", facts={"asked": unseen, **facts})
        return refuse(mind, session, asked, record, Understood(text, query), why)
    if found is None:
        return Understood(text, query)
    meant = tuple(msgspec.structs.replace(query, actor=f"{PREFIX}{name}") for name in found)
    if len(meant) == 1:
        return Understood(text, meant[0])
    offered = meant[:MAX_CHOICES]
    utterance = realise_clarification(
        questions(offered, MAX_CHOICES), speech(session, asked, record)
    )
    reply = _reply(record, utterance, "ambiguous", query)
    return Said(text, query, reply, choices=offered)


def _scenes(query: Query, record: Record) -> tuple[Vehicles, ...]:
    """The scenes that the question may be about, the likeliest first.

    A question about the past is about the decision behind the latest manoeuvre; any other is
    about what is seen now.
    """
    latest_first = tuple(reversed(record.traces))
    if query.tense != "past":
        return scenes_of(latest_first)
    decisions = [event.decision for event in carried_out(record.events)][-1:]
    behind = tuple(trace for trace in latest_first if trace.decision in decisions)
    return scenes_of((*behind, *latest_first))


def _topics(query: Query, utterance: Utterance) -> tuple[int, ...]:
    """The vehicles that question and reply name, the most recent last."""
    tail = query.actor.removeprefix(PREFIX)
    asked = (int(tail),) if tail.isdecimal() and int(tail) != 0 else ()
    return (*utterance.mentioned, *asked)


def _reply(
    record: Record, utterance: Utterance, reason: Reason | None, query: Query | None = None
) -> Reply:
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
