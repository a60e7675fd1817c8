"""Colours and heights of what viewers draw."""

from types import MappingProxyType

from sim.scene import EGO, LightState, PersonState, VehicleState
from xavi_dialogue.viewers.messages import Colour

ROAD: Colour = (0.30, 0.32, 0.35, 1.0)
ROAD_OF_OTHERS: Colour = (0.42, 0.38, 0.36, 1.0)
CROSSING: Colour = (0.80, 0.80, 0.80, 1.0)
MARKING: Colour = (0.92, 0.92, 0.92, 0.9)
TEXT: Colour = (1.0, 1.0, 1.0, 1.0)
OWN: Colour = (0.05, 0.80, 0.75, 1.0)
OTHER: Colour = (0.62, 0.64, 0.68, 1.0)
PERSON: Colour = (0.98, 0.72, 0.35, 1.0)
GHOST: Colour = (0.93, 0.36, 0.86, 0.55)
BELIEF: Colour = (1.0, 0.66, 0.10, 1.0)

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
#: [m] by kind of road user; what is not listed is as high as a car.
HEIGHTS = MappingProxyType(
    {
        "van": 2.3,
        "truck": 3.4,
        "bus": 3.2,
        "tram": 3.6,
        "bicycle": 1.7,
        "motorcycle": 1.6,
        "pedestrian": 1.75,
        "wheelchair": 1.35,
        "scooter": 1.75,
    }
)
CAR_HEIGHT = 1.5  # [m]
SIGNALS = MappingProxyType(
    {
        LightState.RED: (0.90, 0.10, 0.10, 1.0),
        LightState.RED_AMBER: (0.95, 0.35, 0.05, 1.0),
        LightState.AMBER: (1.0, 0.72, 0.0, 1.0),
        LightState.GREEN: (0.05, 0.80, 0.25, 1.0),
        LightState.GREEN_YIELD: (0.35, 0.75, 0.35, 1.0),
        LightState.STOP_FIRST: (0.75, 0.15, 0.45, 1.0),
        LightState.FLASHING: (1.0, 0.72, 0.0, 0.5),
        LightState.OFF: (0.35, 0.35, 0.35, 1.0),
    }
)


def colour(name: int, state: VehicleState | PersonState) -> Colour:
    """Return the colour of a road user: its paint, where it is known."""
    if name == EGO:
        return OWN
    if isinstance(state, PersonState):
        return PERSON
    paint = PAINT.get(state.colour or "")
    return OTHER if paint is None else (*paint, 1.0)


def height(state: VehicleState | PersonState) -> float:
    """Return the height [m] of a road user."""
    return HEIGHTS.get(state.kind, CAR_HEIGHT)


def faded(shade: Colour, share: float) -> Colour:
    """Return a colour of which only a share of the opacity is left."""
    red, green, blue, opacity = shade
    return red, green, blue, opacity * min(max(share, 0.0), 1.0)
