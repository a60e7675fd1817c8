"""Narration: short lines about what the car does, as it happens."""

import tomllib
from collections.abc import Iterable, Mapping
from functools import cache
from importlib.resources import files

from planner.record.events import Event
from planner.record.trace import Action

REMEMBERED = 10_000  # events


def narrate(event: Event) -> str | None:
    """Return a line such as "0:04 I change to the left lane."; None if an event has no line."""
    table = _table()
    phrase = table.get(event.kind, {}).get(event.action or "") or table["other"].get(event.kind)
    return None if phrase is None else f"{clock(event.sim_time)} {phrase.format(event.vehicle)}"


class Narrator:
    """A narrator of single events, which does not report the end of an action that never began."""

    def __init__(self) -> None:
        self._begun: Action | None = None

    def tell(self, event: Event) -> str | None:
        """Return the line for the next event, if any."""
        begun = self._begun
        if event.kind == "action-committed":
            self._begun = event.action
        elif event.kind == "action-ended":
            self._begun = None
            return narrate(event) if begun == event.action else None
        return narrate(event)


class RideNarrator:
    """A narrator that reports events once, even if the same ride is driven again from the start."""

    def __init__(self) -> None:
        self._narrator = Narrator()
        self._told: dict[int, Event] = {}  # by number

    def tell(self, number: int, event: Event) -> str | None:
        """Return the line for the event with a number in the ride, if any."""
        known = self._told.get(number)
        if known == event:
            return None
        if known is not None or len(self._told) >= REMEMBERED:  # it is another ride
            self._narrator = Narrator()
            self._told.clear()
        self._told[number] = event
        return self._narrator.tell(event)


def story(events: Iterable[Event]) -> str:
    """Return all that happened, one line for each event."""
    return "\n".join(line for line in map(Narrator().tell, events) if line is not None)


def clock(time: float) -> str:
    """Return a simulation time [s] as minutes and seconds."""
    minutes, seconds = divmod(int(time), 60)
    return f"{minutes}:{seconds:02d}"


def plan_in_words(plan: Iterable[Action]) -> str:
    """Return the plan in words, such as "change left, then go on"; "" without a plan."""
    phrases = _table()["plan"]
    return ", then ".join(phrases[action] for action in plan)


@cache
def _table() -> Mapping[str, Mapping[str, str]]:
    return tomllib.loads(files("grammars").joinpath("narration.toml").read_text(encoding="utf-8"))
