"""Statements about chances, and about the risk of collision of the plan or of a foil."""

import math
import re
from collections.abc import Iterator

from benchmarks.truth.context import Fault, Said, claim
from benchmarks.truth.phrases import acts
from planner.record.trace import Action, PlanTrace, Rollout, Sample

CHANCE = r"(?P<under>under |over )?(?P<chance>\d+) %"


def chances(trace: PlanTrace, vehicle: int, kinds: frozenset[str]) -> Iterator[float]:
    """Yield the predicted chances [%] that a vehicle acts in such a way: by goal and by actions."""
    for known in trace.predictions:
        if known.vehicle == vehicle:
            ways = [(g, w) for g in known.goals for w in g.trajectories]
            yield 100.0 * sum(g.probability for g in known.goals if g.kind in kinds)
            for kind in kinds:
                yield 100.0 * sum(g.probability for g in known.goals if g.kind == kind)
            yield from (100.0 * g.probability for g in known.goals if g.kind in kinds)
            yield 100.0 * sum(
                g.probability * w.probability for g, w in ways if kinds & {*w.actions}
            )
            yield 100.0 * sum(
                g.probability * w.probability for g, w in ways if kinds >= {*w.actions}
            )


def told_as(match: re.Match[str], value: float, off: float = 1.1) -> bool:
    """Check whether a stated percentage is that of a value [%]."""
    told = float(match["chance"])
    if match["under"] == "under ":
        return value < told + 0.5
    if match["under"] == "over ":
        return value > told - 0.5
    return abs(value - told) <= off


