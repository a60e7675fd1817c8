"""What is asked, or what to say where that is not clear. Pure."""

from dataclasses import replace

import msgspec

from xavi_dialogue.dialogue.choices import chosen, goes_on, is_number, wants_another
from xavi_dialogue.dialogue.following import in_conversation
from xavi_dialogue.dialogue.mind import Said, Situation, refuse, reply_of, speech
from xavi_dialogue.dialogue.pointing import ask_back, refer, scenes_for
from xavi_dialogue.dialogue.quiz import judged
from xavi_dialogue.dialogue.referents import described, scenes_of
from xavi_dialogue.dialogue.state import Understood, up_to
from xavi_dialogue.dialogue.turn import Quiz, Turn
from xavi_dialogue.explain.explanation import NoExplanation
from xavi_dialogue.explain.focus import resolve, tensed
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.when import Focus, When
from xavi_dialogue.explain.whereabouts import place_asked
from xavi_dialogue.language.followup import AGAIN
from xavi_dialogue.language.quizzing import realise_quiz
from xavi_dialogue.language.times import when_said

_FRAGMENT = 2  # words
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
        return refer(now, offered[pick])
    quiz = None if before is None else before.quiz  # stays open where no sense is made of a reply
    if before is not None and quiz is not None:
        found = _verdict(now, before, quiz)
        if found is not None:
            return found
    if memory.is_quizzing and wants_another(text):
        return Understood(text, Query(type="smalltalk", tense="present", event=QUIZ), aim="quiz")
    if is_number(text):  # of none of the choices, if there are any
        return _put_again(now, quiz) if quiz else ask_back(now, "no-question", offered)
    vehicles = frozenset(vehicle for trace in now.record.traces for vehicle in trace.scene) | {0}
    parsed = now.mind.parse(text, vehicles, memory.previous)
    if not isinstance(parsed, Query):
        return _put_again(now, quiz) if quiz else ask_back(now, parsed.cause, parsed.readings)
    if quiz is not None and (parsed.type == "ambiguous" or _is_fragment(text, parsed)):
        return _put_again(now, quiz)
    if parsed.type == "smalltalk" and parsed.event == QUIZ:
        return Understood(text, parsed, aim="quiz")
    if before is not None and offered and _asks_nothing_new(parsed):
        return ask_back(now, "no-question", offered)
    asked = in_conversation(now, parsed)
    if isinstance(asked, Said):
        return asked
    then = _spoken_of(now, asked)
    meant = refer(now, asked, then)
    if isinstance(meant, Said):
        return meant
    if parsed.event == AGAIN:  # that it is asked why is no wish to hear more from now on
        query = msgspec.structs.replace(meant.query, detail=None)
        meant = replace(meant, query=query, again=True, detail=meant.query.detail)
    behind = asked.actor not in (parsed.actor, "ego") and asked.type in ("why", "how")
    timed = _timed(now, replace(meant, focus=_decision(now.memory.last) if behind else None))
    if isinstance(timed, Understood) and timed.focus is None:
        return replace(timed, focus=then)  # who was there counts then, and so does what it did
    return timed


def _is_fragment(text: str, query: Query) -> bool:
    """Whether it is a question only with the help of the one before it: "vehicle 1"."""
    return query.refers_to_previous and query.event != AGAIN and len(text.split()) <= _FRAGMENT


def _asks_nothing_new(query: Query) -> bool:
    """Whether it is "why?" or "are you sure?", which after a question of ours says nothing."""
    bare = query.event == AGAIN or query.type == "confidence"
    return bare and query.refers_to_previous


def _put_again(now: Situation, quiz: Quiz) -> Said:
    """Put a question of ours once more, to which there came no answer."""
    utterance = realise_quiz(quiz, speech(now), again=True)
    return Said(None, reply_of(now.record, utterance, "not-understood"), quiz=quiz)


def _verdict(now: Situation, before: Turn, quiz: Quiz) -> Understood | None:
    """The reply to a question of ours; None where it is no such thing."""
    posed = next((turn for turn in now.memory.turns if turn.quiz == quiz), before)
    record = up_to(now.record, posed.reply.sim_time)
    scenes = (*scenes_for(quiz.about, record)[:1], *scenes_of(now.record.traces[-1:]))
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
    when = _when(now)
    if when is None:
        onward = goes_on(now.asked.text) and not query.factual
        leans = (query.refers_to_previous or onward) and query.tense == "past"
        if last is None or not leans or _turns_to_us(query, last):
            return replace(meant, focus=None)
        return replace(meant, focus=last.focus or meant.focus)
    found = resolve(when, now.record, query)
    if isinstance(found, NoExplanation):
        return refuse(now, query, found)
    if found is None:
        return meant
    return replace(meant, query=tensed(query, found), focus=found)


def _spoken_of(now: Situation, query: Query) -> Focus | None:
    """The part of the ride that a question with a described vehicle speaks of, if any.

    Who was at a place, without a time, is asked of the time that was spoken of last.
    """
    if described(query.actor) is None and described(query.hypothesised_cause or "") is None:
        return None
    when = _when(now)
    if when is None:
        last = now.memory.last
        leans = query.tense == "past" and place_asked(query) is not None
        return last.focus if leans and last is not None else None
    found = resolve(when, now.record, query)
    return found if isinstance(found, Focus) else None


def _turns_to_us(query: Query, last: Turn) -> bool:
    """Whether a question is about what we decided, after one about what another vehicle did.

    The time that was spoken of was that vehicle's.
    """
    other = last.query is not None and last.query.actor != "ego"
    return other and query.type in ("what_if", "why_not", "compare", "sensitivity", "how_avoid")


def _when(now: Situation) -> When | None:
    """What the text says about when; "that" is the time that was spoken of last."""
    when, last = when_said(now.asked.text), now.memory.last
    if when is None or when.landmark != "that":
        return when
    found = None if last is None else last.reply.explanation
    focus = None if last is None else last.focus
    told = () if found is None else (found.then, found.moment)
    meant = (*told, focus and focus.moment, found and found.sim_time)
    spoken_of = next((time for time in meant if time is not None), None)
    if spoken_of is None:
        return None
    return msgspec.structs.replace(when, landmark="clock", clock=spoken_of)


def _decision(last: Turn | None) -> Focus | None:
    """When the decision was taken that the last answer is about: what was expected then counts."""
    found = None if last is None else last.reply.explanation
    if found is None:
        return None
    return Focus(start=found.sim_time, end=found.sim_time, moment=found.sim_time, instant=True)
