"""Measuring: the tables of the functions that compute each attribute."""

from collections.abc import Callable, Mapping
from typing import TypeAlias

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.facts import Gap, Measure
from xavi_dialogue.domain.terms import Thing
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.explain.facts.measures import between, driving, identity, roads, trip
from xavi_dialogue.explain.facts.measures.asked import Asked
from xavi_dialogue.explain.facts.plans import last_choice
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.ride import enough, planned

Worker: TypeAlias = Callable[[Asked], Measure]

delay = trip.delay


def _comfort(asked: Asked) -> Measure:
    """Return comfort as how hard a vehicle brakes."""
    return replace(driving.deceleration(asked), attribute="comfort")


def _value(asked: Asked) -> Measure:
    """Return the expected reward of what was chosen."""
    ride = asked.states.ride
    trace = last_choice(ride, asked.at)
    plan = () if trace is None else planned(trace)
    found = ride.model(trace).intervene(plan[:1]) if trace is not None and plan else None
    if found is None or not enough(found):
        return asked.none("not-recorded")
    return asked.found(found.value)


def _count(asked: Asked) -> Measure:
    """Return how many vehicles are in view."""
    return asked.found(float(len(asked.states.in_view(asked.at))))


#: Attributes for which the things must be known at the time asked about.
SEEN: Mapping[Attribute, Worker] = {
    "speed": driving.speed,
    "limit": driving.limit,
    "excess": driving.excess,
    "acceleration": driving.acceleration,
    "deceleration": driving.deceleration,
    "jerk": driving.jerk,
    "comfort": _comfort,
    "indicator": driving.indicator,
    "brake-lights": driving.brake_lights,
    "gap": between.gap,
    "headway": between.headway,
    "distance": between.distance,
    "time-to-collision": between.time_to_collision,
    "place": between.place,
    "lane": roads.lane,
    "lane-count": roads.lane_count,
    "right-of-way": roads.right_of_way,
}
#: Attributes that stay known once a thing was seen.
KNOWN: Mapping[Attribute, Worker] = {
    "colour": identity.colour,
    "kind": identity.kind,
    "size": identity.size,
    "name": identity.name,
    "origin": identity.origin,
    "heading": identity.heading,
    "visibility": identity.visibility,
    "turn": identity.turn,
    "exit-number": roads.exit_number,
    "route": roads.route,
    "distance-to-go": trip.distance_to_go,
    "distance-driven": trip.distance_driven,
    "time-to-go": trip.time_to_go,
    "arrival-time": trip.arrival_time,
    "time": trip.clock,
    "waiting-time": trip.waiting_time,
    "value": _value,
    "count": _count,
}
#: Those of them that are known only of the ego: we do not know where others want to go.
OURS: frozenset[Attribute] = frozenset(
    ("distance-to-go", "time-to-go", "arrival-time", "exit-number", "route", "value")
)
#: Attributes without a value here, and why: they need an event, or no record has them.
LACKING: Mapping[Attribute, Gap] = {
    "speed-change": "not-applicable",  # over a time or event
    "duration": "not-applicable",  # World.duration of an episode
    "delay": "not-applicable",  # World.delay of an episode
    "probability": "not-applicable",  # World.belief, World.probability
    "cost": "not-applicable",  # causes.options
    "simulations": "not-applicable",  # answers.measuring.simulations
    "options": "not-applicable",
    "weather": "not-sensed",
    "sound": "not-sensed",
    "battery": "not-sensed",
    "money": "not-recorded",
    "law": "not-recorded",
    "world": "not-sensed",
    "load": "not-sensed",
    "occupant": "not-sensed",
    "writing": "not-sensed",
    "parts": "not-sensed",
}


def measure(
    states: States, attribute: Attribute, thing: Thing, at: float, to: Thing | None
) -> Measure:
    """Return the value of an attribute at a time [s], or why it has none."""
    asked = Asked(states, attribute, thing, at, None if to == thing else to)
    if attribute in LACKING:
        return asked.none(LACKING[attribute])
    if at > states.ride.now + 1e-6:
        return asked.none("in-future")
    if attribute in OURS and asked.vehicle != EGO:
        return asked.none("others-thoughts")
    if attribute == "turn" and asked.vehicle != EGO:
        return replace(identity.heading(asked), attribute=attribute)
    if attribute in KNOWN:
        return KNOWN[attribute](asked)
    gap = asked.gap()
    if gap is not None:
        return asked.none(gap)
    return SEEN[attribute](asked)
