"""Source notes: every figure gets the number of the note that names its source."""

import math

from xavi_dialogue.report.figures import Figure, Source
from xavi_dialogue.report.render.markup import Markup, joined, tag

KMH = 3.6
UNITS = {"m/s": "km/h", "m/s2": "m/s²", "rad": "°"}
SCALES = {"m/s": KMH, "rad": math.degrees(1.0)}  # from the unit that is recorded
DIGITS = {"m/s": 1, "m/s2": 1, "m": 1, "s": 1, "rad": 0}
TIE = "\N{NO-BREAK SPACE}"  # between a number and its unit
SMALLEST = 0.001  # probability that is told apart from 0


def number(value: float, unit: str) -> str:
    """Return a number in the unit that is shown, without the unit."""
    if unit == "":
        return percent(value)
    shown = value * SCALES.get(unit, 1.0)
    return f"{shown:.{DIGITS.get(unit, 2)}f}".replace("-", "\N{MINUS SIGN}")


def percent(value: float) -> str:
    """Return a probability."""
    if 0.0 < value < SMALLEST:
        return f"<0.1{TIE}%"
    if 1.0 - SMALLEST < value < 1.0:
        return f">99.9{TIE}%"
    digits = 0 if value in (0.0, 1.0) or 0.1 <= value <= 0.9 else 1
    return f"{100.0 * value:.{digits}f}{TIE}%"


def told(figure: Figure) -> str:
    """Return a figure with its unit and its interval, without its source."""
    unit = UNITS.get(figure.unit, figure.unit)
    value = number(figure.value, figure.unit)
    text = f"{value}{TIE}{unit}" if unit else value
    if figure.low is None or figure.high is None:
        return text
    low, high = (number(end, figure.unit) for end in (figure.low, figure.high))
    return text if low == high == value else f"{text} ({low} to {high})"


class Notes:
    """The notes of a report, numbered in the order in which they are first needed."""

    def __init__(self) -> None:
        """Begin without notes."""
        self._numbers: dict[tuple[Source, str], int] = {}

    def figure(self, figure: Figure | None, absent: str = "–") -> Markup:
        """Return a figure with the number of its note."""
        if figure is None:
            return joined((absent,))
        return joined((told(figure), self.ref(figure.source, figure.interval)))

    def ref(self, source: Source, interval: str = "") -> Markup:
        """Return the number of the note on a source."""
        known = self._numbers.setdefault((source, interval), len(self._numbers) + 1)
        return tag("a", str(known), href=f"#source-{known}", class_="note")

    def all(self) -> Markup:
        """Return the list of all notes."""
        rows = (
            tag("li", _words(source, interval), id=f"source-{known}", value=str(known))
            for (source, interval), known in self._numbers.items()
        )
        return tag("ol", *rows, class_="notes")


def _words(source: Source, interval: str) -> Markup:
    """Return a source in words."""
    at = "" if source.time is None else f" at {source.time:g} s"
    match source.place:
        case "decision":
            where = f"decision {source.number}{at}"
        case "replan":
            where = f"decision {source.number}{at}, planned again (trace {source.trace})"
        case "event":
            where = f"event {source.number}{at}"
        case "scene":
            where = f"scene{at}"
        case _:
            where = "ride"
    how = f": {source.how}" if source.how else ""
    ends = f"; in brackets: {interval}" if interval else ""
    return joined((f"{where}, ", tag("code", source.field), f"{how}{ends}"))
