"""Passages: exits passed, time on junctions, and the slowing down that belongs to them."""

from typing import Any

import msgspec
import pytest

from planner.record.places import RoadFacts
from tests.explain.answers.given import Given, deed, place, plan, step
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Feature, Junction, Vehicle
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.ride import passages
from xavi_dialogue.explain.facts.episodes.lead_in import held_since


def slowed(begin: float, end: float | None, action: str = "brake") -> Episode:
    """Make a deed of ours that slows us down, from and to a time [s]."""
    return Episode(Ego(), action, begin, end)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("episodes", "since"),
    [
        ((), 20.0),
        ((slowed(14.0, 18.0),), 14.0),
        ((slowed(14.0, 16.9),), 20.0),  # more than three seconds before we entered
        ((slowed(14.0, 17.0),), 14.0),
        ((slowed(8.0, 12.0), slowed(16.0, 18.0, "stop")), 8.0),  # four seconds between two halts
        ((slowed(8.0, 11.9), slowed(16.0, 18.0, "stop")), 16.0),
        ((slowed(14.0, None, "wait"),), 14.0),
        ((slowed(14.0, 18.0, "speed-up"),), 20.0),
        ((slowed(21.0, 22.0),), 20.0),  # on the junction, and not before it
    ],
)
def test_slowing_down_before_a_junction_belongs_to_it(
    episodes: tuple[Episode, ...], since: float
) -> None:
    assert held_since(episodes, 20.0) == since


RING = Junction("roundabout")


def counted(
    deeds: tuple[Episode, ...], exits: dict[float, int | None], actor: object = None
) -> Any:
    """Count the exits passed at 20 s, with decisions at which so many were left to ours."""
    traces = []
    for time, left in exits.items():
        route = () if left is None else (step(kind="roundabout", exit=left, exits=4),)
        traces.append(msgspec.structs.replace(plan(time), road=RoadFacts({0: place()}, route)))
    asked = Given(deeds=deeds, traces=tuple(traces)).asked()
    event = Event("pass", actor or Ego(), Feature("exit"), tense="past")  # type: ignore[arg-type]
    return passages.exits_passed(event, asked)


def test_exits_that_we_went_past_are_those_before_ours() -> None:
    entered, left = deed("enter", 8.0, 9.0, to=RING), deed("leave", 15.0, 16.0, to=RING)
    other = deed("enter", 3.0, 4.0, to=Junction("junction"))
    over = counted((other, entered, left), {4.0: 3, 12.0: 1})
    assert (over.count, over.since, over.until, over.of.tense) == (2, 8.0, 15.0, "past")
    on_it = counted((entered,), {4.0: 3, 18.0: 1})
    assert (on_it.count, on_it.since, on_it.until, on_it.of.tense) == (2, 8.0, None, "perfect")
    before = counted((), {18.0: 2})
    assert (before.count, before.of.tense) == (0, "perfect")


def test_exits_are_counted_of_a_roundabout_that_we_were_on() -> None:
    entered = deed("enter", 8.0, 9.0, to=RING)
    for deeds, exits, actor in (
        ((), {18.0: None}, None),
        ((deed("enter", 8.0, 9.0, to=Junction("junction")),), {18.0: None}, None),
        ((entered,), {4.0: 2, 18.0: 1}, Vehicle(1)),
        ((entered,), {4.0: None, 18.0: None}, None),  # which exit is ours is not known
    ):
        with pytest.raises(Unanswered):
            counted(deeds, exits, actor)
