"""Engine: from a grounded act and the record to an answer, a refusal or a request to plan again.

Tables state which explainer answers what. `causal` has questions about reasons, suppositions and
decisions, even if their type does not show it ("was it necessary?"); `factual` has the others.
"""

from typing import TypeAlias

from xavi_dialogue.causal.model import CausalError
from xavi_dialogue.domain.answers import (
    Answer,
    CannotSay,
    DidNotHappen,
    MotionReason,
    NeedRollout,
    NotRecorded,
    NotUnderstood,
    Refusal,
)
from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.domain.meaning import Ask, Beyond, HowKnow, Question, Whether
from xavi_dialogue.domain.terms import At, Between, Ego, Event, Exists, Nobody, Related, Vehicles
from xavi_dialogue.explain.answers import causal, factual
from xavi_dialogue.explain.answers.lights import lights
from xavi_dialogue.explain.answers.reasons import provoked
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.occasions import lacks_deeds
from xavi_dialogue.explain.answers.reference.reading import event_of
from xavi_dialogue.explain.answers.sight import hidden_areas
from xavi_dialogue.explain.answers.suppositions import people_first
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

Result: TypeAlias = Answer | Refusal | NeedRollout


def explain(act: GroundedAct, record: Record) -> Result:
    """Answer a grounded act from the record of the ride.

    Pure: the same act and record give the same result. After a NeedRollout, the caller asks again
    with the new plan in `record.extra`.
    """
    ride = Ride(record)
    return explain_in(act, ride, World(ride))


def explain_in(act: GroundedAct, ride: Ride, world: World) -> Result:
    """Answer a grounded act from a ride that was read already; see `explain`."""
    scene = Asked(ride, world, act.span or _span(act, ride), act)
    try:
        return _explained(_answer(scene), ride)
    except Unanswered as unanswered:
        return _doubted(unanswered.result, ride)
    except CausalError:  # a contradictory record explains nothing
        return NotRecorded("gap-in-record", since=ride.now)


def _span(act: GroundedAct, ride: Ride) -> Span | None:
    """Return the part of the ride that the terms of a question name, if the act names none."""
    question = act.act.question if isinstance(act.act, Ask) else None
    event = event_of(getattr(question, "of", None))
    for time in (getattr(question, "time", None), None if event is None else event.time):
        match time:
            case At(at):
                return Span(at, at, said=True, ahead=at > ride.now)
            case Between(begin, end):
                return Span(begin, end, said=True, ahead=begin > ride.now)
    return None


def _answer(scene: Asked) -> Answer:
    """Return the answer of the explainer that the table names.

    Raises:
        Unanswered: there is no answer, or none yet.
    """
    act = scene.act.act
    lit = lights.explainer(act, scene)
    if lit is not None:
        return lit(act, scene)
    unseen = hidden_areas.explainer(act, scene)
    if unseen is not None:
        return unseen(act, scene)
    if isinstance(act, Ask):
        question = _seen(act.question)
        explainer = (
            people_first.explainer(question, scene)
            or provoked.explainer(question)
            or causal.explainer(question, scene)
            or factual.QUESTIONS.get(type(question))
        )
        if explainer is None:
            raise Unanswered(NotUnderstood())
        return explainer(question, scene)
    if isinstance(act, Beyond):
        raise Unanswered(CannotSay(act.topic, act.words))
    found = factual.ACTS.get(type(act))
    if found is None:
        raise Unanswered(NotUnderstood())
    return found(act, scene)


def _seen(question: Question) -> Question:
    """Ask whether several are there instead of how we know it: we know those whom we see."""
    match question:
        case HowKnow(Exists(Vehicles() | Nobody()) as that):
            return Whether(that)
        case HowKnow(Related("ahead-of" | "behind" | "beside" | "near") as that):
            return Whether(that)
    return question


def _explained(result: Answer, ride: Ride) -> Answer | NotRecorded:
    """Return the result; or that the record lacks it, if it is that nobody was in the way."""
    if not isinstance(result, MotionReason) or any(c.kind != "plan" for c in result.causes):
        return result
    end = ride.now if result.deed.end is None else result.deed.end
    lost = next((g for g in ride.gaps if g[0] <= end and g[1] >= result.deed.begin), None)
    return result if lost is None else NotRecorded("gap-in-record", since=lost[0], until=lost[1])


def _doubted(result: Refusal | NeedRollout, ride: Ride) -> Refusal | NeedRollout:
    """Return the result; or another, if it denies what the record may lack."""
    if isinstance(result, DidNotHappen) and _is_heard(result.asked):
        return NotRecorded("not-sensed")
    if isinstance(result, DidNotHappen) and lacks_deeds(ride, result.asked):
        return NotRecorded("no-deeds")
    if not isinstance(result, DidNotHappen) or result.planned is not None or not ride.gaps:
        return result
    if result.instead or result.elsewhen is not None:
        return result
    return NotRecorded("gap-in-record", since=ride.gaps[0][0], until=ride.gaps[-1][1])


def _is_heard(event: Event) -> bool:
    """Check whether an event is one that we would have to hear: others honk."""
    return event.action == "honk" and not isinstance(event.actor, Ego)
