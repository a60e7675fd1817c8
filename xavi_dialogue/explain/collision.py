"""Collisions: whether there was one, when and why, and how likely one is."""

import math

from msgspec.structs import replace

from planner.events import Event
from planner.trace import PlanTrace
from xavi_dialogue.explain.avoidance import CRASH, crashed, how_avoid
from xavi_dialogue.explain.causes import expected_actions
from xavi_dialogue.explain.contrast import evidence, factual
from xavi_dialogue.explain.details import Impact
from xavi_dialogue.explain.explanation import Evidence, Explanation, OutcomeEstimate
from xavi_dialogue.explain.query import Query, QueryType
from xavi_dialogue.explain.ride import ROUNDING, Ride, Unanswered, decline
from xavi_dialogue.explain.timing import ARRIVAL

#: Types of questions that name a collision and ask nothing else.
ASKED = frozenset[QueryType](("what", "confidence", "why", "when", "how"))
#: Those of them that may be about one that has not happened, and may yet.
AHEAD = frozenset[QueryType](("what", "confidence", "when"))


def collision(query: Query, ride: Ride) -> Explanation:
    """What is known of the collision there was; else, how likely one is.

    How likely it is, is the probability under the latest plan, as its rollouts show.

    Raises:
        Unanswered: there was none, and none is to be expected by what is asked.
    """
    if crashed(ride) is not None:
        return happened(query, ride)
    past = query.tense == "past" and query.type != "confidence"
    if past or query.type not in AHEAD:
        raise no_crash()
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


def happened(query: Query, ride: Ride) -> Explanation:
    """The last collision: when and with whom, and what was expected before.

    Where it is asked why, with what would have avoided it, as far as the record tells: nobody
    decides to collide, so there is no other reason.

    Raises:
        Unanswered: there was none.
    """
    crash = crashed(ride)
    if crash is None:
        raise no_crash()
    moment = crash.sim_time
    impact, behind = _impact(ride, crash)
    if query.event != CRASH:
        deed = ride.manoeuvre
        return _told(impact if deed is None else replace(impact, deed=deed.action), moment, behind)
    if query.type in ("why", "how"):
        try:
            found = how_avoid(replace(query, type="how_avoid", factual=None), ride)
        except Unanswered:
            return _told(impact, moment, behind)
        return replace(found, impact=impact)
    return _told(impact, moment, behind)


def names_collision(query: Query) -> bool:
    """Whether a question is about a collision, and not about what led to it."""
    return query.event == CRASH and query.type in ASKED


def tells_collision(query: Query, ride: Ride) -> bool:
    """Whether it is asked what happened, or for the arrival, after a collision."""
    crash = crashed(ride)
    if query.actor != "ego" or crash is None:
        return False
    time = crash.sim_time
    if ride.past is not None and not ride.past.meets(math.floor(time), time):
        return False  # it is said to the second
    if query.event == ARRIVAL:
        return not ride.arrived
    open_ = not query.factual and not query.counterfactual and query.event is None
    return open_ and query.type in ("what", "when") and query.tense == "past"


def no_crash() -> Unanswered:
    """The refusal where there was no collision."""
    return decline("did-not-happen", vehicle=0, did=False, what=CRASH)


def _impact(ride: Ride, crash: Event) -> tuple[Impact, PlanTrace | None]:
    """A collision, with the last decision before it that knew the vehicle."""
    vehicle = crash.vehicle
    if vehicle is None:
        return Impact(None), None
    trace = ride.at(crash.sim_time - 2.0 * ROUNDING, vehicle)
    if trace is None:
        return Impact(vehicle), None
    model = ride.model(trace)
    try:
        plan = factual(model, trace)
    except Unanswered:
        return Impact(vehicle), None
    chance = min(plan.collisions().get(vehicle, 0.0), 1.0)
    known = Impact(vehicle, trace.sim_time, chance)
    if vehicle not in model.vehicles:
        return known, trace
    choices = model.choices(vehicle)
    likeliest = max(choices, key=lambda choice: choices[choice])
    actions, probability = expected_actions(model, vehicle, likeliest)
    return replace(known, actions=actions, probability=probability), trace


def _told(impact: Impact, moment: float, behind: PlanTrace | None) -> Explanation:
    """Only what happened, and what was expected by the decision behind it."""
    known = () if behind is None else (behind.trace_id,)
    return Explanation(
        factual=(),
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=Evidence("tree", 0, 0, known),
        sim_time=moment if behind is None else behind.sim_time,
        moment=moment,
        impact=impact,
    )
