"""Risks: what "how do you know?" asks after an answer that states the risk of a collision."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Closeness, Refusal, Verdict
from xavi_dialogue.domain.meaning import Question
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Ego,
    Event,
    Happens,
    Now,
    Proposition,
    Unsaid,
    Vehicle,
)


def risked(result: Answer | Refusal | None, question: Question | None) -> Proposition | None:
    """Return the collision whose risk an answer states, as it was believed; None: it states none.

    Args:
        result: the answer.
        question: that it answers, which may name with whom.
    """
    whom = None if question is None else first(question, Vehicle)
    crash = Event("collide", Ego(), whom, time=Now(), tense="present")
    match result:
        case Closeness(risk=float(), grounds=None, past=True, planned=planned, time=time):
            at = At(time if planned is None else planned)
            return Believed(Happens(replace(crash, time=at)), time=at)
        case Closeness(risk=float(), grounds=None):
            return Happens(crash)
        case Verdict(that=Happens(event=Event(action="collide") as event), probability=float()):
            if isinstance(event.time, At):
                return Believed(Happens(event), time=event.time)
            if isinstance(event.time, Unsaid | Now):
                return Happens(replace(event, time=Now(), tense="present"))
    return None
