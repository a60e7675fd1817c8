"""What an answer rests on, as browsers get it: the rollouts behind its figures."""

import re
from collections.abc import Mapping

from planner.trace import PlanTrace, Rollout
from sim.scene import EGO
from xavi_dialogue.app.dashboard.branches import rounded
from xavi_dialogue.app.dashboard.decisions import chances, expected_arrival
from xavi_dialogue.app.dashboard.lines import chance, likeliest
from xavi_dialogue.app.dashboard.sides import Found, sides
from xavi_dialogue.app.dashboard.words import (
    cause_words,
    checked_words,
    dashboard_words,
    does,
    has_lane_change,
    hold_up_words,
    plan_words,
    way_words,
)
from xavi_dialogue.causal.model import Actions, Result, plan_of
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.explain.explanation import Cause, Explanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.vehicles import number_of
from xavi_dialogue.language.wording import lexicon
from xavi_dialogue.transports.web.documents import CauseShown, EffectShown, EvidenceShown, Run, Side

LINES = 5  # of a side, at most
RUNS = 100  # of a side, at most
DIGITS = 4  # of effects, whose units are small

_NAMED = re.compile(r"\bvehicle (\d{1,9})\b", re.IGNORECASE)


def vehicles_of(reply: Reply) -> tuple[int, ...]:
    """The other vehicles that a reply speaks of, or that it was asked about; each once."""
    named = [int(number) for number in _NAMED.findall(reply.text)]
    asked = None if reply.query is None else number_of(reply.query.actor)
    if asked is not None:
        named.append(asked)
    return tuple(dict.fromkeys(vehicle for vehicle in named if vehicle != EGO))


def has_evidence(reply: Reply) -> bool:
    """Whether there is more behind a reply than the decision that it is about."""
    found = reply.explanation
    if found is None or not traces_of(reply):
        return False
    return bool(found.counterfactual or found.effects or found.causes or found.evidence.rollouts)


def traces_of(reply: Reply) -> tuple[str, ...]:
    """The ids of the decisions, and of the plans made again, that a reply rests on."""
    if reply.kind != "answer" or reply.explanation is None:
        return ()
    return tuple(dict.fromkeys(reply.explanation.evidence.traces))


def of_turn(n: int, reply: Reply, traces: Mapping[str, PlanTrace]) -> EvidenceShown | None:
    """What a turn rests on; None where nothing is behind it.

    Args:
        n: number of the turn.
        reply: of the turn.
        traces: by id, those of `traces_of` as far as they are at hand. There may be more: of a
            plan made again, the decision itself is found among them.
    """
    explanation, names = reply.explanation, traces_of(reply)
    if explanation is None or not names:
        return None
    known = [traces[name] for name in names if name in traces]
    here, there = sides(reply.query, explanation, known)
    decision = _decision(known, traces)
    plans = [found.plan.plan for found in (here, there) if found is not None]
    in_lane = has_lane_change(action for plan in plans for action in plan[:1])
    evidence = explanation.evidence
    return EvidenceShown(
        n=n,
        decision=names[0] if decision is None else decision.trace_id,
        t=explanation.sim_time if decision is None else decision.sim_time,
        method=dashboard_words("method", evidence.method),
        rollouts=evidence.rollouts,
        distinct=evidence.distinct_samples,
        factual=None if here is None else _side(here, in_lane, "fact", explanation.factual[:1]),
        counterfactual=None
        if there is None
        else _side(there, in_lane, _asked(reply.query), explanation.counterfactual),
        effects=_effects(explanation),
        causes=_causes(explanation, known),
        traces=names,
        missing=_missing(explanation, names, known, there),
    )


def _decision(known: list[PlanTrace], traces: Mapping[str, PlanTrace]) -> PlanTrace | None:
    """The decision as it was taken, where it is at hand; else as it was planned again."""
    if not known:
        return None
    moment = (known[0].sim_time, known[0].decision)
    every = (*known, *traces.values())
    taken = (t for t in every if t.what_if is None and (t.sim_time, t.decision) == moment)
    return next(taken, known[0])


