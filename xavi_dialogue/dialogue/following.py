"""Following: a question in the light of the answers given so far."""

from dataclasses import replace

import msgspec

from xavi_dialogue.dialogue.chain import deeper, doubted, evidence_for, meant_vehicle
from xavi_dialogue.dialogue.mind import Said, Situation, bottom, inviting, reply_of, speech
from xavi_dialogue.dialogue.referents import PREFIX
from xavi_dialogue.dialogue.turn import Turn
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.followup import AGAIN
from xavi_dialogue.language.particulars import DECIDED
from xavi_dialogue.language.refusals import realise_smalltalk


def in_conversation(now: Situation, query: Query) -> Query | Said:
    """The question that is meant after the answers given so far, or what to say to it at once."""
    last = now.memory.last
    if query.actor == f"{PREFIX}unknown" and query.type == "what" and not query.factual:
        return meant_vehicle(query, now.memory) or query
    again = query.event == AGAIN
    if again:
        query = msgspec.structs.replace(query, event=None)
    if last is None:
        return query
    insisted = last.query is not None and last.query.type == "confidence"
    declined = last.reply.reason is not None or (insisted and last.reply.explanation is None)
    if declined and _doubts(query, last):
        return replace(_insist(now, query), leans=last.leans or last.query, focus=last.focus)
    if query.type == "confidence" and query.refers_to_previous and query.actor == "ego":
        doubt = doubted(last)
        if doubt is not None:
            return doubt if isinstance(doubt, Query) else _insist(now, query)
    if again or _why_declined(query, last):
        beside = now.memory.turns[-1].query  # "why?" after "I only know about this drive"
        beyond = beside is not None and beside.type == "out_of_scope"
        found = deeper(now.memory, query) if again and not beyond else None
        return bottom(now, query) if found is None else found
    known = query.type == "how" and query.event != DECIDED
    if known and query.refers_to_previous and query.actor == "ego":
        return evidence_for(last) or query
    if query.type == "when" and query.tense == "future" and not (query.factual or query.event):
        return msgspec.structs.replace(query, actor="ego")  # "how long will this take?"
    return query


def _why_declined(query: Query, last: Turn) -> bool:
    """Whether "why not?" asks for the reasons of a refusal: there is nothing else to negate."""
    bare = query.type == "why_not" and query.refers_to_previous
    return bare and last.reply.reason is not None and not (query.factual or query.counterfactual)


def _doubts(query: Query, last: Turn) -> bool:
    """Whether it is asked if we are sure of what we declined to answer."""
    asked = last.query if last.leans is None else last.leans
    same = asked is not None and (query.factual, query.actor) == (asked.factual, asked.actor)
    return query.type == "confidence" and query.refers_to_previous and same


def _insist(now: Situation, query: Query) -> Said:
    """Say that what was declined stands."""
    utterance = realise_smalltalk("insist", inviting(now, speech(now)))
    return Said(query, reply_of(now.record, utterance, None, query))
