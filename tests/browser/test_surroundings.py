"""What is around the car on the map: people, lights, crossings, hidden parts of the road."""

import re
import threading
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import pytest
from msgspec import structs
from playwright.sync_api import expect

from benchmarks.service.synthetic_vehicle import SyntheticVehicle
from planner.record.hidden_record import Phantom
from sim.scene import Light, LightState, PersonState, Scene, Signal, Unseen, VehicleState
from tests.browser.conftest import Visits
from tests.browser.served import Dashboard, dashboard
from tests.drills.processes import Crew, free_endpoint
from tests.traces import s1_ride
from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import host

ROADS = Path("sim/scenarios/junction/junction.net.xml")
BEGIN = 10.0  # [s]
STEP = 0.2  # [s] of the ride, between scenes
PERIOD = 0.05  # [s] between scenes, shorter than between updates of the page
MOMENTS = 200
LOSE_THE_PAST = """() => {
  const store = window.xavi.store;
  store.past.splice(0, 9999);
  store.holes = true;
  const few = store.past.length;
  store.seek(20);
  return few;
}"""
SOMEBODY = Phantom(
    ("south_in_1",), 73.9, 88.6, (1.6, -30.0), 1.57, 13.9, 0.0, 14.7, 0.08, 0.3,
    "J", 8, (5,), (9.0,),
)  # fmt: skip


def scene(number: int) -> Scene:
    """We come from the west to a red light; two walk, a bus hides its lane."""
    time, ahead = round(BEGIN + number * STEP, 3), 0.1 * number
    return Scene(
        time,
        {
            0: VehicleState((-60.0 + ahead, -1.6), 0.0, 0.5, 0.0, 4.8, 1.8),
            2: VehicleState((1.6, -21.0), 1.571, 0.0, 0.0, 12.0, 2.5, "bus", "yellow"),
            3: VehicleState((-40.0 + ahead, -4.0), 0.0, 0.5, 0.0, 1.6, 0.65, "bicycle", "green"),
        },
        tuple(Light(Signal("J", k), LightState.RED, 0.0, change_seen=True) for k in range(24)),
        {9: PersonState((-16.0, -3.0 + ahead / 10.0), 1.571, 0.05, 0.2, 0.5)},
        (Unseen("south_in_1", 73.9, 88.6),),
    )


@pytest.fixture(scope="module")
def junction(crew: Crew) -> Iterator[Dashboard]:
    """A car that sees all this."""
    endpoint, over = free_endpoint(), threading.Event()
    with host(Link.of_hub(endpoint)) as bus:
        car = SyntheticVehicle(bus, Keys(), ROADS)
        car.appear()
        trace = structs.replace(s1_ride().traces[0], phantoms=(SOMEBODY,), sim_time=BEGIN)

        def drive() -> None:
            car.see_all(scene(0))
            car.decide(trace)
            while not over.wait(PERIOD):
                car.see_all(scene(min(car.scenes, MOMENTS)))

        thread = threading.Thread(target=drive)
        try:
            shown = dashboard(crew, "--connect", endpoint, "--session", "surroundings")
            thread.start()
            yield shown
        finally:
            over.set()
            if thread.ident is not None:
                thread.join()
            crew.dismiss()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_people_lights_and_hidden_lanes_are_on_the_map(
    junction: Dashboard, visit: Visits, scheme: str
) -> None:
    screen = visit(junction.address, color_scheme=scheme)
    screen.until("() => window.xavi.store.roads?.crossings.length === 5")
    screen.until_map("map.lights > 0 && map.hidden && map.imagined === 1")
    screen.until_map(
        "['pedestrian 9', 'bicycle 3', 'vehicle 2'].every((one) => map.labels.includes(one))"
    )
    legend = screen.page.locator(".map-legend")
    for words in ("traffic light", "out of our sight", "somebody may come"):
        expect(legend).to_contain_text(words)
    told = screen.page.locator("#map-in-words")
    expect(told).to_contain_text(re.compile("pedestrian 9 is", re.IGNORECASE))
    expect(told).to_contain_text("Our traffic light is red.")
    expect(told).to_contain_text("out of our sight")


def test_on_a_phone_too(junction: Dashboard, visit: Visits) -> None:
    screen = visit(junction.address, viewport={"width": 390, "height": 844}, is_mobile=True)
    screen.until_map("map.lights > 0 && map.labels.some((one) => one.endsWith('9'))")


def test_what_was_missed_while_the_ride_went_fast_is_fetched(
    junction: Dashboard, visit: Visits
) -> None:
    screen = visit(junction.address)
    screen.until_at(BEGIN + STEP * MOMENTS)
    screen.until("() => window.xavi.store.past.length > 20")  # what it asked for when it opened
    few = screen.ask_page(LOSE_THE_PAST)
    screen.until("few => window.xavi.store.past.length > few + 20", few)
    times = screen.ask_page("window.xavi.store.past.map((one) => one.t)")
    later = [time for time in times if time >= BEGIN]  # not what decisions remember
    assert max(b - a for a, b in pairwise(later)) < 5.0
    assert screen.ask_page("window.xavi.store.past.every((one) => one.hidden && one.lights)")