def _missing(
    explanation: Explanation, names: tuple[str, ...], known: list[PlanTrace], there: Found | None
) -> str | None:
    if not known:
        return dashboard_words("missing", "all")
    if explanation.counterfactual and there is None:
        return dashboard_words("missing", "some" if len(known) < len(names) else "otherwise")
    return None


def _asked(query: Query | None) -> str:
    """As what the counterfactual came into it: asked about, or thought of beside what was asked."""
    if query is None:
        return "instead"
    if query.intervention is not None or query.condition is not None:
        return "then"
    return "instead" if query.counterfactual is None else "asked"


def _side(found: Found, in_lane: bool, title: str, brief: Actions) -> Side:
    """One side: its likeliest lines, and its rollouts with the likeliest situations first."""
    plan, trace = found.plan, found.trace
    ranked = sorted(zip(plan.weights, plan.results, strict=True), key=lambda pair: -pair[0])
    return Side(
        title=dashboard_words("title", title),
        brief=plan_words(brief, in_lane=in_lane),
        words=plan_words(plan.plan, in_lane=in_lane),
        outcomes=chances(plan),
        arrival=expected_arrival(trace, plan),
        lines=likeliest(trace, plan, LINES),
        runs=tuple(_run(trace, result, in_lane) for _, result in ranked[:RUNS]),
        rollouts=plan.draws,
    )


def _run(trace: PlanTrace, result: Result, in_lane: bool) -> Run:
    rollout = result.rollout
    lasted: dict[tuple[int, str], float] = {}
    for stretch in rollout.held_up:
        key = (stretch.vehicle, hold_up_words(stretch.how))
        lasted[key] = lasted.get(key, 0.0) + stretch.until - stretch.since
    time = None if trace.waypoint is not None else rollout.components.get("time")
    return Run(
        index=rollout.index,
        draws=result.draws,
        words=plan_words(plan_of(rollout), in_lane=in_lane),
        outcome=rollout.outcome,
        arrival=rounded(time),
        samples=_samples(trace, rollout),
        held_up=tuple(
            (vehicle, how, round(seconds, 1)) for (vehicle, how), seconds in lasted.items()
        ),
        collided_with=rollout.collided_with,
    )


def _samples(trace: PlanTrace, rollout: Rollout) -> tuple[tuple[int, str, float], ...]:
    """What the others do in a rollout, and how probable that was."""
    known = {prediction.vehicle: prediction for prediction in trace.predictions}
    found = []
    for sample in sorted(rollout.samples, key=lambda sample: sample.vehicle):
        goal = known[sample.vehicle].goals[sample.goal]
        way = goal.trajectories[sample.trajectory]
        said = does(way.actions or (goal.kind,))
        found.append((sample.vehicle, said, chance(goal.probability * way.probability)))
    return tuple(found)


def _effects(explanation: Explanation) -> tuple[EffectShown, ...]:
    components = lexicon().components
    return tuple(
        EffectShown(
            words=components[effect.component],
            unit=effect.unit,
            delta=round(effect.delta, DIGITS),
            low=round(effect.low, DIGITS),
            high=round(effect.high, DIGITS),
            n=effect.n,
            n_distinct=effect.n_distinct,
        )
        for effect in explanation.effects
    )


def _causes(explanation: Explanation, known: list[PlanTrace]) -> tuple[CauseShown, ...]:
    activity = explanation.activity
    of_ours = activity is None or activity.vehicle == EGO
    removed = {again.what_if.removed for again in known if again.what_if is not None}
    return tuple(
        CauseShown(
            vehicle=cause.vehicle,
            words=cause_words(cause, of_ours=of_ours),
            probability=chance(cause.probability),
            how=way_words(cause, of_ours=of_ours),
            influence=rounded(cause.influence),
            checked=checked_words(cause) if _was_tried(cause, removed) else None,
        )
        for cause in explanation.causes
    )


def _was_tried(cause: Cause, removed: set[int | None]) -> bool:
    """Whether it was planned again without a vehicle: that it does otherwise shows less."""
    return cause.necessary is not None or cause.vehicle in removed
