"""Questions about what the ego did, plans, or might have done instead."""

from msgspec.structs import replace

from xavi_dialogue.explain.actions import to_macros
from xavi_dialogue.explain.contrast import contrast
from xavi_dialogue.explain.deeds import DRIVING, did_not_happen, happened
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.premise import about_foil, premise
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.ride import Ride
from xavi_dialogue.explain.slowing import explain_driving


def why(query: Query, ride: Ride) -> Explanation:
    """Why the ego did it: against the foil named, or else against the best alternative."""
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
        raise did_not_happen(ride, undone)
    found = premise(ride, _undoing(query))
    return contrast(ride, found.trace, None, found.node)


def _undoing(query: Query) -> Query:
    """The same question with what had not happened as what did."""
    return replace(query, factual=query.counterfactual or query.factual, counterfactual=None)
