"""Pictures of the dashboard, for people who have not seen it.

python -m tests.browser.shots FOLDER
"""

import struct
import sys
import tempfile
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, expect, sync_playwright

from benchmarks.service.browser import options, program
from tests.browser.screen import Screen
from tests.browser.served import S1, dashboard
from tests.drills.processes import Crew

QUESTION = "Why did you change lanes instead of going straight?"
MOMENT = 4.4  # [s] the lane change is under way, and both lines lie ahead
DESKTOP = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}
PICTURES: dict[str, dict[str, Any]] = {
    "dashboard-desktop": {"viewport": DESKTOP, "color_scheme": "light"},
    "dashboard-dark": {"viewport": DESKTOP, "color_scheme": "dark"},
    "dashboard-phone": {
        "viewport": PHONE,
        "color_scheme": "light",
        "device_scale_factor": 2,
        "is_mobile": True,
        "has_touch": True,
    },
}
MOST = 400_000  # bytes of a picture
TWO_FRAMES = """() => new Promise((tell) =>
  requestAnimationFrame(() => requestAnimationFrame(tell)))"""
SIGNATURE = b"\x89PNG\r\n\x1a\n"


def ride(browser: Browser, address: str) -> int:
    """Have the ride driven, and ask; the number of the turn."""
    screen = Screen(browser.new_page())
    screen.page.goto(address)
    screen.until_over()
    turn = screen.ask_and_hear(QUESTION)
    screen.page.close()
    return int(turn["n"])


def take(browser: Browser, address: str, turn: int, context: dict[str, Any]) -> bytes:
    """A picture of the page that shows a turn, at a moment of the ride; nothing in it moves."""
    page = browser.new_context(**context, reduced_motion="reduce").new_page()
    screen = Screen(page)
    page.goto(address)
    screen.until_over()
    screen.until("() => window.xavi.store.roads !== null")
    screen.button("Hide this", "#strip").click()
    screen.ask_page("time => window.xavi.store.seek(time)", MOMENT)
    screen.ask_page("number => window.xavi.store.show(number)", turn)
    article = screen.turn(turn)
    article.get_by_role("button", name="Evidence").click()
    expect(article.get_by_role("table").first).to_be_attached()
    screen.until_map("map.ghost > 0")
    suggested = "time => Math.abs(window.xavi.store.suggestions.t - time) < 0.1"
    screen.until(suggested, MOMENT)
    article.locator(".reply").evaluate("one => one.scrollIntoView({block: 'start'})")
    page.mouse.move(1, 1)
    page.evaluate("document.activeElement.blur()")
    screen.until("() => document.fonts.status === 'loaded'")
    page.evaluate(TWO_FRAMES)
    picture = page.screenshot()
    assert screen.faults() == []
    page.context.close()
    return picture


def packed(picture: bytes) -> bytes:
    """The same picture in fewer bytes."""
    chunks = list(_chunks(picture))
    pixels = zlib.decompress(b"".join(data for name, data in chunks if name == b"IDAT"))
    head = [(name, data) for name, data in chunks if name == b"IHDR"]
    body = [(b"IDAT", zlib.compress(pixels, 9)), (b"IEND", b"")]
    return SIGNATURE + b"".join(
        struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        for name, data in (*head, *body)
    )


def _chunks(picture: bytes) -> Iterator[tuple[bytes, bytes]]:
    place = len(SIGNATURE)
    while place < len(picture):
        (length,) = struct.unpack_from(">I", picture, place)
        yield picture[place + 4 : place + 8], picture[place + 8 : place + 8 + length]
        place += 12 + length


def main() -> None:
    folder = Path(sys.argv[1])
    with tempfile.TemporaryDirectory() as scratch, sync_playwright() as playwright:
        crew = Crew(Path(scratch))
        browser = playwright.chromium.launch(executable_path=program(), args=options())
        try:
            shown = dashboard(crew, *S1, "--speed", "0")
            turn = ride(browser, shown.address)
            for name, context in PICTURES.items():
                picture = packed(take(browser, shown.address, turn, context))
                assert len(picture) <= MOST, f"{name} has {len(picture)} bytes"
                (folder / f"{name}.png").write_bytes(picture)
                sys.stderr.write(f"{folder / name}.png: {len(picture)} bytes\n")
            crew.dismiss()
        finally:
            browser.close()
            crew.clear()


if __name__ == "__main__":
    main()
