"""Which vehicle a description means, and how a vehicle is described.

A question names a vehicle by its number, or describes it ("vehicle:front", "vehicle:truck",
"vehicle:it"). Descriptions are resolved against the scenes that the question may be about, the
likeliest first: the first scene in which anything fits decides. Where somebody is ("in front")
holds for a moment only, so that such a description counts in the scenes of that moment alone.
"""

import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TypeAlias

from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.explain.bearings import Vehicles, nearest_first, place
from xavi_dialogue.explain.whereabouts import is_place, who_is
from xavi_dialogue.language.context import VehicleWords

PREFIX = "vehicle:"


@dataclass(frozen=True, slots=True)
class Scope:
    """What a description may refer to."""

    scenes: tuple[Vehicles, ...]  # the likeliest first
    topic: int | None  # the vehicle that was spoken of last
    moments: tuple[Vehicles, ...] | None = None  # the same of where somebody is; None: alike


_Search: TypeAlias = Callable[[Vehicles, int | None], tuple[int, ...]]


def described(actor: str) -> str | None:
    """The description in "vehicle:front"; None for the ego and for numbers."""
    tail = actor.removeprefix(PREFIX)
    return None if tail == actor or tail.isdecimal() else tail


def candidates(description: str, scope: Scope) -> tuple[int, ...] | None:
    """The vehicles that fit a description, lowest name first.

    Returns:
        None for what is no description of a vehicle in view, such as "unknown" or "both".
    """
    if is_place(description):
        moments = scope.scenes if scope.moments is None else scope.moments
        return next(filter(None, (who_is(description, scene) for scene in moments)), ())
    search = _SEARCHES.get(description)
    if search is None:
        return None
    found = (search(scene, scope.topic) for scene in scope.scenes)
    return tuple(sorted(next(filter(None, found), ())))


def _of_kind(*kinds: str) -> _Search:
    return lambda scene, _: tuple(n for n, v in scene.items() if n != EGO and v.kind in kinds)


def _of_colour(*colours: str) -> _Search:
    return lambda scene, _: tuple(n for n, v in scene.items() if n != EGO and v.colour in colours)


def _topic(scene: Vehicles, topic: int | None) -> tuple[int, ...]:
    """What was spoken of last; failing that, the only other vehicle there is."""
    if topic is not None:
        return (topic,) if topic in scene else ()
    return _others(scene, None)


def _others(scene: Vehicles, topic: int | None) -> tuple[int, ...]:
    return tuple(name for name in scene if name not in (EGO, topic))


_SEARCHES: Mapping[str, _Search] = {
    "it": _topic,
    "that": _topic,
    "other": _others,
    **{kind: _of_kind(kind) for kind in ("truck", "bus", "motorcycle", "bicycle")},
    **{
        colour: _of_colour(colour)
        for colour in ("blue", "red", "green", "white", "black", "yellow", "orange", "brown")
    },
    "grey": _of_colour("grey", "silver"),
    "silver": _of_colour("grey", "silver"),
}


def vehicle_words(scene: Vehicles) -> dict[int, VehicleWords]:
    """How each vehicle may be spoken of; a description belongs to the nearest that it fits."""
    phrases, kinds = _lexicon()
    words: dict[int, VehicleWords] = {}
    taken: set[str] = set()
    for name, seen in nearest_first(scene):
        kind = scene[name].kind
        phrase = phrases[place(seen)].format(kinds.get(kind, kinds["car"]))
        description = None if phrase in taken else phrase
        taken.add(phrase)
        words[name] = VehicleWords("truck" if kind == "truck" else "car", description)
    return dict(sorted(words.items()))


def scenes_of(traces: Iterable[PlanTrace]) -> tuple[Vehicles, ...]:
    """The scenes of the traces, each once, in their order."""
    return tuple({trace.decision: trace.scene for trace in traces}.values())


@cache
def _lexicon() -> tuple[Mapping[str, str], Mapping[str, str]]:
    text = files("grammars").joinpath("scene.toml").read_text(encoding="utf-8")
    data = tomllib.loads(text)
    return data["place"], data["kind"]
