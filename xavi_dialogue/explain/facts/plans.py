"""Plans: the last decision with a choice, the latest plan, and when its actions begin."""

from collections.abc import Mapping

from planner.record.trace import PlanTrace
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.history.ride import Ride, enough, planned


def last_choice(ride: Ride, at: float) -> PlanTrace | None:
    """Find the last decision up to a time [s] that had a choice; the first one if none had."""
    k = ride.index(at)
    while k is not None and k > 0 and ride.traces[k].under_way is not None:
        k -= 1
    return None if k is None else ride.traces[k]


def plan_of(ride: Ride) -> tuple[CausalModel, Intervention] | None:
    """Return the plan of the last decision, of as many of its actions as there is evidence for."""
    if not ride.traces:
        return None
    trace = ride.traces[-1]
    model, plan = ride.model(trace), planned(trace)
    for length in range(len(plan), 0, -1):
        found = model.intervene(plan[:length])
        if found is not None and enough(found):
            return model, found
    return None


def beginnings(ride: Ride) -> Mapping[ActionName, float]:
    """Return when [s] each action of the plan is expected to begin, in the mean of its rollouts."""
    found = plan_of(ride)
    if found is None:
        return {}
    _, plan = found
    times: dict[ActionName, list[tuple[float, float]]] = {}
    for result, weight in zip(plan.results, plan.weights, strict=True):
        for timed in result.rollout.actions:
            times.setdefault(timed.action, []).append((timed.start, weight))
    return {
        action: sum(t * w for t, w in known) / sum(w for _, w in known)
        for action, known in times.items()
        if sum(w for _, w in known) > 0.0
    }
