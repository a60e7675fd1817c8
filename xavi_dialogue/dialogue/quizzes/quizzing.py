"""Quizzing: replies by the aim of a turn: answers, a question of ours, or a verdict."""

from msgspec.structs import replace

from xavi_dialogue.dialogue.acts import Lacking, Results, respond
from xavi_dialogue.dialogue.pipeline import Said, Situation, speak
from xavi_dialogue.dialogue.quizzes.quiz import candidates, solved
from xavi_dialogue.dialogue.quizzes.quiz_replies import judged, signs
from xavi_dialogue.dialogue.standing import REFUSALS
from xavi_dialogue.dialogue.state.state import Understood, up_to
from xavi_dialogue.dialogue.state.turn import Part, Quiz
from xavi_dialogue.domain.answers import Answer, Judged, NeedRollout, NothingToAsk, Posed, Refusal
from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.domain.meaning import Ask, Identify, Reading, Repair
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import At, Described, Thing, Vehicle
from xavi_dialogue.explain.history.record import Record


def reply_to(now: Situation, understood: Understood, done: tuple[Results, ...]) -> Said | Lacking:
    """Return the reply to what was understood, or the plan that it lacks."""
    quiz = understood.quiz
    match understood.aim:
        case "quiz":
            return _pose(now)
        case "again" if quiz is not None:
            posed = replace(quiz.posed, again=True)
            return _with_quiz(speak(now, (Part(None, posed),)), quiz)
        case "verdict" if quiz is not None:
            return _conclude(now, understood, quiz, done)
    return respond(now, understood, done)


def judgement_of(now: Situation, quiz: Quiz, readings: tuple[Reading, ...]) -> Understood | None:
    """Return the verdict on a reply to a question of ours; None if the text is not such a reply."""
    said = signs(now.asked.text)
    if "another" in said:
        return Understood(aim="quiz")
    reading = readings[0] if readings else None
    meant = _vehicles(now, quiz, readings)
    judgement = judged(quiz, said, reading, meant)
    return None if judgement is None else Understood(aim="verdict", quiz=quiz, judgement=judgement)


def put_again(quiz: Quiz) -> Understood:
    """Ask a question of ours once more, after a text that was no answer to it."""
    return Understood(aim="again", quiz=quiz)


def _pose(now: Situation) -> Said | Lacking:
    """Ask the passenger the first question that the record can answer."""
    memory = now.memory
    for posed in candidates(memory.turns, memory.quizzed, now.record):
        found = _explained(now, posed, now.record)
        if isinstance(found, NeedRollout):
            if found not in now.record.refused:
                return Lacking(found, ())
            continue
        quiz = solved(posed, found, now.record.now)
        if quiz is not None:
            return _with_quiz(speak(now, (Part(None, posed),)), quiz)
    return speak(now, (Part(None, NothingToAsk(asked=bool(memory.quizzed))),))


def _conclude(
    now: Situation, understood: Understood, quiz: Quiz, done: tuple[Results, ...]
) -> Said | Lacking:
    """Say whether the passenger's answer was right, and state the solution."""
    judgement = understood.judgement
    assert judgement is not None
    found: Answer | Refusal | NeedRollout
    found = done[0][0] if done else _explained(now, quiz.posed, up_to(now.record, quiz.at))
    if isinstance(found, NeedRollout):
        return Lacking(found, done)
    if isinstance(found, REFUSALS):
        return speak(now, (Part(None, found),))
    verdict = Judged(judgement, quiz.posed, found)  # type: ignore[arg-type]
    said = speak(now, (Part(_act(quiz.posed), verdict),))
    right = None if judgement == "passed" else judgement == "right"
    return Said(said.reply, said.parts, said.mentioned, answered=quiz, right=right)


def _explained(now: Situation, posed: Posed, record: Record) -> Answer | Refusal | NeedRollout:
    return now.pipeline.explain(_act(posed), record)


def _act(posed: Posed) -> GroundedAct:
    """Return a question of ours as if the passenger asked it about the time that it names."""
    at = next(parts(posed.about, At), None)
    span = None if at is None else Span(at.at, at.at, said=True)
    return GroundedAct(Ask(posed.about), span)


def _with_quiz(said: Said, quiz: Quiz) -> Said:
    return Said(said.reply, said.parts, said.mentioned, quiz=quiz)


def _vehicles(now: Situation, quiz: Quiz, readings: tuple[Reading, ...]) -> tuple[Thing, ...]:
    """Return the vehicles that a reply names by number, or by a description when it was asked."""
    if quiz.posed.kind != "vehicle":
        return ()
    acts = readings[0].acts if readings else ()
    picks = (act.pick for act in acts if isinstance(act, Repair))
    numbers = [Vehicle(pick) for pick in picks if pick is not None]  # "2"
    named = tuple(dict.fromkeys((*numbers, *(v for act in acts for v in parts(act, Vehicle)))))
    if named:
        return named
    words: tuple[Thing, ...] = tuple(thing for act in acts for thing in parts(act, Described))
    asked = tuple(Reading(acts=(Ask(Identify(thing)),), shares=()) for thing in words[:1])
    record = up_to(now.record, quiz.at)
    found = now.pipeline.ground(asked, record, now.memory.discourse) if asked else None
    acts_found = () if found is None else found.acts
    return tuple(thing for act in acts_found for thing in parts(act.act, Vehicle))
