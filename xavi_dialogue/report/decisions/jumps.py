"""Jumps: probabilities that moved far from one decision to the next, and what changed in between.

What changed is what both decisions recorded otherwise: what was planned and seen, and speeds that
the first one expected. Which of it moved the probability, a record does not show.
"""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from planner.record.trace import Action, GoalPrediction, PlanTrace
from sim.roads.network import angle_between
from sim.scene import EGO
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.explain.history.ride import planned
from xavi_dialogue.report.content import Change, ChangeKind, Jump
from xavi_dialogue.report.decisions.expected import expected_speeds
from xavi_dialogue.report.decisions.weighed import Ground, chosen_plan, collision
from xavi_dialogue.report.figures import Figure, Source, rounded
from xavi_dialogue.report.ridden import predicted
from xavi_dialogue.report.road_users.parties import of_trace
from xavi_dialogue.report.road_users.tracks import Tracks

FAR = 0.5  # of a probability, from which it has moved far
FASTER = 1.0  # [m/s] by which a speed differs
FARTHER = 0.05  # [m] by which a place differs
TURNED = 0.17  # [rad] by which a heading differs

Goal = tuple[Action, str | None]  # its kind and its edge


def jumps(traces: Sequence[PlanTrace], tracks: Tracks, involved: Sequence[int]) -> tuple[Jump, ...]:
    """Return the probabilities that moved by half or more between two decisions in a row.

    Args:
        traces: the decisions, in order of time.
        tracks: where everybody was.
        involved: whose goals are looked at.
    """
    found: list[Jump] = []
    for before, trace in pairwise(traces):
        found += _of_collision(before, trace, tracks, involved)
        for vehicle in involved:
            found += _of_goal(before, trace, tracks, vehicle)
    return tuple(found)


def _of_collision(
    before: PlanTrace, trace: PlanTrace, tracks: Tracks, involved: Sequence[int]
) -> Iterator[Jump]:
    moved: list[tuple[Action | None, Figure | None, Figure | None]] = []
    moved.append((None, _risk(before), _risk(trace)))
    given_up = planned(before)[:1]
    if given_up and given_up != planned(trace)[:1]:
        action = given_up[0]
        moved.append((action, _risk_of(before, action), _risk_of(trace, action)))
    far = [
        (action, was, now)
        for action, was, now in moved
        if was is not None and now is not None and abs(now.value - was.value) >= FAR
    ]
    if not far:
        return
    own = [*_plans(before, trace), *_lights(before, trace), *_speeds(before, trace, EGO)]
    others = [one for v in involved for one in _observed(before, trace, tracks, v)]
    changes = (*own, *others)
    for option, was, now in far:
        yield Jump(None, before.decision, trace.decision, was, now, goal=option, changes=changes)


def _risk_of(trace: PlanTrace, action: Action) -> Figure | None:
    """Return the probability of a collision of an option; None if it was not tried."""
    model = CausalModel(trace)
    found = model.intervene((action,)) if action in model.options() else None
    of = f"of the rollouts that begin with {action}"
    return None if found is None else collision(Ground(trace), found, of)


def _risk(trace: PlanTrace) -> Figure | None:
    """Return the probability of a collision under the plan; None if there is no plan."""
    plan = chosen_plan(CausalModel(trace))
    return None if plan is None else collision(Ground(trace), plan)


def _of_goal(before: PlanTrace, trace: PlanTrace, tracks: Tracks, vehicle: int) -> Iterator[Jump]:
    """Yield the goal of a road user whose probability moved farthest, if that is far."""
    first, then = _goals(before, vehicle), _goals(trace, vehicle)
    if not first or not then:
        return
    moved = {
        name: (then[name][1].value if name in then else 0.0)
        - (first[name][1].value if name in first else 0.0)
        for name in {**then, **first}
    }
    name = max(moved, key=lambda one: abs(moved[one]))  # the new one first, where two are alike
    if abs(moved[name]) < FAR:
        return
    goal = (then.get(name) or first[name])[0]
    yield Jump(
        vehicle=vehicle,
        before=before.decision,
        number=trace.decision,
        was=first[name][1] if name in first else None,
        now=then[name][1] if name in then else None,
        goal=goal.kind,
        place=goal.place,
        changes=tuple(_observed(before, trace, tracks, vehicle)),
    )


