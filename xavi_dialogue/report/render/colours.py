"""Colours and strokes of road users, the same in all drawings; also apart in black and white."""

from collections.abc import Sequence

from sim.scene import EGO

OWN = "#14508c"
OTHERS = ("#c0392b", "#2e7d4f", "#8e5ea2", "#b8860b", "#4a4a4a")
STROKES = ("", "7 3", "2 3", "8 3 2 3", "4 4", "1 4")
REST = "#b5b5b5"  # who is not involved
LIGHTS = {
    "r": "#d62828",
    "u": "#f08c00",
    "y": "#f4c20d",
    "G": "#2a9d3a",
    "g": "#2a9d3a",
    "s": "#d62828",
    "o": "#f08c00",
    "O": "#888888",
}


def colour(vehicle: int, involved: Sequence[int]) -> str:
    """Return the colour of a road user."""
    if vehicle == EGO:
        return OWN
    if vehicle not in involved:
        return REST
    return OTHERS[list(involved).index(vehicle) % len(OTHERS)]


def stroke(vehicle: int, involved: Sequence[int]) -> str | None:
    """Return the pattern of a road user's lines."""
    at = 0 if vehicle == EGO or vehicle not in involved else list(involved).index(vehicle) + 1
    return STROKES[at % len(STROKES)] or None
