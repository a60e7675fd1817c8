"""Observations of traffic lights: every change of a controller that was in view."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from planner.record.light_record import UNSEEN, Showing


@dataclass(frozen=True, slots=True)
class Watched:
    """The observations of one controller: every change, the last one being its present state."""

    controller: str
    places: tuple[int, ...]
    seen: tuple[Showing, ...]


def watch(
    before: Watched | None, controller: str, shown: Mapping[int, str], time: float, most: int
) -> Watched:
    """Return the observations of a controller, with a new one.

    Args:
        before: earlier observations.
        controller: its name.
        shown: the letters of the places that are in view.
        time: [s] of the new observation.
        most: maximum number of changes that are kept.
    """
    known: Sequence[int] = () if before is None else before.places
    places = tuple(sorted({*known, *shown}))
    seen: list[Showing] = []
    for showing in () if before is None else before.seen:
        had = dict(zip(known, showing.states, strict=True))
        states = "".join(had.get(place, UNSEEN) for place in places)
        seen.append(Showing(showing.time, states))
    states = "".join(shown.get(place, UNSEEN) for place in places)
    if not seen or seen[-1].states != states:
        seen.append(Showing(round(time, 3), states))
    return Watched(controller, places, tuple(seen[-most:]))


def phases(seen: Sequence[Showing]) -> tuple[Showing, ...]:
    """Return the changes since the controller came into view, except for places coming in view."""
    found: list[Showing] = []
    before = ""
    for showing in seen:
        if all(letter == UNSEEN for letter in showing.states):
            found = []
        elif not found or not alike(before, showing.states):
            found.append(showing)
        else:
            found[-1] = Showing(found[-1].time, _completed(showing.states, found[-1].states))
        before = showing.states
    return tuple(found)


def _completed(states: str, before: str) -> str:
    """Return a state with the places out of view as they were seen before."""
    pairs = zip(states, before, strict=True)
    return "".join(was if now == UNSEEN else now for now, was in pairs)


def alike(one: str, other: str) -> bool:
    """Check whether two states agree at all places seen in both, and at least one was."""
    pairs = [(a, b) for a, b in zip(one, other, strict=True) if UNSEEN not in (a, b)]
    return bool(pairs) and all(a == b for a, b in pairs)
