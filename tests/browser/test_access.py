"""By keyboard alone, on a phone, in the dark, by ear, without motion, and on a slow machine."""

import re

import pytest
from playwright.sync_api import expect

from tests.browser.audit import heard, nameless, wrong
from tests.browser.conftest import Visits
from tests.browser.screen import Screen
from tests.browser.served import S1, Dashboard, dashboard
from tests.drills.processes import Crew

LANES = "Why did you change lanes instead of going straight?"
DESKTOP = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}
SMALL = {"width": 320, "height": 568}
TOUCH = {"has_touch": True, "is_mobile": True, "device_scale_factor": 2}


@pytest.fixture(scope="module")
def ridden(crew: Crew) -> Dashboard:
    return dashboard(crew, *S1, "--speed", "0")


def told(visit: Visits, ridden: Dashboard, **context: object) -> Screen:
    """A page with a ride, answers of every kind, and evidence that is unfolded."""
    screen = visit(ridden.address, **context)
    screen.until_over()
    screen.until("() => window.xavi.store.roads !== null")
    turn = screen.ask_and_hear(LANES)
    screen.ask_and_hear("What is the weather like?")
    screen.ask_page("number => window.xavi.store.show(number)", turn["n"])
    screen.turn(turn["n"]).get_by_role("button", name="Evidence").click()
    expect(screen.turn(turn["n"]).get_by_role("table").first).to_be_visible()
    return screen


def test_keys_are_enough(ridden: Dashboard, visit: Visits) -> None:
    screen = visit(ridden.address)
    screen.until_over()
    press = screen.page.keyboard.press
    press("/")
    expect(screen.question).to_be_focused()
    before = screen.count
    screen.page.keyboard.type(LANES)
    press("Enter")
    turn = screen.heard(LANES, before)
    evidence = screen.turn(turn["n"]).get_by_role("button", name="Evidence")
    for _ in range(60):  # back through the turn, key by key
        press("Shift+Tab")
        if evidence.evaluate("one => one === document.activeElement"):
            break
    expect(evidence).to_be_focused()
    outline = "one => getComputedStyle(one).outlineStyle !== 'none'"
    assert evidence.evaluate(outline) is True  # where the focus is can be seen
    press("Enter")
    expect(evidence).to_have_attribute("aria-expanded", "true")
    press("?")
    expect(screen.page.get_by_role("dialog")).to_be_visible()
    press("Escape")
    expect(screen.page.get_by_role("dialog")).to_be_hidden()
    press("t")
    expect(screen.slider).to_be_focused()
    press("Home")
    screen.until("() => !window.xavi.store.live")
    press("l")
    screen.until("() => window.xavi.store.live")


def test_the_focus_is_never_caught(ridden: Dashboard, visit: Visits) -> None:
    screen = visit(ridden.address)
    screen.until_over()
    places = []
    for _ in range(80):
        screen.page.keyboard.press("Tab")
        places.append(
            screen.ask_page("document.activeElement.closest('header, nav, section')?.id ?? ''")
        )
        if screen.ask_page("document.activeElement === document.body"):
            break
    assert {"bar", "map", "timeline", "talk"} <= set(places)
    assert len(places) < 80


@pytest.mark.parametrize("size", [PHONE, SMALL], ids=["phone", "small"])
def test_on_a_phone(ridden: Dashboard, visit: Visits, size: dict[str, int]) -> None:
    screen = told(visit, ridden, viewport=size, **TOUCH)
    faults = wrong(screen, "wide") + wrong(screen, "small")
    screen.tab("Decision")
    expect(screen.page.locator("#decision").get_by_role("table").first).to_be_visible()
    faults += wrong(screen, "wide") + wrong(screen, "small")
    assert not faults, "\n".join(faults)
    map_box, talk = screen.page.locator("#map").bounding_box(), screen.page.locator("#decision")
    assert map_box is not None
    assert map_box["height"] > 0.25 * size["height"]
    expect(talk).to_be_visible()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_all_text_can_be_read(
    ridden: Dashboard, visit: Visits, scheme: str, size: dict[str, int]
) -> None:
    screen = told(visit, ridden, color_scheme=scheme, viewport=size)
    faults = wrong(screen, "faint")
    screen.ask_page("window.xavi.store.seek(3.2)")
    screen.tab("Decision")
    expect(screen.page.locator("#decision").get_by_role("table").first).to_be_visible()
    faults += wrong(screen, "faint")
    screen.button("Help and keys").click()
    expect(screen.page.get_by_role("dialog")).to_be_visible()
    faults += wrong(screen, "faint")
    assert not faults, "\n".join(faults)


def test_the_theme_is_chosen_and_remembered(ridden: Dashboard, visit: Visits) -> None:
    screen = visit(ridden.address, color_scheme="light")
    ground = "getComputedStyle(document.documentElement).backgroundColor"
    light = screen.ask_page(ground)
    switch = screen.button(re.compile("^Theme"))
    switch.click()
    switch.click()
    expect(switch).to_have_accessible_name(re.compile("Theme: dark"))
    assert screen.ask_page(ground) != light
    screen.page.reload()
    expect(switch).to_have_accessible_name(re.compile("Theme: dark"))
    assert screen.ask_page(ground) != light


def test_by_ear(ridden: Dashboard, visit: Visits) -> None:
    screen = told(visit, ridden)
    assert nameless(screen) == []
    roles = [role for role, _ in heard(screen)]
    assert roles.count("main") == roles.count("banner") == 1
    assert screen.page.locator("h1").count() == 1
    regions = {name for role, name in heard(screen) if role in ("region", "tabpanel")}
    assert {"Map", "Timeline"} <= regions
    assert screen.ask_page("document.documentElement.lang") == "en"
    assert (
        screen.ask_page(
            "[...document.querySelectorAll('[id]')].map((one) => one.id)"
            ".filter((id, k, all) => all.indexOf(id) !== k)"
        )
        == []
    )  # no two of a name
    screen.tab("Decision")
    expect(screen.page.locator("#decision").get_by_role("tree").first).to_be_visible()
    assert nameless(screen) == []


def test_without_motion(ridden: Dashboard, visit: Visits) -> None:
    screen = told(visit, ridden, reduced_motion="reduce")
    screen.until_map("map.ghost > 0")
    assert wrong(screen, "moving") == []
    still = """() => new Promise((tell) => {
      const [before, began] = [window.xavi.map.frames().count, performance.now()];
      const look = () => performance.now() - began < 1000 ? requestAnimationFrame(look)
        : tell(window.xavi.map.frames().count - before);
      look();
    })"""
    screen.until(f"async () => (await ({still})()) <= 1")  # nothing is drawn where nothing changes


def test_a_slow_page_gets_fewer_scenes_and_recovers(crew: Crew, visit: Visits) -> None:
    screen = visit(dashboard(crew, *S1).address)
    screen.until_at(1.0)
    busy = """() => { const end = performance.now() + 2500; while (performance.now() < end); }"""
    for _ in range(2):
        screen.ask_page(busy)
    screen.until("() => window.xavi.store.status.dropped > 5")
    expect(screen.page.locator("#bar")).to_contain_text(re.compile(r"\d+ scenes dropped"))
    seen = screen.ask_page("window.xavi.store.latest.t")
    screen.until("seen => window.xavi.store.latest.t > seen + 1", seen)
    assert screen.ask_and_hear("What are you doing?")["reply"]["kind"] == "answer"
