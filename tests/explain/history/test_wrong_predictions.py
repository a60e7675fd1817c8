"""Predictions that turned out wrong, by the roads on which others were seen."""

from types import SimpleNamespace as Made
from typing import Any

import pytest

from xavi_dialogue.explain.history.predicted_roads import turn_to, wrong_predictions


def seen(time: float, edge: str | None, *goals: tuple[str, str, float]) -> Any:
    """A decision with the road on which vehicle 1 is, and its goals: road, kind, probability."""
    places = {} if edge is None else {1: Made(edge=edge)}
    known = [Made(edge=e, kind=k, place=f"to {e}", probability=p) for e, k, p in goals]
    predictions = [Made(vehicle=1, goals=known)] if goals else []
    return Made(sim_time=time, road=Made(places=places), predictions=predictions)


LEFT, RIGHT = ("west", "exit-left", 0.7), ("east", "exit-right", 0.3)
CROSS = ("east", "cross", 0.9)


@pytest.mark.parametrize(
    ("goals", "edges", "wrong"),
    [
        ((LEFT, RIGHT), ("south", None, "east"), ("west", "east", 3.0)),
        ((LEFT, RIGHT), ("south", "south", "west"), None),
        ((LEFT, RIGHT), ("south", "south", "south"), None),  # still open
        ((LEFT, RIGHT), ("south", "north", "north"), None),  # on no road of a goal
        ((LEFT, RIGHT, RIGHT, RIGHT), ("south", "east", "east"), None),  # 0.9 in all
        ((LEFT, RIGHT, CROSS), ("south", "east", "east"), ("west", "east", 2.0)),
        ((), ("south", "east", "east"), None),
    ],
)
def test_a_prediction_is_wrong_if_another_road_was_likelier(
    goals: Any, edges: Any, wrong: Any
) -> None:
    later = [seen(float(k), edge) for k, edge in enumerate(edges, 1)]
    first = seen(0.0, "south", *goals)
    found = [(w.expected.edge, w.truth.edge, w.came_at) for w in wrong_predictions([first, *later])]
    assert found == ([] if wrong is None else [wrong])


def test_a_turn_is_called_as_the_goal_is_to_which_it_leads() -> None:
    traces = [seen(1.0, "south", LEFT, RIGHT), seen(2.0, "south", LEFT), seen(5.0, "east", RIGHT)]
    assert turn_to(traces, 1, "west", 3.0) == "exit-left"
    assert turn_to(traces, 1, "east", 1.5) == "exit-right"
    assert turn_to(traces, 1, "east", 3.0) is None  # the last decision before knows no such goal
    assert turn_to(traces, 1, "west", 0.5) is None
    assert turn_to(traces, 2, "west", 3.0) is None