def _goals(trace: PlanTrace, vehicle: int) -> dict[Goal, tuple[GoalPrediction, Figure]]:
    found = predicted(trace, vehicle)
    if found is None:
        return {}
    at, known = found
    return {
        (goal.kind, goal.edge): (
            goal,
            Figure(
                goal.probability, "", of_trace(trace, f"predictions[{at}].goals[{k}].probability")
            ),
        )
        for k, goal in enumerate(known.goals)
    }


def _observed(
    before: PlanTrace, trace: PlanTrace, tracks: Tracks, vehicle: int
) -> Iterator[Change]:
    """Yield what was seen of another otherwise than before."""
    there = tuple("in view" if vehicle in one.scene else "" for one in (before, trace))
    if there[0] != there[1]:
        yield _told("in-view", vehicle, there[0], there[1], of_trace(trace, "scene"))
    if not all(there):
        return
    first, then = _place(before, vehicle), _place(trace, vehicle)
    if first and then and first != then:
        yield _told("road", vehicle, first, then, of_trace(trace, f"road.places.{vehicle}"))
    shown = [", ".join(sorted(one.scene[vehicle].signals)) for one in (before, trace)]
    if shown[0] != shown[1]:
        source = of_trace(trace, f"scene.{vehicle}.signals")
        yield _told("signals", vehicle, shown[0], shown[1], source)
    yield from _moved(before, trace, vehicle)
    yield from _speeds(before, trace, vehicle)
    for one in expected_speeds((before,), tracks, vehicle):
        known = one.driven is not None and abs(one.at - trace.sim_time) < 0.05
        if known and one.driven and abs(one.speed.value - one.driven.value) >= FASTER:
            yield Change("expected", vehicle, one.speed, one.driven)


def _moved(before: PlanTrace, trace: PlanTrace, vehicle: int) -> Iterator[Change]:
    """Yield how far somebody moved and turned."""
    here, there = before.scene[vehicle], trace.scene[vehicle]
    since = f"since decision {before.decision}"
    way = math.dist(here.position, there.position)
    if way >= FARTHER:
        source = of_trace(trace, f"scene.{vehicle}.position", since)
        yield Change("moved", vehicle, now=Figure(rounded(way, 2), "m", source))
    turn = angle_between(there.heading, here.heading)
    if abs(turn) >= TURNED:
        source = of_trace(trace, f"scene.{vehicle}.heading", since)
        yield Change("turned", vehicle, now=Figure(rounded(abs(turn)), "rad", source))


def _told(kind: ChangeKind, vehicle: int | None, was: str, now: str, source: Source) -> Change:
    return Change(kind, vehicle, words=(was, now), source=source)


def _place(trace: PlanTrace, vehicle: int) -> str:
    """Return the road that somebody is on: its edge, or the junction."""
    place = None if trace.road is None else trace.road.places.get(vehicle)
    if place is None:
        return ""
    return "a junction" if place.in_junction else f"road {place.edge}"


def _speeds(before: PlanTrace, trace: PlanTrace, vehicle: int) -> Iterator[Change]:
    was, now = (
        Figure(one.scene[vehicle].speed, "m/s", of_trace(one, f"scene.{vehicle}.speed"))
        for one in (before, trace)
    )
    if abs(now.value - was.value) >= FASTER:
        yield Change("speed", vehicle, was, now)


def _plans(before: PlanTrace, trace: PlanTrace) -> Iterator[Change]:
    was, now = planned(before), planned(trace)
    if was[:1] != now[:1]:
        source = of_trace(trace, "plan")
        yield _told("plan", None, "".join(was[:1]), "".join(now[:1]), source)


def _lights(before: PlanTrace, trace: PlanTrace) -> Iterator[Change]:
    was, now = (
        "" if one.road is None or not one.road.lights else one.road.lights[0].state
        for one in (before, trace)
    )
    if was != now:
        yield _told("light", None, was, now, of_trace(trace, "road.lights"))
