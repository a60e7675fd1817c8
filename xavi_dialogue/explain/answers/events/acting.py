"""Acting: what somebody is doing at a moment, and how its speed changes."""

from sim.scene import EGO
from xavi_dialogue.domain.answers import Activity
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.naming import look_of, number
from xavi_dialogue.explain.history.motion import Trend
from xavi_dialogue.explain.history.thresholds import STANDING

CHANGING = 0.1  # [m/s2] minimum acceleration of a changing speed


def activity(asked: Asked, actor: Ego | Vehicle, at: float) -> Activity:
    """Return what somebody is doing at a time [s], how fast, and what it is expected to do."""
    world = asked.world
    on = world.episodes(actor=actor, begin=at - 0.3, end=at + 0.1)
    if not on and isinstance(actor, Ego):
        on = world.episodes(actor=actor, actions=("continue",), begin=at, end=at)
    speed = world.measure("speed", actor, at)
    if speed.value is not None and speed.value < STANDING:  # to drive past is over
        on = tuple(e for e in on if e.action not in ("pass", "overtake"))
    vehicle = number(actor)
    trend = _trend(asked, EGO if vehicle is None else vehicle, at)
    look = look_of(asked, actor, at)
    belief = None if vehicle is None else world.belief(vehicle, at)
    lost = look is not None and not look.in_view
    return Activity(
        actor, at, () if lost else on, None if lost else speed.value,
        None if lost else trend, look, belief,
    )  # fmt: skip


def _trend(asked: Asked, vehicle: int, at: float) -> Trend | None:
    """Return how a speed is changing at a time [s]; the newest scene ends a change at once."""
    trend, scene = asked.ride.motion(vehicle).until(at).trend, asked.ride.scene
    seen = None if scene is None or at < scene.time else scene.vehicles.get(vehicle)
    if seen is None or trend not in ("slowing", "speeding-up"):
        return trend
    rate = seen.acceleration if trend == "speeding-up" else -seen.acceleration
    return trend if rate > CHANGING else "steady"
