"""What tests in the browser share: the browser, processes of a file, and a report of failures."""

from collections.abc import Generator, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Error, expect, sync_playwright

from benchmarks.service.browser import options, program
from tests.browser.screen import PATIENCE, Screen
from tests.drills.processes import Crew


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """The system's Chromium, without a window."""
    expect.set_options(timeout=PATIENCE)
    with sync_playwright() as playwright:
        made = playwright.chromium.launch(executable_path=program(), args=options())
        yield made
        made.close()


@pytest.fixture(scope="module")
def crew(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Crew]:
    """Starts processes; after the file all end when told to, and nothing is left of them."""
    made = Crew(tmp_path_factory.mktemp("crew"))
    try:
        yield made
        made.dismiss()
        left = made.leavings()
    finally:
        made.clear()
    assert left == []


WORDS = 4000  # characters of what a process said last


class Visits:
    """Opens pages, each in a browser profile of its own."""

    def __init__(self, browser: Browser) -> None:
        self._browser = browser
        self.screens: list[Screen] = []

    def __call__(self, address: str, **context: object) -> Screen:
        """Open a page, and wait until it is put together.

        Args:
            address: of the page.
            context: of playwright's `new_context`, such as viewport or color_scheme.
        """
        screen = self.blank(**context)
        screen.page.goto(address)
        screen.until("() => window.xavi !== undefined")
        return screen

    def blank(self, **context: object) -> Screen:
        """A page that shows nothing yet."""
        options = {"viewport": {"width": 1440, "height": 900}, **context}
        screen = Screen(self._browser.new_context(**options).new_page())  # type: ignore[arg-type]
        self.screens.append(screen)
        return screen

    def close(self) -> None:
        for screen in self.screens:
            screen.page.context.close()


@pytest.fixture
def visit(browser: Browser) -> Iterator[Visits]:
    """Opens pages; any error of theirs, blocked content or request elsewhere fails the test."""
    visits = Visits(browser)
    try:
        yield visits
        faults = [fault for screen in visits.screens for fault in screen.faults()]
    finally:
        visits.close()
    assert not faults, "\n".join(faults)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item, call: pytest.CallInfo[None]
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """With a test that fails, keep what was on the screen and what the browser said."""
    report = yield
    visits = getattr(item, "funcargs", {}).get("visit")
    if report.when == "call" and report.failed and isinstance(visits, Visits):
        folder = item.config.cache.mkdir("browser")  # type: ignore[union-attr]
        crew = item.funcargs.get("crew")  # type: ignore[attr-defined]
        for one in crew.started if isinstance(crew, Crew) else ():
            report.sections.append((" ".join(one.popen.args[2:])[:200], one.said[-WORDS:]))
        for k, screen in enumerate(visits.screens):
            picture = folder / f"{item.name.replace('/', '-')[:100]}-{k}.png"
            told = "\n".join([_pictured(screen, picture), *screen.said])
            report.sections.append((f"page {k} of the browser", told))
    return report


def _pictured(screen: Screen, picture: Path) -> str:
    try:
        screen.page.screenshot(path=picture, timeout=PATIENCE)
    except Error as error:
        return f"no picture: {error}"
    return f"picture: {picture}"
