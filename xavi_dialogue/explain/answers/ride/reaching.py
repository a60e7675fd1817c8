"""Reaching: when we come to a junction, or draw level with a vehicle, at the present speeds."""

from xavi_dialogue.domain.answers import Answer, Measures
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Event, Junction, Vehicle
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.ride.places import junction

TO_PLACES = frozenset(("arrive", "enter", "approach", "head", "come"))
PASSING = frozenset(("overtake", "pass"))
CRAWLING = 1.5  # [m/s] speed below which no time can be estimated
CLOSING = 0.5  # [m/s] minimum difference in speed to draw level
BESIDE = 2.0  # [m] minimum sideways distance at which one is not behind a vehicle


def reaching(asked: Asked, event: Event) -> Answer | None:
    """Return when we come to a place or pass a vehicle; None if that cannot be estimated."""
    if not is_us(event.actor):
        return None
    if event.action in TO_PLACES and isinstance(event.object, Junction):
        far = junction(asked, event.object, asked.now)
        speed = asked.world.measure("speed", Ego(), asked.now).value or 0.0
        if far.value is None or speed < CRAWLING:
            return None if far.value is None else Measures((far,))
        return _in(asked, far.value / speed, event.object)
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


def _in(asked: Asked, seconds: float, to: Junction | Vehicle) -> Measures:
    return Measures((Measure("time-to-go", Ego(), asked.now, value=seconds, to=to),))
