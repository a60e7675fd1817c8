"""What is asked, or what to say where that is not clear. Pure."""

from dataclasses import replace

import msgspec

from xavi_dialogue.dialogue.bearings import Vehicles
from xavi_dialogue.dialogue.chain import deeper, evidence_for, meant_vehicle
from xavi_dialogue.dialogue.choices import chosen, goes_on, is_number, wants_another
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.dialogue.mind import Said, Situation, bottom, inviting, refuse, reply_of, speech
from xavi_dialogue.dialogue.quiz import judged
from xavi_dialogue.dialogue.referents import PREFIX, Scope, candidates, described, scenes_of
from xavi_dialogue.dialogue.state import Understood, up_to
from xavi_dialogue.dialogue.turn import Quiz, Turn
from xavi_dialogue.explain.explanation import NoExplanation, Reason
from xavi_dialogue.explain.focus import resolve, tensed
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.when import Focus
from xavi_dialogue.language.followup import AGAIN
from xavi_dialogue.language.questions import question, questions
from xavi_dialogue.language.refusals import (
    MAX_CHOICES,
    realise_clarification,
    realise_not_understood,
    realise_smalltalk,
)
from xavi_dialogue.language.times import when_said

QUIZ = "quiz"  # the event of a request to be quizzed


def understand(now: Situation, before: Turn | None) -> Understood | Said:
    """What is asked, or what to say where that is not clear.

    Args:
        now: the question and what there is to understand it from.
        before: the turn before, where it ended with a question of ours.
    """
    text, memory = now.asked.text, now.memory
    offered = () if before is None else before.choices
    pick = chosen(text, len(offered)) if offered else None
    if pick is not None:
        return _refer(now, offered[pick])
    quiz = None if before is None else before.quiz  # stays open where no sense is made of a reply
    if before is not None and quiz is not None:
        found = _verdict(now, before, quiz)
        if found is not None:
            return found
    if memory.is_quizzing and wants_another(text):
        return Understood(text, Query(type="smalltalk", tense="present", event=QUIZ), aim="quiz")
    if is_number(text):  # of none of the choices, if there are any
        return replace(_ask_back(now, "no-question", offered), quiz=quiz)
    vehicles = frozenset(vehicle for trace in now.record.traces for vehicle in trace.scene) | {0}
    parsed = now.mind.parse(text, vehicles, memory.previous)
    if not isinstance(parsed, Query):
        return replace(_ask_back(now, parsed.cause, parsed.readings), quiz=quiz)
    if parsed.type == "ambiguous" and quiz is not None:
        return replace(_ask_back(now, "ambiguous", ()), quiz=quiz)
    if parsed.type == "smalltalk" and parsed.event == QUIZ:
        return Understood(text, parsed, aim="quiz")
    asked = _in_conversation(now, parsed)
    if isinstance(asked, Said):
        return asked
    meant = _refer(now, asked)
    if isinstance(meant, Said):
        return meant
    if parsed.event == AGAIN:  # that it is asked why is no wish to hear more from now on
        query = msgspec.structs.replace(meant.query, detail=None)
        meant = replace(meant, query=query, again=True, detail=meant.query.detail)
    behind = asked.actor not in (parsed.actor, "ego") and asked.type in ("why", "how")
    return _timed(now, replace(meant, focus=_decision(now.memory.last) if behind else None))


def _verdict(now: Situation, before: Turn, quiz: Quiz) -> Understood | None:
    """The reply to a question of ours; None where it is no such thing."""
    posed = next((turn for turn in now.memory.turns if turn.quiz == quiz), before)
    record = up_to(now.record, posed.reply.sim_time)
    scenes = (*_scenes(quiz.about, record)[:1], *scenes_of(now.record.traces[-1:]))
    judgement = judged(quiz, now.asked.text, scenes)
    if judgement is None:
        return None
    return Understood(
        now.asked.text,
        quiz.about,
        aim="verdict",
        quiz=quiz,
        judgement=judgement,
        posed_at=posed.reply.sim_time,
    )


def _timed(now: Situation, meant: Understood) -> Understood | Said:
    """The question with the part of the ride that it is about: what it says, or that before it."""
    query, last = meant.query, now.memory.last
    when = when_said(now.asked.text)
    if when is None:
        onward = goes_on(now.asked.text) and not query.factual
        leans = query.refers_to_previous or onward
        if last is None or not leans or query.tense != "past":
            return replace(meant, focus=None)
        return replace(meant, focus=last.focus or meant.focus)
    found = resolve(when, now.record, query)
    if isinstance(found, NoExplanation):
        return refuse(now, query, found)
    if found is None:
        return meant
    return replace(meant, query=tensed(query, found), focus=found)


def _decision(last: Turn | None) -> Focus | None:
    """When the decision was taken that the last answer is about: what was expected then counts."""
    found = None if last is None else last.reply.explanation
    if found is None:
        return None
    return Focus(start=found.sim_time, end=found.sim_time, moment=found.sim_time, instant=True)


def _ask_back(now: Situation, cause: str, readings: tuple[Query, ...]) -> Said:
    offered = _told_apart(readings)
    utterance = realise_not_understood(cause, inviting(now, speech(now)), offered)
    reason: Reason = "ambiguous" if utterance.choices else "not-understood"
    reply = reply_of(now.record, utterance, reason)
    return Said(None, reply, choices=offered if utterance.choices else ())


def _in_conversation(now: Situation, query: Query) -> Query | Said:
    """The question in the light of the answers given so far, and not of the questions alone."""
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
    if again or _why_declined(query, last):
        beside = now.memory.turns[-1].query  # "why?" after "I only know about this drive"
        beyond = beside is not None and beside.type == "out_of_scope"
        found = deeper(now.memory, query) if again and not beyond else None
        return bottom(now, query) if found is None else found
    if query.type == "how" and query.refers_to_previous and query.actor == "ego":
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


def _refer(now: Situation, query: Query) -> Understood | Said:
    """Put numbers in the place of descriptions of vehicles.

    Of several that a suspected one may be, none is asked about: the answer names the causes.
    """
    text, record = now.asked.text, now.record
    scope = Scope(_scenes(query, record), now.memory.topic)
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
        return refuse(now, query, why)
    if found is None:
        return Understood(text, query)
    meant = tuple(msgspec.structs.replace(query, actor=f"{PREFIX}{name}") for name in found)
    if len(meant) == 1:
        return Understood(text, meant[0])
    offered = _told_apart(meant)
    if len(offered) < 2:
        return _ask_back(now, "ambiguous", ())
    utterance = realise_clarification(questions(offered, MAX_CHOICES), speech(now))
    reply = reply_of(record, utterance, "ambiguous", query)
    return Said(query, reply, choices=offered)


def _told_apart(meant: tuple[Query, ...]) -> tuple[Query, ...]:
    """The readings that can be offered: those whose wordings differ, and not too many."""
    by_wording = {question(query): query for query in reversed(meant)}
    return tuple(query for query in meant if query in by_wording.values())[:MAX_CHOICES]


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
