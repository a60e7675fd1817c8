"""Looks: how well a vehicle, as it was seen, fits the words of a description.

Costs are between 0, it fits, and 1, it is something else.
"""

from typing import Final

from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.vocabulary import Bearing, Kind

WRONG: Final = 1.0
NEARLY: Final = 0.3
PASSED: Final = 0.2  # of somebody on one side whom we have passed
BIG: Final = 6.0  # [m] length from which a vehicle is big
SMALL: Final = 4.0  # [m] length up to which one is small
HERE: Final = 30.0  # [m]
FAR: Final = 40.0  # [m]
SAME_LINE: Final = 2.0  # [m] sideways, up to which somebody is straight ahead or behind
ASIDE: Final = 1.5  # [m] sideways, from which on somebody is on one side

#: What a lay person may call a kind, beside its own name, and at which cost.
_KINDS: Final[dict[Kind, dict[Kind, float]]] = {
    "car": {"taxi": 0.1, "van": 0.3, "truck": 0.5, "bus": 0.5, "motorcycle": 0.7},
    "truck": {"van": 0.3, "bus": 0.5},
    "van": {"truck": 0.3, "bus": 0.6, "car": 0.6},
    "bus": {"truck": 0.6, "van": 0.5, "tram": 0.5},
    "taxi": {"car": 0.3},
    "bike": {"bicycle": 0.0, "motorcycle": 0.1, "scooter": 0.3},
    "motorcycle": {"bicycle": 0.3, "scooter": 0.1},
    "bicycle": {"motorcycle": 0.3, "scooter": 0.2},
    "pedestrian": {"wheelchair": 0.1, "scooter": 0.4},
    "tram": {"bus": 0.5},
    "emergency": {"van": 0.7, "car": 0.7},
}
_ALIKE: Final = (
    frozenset(("grey", "silver")),
    frozenset(("silver", "white")),
    frozenset(("white", "cream", "beige")),
    frozenset(("red", "orange")),
    frozenset(("red", "pink")),
    frozenset(("yellow", "orange")),
    frozenset(("yellow", "gold")),
    frozenset(("brown", "beige")),
    frozenset(("purple", "violet", "pink", "magenta")),
    frozenset(("blue", "turquoise", "cyan")),
    frozenset(("green", "turquoise", "lime")),
)
_SAME: Final = {"gray": "grey", "violet": "purple", "golden": "gold"}


def kind_cost(wanted: Kind, look: Look) -> float:
    """Weigh a kind: "car" may be any motor vehicle, at a cost."""
    if wanted in ("vehicle", look.kind):
        return 0.0
    if look.kind == "vehicle":
        return 0.2
    return _KINDS.get(wanted, {}).get(look.kind, WRONG)


def colour_cost(wanted: str | None, look: Look) -> float:
    """Weigh a colour."""
    if wanted is None:
        return 0.0
    if look.colour is None:
        return 0.4
    named, seen = _SAME.get(wanted, wanted), _SAME.get(look.colour, look.colour)
    if named == seen or named in ("dark", "light", "bright"):
        return 0.0
    return 0.4 if any({named, seen} <= alike for alike in _ALIKE) else WRONG


def size_cost(wanted: str | None, look: Look) -> float:
    """Weigh a size: lorries and buses are big, whatever their length."""
    if wanted is None:
        return 0.0
    big = look.length >= BIG or look.kind in ("truck", "bus", "tram")
    if wanted == "big":
        return 0.0 if big else (0.4 if look.kind == "van" or look.length > 5.0 else 0.9)
    return 0.9 if big else (0.0 if look.length <= SMALL or look.kind == "motorcycle" else 0.2)


def bearing_cost(wanted: Bearing | None, look: Look) -> float:
    """Weigh where a vehicle is, seen from us."""
    if wanted is None or wanted in (look.bearing, "there"):
        return 0.0
    match wanted:
        case "around":
            return 0.0 if look.distance < 2.0 * FAR else 0.5
        case "here":
            return 0.0 if look.distance < HERE else 0.4
        case "far":
            return 0.0 if look.distance > FAR else 0.5
        case "oncoming":
            return 0.0 if look.oncoming else WRONG
        case "left" | "right":
            return _aside(wanted, look)
        case "ahead":
            return _along(look, 1.0)
        case "behind":
            return _along(look, -1.0)
        case "beside":
            return _beside(look)
    return _compound(wanted, look)


def origin_cost(wanted: Bearing, looks: tuple[Look, ...]) -> float:
    """Weigh where a vehicle came from: the side that it was seen on at any of some moments."""
    side = "left" if wanted.endswith("left") else "right" if wanted.endswith("right") else None
    costs = []
    for look in looks:
        if side is not None and look.bearing == f"crossing-{side}":
            return 0.0
        if wanted in ("ahead", "oncoming") and look.oncoming:
            return 0.0
        costs.append(bearing_cost(wanted, look))
    return min(costs, default=WRONG)


def _aside(wanted: str, look: Look) -> float:
    if look.bearing.endswith(f"-{wanted}"):
        return PASSED if look.bearing.startswith("behind") else 0.0
    left = look.left if wanted == "left" else -look.left
    if left < ASIDE:
        return WRONG
    return 0.1 if left >= 0.3 * abs(look.ahead) else NEARLY


def _along(look: Look, sign: float) -> float:
    ahead = sign * look.ahead
    if ahead <= 0.0:
        return WRONG
    if look.bearing == "oncoming" or look.oncoming:
        return 0.2 if sign > 0.0 else NEARLY
    if look.bearing.startswith("beside"):
        return 0.6
    if abs(look.left) <= SAME_LINE:
        return 0.0
    return 0.2 if abs(look.left) <= ahead else 0.5


def _beside(look: Look) -> float:
    if look.bearing.startswith("beside"):
        return 0.0
    return NEARLY if abs(look.ahead) < 8.0 and abs(look.left) < 8.0 else WRONG


def _compound(wanted: Bearing, look: Look) -> float:
    along, _, side = wanted.partition("-")
    aside = _aside(side, look) if side else 0.0
    match along:
        case "ahead":
            return max(aside, _along(look, 1.0))
        case "behind":
            return max(aside, _along(look, -1.0))
        case "beside":
            return max(aside, _beside(look))
        case "crossing":
            return max(aside, NEARLY)
    return WRONG
