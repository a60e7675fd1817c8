"""Where the other vehicles are, seen from our car: explain.bearings, as the dialogue uses it."""

from xavi_dialogue.explain.bearings import (
    Bearing,
    Place,
    Vehicles,
    bearing,
    nearest_at,
    nearest_first,
    place,
)

__all__ = ["Bearing", "Place", "Vehicles", "bearing", "nearest_at", "nearest_first", "place"]
