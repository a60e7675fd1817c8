"""Risks and forecasts: what "how do you know?" and "why?" ask after an answer that states one."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Closeness, Refusal, Verdict
from xavi_dialogue.domain.journeys import Course
from xavi_dialogue.domain.meaning import Act, Ask, HowKnow, Question, Why
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Ego,
    Event,
    Feature,
    Happens,
    Now,
    Proposition,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.domain.traffic_lights import Foreseen, LightForeseen


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


def beneath(result: Answer | Refusal | None, question: Question | None) -> Act | None:
    """Return what a bare "why?" asks after a risk or our way; None after others."""
    match result:
        case Course(steps=(step, *_)) if step.turn is not None:
            return Ask(Why(Happens(Event(step.turn, tense="present"))))
        case Closeness() if (of := risked(result, question)) is not None:
            return Ask(HowKnow(of))
    return None


def foretold(result: Answer | Refusal | None) -> Event | None:
    """Return the change of a traffic light that an answer foretells; None: it foretells none."""
    match result:
        case LightForeseen(foreseen=Foreseen(shown=shown, to=str(to))):
            return Event("turn-colour", shown.light, Feature("light", to), tense="future")
    return None
