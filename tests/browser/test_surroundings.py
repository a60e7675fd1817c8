"""What is around the car on the map: people, lights, crossings, hidden parts of the road."""

import re
from itertools import pairwise

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visits
from tests.browser.served import Dashboard, dashboard
from tests.drills.processes import Crew

JUNCTION = ("--scenario", "junction", "--seed", "0", "--keep-days", "0")
BUS_WAITS = 30.0  # [s] its light is red, and it hides its own lane


@pytest.fixture(scope="module")
def driving(crew: Crew) -> Dashboard:
    return dashboard(crew, *JUNCTION, "--speed", "0")


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_people_lights_and_hidden_lanes_are_on_the_map(
    driving: Dashboard, visit: Visits, theme: str
) -> None:
    screen = visit(driving.address, color_scheme=theme)
    screen.page.set_default_timeout(300_000.0)
    screen.until_at(BUS_WAITS + 1.0)
    screen.ask_page("time => window.xavi.store.seek(time)", BUS_WAITS)
    screen.until_map("map.lights > 0 && map.hidden")
    screen.until("() => window.xavi.map.shown().labels.some((one) => /^pedestrian/.test(one))")
    legend = screen.page.locator(".map-legend")
    expect(legend).to_contain_text("traffic light")
    expect(legend).to_contain_text("out of our sight")
    words = screen.page.locator("#map-in-words")
    expect(words).to_contain_text(re.compile(r"(P|p)edestrian \d+ is"))
    assert screen.ask_page("window.xavi.store.roads.crossings.length") == 5
    lights = screen.ask_page("window.xavi.store.sceneAt(window.xavi.store.at).lights")
    assert {state for _, state in lights} >= {"red", "green"}


def test_what_was_missed_while_the_ride_went_fast_is_fetched(
    driving: Dashboard, visit: Visits
) -> None:
    screen = visit(driving.address)
    screen.until_at(BUS_WAITS)
    screen.ask_page("window.xavi.store.past.splice(5); window.xavi.store.holes = true")
    screen.ask_page("window.xavi.store.seek(10)")
    screen.until("() => window.xavi.store.past.length > 60")
    times = screen.ask_page("window.xavi.store.past.map((one) => one.t)")
    assert max(b - a for a, b in pairwise(times)) < 0.7
