"""Where reports were lost, nobody is said not to be in our way."""

from dataclasses import replace

import pytest

from tests.dialogue.talking import Talk

LOST = (11.7, 15.3)  # [s]


def _with_gap() -> Talk:
    """A conversation at a red light, of whose approach the record has lost all."""
    talk = Talk("city-0", 15.0)
    known = talk.dialogue
    traces = tuple(one for one in known.traces if not LOST[0] < one.sim_time < LOST[1])
    events = tuple(one for one in known.events if one.sim_time >= LOST[1])
    talk.dialogue = replace(known, traces=traces, events=events, gaps=(LOST,))
    return talk


@pytest.mark.parametrize(
    "question", ["why are we so slow", "what are we waiting for", "Why are we driving so slowly?"]
)
def test_a_gap_is_no_reason(question: str) -> None:
    told = _with_gap().hear(question)
    assert "nobody" not in told
    assert told.startswith("Part of my record is missing")


@pytest.mark.parametrize("question", ["why are we so slow", "what are we waiting for"])
def test_the_light_is_the_reason_where_nothing_is_lost(question: str) -> None:
    assert "the traffic light is red" in Talk("city-0", 15.0).hear(question)
