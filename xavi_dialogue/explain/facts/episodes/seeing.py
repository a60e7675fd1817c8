"""Episodes of seeing: who came into view or was lost from it, and which indicators showed."""

from collections.abc import Iterator

from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.vocabulary import Side
from xavi_dialogue.explain.facts.actions import named
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.motion import EPSILON


def sights(states: States, vehicle: int) -> list[Episode]:
    """Return when a vehicle came into view, and when it was lost from view."""
    if vehicle == EGO:
        return []
    here, ours = named(vehicle), named(EGO)
    found: list[Episode] = []
    for begin, end in _views(states, vehicle):
        if begin > states.begin + EPSILON:
            found.append(Episode(here, "appear", begin, begin, ours))
        if end is not None:
            found.append(Episode(here, "disappear", end, end, ours))
    return found


def _views(states: States, vehicle: int) -> Iterator[tuple[float, float | None]]:
    """Yield the stretches [s] in which a vehicle was in view; the last may go on."""
    hidden = states.seen(vehicle).hidden
    parts = states.motion(vehicle).parts()
    for number, part in enumerate(parts):
        begin, last = part.time[0], part.time[-1]
        for since, until in hidden:
            if begin - EPSILON <= since <= last + EPSILON:
                if since > begin + EPSILON:
                    yield begin, since
                begin = until
        if begin < last - EPSILON:
            going_on = number + 1 == len(parts) and states.known(vehicle, states.ride.now)
            with_us = states.ride.ended and last >= states.motion(EGO).time[-1] - EPSILON
            yield begin, None if going_on or with_us else last


def signals(states: States, vehicle: int) -> list[Episode]:
    """Return when a vehicle showed an indicator."""
    found = []
    changes = states.seen(vehicle).lights
    motion = states.motion(vehicle)
    last = motion.time[-1] if motion.time else states.ride.now
    for side in ("left", "right"):
        begin: float | None = None
        for change in changes:
            if side in change.shown and begin is None:
                begin = change.time
            elif side not in change.shown and begin is not None:
                found.append(_signal(vehicle, side, begin, change.time))
                begin = None
        if begin is not None:
            going_on = states.visible(vehicle, states.ride.now) and not states.ride.ended
            found.append(_signal(vehicle, side, begin, None if going_on else last))
    return found


def _signal(vehicle: int, side: str, begin: float, end: float | None) -> Episode:
    to: Side = "left" if side == "left" else "right"
    return Episode(named(vehicle), "signal", begin, end, side=to)
