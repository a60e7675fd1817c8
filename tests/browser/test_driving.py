"""A car that is under way: it drives on the map, in the timeline, and in what is told of it."""

import re

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visits
from tests.browser.served import S1, Dashboard, dashboard
from tests.drills.processes import Crew


@pytest.fixture(scope="module")
def driving(crew: Crew) -> Dashboard:
    """It sets off when somebody looks."""
    return dashboard(crew, *S1, "--speed", "2")


def test_the_car_drives(driving: Dashboard, visit: Visits) -> None:
    screen = visit(driving.address)
    screen.until_map("map.vehicles.includes(0) && map.vehicles.length > 1")
    first = screen.ask_page("[window.xavi.store.latest.t, window.xavi.store.latest.vehicles[0].x]")
    screen.until("([t]) => window.xavi.store.latest.t > t + 1", first)
    t, x = screen.ask_page("[window.xavi.store.latest.t, window.xavi.store.latest.vehicles[0].x]")
    assert t > first[0]
    assert x != first[1]
    painted = screen.ask_page("window.xavi.map.frames().count")
    screen.until("count => window.xavi.map.frames().count > count", painted)
    expect(screen.page.get_by_role("heading", level=1)).to_be_visible()
    expect(screen.slider).to_have_attribute("aria-valuetext", re.compile(r"live"))
    screen.until_map("map.predictions > 0")  # what others are expected to do
    screen.until("() => window.xavi.store.roads?.lanes.length > 0")
    shown = screen.shown
    assert any("1" in label for label in shown["labels"])
    screen.until_over()
    screen.until("() => window.xavi.store.decisions.length > 5")
    assert screen.ask_page("window.xavi.store.events.some((one) => one.kind === 'arrived')")


def test_a_question_back_is_answered_by_a_click(crew: Crew, visit: Visits) -> None:
    """It is the first of the conversation, so that nothing tells which vehicle is meant."""
    motorway = ("--scenario", "motorway", "--seed", "0", "--keep-days", "0")
    screen = visit(dashboard(crew, *motorway, "--speed", "2").address)
    screen.until_at(6.5)
    screen.ask_page("window.xavi.store.seek(6)")
    turn = screen.ask_and_hear("Why is the car over there so slow?")
    assert turn["reply"]["kind"] == "clarification"
    latest = screen.turn(turn["n"])
    before = screen.count
    chosen = turn["reply"]["choices"][1]
    latest.get_by_role("button", name=re.compile(re.escape(chosen))).click()
    screen.until("n => window.xavi.store.turns.length > n", before)
    answer = screen.turns()[before]["reply"]
    assert answer["reason"] == "did-not-happen"  # it is not slow, which is said of the one chosen
    assert re.findall(r"vehicle \d+", answer["text"]) == re.findall(r"vehicle \d+", chosen)
