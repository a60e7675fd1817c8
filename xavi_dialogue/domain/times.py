"""Times: the terms for times that contain no other terms; see `terms` for the rest."""

from typing import Literal

from xavi_dialogue.domain.base import Value


class Now(Value, frozen=True):
    """The moment of the question: "now", "currently", "at the moment"."""


class Unsaid(Value, frozen=True):
    """No time was named: tense and discourse decide."""


class At(Value, frozen=True):
    """A time of the ride: "at 0:12", "at 12 seconds"."""

    at: float  # [s] simulation time


class Ago(Value, frozen=True):
    """A time before now: "five seconds ago", "just now" (None: a few seconds)."""

    seconds: float | None = None  # [s]
    span: bool = False  # the whole interval up to now: "in the last ten seconds"


class AtDecision(Value, frozen=True):
    """The time of a decision by its number in the record: "at decision 4"."""

    number: int
    last: int | None = None  # "between decisions 4 and 6"; beyond the latest: up to now


class Within(Value, frozen=True):
    """A time after now: "in five seconds", "soon" (None)."""

    seconds: float | None = None  # [s]


class Between(Value, frozen=True):
    """An interval of the ride."""

    begin: float  # [s]
    end: float  # [s] beyond now: up to now


class Back(Value, frozen=True):
    """The time of the episode under discussion, or before or after it: "then", "before that".

    What was "earlier" was before now, whatever is under discussion. What was "between" was from
    one moment that was told to the next: "between those two moments".
    """

    relation: Literal["during", "before", "after", "earlier", "between"] = "during"
    seconds: float | None = None  # [s] that long before: "two seconds earlier"


class Rank(Value, frozen=True):
    """Which of several times: "the first time", "the second time", "last time"."""

    rank: int  # -1 the last


class Start(Value, frozen=True):
    """The beginning of the ride."""


class WholeRide(Value, frozen=True):
    """All of the ride so far: "so far", "ever", "the whole trip", "until now"."""


class Next(Value, frozen=True):
    """The future after now: "next", "from now on", "later"."""
