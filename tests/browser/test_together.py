"""Two browsers and a terminal in one conversation."""

from playwright.sync_api import expect

from tests.browser.conftest import Visits
from tests.browser.served import dashboard
from tests.drills.processes import Crew, free_endpoint
from tests.drills.stage import HALT


def test_everybody_in_a_session_sees_what_is_said(crew: Crew, visit: Visits) -> None:
    endpoint = free_endpoint()
    crew.serve(endpoint, "--keep-days", "0")
    car = crew.drive(endpoint, "--scenario", "s1", "--seed", "1", "--control")
    car.order(f"until {HALT}")  # and there it stays, for all that come
    shown = dashboard(crew, "--connect", endpoint, "--session", "family")
    ada, bob = visit(shown.address), visit(shown.address, viewport={"width": 390, "height": 844})
    ada.until_at(HALT)
    asked = ada.ask_and_hear("Why did you change lanes?")
    assert asked["reply"]["kind"] == "answer"
    bob.heard("Why did you change lanes?", 0)
    expect(bob.log).to_contain_text(asked["reply"]["text"])
    terminal = crew.xavi("chat", "--connect", endpoint, "--session", "family")
    terminal.order("Where is vehicle 1 going?")
    said = terminal.hear(1)[0]
    for screen in (ada, bob):
        assert screen.heard("Where is vehicle 1 going?", 1)["reply"]["text"] == said
        expect(screen.log).to_contain_text("Where is vehicle 1 going?")
    ada.until("() => window.xavi.store.status.browsers === 2")
    follow_up = bob.ask_and_hear("And why?")  # leans on what was said at the terminal
    ada.heard("And why?", 2)
    expect(ada.log).to_contain_text(follow_up["reply"]["text"])
    terminal.order("Are you sure?")
    terminal.hear(2)
    numbers = [turn["n"] for turn in bob.turns()]
    assert numbers == sorted(set(numbers))
