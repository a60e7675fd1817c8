"""Events with traffic lights: one shows a colour or turns to it; somebody passes or waits at it."""

from collections.abc import Iterator

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Feature
from xavi_dialogue.domain.traffic_lights import COLOURS
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.facts.actions import covered
from xavi_dialogue.explain.facts.episodes import happening
from xavi_dialogue.explain.facts.episodes.light_waits import holding
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.facts.traffic_lights import SAID, light_in, meant
from xavi_dialogue.explain.history.ride import ROUNDING
from xavi_dialogue.explain.history.traffic_lights import passings, stretches

SHOWING = frozenset[ActionName](("show", "turn-colour"))
PASSING = frozenset[ActionName](("pass", "cross", "enter", "leave"))
HELD = frozenset[ActionName](
    ("wait", "stop", "stand", "brake", "slow-down", "give-way", "block", "follow")
)
JUST = 1.0  # [s] tolerance of the time that is asked about


def light_of(event: Event) -> Feature | None:
    """Find the traffic light that an event is about."""
    where = None if event.where is None else event.where.to
    return light_in(event.actor, event.object, where)


def light_episodes(
    states: States, event: Event, begin: float, end: float
) -> tuple[Episode, ...] | None:
    """Return the episodes in an interval [s] that an event describes; None if it has no light."""
    light = light_of(event) or _lined(states, event)
    if light is None:
        return None
    if event.action in SHOWING:
        return tuple(_showing(states, event, light, begin, end))
    if event.action in PASSING and isinstance(event.actor, Ego):
        return tuple(_passing(states, light, begin, end))
    if event.action in HELD:
        return tuple(_held(states, event, begin, end))
    return ()


def _lined(states: States, event: Event) -> Feature | None:
    """Find the light whose line we passed, if the event is that we passed a line."""
    line = event.object == Feature("line") or (
        event.where is not None and event.where.to == Feature("line")
    )
    passed = event.action in PASSING and isinstance(event.actor, Ego) and line
    return Feature("light") if passed and passings(states.ride) else None


def _showing(
    states: States, event: Event, light: Feature, begin: float, end: float
) -> Iterator[Episode]:
    ride = states.ride
    signal = meant(ride, light, min(end, ride.now))
    wanted = SAID.get(getattr(event.object, "colour", None) or "")
    for one in () if signal is None else stretches(ride, signal):
        colour = COLOURS.get(one.state, "off")
        if wanted is not None and colour != wanted:
            continue
        until = one.end if one.changed else None
        of = Feature("light", of=light.of)
        what = Feature("light", colour=colour)
        if event.action == "turn-colour":
            if one.begun and begin - JUST <= one.begin <= end + ROUNDING:
                yield Episode(of, "turn-colour", one.begin, one.begin, what)
        elif one.begin <= end + ROUNDING and (until is None or until >= begin - ROUNDING):
            yield Episode(of, "show", one.begin, until, what)


def _passing(states: States, light: Feature, begin: float, end: float) -> Iterator[Episode]:
    wanted = SAID.get(light.colour or "")
    for one in passings(states.ride):
        colour = None if one.shown is None else COLOURS.get(one.shown.state, "off")
        if wanted is not None and colour != wanted:
            continue
        if begin - JUST <= one.time <= end + JUST:
            what = Feature("light", colour=colour)
            yield Episode(
                Ego(), "pass", one.time, one.time, what, speed_from=one.speed, speed_to=one.speed
            )


def _held(states: States, event: Event, begin: float, end: float) -> Iterator[Episode]:
    """Yield what a vehicle does for a light: standing or braking while the light holds it."""
    actors = happening.actors_of(states, event)
    ride = states.ride
    for one in happening.happening(states, actors, covered(frozenset((event.action,)))):
        until = ride.now if one.end is None else one.end
        vehicle = getattr(one.actor, "number", 0)
        mine = one.object is None or light_in(one.object) is not None
        meets = until >= begin - ROUNDING and one.begin <= end + ROUNDING
        if mine and meets and holding(ride, vehicle, one.begin, until) is not None:
            yield one
