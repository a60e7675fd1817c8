"""Suppositions that another vehicle has a certain goal, or takes certain actions.

A supposition is certain: one belief of probability 1 replaces the beliefs of recognition. The
others are predicted as before, since each prediction assumes that the other vehicles coast.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from planner.manoeuvres.actions import Situation, expand
from planner.motion.forward import DT, Motion
from planner.motion.obstacles import NOBODY, Obstacle, Traffic
from planner.motion.surroundings import Others, Surroundings
from planner.motion.tracks import Observed
from planner.prediction.astar import GRIP
from planner.prediction.goals import PLACES, Goal, goals_in_view
from planner.prediction.onward import motion_along, trajectories_to
from planner.prediction.people import ways_of
from planner.prediction.recognise import Belief, Trajectory
from planner.record.trace import ON_FOOT, Action, EgoGoal
from planner.roads.routes import Refusal
from planner.rollouts.rollout import Leg, Task, held_by_lights, held_up, take
from planner.search.decide import observed
from planner.search.inputs import Frame, Moment

STRAIGHT = ("continue", "exit-straight")  # one word to people


@dataclass(frozen=True, slots=True, eq=False)
class _Prospect:
    """The situation of one vehicle: its task, its possible places, and the others."""

    task: Task  # without a goal
    observed: Observed
    starts: tuple[Situation, ...]  # possible ones, one for each lane that fits
    others: Others  # coasting


def suppose(
    frame: Frame,
    moment: Moment,
    known: Sequence[Belief],
    vehicle: int,
    goal: str | None,
    actions: Sequence[Action],
) -> Belief | Refusal:
    """Return the one belief about a vehicle that a supposition leads to.

    With a goal alone, its ways there keep their relative probabilities. If recognition dropped
    the goal, they are planned anew, and its likelihood is 0. With actions, the vehicle drives
    these and then follows the road; if the last one is a stop, it stays there.

    Args:
        frame: of the decision.
        moment: of the decision.
        known: the beliefs of recognition about the vehicle.
        vehicle: its number; it is in the scene.
        goal: the kind of a goal, or its edge where several are of one kind; None leaves it open.
        actions: its first actions, in order; () leaves them open.
    """
    if moment.scene[vehicle].kind in ON_FOOT:
        return _on_foot(frame, moment, known, vehicle, goal, actions)
    prospect = _prospect(frame, moment, vehicle)
    goals = _goals(prospect, known)
    wanted = None if goal is None else _named(goals, goal)
    if isinstance(wanted, Refusal):
        return wanted
    if actions:
        return _acting(prospect, known, goals, wanted, actions)
    assert wanted is not None
    kept = _belief_in(known, wanted)
    if kept is not None:
        return replace(kept, probability=1.0)
    ways = trajectories_to(
        prospect.task, prospect.starts, wanted, prospect.observed, prospect.others, frame.settings
    )
    return Belief(wanted, 0.0, 1.0, ways) if ways else Refusal(f"no way leads to {wanted.place}")


def _on_foot(
    frame: Frame,
    moment: Moment,
    known: Sequence[Belief],
    vehicle: int,
    goal: str | None,
    actions: Sequence[Action],
) -> Belief | Refusal:
    """Return the belief about a person on foot, whose possible actions are the goals."""
    named = {*actions, *(() if goal is None else (goal,))}
    if len(named) != 1:
        return Refusal("people on foot are supposed to do one thing: cross, continue or stop")
    seen = {
        name: observed(name, moment.history[name], state) for name, state in moment.scene.items()
    }
    vehicles = [track for track in seen.values() if track.kind not in ON_FOOT]
    surroundings = Surroundings(frame.roads, moment.outlook, round(frame.settings.horizon / DT))
    going_on = [surroundings.on(track.kind).coast(track).usual for track in vehicles]
    beliefs = ways_of(surroundings, seen[vehicle], vehicles, going_on, frame.settings)
    wanted = _named([belief.goal for belief in beliefs], named.pop())
    if isinstance(wanted, Refusal):
        return wanted
    kept = _belief_in(known, wanted)
    found = next(belief for belief in beliefs if belief.goal == wanted)
    return replace(found, likelihood=0.0 if kept is None else kept.likelihood)


def _prospect(frame: Frame, moment: Moment, vehicle: int) -> _Prospect:
    seen = {
        name: observed(name, moment.history[name], state) for name, state in moment.scene.items()
    }
    one = seen[vehicle]
    surroundings = Surroundings(frame.roads, moment.outlook, round(frame.settings.horizon / DT))
    own = surroundings.on(one.kind)
    view = frame.settings.view_radius
    nowhere = EgoGoal("", 0.0, None)
    task = Task(
        own.roads, nowhere, (one.length, one.width), moment.time, own.steps, view, yielding=True
    )
    coasting = tuple(
        surroundings.on(other.kind).coast(other) for name, other in seen.items() if name != vehicle
    )
    starts = one.situation(own.roads, -1, moment.time)
    return _Prospect(task, one, starts, Others(own, coasting))


def _goals(prospect: _Prospect, known: Sequence[Belief]) -> tuple[Goal, ...]:
    """Return all goals that the vehicle may have, however improbable."""
    if not prospect.starts:
        return tuple(belief.goal for belief in known)
    return goals_in_view(prospect.task.roads, prospect.starts, prospect.task.view)


def _named(goals: Sequence[Goal], name: str) -> Goal | Refusal:
    """Return the goal of a kind, or at an edge."""
    found = [goal for goal in goals if name in (goal.kind, edge_of(goal))]
    if not found and name in STRAIGHT:
        found = [goal for goal in goals if goal.kind in STRAIGHT]
    if len(found) == 1:
        return found[0]
    if found:
        edges = ", ".join(str(edge_of(goal)) for goal in found)
        return Refusal(f"several of its goals are {name}; name the edge: {edges}")
    kinds = ", ".join(goal.kind for goal in goals)
    return Refusal(f"{name} is none of its goals; these are {kinds}")


def _belief_in(known: Sequence[Belief], goal: Goal) -> Belief | None:
    wanted = (goal.kind, edge_of(goal))
    return next((b for b in known if (b.goal.kind, edge_of(b.goal)) == wanted), None)


def edge_of(goal: Goal) -> str | None:
    """Return the edge of a goal; None for stopping."""
    return None if goal.target is None else goal.target.edge


def _acting(
    prospect: _Prospect,
    known: Sequence[Belief],
    goals: Sequence[Goal],
    wanted: Goal | None,
    actions: Sequence[Action],
) -> Belief | Refusal:
    """Return the belief that a vehicle takes certain actions, whichever goal they lead to."""
    legs = _driven_freely(prospect, actions, prospect.others.usual)
    if isinstance(legs, Refusal):
        return legs
    reached = _reached(prospect, goals, legs)
    if wanted is not None and wanted not in reached:
        return Refusal(f"{', '.join(actions)} does not lead to {wanted.place}")
    goal = wanted or reached[-1]
    kept = _belief_in(known, goal)
    start = prospect.task.start
    motions = prospect.others.surroundings.motions(lambda k: _moving(prospect, actions, legs, k))
    stretches, stops = held_up(legs, start), held_by_lights(legs, start)
    way = Trajectory(1.0, tuple(actions), motions, stretches, stops)
    return Belief(goal, 0.0 if kept is None else kept.likelihood, 1.0, (way,))


def _moving(
    prospect: _Prospect, actions: Sequence[Action], usual: list[Leg], courses: tuple[int, ...]
) -> Obstacle:
    """Return the motion of a vehicle with certain actions if lights take certain courses."""
    traffic, legs = prospect.others.under(courses), usual
    if courses != prospect.others.surroundings.outlook.usual:
        driven = _driven_freely(prospect, actions, traffic)
        legs = usual if isinstance(driven, Refusal) else driven
    motion = motion_along(prospect.task, legs, prospect.observed, traffic)
    return _standing(motion, legs[-1]) if actions[-1] == "stop" else motion


def _driven_freely(
    prospect: _Prospect, actions: Sequence[Action], others: Traffic
) -> list[Leg] | Refusal:
    """Return the legs of actions in turn; without the others if these coast into the vehicle."""
    legs = _driven(prospect, actions, others)
    if not isinstance(legs, Refusal) and legs[-1].outcome == "collision":
        return _driven(prospect, actions, replace(NOBODY, lights=others.lights))
    return legs


def _driven(prospect: _Prospect, actions: Sequence[Action], others: Traffic) -> list[Leg] | Refusal:
    """Return the legs of actions in turn, from the first lane on which all of them apply."""
    tried = [_legs(prospect.task, start, actions, others) for start in prospect.starts]
    driven = (legs for legs in tried if not isinstance(legs, Refusal))
    return next(driven, tried[0] if tried else Refusal("it is on no lane"))


def _legs(
    task: Task, here: Situation, actions: Sequence[Action], others: Traffic
) -> list[Leg] | Refusal:
    """Return the legs of actions in turn, up to the horizon or a collision."""
    legs: list[Leg] = []
    first = 0
    for action in actions:
        plan = expand(task.roads, here, action, None, task.view)
        if isinstance(plan, Refusal):
            return Refusal(f"{action} does not apply: {plan.reason}")
        leg = take(task, plan, Motion(0.0, here.speed, here.acceleration), first, others)
        if bool(np.max(leg.speed**2 * np.abs(leg.curvature)) >= GRIP):
            return Refusal(f"{action} does not apply: it is too fast for the bend")
        legs.append(leg)
        here, first = leg.end, leg.first + len(leg.speed) - 1
        if leg.outcome in ("collision", "termination"):
            break
    return legs


def _reached(prospect: _Prospect, goals: Sequence[Goal], legs: Sequence[Leg]) -> tuple[Goal, ...]:
    """Return the goals driven to, last the one that stands for the whole; at least one.

    If no goal in view was reached, return the road taken.
    """
    lanes, last = prospect.task.roads.network.lanes, legs[-1]
    edges = [lanes[lane].edge for leg in legs for lane in leg.lanes]
    passed = [goal for goal in goals if edge_of(goal) in edges]
    passed.sort(key=lambda goal: edges.index(str(edge_of(goal))))
    if last.action == "stop":
        standing = [goal for goal in goals if goal.target is None]
        return (*passed, *(standing or [Goal("stop", PLACES["stop"], None, 1.0)]))
    end = EgoGoal(edges[-1], round(last.end.location.offset, 2), None)
    taken = Goal(last.action, PLACES.get(last.action, "the road ahead"), end, 1.0)
    return tuple(passed) or (taken,)


def _standing(motion: Obstacle, last: Leg) -> Obstacle:
    """Return the motion with a final stop where a leg ended."""
    end = last.first + len(last.speed) - 1
    position, heading, speed = motion.position.copy(), motion.heading.copy(), motion.speed.copy()
    position[end:], heading[end:], speed[end:] = last.position[-1], last.heading[-1], 0.0
    return replace(motion, position=position, heading=heading, speed=speed)
