"""Episodes that only the ego has: arriving, colliding, changing its plan, bearing to a side."""

import itertools
from collections.abc import Iterator

from planner.record.places import RoadFacts
from planner.record.trace import Action, PlanTrace
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Destination
from xavi_dialogue.domain.vocabulary import Side
from xavi_dialogue.explain.facts.actions import named
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.motion import EPSILON, bends
from xavi_dialogue.explain.history.nearing import driven
from xavi_dialogue.explain.history.ride import planned

TURNS: tuple[Action, ...] = ("exit-left", "exit-right", "exit-straight", "continue-next-exit")
ALONG: tuple[Action, ...] = ("continue", "exit-straight", "stop")  # by which the ego keeps its lane
AROUND = 1.0  # [s] around another action in which bearing to a side is part of that
SAME_JUNCTION = 6.0  # [m] maximum difference of the distances to one junction at two decisions


def told(states: States) -> Iterator[Episode]:
    """Yield the arrival of the ego and its collisions, by its events."""
    for event in states.ride.events:
        time = event.sim_time
        if event.kind == "arrived":
            yield Episode(named(EGO), "arrive", time, time, Destination())
        elif event.kind == "collided":
            other = None if event.vehicle is None else named(event.vehicle)
            yield Episode(named(EGO), "collide", time, time, other)


def struck(states: States, vehicle: int) -> list[Episode]:
    """Return the collisions of the ego with a vehicle as those of that vehicle with the ego."""
    return [
        Episode(named(vehicle), "collide", event.sim_time, event.sim_time, named(EGO))
        for event in states.ride.events
        if event.kind == "collided" and event.vehicle == vehicle
    ]


def driving_on(states: States) -> Iterator[Episode]:
    """Yield the stretches in which the ego just drove on."""
    for deed in states.ride.deeds:
        if deed.action == "continue":
            yield Episode(named(EGO), "continue", deed.time, deed.ended)


def bearing(states: States) -> Iterator[Episode]:
    """Yield the stretches in which the ego bore to one side, in no turn and no change of lanes."""
    others = [deed.span for deed in states.ride.deeds if deed.action not in ALONG]
    for bend in bends(states.motion(EGO)):
        if not any(a - AROUND <= bend.end and bend.start <= b + AROUND for a, b in others):
            side: Side = "left" if bend.angle > 0.0 else "right"
            yield Episode(named(EGO), "swerve", bend.start, bend.end, None, side)


def changed_plans(states: States) -> Iterator[Episode]:
    """Yield when the next action of the plan, besides driving on, was not the one before."""
    traces = states.ride.traces
    for before, after in itertools.pairwise(traces):
        if changed(states, before, after):
            yield Episode(named(EGO), "change-plan", after.sim_time, after.sim_time)


def changed(states: States, before: PlanTrace, after: PlanTrace) -> bool:
    """Check whether the plan of a decision begins differently from that of the one before it.

    This is another turn at a junction ahead, or another action besides turns. An action that began
    in between is no change, nor is a turn that comes within reach of the plan.
    """
    if before.road is not None and after.road is not None:
        way = driven(states.motion(EGO), before.sim_time, after.sim_time)
        if _turns_elsewhere(before.road, after.road, way):
            return True
        old, new = (tuple(a for a in _moves(t) if a not in TURNS) for t in (before, after))
    else:
        old, new = _moves(before), _moves(after)
    if before.under_way is not None and after.under_way is None:
        return False
    for deed in states.ride.deeds:
        begun = before.sim_time - EPSILON <= deed.started <= after.sim_time + EPSILON
        if begun and old[:1] == (deed.action,) and new[:1] != old[:1]:
            old = old[1:]
    if old:
        return old[:1] != new[:1]
    return bool(new) and new[0] not in TURNS


def _turns_elsewhere(before: RoadFacts, after: RoadFacts, way: float) -> bool:
    """Check whether two routes take different ways at the first junction that is on both."""
    if any(EGO in road.places and road.places[EGO].roundabout for road in (before, after)):
        return False
    for old in before.route:
        for new in after.route:
            same = old.kind == new.kind and old.arms == new.arms
            if same and abs(old.distance - way - new.distance) <= SAME_JUNCTION:
                return (old.turn, old.exit) != (new.turn, new.exit)
    return False


def _moves(trace: PlanTrace) -> tuple[Action, ...]:
    return tuple(action for action in planned(trace) if action != "continue")
