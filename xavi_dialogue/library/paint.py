"""The colours of things, by the words for paint that scenes hold."""

from types import MappingProxyType
from typing import TypeAlias

Rgb: TypeAlias = tuple[float, float, float]  # from 0 to 1

OURS: Rgb = (0.05, 0.65, 0.62)
OTHERS: Rgb = (0.62, 0.64, 0.68)
ON_FOOT: Rgb = (0.98, 0.62, 0.25)
GHOST: Rgb = (0.85, 0.25, 0.78)
BELIEF: Rgb = (0.93, 0.53, 0.05)

#: Paint by its word; what is not listed looks grey.
PAINT = MappingProxyType(
    {
        "red": (0.82, 0.16, 0.15),
        "blue": (0.18, 0.42, 0.82),
        "green": (0.15, 0.58, 0.28),
        "yellow": (0.95, 0.80, 0.15),
        "orange": (0.95, 0.52, 0.12),
        "white": (0.95, 0.95, 0.95),
        "black": (0.10, 0.10, 0.11),
        "grey": (0.50, 0.52, 0.55),
        "silver": (0.75, 0.77, 0.80),
        "brown": (0.45, 0.29, 0.17),
        "beige": (0.87, 0.80, 0.66),
        "purple": (0.48, 0.25, 0.66),
        "pink": (0.95, 0.55, 0.70),
        "turquoise": (0.20, 0.72, 0.72),
    }
)
