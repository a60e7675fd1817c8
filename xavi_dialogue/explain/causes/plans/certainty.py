"""Certainty: how sure the ego is that its plan goes well, and that its choice is the better one."""

import numpy as np

from planner.record.trace import Outcome, PlanTrace
from xavi_dialogue.causal.mixtures import Joint
from xavi_dialogue.causal.model import Actions, Intervention
from xavi_dialogue.domain.answers import Certainty, Contrast, NeedRollout
from xavi_dialogue.explain.causes.plans.chances import chances, either_way, surely
from xavi_dialogue.explain.causes.plans.contrast import (
    alone,
    alternatives,
    compare,
    contrast,
    decided,
    evidence,
    factual,
)
from xavi_dialogue.explain.causes.plans.natural import natural
from xavi_dialogue.explain.causes.plans.premise import Premise
from xavi_dialogue.explain.history.ride import (
    MIN_COVERAGE,
    MIN_DISTINCT,
    Ride,
    Unanswered,
    planned,
)

DOUBT = 0.05  # chance that a probability is smaller than its lower bound
UTMOST = 0.99  # no bound is higher: the unforeseen is always possible
EQUAL = 0.05  # [s] of reward that make no difference
WELL: tuple[Outcome, ...] = ("done", "termination")  # if late, the ego is still on its way
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
    """Estimate how surely the plan of a decision goes well, by the chances of its outcomes.

    Raises:
        Unanswered: there is too little evidence.
    """
    trace = found.trace
    model = ride.model(trace)
    plan = factual(model, trace)
    good = [result for result in plan.results if result.rollout.outcome in WELL]
    share = min(sum(plan.outcomes[name] for name in WELL), 1.0)
    proven = sum(model.prior(result.joint) for result in good)
    low = _bound(share, len(plan.results), proven)
    told = sum(chances(plan).of(name) for name in WELL)
    known = len(plan.results) > 1
    return Certainty(
        "plan",
        min(told, UTMOST) if known else None,
        surely(low) if known else None,
        len(good),
        len(plan.results),
        trace.sim_time,
        evidence(ride, model, plan),
        alone(ride, model, plan),
        len(model.vehicles),
        sum(model.prior(result.joint) for result in plan.results),
        proven,
    )


def of_choice(ride: Ride, found: Premise, foil: Actions = ()) -> Certainty | None:
    """Estimate how surely a choice does better than what its explanation compares it with.

    Args:
        ride: the record.
        found: the decision, and where in its plan the choice is.
        foil: what the question names instead; () for the rival.

    Returns:
        The certainty; None if there is nothing to compare the choice with.

    Raises:
        Unanswered: rollouts are needed.
    """
    trace, node = found.trace, found.node
    try:
        against = contrast(ride, trace, foil, node) if foil else _rival(ride, trace, node)
        if against is None or against.verdict == "alone":
            return None
        model, there = ride.evidence(trace, against.foil)
        here = decided(ride, model)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return None
    gains = _gains(here, there)
    better = [joint for joint, gain in gains.items() if gain > EQUAL]
    known = sum(model.prior(joint) for joint in gains)
    alike = len(gains) > 1 and (known >= MIN_COVERAGE or len(gains) >= MIN_DISTINCT)
    proven = sum(model.prior(joint) for joint in better)
    share = proven + max(1.0 - known, 0.0) * _expected(len(better), len(gains))
    part = len(better) / len(gains) if gains else 0.0
    return Certainty(
        "choice",
        min(either_way(min(share, 1.0)), UTMOST) if alike else None,
        surely(min(max(proven, at_least(part, len(gains))), share, UTMOST)) if alike else None,
        len(better),
        len(gains),
        trace.sim_time,
        against.evidence,
        against,
        len(model.vehicles),
        known,
        proven,
    )


def _rival(ride: Ride, trace: PlanTrace, node: Actions) -> Contrast | None:
    """Compare a choice with its natural foil, else with the best option that stays on the way.

    An option that leads off the way is no rival: it was never in doubt that it is worse. None if
    all options do.

    Raises:
        Unanswered: there is too little evidence, or rollouts are needed.
    """
    found = natural(ride, trace, node)
    lost = found.outcome is not None and found.outcome.name == "dead"
    if not lost and not found.way:
        return found
    model, plan = ride.model(trace), planned(trace)
    here = factual(model, trace)
    rivals = alternatives(model, plan[len(node)], node)
    alive = [pair for pair in rivals if pair[1].likeliest != "dead"]
    return compare(ride, model, here, alive[0][1], alive[0][0]) if alive else None


def _expected(good: int, tried: int) -> float:
    """Return the probability that what was not tried goes well, by Jeffreys' prior."""
    return (good + 0.5) / (tried + 1.0)


def _bound(share: float, n: int, proven: float) -> float:
    """Return the lower bound of a probability, of which a part is proven by exhaustion.

    What a situation leads to is certain once it was tried. So the prior mass of the situations
    tried with success is a bound, too, however few they are.
    """
    return min(max(at_least(share, n), proven), share, UTMOST)


def _gains(here: Intervention, there: Intervention) -> dict[Joint, float]:
    """Return how much higher [s] the fact's reward is, in each situation tried with both."""
    other = {result.joint: result.rollout.reward for result in there.results}
    return {
        result.joint: result.rollout.reward - other[result.joint]
        for result in here.results
        if result.joint in other
    }
