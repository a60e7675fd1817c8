"""What if another vehicle did otherwise, or were not there."""

from planner.trace import PlanTrace
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import Actions, CausalModel, Choice, Intervention
from xavi_dialogue.explain.actions import is_macro
from xavi_dialogue.explain.causes import expected_actions
from xavi_dialogue.explain.contrast import (
    LANE_CHANGES,
    arrival,
    evidence,
    factual,
    outcome,
    to_effects,
)
from xavi_dialogue.explain.explanation import Cause, Evidence, Explanation, NeedRollout
from xavi_dialogue.explain.query import Query, QueryAction, Tense
from xavi_dialogue.explain.ride import (
    ROUNDING,
    Ride,
    Unanswered,
    decline,
    enough,
    planned,
    prediction,
    thin,
)
from xavi_dialogue.explain.vehicles import actor_of, check_contrary, matching


def what_if(query: Query, ride: Ride) -> Explanation:
    """What the ego would do if a vehicle did, or had not done, something; or were not there."""
    vehicle = actor_of(query, ride)
    asked = query.counterfactual or ()
    moment = moment_of(ride, query.tense, vehicle)
    if not asked or query.intervention == "remove":
        return _without(ride, vehicle, moment)
    return _otherwise(query, ride, vehicle, asked, moment)


def _otherwise(
    query: Query, ride: Ride, vehicle: int, asked: tuple[QueryAction, ...], moment: float
) -> Explanation:
    """What the ego would do if a vehicle did, or had not done, something.

    That is told from the samples of the decision itself; where they are too few, it is planned
    again with the vehicle acting so.
    """
    if query.tense == "past":
        check_contrary(ride, vehicle, asked, done=query.negated)
    known = known_to(ride, vehicle, moment)
    if not known:
        raise decline("outside-record", vehicle=vehicle, time=moment)
    model = ride.model(known[-1])
    every, matched = frozenset(model.choices(vehicle)), matching(model, vehicle, asked)
    supposed = every - matched if query.negated else matched
    refused: Unanswered = thin(asked, None)
    if supposed and matched:
        try:
            return _supposing(ride, model, vehicle, supposed)
        except Unanswered as unanswered:
            refused = unanswered
    steps = tuple(action for action in asked if is_macro(action))
    if query.negated or len(steps) < len(asked):
        raise refused
    return _acting(ride, vehicle, steps, moment, refused)


def _acting(
    ride: Ride, vehicle: int, steps: Actions, moment: float, refused: Unanswered
) -> Explanation:
    """The plan made again with a vehicle that does what nothing in the record provides for.

    Raises:
        Unanswered: it must be planned again first; or that was not possible.
    """
    known = known_to(ride, vehicle, moment)
    if not known:
        raise refused
    need = NeedRollout(trace_id=known[-1].trace_id, vehicle=vehicle, vehicle_actions=steps)
    if len(steps) == 1 and steps[0] not in LANE_CHANGES:  # where it goes, however it gets there
        need = NeedRollout(trace_id=known[-1].trace_id, vehicle=vehicle, goal=steps[0])
    again = ride.supposed(known[-1], need)
    if again is not None:
        return compared(ride, vehicle, known[-1], again)
    raise refused if ride.cannot_have(need) else Unanswered(need)


def known_to(ride: Ride, vehicle: int, moment: float) -> list[PlanTrace]:
    """The decisions up to a time [s] that had a choice and reckoned with a vehicle."""
    return [
        trace
        for trace in ride.traces
        if trace.sim_time <= moment + ROUNDING
        and trace.under_way is None
        and prediction(trace, vehicle) is not None
    ]


def moment_of(ride: Ride, tense: Tense, vehicle: int | None = None) -> float:
    """The time [s] of the decision that a supposition is about.

    Of the past, it is the one for the last deed; of a vehicle that came into view only then, the
    latest.
    """
    deed = ride.manoeuvre
    if tense == "past" and deed is not None:
        time = ride.choice_of(deed).sim_time
        before = [trace for trace in ride.traces if trace.sim_time <= time + ROUNDING]
        if vehicle is None or any(prediction(trace, vehicle) for trace in before):
            return time
    return ride.latest.sim_time


