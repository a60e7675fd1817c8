"""Measures of how somebody drives: speed, limit, acceleration, jerk, comfort, lights."""

from msgspec.structs import replace

from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.explain.facts.measures.asked import Asked
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.thresholds import SMOOTHED


def speed(asked: Asked) -> Measure:
    """Return the speed, with the limit as `reference`."""
    state = asked.states.state(asked.vehicle, asked.at)
    if state is None:
        return asked.none("out-of-view")
    return replace(asked.found(round(state.speed, 2)), reference=limit_at(asked))


def limit(asked: Asked) -> Measure:
    """Return the speed limit where the vehicle is."""
    value = limit_at(asked)
    return asked.none("not-recorded") if value is None else asked.found(value)


def limit_at(asked: Asked) -> float | None:
    """Return the limit [m/s] in force for a vehicle; None if it is not recorded."""
    place = asked.states.place(asked.vehicle, asked.time)
    return None if place is None else place.limit


def excess(asked: Asked) -> Measure:
    """Return by how much the speed is over the limit; negative: under it."""
    state, allowed = asked.states.state(asked.vehicle, asked.at), limit_at(asked)
    if state is None or allowed is None:
        return asked.none("not-recorded")
    return replace(asked.found(round(state.speed - allowed, 2)), reference=allowed)


def acceleration(asked: Asked) -> Measure:
    """Return how the speed changes."""
    motion = asked.states.motion(asked.vehicle)
    k = motion.index(asked.at)
    return asked.none("out-of-view") if k is None else asked.found(round(motion.rate[k], 2))


def deceleration(asked: Asked) -> Measure:
    """Return how hard a vehicle brakes; 0 if it does not."""
    found = acceleration(asked)
    return found if found.value is None else replace(found, value=max(-found.value, 0.0))


def jerk(asked: Asked) -> Measure:
    """Return how fast the acceleration changes."""
    value = jerk_at(asked.states, asked.vehicle, asked.at)
    return asked.none("not-recorded") if value is None else asked.found(round(value, 2))


def jerk_at(states: States, vehicle: int, time: float) -> float | None:
    """Return the jerk [m/s3] over SMOOTHED seconds around a time; positive: it accelerates more."""
    motion = states.motion(vehicle)
    last = motion.time[-1] if motion.time else time
    end = min(time + SMOOTHED / 2.0, last)
    before, after = motion.index(end - SMOOTHED), motion.index(end)
    if before is None or after is None or after <= before:
        return None
    span = motion.time[after] - motion.time[before]
    return (motion.rate[after] - motion.rate[before]) / span if span < 2.0 * SMOOTHED else None


def indicator(asked: Asked) -> Measure:
    """Return which indicator is on."""
    shown = asked.states.lights(asked.vehicle, asked.at)
    if shown is None:
        return asked.none("not-recorded")
    sides = tuple(light for light in shown if light in ("left", "right"))
    word = "both" if len(sides) == 2 else sides[0] if sides else "none"
    return replace(asked.found(None, word), lights=sides)


def brake_lights(asked: Asked) -> Measure:
    """Return "on" or "off" for the brake lights."""
    shown = asked.states.lights(asked.vehicle, asked.at)
    if shown is None:
        return asked.none("not-recorded")
    lit = tuple(light for light in shown if light == "brake")
    return replace(asked.found(None, "on" if lit else "off"), lights=lit)
