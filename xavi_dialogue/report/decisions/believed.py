"""What was believed of those involved, and how it moved."""

from collections.abc import Sequence

from planner.record.trace import Action, PlanTrace
from xavi_dialogue.report.content import BeliefPoint, Beliefs, GoalBelief
from xavi_dialogue.report.decisions.expected import expected_speeds
from xavi_dialogue.report.ridden import Inquiry, Ridden, predicted
from xavi_dialogue.report.road_users.parties import of_trace
from xavi_dialogue.report.road_users.tracks import Tracks

LEAST = 0.01  # probability that a goal reaches somewhere in the window to be listed

Name = tuple[Action, str | None]  # of a goal: its kind and its edge


def beliefs(
    inquiry: Inquiry,
    tracks: Tracks,
    vehicle: int,
    window: tuple[float, float],
    examined: Sequence[PlanTrace],
) -> Beliefs:
    """Return the goals that the decisions of a window [s] ascribed to a road user.

    Args:
        inquiry: the record.
        tracks: where everybody was.
        vehicle: the road user.
        window: [s] begin and end.
        examined: the decisions of which the speeds that they expected are told, too.
    """
    ridden = inquiry.ridden
    points: dict[Name, list[BeliefPoint]] = {}
    places: dict[Name, str] = {}
    without = []
    for trace in ridden.between(*window):
        found = predicted(trace, vehicle)
        if found is None:
            without += [trace.decision] if vehicle in trace.scene else []
            continue
        at, known = found
        for k, goal in enumerate(known.goals):
            source = of_trace(trace, f"predictions[{at}].goals[{k}].probability")
            name = (goal.kind, goal.edge)
            places.setdefault(name, goal.place)
            point = BeliefPoint(trace.sim_time, goal.probability, source)
            points.setdefault(name, []).append(point)
    listed = {name: row for name, row in points.items() if _most(row) >= LEAST}
    taken = _taken(ridden, vehicle, listed)
    crossed = _crossed(inquiry, vehicle, window[0])
    ranked = sorted(listed.items(), key=lambda item: (-_most(item[1]), item[0][0]))
    goals = tuple(
        GoalBelief(
            kind=kind,
            place=places[kind, edge],
            edge=edge,
            points=tuple(row),
            came=crossed if kind == "cross" else _came(edge, row, taken, listed),
        )
        for (kind, edge), row in ranked
    )
    speeds = expected_speeds(examined, tracks, vehicle)
    return Beliefs(vehicle, goals, tuple(without), speeds)


def _came(
    edge: str | None,
    row: list[BeliefPoint],
    taken: set[str],
    listed: dict[Name, list[BeliefPoint]],
) -> bool | None:
    """Check whether a road was taken; it was not, where another was that was open as well.

    None if neither was seen: what was expected after one junction is open until the next.
    """
    if edge is None or edge in taken:
        return None if edge is None else True
    times = {point.time for point in row}
    others = (points for (_, other), points in listed.items() if other in taken)
    return False if any(not times.isdisjoint(p.time for p in points) for points in others) else None


def _most(row: list[BeliefPoint]) -> float:
    return max(point.probability for point in row)


def _taken(ridden: Ridden, vehicle: int, listed: dict[Name, list[BeliefPoint]]) -> set[str]:
    """Return those edges of goals that a road user drove on later, in the whole record."""
    begin = min((row[0].time for row in listed.values()), default=0.0)
    edges = {edge for _, edge in listed if edge is not None}
    here: str | None = None
    taken: set[str] = set()
    for trace in ridden.between(begin, ridden.end):
        place = None if trace.road is None else trace.road.places.get(vehicle)
        if place is None or place.in_junction:  # it is not on the road yet that it leads to
            continue
        here = here or place.edge
        if place.edge != here and place.edge in edges:
            taken.add(place.edge)
    return taken


def _crossed(inquiry: Inquiry, vehicle: int, since: float) -> bool | None:
    """Check whether somebody on foot was seen to cross the car's way from a time [s] on.

    None if not: it may have crossed later, or out of sight.
    """
    seen = inquiry.world.episodes((vehicle,), ("cross",), since, inquiry.ridden.end)
    return True if any(episode.action == "cross" for episode in seen) else None
