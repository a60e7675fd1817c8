"""What else the ego might have done: which options there were, and whether it had to."""

from typing import Literal, cast

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import Actions, Intervention
from xavi_dialogue.explain.actions import STRAIGHT
from xavi_dialogue.explain.contrast import (
    alternatives,
    arrival,
    evidence,
    explain_contrast,
    factual,
    outcome,
    to_effects,
)
from xavi_dialogue.explain.deeds import DRIVING, happened
from xavi_dialogue.explain.details import Choices, Need, Option
from xavi_dialogue.explain.explanation import Explanation, NoExplanation
from xavi_dialogue.explain.method import decision
from xavi_dialogue.explain.premise import Premise
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import Ride, Unanswered, planned
from xavi_dialogue.explain.slowing import explain_driving

About = Literal["options", "second", "worst", "sooner"]
SOONER = 0.5  # [s] from which an option is sooner
Asked = Literal["necessary", "other-way", "better-way"]


def options(query: Query, ride: Ride) -> Explanation:
    """What else could be done at a decision, or the best or the worst of it.

    Raises:
        Unanswered: what the question names did not happen; or there is too little evidence.
    """
    about = cast(About, query.event)
    found = decision(_about_deed(query, ride), ride)
    trace, model = found.trace, ride.model(found.trace)
    here = factual(model, trace)
    ranked = _others(ride, found)
    if about == "sooner":
        ranked = _sooner(ranked, here)
    others = tuple(_option(found, here, foil, there) for foil, there in ranked)
    plain = _alone(ride, found, here)
    chosen = planned(trace)[len(found.node)]
    plain = replace(plain, choices=Choices(about, chosen, others))
    if not ranked:
        return plain
    foil, there = ranked[-1 if about == "worst" else 0]
    return replace(
        plain,
        counterfactual=foil,
        outcome=outcome(there),
        effects=to_effects(effects(there, here)),
        evidence=evidence(model, ride, here, *(there for _, there in ranked)),
    )


def needed(query: Query, ride: Ride) -> Explanation:
    """Whether the ego had to do what it did: what the best alternative would have cost.

    Raises:
        Unanswered: what the question names did not happen; or there is too little evidence.
    """
    asked = cast(Asked, query.event)
    about = _about_deed(query, ride)
    driving = tuple(action for action in about.factual or () if action in DRIVING)
    if driving and not ("stop" in driving and happened(ride, "stop")):
        return replace(explain_driving(ride, driving, query.tense), need=Need(asked, "driving"))
    found = decision(about, ride)
    trace, model = found.trace, ride.model(found.trace)
    here = factual(model, trace)
    ranked = _others(ride, found)
    if not ranked:
        return replace(_alone(ride, found, here), need=Need(asked, "only"))
    foil, there = ranked[0]
    best = foil[len(found.node)]
    try:
        explained = explain_contrast(ride, model, here, there, foil)
    except Unanswered as unanswered:
        refused = unanswered.result
        if isinstance(refused, NoExplanation) and refused.reason == "effect-too-small":
            return replace(_alone(ride, found, here), need=Need(asked, "equal", best))
        raise
    kind: Literal["worse", "bad"] = "worse" if there.likeliest == "done" else "bad"
    return replace(explained, need=Need(asked, kind, best))


def _about_deed(query: Query, ride: Ride) -> Query:
    """The query about what was done: as it says, as the question before it did, or the last deed.

    What the question before it was about may not have happened; it is then not held to it.
    """
    named = query.factual or query.counterfactual
    plain = replace(query, counterfactual=None)
    if not named:
        return plain
    supposed = not query.factual and set(named) <= set(STRAIGHT)  # driving on goes without saying
    if query.refers_to_previous and (supposed or not all(_done(ride, a) for a in named)):
        return replace(plain, factual=None)
    return replace(plain, factual=named)


def _done(ride: Ride, action: QueryAction) -> bool:
    waited = action == "give-way" and any(event.kind == "gave-way" for event in ride.events)
    drove = action in DRIVING and ride.motion(EGO).last(action) is not None
    return waited or drove or happened(ride, action) is not None


def _others(ride: Ride, found: Premise) -> list[tuple[Actions, Intervention]]:
    plan = planned(found.trace)
    if len(plan) <= len(found.node):
        return []
    return alternatives(ride.model(found.trace), plan[len(found.node)], found.node)


def _sooner(
    ranked: list[tuple[Actions, Intervention]], here: Intervention
) -> list[tuple[Actions, Intervention]]:
    """The options that get there sooner than what was chosen, the soonest first."""
    known = [(_later(there, here), foil, there) for foil, there in ranked]
    sooner = [
        (delta, foil, there)
        for delta, foil, there in known
        if delta is not None and delta <= -SOONER and there.likeliest == "done"
    ]
    return [(foil, there) for _, foil, there in sorted(sooner, key=lambda one: one[0])]


def _later(there: Intervention, here: Intervention) -> float | None:
    """By how much [s] an option gets there later; None where that cannot be told."""
    return next((e.delta for e in effects(there, here) if e.component == "time"), None)


def _option(found: Premise, here: Intervention, foil: Actions, there: Intervention) -> Option:
    ends = outcome(there)
    delta = _later(there, here) if ends.name == "done" else None
    return Option(foil[len(found.node)], ends.name, ends.probability, delta, ends.collided_with)


def _alone(ride: Ride, found: Premise, here: Intervention) -> Explanation:
    """What was decided, with nothing beside it."""
    model = ride.model(found.trace)
    return Explanation(
        factual=here.plan,
        counterfactual=(),
        outcome=outcome(here),
        effects=(),
        causes=(),
        evidence=evidence(model, ride, here),
        sim_time=found.trace.sim_time,
        arrival=arrival(found.trace, here),
    )
