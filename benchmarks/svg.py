"""Line charts as plain SVG, in panels side by side."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape

WIDE, HIGH = 240.0, 170.0  # [px] plotting area of a panel
LEFT, TOP, BELOW = 52.0, 34.0, 42.0  # [px] around it
COLOURS = ("#1b6ca8", "#d1495b", "#66a182", "#7d5ba6")
TICKS = 4
USED = 0.92  # share of the plotting area that curves use


@dataclass(frozen=True, slots=True)
class Line:
    """One curve."""

    name: str
    points: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Panel:
    """One chart; both axes begin at zero."""

    title: str
    x: str
    y: str
    lines: tuple[Line, ...]


def chart(panels: Sequence[Panel]) -> str:
    """Return the panels side by side, as an SVG document with a legend."""
    width = len(panels) * (LEFT + WIDE) + 20.0
    height = TOP + HIGH + BELOW + 22.0
    body = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}" height="{height:g}"'
        f' viewBox="0 0 {width:g} {height:g}" font-family="sans-serif" font-size="11">',
        f'<rect width="{width:g}" height="{height:g}" fill="white"/>',
    ]
    for k, panel in enumerate(panels):
        body += _panel(panel, k * (LEFT + WIDE) + LEFT)
    names = [line.name for line in panels[0].lines] if panels else []
    body += _legend(names, height - 10.0)
    return "\n".join((*body, "</svg>", ""))


def _panel(panel: Panel, left: float) -> Iterator[str]:
    points = [point for line in panel.lines for point in line.points]
    most_x = max((x for x, _ in points), default=0.0) or 1.0
    most_y = max((y for _, y in points), default=0.0) or 1.0
    floor, end = TOP + HIGH, left + WIDE - 14.0

    def place(x: float, y: float) -> tuple[float, float]:
        return left + WIDE * USED * x / most_x, floor - HIGH * USED * y / most_y

    yield _text(left, TOP - 16.0, panel.title, "start", bold=True)
    yield f'<path d="M{left:g},{TOP:g} V{floor:g} H{end:g}" fill="none" stroke="#444"/>'
    yield _text(left + WIDE * USED / 2.0, floor + 30.0, panel.x, "middle")
    yield _text(left - 5.0, TOP - 2.0, panel.y, "end")
    for k in range(TICKS + 1):
        x, y = most_x * k / TICKS, most_y * k / TICKS
        across, up = place(x, y)
        yield _text(across, floor + 14.0, f"{x:.3g}", "middle")
        yield _text(left - 5.0, up + 4.0, f"{y:.3g}", "end")
    for line, colour in zip(panel.lines, COLOURS, strict=False):
        yield from _curve([place(x, y) for x, y in line.points], colour)


def _curve(places: Sequence[tuple[float, float]], colour: str) -> Iterator[str]:
    way = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
    yield f'<polyline points="{way}" fill="none" stroke="{colour}" stroke-width="2"/>'
    for x, y in places:
        yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.5" fill="{colour}"/>'


def _legend(names: Sequence[str], height: float) -> Iterator[str]:
    for k, (name, colour) in enumerate(zip(names, COLOURS, strict=False)):
        left = LEFT + k * 120.0
        yield f'<rect x="{left:g}" y="{height - 8.0:g}" width="14" height="4" fill="{colour}"/>'
        yield _text(left + 20.0, height - 2.0, name, "start")


def _text(x: float, y: float, text: str, anchor: str, *, bold: bool = False) -> str:
    weight = ' font-weight="bold"' if bold else ""
    place = f'x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"'
    return f"<text {place}{weight}>{escape(text)}</text>"
