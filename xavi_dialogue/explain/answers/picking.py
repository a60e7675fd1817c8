"""Picking: which of several vehicles is meant, by how it is set apart from the others."""

from collections.abc import Callable

from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.terms import Described, Thing, Vehicle
from xavi_dialogue.explain.answers.asked import Asked

LATELY = 10.0  # [s] for which one that was lost from view may still be around


def extreme_of(thing: Thing, seen: tuple[Look, ...]) -> tuple[Look, ...]:
    """Keep the nearest, fastest, biggest of them, where the description wants one."""
    wanted = thing.extreme if isinstance(thing, Described) else None
    if wanted is None or not seen:
        return seen
    keys: dict[str, Callable[[Look], float]] = {
        "nearest": lambda look: look.distance,
        "farthest": lambda look: -look.distance,
        "fastest": lambda look: -look.speed,
        "slowest": lambda look: look.speed,
        "biggest": lambda look: -look.length,
    }
    return (min(seen, key=keys[wanted]),)


def lately_lost(asked: Asked, look: Look) -> bool:
    """Tell whether a vehicle is hidden, or was lost a short while ago."""
    if look.in_view or look.seen is None:
        return False
    shown = asked.world.measure("visibility", Vehicle(look.vehicle), asked.now)
    return shown.word == "hidden" or look.seen >= asked.now - LATELY
