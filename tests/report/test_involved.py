"""Who is involved for being close, and which of the roads that were expected was taken."""

from dataclasses import dataclass, field
from typing import Any

from xavi_dialogue.report.content import BeliefPoint
from xavi_dialogue.report.decisions import believed
from xavi_dialogue.report.figures import Source
from xavi_dialogue.report.road_users import parties

SOURCE = Source("decision", "predictions", 1, 1.0)


@dataclass
class Stated:
    """A world and tracks in one: how far from the car others are [m]."""

    gaps: dict[int, float | None] = field(default_factory=dict)

    @property
    def world(self) -> "Stated":
        return self

    @property
    def vehicles(self) -> tuple[int, ...]:
        return tuple(self.gaps)

    def gap(self, vehicle: int, time: float) -> float | None:
        return self.gaps[vehicle]


def test_who_is_close_at_the_moment_is_involved() -> None:
    stated: Any = Stated({1: 1.1, 2: 2.0, 3: None, 4: 0.0})
    assert list(parties._beside(stated, stated, 46.2)) == [1, 4]


def _row(*times: float) -> list[BeliefPoint]:
    return [BeliefPoint(time, 0.5, SOURCE) for time in times]


def test_a_road_was_not_taken_where_another_was_that_was_open_as_well() -> None:
    on, off, next_ = ("continue", "west"), ("exit-right", "north"), ("continue", "far")
    listed: Any = {on: _row(1.0, 2.0), off: _row(1.0), next_: _row(3.0)}
    came = {name: believed._came(name[1], listed[name], {"west"}, listed) for name in listed}
    assert came == {on: True, off: False, next_: None}
    assert believed._came(None, listed[on], {"west"}, listed) is None
    assert believed._came("west", listed[on], set(), listed) is None
