"""Measures: a value as a sentence, by its attribute."""

from collections.abc import Mapping
from typing import Any

from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import (
    Destination,
    Ego,
    Exit,
    Feature,
    Junction,
    Thing,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.nlg.content.clauses.agreement import verbs
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT, since
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message
from xavi_dialogue.nlg.surface.tables import table, word
from xavi_dialogue.nlg.surface.values import Moment, Number, Owned, Quantity, Unit, Who

UNITS: Mapping[Attribute, Unit] = {
    "speed": "m/s", "speed-change": "m/s", "limit": "m/s", "excess": "m/s", "acceleration": "m/s2",
    "deceleration": "m/s2", "comfort": "m/s2", "jerk": "m/s3", "gap": "m", "distance": "m",
    "headway": "s", "time-to-collision": "s", "size": "m", "distance-to-go": "m",
    "distance-driven": "m", "time-to-go": "s", "arrival-time": "clock", "time": "s",
    "waiting-time": "s", "duration": "s", "delay": "s", "probability": "%", "turn": "m",
    "route": "m", "cost": "s",
}  # fmt: skip
WORLDLY = frozenset(("weather", "sound", "battery", "money", "law", "world"))
TOPICS = {"weather": "the weather", "sound": "sounds and smells", "battery": "my battery",
          "money": "the price of this ride", "law": "the law",
          "world": "the world outside this ride"}  # fmt: skip
UNSEEN = frozenset(("load", "occupant", "writing", "parts"))  # not visible from outside
INSIDE = frozenset(("load", "occupant"))  # those of them that are inside the vehicle
_NAMES = {"distance-to-go": "the distance to our destination", "turn": "the next turn on our way",
          "exit-number": "the exit that we take", "time-to-go": "the time that we still need",
          "arrival-time": "the time of arrival"}  # fmt: skip
SOON = 1.0  # [s] maximum time of what comes at once
WIDE = 5.0  # [s] by how much sooner a wait may end for that to be told
BETWEEN = frozenset(("gap", "headway", "distance", "time-to-collision"))
AT_HAND = 4.0  # [m] distance below which a place is just ahead
AT = 1.5  # [m] distance below which we are at a place
OVER = 0.5  # [m/s] minimum excess over the limit that is stated
STANDING = 0.3  # [m/s]
EVEN_SPEED = 0.8  # [m/s] maximum variation of a speed that is stated as one value
EVEN = 0.3  # [m/s2] maximum acceleration that counts as none
GENTLE, FIRM, HARD = 1.5, 3.2, 4.0  # [m/s2] minimum of normal, firm, hard braking
_UNPLACED = frozenset(("place", "heading", "origin"))
_VAGUE = frozenset(("indicator", "brake-lights", "right-of-way", "visibility", "comfort", "route",
                    "cost", "value", "count", "simulations", "options", "turn"))  # fmt: skip
_WORDED = frozenset(("colour", "kind", "place", "origin", "heading", "visibility"))
_EITHER = frozenset(("lane", "route", *WORLDLY))


def measure_message(
    one: Measure, context: SpeechContext, *, bare: bool = False, when: bool = True,
    gone: bool = False,
) -> Message:  # fmt: skip
    """Make the message for one measure.

    Args:
        one: the measure.
        context: the situation.
        bare: leave out the value that it is compared with.
        when: state the time, unless it is now.
        gone: it is the last value that was seen, however short a while ago.
    """
    slots = _common(one, context, when, gone=gone)
    if one.gap is not None or not _has_value(one):
        slots |= {"gap": one.gap or "not-recorded", "between": one.attribute in BETWEEN}
        return Message("NO_VALUE", slots)
    if one.attribute in WORLDLY:
        return Message("MEASURE_WORLD", slots)
    slots |= _valued(one, context)
    if bare:
        slots |= {"reference": None, "above": False}
    return Message(f"MEASURE_{one.attribute.replace('-', '_').upper()}", slots)


def _has_value(one: Measure) -> bool:
    """Check whether a measure has what the sentence of its attribute needs."""
    if one.attribute in UNSEEN:
        return False
    if one.attribute in ("indicator", "brake-lights", "name"):
        return True
    if one.attribute in _WORDED:
        return one.word is not None
    if one.attribute == "turn":
        return one.side is not None
    if one.attribute == "right-of-way":
        return one.rule is not None
    return one.value is not None or (one.attribute in _EITHER and one.word is not None)


def _common(
    one: Measure, context: SpeechContext, when: bool, *, gone: bool = False
) -> dict[str, Any]:
    """Return the slots that all attributes have: who, when, and verbs that agree with them."""
    past = (gone or context.now - one.time > since(context)) and one.extreme is None
    past = past and one.attribute != "visibility"
    ego = isinstance(one.thing, Ego)
    plain = one.attribute not in _UNPLACED
    at = one.time if past else None
    who = Who(one.thing, at, plain, one.attribute != "colour", one.attribute != "kind", ride=True)
    many = ego or (isinstance(one.thing, Vehicles) and len(one.thing.numbers) > 1)
    told = past or one.extreme is not None
    noun = word("doings", "attribute", one.attribute)
    seen = _last_seen(one, context)
    return {
        "attribute": one.attribute, "who": who, "ego": ego, "past": told, "noun": noun,
        "named": _named(one, who, noun), "vague": one.attribute in _VAGUE,
        "topic": TOPICS.get(one.attribute, "that"), "inside": one.attribute in INSIDE,
        "when": Moment(one.time) if past and when else None, "clocked": context.then,
        "moment": Moment(one.time) if past else None,
        "to": Who(one.to, at, placed=plain) if one.to is not None else None,
        "to_ego": isinstance(one.to, Ego), "to_place": _is_place(one.to),
        "place": _is_place(one.thing), "hidden_now": not told, "since": seen,
        "extreme": one.extreme, "part": one.until is not None, "at_least": one.at_least,
        **verbs(told, many),
    }  # fmt: skip


def _named(one: Measure, who: Who, noun: str) -> object:
    """Return the name of a measure: "the speed of the blue car", "the distance to the junction"."""
    if one.attribute in _NAMES and isinstance(one.thing, Ego):
        return _NAMES[one.attribute]
    if one.attribute in WORLDLY:
        return f"anything about {TOPICS[one.attribute]}"
    if one.attribute in ("limit", "time", "time-to-go", "probability", "right-of-way"):
        return f"the {noun}"
    return Owned(who, noun)


def _is_place(thing: Thing | None) -> bool:
    return isinstance(thing, Destination | Junction | Exit)


def _last_seen(one: Measure, context: SpeechContext) -> Moment | None:
    if one.attribute == "visibility":
        return Moment(one.time) if context.now - one.time > PRESENT else None
    if not isinstance(one.thing, Vehicle):
        return None
    look = context.look(one.thing.number, one.time)
    return Moment(look.seen) if look is not None and look.seen is not None else None


def _valued(one: Measure, context: SpeechContext) -> dict[str, Any]:
    """Return the slots of a measure that has a value."""
    value = one.value
    unit = UNITS.get(one.attribute, "count")
    slots: dict[str, Any] = {
        "value": Quantity(value, unit) if value is not None else None,
        "word": _worded(one), "side": one.side, "rule": one.rule, "count": one.count,
        "lanes": Number(one.count, "lane") if one.count is not None else None,
        "exits": Number(one.count, "exit") if one.count is not None else None,
        "lit": _lit(one), "peak_at": _peak(one), "until": one.until,
        "rank": int(value) if value is not None and unit == "count" else None,
        "number": f"{value:g}" if value is not None else None,
            }  # fmt: skip
    if one.reference is not None:
        slots["reference"] = Quantity(one.reference, unit)
    return slots | _judged(one, value) | _particular(one, value, context)


def _judged(one: Measure, value: float | None) -> dict[str, Any]:
    """Return the judgement of a number: over or under, hard or gentle, faster or slower."""
    if value is None:
        return {}
    slots: dict[str, Any] = {"total": one.extreme == "total", "none": value <= 0.0}
    match one.attribute:
        case "speed":
            slots["standing"] = value < STANDING
            if one.low is not None and one.high is not None:
                slots |= {
                    "ranged": one.high - one.low > EVEN_SPEED,
                    "even": True,
                    "low": Quantity(one.low, "m/s"),
                    "high": Quantity(one.high, "m/s"),
                }
            slots["above"] = one.reference is not None and value > one.reference + OVER
        case "speed-change":
            slots |= {
                "even": abs(value) < EVEN_SPEED,
                "slower": value < 0,
                "low": Quantity(one.low or 0.0, "m/s"),
                "high": Quantity(one.high or 0.0, "m/s"),
            }
        case "excess":
            slots |= {"over": value > 0.3, "even": abs(value) <= 0.3}
        case "acceleration":
            slots |= {"even": abs(value) < EVEN, "slowing": value < 0, "degree": degree(value)}
        case "deceleration" | "comfort":
            slots |= {"even": value < EVEN, "degree": degree(value), "hard": value >= FIRM}
            slots["braking"] = one.until is not None
            slots["adverb"] = "hard" if value >= HARD else "firmly"
        case "jerk":
            slots["degree"] = "smooth" if value < 1.0 else "normal" if value < 2.5 else "rough"
        case "delay":
            slots |= {"even": abs(value) < 0.5, "saved": value < 0, "several": (one.count or 0) > 1}
            slots["who"] = Who(one.to, one.time) if isinstance(one.to, Vehicle | Vehicles) else None
        case "time-to-go":
            slots |= {
                "arrived": value <= 0.0,
                "level": isinstance(one.to, Vehicle),
                "reach": isinstance(one.to, Junction | Feature),
            }
            slots["bound"] = _is_bound(one)
        case "arrival-time":
            slots["bound"] = _is_bound(one)
    return slots


def _is_bound(one: Measure) -> bool:
    """Check whether the value of a time is only a lower bound."""
    return one.low is not None and one.high is None


def degree(acceleration: float) -> str:
    """Return the word for a deceleration or acceleration [m/s2]."""
    size = abs(acceleration)
    if size < GENTLE:
        return "gentle"
    return "normal" if size < FIRM else "firm" if size < HARD else "hard"


def _particular(one: Measure, value: float | None, context: SpeechContext) -> dict[str, Any]:
    """Return the slots that only one attribute needs."""
    match one.attribute:
        case "lane" if value is not None and one.count is not None:
            return {"leftmost": int(value) == one.count}
        case "lane-count" if value is not None:
            return {"lanes": Number(int(value), "lane")}
        case "name":
            return {"number": one.thing.number if isinstance(one.thing, Vehicle) else None}
        case "place":
            return {"far": Quantity(value, "m") if value is not None else None}
        case "distance" if value is not None:
            return {"at_hand": value < AT}
        case "exit-number" | "turn":
            at_hand = one.attribute == "turn" and (value or 0.0) < AT_HAND
            return _route_verbs(one, context) | {"at_hand": at_hand}
        case "arrival-time" if value is not None:
            left = Quantity(value - context.now, "s")
            arrived = value <= context.now
            return {"value_at": Moment(value), "left": left, "arrived": arrived}
        case "time" if value is not None:
            return {"clock": Quantity(value, "clock")}
        case "time-to-collision":
            other = one.to if isinstance(one.thing, Ego) else one.thing
            pair = "we" if one.to is None else (Who(ride=True), Who(other)) if other else "we"
            return {"pair": pair}
        case "waiting-time":
            lasts = one.extreme is None and one.until is not None and one.until >= context.now
            low = one.low
            sooner = low is not None and (value or 0.0) - low > WIDE
            least = Quantity(low, "s") if low is not None and sooner else None
            return {"left": lasts, "soon": lasts and (value or 0.0) < SOON, "least": least}
        case "duration":
            return {"going_on": one.until is None and one.at_least, "at_least": False}
        case "cost":
            return {"seconds": Quantity(value, "s") if value is not None else None}
    return {}


def _route_verbs(one: Measure, context: SpeechContext) -> dict[str, Any]:
    if context.now - one.time > PRESENT:
        return {"we_take": "we took", "we_go": "we went", "we_turn": "we turned"}
    return {"we_take": "we take", "we_go": "we go", "we_turn": "we turn"}


def _peak(one: Measure) -> Moment | None:
    return Moment(one.time) if one.extreme in ("highest", "lowest") else None


def _lit(one: Measure) -> str | None:
    """Return which indicators or brake lights are on."""
    shown = set(one.lights)
    if one.attribute == "brake-lights":
        return "on" if "brake" in shown or one.word == "on" else None
    left, right = "left" in shown or one.word == "left", "right" in shown or one.word == "right"
    if (left and right) or {"hazard", "both"} & {*shown, one.word}:
        return "both"
    return "left" if left else "right" if right else None


def _worded(one: Measure) -> str | None:
    if one.word is None:
        return None
    if one.attribute == "kind":
        kind = str(table("vehicles")["kind"].get(one.word, one.word))
        return f"{'an' if kind[:1] in 'aeiou' else 'a'} {kind}"
    if one.attribute == "place":
        return str(table("vehicles")["place"].get(one.word, one.word))
    if one.attribute == "origin":
        return _ORIGINS.get(one.word, one.word)
    if one.attribute == "heading":
        return _HEADINGS.get(one.word, one.word)
    return one.word


_HEADINGS = {"left": "going left", "right": "going right", "straight": "going straight on"}
_ORIGINS = {
    "ahead": "into view ahead of us", "behind": "up from behind us", "left": "from the left",
    "right": "from the right", "oncoming": "towards us from ahead",
    "ahead-left": "from ahead on the left", "ahead-right": "from ahead on the right",
    "behind-left": "from behind us on the left", "behind-right": "from behind us on the right",
    "crossing-left": "from the left", "crossing-right": "from the right",
    "beside-left": "from our left", "beside-right": "from our right",
}  # fmt: skip
