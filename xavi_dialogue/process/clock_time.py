"""Clock times: moments of a ride as people write them, such as 65, 65 s or 1:05."""

import math
import re
from numbers import Real

CLOCK = re.compile(r"(\d{1,6}):([0-5]\d(?:\.\d+)?)", re.ASCII)  # minutes and seconds


def seconds_of(given: object) -> float | None:
    """Return the time [s] that is meant: a number, or a text such as 65, 65 s or 1:05."""
    if isinstance(given, bool) or not isinstance(given, str | Real):
        return None
    minutes, text = 0, given
    if isinstance(given, str):
        split = CLOCK.fullmatch(given.strip())
        minutes, text = (int(split[1]), split[2]) if split else (0, given.strip().removesuffix("s"))
    try:
        time = 60.0 * minutes + float(text)
    except ValueError:
        return None
    return None if math.isnan(time) else time
