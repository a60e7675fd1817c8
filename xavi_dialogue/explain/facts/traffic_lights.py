"""Traffic lights as facts: which one is meant, what it showed, and how it was to change."""

from collections.abc import Iterator, Sequence

import numpy as np

from planner.record.light_record import LightPrediction
from planner.record.trace import PlanTrace
from planner.traffic_lights.cycles import BRAKING, REACTION
from sim.scene import EGO, Signal
from xavi_dialogue.domain.terms import Feature, Vehicle
from xavi_dialogue.domain.traffic_lights import (
    COLOURS,
    TURNING,
    YIELDING,
    Crossed,
    Foreseen,
    LightColour,
    LightOdds,
    Shown,
)
from xavi_dialogue.explain.facts.episodes.light_waits import facing
from xavi_dialogue.explain.history.nearing import driven, speed_at
from xavi_dialogue.explain.history.ride import ROUNDING, Ride
from xavi_dialogue.explain.history.thresholds import STALE
from xavi_dialogue.explain.history.traffic_lights import (
    Passing,
    Stretch,
    ahead,
    passings,
    shown,
    stretches,
)

SAID: dict[str, LightColour] = {
    "red": "red", "green": "green", "amber": "amber", "yellow": "amber", "orange": "amber",
    "gold": "amber",
}  # fmt: skip
AROUND = 1.0  # [s] around our passing of a line in which its light is meant
BEHIND = 20.0  # [s] for which a light that we passed is still meant


def light_in(*things: object) -> Feature | None:
    """Find the first traffic light among some things."""
    return next((t for t in things if isinstance(t, Feature) and t.kind == "light"), None)


def colour_of(light: Feature | None) -> LightColour | None:
    """Return the colour that a question gives a light."""
    return None if light is None or light.colour is None else SAID.get(light.colour)


def meant(ride: Ride, light: Feature, time: float) -> Signal | None:
    """Find which light is meant at a time [s]; None if none was in view, or none is known.

    Ours is the next one on our way, or the one whose line we pass; if there is none ahead, the one
    that we passed last. For another vehicle, it is the light that holds it. For several, it is
    not known.
    """
    time = time if light.time is None else light.time
    if light.of is not None:
        one = light.of.number if isinstance(light.of, Vehicle) else None
        return None if one is None else facing(ride, one, time)
    done = [one for one in passings(ride) if one.time <= time + AROUND]
    near = [Signal(one.controller, one.place) for one in ahead(ride, time)]
    if light.rank is not None and light.rank > 0:
        return near[light.rank - 1] if len(near) >= light.rank else None
    if light.rank is not None and light.rank < 0:  # "the last", "the last but one"
        return done[light.rank].signal if len(done) >= -light.rank else None
    back = [one for one in done if time - one.time <= BEHIND]
    if done and abs(time - done[-1].time) <= AROUND:
        return done[-1].signal
    wanted = colour_of(light)
    such = [s for s in near if wanted is not None and colour_at(ride, s, time) == wanted]
    found = such[:1] or near[:1] or [one.signal for one in back[-1:]]
    return next(iter(found), None)


def colour_at(ride: Ride, signal: Signal, time: float) -> LightColour | None:
    """Return the colour that a light showed at a time [s]; None if it was not seen then."""
    one = shown(ride, signal, time)
    return None if one is None else COLOURS.get(one.state)


def green_around(ride: Ride, time: float) -> bool | None:
    """Check whether another light of the junction of ours was green; None if none was in view."""
    ours, trace = meant(ride, Feature("light"), time), ride.at(time)
    known = None if ours is None or trace is None else _prediction(trace, ours)
    if known is None or ours is None:
        return None
    others = (Signal(known.controller, place) for place in known.places if place != ours.index)
    seen = {colour_at(ride, one, time) for one in others} - {None}
    return "green" in seen if seen else None


def told(ride: Ride, signal: Signal, one: Stretch, light: Feature) -> Shown:
    """Return what a light showed over a stretch, as a value of answers."""
    goes_on = not one.changed and one.end >= ride.now - STALE
    known = stretches(ride, signal)
    later = [other for other in known if other.begin >= one.end - ROUNDING and other is not one]
    after = COLOURS.get(later[0].state) if one.changed and later else None
    return Shown(
        Feature("light", of=light.of),
        COLOURS.get(one.state, "off"),
        one.begin,
        one.begun,
        None if goes_on else one.end,
        one.changed,
        one.state == YIELDING,
        one.state == TURNING,
        after,
    )


def shown_at(ride: Ride, light: Feature, time: float) -> Shown | None:
    """Return what the light that is meant showed at a time [s]; None if that was not seen."""
    signal = meant(ride, light, time)
    one = None if signal is None else shown(ride, signal, min(time, ride.now))
    return None if signal is None or one is None else told(ride, signal, one, light)


def crossed(ride: Ride, one: Passing) -> Crossed:
    """Return how we passed a line: when, how fast, at which colour, and whether it was too late."""
    light = Feature("light")
    seen = None if one.shown is None else told(ride, one.signal, one.shown, light)
    since = None if one.shown is None else one.time - one.shown.begin
    late = one.shown is not None and one.shown.begun and _too_late(ride, one.shown.begin, one.time)
    return Crossed(one.time, one.speed, seen, since, late)


