"""The car, the service or the dashboard itself is killed, and comes back."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visits
from tests.browser.screen import LOST
from tests.browser.served import Dashboard, dashboard
from tests.drills.processes import Crew, Process, free_endpoint

DRIVE = ("--scenario", "s1", "--seed", "1")
SLOWLY = 0.25  # so that the ride outlasts whatever is started anew meanwhile


@dataclass
class Scene:
    """A service, and a dashboard beside it; cars come and go."""

    crew: Crew
    endpoint: str
    service: Process = field(init=False)
    dashboard: Dashboard = field(init=False)

    def serve(self) -> Process:
        store = self.crew.folder / f"{self.endpoint.rpartition(':')[2]}.sqlite3"
        return self.crew.serve(self.endpoint, "--store", str(store))

    def drive(self, speed: float = SLOWLY) -> Process:
        return self.crew.drive(self.endpoint, *DRIVE, "--speed", str(speed))

    def show(self, listen: str = "127.0.0.1:0") -> Dashboard:
        arguments = ("--connect", self.endpoint, "--session", "lost")
        return dashboard(self.crew, *arguments, listen=listen)


@pytest.fixture
def scene(crew: Crew) -> Iterator[Scene]:
    endpoint = free_endpoint()
    made = Scene(crew, endpoint)
    made.service, made.dashboard = made.serve(), made.show()
    yield made
    crew.dismiss()


def test_the_car_is_lost_and_another_one_comes(scene: Scene, visit: Visits) -> None:
    screen = visit(scene.dashboard.address)
    expect(screen.page.locator("#state")).to_contain_text("Waiting for the car")
    car = scene.drive(speed=1.0)
    screen.until_at(5.0)
    car.kill()
    screen.until("() => window.xavi.store.status.car === 'gone'")
    expect(screen.page.locator("#strip")).to_contain_text("not heard of any more")
    turn = screen.ask_and_hear("Why did you change lanes?")  # its record is still there
    assert turn["reply"]["text"]
    screen.slider.press("Home")
    screen.until("() => !window.xavi.store.live")
    screen.slider.press("End")
    ride = screen.ask_page("window.xavi.store.ride.ride")
    scene.drive()
    screen.until("before => window.xavi.store.ride.ride !== before", ride)
    screen.until("() => window.xavi.store.status.car === 'there'")
    screen.until_at(1.0)
    screen.until_map("map.vehicles.includes(0)")


def test_the_service_is_lost_and_comes_back(scene: Scene, visit: Visits) -> None:
    """With it goes the hub, so that the car is not heard either as long."""
    scene.drive()
    screen = visit(scene.dashboard.address)
    screen.until_at(1.0)
    assert screen.ask_and_hear("Where are you going?")["reply"]["kind"] == "answer"
    scene.service.kill()
    screen.until("() => window.xavi.store.status.service !== 'there'")
    before = screen.count
    screen.ask("What are you doing?")
    expect(screen.log).to_contain_text("What are you doing?")
    scene.serve()
    screen.until("() => window.xavi.store.status.service === 'there'")
    screen.ask("Where do you want to go?")
    assert screen.heard("Where do you want to go?", before)["reply"]["text"]
    assert screen.turns()[0]["text"] == "Where are you going?"  # what was said before still is


def test_the_page_comes_back_to_a_dashboard_that_is_started_anew(
    scene: Scene, visit: Visits
) -> None:
    scene.drive()
    screen = visit(scene.dashboard.address)
    screen.forgive(LOST)
    screen.until_at(1.0)
    turn = screen.ask_and_hear("Where are you going?")
    port = scene.dashboard.port
    scene.dashboard.process.kill()
    notice = screen.page.locator("#notice")
    expect(notice).to_contain_text(re.compile("Trying again"))
    expect(screen.turn(turn["n"])).to_be_visible()  # what was there still is
    scene.show(f"127.0.0.1:{port}")
    expect(notice).to_contain_text("Back.")
    screen.until_open()
    seen = screen.ask_page("window.xavi.store.latest.seq")
    screen.until("seq => window.xavi.store.latest.seq !== seq", seen)
    assert screen.ask_and_hear("What are you doing?")["reply"]["text"]


def test_a_question_that_is_lost_with_the_connection_is_not_lost(
    scene: Scene, visit: Visits
) -> None:
    scene.drive()
    screen = visit(scene.dashboard.address)
    screen.forgive(LOST)
    screen.until_at(1.0)
    port = scene.dashboard.port
    scene.dashboard.process.kill()
    screen.until("() => window.xavi.connection.state !== 'open'")
    text = "Where are you going?"
    screen.ask(text)
    scene.show(f"127.0.0.1:{port}")
    screen.until_open()
    if screen.question.input_value() == text:  # it was given back to be sent
        screen.question.press("Enter")
    assert screen.heard(text, 0)["reply"]["kind"] == "answer"
