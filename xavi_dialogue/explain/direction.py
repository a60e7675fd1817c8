"""What a question leaves open and the record settles: which side is meant, and whether it is over.

"Change lanes" names no side; and "why did you not go straight on?" is about the present as long as
nothing was done yet but driving on.
"""

from collections.abc import Callable

from msgspec.structs import replace

from xavi_dialogue.explain.actions import STRAIGHT
from xavi_dialogue.explain.deeds import happened
from xavi_dialogue.explain.motion import foresees
from xavi_dialogue.explain.premise import TURNS
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import Ride, planned, prediction
from xavi_dialogue.explain.vehicles import matching, vehicle_of

MIRRORED: dict[QueryAction, QueryAction] = {
    "change-left": "change-right",
    "change-right": "change-left",
    "exit-left": "exit-right",
    "exit-right": "exit-left",
}


#: "Go left" may be either; which it was, is known from what was done.
KINDRED: dict[QueryAction, QueryAction] = {"exit-left": "change-left", "exit-right": "change-right"}
OPEN = {"direction": MIRRORED, "manoeuvre": KINDRED}  # by what a question leaves open


def directed(query: Query, ride: Ride) -> Query:
    """The query with the side and the manoeuvre that happened, in the tense of what is under way.

    A foil without a side is on the one that was taken; else, of the ego's, on the one on which it
    was possible.
    """
    query = _present(query, ride)
    others = OPEN.get(query.underspecified or "")
    if others is None:
        return query
    known = _known(query, ride)

    def turned(actions: tuple[QueryAction, ...] | None) -> tuple[QueryAction, ...] | None:
        return None if actions is None else tuple(_turn(a, known, others) for a in actions)

    factual, foil = turned(query.factual), query.counterfactual
    if query.negated or query.factual is None:
        foil = turned(foil)
        if foil == query.counterfactual and foil and _ours(query) and not query.negated:
            possible = _possible(ride)
            foil = tuple(_turn(a, possible, others) if not known(a) else a for a in foil)
    return replace(query, factual=factual, counterfactual=foil)


def _present(query: Query, ride: Ride) -> Query:
    """The query in the present, where it asks why not, and the ego has but driven on so far."""
    past = query.type == "why_not" and query.tense == "past" and _ours(query)
    if not past or query.factual or not query.counterfactual or ride.ended or ride.past:
        return query
    if query.counterfactual[0] in TURNS and query.counterfactual[0] in planned(ride.latest):
        return query  # it is not done yet
    deed = ride.manoeuvre
    if deed is not None and (deed.action != "continue" or query.counterfactual[0] not in STRAIGHT):
        return query
    return replace(query, tense="present")


def _ours(query: Query) -> bool:
    return vehicle_of(query) == 0 or query.actor == "ego"


def _possible(ride: Ride) -> Callable[[QueryAction], bool]:
    """Tells whether a decision of the ego had an action to choose from."""
    options = {a for t in ride.traces if t.under_way is None for a in ride.model(t).options()}
    return lambda action: action in options


def _turn(
    action: QueryAction,
    known: Callable[[QueryAction], bool],
    others: dict[QueryAction, QueryAction],
) -> QueryAction:
    other = others.get(action)
    return other if other is not None and known(other) and not known(action) else action


def _known(query: Query, ride: Ride) -> Callable[[QueryAction], bool]:
    """Tells whether the one asked about did an action, or is expected to.

    What another may do to either side, it is expected to do to the likelier one.
    """
    vehicle = vehicle_of(query)
    if vehicle is None or vehicle == 0:
        plan = planned(ride.latest)
        return lambda action: happened(ride, action) is not None or action in plan
    motion = ride.motion(vehicle)
    expected = prediction(ride.latest, vehicle)
    ways = [way for goal in expected.goals for way in goal.trajectories] if expected else []
    if query.tense == "future" and query.underspecified == "direction" and expected:
        model = ride.model(ride.latest)
        chances = model.choices(vehicle)

        def chance(action: QueryAction) -> float:
            return sum(chances[way] for way in matching(model, vehicle, (action,)))

        return lambda action: chance(action) > chance(MIRRORED.get(action, action))
    if query.tense == "future":
        return lambda action: any(foresees(way, action) for way in ways)
    return lambda action: motion.last(action) is not None
