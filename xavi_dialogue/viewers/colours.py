"""Colours and heights of what viewers draw."""

from types import MappingProxyType

from sim.scene import EGO, LightState, PersonState, VehicleState
from xavi_dialogue.library import paint
from xavi_dialogue.viewers.messages import Colour

ROAD: Colour = (0.30, 0.32, 0.35, 1.0)
ROAD_OF_OTHERS: Colour = (0.42, 0.38, 0.36, 1.0)
CROSSING: Colour = (0.80, 0.80, 0.80, 1.0)
MARKING: Colour = (0.92, 0.92, 0.92, 0.9)
TEXT: Colour = (1.0, 1.0, 1.0, 1.0)
OWN: Colour = (*paint.OURS, 1.0)
OTHER: Colour = (*paint.OTHERS, 1.0)
PERSON: Colour = (*paint.ON_FOOT, 1.0)
GHOST: Colour = (*paint.GHOST, 0.55)
BELIEF: Colour = (*paint.BELIEF, 1.0)

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
    known = paint.PAINT.get(state.colour or "")
    return OTHER if known is None else (*known, 1.0)


def height(state: VehicleState | PersonState) -> float:
    """Return the height [m] of a road user."""
    return HEIGHTS.get(state.kind, CAR_HEIGHT)


def faded(shade: Colour, share: float) -> Colour:
    """Return a colour of which only a share of the opacity is left."""
    red, green, blue, opacity = shade
    return red, green, blue, opacity * min(max(share, 0.0), 1.0)
