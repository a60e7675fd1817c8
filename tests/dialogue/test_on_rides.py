"""Questions on recorded rides, where the nearest thing on record is not what is asked about."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize("text", ["why are we stopping?", "why are you coming to a stop?"])
def test_why_we_stop_again_is_not_why_we_stood_before(text: str) -> None:
    """We stood for the light until 26.4 s, and come to a halt for a bicycle at 29.6 s."""
    reply = Talk("junction-0", 28.2, planner=False).say(text).reply.text
    assert "bicycle" in reply
    assert "traffic light" not in reply
    assert "light" in Talk("junction-0", 27.0, planner=False).say(text).reply.text