@claim(
    r"(?P<act>(?:turn|go|stop|move|change|leave)\w*"
    rf"(?: right| left| straight on| to the \w+ lane)?) \({CHANCE}\)"
)
def expected(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check that a vehicle is, or was, expected to act in this way with the stated chance."""
    kinds = acts(match["act"])
    if said.decision is not None:
        return  # `blames` checks it by that decision
    if not kinds or re.search(r"collision|collide", said.text):
        return
    past = bool(re.search(r"\b(expected|thought|would|was a chance|was possible)\b", said.text))
    start, end = (0.0, said.now) if past else (said.now, said.now)
    traces = said.ride.decided(start, end)
    named = said.who(re.findall(r"V\d+", said.text)[-1]) if "V" in said.text else said.last()
    values = [value for t in traces for v in named for value in chances(t, v, kinds[-1])]
    if not any(told_as(match, value) for value in values):
        yield Fault("chance then" if past else "chance now", f"{match[0]}: {_few(values)}")


@claim(rf"chance that (?P<who>V\d+|it) (?:will|would) (?P<act>[^;:.]*?) (?:at|is|was) {CHANCE}")
def chance_put(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the stated chance of what a vehicle will do."""
    kinds = acts(match["act"])
    if not kinds or re.search(r"\b(not|that|let|pull|cut)\b", match["act"]):
        return
    past = " would " in match[0]
    traces = said.ride.decided(0.0 if past else said.now, said.now)
    values = [x for t in traces for v in said.who(match["who"]) for x in chances(t, v, kinds[0])]
    if values and not any(told_as(match, value) for value in values):
        yield Fault("chance then" if past else "chance now", f"{match[0]}: {_few(values)}")


def _few(values: list[float]) -> str:
    return ", ".join(f"{value:.0f}" for value in sorted(set(values))[:12])


def risks(trace: PlanTrace, kinds: frozenset[str], struck: tuple[int, ...]) -> list[float]:
    """Return the shares [%] of rollouts with such actions that collide, by ways to count them."""
    found: list[float] = []
    first = [r for r in trace.rollouts if r.actions and r.actions[0].action in kinds]
    later = [r for r in trace.rollouts if kinds & {step.action for step in r.actions}]
    plan = trace.plan[0].action if trace.plan else None
    chosen = _as_planned(trace)
    for drives in (first, later, chosen if plan in kinds else []):
        for some in (drives, [r for r in drives if not r.forced]):
            if some:
                hits = [r for r in some if r.outcome == "collision"]
                found.append(100.0 * len(hits) / len(some))
                found.append(100.0 * sum(r.collided_with in struck for r in hits) / len(some))
                found.append(_weighted(trace, some))
    return found


def _weighted(trace: PlanTrace, drives: list[Rollout]) -> float:
    """Return the share [%] of collisions, with situations weighted by predicted probability."""
    known = {p.vehicle: p.goals for p in trace.predictions}
    weights: dict[tuple[Sample, ...], float] = {}
    hits: dict[tuple[Sample, ...], list[bool]] = {}
    for drive in drives:
        goals = [(known[s.vehicle][s.goal], s.trajectory) for s in drive.samples]
        chance = math.prod(g.probability * g.trajectories[k].probability for g, k in goals)
        weights[drive.samples] = chance
        hits.setdefault(drive.samples, []).append(drive.outcome == "collision")
    total = sum(weights.values())
    share = sum(weights[s] * sum(h) / len(h) for s, h in hits.items())
    return 100.0 * share / total if total else 0.0


def _as_planned(trace: PlanTrace) -> list[Rollout]:
    plan: list[Action] = [step.action for step in trace.plan]
    return [r for r in trace.rollouts if [s.action for s in r.actions][: len(plan)] == plan]


@claim(
    rf"(?P<foil>[^.;:]*?) (?P<be>carried|carries) (?:a|an) {CHANCE} "
    r"risk of a collision(?: with (?P<who>V\d+|it))?"
)
def risk_of_option(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the risk of an option by the rollouts of the decisions around that time."""
    if said.decision is not None:
        return  # `hazards` checks it by that decision
    foil = re.split(r"because|though|, but", match["foil"])[-1]
    kinds = acts(foil)
    if not kinds:
        return
    struck = said.who(match["who"]) if match["who"] else ()
    past = match["be"] == "carried"
    start, end = said.when(past) if past else (said.now, said.now)
    yield from _risk(said, match, kinds[0], struck, (start - 1.0 if past else start, end))


def _risk(
    said: Said,
    match: re.Match[str],
    kinds: frozenset[str],
    struck: tuple[int, ...],
    span: tuple[float, float],
) -> Iterator[Fault]:
    told = float(match["chance"])
    near_by = [x for t in said.ride.decided(*span) for x in risks(t, kinds, struck)]
    if any(told_as(match, value, 3.0 + 0.1 * told) for value in near_by):
        if struck and not any(
            r.collided_with in struck for t in said.ride.decided(*span) for r in t.rollouts
        ):
            yield Fault("risk with whom", match[0])
        return
    ever = [x for t in said.ride.decided(0.0, said.now) for x in risks(t, kinds, struck)]
    other = any(told_as(match, value, 3.0 + 0.1 * told) for value in ever)
    yield Fault("risk of another time" if other else "risk", f"{match[0]}: {_few(near_by)}")


@claim(
    rf"put the risk of a collision(?: with (?P<who>V\d+|it))? at {CHANCE}"
    r" for what I (?P<be>did|do)\b"
)
def risk_of_plan(said: Said, match: re.Match[str]) -> Iterator[Fault]:
    """Check the risk of what was done by the rollouts of the decisions around that time."""
    if said.decision is not None:
        return
    past = match["be"] == "did"
    start, end = said.when(past) if past else (said.now, said.now)
    traces = said.ride.decided(start - 1.0 if past else start, end)
    struck = said.who(match["who"]) if match["who"] else ()
    values = [x for t in traces if t.plan for x in risks(t, frozenset({t.plan[0].action}), struck)]
    if values and not any(
        told_as(match, value, 3.0 + 0.1 * float(match["chance"])) for value in values
    ):
        yield Fault("risk of what I did", f"{match[0]}: {_few(values)}")
