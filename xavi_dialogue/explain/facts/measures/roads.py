"""Measures of the road: lane, lanes, right of way, exits, the route."""

from msgspec.structs import replace

from planner.record.places import RouteStep
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.terms import Junction
from xavi_dialogue.explain.facts.episodes.ways import ways
from xavi_dialogue.explain.facts.measures.asked import Asked
from xavi_dialogue.explain.history.nearing import still_to
from xavi_dialogue.explain.history.traffic_lights import rule_at


def lane(asked: Asked) -> Measure:
    """Return the number of the lane, 1 the rightmost; `count`: how many lanes there are."""
    place = asked.states.place(asked.vehicle, asked.time)
    if place is None:
        return asked.none("not-recorded")
    if place.lane is None:
        return replace(asked.none("not-applicable"), count=place.lanes)
    number = place.lane + 1
    word = "only" if place.lanes == 1 else "right" if number == 1 else None
    word = "left" if number == place.lanes > 1 else word
    word = "middle" if word is None and 2 * number == place.lanes + 1 else word
    found = replace(asked.found(float(number), word), count=place.lanes)
    return replace(found, side=word) if word in ("left", "right") else found


def lane_count(asked: Asked) -> Measure:
    """Return how many lanes there are in the direction of the vehicle."""
    place = asked.states.place(asked.vehicle, asked.time)
    return asked.none("not-recorded") if place is None else asked.found(float(place.lanes))


def right_of_way(asked: Asked) -> Measure:
    """Return whether the ego or another goes first; alone, the rule at the next junction.

    `rule` is that for `thing`: priority, give-way, equal, depends. `word` names who goes first.
    """
    road = asked.states.road(asked.at)
    if road is None:
        return asked.none("not-recorded")
    vehicle = asked.vehicle if asked.vehicle != EGO else asked.other
    if vehicle is None or vehicle == EGO:
        step = _next(asked)
        return asked.none("not-applicable") if step is None else _ruled(asked, step)
    who = next((fact.who for fact in road.priority if fact.vehicle == vehicle), None)
    if who is None:
        return asked.none("not-applicable")
    first = (who == "ego") == (asked.vehicle == EGO)
    rule = "depends" if who == "depends" else "priority" if first else "give-way"
    return replace(asked.found(None, who), rule=rule)


def _ruled(asked: Asked, step: RouteStep) -> Measure:
    left = max(still_to(asked.states.ride, step.distance, asked.at), 0.0)
    road = asked.states.road(asked.at)
    rule = step.rule if road is None else rule_at(road, step)
    return replace(asked.found(left, rule), rule=rule)


def _next(asked: Asked) -> RouteStep | None:
    """Return the step of the route that is asked about; the next one unless another is named."""
    road = asked.states.road(asked.at)
    places = [p for p in (asked.thing, asked.to) if isinstance(p, Junction)]
    steps = [] if road is None else list(road.route)
    if places and places[0].form == "roundabout":
        steps = [s for s in steps if s.kind == "roundabout"]
    rank = 1 if not places or places[0].rank is None else places[0].rank
    return steps[rank - 1] if 0 < rank <= len(steps) else None


def exit_number(asked: Asked) -> Measure:
    """Return the number of the exit that the ego takes at the roundabout ahead, or took last.

    `count`: how many exits there are; None if the roundabout is behind the ego.
    """
    road = asked.states.road(asked.at)
    if road is None:
        return asked.none("not-recorded")
    left = [e for e in _rings(asked) if e.begin <= asked.at]
    place = asked.states.place(EGO, asked.at)
    inside = left and left[-1].action == "enter"
    step = next((s for s in road.route if s.kind == "roundabout" and s.exit is not None), None)
    if left and left[-1].exit is not None and (inside or step is None):
        found = asked.found(float(left[-1].exit), None, asked.at if inside else left[-1].begin)
        count = step.exits if step is not None and place and place.roundabout else None
        return replace(found, count=count)
    if step is None or step.exit is None:
        return asked.none("not-applicable")
    return replace(asked.found(float(step.exit)), count=step.exits, side=None)


def _rings(asked: Asked) -> list[Episode]:
    """Return the episodes of entering and of leaving roundabouts, in order."""
    return [e for e in ways(asked.states, EGO) if e.action in ("enter", "leave")]


def route(asked: Asked) -> Measure:
    """Return how many junctions are on the way to the destination; `World.road` lists them."""
    road = asked.states.road(asked.at)
    return asked.none("not-recorded") if road is None else asked.found(float(len(road.route)))
