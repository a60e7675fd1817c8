"""Mentions of vehicles in the text of an answer, by name or by description."""

import re
from dataclasses import dataclass

from benchmarks.truth.ridden import Ridden
from sim.scene import EGO, VehicleState

COLOURS = "white|grey|black|red|orange|yellow|green|blue|purple|brown"
KINDS = {
    "car": {"car"},
    "van": {"car", "truck"},
    "lorry": {"truck"},
    "bus": {"bus"},
    "motorbike": {"motorcycle"},
    "bicycle": {"bicycle"},
}
SIDE = r"(?: on the (?:left|right))?"
BESIDE = 10.0  # [m] greatest distance ahead or behind at which a vehicle may be called beside us
PLACE = (
    rf"(?: (?P<that>that (?:was|came|I saw last) )?(?P<place>ahead of us{SIDE}|behind us{SIDE}|"
    rf"(?:coming )?from the (?:left|right)|(?:coming )?towards us|on our (?:left|right)|"
    rf"(?:right )?beside us{SIDE}))"
)
MENTION = re.compile(
    rf"\b(?:(?:[Tt]he|[Aa]) (?:(?P<colour>{COLOURS}) )?(?P<kind>{'|'.join(KINDS)})\b{PLACE}?"
    r"(?: \(vehicle (?P<number>\d+)\))?|[Vv]ehicle (?P<bare>\d+))"
)


@dataclass(frozen=True)
class Mention:
    """A stretch of text that stands for a vehicle."""

    text: str
    vehicles: tuple[int, ...]  # vehicles that it may stand for
    place: str | None
    past: bool  # whether the place is that of an earlier time
    numbered: bool


def mentions(text: str, ride: Ridden, now: float) -> tuple[str, list[Mention]]:
    """Return the text with mentions of vehicles replaced by V0, V1, ..., and the mentions."""
    known = {v: state for v, state in ride.known(now).items() if v != EGO}
    found: list[Mention] = []
    named: dict[tuple[str | None, str], int] = {}

    def taken(match: re.Match[str]) -> str:
        number = match["number"] or match["bare"]
        look = (match["colour"], match["kind"])
        if number is not None:
            vehicles: tuple[int, ...] = (int(number),)
            named[look] = int(number)
        elif look in named:
            vehicles = (named[look],)
        else:
            vehicles = tuple(v for v, state in known.items() if fits(state, *look))
        past = match["that"] is not None
        found.append(Mention(match[0], vehicles, match["place"], past, number is not None))
        return f"V{len(found) - 1}"

    return MENTION.sub(taken, text), found


def fits(state: VehicleState, colour: str | None, kind: str | None) -> bool:
    """Check whether a vehicle looks as described."""
    right_colour = colour is None or state.colour == colour
    return right_colour and (kind is None or state.kind in KINDS[kind])


def placed(ride: Ridden, vehicle: int, place: str, time: float) -> bool:
    """Check whether a vehicle is where a word of place says, in a generous sense."""
    seen = ride.offset(EGO, vehicle, time)
    if seen is None:
        return False
    ahead, left, turn = seen
    if "from the" in place:
        return (left > -6.0) if "left" in place else (left < 6.0)
    if "towards us" in place:
        return abs(turn) > 1.6 and ahead > -8.0
    side = left if place.endswith("left") else -left if place.endswith("right") else None
    if place.startswith("ahead"):
        return ahead > -1.0 and (side is None or side > -1.0)
    if place.startswith("behind"):
        return ahead < 1.0 and (side is None or side > -1.0)
    if "beside" in place and abs(ahead) > BESIDE:
        return False
    return side is None or side > -1.0