def _supposing(
    ride: Ride, model: CausalModel, vehicle: int, supposed: frozenset[Choice]
) -> Explanation:
    """The ego's best plan given what is supposed of a vehicle, against what was decided.

    Raises:
        Unanswered: there is too little evidence.
    """
    trace, chances = model.trace, model.choices(vehicle)
    there = _best(CausalModel(trace, {vehicle: supposed}), planned(trace))
    here = factual(model, trace)
    likeliest = max(supposed, key=lambda choice: (chances[choice], choice))
    actions, _ = expected_actions(model, vehicle, likeliest)
    chance = min(sum(chances[choice] for choice in supposed), 1.0)
    cause = Cause(vehicle, actions, chance, None, None, there.plan[:1] != here.plan[:1])
    return Explanation(
        factual=here.plan,
        counterfactual=there.plan,
        outcome=outcome(there),
        effects=to_effects(effects(there, here)),
        causes=(cause,),
        evidence=evidence(model, ride, there, here),
        sim_time=trace.sim_time,
        arrival=arrival(trace, here),
    )


def _best(given: CausalModel, plan: Actions) -> Intervention:
    """The best of the plans that there is evidence for; of equals, what is planned anyway.

    Raises:
        Unanswered: there is too little evidence, if only of what is planned.
    """
    found = [i for a in given.options() if (i := given.intervene((a,))) is not None]
    options = [intervention for intervention in found if enough(intervention)]
    if not any(intervention.plan[:1] == plan[:1] for intervention in options):
        raise thin(plan[:1], given.intervene(plan[:1]))
    return max(options, key=lambda i: (i.value, i.plan[:1] == plan[:1]))


def replanned(ride: Ride, vehicle: int, moment: float) -> tuple[PlanTrace, PlanTrace]:
    """The last decision up to a time [s] that reckons with a vehicle; the same without it.

    Raises:
        Unanswered: there is none, or it must be planned again first.
    """
    known = known_to(ride, vehicle, moment)
    if not known:
        raise decline("outside-record", vehicle=vehicle, time=moment)
    again = ride.variants(known[-1], removed=vehicle)
    if not again:
        raise Unanswered(NeedRollout(trace_id=known[-1].trace_id, removed=vehicle))
    return known[-1], again[-1]


def _without(ride: Ride, vehicle: int, moment: float) -> Explanation:
    """The plan made again without a vehicle, against the plan as it was."""
    trace, again = replanned(ride, vehicle, moment)
    return compared(ride, vehicle, trace, again)


def compared(ride: Ride, vehicle: int, trace: PlanTrace, again: PlanTrace) -> Explanation:
    """The plan of a decision made again with a vehicle gone or acting otherwise, against it."""
    model, other = ride.model(trace), ride.model(again)
    here, there = factual(model, trace), factual(other, again)
    choices = model.choices(vehicle)
    actions, chance = expected_actions(model, vehicle, max(choices, key=lambda c: choices[c]))
    cause = Cause(vehicle, actions, chance, None, None, there.plan[:1] != here.plan[:1])
    there_rests, here_rests = evidence(other, ride, there), evidence(model, ride, here)
    return Explanation(
        factual=here.plan,
        counterfactual=there.plan,
        outcome=outcome(there),
        effects=to_effects(effects(there, here)),
        causes=(cause,),
        evidence=Evidence(
            "rollouts",
            there_rests.rollouts + here_rests.rollouts,
            there_rests.distinct_samples + here_rests.distinct_samples,
            (*here_rests.traces, *there_rests.traces),
        ),
        sim_time=trace.sim_time,
        arrival=arrival(trace, here),
    )
