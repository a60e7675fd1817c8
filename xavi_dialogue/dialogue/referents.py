"""Which vehicle a description means, and how a vehicle is described.

A question names a vehicle by its number, or describes it ("vehicle:front", "vehicle:truck",
"vehicle:it"). Descriptions are resolved against the scenes that the question may be about, the
likeliest first: the first scene in which anything fits decides.
"""

import tomllib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Literal, TypeAlias

from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.explain.bearings import (
    Place,
    Vehicles,
    bearing,
    nearest_at,
    nearest_first,
    place,
)
from xavi_dialogue.language.context import VehicleWords

PREFIX = "vehicle:"


@dataclass(frozen=True, slots=True)
class Scope:
    """What a description may refer to."""

    scenes: tuple[Vehicles, ...]  # the likeliest first
    topic: int | None  # the vehicle that was spoken of last


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
    search = _SEARCHES.get(description) or _related(description)
    if search is None:
        return None
    for scene in scope.scenes:
        found = search(scene, scope.topic)
        if found:
            return tuple(sorted(found))
    return ()


def _at(*places: Place) -> _Search:
    return lambda scene, _: nearest_at(scene, places)


def _of_kind(*kinds: str) -> _Search:
    return lambda scene, _: tuple(n for n, v in scene.items() if n != EGO and v.kind in kinds)


def _of_colour(*colours: str) -> _Search:
    return lambda scene, _: tuple(n for n, v in scene.items() if n != EGO and v.colour in colours)


def _ahead(scene: Vehicles, _: int | None) -> tuple[int, ...]:
    """On our line; failing that, what goes our way further to the side."""
    return nearest_at(scene, ("ahead",)) or nearest_at(scene, ("ahead-left", "ahead-right"))


def _behind(scene: Vehicles, _: int | None) -> tuple[int, ...]:
    return nearest_at(scene, ("behind",)) or nearest_at(scene, ("behind-left", "behind-right"))


def _topic(scene: Vehicles, topic: int | None) -> tuple[int, ...]:
    """What was spoken of last; failing that, the only other vehicle there is."""
    if topic is not None:
        return (topic,) if topic in scene else ()
    return _others(scene, None)


def _others(scene: Vehicles, topic: int | None) -> tuple[int, ...]:
    return tuple(name for name in scene if name not in (EGO, topic))


def _parked(scene: Vehicles, _: int | None) -> tuple[int, ...]:
    return tuple(n for n, state in scene.items() if n != EGO and state.speed < 0.1)


def _from(side: Literal["left", "right"]) -> _Search:
    """What comes across our way from a side; failing that, what is on that side."""
    crossing: Place = "crossing-left" if side == "left" else "crossing-right"
    return lambda scene, _: nearest_at(scene, (crossing,)) or _SEARCHES[side](scene, None)


def _related(description: str) -> _Search | None:
    """What is next before or behind another vehicle: "front-1", "behind-1"; it may be our car."""
    side, _, other = description.rpartition("-")
    if side not in ("front", "behind") or not other.isdecimal():
        return None
    name, wanted = int(other), "ahead" if side == "front" else "behind"

    def search(scene: Vehicles, _: int | None) -> tuple[int, ...]:
        if name not in scene:
            return ()
        seen = ((n, bearing(scene[name], state)) for n, state in scene.items() if n != name)
        fits = [(where.distance, n) for n, where in seen if place(where) == wanted]
        return tuple(n for _, n in sorted(fits))[:1]

    return search


def _nearest(scene: Vehicles, _: int | None) -> tuple[int, ...]:
    return tuple(name for name, _ in nearest_first(scene))[:1]


_SEARCHES: Mapping[str, _Search] = {
    "nearest": _nearest,
    "from-left": _from("left"),
    "from-right": _from("right"),
    "front": _ahead,
    "behind": _behind,
    "left": _at("beside-left", "ahead-left", "behind-left", "crossing-left"),
    "right": _at("beside-right", "ahead-right", "behind-right", "crossing-right"),
    "beside": _at("beside-left", "beside-right"),
    "oncoming": _at("oncoming"),
    "parked": _parked,
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
