"""Which way: "change lanes" names no side, and the record knows which one is meant."""

from collections.abc import Callable

from msgspec.structs import replace

from xavi_dialogue.explain.deeds import happened
from xavi_dialogue.explain.motion import foresees
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import Ride, planned, prediction
from xavi_dialogue.explain.vehicles import vehicle_of

MIRRORED: dict[QueryAction, QueryAction] = {
    "change-left": "change-right",
    "change-right": "change-left",
    "exit-left": "exit-right",
    "exit-right": "exit-left",
}


def directed(query: Query, ride: Ride) -> Query:
    """The query with the side on which it happened, where the question names none.

    What is only asked about keeps its side: nothing in the record tells which one is meant.
    """
    if query.underspecified != "direction":
        return query
    known = _known(query, ride)

    def turned(actions: tuple[QueryAction, ...] | None) -> tuple[QueryAction, ...] | None:
        return None if actions is None else tuple(_turn(action, known) for action in actions)

    foil = turned(query.counterfactual) if query.negated else query.counterfactual
    return replace(query, factual=turned(query.factual), counterfactual=foil)


def _turn(action: QueryAction, known: Callable[[QueryAction], bool]) -> QueryAction:
    other = MIRRORED.get(action)
    return other if other is not None and known(other) and not known(action) else action


def _known(query: Query, ride: Ride) -> Callable[[QueryAction], bool]:
    """Tells whether the one asked about did an action, or is expected to."""
    vehicle = vehicle_of(query)
    if vehicle is None or vehicle == 0:
        plan = planned(ride.latest)
        return lambda action: happened(ride, action) is not None or action in plan
    motion = ride.motion(vehicle)
    expected = prediction(ride.latest, vehicle)
    ways = [way for goal in expected.goals for way in goal.trajectories] if expected else []
    if query.tense == "future":
        return lambda action: any(foresees(way, action) for way in ways)
    return lambda action: motion.last(action) is not None
