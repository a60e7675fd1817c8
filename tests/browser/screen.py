"""The page as its readers see it: what is on it, found by what a screen reader is told of it."""

import re
from typing import Any
from urllib.parse import urlsplit

from playwright.sync_api import ConsoleMessage, Locator, Page, Response, expect

PATIENCE = 45_000.0  # [ms] for what comes by itself, on a machine that is busy with other things
LOST = r"WebSocket connection to .* failed|net::ERR_(CONNECTION|EMPTY|INCOMPLETE|SOCKET)"
#: Takes down what the content security policy blocks.
WATCH = """
window.__violations = [];
addEventListener("securitypolicyviolation", (event) =>
  window.__violations.push(`${event.violatedDirective} ${event.blockedURI}`));
"""


class Screen:
    """One browser window that shows a dashboard; takes down all that goes wrong in it."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.said: list[str] = []  # by the browser
        self.wrong: list[str] = []  # of that, what no page should have
        self.requests: list[str] = []
        self._forgiven: list[str] = []
        page.set_default_timeout(PATIENCE)
        page.add_init_script(WATCH)
        page.on("console", self._hear)
        page.on("pageerror", lambda error: self._note(f"error: {error.stack or error}", True))
        page.on("request", lambda request: self.requests.append(request.url))
        page.on("response", self._look)

    # What goes wrong:

    def forgive(self, pattern: str) -> None:
        """Expect errors of the console that match, because the test brings them about."""
        self._forgiven.append(pattern)

    def faults(self) -> list[str]:
        """Errors that were not expected, content that was blocked, requests to elsewhere."""
        allowed = re.compile("|".join(self._forgiven or [r"(?!)"]))
        wrong = [text for text in self.wrong if not allowed.search(text)]
        blocked = self.page.evaluate("window.__violations ?? []")
        home = urlsplit(self.page.url).netloc
        elsewhere = [url for url in self.requests if urlsplit(url).netloc not in (home, "")]
        return [*wrong, *blocked, *elsewhere]

    def _hear(self, message: ConsoleMessage) -> None:
        self._note(f"{message.type}: {message.text}", message.type in ("error", "assert"))

    def _look(self, response: Response) -> None:
        if response.status >= 400:
            self._note(f"{response.status} of {response.url}", False)

    def _note(self, text: str, wrong: bool) -> None:
        self.said.append(text)
        if wrong:
            self.wrong.append(text)

    # What the page knows:

    def ask_page(self, program: str, argument: object = None) -> Any:
        """What an expression of the page comes to."""
        return self.page.evaluate(program, argument)

    def until(self, condition: str, argument: object = None) -> None:
        """Wait until an expression of the page is true."""
        self.page.wait_for_function(condition, arg=argument)

    @property
    def shown(self) -> dict[str, Any]:
        """What is on the map."""
        found: dict[str, Any] = self.page.evaluate("window.xavi.map.shown()")
        return found

    def until_map(self, condition: str) -> None:
        """Wait until something is true of what is on the map, which the condition calls `map`."""
        self.until(
            f"() => {{ const map = window.xavi?.map?.shown(); return map && ({condition}) }}"
        )

    def until_at(self, least: float) -> None:
        """Wait until a moment [s] of the ride is there."""
        self.until("least => window.xavi?.store.latest?.t >= least", least)

    def until_over(self) -> None:
        """Wait until the ride is over."""
        self.until("() => window.xavi?.store.latest?.state === 'ended'")

    def until_open(self) -> None:
        """Wait until it is connected to the dashboard."""
        self.until("() => window.xavi?.connection.state === 'open'")

    # The conversation:

    @property
    def question(self) -> Locator:
        return self.page.locator("#talk").get_by_role("textbox")

    @property
    def log(self) -> Locator:
        return self.page.locator("#talk").get_by_role("log")

    def turn(self, number: int) -> Locator:
        """A turn of the conversation."""
        return self.log.locator(f"article[data-n='{number}']")

    def ask(self, text: str) -> None:
        """Type a question, and press Enter."""
        self.question.fill(text)
        self.question.press("Enter")

    def ask_and_hear(self, text: str) -> dict[str, Any]:
        """Ask, and wait for the turn that holds the answer."""
        before = self.count
        self.ask(text)
        return self.heard(text, before)

    def heard(self, text: str, before: int) -> dict[str, Any]:
        """The turn in which a question stands, once it is there.

        Args:
            text: of the question.
            before: how many turns there were before it was asked.
        """
        condition = (
            "([text, n]) => window.xavi.store.turns.slice(n).some((one) => one.text === text)"
        )
        self.until(condition, [text, before])
        return next(turn for turn in self.turns()[before:] if turn["text"] == text)

    @property
    def count(self) -> int:
        """How many turns the page knows."""
        return int(self.page.evaluate("window.xavi.store.turns.length"))

    def turns(self) -> list[dict[str, Any]]:
        """The turns that the page knows."""
        found: list[dict[str, Any]] = self.page.evaluate("window.xavi.store.turns")
        return found

    def button(self, name: str | re.Pattern[str], within: str = "body") -> Locator:
        return self.page.locator(within).get_by_role("button", name=name)

    # The timeline:

    @property
    def slider(self) -> Locator:
        return self.page.locator("#timeline").get_by_role("slider")

    @property
    def at(self) -> float:
        """The moment [s] that is shown."""
        return float(self.page.evaluate("window.xavi.store.at"))

    @property
    def live(self) -> bool:
        return bool(self.page.evaluate("window.xavi.store.live"))

    def drag_to(self, time: float) -> None:
        """Drag the timeline's knob to a moment [s]."""
        box = self.slider.bounding_box()
        view = self.page.evaluate("window.xavi.timeline.view()")
        assert box is not None
        mouse, middle = self.page.mouse, box["y"] + box["height"] / 2

        def place(moment: float) -> float:
            return float(box["x"] + box["width"] * (moment - view["start"]) / view["length"])

        mouse.move(place(self.at), middle)
        mouse.down()
        mouse.move(place((self.at + time) / 2), middle, steps=5)
        mouse.move(place(time), middle, steps=5)
        mouse.up()

    def tab(self, name: str) -> None:
        """Choose a tab, where there are tabs."""
        tab = self.page.get_by_role("tab", name=name)
        if tab.is_visible():
            tab.click()
            expect(tab).to_have_attribute("aria-selected", "true")
