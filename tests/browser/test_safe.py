"""Who may open the page, and that it stays among itself."""

import re

import pytest
from playwright.sync_api import expect

from tests.browser.conftest import Visits
from tests.browser.served import Dashboard, dashboard
from tests.drills.processes import Crew, free_endpoint

TOKEN = "correct-horse-battery-staple"
REFUSED = r"status of 40[0-9]|status of 421|Unexpected response code: 40[0-9]"


@pytest.fixture(scope="module")
def nobody() -> str:
    """Where there is no hub: the page is there all the same."""
    return free_endpoint()


@pytest.fixture(scope="module")
def open_to_all(crew: Crew, nobody: str) -> Dashboard:
    extra = {"XAVI_DASHBOARD_TOKEN": TOKEN}
    return dashboard(crew, "--connect", nobody, listen="0.0.0.0:0", extra=extra)


def test_listening_elsewhere_it_wants_a_token(open_to_all: Dashboard, visit: Visits) -> None:
    home = f"http://127.0.0.1:{open_to_all.port}/"
    stranger = visit.blank()
    stranger.forgive(REFUSED)
    answer = stranger.page.goto(home)
    assert answer is not None
    assert answer.status == 401
    expect(stranger.page.locator("body")).to_contain_text(re.compile("token"))
    assert stranger.page.goto(f"{home}?token=wrong-wrong-wrong-wrong").status == 401  # type: ignore[union-attr]
    for path in ("api/past", "static/js/main.js", "ws"):
        assert stranger.page.goto(home + path).status in (401, 404, 426)  # type: ignore[union-attr]
    guest = visit(f"{home}?token={TOKEN}")
    guest.until_open()
    assert TOKEN not in guest.page.url
    assert guest.ask_page("document.cookie") == ""  # scripts cannot read it
    guest.page.reload()
    guest.until_open()


def test_without_a_token_given_one_is_made_up(crew: Crew, nobody: str, visit: Visits) -> None:
    shown = dashboard(crew, "--connect", nobody, listen="0.0.0.0:0")
    found = re.search(r"token=([\w-]{16,})", shown.process.said)
    assert found is not None
    screen = visit(f"http://127.0.0.1:{shown.port}/?token={found[1]}")
    screen.until_open()


def test_other_pages_cannot_talk_with_it(crew: Crew, nobody: str, visit: Visits) -> None:
    ours = dashboard(crew, "--connect", nobody)
    theirs = dashboard(crew, "--connect", nobody)
    screen = visit(ours.address)
    screen.until_open()
    elsewhere = visit.blank(bypass_csp=True)
    elsewhere.forgive(r"WebSocket connection|CORS policy|ERR_FAILED|NotSameOrigin|Refused to")
    elsewhere.page.goto(theirs.address)
    elsewhere.until_open()
    opened = elsewhere.ask_page(
        """address => new Promise((tell) => {
          const socket = new WebSocket(address.replace("http", "ws") + "ws");
          socket.onopen = () => tell(true);
          socket.onerror = () => tell(false);
        })""",
        ours.address,
    )
    assert opened is False
    fetched = elsewhere.ask_page(
        "address => fetch(address + 'api/past').then(() => true, () => false)", ours.address
    )
    assert fetched is False
    elsewhere.requests.clear()  # these were ours, to elsewhere on purpose


def test_a_page_that_waits_says_for_whom(crew: Crew, nobody: str, visit: Visits) -> None:
    screen = visit(dashboard(crew, "--connect", nobody).address)
    expect(screen.page.locator("#state")).to_contain_text("Waiting for the hub")
    expect(screen.page.locator("#state")).to_contain_text("xavi serve")
    crew.serve(nobody, "--keep-days", "0")
    expect(screen.page.locator("#state")).to_contain_text("Waiting for the car")
    expect(screen.page.locator("#bar")).to_contain_text(re.compile("service\\s*there"))
