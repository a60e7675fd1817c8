"""From what was understood to what is said: explain, put into words. Pure."""

from dataclasses import replace

import msgspec

from planner.trace import PlanTrace
from xavi_dialogue.dialogue.chain import WHICH
from xavi_dialogue.dialogue.mind import (
    Said,
    Situation,
    bottom,
    inviting,
    refuse,
    reply_of,
    speech,
    topics,
)
from xavi_dialogue.dialogue.state import Understood
from xavi_dialogue.explain.engine import settled
from xavi_dialogue.explain.explanation import Explanation, NeedRollout, NoExplanation, Reason
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.doings import vehicle_of
from xavi_dialogue.language.realise import realise
from xavi_dialogue.language.refusals import (
    realise_help,
    realise_not_understood,
    realise_smalltalk,
)


def answer(now: Situation, understood: Understood) -> Said | NeedRollout:
    """The reply to what was understood, or what it takes to find it."""
    query = settled(understood.query, now.record)
    if query.type in ("smalltalk", "help", "ambiguous"):
        return _chat(now, query)
    found = now.mind.explain(query, now.record)
    if isinstance(found, NeedRollout):
        return found
    if isinstance(found, NoExplanation):
        return refuse(now, query, found)
    context = speech(now, explained_trace(found, now.record))
    context = replace(context, detail=context.detail or understood.detail)
    if query.event == WHICH:  # name it once more with where it is
        context = replace(context, named=context.named - {vehicle_of(query.actor)})
    if understood.again and _is_told(now, query, found, context):
        return bottom(now, query)
    repeated = not understood.again and now.memory.answered(query, found)
    context = replace(context, repeated=repeated)
    utterance = realise(query, found, context)
    reply = reply_of(now.record, utterance, None, query)
    trace_id = found.evidence.traces[0] if found.evidence.traces else None
    reply = msgspec.structs.replace(reply, explanation=found, trace_id=trace_id)
    mentioned, focus = topics(query, utterance), now.record.focus
    return Said(query, reply, _spelled_out(query, found), focus, mentioned)


def explained_trace(found: Explanation, record: Record) -> PlanTrace | None:
    """The recorded decision that an explanation is about."""
    wanted = frozenset(found.evidence.traces)
    known = (*record.traces, *record.extra)
    return next((trace for trace in known if trace.trace_id in wanted), None)


def _is_told(now: Situation, query: Query, found: Explanation, context: SpeechContext) -> bool:
    """Whether the last answer left nothing unsaid of what a bare "why?" asks for."""
    told = [turn.reply.explanation for turn in now.memory.turns[-2:]]
    if told[-1:] != [found]:
        return False
    plain = replace(context, turn=0, told=frozenset())
    fuller, as_told = (realise(query, found, replace(plain, detail=d)) for d in ("more", None))
    return told == [found, found] or context.detail != "more" or fuller.text == as_told.text


def _spelled_out(query: Query, found: Explanation) -> Query | None:
    """What a follow-up leans on after "why?": a question that names the deed explained."""
    if query.type != "why" or query.actor != "ego" or query.factual or not found.factual:
        return None
    return msgspec.structs.replace(query, factual=found.factual[:1])


def _chat(now: Situation, query: Query) -> Said:
    """What to say to small talk, to a request for help, and where it is not clear what is meant."""
    last = now.memory.last
    if query.event == "repeat" and last is not None:
        reply = msgspec.structs.replace(last.reply, sim_time=now.record.now)
        return Said(last.query, reply, last.leans, last.focus, last.mentioned, last.choices)
    context = inviting(now, speech(now))
    reason: Reason | None = None
    if query.type == "smalltalk":
        utterance = realise_smalltalk(query.event, context)
    elif query.type == "help":
        utterance = realise_help(context)
    else:
        utterance, reason = realise_not_understood("ambiguous", context), "ambiguous"
    return Said(query, reply_of(now.record, utterance, reason, query))
