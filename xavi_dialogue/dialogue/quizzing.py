"""What is said to what was understood: an answer, a question of ours, or a verdict. Pure."""

from dataclasses import replace

import msgspec

from xavi_dialogue.dialogue.answering import answer, explained_trace
from xavi_dialogue.dialogue.mind import Said, Situation, inviting, refuse, reply_of, speech
from xavi_dialogue.dialogue.quiz import candidates, filled
from xavi_dialogue.dialogue.state import Understood, up_to
from xavi_dialogue.dialogue.turn import Judgement, Quiz
from xavi_dialogue.explain.explanation import Explanation, NeedRollout, NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.quizzing import realise_no_quiz, realise_quiz, realise_verdict


def respond(now: Situation, understood: Understood) -> Said | NeedRollout:
    """The reply to what was understood, or what it takes to find it."""
    quiz, judgement, posed_at = understood.quiz, understood.judgement, understood.posed_at
    if understood.aim == "quiz":
        return _pose(now, understood.query)
    if quiz is not None and judgement is not None and posed_at is not None:
        then = replace(now, record=up_to(now.record, posed_at))
        return _conclude(then, quiz, judgement)
    focused = replace(now.record, focus=understood.focus)
    return answer(replace(now, record=focused), understood)


def _pose(now: Situation, query: Query) -> Said | NeedRollout:
    """Put the first question to the passenger whose answer the record holds."""
    memory = now.memory
    told = tuple(
        turn.query for turn in memory.turns if turn.query is not None and turn.reply.explanation
    )
    for quiz in candidates(memory.asked, told, memory.quizzed, now.record):
        found = now.mind.explain(quiz.about, now.record)
        if isinstance(found, NeedRollout) and found not in now.record.refused:
            return found
        posed = filled(quiz, found) if isinstance(found, Explanation) else None
        if posed is not None and isinstance(found, Explanation):
            said = realise_quiz(posed, speech(now, explained_trace(found, now.record)))
            reply = reply_of(now.record, said, None, query)
            return Said(query, reply, mentioned=said.mentioned, quiz=posed)
    said = realise_no_quiz(inviting(now, speech(now)), asked=bool(memory.quizzed))
    return Said(query, reply_of(now.record, said, None, query))


def _conclude(now: Situation, quiz: Quiz, judgement: Judgement) -> Said | NeedRollout:
    """Tell whether the passenger's answer was right, and what it is."""
    found = now.mind.explain(quiz.about, now.record)
    if isinstance(found, NeedRollout):
        return found
    if isinstance(found, NoExplanation):
        return refuse(now, quiz.about, found)
    context = speech(now, explained_trace(found, now.record))
    said = realise_verdict(quiz, judgement, found, context)
    reply = reply_of(now.record, said, None, quiz.about)
    trace_id = found.evidence.traces[0] if found.evidence.traces else None
    return Said(
        quiz.about,
        msgspec.structs.replace(reply, explanation=found, trace_id=trace_id),
        mentioned=said.mentioned,
        answered=quiz,
        right=None if judgement == "passed" else judgement == "right",
    )
