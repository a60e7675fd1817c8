"""Room: whether a lane beside us, or ours ahead, is free."""

from collections.abc import Iterable

from planner.record.places import RoadPlace
from sim.scene import EGO
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.journeys import LaneFits
from xavi_dialogue.domain.terms import Ego, Is, Lane, Vehicle
from xavi_dialogue.explain.answers.expectations.plans import steps
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, known, unknown
from xavi_dialogue.explain.answers.reference.moments import instant
from xavi_dialogue.explain.answers.reference.naming import looks
from xavi_dialogue.explain.answers.ride.onward import steps_ahead
from xavi_dialogue.explain.causes.driving.slowness import in_lane_ahead

FREE = (15.0, 30.0)  # [m] behind and ahead of us, where nobody is in a free lane
IN_FRONT = 40.0  # [m] within which somebody in our lane is in front of us
TOLD = 2  # of those in our way, the nearest


def free(of: Is, asked: Asked) -> Finding:
    """Weigh that there is room in a lane beside us, or that our road ahead is clear."""
    at = instant(asked, of.time, of.tense)
    if not isinstance(of.thing, Lane):
        return _clear(asked, at)
    lane = of.thing.which
    road = asked.world.road(at)
    seen = looks(asked, asked.world.in_view(at), at)
    if road is None or EGO not in road.places:
        return unknown("not-recorded")
    places = {look.vehicle: road.places.get(look.vehicle) for look in seen}
    own = road.places[EGO]
    wanted = _lane(own, lane)
    if wanted is None:
        return Finding(False, known(asked.world.measure("lane", Ego(), at)))
    there = [
        look
        for look in seen
        if _same_lane(places[look.vehicle], own, wanted)
        and -FREE[0] <= look.ahead <= FREE[1]
        and not look.oncoming
    ]
    nearest = sorted(there, key=lambda look: look.distance)
    return Finding(not there, tuple(nearest))


def in_our_way_ahead(asked: Asked, seen: Iterable[Look], at: float) -> list[Look]:
    """Keep those who are ahead of us in our lane at a time [s], or on foot right in front."""
    road = asked.world.road(at)
    places = {} if road is None else road.places
    edges = {v: place.edge for v, place in places.items()}
    ours = {
        look.vehicle
        for look in in_lane_ahead(asked.ride, asked.world, at, IN_FRONT)
        if edges.get(look.vehicle) == edges.get(EGO)  # and not beyond a junction
    }
    return [
        look
        for look in seen
        if look.vehicle in ours
        or (look.kind == "pedestrian" and look.bearing == "ahead" and look.distance <= FREE[1])
    ]


def lane_fits(asked: Asked) -> Finding:
    """Return which lane we are in, and whether our plan leaves it before we turn."""
    lane = asked.world.measure("lane", Ego(), asked.now)
    if lane.value is None and lane.word is None:
        return unknown(lane.gap or "not-recorded")
    changes = (a for a, _ in steps(asked) if a in ("change-left", "change-right"))
    turns = (s for s in steps_ahead(asked) if s.turn != "exit-straight")
    return Finding(None, answer=LaneFits(lane, next(changes, None), next(turns, None)))


def _clear(asked: Asked, at: float) -> Finding:
    """Weigh that nobody is close ahead of us on our way, and nobody holds us up."""
    if asked.world.road(at) is None:
        return unknown("not-recorded")
    there = [
        look
        for look in looks(asked, asked.world.in_view(at), at)
        if (_on_our_way(look) and look.distance <= FREE[1])
        or asked.world.relation("in-the-way-of", Vehicle(look.vehicle), Ego(), at)
    ]
    nearest = sorted(there, key=lambda look: look.distance)
    return Finding(not there, tuple(nearest[:TOLD]))


def _on_our_way(look: Look) -> bool:
    """Check whether somebody drives ahead of us, or is about to cross our way."""
    return (look.bearing == "ahead" and not look.oncoming) or (
        look.bearing.startswith("crossing") and look.ahead > 0.0 and look.speed > 0.0
    )


def _lane(own: RoadPlace, which: str) -> int | None:
    """Return the index of a lane, counted from the right; None if there is no such lane."""
    if own.lane is None:
        return None
    lanes = {
        "own": own.lane, "left": own.lane + 1, "right": own.lane - 1, "rightmost": 0,
        "leftmost": own.lanes - 1,
        "other": own.lane + 1 if own.lane + 1 < own.lanes else own.lane - 1,
    }  # fmt: skip
    found = lanes.get(which, own.lane)
    return found if 0 <= found < own.lanes else None


def _same_lane(place: RoadPlace | None, own: RoadPlace, lane: int) -> bool:
    return place is not None and place.edge == own.edge and place.lane == lane
