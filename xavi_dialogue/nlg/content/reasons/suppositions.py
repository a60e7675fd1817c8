"""Suppositions: what we would have done if another vehicle had acted otherwise, or were absent."""

from typing import Any

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Contrast, SupposedOfOther
from xavi_dialogue.domain.terms import Vehicle, Vehicles
from xavi_dialogue.nlg.content.clauses.clauses import event_clause
from xavi_dialogue.nlg.content.clauses.manoeuvres import own_verbs
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.proposals import about_cause
from xavi_dialogue.nlg.content.reasons.contrasts import RISK, consequence_slots, time_effect
from xavi_dialogue.nlg.content.reasons.evidence import rests_on
from xavi_dialogue.nlg.content.reasons.terms import looked_ahead
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Chance, Clause, Moment, Quantity, Tense, Who

LIKELY = 0.5  # minimum probability of a collision that is stated as certain to come
SLOWING = ("slow-down", "brake")  # what is done less where we would drive faster
KNOWN = 0.005  # minimum probability of what was considered


def plan_supposed_of_other(answer: SupposedOfOther, context: SpeechContext) -> Plan:
    """Plan what we would have done, and whether that is what we did."""
    slots: dict[str, Any] = {
        "past": answer.past,
        "who": _who(answer),
        "condition": _condition(answer, context),
        "then": own_verbs(answer.then, answer.plan)[:2],
        "plan": own_verbs(answer.plan, answer.then)[:2],
        "same": answer.same,
        "still": answer.still,
        "known": answer.still is not None,
        "undone": answer.undone,
    }
    if answer.asked is not None:
        event = event_clause(answer.asked, context.now)
        slots["asked"] = Clause(event.subject, event.verb, event.rest)
        slots["less"] = answer.faster and answer.asked.action in SLOWING
    slots["slows"] = answer.slows
    if answer.within is not None:
        slots |= consequence_slots(answer.within, context, past=answer.past)
        based = rests_on(answer.within.evidence, answer.within.decided)
        shown = () if based is None else (based,)
        return Plan((Message("SUPPOSED_WHY", slots),), (), shown, (), about_cause(answer))
    timed = _timed(answer, context)
    if timed is not None:
        told = Message("SUPPOSED_ARRIVAL", {**slots, **timed})
        return Plan((told, *_left_out(answer)), (), (), (), about_cause(answer))
    crash = _crash(answer)
    if crash is not None:
        slots |= {"crash": True, "risk": Chance(crash.collision), "struck": _struck(crash)}
    outcome = _outcome(answer, context)
    slots["faster"] = answer.faster and (outcome is None or crash is not None)
    first = Message("SUPPOSED_ASKED" if answer.asked is not None else "SUPPOSED", slots)
    risky = outcome is not None and outcome.rule == "SUPPOSED_RISK"
    risky = risky and (crash is None or answer.asked is not None)
    core = (first, outcome) if risky and outcome is not None else (first,)
    core = (*core, *_left_out(answer))
    outcome = None if crash is not None else outcome
    details = () if risky or outcome is None else (outcome,)
    contrast = answer.contrast
    rests = None if contrast is None else rests_on(contrast.evidence, contrast.decided)
    more = tuple(one for one in (_prior(answer, context), rests) if one is not None)
    return Plan(
        core,
        details,
        more,
        (),
        about_cause(answer),
    )


def _timed(answer: SupposedOfOther, context: SpeechContext) -> dict[str, Any] | None:
    """Return the slots for when we would be there, if the question is that."""
    if answer.form not in ("arrival", "quicker") or answer.contrast is None:
        return None
    contrast = answer.contrast
    effect = time_effect(contrast)
    return {
        "late": contrast.late,
        "unlike": contrast.spares_delay,
        "chance": None if contrast.outcome is None else Chance(contrast.outcome.probability),
        "waypoint": contrast.waypoint,
        "simple": context.detail == "simpler",
        **looked_ahead(contrast),
        "verdict": answer.form == "quicker",
        "sooner": effect is not None and effect.delta < 0.0,
        "delta": None if effect is None else Quantity(abs(effect.delta), "s"),
        "arrival": None if answer.arrival is None else Moment(answer.arrival),
    }


def _crash(answer: SupposedOfOther) -> Contrast | None:
    """Return the comparison, if no option that was tried would avoid a collision."""
    found = answer.contrast
    return found if found is not None and answer.same and found.collision >= LIKELY else None


def _struck(contrast: Contrast) -> Who | None:
    vehicle = contrast.collided_with
    return None if vehicle is None else Who(Vehicle(vehicle), contrast.decided)


def _time(answer: SupposedOfOther) -> float | None:
    return None if answer.contrast is None else answer.contrast.decided


def _who(answer: SupposedOfOther) -> Who:
    """Return all vehicles with the same supposition."""
    numbers = (answer.vehicle, *answer.others)
    thing = Vehicles(numbers) if answer.others else Vehicle(answer.vehicle)
    return Who(thing, _time(answer))


def _left_out(answer: SupposedOfOther) -> tuple[Message, ...]:
    """Return the vehicles whose supposition could not be planned; () if there are none."""
    if not answer.left_out:
        return ()
    numbers = answer.left_out
    thing = Vehicles(numbers) if len(numbers) > 1 else Vehicle(numbers[0])
    return (message("SUPPOSED_LEFT_OUT", who=Who(thing, _time(answer))),)


def _condition(answer: SupposedOfOther, context: SpeechContext) -> Clause | None:
    """Return the supposition as the clause of an "if"; None if the vehicle is absent in it."""
    tense: Tense = "past-perfect" if answer.past else "past"
    if answer.everybody:
        return Clause("nobody else", "be", ("around",), tense)
    if answer.supposed is None:
        return None
    negated, supposed = answer.negated, answer.supposed
    if answer.others:
        supposed = replace(supposed, actor=_who(answer).thing)
    clause = event_clause(supposed, context.now, tense=tense, negated=negated)
    return Clause(clause.subject, clause.verb, clause.rest, tense, negated=negated)


def _outcome(answer: SupposedOfOther, context: SpeechContext) -> Message | None:
    """Return what it would have led to: a collision, or a difference in time."""
    contrast: Contrast | None = answer.contrast
    if contrast is None:
        return None
    if contrast.collision >= RISK and contrast.collision > contrast.fact_collision:
        return message(
            "SUPPOSED_RISK",
            past=answer.past,
            simple=context.detail == "simpler",
            risk=Chance(contrast.collision),
            sure=contrast.collision >= LIKELY,
            struck=_struck(contrast),
        )
    effect = time_effect(contrast)
    if effect is None or (contrast.outcome is not None and contrast.outcome.name != "done"):
        return None
    return message(
        "SUPPOSED_TIME",
        past=answer.past,
        waypoint=contrast.waypoint,
        delta=Quantity(abs(effect.delta), "s"),
        later=effect.delta > 0.0,
        mean=False,
        simple=context.detail == "simpler",
    )


def _prior(answer: SupposedOfOther, context: SpeechContext) -> Message | None:
    """Return how probable the supposition was believed to be."""
    if answer.supposed is None or answer.prior is None or context.detail == "simpler":
        return None
    return message(
        "SUPPOSED_PRIOR",
        past=answer.past,
        none=answer.prior < KNOWN,
        negated=answer.negated,
        chance=Chance(answer.prior),
    )
