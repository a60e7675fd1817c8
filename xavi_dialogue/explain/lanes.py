"""Why the ego is in its lane: when and why it moved there, or that nothing spoke for another."""

from msgspec.structs import replace

from planner.trace import PlanTrace
from xavi_dialogue.explain.contrast import LANE_CHANGES, contrast
from xavi_dialogue.explain.details import Staying
from xavi_dialogue.explain.explanation import Evidence, Explanation, NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.ride import Deed, Ride, Unanswered, planned

TURNS = ("exit-left", "exit-right", "continue-next-exit")
LEAST = 1.0  # [s] that a change of lane or a turn takes
NO_LANE = ("there is no lane to the left", "there is no lane to the right")


def lane(query: Query, ride: Ride) -> Explanation:
    """Why the ego is in its lane.

    Raises:
        Unanswered: rollouts are needed.
    """
    del query
    moves = [d for d in ride.deeds if d.action in (*LANE_CHANGES, *TURNS) and _lasted(d)]
    last = moves[-1] if moves else None
    if last is not None and last.action in LANE_CHANGES:
        staying = Staying(last.action, last.time, last.ended is None)
        return _against(ride, ride.choice_of(last), None, staying)
    return _kept(ride, _since(last))


def _lasted(deed: Deed) -> bool:
    """Whether it was more than given up at once."""
    return deed.ended is None or deed.ended - deed.started >= LEAST


def _since(last: Deed | None) -> Staying:
    if last is None:
        return Staying()
    return Staying(last.action, last.time if last.ended is None else last.ended)


def _kept(ride: Ride, staying: Staying) -> Explanation:
    """Of a lane that was not changed to: what speaks against leaving it now."""
    free = [trace for trace in ride.traces if trace.under_way is None]
    trace = free[-1] if free else ride.latest
    model = ride.model(trace)
    sides = [action for action in LANE_CHANGES if action in model.options()]
    known = {action: model.intervene((action,)) for action in sides}
    sides.sort(key=lambda action: -(found.value if (found := known[action]) else 0.0))
    if sides and planned(trace)[:1] != (sides[0],):
        return _against(ride, trace, sides[0], staying)
    reasons = [n.reason for n in trace.not_applicable if not n.node and n.action in LANE_CHANGES]
    other = next((reason for reason in reasons if reason not in NO_LANE), None)
    return _alone(ride, trace, replace(staying, only=bool(reasons), reason=other))


def _against(ride: Ride, trace: PlanTrace, foil: str | None, staying: Staying) -> Explanation:
    """What speaks against another lane; nothing, where it would have made no difference.

    Raises:
        Unanswered: rollouts are needed.
    """
    step = next((action for action in LANE_CHANGES if action == foil), None)
    try:
        found = contrast(ride, trace, None if step is None else (step,))
    except Unanswered as unanswered:
        refused = unanswered.result
        if not isinstance(refused, NoExplanation):
            raise
        same = refused.reason == "effect-too-small"
        return _alone(ride, trace, replace(staying, same=same))
    return replace(found, staying=staying)


def _alone(ride: Ride, trace: PlanTrace, staying: Staying) -> Explanation:
    return Explanation(
        factual=planned(trace),
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=Evidence("tree", 0, 0, (trace.trace_id,)),
        sim_time=trace.sim_time,
        staying=staying,
    )
