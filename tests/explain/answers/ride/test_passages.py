"""Passages: exits passed, time on junctions, and the slowing down that belongs to them."""

import pytest

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego
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
