"""A recording in the page; SUMO cannot be had meanwhile."""

import re
from pathlib import Path

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visits
from tests.browser.served import S1, dashboard
from tests.drills.processes import PATIENCE, Crew

NO_SUMO = """
raise ImportError("SUMO is not installed")
"""


def test_a_recording_is_seen_and_asked_about(crew: Crew, visit: Visits, tmp_path: Path) -> None:
    recorded = tmp_path / "ride.mcap"
    chat = crew.xavi("chat", *S1, "--record", str(recorded))
    chat.order("@ 8.0s", "Why did you change lanes?")
    assert "left lane" in chat.hear(1)[0]
    assert chat.popen.stdin is not None
    chat.popen.stdin.close()
    assert chat.popen.wait(PATIENCE) == 0, chat.said
    without = tmp_path / "without"
    for name in ("libsumo", "traci"):  # sumolib reads networks, and does so without SUMO
        (without / name).mkdir(parents=True)
        (without / name / "__init__.py").write_text(NO_SUMO)
    shown = dashboard(
        crew, "--replay", str(recorded), "--keep-days", "0", extra={"PYTHONPATH": str(without)}
    )
    screen = visit(shown.address)
    expect(screen.page.locator("#strip")).to_contain_text("This is a recording.")
    screen.until_at(8.0)
    expect(screen.page.locator("#strip")).to_contain_text("The recording is over.")
    screen.until_map("map.vehicles.includes(0) && map.vehicles.length > 1")
    screen.until("() => window.xavi.store.roads?.lanes.length > 0")
    screen.drag_to(4.0)
    assert not screen.live
    turn = screen.ask_and_hear("What are you doing?")
    assert turn["reply"]["kind"] == "answer"
    assert turn["reply"]["sim_time"] == pytest.approx(4.0, abs=0.2)
    screen.button(re.compile("Back to the"), "#timeline").click()
    why = screen.ask_and_hear("Why did you change lanes instead of going straight?")
    assert "left lane" in why["reply"]["text"]
    screen.until_map("map.ghost > 0")
