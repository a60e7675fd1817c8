"""Attributes: unit, and what counts as the same, of each; once for all answers."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from xavi_dialogue.domain.vocabulary import Attribute

Unit = Literal["m/s", "m", "s", "m/s2", "m/s3", "share", "count", "reward", "word", ""]


@dataclass(frozen=True, slots=True)
class Kind:
    """What kind of value an attribute has."""

    unit: Unit  # of its value; "word": it has a word, and perhaps a value beside it
    tolerance: float = 0.0  # difference up to which two values are the same
    pair: bool = False  # it is between two things


ATTRIBUTES: Mapping[Attribute, Kind] = {
    "speed": Kind("m/s", 0.5),
    "limit": Kind("m/s", 0.1),
    "speed-change": Kind("m/s", 0.5),
    "excess": Kind("m/s", 0.3),
    "acceleration": Kind("m/s2", 0.3),
    "deceleration": Kind("m/s2", 0.3),
    "gap": Kind("m", 1.0, pair=True),
    "headway": Kind("s", 0.2, pair=True),
    "distance": Kind("m", 1.0, pair=True),
    "time-to-collision": Kind("s", 0.3, pair=True),
    "lane": Kind("count"),
    "lane-count": Kind("count"),
    "indicator": Kind("word"),
    "brake-lights": Kind("word"),
    "colour": Kind("word"),
    "kind": Kind("word"),
    "size": Kind("m", 0.5),
    "name": Kind("count"),
    "place": Kind("word", pair=True),
    "origin": Kind("word"),
    "heading": Kind("word"),
    "right-of-way": Kind("word", pair=True),
    "visibility": Kind("word"),
    "distance-to-go": Kind("m", 5.0),
    "distance-driven": Kind("m", 5.0),
    "time-to-go": Kind("s", 1.0),
    "arrival-time": Kind("s", 1.0),
    "time": Kind("s", 0.5),
    "waiting-time": Kind("s", 0.5, pair=True),
    "duration": Kind("s", 0.5),
    "delay": Kind("s", 0.5),
    "probability": Kind("share", 0.05),
    "value": Kind("reward", 0.05),
    "comfort": Kind("m/s2", 0.3),
    "jerk": Kind("m/s3", 0.5),
    "cost": Kind("reward", 0.05),
    "exit-number": Kind("count"),
    "turn": Kind("word"),
    "route": Kind("count"),
    "count": Kind("count"),
    "weather": Kind(""),
    "battery": Kind(""),
    "money": Kind(""),
    "law": Kind(""),
    "world": Kind(""),
    "load": Kind(""),
    "occupant": Kind(""),
    "writing": Kind(""),
    "parts": Kind(""),
}


def same(attribute: Attribute, one: float, other: float) -> bool:
    """Whether two values of an attribute are the same, as people count it."""
    return abs(one - other) <= ATTRIBUTES[attribute].tolerance + 1e-9
