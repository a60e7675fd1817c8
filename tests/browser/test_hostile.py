"""Markup wherever a car or a service can put text: it is shown as text, and never runs."""

import threading
from collections.abc import Iterator

import pytest
from playwright.sync_api import expect

from benchmarks.service.synthetic_vehicle import SyntheticVehicle
from tests.browser.conftest import Visits
from tests.browser.forgery import MARKUP, ForgedService, decisions, events, traffic
from tests.browser.screen import Screen
from tests.browser.served import Dashboard, dashboard
from tests.drills.processes import Crew, free_endpoint
from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import host

PERIOD = 0.1  # [s] between scenes
#: Whether the decision in force has come, with all that there is to it.
WHOLE = """async () => {
  const { store } = window.xavi;
  return (await store.detail(store.decisionAt(store.at).id)).alternatives.length > 0;
}"""


@pytest.fixture(scope="module")
def hostile(crew: Crew) -> Iterator[Dashboard]:
    """A dashboard whose bus belongs to those who mean no good."""
    endpoint = free_endpoint()
    over = threading.Event()
    with host(Link.of_hub(endpoint)) as bus:
        ForgedService(bus).open()
        car = SyntheticVehicle(bus, Keys())
        car.scenario = MARKUP[0]
        car.appear()
        for trace in decisions():
            car.decide(trace)
        for event in events():
            car.experience(event)

        def drive() -> None:
            while not over.wait(PERIOD):
                car.see(round(10.0 + PERIOD * car.scenes, 3), traffic())

        thread = threading.Thread(target=drive)
        thread.start()
        try:
            yield dashboard(crew, "--connect", endpoint, "--session", "hostile")
        finally:
            over.set()
            thread.join()
            crew.dismiss()


def harm(screen: Screen) -> list[str]:
    """What ran, and what of the page was made of markup."""
    made = "[...document.querySelectorAll('.forged')].map((one) => one.outerHTML)"
    ran = "window.__pwned === undefined ? [] : [String(window.__pwned)]"
    return [*screen.ask_page(made), *screen.ask_page(ran)]


def test_markup_of_a_car_is_text(hostile: Dashboard, visit: Visits) -> None:
    screen = visit(hostile.address)
    screen.until_map("map.vehicles.length === 7")
    screen.until("() => window.xavi.store.decisions.length >= 4")
    expect(screen.page.locator("#bar")).to_contain_text(MARKUP[0])  # its scenario
    screen.tab("Decision")
    expect(screen.page.locator("#decision").get_by_role("table").first).to_be_visible()
    for number in range(4):
        screen.ask_page("k => window.xavi.store.seek(window.xavi.store.decisions[k].t)", number)
        screen.until(WHOLE)
    screen.page.locator("#map canvas").first.focus()
    for _ in range(8):
        screen.page.keyboard.press("]")  # one vehicle after the other, with its card
    assert harm(screen) == []


@pytest.mark.parametrize("question", ["hello", "clarify", "refuse", MARKUP[0], " ".join(MARKUP)])
def test_markup_of_a_service_is_text(hostile: Dashboard, visit: Visits, question: str) -> None:
    screen = visit(hostile.address)
    screen.until("() => window.xavi.store.turns.length >= 6")
    for text in MARKUP:  # a session that was full of it before
        expect(screen.log).to_contain_text(text)
    turn = screen.ask_and_hear(question)
    shown = screen.turn(turn["n"])
    expect(shown).to_contain_text(question)
    expect(shown).to_contain_text(MARKUP[3])
    assert harm(screen) == []


def test_what_is_typed_is_text(hostile: Dashboard, visit: Visits) -> None:
    screen = visit(f"{hostile.address}?q={MARKUP[0]}#{MARKUP[2]}")
    screen.until_open()
    screen.question.fill(MARKUP[3])
    expect(screen.question).to_have_value(MARKUP[3])
    assert harm(screen) == []
