"""Lights read: what a question says about a traffic light, and which moment it is about."""

from sim.scene import Signal
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Proposition,
    Related,
    Unsaid,
)
from xavi_dialogue.domain.traffic_lights import LightColour, Shown
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import is_own, unwrapped
from xavi_dialogue.explain.facts.episodes.light_events import PASSING, SHOWING, light_of
from xavi_dialogue.explain.facts.traffic_lights import SAID, light_in, meant
from xavi_dialogue.explain.history.traffic_lights import Passing, ahead, passings

POSSIBLE = ("can", "could", "should", "would", "must")
GOING = frozenset(("go", "move", "continue", "exit-straight"))


def things(of: object) -> tuple[object, ...]:
    """Return the actor and the object of an event."""
    return (of.actor, of.object) if isinstance(of, Event) else ()


def of_showing(of: object) -> tuple[Feature, LightColour | None] | None:
    """Return the light that is said to show or turn to a colour, and the colour."""
    match of:
        case Has(attribute="colour", value=value, thing=Feature(kind="light") as light):
            return light, SAID.get(value)
    event = of.event if isinstance(of, Happens) else of
    if not isinstance(event, Event) or event.action not in SHOWING:
        return None
    found = light_of(event)
    return None if found is None else (found, SAID.get(_object_colour(event)))


def _object_colour(event: Event) -> str:
    return getattr(event.object, "colour", None) or ""


def passing(of: Proposition | None) -> Event | None:
    """Return the event of our passing a light."""
    inner, negated = unwrapped(of)
    if not isinstance(inner, Happens) or negated or not is_own(inner.event.actor):
        return None
    event = inner.event
    found = light_in(event.object, None if event.where is None else event.where.to)
    said = found is not None and event.action in PASSING | GOING
    return event if said and event.modal not in POSSIBLE else None


def may_pass(of: Proposition | None) -> bool:
    """Check whether a proposition is that we could or should pass a light."""
    inner, _ = unwrapped(of)
    if not isinstance(inner, Happens) or not is_own(inner.event.actor):
        return False
    event = inner.event
    passes = event.action in PASSING and light_in(event.object) is not None
    return passes and event.modal in POSSIBLE


def of_another(that: Proposition | None) -> bool:
    """Check whether a proposition is that another vehicle passed a light, which is not recorded."""
    of, _ = unwrapped(that)
    if not isinstance(of, Happens) or is_own(of.event.actor) or of.event.action not in PASSING:
        return False
    return light_in(of.event.object) is not None


def stated(that: Proposition | None) -> Proposition | None:
    """Return what is said about a light, if facts show whether it is so."""
    of, _ = unwrapped(that)
    match of:
        case Has() | Happens() if of_showing(of) is not None:
            return of
        case Exists(Feature(kind="light")) | Is(state="present", thing=Feature(kind="light")):
            return of
        case Related("can-see", Ego(), Feature(kind="light")):
            return of
    return of if passing(that) is not None else None


def alike(one: Shown, wanted: LightColour) -> bool:
    """Check whether a light showed a colour; red and amber together count as red."""
    return one.colour == wanted or (wanted == "red" and one.colour == "red-amber")


def moment(of: object, scene: Asked, light: Feature) -> tuple[float, bool]:
    """Return the moment [s] asked about, and whether it is in the past.

    In the past tense without a time, it is when we passed the line of the last light.
    """
    tense = getattr(of, "tense", None) or getattr(getattr(of, "event", None), "tense", "present")
    span = scene.past
    if span is not None and (span.said or tense in ("past", "perfect")):
        inside = within(scene, span.begin, span.end)
        if inside is not None:
            return inside.time, True
        time = span.end if span.begin < span.end else span.begin
        return time, time < scene.now - 1.0
    if light.time is not None:
        return light.time, light.time < scene.now - 1.0
    done = passings(scene.ride)
    if light.rank == -1 and done:
        return done[-1].time, True
    if tense == "past" and done and isinstance(getattr(of, "time", Unsaid()), Unsaid):
        return done[-1].time, True
    return scene.now, False


def within(scene: Asked, begin: float, end: float) -> Passing | None:
    """Find the last line that we passed between two times [s]."""
    found = [p for p in passings(scene.ride) if begin - 1.0 <= p.time <= end + 1.0]
    return found[-1] if found else None


def place(scene: Asked, light: Feature, time: float) -> dict[str, float | None]:
    """Return how far ahead of us a light is at a time [s], or when we passed it."""
    signal = meant(scene.ride, light, time)
    far = (x.distance for x in ahead(scene.ride, time) if _is(signal, x.controller, x.place))
    done = [p.time for p in passings(scene.ride) if p.signal == signal]
    return {"distance": next(far, None), "passed": done[-1] if done else None}


def _is(signal: Signal | None, controller: str, place: int) -> bool:
    return signal == Signal(controller, place)
