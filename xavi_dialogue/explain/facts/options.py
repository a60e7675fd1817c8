"""Options: what a decision could choose from, and what was expected of each."""

from collections.abc import Mapping

from planner.trace import Action, Outcome, PlanTrace
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.domain.facts import OptionValue
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.history.ride import Ride, enough, planned


def options(ride: Ride, at: float) -> tuple[OptionValue, ...]:
    """What the last decision up to a time [s] could choose from; the chosen one first, then best.

    Where another manoeuvre was under way, that of the last decision with a choice.
    """
    k = ride.index(at)
    while k is not None and k > 0 and ride.traces[k].under_way is not None:
        k -= 1
    if k is None:
        return ()
    return of_trace(ride, ride.traces[k])


def of_trace(ride: Ride, trace: PlanTrace) -> tuple[OptionValue, ...]:
    """What a decision could choose from."""
    model = ride.model(trace)
    chosen = planned(trace)[:1]
    here = model.intervene(chosen) if chosen else None
    found = []
    for action in model.options():
        there = model.intervene((action,))
        if there is not None and enough(there):
            found.append(_option(trace, action, (action,) == chosen, there, here))
    return tuple(sorted(found, key=lambda o: (not o.chosen, -(o.value or 0.0))))


def _option(
    trace: PlanTrace,
    action: Action,
    chosen: bool,
    there: Intervention,
    here: Intervention | None,
) -> OptionValue:
    ends: Outcome = there.likeliest
    struck = there.collisions()
    delta = None
    if here is not None and not chosen and ends == "done":
        delta = next((e.delta for e in effects(there, here) if e.component == "time"), None)
    return OptionValue(
        action,
        chosen,
        ends,
        min(there.outcomes[ends], 1.0),
        there.expectation("time") if ends == "done" else None,
        delta,
        there.value,
        collision=min(there.outcomes["collision"], 1.0),
        collided_with=max(struck, key=lambda v: struck[v], default=None),
    )


def plan_of(ride: Ride) -> tuple[CausalModel, Intervention] | None:
    """The plan of the last decision, of as many of its actions as there is evidence for."""
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
    """When [s] each action of the plan is expected to begin, in the mean of the drives imagined."""
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
