"""Charts over time as SVG: lines, a vertical mark at the moment, ticks of decisions, bands."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from xavi_dialogue.report.render.markup import EMPTY, Markup, tag

WIDE, HIGH = 600.0, 130.0  # [px] plotting area
LEFT, RIGHT, TOP, BELOW = 52.0, 128.0, 20.0, 34.0  # [px] around it
STEPS = (1.0, 2.0, 5.0, 10.0, 20.0, 25.0, 50.0, 100.0, 200.0)
TICKS = 5
APART = 20.0  # [px] between the labels of decisions
GREY = "#666"


@dataclass(frozen=True, slots=True)
class Line:
    """One curve."""

    name: str
    points: tuple[tuple[float, float], ...]  # time [s], value
    colour: str
    stroke: str | None = None
    dots: bool = False


@dataclass(frozen=True, slots=True)
class Axes:
    """The time axis, shared by all charts of a report."""

    since: float  # [s]
    until: float  # [s]
    moment: float  # [s]
    decisions: tuple[tuple[int, float], ...]  # number and time [s]

    def across(self, time: float) -> float:
        """Return where [px] a time is."""
        return LEFT + WIDE * (time - self.since) / max(self.until - self.since, 1e-6)


def chart(
    axes: Axes,
    title: str,
    lines: Sequence[Line],
    *,
    low: float | None = 0.0,
    high: float | None = None,
) -> Markup:
    """Return a chart of lines.

    Args:
        axes: the time axis.
        title: with the unit.
        lines: to draw, those of the same name once in the legend.
        low: least value of the axis; None: by the lines.
        high: greatest value; None: by the lines.
    """
    values = [value for line in lines for _, value in line.points]
    floor = min(values, default=0.0) if low is None else low
    top = max(values, default=1.0) if high is None else high
    step = next((s for s in STEPS if (top - floor) / s <= TICKS), STEPS[-1])
    floor = math.floor(floor / step) * step
    top = max(math.ceil(top / step - 1e-9) * step, floor + step)

    def up(value: float) -> float:
        return TOP + HIGH * (1.0 - (value - floor) / (top - floor))

    grid = []
    for k in range(round((top - floor) / step) + 1):
        value = floor + k * step
        grid.append(_rule(LEFT, up(value), LEFT + WIDE, up(value), "#ddd"))
        grid.append(_text(LEFT - 6.0, up(value) + 4.0, f"{value:g}".replace("-", "−"), "end"))
    curves = [_curve(axes, line, up) for line in lines]
    return _framed(axes, title, HIGH, (*grid, *curves), _legend(lines))


def bands(
    axes: Axes, title: str, rows: Sequence[tuple[str, Sequence[tuple[float, float, str, str]]]]
) -> Markup:
    """Return rows of bands; each band has begin, end [s], colour and a text in it."""
    high = 24.0 * len(rows)
    drawn: list[Markup] = []
    for k, (name, spans) in enumerate(rows):
        top = TOP + 24.0 * k + 3.0
        drawn.append(_text(LEFT + WIDE + 8.0, top + 13.0, name, "start"))
        for begin, end, colour, text in spans:
            x0, x1 = axes.across(max(begin, axes.since)), axes.across(min(end, axes.until))
            wide = max(x1 - x0, 2.0)
            drawn.append(tag("rect", x=x0, y=top, width=wide, height=18.0, fill=colour))
            if wide > 8.0 * len(text):
                drawn.append(_text(x0 + wide / 2.0, top + 13.0, text, "middle", fill="#fff"))
    return _framed(axes, title, high, drawn, EMPTY)


def _framed(axes: Axes, title: str, high: float, body: Sequence[Markup], legend: Markup) -> Markup:
    """Return a drawing with the time axis, the moment, and ticks of decisions."""
    floor = TOP + high
    parts = [_text(LEFT, 13.0, title, "start", weight="bold"), *body]
    for second in range(math.ceil(axes.since - 1e-9), math.floor(axes.until + 1e-9) + 1):
        x = axes.across(float(second))
        parts.append(_rule(x, floor, x, floor + 4.0, GREY))
        parts.append(_text(x, floor + 15.0, f"{second}", "middle"))
    labelled = -math.inf
    for number, time in axes.decisions:
        x = axes.across(time)
        parts.append(tag("path", d=f"M{x:.1f},{floor + 18.0:.1f} l3,6 l-6,0 z", fill=GREY))
        if x - labelled >= APART:
            parts.append(_text(x, floor + 32.0, f"D{number}", "middle", size="8"))
            labelled = x
    x = axes.across(axes.moment)
    parts.append(tag("line", x1=x, y1=TOP - 4.0, x2=x, y2=floor, stroke="#000",
                     stroke_width="1.5", stroke_dasharray="3 2"))  # fmt: skip
    parts.append(_rule(LEFT, floor, LEFT + WIDE, floor, GREY))
    parts.append(_text(LEFT + WIDE + 8.0, floor + 15.0, "time [s]", "start"))
    width, height = LEFT + WIDE + RIGHT, floor + BELOW + 4.0
    return tag("svg", *parts, legend, viewBox=f"0 0 {width:g} {height:g}", role="img",
               aria_label=title, class_="chart", xmlns="http://www.w3.org/2000/svg")  # fmt: skip


def _curve(axes: Axes, line: Line, up: Callable[[float], float]) -> Markup:
    places = [(axes.across(time), up(value), time) for time, value in line.points]
    way, last = [], None
    for x, y, time in places:
        begins = last is None or (time - last > 0.5 and not line.dots)
        way.append(f"{'M' if begins else 'L'}{x:.1f},{y:.1f}")
        last = time
    path = tag("path", d=" ".join(way), fill="none", stroke=line.colour, stroke_width="2",
               stroke_dasharray=line.stroke)  # fmt: skip
    dots = (tag("circle", cx=x, cy=y, r="2.6", fill=line.colour) for x, y, _ in places if line.dots)
    return tag("g", path, *dots)


def _legend(lines: Sequence[Line]) -> Markup:
    parts, top = [], TOP + 8.0
    for line in {line.name: line for line in lines}.values():
        left = LEFT + WIDE + 8.0
        parts.append(tag("line", x1=left, y1=top, x2=left + 22.0, y2=top, stroke=line.colour,
                         stroke_width="2", stroke_dasharray=line.stroke))  # fmt: skip
        parts.append(_text(left + 27.0, top + 4.0, line.name, "start"))
        top += 16.0
    return tag("g", *parts)


def _rule(x1: float, y1: float, x2: float, y2: float, colour: str) -> Markup:
    return tag("line", x1=x1, y1=y1, x2=x2, y2=y2, stroke=colour)


def _text(
    x: float,
    y: float,
    text: str,
    anchor: str,
    *,
    weight: str | None = None,
    fill: str | None = None,
    size: str | None = None,
) -> Markup:
    return tag("text", text, x=x, y=y, text_anchor=anchor, font_weight=weight, fill=fill,
               font_size=size)  # fmt: skip
