"""Pointing: numbers in the place of descriptions of vehicles, or the question which is meant."""

import msgspec

from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.dialogue.mind import Said, Situation, inviting, refuse, reply_of, speech
from xavi_dialogue.dialogue.referents import PREFIX, Scope, candidates, described, scenes_of
from xavi_dialogue.dialogue.state import Understood
from xavi_dialogue.explain.bearings import Vehicles
from xavi_dialogue.explain.explanation import Facts, NoExplanation, Reason
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.when import Focus
from xavi_dialogue.explain.whereabouts import is_place, place_asked
from xavi_dialogue.language.questions import question, questions
from xavi_dialogue.language.refusals import (
    MAX_CHOICES,
    realise_clarification,
    realise_not_understood,
)


def refer(now: Situation, query: Query, then: Focus | None = None) -> Understood | Said:
    """Put numbers in the place of descriptions of vehicles.

    Of several that a suspected one may be, none is asked about: the answer names the causes.
    Where it is asked who is at a place and nobody is, the description stays, for the answer to
    say so.

    Args:
        now: the question and what there is to understand it from.
        query: what it asks.
        then: the part of the ride that it speaks of, if any.
    """
    text, record = now.asked.text, now.record
    moments = _moments(query, record, then)
    scope = Scope(scenes_for(query, record), now.memory.topic, moments)
    suspected, acting = described(query.hypothesised_cause or ""), described(query.actor)
    suspects = None if suspected is None else candidates(suspected, scope)
    if suspects is not None and len(suspects) == 1:
        query = msgspec.structs.replace(query, hypothesised_cause=f"{PREFIX}{suspects[0]}")
    found = None if acting is None else candidates(acting, scope)
    at_once = then is not None or query.tense != "past"
    if found == () and suspects != () and at_once and place_asked(query) is not None and moments:
        return Understood(text, query)
    if suspects == () or found == ():
        unseen = acting if found == () else suspected
        return refuse(now, query, _unknown(record, unseen or "", then))
    if found is None:
        return Understood(text, query)
    meant = tuple(msgspec.structs.replace(query, actor=f"{PREFIX}{name}") for name in found)
    if len(meant) == 1:
        return Understood(text, meant[0])
    offered = _told_apart(meant)
    if len(offered) < 2:
        return ask_back(now, "ambiguous", ())
    utterance = realise_clarification(questions(offered, MAX_CHOICES), speech(now))
    reply = reply_of(record, utterance, "ambiguous", query)
    return Said(query, reply, choices=offered)


def _unknown(record: Record, description: str, then: Focus | None) -> NoExplanation:
    """That no vehicle fits a description."""
    known = {name for trace in record.traces for name in trace.scene} - {0}
    facts: Facts = {
        "asked": description,
        "known": tuple(f"vehicle {name}" for name in sorted(known)),
        **({"place": description} if is_place(description) else {}),
        **({"then": True} if then is not None and not then.ahead else {}),
    }
    return NoExplanation(reason="unknown-vehicle", facts=facts)


def ask_back(now: Situation, cause: str, readings: tuple[Query, ...]) -> Said:
    """Say what a text without a clear meaning lacks, or ask which of its readings is meant."""
    offered = _told_apart(readings)
    utterance = realise_not_understood(cause, inviting(now, speech(now)), offered)
    reason: Reason = "ambiguous" if utterance.choices else "not-understood"
    reply = reply_of(now.record, utterance, reason)
    return Said(None, reply, choices=offered if utterance.choices else ())


def _told_apart(meant: tuple[Query, ...]) -> tuple[Query, ...]:
    """The readings that can be offered: those whose wordings differ, and not too many."""
    by_wording = {question(query): query for query in reversed(meant)}
    return tuple(query for query in meant if query in by_wording.values())[:MAX_CHOICES]


def scenes_for(query: Query, record: Record) -> tuple[Vehicles, ...]:
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


def _moments(query: Query, record: Record, then: Focus | None) -> tuple[Vehicles, ...]:
    """The scenes in which it counts who is where: of now, or of the time that is spoken of.

    Who was there at a time is told from that time alone; what somebody there did, from all of the
    part of the ride that is meant.
    """
    if then is not None and not then.ahead:
        near = sorted(record.traces, key=lambda trace: abs(trace.sim_time - then.moment))
        within = [t for t in near[1:] if then.start <= t.sim_time <= then.end]
        return scenes_of((*near[:1], *(() if place_asked(query) else within)))
    if query.tense != "past":
        return scenes_of(record.traces[-1:])
    return scenes_for(query, record)
