"""Certainty: how sure the ego is of its plan, and that what it chose was the better choice."""

import numpy as np

from planner.trace import Outcome
from xavi_dialogue.causal.model import Intervention, Joint
from xavi_dialogue.domain.answers import Certainty
from xavi_dialogue.explain.causes.contrast import alone, alternatives, evidence, factual, sides
from xavi_dialogue.explain.causes.premise import Premise
from xavi_dialogue.explain.history.ride import MIN_DISTINCT, Ride, planned

DOUBT = 0.05  # chance that a probability is smaller than its lower bound
UTMOST = 0.99  # no bound is higher: there is always what nobody foresees
EQUAL = 0.05  # [s] of reward that make no difference
WELL: tuple[Outcome, ...] = ("done", "termination")  # who is late is still on the way
FINENESS = 4000  # steps of a numerical integral


def at_least(share: float, n: int) -> float:
    """Bound the probability that a frequency of `share` in `n` independent trials shows.

    With Jeffreys' prior Beta(1/2, 1/2), the belief about the probability p after k = share * n
    successes is Beta(k + 1/2, n - k + 1/2); the bound is its 5 % point (Brown, Cai and DasGupta
    2001). In p = sin^2(t) the density is sin^2k(t) cos^2(n-k)(t), which has no poles and is summed
    here. After n successes in n trials the rule of three says 1 - 3/n; this is a little bolder:
    0.86 for 12, 0.94 for 30.
    """
    angle = (np.arange(FINENESS) + 0.5) * (np.pi / 2.0 / FINENESS)
    good = share * n
    logs = 2.0 * good * np.log(np.sin(angle)) + 2.0 * (n - good) * np.log(np.cos(angle))
    mass = np.cumsum(np.exp(logs - np.max(logs)))
    point = angle[int(np.searchsorted(mass, DOUBT * mass[-1]))]
    return float(np.sin(point) ** 2)


def of_plan(ride: Ride, found: Premise) -> Certainty:
    """Tell how surely the plan of a decision goes well.

    Raises:
        Unanswered: there is too little evidence.
    """
    trace = found.trace
    model = ride.model(trace)
    plan = factual(model, trace)
    good = [result for result in plan.results if result.rollout.outcome in WELL]
    share = min(sum(plan.outcomes[name] for name in WELL), 1.0)
    low = _bound(share, len(plan.results), sum(model.prior(result.joint) for result in good))
    rests_on, tried = evidence(ride, model, plan), len(plan.results)
    contrast = alone(ride, model, plan)
    return Certainty("plan", share, low, len(good), tried, trace.sim_time, rests_on, contrast)


def of_choice(ride: Ride, found: Premise) -> Certainty | None:
    """Tell how surely a choice beats the best alternative; None where they were not tried alike.

    Raises:
        Unanswered: there is too little evidence of what was chosen.
    """
    trace, node = found.trace, found.node
    model, plan = ride.model(trace), planned(trace)
    if len(plan) <= len(node):
        return None
    here = factual(model, trace)
    others = alternatives(model, plan[len(node)], node)
    if not others:
        return None
    foil, there = others[0]
    gains = _gains(here, there)
    known = sum(model.prior(joint) for joint in gains)
    if known < 0.5 and len(gains) < MIN_DISTINCT:
        return None
    better = [joint for joint, gain in gains.items() if gain > EQUAL]
    weights = dict(zip((r.joint for r in here.results), here.weights, strict=True))
    mass = sum(weights[joint] for joint in gains)
    share = min(sum(weights[joint] for joint in better) / mass, 1.0) if mass > 0.0 else 0.0
    low = _bound(share, len(gains), sum(model.prior(joint) for joint in better))
    rests_on = evidence(ride, model, here, there)
    contrast = sides(ride, model, here, there, foil)
    tried, time = len(gains), trace.sim_time
    return Certainty("choice", share, low, len(better), tried, time, rests_on, contrast)


def _bound(share: float, n: int, proven: float) -> float:
    """The lower bound of a probability, of which a part is proven by exhaustion.

    What comes of a situation is certain once it was tried, so the prior mass of those tried with
    success is a bound too, however few they are.
    """
    return min(max(at_least(share, n), proven), share, UTMOST)


def _gains(here: Intervention, there: Intervention) -> dict[Joint, float]:
    """By how much [s] the fact's reward exceeds the foil's, in each situation tried with both."""
    other = {result.joint: result.rollout.reward for result in there.results}
    return {
        result.joint: result.rollout.reward - other[result.joint]
        for result in here.results
        if result.joint in other
    }