def _too_late(ride: Ride, begin: float, time: float) -> bool:
    """Check whether at `begin` [s] the ego was too close to the line that it passed at `time`."""
    speed = speed_at(ride, begin)
    far = driven(ride.motion(EGO), begin, time)
    return speed is not None and far < speed * REACTION + speed * speed / (2.0 * BRAKING)


def foreseen(
    ride: Ride, signal: Signal, time: float, to: LightColour | None = None
) -> Foreseen | None:
    """Return when a light was expected to change, at the last decision up to a time [s].

    Args:
        ride: the record.
        signal: the light.
        time: [s] the time whose expectation is asked about.
        to: the colour that it changes to; None: whatever comes next.

    Returns:
        The expectation; None if the light was not in view, shows that already, or is not expected
        to change.
    """
    trace = ride.at(time)
    known = None if trace is None else _prediction(trace, signal)
    now = None if trace is None else shown(ride, signal, trace.sim_time)
    if trace is None or known is None or now is None:
        return None
    colour = COLOURS.get(now.state, "off")
    to = to or next(_next(known, signal, trace.sim_time, colour), None)
    if to is None or to == colour:
        return None
    within = sorted(_turns(known, signal, trace, to))
    cycle = _repeats(stretches(ride, signal), now, trace.sim_time)
    spread = cycle or len(known.courses) > 1  # one course of the prior has no range
    chance = min(sum(share for _, share in within), 1.0)
    sure = chance >= 1.0 - ROUNDING
    came = [s.begin for s in stretches(ride, signal) if COLOURS.get(s.state) == to and s.begun]
    return Foreseen(
        told(ride, signal, now, Feature("light")),
        trace.sim_time,
        to,
        chance,
        trace.settings.horizon,
        _middle(within),
        within[0][0] if within and spread else None,
        within[-1][0] if within and spread and sure else None,
        cycle,
        next((at for at in came if at > trace.sim_time + ROUNDING), None),
    )


def _prediction(trace: PlanTrace, signal: Signal) -> LightPrediction | None:
    known = (one for one in trace.lights if one.controller == signal.controller)
    return next((one for one in known if signal.index in one.places), None)


def _next(
    known: LightPrediction, signal: Signal, time: float, colour: LightColour
) -> Iterator[LightColour]:
    """Yield the colours that a light may show next, by course, the likeliest first."""
    at = known.places.index(signal.index)
    for course in sorted(known.courses, key=lambda c: -c.probability):
        for change in course.showings:
            found = COLOURS.get(change.states[at])
            if change.time > time + ROUNDING and found is not None and found != colour:
                yield found
                break


def _turns(
    known: LightPrediction, signal: Signal, trace: PlanTrace, to: LightColour
) -> Iterator[tuple[float, float]]:
    """Yield when [s] a light turns to a colour in each course within the horizon, and its share."""
    at, end = known.places.index(signal.index), trace.sim_time + trace.settings.horizon
    for course in known.courses:
        for change in course.showings:
            later = trace.sim_time + ROUNDING < change.time <= end
            if later and COLOURS.get(change.states[at]) == to:
                yield change.time, course.probability
                break


def odds_of(ride: Ride, signal: Signal, by: float, colour: LightColour) -> LightOdds | None:
    """Return how likely a light has turned to a colour by a time [s], or still shows it then.

    None if it was not in view, only one course was expected of it, or none reaches that far.
    """
    trace = ride.at(ride.now)
    known = None if trace is None else _prediction(trace, signal)
    now = None if trace is None else shown(ride, signal, trace.sim_time)
    if trace is None or known is None or now is None:
        return None
    if len(known.courses) == 1 or by > trace.sim_time + trace.settings.horizon:
        return None
    stays = COLOURS.get(now.state) == colour
    to = next(_next(known, signal, trace.sim_time, colour), None) if stays else colour
    within = [] if to is None else sorted(_turns(known, signal, trace, to))
    turned = _cumulated(within, by, trace.sim_time, trace.sim_time + trace.settings.horizon)
    return LightOdds(colour, by, 1.0 - turned if stays else turned, stays)


def _cumulated(times: Sequence[tuple[float, float]], by: float, now: float, end: float) -> float:
    """Return the probability that something happens by a time [s].

    Args:
        times: when [s] it happens in each course that reaches it, in order, and its share.
        by, now, end: the time, that of the decision, and the end of the courses, [s].

    A course stands for all times around its own, so half of its share lies before it. One with
    most of the probability is a cycle that was seen, and stands for itself.
    """
    if any(share > 0.5 for _, share in times):
        return min(sum(share for time, share in times if time <= by + ROUNDING), 1.0)
    points, mass = [(now, 0.0)], 0.0
    for time, share in times:
        points.append((time, mass + 0.5 * share))
        mass += share
    last, before = points[-1][0], points[-2][0] if times else now
    points.append((min(2.0 * last - before, end), mass))
    return float(np.interp(by, [time for time, _ in points], [share for _, share in points]))


def _middle(times: Sequence[tuple[float, float]]) -> float | None:
    """Return the time [s] at which the summed probability reaches one half; None: never."""
    mass = 0.0
    for time, share in times:
        mass += share
        if mass >= 0.5 - ROUNDING:
            return time
    return None


def _repeats(known: Sequence[Stretch], now: Stretch, time: float) -> bool:
    """Check whether the light was seen to show the same before, from beginning to end."""
    before = [one for one in known if one.end <= time + ROUNDING and one is not now]
    return any(one.state == now.state and one.begun and one.changed for one in before)
