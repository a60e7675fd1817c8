"""Announced: what an indicator of another vehicle means, and how the vehicle got where it is.

An indicator announces a change of lanes or a turn to that side; who drives in front of the vehicle
is no reason for it. A vehicle got behind us or ahead because one let the other go, or passed it.
"""

from planner.record.trace import PlanTrace
from xavi_dialogue.domain.answers import SignalReason
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName, Relation, Side
from xavi_dialogue.explain.causes.vehicles.conduct import probability
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.ride import Ride, prediction

MEANT: dict[Side, tuple[ActionName, ...]] = {
    "left": ("change-left", "exit-left"),
    "right": ("change-right", "exit-right"),
}
LEAVING: tuple[ActionName, ...] = ("leave",)  # a roundabout, to the right
LATER = 15.0  # [s] after an indicator begins, in which what it announced may begin
EARLY = 1.0  # [s] before the indicator shows, in which that may have begun
THOUGHT = 0.1  # minimum probability of what is thought possible
JUNCTION = 100.0  # [m] from a junction within which a turn may be announced
#: What brings another vehicle behind us: done by it, and done by us.
LETTING = frozenset[ActionName](("give-way", "let-go"))
PASSING = frozenset[ActionName](("overtake", "cut-in", "pull-out"))


def announced(
    ride: Ride, world: World, vehicle: int, signal: Episode, time: float
) -> SignalReason | None:
    """Return what an indicator means, as believed up to a time [s]; None: side not known."""
    meant = MEANT.get(signal.side) if signal.side is not None else None
    if meant is None:
        return None
    road = world.road(signal.begin)
    place = None if road is None else road.places.get(vehicle)
    if place is not None and place.roundabout and signal.side == "right":
        meant = LEAVING
    done = world.episodes(Vehicle(vehicle), meant, signal.begin - EARLY, signal.begin + LATER)
    done = tuple(e for e in done if e.action in meant and e.begin >= signal.begin - EARLY)
    trace = ride.at(time if signal.end is None else min(time, signal.end), vehicle)
    chance, thought = None, set[ActionName]()
    if trace is not None and prediction(trace, vehicle) is not None:
        chance = probability(ride, trace, vehicle, meant)
        thought = {a for a in meant if probability(ride, trace, vehicle, (a,)) >= THOUGHT}
    possible = meant if meant == LEAVING else _possible(trace, vehicle, meant)
    aims = tuple(a for a in meant if a in thought or a in possible)
    return SignalReason(vehicle, signal, aims, chance, done[0] if done else None)


def _possible(
    trace: PlanTrace | None, vehicle: int, meant: tuple[ActionName, ...]
) -> tuple[ActionName, ...]:
    """Return which of the meanings, a change of lanes and a turn, the road allows there."""
    road = None if trace is None else trace.road
    place = None if road is None else road.places.get(vehicle)
    if road is None or place is None:
        return meant
    ahead = next(iter(road.route), None)
    turning = ahead is not None and ahead.distance <= JUNCTION
    ours = road.places.get(0)
    if ours is None or ours.edge != place.edge:
        turning = True  # the junctions on its way are not known
    lanes = place.lanes > 1
    return tuple(a for a, may in zip(meant, (lanes, turning or not lanes), strict=True) if may)


def meeting(world: World, vehicle: int, relation: Relation, time: float) -> Episode | None:
    """Find the last action that brought a vehicle behind us or in front of us."""
    if relation not in ("behind", "ahead-of"):
        return None
    theirs, ours = (LETTING, PASSING) if relation == "behind" else (PASSING, LETTING)
    found = [
        e
        for e in world.episodes(Vehicle(vehicle), tuple(theirs), end=time)
        if e.action in theirs and isinstance(e.object, Ego)
    ]
    found += [
        e
        for e in world.episodes(Ego(), tuple(ours), end=time)
        if e.action in ours and e.object == Vehicle(vehicle)
    ]
    return max(found, key=lambda e: e.begin, default=None)
