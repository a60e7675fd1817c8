"""Questions at the page: answers, refusals, questions back, and what is shown beside them."""

import re

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visits
from tests.browser.screen import Screen
from tests.browser.served import S1, Dashboard, dashboard
from tests.drills.processes import Crew

LANES = "Why did you change lanes instead of going straight?"


@pytest.fixture(scope="module")
def ridden(crew: Crew) -> Dashboard:
    return dashboard(crew, *S1, "--speed", "0")


@pytest.fixture
def screen(ridden: Dashboard, visit: Visits) -> Screen:
    """A page that shows a ride which is over."""
    screen = visit(ridden.address)
    screen.until_over()
    screen.until("() => window.xavi.store.roads !== null")
    return screen


def test_an_answer_is_shown_on_the_map_with_its_evidence(screen: Screen) -> None:
    turn = screen.ask_and_hear(LANES)
    assert turn["reply"]["kind"] == "answer"
    assert turn["evidence"] is True
    assert turn["vehicles"] == [1]
    latest = screen.turn(turn["n"])
    expect(latest).to_contain_text(turn["reply"]["text"])
    expect(latest.get_by_role("button", name=re.compile("vehicle 1", re.I)).first).to_be_visible()
    screen.until_map("map.ghost > 0 && map.fact > 0")  # by itself
    evidence = screen.ask_page("n => window.xavi.store.evidenceOf(n)", turn["n"])
    assert evidence["counterfactual"]["rollouts"] > 0
    assert evidence["effects"]
    latest.get_by_role("button", name="Evidence").click()
    fold = latest.get_by_role("region", name="Evidence")
    expect(fold).to_contain_text(re.compile(r"\d+ rollouts from \d+ distinct"))
    expect(fold).to_contain_text("What you asked about")
    expect(fold).to_contain_text(re.compile(r"between"))  # the interval of an effect
    expect(fold.get_by_role("table").first).to_be_visible()
    off = latest.get_by_role("button", name="Show on the map")
    expect(off).to_have_attribute("aria-pressed", "true")
    off.click()
    screen.until_map("map.ghost === 0")


def test_a_vehicle_that_an_answer_names_is_pointed_at(screen: Screen) -> None:
    screen.ask_and_hear(LANES)
    # Where it is named a second time in a conversation, its number is left out.
    named = screen.log.get_by_role("article").get_by_role("button", name=re.compile("^vehicle 1$"))
    named.first.hover()
    screen.until("() => window.xavi.store.pointed.has(1)")


def test_misspelt_questions_are_understood(screen: Screen) -> None:
    turn = screen.ask_and_hear("Why did you chagne lanse?")
    assert turn["reply"]["kind"] == "answer"
    assert "left lane" in turn["reply"]["text"]


def test_a_refusal_offers_other_questions(screen: Screen) -> None:
    turn = screen.ask_and_hear("asdf qwer")
    assert (turn["reply"]["kind"], turn["reply"]["reason"]) == ("refusal", "not-understood")
    latest = screen.turn(turn["n"])
    offered = turn["reply"]["suggestions"][0]
    before = screen.count
    latest.get_by_role("button", name=offered).click()
    assert screen.heard(offered, before)["reply"]["text"]


def test_suggested_questions_are_asked_by_a_click(screen: Screen) -> None:
    suggested = screen.page.get_by_role("list", name="Suggested questions").get_by_role("button")
    expect(suggested.nth(2)).to_be_visible()
    before = screen.count
    # Read and clicked in one step: other questions may be suggested at any time.
    offered = suggested.first.evaluate("button => (button.click(), button.textContent)")
    assert screen.heard(offered, before)["reply"]["kind"] == "answer"


def test_earlier_moments_are_asked_about(screen: Screen) -> None:
    end = screen.at
    screen.drag_to(5.0)
    assert not screen.live
    held = screen.at
    assert held == pytest.approx(5.0, abs=0.2)
    expect(screen.page.locator("#talk")).to_contain_text(re.compile("asking about", re.I))
    turn = screen.ask_and_hear("What are you doing?")
    assert turn["reply"]["sim_time"] == pytest.approx(held, abs=0.01)
    screen.slider.press("ArrowLeft")
    screen.until("held => window.xavi.store.at < held", held)
    screen.slider.press("PageDown")
    screen.slider.press("PageUp")
    screen.slider.press("Home")
    screen.until("() => window.xavi.store.at <= 0.5")
    first = screen.ask_and_hear("What are you doing?")
    assert first["reply"]["sim_time"] <= 0.5
    screen.button("Back to the end", "#timeline").click()
    screen.until("() => window.xavi.store.live")
    expect(screen.slider).to_have_attribute("aria-valuetext", re.compile("ride over"))
    last = screen.ask_and_hear("Where are you going?")
    assert last["reply"]["sim_time"] == pytest.approx(end, abs=0.2)


def test_the_decision_in_force_is_shown_with_its_alternatives_and_its_tree(screen: Screen) -> None:
    screen.ask_page("window.xavi.store.seek(3.2)")
    screen.tab("Decision")
    panel = screen.page.locator("#decision")
    table = panel.get_by_role("table").first
    expect(table).to_contain_text(re.compile("left lane", re.I))
    assert table.get_by_role("row").count() >= 3
    tree = panel.get_by_role("tree")
    node = tree.locator("[role=treeitem][aria-expanded]").first
    node.focus()
    if node.get_attribute("aria-expanded") == "true":
        screen.page.keyboard.press("ArrowLeft")
    expect(node).to_have_attribute("aria-expanded", "false")
    screen.page.keyboard.press("ArrowRight")
    expect(node).to_have_attribute("aria-expanded", "true")
    expect(panel.locator("svg").first).to_be_visible()  # the posterior over goals
    expect(panel).to_contain_text(re.compile(r"vehicle 1", re.I))
