"""Which of two ways to act is the safer or the smoother, by the measure that the question names."""

from msgspec.structs import replace

from xavi_dialogue.causal.model import Intervention
from xavi_dialogue.explain import ego
from xavi_dialogue.explain.contrast import factual
from xavi_dialogue.explain.course import HARD, brakes, lines
from xavi_dialogue.explain.details import Ranking
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.motion import Motion
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.ride import Ride


def compare(query: Query, ride: Ride) -> Explanation:
    """What the ego did or plans against a foil; with their risks where it is asked which is safer.

    Raises:
        Unanswered: as for any contrast.
    """
    found = ego.why_not(query, ride)
    if query.event == "smoother" and found.counterfactual:
        return replace(found, ranking=Ranking("smoother"))
    if query.event != "safer" or not found.counterfactual:
        return found
    known = {trace.trace_id: trace for trace in ride.traces}
    origin = known.get(found.evidence.traces[0])
    decided = origin or next(t for t in ride.traces if t.sim_time == found.sim_time)
    model, there = ride.evidence(decided, found.counterfactual)
    here = factual(ride.model(decided), decided)
    driven, foil_driven = lines(decided), lines(model.trace)
    ranking = Ranking(
        "safer",
        min(here.outcomes["collision"], 1.0),
        min(there.outcomes["collision"], 1.0),
        _brakes_hard(here, driven),
        _brakes_hard(there, foil_driven),
    )
    return replace(found, ranking=ranking)


def _brakes_hard(plan: Intervention, driven: dict[int, Motion]) -> float | None:
    """The probability of braking hard under a plan, of the drives whose speeds are recorded."""
    known = [
        (weight, brakes(driven[result.rollout.index]) >= HARD)
        for result, weight in zip(plan.results, plan.weights, strict=True)
        if result.rollout.index in driven
    ]
    mass = sum(weight for weight, _ in known)
    return sum(weight for weight, hard in known if hard) / mass if mass > 0.0 else None
