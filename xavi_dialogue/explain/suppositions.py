"""What if another vehicle did otherwise, or were not there."""

from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import Actions, CausalModel, Choice, Intervention
from xavi_dialogue.explain.causes import expected_actions
from xavi_dialogue.explain.contrast import evidence, factual, outcome, to_effects
from xavi_dialogue.explain.explanation import Cause, Explanation, NeedRollout
from xavi_dialogue.explain.query import Query, Tense
from xavi_dialogue.explain.ride import Ride, Unanswered, decline, enough, planned, prediction, thin
from xavi_dialogue.explain.vehicles import actor_of, check_contrary, matching


def what_if(query: Query, ride: Ride) -> Explanation:
    """What the ego would do if a vehicle did, or had not done, something; or were not there."""
    vehicle = actor_of(query, ride)
    asked = query.counterfactual or ()
    moment = _moment(ride, query.tense)
    if not asked or query.intervention == "remove":
        return _without(ride, vehicle, moment)
    past = query.tense == "past"
    if past:
        check_contrary(ride, vehicle, asked, done=query.negated)
    for trace in reversed(ride.traces):
        if trace.sim_time > moment + 1e-6 or prediction(trace, vehicle) is None:
            continue
        model = ride.model(trace)
        every = frozenset(model.choices(vehicle))
        matched = matching(model, vehicle, asked)
        if matched and (matched != every or not query.negated):
            supposed = every - matched if query.negated else matched
            return _supposing(ride, model, vehicle, supposed, every - supposed if past else every)
    raise thin(asked, None)


def _moment(ride: Ride, tense: Tense) -> float:
    """The time [s] of the decision that a supposition is about."""
    deed = ride.manoeuvre
    if tense == "past" and deed is not None:
        return ride.choice_of(deed).sim_time
    return ride.latest.sim_time


def _supposing(
    ride: Ride,
    model: CausalModel,
    vehicle: int,
    supposed: frozenset[Choice],
    actual: frozenset[Choice],
) -> Explanation:
    """The ego's best plan given what is supposed of a vehicle, against that given the actual.

    Where the vehicle did the contrary, or nothing is known of it, the latter is the plan itself.
    """
    trace, chances = model.trace, model.choices(vehicle)
    every = frozenset(chances)
    there = _best(CausalModel(trace, {vehicle: supposed}), planned(trace))
    here = factual(model, trace)
    if actual not in (every, frozenset()):
        here = _best(CausalModel(trace, {vehicle: actual}), planned(trace))
    likeliest = max(supposed, key=lambda choice: (chances[choice], choice))
    actions, _ = expected_actions(model, vehicle, likeliest)
    chance = min(sum(chances[choice] for choice in supposed), 1.0)
    cause = Cause(vehicle, actions, chance, None, None, there.plan != here.plan)
    return _compared(ride, model, here, there, cause)


def _best(given: CausalModel, plan: Actions) -> Intervention:
    """The best of the plans that there is evidence for; of equals, what is planned anyway.

    Raises:
        Unanswered: there is too little evidence.
    """
    found = [i for a in given.options() if (i := given.intervene((a,))) is not None]
    options = [intervention for intervention in found if enough(intervention)]
    if not options:
        raise thin(plan[:1], max(found, key=lambda i: i.draws, default=None))
    return max(options, key=lambda i: (i.value, i.plan[:1] == plan[:1]))


def _without(ride: Ride, vehicle: int, moment: float) -> Explanation:
    """The plan made again without a vehicle, against the plan as it was."""
    trace = ride.at(moment, vehicle)
    if trace is None or prediction(trace, vehicle) is None:
        raise decline("outside-record", vehicle=vehicle, time=moment)
    again = ride.variants(trace, removed=vehicle)
    if not again:
        raise Unanswered(NeedRollout(trace_id=trace.trace_id, removed=vehicle))
    model, other = ride.model(trace), ride.model(again[-1])
    here, there = factual(model, trace), factual(other, again[-1])
    choices = model.choices(vehicle)
    actions, chance = expected_actions(model, vehicle, max(choices, key=lambda c: choices[c]))
    cause = Cause(vehicle, actions, chance, None, None, there.plan != here.plan)
    return _compared(ride, other, here, there, cause)


def _compared(
    ride: Ride, model: CausalModel, here: Intervention, there: Intervention, cause: Cause
) -> Explanation:
    return Explanation(
        factual=here.plan,
        counterfactual=there.plan,
        outcome=outcome(there),
        effects=to_effects(effects(there, here)),
        causes=(cause,),
        evidence=evidence(model, ride, here, there),
        sim_time=model.trace.sim_time,
        arrival=here.expectation("time"),
    )
