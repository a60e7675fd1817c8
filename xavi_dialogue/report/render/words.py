"""Words of reports: road users, actions, states, by `grammars/report.toml`."""

import tomllib
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib.resources import files

from planner.record.trace import ON_FOOT, Action
from sim.scene import EGO
from xavi_dialogue.dashboard.views.labels import deed, does, plan_words
from xavi_dialogue.report.content import Entry, Party
from xavi_dialogue.report.decisions.alternatives import Supposed
from xavi_dialogue.report.render.colours import colour
from xavi_dialogue.report.render.markup import Markup, joined, tag

OURS = "this car"


def phrase(kind: str, name: str) -> str:
    """Return a phrase of the table; the name itself where it has none."""
    return _table()[kind].get(name, name)


def restraint(one: Entry, whom: str) -> str:
    """Tell what keeps this car from driving faster; `whom` names the other in it."""
    by = phrase("restraint", one.what).format(whom)
    return f"{by.rstrip(',')}, and a traffic light" if one.lit else by


def seconds(time: float) -> str:
    """Return a time, with up to two decimals: "21.65 s"."""
    text = f"{time:.2f}"
    return f"{text[:-1] if text.endswith('0') else text} s"


class Names:
    """The names of road users in one report."""

    def __init__(self, involved: Sequence[Party]) -> None:
        """Names with the looks of those involved."""
        self._looks = {one.vehicle: _look(one) for one in involved}
        self._people = {one.vehicle: one.kind for one in involved if one.kind in ON_FOOT}
        self.order = tuple(self._looks)

    def of(self, vehicle: int | None) -> str:
        """Return a road user's name: "vehicle 1 (blue car)"."""
        if vehicle is None:
            return "somebody"
        if vehicle == EGO:
            return OURS
        look = self._looks.get(vehicle)
        if vehicle in self._people or not look:
            return self.short(vehicle)
        return f"{self.short(vehicle)} ({look})"

    def short(self, vehicle: int) -> str:
        """Return a road user's name without its look."""
        kind = self._people.get(vehicle, "vehicle")
        return OURS if vehicle == EGO else f"{kind} {vehicle}"

    def shown(self, vehicle: int) -> Markup:
        """Return a road user's name with its colour in the drawings."""
        fill = colour(vehicle, self.order)
        swatch = tag("span", class_="swatch", style=f"background:{fill}")
        return joined((swatch, capital(self.of(vehicle))))


def _look(party: Party) -> str:
    return " ".join(word for word in (party.colour, party.kind) if word)


def capital(text: str) -> str:
    """Return a text with a capital letter first."""
    return text[:1].upper() + text[1:]


def action_words(action: Action) -> str:
    """Return an action of this car: "turn left"."""
    return deed(action)


def chain(plan: Iterable[Action]) -> str:
    """Return a plan of this car: "move to the left lane, then turn left"."""
    return plan_words(plan)


def goal(kind: Action, place: str) -> str:
    """Return a goal of another: "turns left (the road to the left)"."""
    told = phrase("goal", kind) if kind in _table()["goal"] else does((kind,))
    return f"{told} ({place})" if place else told


def supposed_words(names: Names, one: Supposed) -> str:
    """Return what is supposed."""
    match one.kind:
        case "empty":
            return "without all others"
        case "absent":
            return f"without {names.of(one.vehicle)}"
        case "pair":
            return f"without both {' and '.join(map(names.of, one.pair))}"
        case "goal":
            return f"{names.of(one.vehicle)} surely {goal(one.goal or 'continue', one.place)}"
        case "light":
            return f"the light ahead stays {phrase('light', one.lights[0].state)}"
    return "with the hidden parts of the road in view, and nobody there"


def decisions_words(numbers: Sequence[int]) -> str:
    """Return decisions by their numbers: "decisions 3 to 5 and 8"."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][1] + 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    parts = [f"{a}" if a == b else f"{a} to {b}" for a, b in runs]
    told = ", ".join(parts[:-1]) + (" and " if len(parts) > 1 else "") + parts[-1]
    return f"decision{'s' * (len(numbers) > 1)} {told}"


@cache
def _table() -> Mapping[str, Mapping[str, str]]:
    return tomllib.loads(files("grammars").joinpath("report.toml").read_text(encoding="utf-8"))
