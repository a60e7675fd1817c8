"""Questions about what the ego did, plans, or might have done instead."""

from msgspec.structs import replace

from xavi_dialogue.explain.actions import to_macros
from xavi_dialogue.explain.blame import INFLUENCE, blamed, check_influence, decision_at
from xavi_dialogue.explain.contrast import contrast
from xavi_dialogue.explain.deeds import DRIVING, did_not_happen, happened, no_choice
from xavi_dialogue.explain.explanation import Explanation, NoExplanation, Reason
from xavi_dialogue.explain.premise import about_foil, premise
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.ride import Ride, Unanswered
from xavi_dialogue.explain.slowing import driven, explain_driving


def why(query: Query, ride: Ride) -> Explanation:
    """Why the ego did it: against the foil named, or else against the best alternative.

    Raises:
        Unanswered: as for the contrast; or the vehicle that it is laid to has no influence.
    """
    vehicle = blamed(query)
    try:
        found = _why(query, ride)
    except Unanswered as unanswered:
        if vehicle is not None and _reason(unanswered) == "effect-too-small":
            check_influence(ride, vehicle, premise(ride, query).trace)
        raise
    named = {cause.vehicle for cause in found.causes} | {found.cleared}
    if vehicle is not None and query.event == INFLUENCE and vehicle not in named:
        check_influence(ride, vehicle, decision_at(ride, found.sim_time))
    return found


def _reason(unanswered: Unanswered) -> Reason | None:
    found = unanswered.result
    return found.reason if isinstance(found, NoExplanation) else None


def _why(query: Query, ride: Ride) -> Explanation:
    described = tuple(action for action in query.factual or () if action in DRIVING)
    if described and not ("stop" in described and happened(ride, "stop")):
        return explain_driving(ride, described, query.tense)
    found = premise(ride, query)
    foil = None
    if query.counterfactual:
        foil = to_macros(ride.model(found.trace), query.counterfactual, found.node)
    return contrast(ride, found.trace, foil, found.node)


def why_not(query: Query, ride: Ride) -> Explanation:
    """Why the ego did not do the foil, or what would have happened had it done so."""
    if not query.counterfactual:
        return why(query, ride)
    found = about_foil(ride, query)
    foil = to_macros(ride.model(found.trace), query.counterfactual, found.node)
    return contrast(ride, found.trace, foil, found.node)


def what_if(query: Query, ride: Ride) -> Explanation:
    """What would have happened had the ego done the foil, or had it not done what it did."""
    if not query.negated:
        return why_not(query, ride)
    undone = query.counterfactual or query.factual
    if undone and all(happened(ride, action) is None for action in undone):
        if any(action in DRIVING for action in undone):
            if driven(ride, undone, query.tense) not in undone:  # who says brake may mean either
                raise did_not_happen(ride, undone)
            raise no_choice(ride, undone)
        raise did_not_happen(ride, undone)
    found = premise(ride, _undoing(query))
    return contrast(ride, found.trace, None, found.node)


def _undoing(query: Query) -> Query:
    """The same question with what had not happened as what did."""
    return replace(query, factual=query.counterfactual or query.factual, counterfactual=None)
