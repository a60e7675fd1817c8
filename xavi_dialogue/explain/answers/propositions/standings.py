"""Standings: why things are in a relation, and why lights are shown."""

from xavi_dialogue.domain.answers import Answer
from xavi_dialogue.domain.meaning import Whether
from xavi_dialogue.domain.terms import Event, Has, Proposition, Related
from xavi_dialogue.domain.vocabulary import Manner, Relation, Side
from xavi_dialogue.explain.answers.reasons import choices, motions, others
from xavi_dialogue.explain.answers.reasons.signalling import why_signal
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import is_own, vehicle_in

PLACES = frozenset[Relation](("ahead-of", "behind", "left-of", "right-of", "beside", "near"))
SIDES: dict[str, Side] = {"left": "left", "right": "right"}


def related(of: Related, scene: Asked) -> Answer:
    """Return why two things are in a relation: what the moving one does."""
    lane_like = of.relation == "on" and is_own(of.thing)
    if lane_like:
        return choices.in_lane(scene)
    tense = of.tense
    if is_own(of.thing) and vehicle_in(of.to) is not None:
        if of.relation == "waiting-for":
            return motions.motion(Event("wait", object=of.to, tense=tense), scene)
        if of.relation in ("must-yield-to", "has-priority-over"):
            return fact(of, scene)
        manner: Manner = "close" if of.relation in ("near", "closer-than") else "slowly"
        return motions.slow(scene, manner)
    if vehicle_in(of.thing) is not None:
        if of.relation in ("waiting-for", "in-the-way-of"):
            event = Event("stand", of.thing, object=of.to, tense=tense)
            return others.why(event, scene, negated=False)
        if is_own(of.to) and of.relation in PLACES:
            return others.placed(of, scene)
        return others.why(Event("do", of.thing, tense=tense), scene, negated=False)
    return fact(of, scene)


def signalling(of: Has, scene: Asked) -> Answer:
    """Return why somebody shows a light."""
    if is_own(of.thing) and of.attribute == "brake-lights":
        return motions.motion(Event("brake", tense=of.tense), scene)
    if is_own(of.thing):
        side = SIDES.get(of.value)
        return why_signal(side, scene, past=of.tense != "present")
    event = Event("signal", of.thing, tense=of.tense)
    return others.why(event, scene, negated=False)


def fact(of: Proposition, scene: Asked) -> Answer:
    """Return whether something holds at all, if the record shows no cause for it."""
    # Deferred import: whether something holds may be a question about reasons itself.
    from xavi_dialogue.explain.answers.propositions.verdicts import whether

    return whether(Whether(of), scene)
