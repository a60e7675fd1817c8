"""Blame: the facts, or the reason, for a question whose fault something was; never a verdict."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, ChoiceReason, MotionReason
from xavi_dialogue.domain.meaning import Fault, Why
from xavi_dialogue.domain.terms import Event, Happens, Not
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers import causal
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.naming import is_us
from xavi_dialogue.explain.answers.ride.priority import fault

#: Actions ascribed to us when we cannot go on.
STUCK: tuple[ActionName, ...] = ("keep-lane", "stand", "wait")


def blamed(question: Fault, asked: Asked) -> Answer:
    """Return the facts for a question of fault; for our own actions, the reason.

    Raises:
        Unanswered: a vehicle is unknown, nothing is recorded of it, or rollouts are needed.
    """
    event = question.of.event if isinstance(question.of, Happens) else None
    struck = event is not None and event.action in ("collide", "nearly-collide")
    if event is None or not is_us(event.actor) or struck or question.legal:
        return fault(question, asked)
    stuck = Not(Happens(Event("go", tense="present")))
    plain = stuck if event.action in STUCK else Happens(replace(event, modal=None))
    why = Why(plain, suspect=question.suspect)
    explainer = causal.explainer(why, asked)
    if explainer is None:
        return fault(question, asked)
    found = explainer(why, asked)
    if isinstance(found, ChoiceReason | MotionReason) and found.suspected != "none":
        return replace(found, suspect=None, suspected=None)  # a reason is no fault: no "yes"
    return found
