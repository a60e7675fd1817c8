"""The evidence of an answer for browsers: the rollouts behind its figures."""

import re
from collections.abc import Mapping

from planner.record.trace import PlanTrace, Rollout
from sim.scene import EGO
from xavi_dialogue.causal.mixtures import Result
from xavi_dialogue.causal.model import Actions, plan_of
from xavi_dialogue.dashboard.typed_answer import TypedAnswer, asked_about, title_of, told_of
from xavi_dialogue.dashboard.views.contrast import ContrastSide, sides
from xavi_dialogue.dashboard.views.decision import expected_arrival, outcome_shares
from xavi_dialogue.dashboard.views.labels import (
    cause_words,
    checked_words,
    component_words,
    dashboard_words,
    does,
    has_lane_change,
    hold_up_words,
    plan_words,
    way_words,
)
from xavi_dialogue.dashboard.views.search_tree import rounded
from xavi_dialogue.dashboard.views.trajectories import chance, likeliest
from xavi_dialogue.dashboard.web.http_documents import (
    CauseShown,
    EffectShown,
    EvidenceShown,
    Run,
    Side,
)
from xavi_dialogue.dialogue.explanation import Contrastive
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.domain.answers import Cause

LINES = 5  # greatest number of lines of a side
RUNS = 100  # greatest number of rollouts of a side
DIGITS = 4  # decimals of effects, which may be small

_NAMED = re.compile(r"\bvehicle (\d{1,9})\b", re.IGNORECASE)


def vehicles_of(reply: Reply) -> tuple[int, ...]:
    """Return the other vehicles that a reply or its question mentions, each once."""
    named = [int(number) for number in _NAMED.findall(reply.text)]
    named += asked_about(reply)
    return tuple(dict.fromkeys(vehicle for vehicle in named if vehicle != EGO))


def has_evidence(reply: Reply) -> bool:
    """Check whether a reply rests on more than the decision that it is about."""
    told = told_of(reply)
    if told is None or not told.said.evidence.traces:
        return False
    said = told.said
    return bool(said.counterfactual or said.effects or said.causes or said.evidence.rollouts)


def traces_of(reply: Reply) -> tuple[str, ...]:
    """Return the ids of the decisions, and of the plans made again, that a reply rests on."""
    told = told_of(reply)
    return () if told is None else tuple(dict.fromkeys(told.said.evidence.traces))


def of_turn(n: int, reply: Reply, traces: Mapping[str, PlanTrace]) -> EvidenceShown | None:
    """Return the evidence of a turn; None if there is none.

    Args:
        n: number of the turn.
        reply: of the turn.
        traces: by id, those of `traces_of` as far as they are at hand. There may be more: of a
            plan made again, the decision itself is found among them.
    """
    told, names = told_of(reply), traces_of(reply)
    if told is None or not names:
        return None
    known = [traces[name] for name in names if name in traces]
    return _shown(n, reply, told, names, known, traces)


def _shown(
    n: int,
    reply: Reply,
    told: TypedAnswer,
    names: tuple[str, ...],
    known: list[PlanTrace],
    traces: Mapping[str, PlanTrace],
) -> EvidenceShown:
    said = told.said
    here, there = sides(told, known)
    decision = _decision(known, traces)
    plans = [found.plan.plan for found in (here, there) if found is not None]
    in_lane = has_lane_change(action for plan in plans for action in plan[:1])
    decided = reply.sim_time if told.decided is None else told.decided
    brief = said.factual[:1] or (() if here is None else here.plan.plan[:1])
    return EvidenceShown(
        n=n,
        decision=names[0] if decision is None else decision.trace_id,
        t=decided if decision is None else decision.sim_time,
        method=dashboard_words("method", said.evidence.method),
        rollouts=said.evidence.rollouts,
        distinct=said.evidence.distinct_samples,
        factual=None if here is None else _side(here, in_lane, "fact", brief),
        counterfactual=None
        if there is None
        else _side(there, in_lane, title_of(told, reply), said.counterfactual),
        effects=_effects(said),
        causes=_causes(told, known),
        traces=names,
        missing=_missing(said, names, known, there),
    )


def _decision(known: list[PlanTrace], traces: Mapping[str, PlanTrace]) -> PlanTrace | None:
    """Return the decision as taken if it is known, else as planned again."""
    if not known:
        return None
    moment = (known[0].sim_time, known[0].decision)
    every = (*known, *traces.values())
    taken = (t for t in every if t.what_if is None and (t.sim_time, t.decision) == moment)
    return next(taken, known[0])


def _missing(
    said: Contrastive, names: tuple[str, ...], known: list[PlanTrace], there: ContrastSide | None
) -> str | None:
    if not known:
        return dashboard_words("missing", "all")
    if said.counterfactual and there is None:
        return dashboard_words("missing", "some" if len(known) < len(names) else "otherwise")
    return None


def _side(found: ContrastSide, in_lane: bool, title: str, brief: Actions) -> Side:
    """Return one side: its likeliest lines, and its rollouts, likeliest situations first."""
    plan, trace = found.plan, found.trace
    ranked = sorted(zip(plan.weights, plan.results, strict=True), key=lambda pair: -pair[0])
    return Side(
        title=dashboard_words("title", title),
        brief=plan_words(brief, in_lane=in_lane),
        words=plan_words(plan.plan, in_lane=in_lane),
        outcomes=outcome_shares(plan),
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
    """Return what the others do in a rollout, with its probability."""
    known = {prediction.vehicle: prediction for prediction in trace.predictions}
    found = []
    for sample in sorted(rollout.samples, key=lambda sample: sample.vehicle):
        goal = known[sample.vehicle].goals[sample.goal]
        way = goal.trajectories[sample.trajectory]
        said = does(way.actions or (goal.kind,))
        found.append((sample.vehicle, said, chance(goal.probability * way.probability)))
    return tuple(found)


def _effects(said: Contrastive) -> tuple[EffectShown, ...]:
    return tuple(
        EffectShown(
            words=component_words(effect.component),
            unit=effect.unit,
            delta=round(effect.delta, DIGITS),
            low=round(effect.low, DIGITS),
            high=round(effect.high, DIGITS),
            n=effect.n,
            n_distinct=effect.n_distinct,
        )
        for effect in said.effects
    )


def _causes(told: TypedAnswer, known: list[PlanTrace]) -> tuple[CauseShown, ...]:
    of_ours = told.ours
    removed = {v for again in known if again.what_if is not None for v in again.what_if.gone}
    return tuple(
        CauseShown(
            vehicle=cause.vehicle,
            words=cause_words(cause, of_ours=of_ours),
            probability=chance(cause.probability),
            how=way_words(cause, of_ours=of_ours),
            influence=rounded(cause.influence),
            checked=checked_words(cause) if _was_tried(cause, removed) else None,
        )
        for cause in told.said.causes
    )


def _was_tried(cause: Cause, removed: set[int]) -> bool:
    """Check whether the decision was planned again without a vehicle."""
    return cause.necessary is not None or cause.vehicle in removed
