"""Words for the look of vehicles and people, from SUMO's classes, colours and light bits."""

_KINDS = {
    "truck": "truck",
    "trailer": "truck",
    "delivery": "truck",
    "bus": "bus",
    "coach": "bus",
    "motorcycle": "motorcycle",
    "moped": "motorcycle",
    "bicycle": "bicycle",
    "tram": "tram",
    "rail_urban": "tram",
    **dict.fromkeys(("rail", "rail_electric", "rail_fast", "subway", "cable_car"), "vehicle"),
    "ship": "vehicle",
}
_VANS = ("delivery", "passenger/van")
_WALKERS = {"wheelchair": "wheelchair", "scooter": "scooter"}
_RIGHT, _LEFT, _HAZARD, _BRAKE = 0b0001, 0b0010, 0b0100, 0b1000

_PALETTE = {
    "white": (255, 255, 255),
    "grey": (128, 128, 128),
    "black": (0, 0, 0),
    "red": (255, 0, 0),
    "orange": (255, 165, 0),
    "yellow": (255, 255, 0),
    "green": (0, 160, 0),
    "blue": (0, 0, 255),
    "purple": (128, 0, 128),
    "brown": (139, 69, 19),
}


def colour_name(red: int, green: int, blue: int) -> str:
    """Return the word for a colour, by the nearest of a small palette.

    Args:
        red, green, blue: 0 to 255.
    """

    def distance(word: str) -> int:
        r, g, b = _PALETTE[word]
        return (r - red) ** 2 + (g - green) ** 2 + (b - blue) ** 2

    return min(_PALETTE, key=distance)


def kind_of(vehicle_class: str, shape: str = "") -> str:
    """Return the word for a vehicle of a SUMO class (vClass); "car" for all classes not listed.

    Trains and ships are called "vehicle". Class "delivery" is always called "truck".

    Args:
        vehicle_class: its class.
        shape: its guiShape, by which vans are recognised among the classes not listed.
    """
    return _KINDS.get(vehicle_class, "van" if shape in _VANS else "car")


def walker_of(person_class: str) -> str:
    """Return the word for a person outside of vehicles, by its SUMO class (vClass)."""
    return _WALKERS.get(person_class, "pedestrian")


def lights(signals: int) -> tuple[str, ...]:
    """Return which lights are on: left, right, brake; hazard lights are both left and right.

    Args:
        signals: SUMO's bit field.
    """
    shown = {
        "left": signals & (_LEFT | _HAZARD),
        "right": signals & (_RIGHT | _HAZARD),
        "brake": signals & _BRAKE,
    }
    return tuple(light for light, on in shown.items() if on)


def bits(shown: tuple[str, ...]) -> int:
    """Return SUMO's bit field for lights.

    Args:
        shown: the lights that are on: left, right, brake.
    """
    known = {"left": _LEFT, "right": _RIGHT, "brake": _BRAKE}
    return sum(known[light] for light in set(shown))
