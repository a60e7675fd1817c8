"""Quantities: numbers with their units, rounded and written as a passenger would say them."""

import math

from xavi_dialogue.nlg.surface.chances import percent
from xavi_dialogue.nlg.surface.tables import table
from xavi_dialogue.nlg.surface.values import Number, Quantity, Range

KMH = 3.6  # [km/h] per [m/s]
MINUTES = 100.0  # [s] from which a time is stated in minutes
HOUR = 3600.0  # [s]
JUST = 2.5  # [s] maximum age of what happened "just now"
RECENT = 9.0  # [s] maximum age that is stated in seconds; older times are stated by the clock
ROUNDING = 1e-6  # [s]
SMALL = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
         "eleven", "twelve")  # fmt: skip
EXACT = ("less ", "over ", "under ", "more ", "half ", "a moment")  # these take no "about"


def quantity(amount: Quantity, form: str = "plain") -> str:
    """Return a quantity in words.

    Args:
        amount: the number with its unit.
        form: "plain"; "about" for rounded numbers; "number" without its unit.
    """
    text = _spelt(amount)
    if form == "number":
        return text.split(" ")[0]
    if form == "about" and not text.startswith(EXACT):
        return f"about {text}"
    return text


def span(amounts: Range, form: str = "to") -> str:
    """Return both ends, with their unit once: "from 47 to 20 km/h", "2 to 4 seconds"."""
    low, high = quantity(amounts.low), quantity(amounts.high)
    if low == high:
        return low
    first, _, unit = low.partition(" ")
    if unit and high.partition(" ")[2].rstrip("s") == unit.rstrip("s"):
        low = first
    joint = "and" if form == "and" else "to"
    return f"{low} {joint} {high}"


def number(amount: Number, form: str = "plain") -> str:
    """Return a count with its noun in the right number: "one car", "two cars", "no cars"."""
    noun = amount.noun if amount.count == 1 else plural(amount.noun)
    numeral = SMALL[amount.count] if 0 <= amount.count < len(SMALL) else str(amount.count)
    return {"word": numeral, "noun": noun}.get(form, f"{numeral} {noun}")


def plural(noun: str) -> str:
    """Return the plural of a noun phrase that ends with its noun."""
    head, _, last = noun.rpartition(" ")
    known = table("vehicles")["plural"].get(last)
    return f"{head} {known or last + 's'}".strip()


def nearest(value: float, step: float = 1) -> float:
    """Return the nearest multiple of a step, halves upwards."""
    return math.floor(value / step + 0.5) * step


def clock(value: float) -> str:
    """Return a time of the ride in minutes and full seconds."""
    whole = math.floor(max(value, 0.0) + ROUNDING)
    minutes, seconds = divmod(whole, 60)
    if whole < HOUR:
        return f"{minutes}:{seconds:02d}"
    return f"{minutes // 60}:{minutes % 60:02d}:{seconds:02d}"


def moment(time: float, now: float, form: str = "plain") -> str:
    """Return a time of the ride: "just now", "about 5 seconds ago", "at 0:12", "in 4 seconds"."""
    if form == "bare":
        return clock(time)
    if form == "clock":
        return f"at {clock(time)}"
    ago = now - time
    if form == "since":
        return f"since {clock(time)}"
    if abs(ago) < 0.5:
        return "now"
    if ago < 0:
        return "in a moment" if ago > -1.5 else f"in {quantity(Quantity(-ago, 's'), 'about')}"
    if ago <= JUST:
        return "just now"
    if ago <= RECENT:
        return f"{quantity(Quantity(ago, 's'), 'about')} ago"
    return f"at {clock(time)}"


def _spelt(amount: Quantity) -> str:
    value = amount.value
    match amount.unit:
        case "m/s":
            return f"{nearest(abs(value) * KMH):.0f} km/h"
        case "m":
            return _metres(abs(value))
        case "s":
            return _seconds(abs(value))
        case "m/s2":
            return f"{abs(value):.1f} m/s²"
        case "m/s3":
            return f"{abs(value):.1f} m/s³"
        case "%":
            return percent(value)
        case "clock":
            return clock(value)
        case "count":
            return f"{nearest(value):.0f}"


def _seconds(value: float) -> str:
    if value >= HOUR:
        return "more than an hour"
    if value >= MINUTES:
        return f"{nearest(value / 60):.0f} minutes"
    rounded = nearest(value) if value >= 3 else nearest(value, 0.5)
    if rounded == 0:
        return "less than half a second"
    if rounded == 0.5:
        return "half a second"
    return "1 second" if rounded == 1 else f"{rounded:g} seconds"


def _metres(value: float) -> str:
    if value < 0.05:
        return "less than 10 centimetres"
    if value < 0.95:
        return f"{max(nearest(value * 100, 10), 10):.0f} centimetres"
    if value >= 950:
        return f"{nearest(value / 1000, 0.1):.1f} kilometres"
    step = 0.1 if value < 2 else 0.5 if value < 5 else 1 if value < 20 else 5 if value < 100 else 10
    rounded = nearest(value, step)
    return "1 metre" if rounded == 1 else f"{round(rounded, 1):g} metres"
