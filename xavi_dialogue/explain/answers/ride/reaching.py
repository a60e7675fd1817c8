"""Reaching: whether our way leads to the destination, when we come to a place or pass a vehicle.

For places, that is by our plan, or at our present speed where its simulations do not come there;
for vehicles, at the present speeds.
"""

from xavi_dialogue.domain.answers import Answer, Measures, NotRecorded
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Where
from xavi_dialogue.domain.terms import Ego, Event, Feature, Junction, Vehicle
from xavi_dialogue.explain.answers.expectations.plans import covers
from xavi_dialogue.explain.answers.lights import lights_seen
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.ride.onward import course
from xavi_dialogue.explain.answers.ride.places import junction
from xavi_dialogue.explain.history.traffic_lights import ahead

TO_PLACES = frozenset(("arrive", "enter", "approach", "head", "come"))
PASSING = frozenset(("overtake", "pass"))
CRAWLING = 1.5  # [m/s] speed below which no time can be estimated
SLOWING = -0.5  # [m/s2] below which our speed now tells nothing of the time to a place
AT_PLACE = 3.0  # [m] up to which we are at a place
LIKELY = 0.5  # minimum share of the rollouts that come to a place
CLOSING = 0.5  # [m/s] minimum difference in speed to draw level
BESIDE = 2.0  # [m] minimum sideways distance at which one is not behind a vehicle


def reaching(asked: Asked, event: Event) -> Answer | None:
    """Return when we come to a place or pass a vehicle; None if that cannot be estimated."""
    if not is_us(event.actor):
        return None
    if isinstance(event.object, Junction) and event.action in TO_PLACES:
        return _at_place(asked, event.object, junction(asked, event.object, asked.now).value)
    if isinstance(event.object, Feature) and event.action in PASSING | TO_PLACES:
        return _at_feature(asked, event.object)
    vehicle = number(event.object)
    if event.action not in PASSING | TO_PLACES or vehicle is None:
        return None
    look = asked.world.look(vehicle, asked.now)
    speed = asked.world.measure("speed", Ego(), asked.now).value or 0.0
    if look is None or not look.in_view:
        return None
    if look.oncoming and look.ahead > 0.0:
        return _in(asked, look.ahead / max(speed + look.speed, CRAWLING), Vehicle(vehicle))
    if look.oncoming:
        return None
    closing = speed - look.speed
    if look.ahead <= 0.0 or closing < CLOSING or abs(look.left) < BESIDE:
        return None
    return _in(asked, look.ahead / closing, Vehicle(vehicle))


def _at_feature(asked: Asked, of: Feature) -> Answer | None:
    """Return when we come to a light or to a line; None for what else is on a road."""
    if of.kind not in ("light", "line") or of.of is not None:
        return None
    near, rank = ahead(asked.ride, asked.now), (of.rank or 1) - 1
    if 0 <= rank < len(near):
        return _at_place(asked, of, near[rank].distance)
    if of.kind == "light":
        return lights_seen.where(Where(of), asked)  # none is in view
    return _at_place(asked, of, junction(asked, Junction(rank=of.rank or 1), asked.now).value)


def _at_place(asked: Asked, place: Junction | Feature, distance: float | None) -> Answer | None:
    """Return when we come to a place a distance [m] ahead; how far it is if we slow down."""
    if distance is None:
        return None
    if distance <= AT_PLACE:
        return Measures((Measure("distance", Ego(), asked.now, value=distance, to=place),))
    there = covers(asked, distance - AT_PLACE)
    if there is not None and there.share >= LIKELY:
        return _in(asked, max(there.moment - asked.now, 0.0), place)
    speed = asked.world.measure("speed", Ego(), asked.now).value or 0.0
    pace = asked.world.measure("acceleration", Ego(), asked.now).value or 0.0
    if speed < CRAWLING or pace < SLOWING:
        return Measures((Measure("distance", Ego(), asked.now, value=distance, to=place),))
    return _in(asked, distance / speed, place)


def _in(asked: Asked, seconds: float, to: Junction | Feature | Vehicle) -> Measures:
    return Measures((Measure("time-to-go", Ego(), asked.now, value=seconds, to=to),))


def on_our_way(asked: Asked) -> Finding:
    """Weigh that we are on the way to our destination: whether a way leads there from here.

    Raises:
        Unanswered: the record does not hold our way.
    """
    road = asked.world.road(asked.now)
    if road is None:
        raise Unanswered(NotRecorded("not-recorded", about="route"))
    holds = asked.ride.arrived or road.distance is not None
    return Finding(holds, answer=course(asked, "bound", (), holds=holds))
