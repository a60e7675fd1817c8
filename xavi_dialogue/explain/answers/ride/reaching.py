"""Reaching: when we come to a junction, or draw level with a vehicle, at the speeds of now."""

from xavi_dialogue.domain.answers import Answer, Measures
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Event, Junction, Vehicle
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.ride.places import junction

TO_PLACES = frozenset(("arrive", "enter", "approach", "head", "come"))
PASSING = frozenset(("overtake", "pass"))
CRAWLING = 1.5  # [m/s] below which the speed of now tells nothing of the time to come
CLOSING = 0.5  # [m/s] by which one must be faster to draw level
BESIDE = 2.0  # [m] to the side from which one is not behind a vehicle


def reaching(asked: Asked, event: Event) -> Answer | None:
    """Tell when we come to a place or pass a vehicle; None where that cannot be reckoned."""
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
