"""A browser without a window, driven by playwright."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from xavi_dialogue.process.exit_status import RunFault

if TYPE_CHECKING:
    from playwright.sync_api import CDPSession, Page

SIZE = (1440, 900)  # [px] of the window
PATIENCE = 60.0  # [s] greatest wait for a result of the page
NAMES = ("chromium", "chromium-browser", "google-chrome")


class NoBrowser(RunFault):
    """The browser, or the library that controls it, is missing."""


def program() -> str:
    """Return the path of the browser.

    Raises:
        NoBrowser: none is installed.
    """
    named = os.environ.get("XAVI_CHROMIUM")
    found = next(filter(None, map(shutil.which, [named] if named else NAMES)), None)
    if found is not None:
        return found
    if named:
        raise NoBrowser(f"XAVI_CHROMIUM names {named!r}, which was not found")
    raise NoBrowser("there is no Chromium; install it, or name another with XAVI_CHROMIUM")


def options() -> list[str]:
    """Return the arguments for the browser; if run by root, it has no sandbox."""
    return ["--no-sandbox"] if os.geteuid() == 0 else []


@dataclass(frozen=True)
class Window:
    """One page in a browser."""

    page: "Page"
    session: "CDPSession"

    def visit(self, address: str) -> None:
        """Load a page."""
        self.page.goto(address)

    def run(self, program: str) -> Any:
        """Return the value of an expression or function in the page."""
        return self.page.evaluate(program)

    def until(self, condition: str) -> None:
        """Wait until a function of the page returns a true value.

        It has to be a function: pages whose content security policy forbids `eval` know no other.

        Raises:
            NoBrowser: it is not, within a minute.
        """
        from playwright.sync_api import TimeoutError as TooLate

        try:
            self.page.wait_for_function(condition, timeout=1000.0 * PATIENCE)
        except TooLate:
            raise NoBrowser(f"the page does not come to {condition!r}") from None

    def wait(self, seconds: float) -> None:
        """Let the page go on for some time [s]."""
        self.page.wait_for_timeout(1000.0 * seconds)

    def heap(self) -> int:
        """Return the memory of the page's program after a collection [bytes]."""
        self.session.send("Performance.enable")
        self.session.send("HeapProfiler.collectGarbage")
        told = self.session.send("Performance.getMetrics")["metrics"]
        return int(next(one["value"] for one in told if one["name"] == "JSHeapUsedSize"))


@contextmanager
def opened() -> Iterator[Window]:
    """Yield a page in a new browser, which is closed at the end.

    Raises:
        NoBrowser: none is installed, or playwright is not.
    """
    try:
        from playwright.sync_api import sync_playwright
    except ModuleNotFoundError:
        raise NoBrowser(
            "playwright is not installed: pip install 'xavi-dialogue[browser]'"
        ) from None
    where = program()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=where, args=options())
        try:
            page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]})
            yield Window(page, page.context.new_cdp_session(page))
        finally:
            browser.close()
