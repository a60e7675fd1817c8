"""Collisions: whether there was one, and how likely one is."""

from xavi_dialogue.explain.avoidance import CRASH, how_avoid
from xavi_dialogue.explain.contrast import evidence, factual
from xavi_dialogue.explain.explanation import Explanation, OutcomeEstimate
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.ride import Ride

#: Types of questions that name a collision and ask nothing else.
ASKED = frozenset({"what", "confidence"})


def collision(query: Query, ride: Ride) -> Explanation:
    """Whether there was a collision: then, whether it could have been avoided; how likely one is.

    How likely it is, is the probability under the latest plan, as its rollouts show.

    Raises:
        Unanswered: there was none.
    """
    if query.type == "what" and query.tense == "past":
        return how_avoid(query, ride)
    trace = ride.latest
    model = ride.model(trace)
    plan = factual(model, trace)
    return Explanation(
        factual=plan.plan,
        counterfactual=(),
        outcome=OutcomeEstimate("collision", min(plan.outcomes["collision"], 1.0)),
        effects=(),
        causes=(),
        evidence=evidence(model, ride, plan),
        sim_time=trace.sim_time,
    )


def names_collision(query: Query) -> bool:
    """Whether a question is about a collision, and not about what led to it."""
    return query.event == CRASH and query.type in ASKED
