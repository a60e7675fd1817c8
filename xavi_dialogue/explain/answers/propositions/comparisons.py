"""Comparisons: whether an attribute has a value, and how two compare."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Counted, Identified, Measures, Verdict
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import HowMany, Which
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Everyone,
    Exists,
    Has,
    Measured,
    Quantity,
    Thing,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import Attribute, Comparator, Extreme
from xavi_dialogue.explain.answers.measuring.closeness import approaches
from xavi_dialogue.explain.answers.measuring.counting import how_many
from xavi_dialogue.explain.answers.propositions.measures import best_of, value_at, values
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, known, unknown
from xavi_dialogue.explain.answers.reference.moments import Window, instant, is_past, window
from xavi_dialogue.explain.answers.reference.naming import check_sense, of_kind, somebodies

#: Maximum difference between two values that count as equal, by attribute.
SAME: dict[Attribute, float] = {
    "speed": 0.6, "limit": 0.3, "gap": 0.5, "distance": 0.5, "headway": 0.2,
    "time-to-collision": 0.3, "deceleration": 0.3, "acceleration": 0.3, "size": 0.3,
    "time-to-go": 1.0, "distance-to-go": 5.0, "probability": 0.03, "duration": 0.5,
}  # fmt: skip
KMH = 3.6  # [km/h] in 1 m/s
LIGHTS: frozenset[Attribute] = frozenset(("indicator", "brake-lights"))
#: Kinds that look like a car from outside.
UNMARKED: frozenset[str] = frozenset(("taxi", "emergency"))
#: What is still known of a vehicle that is out of view.
LASTING: frozenset[Attribute] = frozenset(("colour", "kind", "size", "name", "origin"))
#: Attributes that we cannot see: of a vehicle from outside, or of the world.
INSIDE: frozenset[Attribute] = frozenset(("load", "occupant", "writing", "parts", "weather"))
NONE = ("none", "off", "no", "")


def has(of: Has, asked: Asked) -> Finding:
    """Weigh that an attribute has a value in words.

    Raises:
        Unanswered: the thing is unknown.
    """
    check_sense(of.thing)
    about = window(asked, of.time, of.tense)
    at = instant(asked, of.time, of.tense)
    things: tuple[Thing, ...] = somebodies(asked, of.thing, at) or (of.thing,)
    lasting = of.attribute in LIGHTS and is_past(asked, of.time, of.tense) and not about.instant
    found = [
        _shown_over(of, asked, thing, about) if lasting else _has(of, asked, thing, at)
        for thing in things
    ]
    true = next((one for one in found if one.holds), None)
    return true or found[0]


def _has(of: Has, asked: Asked, thing: Thing, at: float) -> Finding:
    values = value_at(asked, Measured(of.attribute, thing), thing, at)
    value = values[-1] if of.attribute in LASTING else values[0]
    if of.attribute in INSIDE:
        return Finding(None, (), value.gap, answer=Measures((value,)))
    if value.gap is not None:
        return unknown(value.gap, *known(*values))
    if of.attribute in LIGHTS:
        return Finding(_lit(of, value.lights), (value,))
    said = of.value.strip().lower()
    if of.attribute == "kind" and value.word is not None and _is_finer(said, value.word.lower()):
        return unknown("not-sensed")  # "is it a racing car?"
    if value.word is not None:
        return Finding(value.word.lower() == said or said in value.word.lower().split(), (value,))
    number = "" if value.value is None else f"{value.value:g}"
    side = value.side or ""
    return Finding(said in (number, side), (value,))


def _is_finer(said: str, seen: str) -> bool:
    """Check whether a kind that is named is more specific than what can be seen from outside."""
    return said.split()[-1:] == [seen] != said.split() or (seen == "car" and said in UNMARKED)


def _shown_over(of: Has, asked: Asked, thing: Thing, about: Window) -> Finding:
    """Weigh that a light was shown at any time in a stretch of the ride."""
    last: Measure | None = None
    for at in _moments(asked, about):
        found = asked.world.measure(of.attribute, thing, at)
        if found.gap is None:
            if _lit(of, found.lights):
                return Finding(True, (found,))
            last = found
        elif last is None:
            last = found
    if last is None:
        return unknown("not-recorded")
    return unknown(last.gap) if last.gap is not None else Finding(False, (last,))


def _moments(asked: Asked, about: Window) -> tuple[float, ...]:
    count = int((about.end - about.begin) / 0.4)
    return tuple(about.begin + k * 0.4 for k in range(count + 1))


def _lit(of: Has, lights: tuple[str, ...]) -> bool:
    said = of.value.strip().lower()
    if of.attribute == "brake-lights":
        return ("brake" in lights) != (said in NONE)
    turning = [light for light in lights if light in ("left", "right")]
    if said in NONE:
        return not turning
    if said in ("left", "right"):
        return said in turning
    if said in ("both", "hazard", "warning"):
        return len(turning) == 2
    return bool(turning)


def compares(of: Compares, asked: Asked) -> Finding:
    """Weigh how a measure compares with another one, with a number, or with what is allowed.

    A comparison of several things holds if it holds for each of them.

    Raises:
        Unanswered: a thing is unknown.
    """
    if of.left.attribute == "count":
        return _tallied(of, asked)
    if isinstance(of.left.to, Everyone) and isinstance(of.right, Quantity):
        return _of_any(of, of.left.to, of.right, asked)
    if isinstance(of.left.thing, Everyone) and isinstance(of.right, Measured):
        return _any_faster(of, of.left.thing, asked)
    at = instant(asked, of.left.time, of.left.tense)
    each = somebodies(asked, of.left.thing, at)
    if len(each) < 2:
        return _lesser_first(of, _compared(of, asked))
    found = [_compared(replace(of, left=replace(of.left, thing=one)), asked) for one in each]
    told = [one for one in found if one.holds is not None]
    if not told:
        return found[0]
    left = tuple(one.facts[0] for one in told)
    right = told[0].facts[1:]
    return Finding(all(one.holds for one in told), (*left, *right))


def _of_any(of: Compares, whom: Everyone, limit: Quantity, asked: Asked) -> Finding:
    """Weigh whether anybody came so close, by the closest approach of each; list all who did."""
    near = approaches(asked, whom.kind, window(asked, of.left.time, of.left.tense))
    found = [m for m in near if _holds(of.comparator, (m.value or 0.0) - limit.value, 0.0, None)]
    if not near:
        return unknown("not-applicable")
    return Finding(bool(found), tuple(found or near[:1]))


def _any_faster(of: Compares, whom: Everyone, asked: Asked) -> Finding:
    """Weigh whether anybody was faster, or slower, than us at the same time; with who was most."""
    about = window(asked, of.left.time, of.left.tense)
    times = [asked.now] if about.instant else _moments(asked, about)
    sign = -1.0 if of.comparator == "less" else 1.0
    found: list[tuple[float, Measure, Measure]] = []
    for at in times:
        ours = asked.world.measure("speed", Ego(), at)
        for number in of_kind(asked, asked.world.in_view(at), whom.kind, at):
            theirs = asked.world.measure("speed", Vehicle(number), at)
            if ours.value is not None and theirs.value is not None:
                found.append((sign * (theirs.value - ours.value), theirs, ours))
    if not found:
        return unknown("not-applicable")
    most, theirs, ours = max(found, key=lambda one: one[0])
    told = replace(of, left=replace(of.left, thing=theirs.thing))
    holds = most > _as_told(theirs.value or 0.0, ours.value or 0.0)
    return Finding(holds, answer=Verdict(told, holds, (theirs, ours)))


def who_came(question: Which, asked: Asked) -> Answer | None:
    """Return who came within a distance of us in the ride; None for other questions."""
    of = question.such
    if not isinstance(of, Compares) or not isinstance(of.right, Quantity):
        return None
    left = of.left
    ride = left.attribute == "distance" and isinstance(left.time, WholeRide)
    if not ride or not isinstance(question.thing, Wanted) or Ego() not in (left.thing, left.to):
        return None
    near = _of_any(of, Everyone(question.thing.kind), of.right, asked)
    measures = tuple(m for m in near.facts if isinstance(m, Measure))
    return Measures(measures) if near.holds else Identified((), of, measures, none=True)


def _lesser_first(of: Compares, found: Finding) -> Finding:
    """Return the finding with the lesser of two unequal things as the one that falls short."""
    if of.comparator != "same" or found.holds is not False or not isinstance(of.right, Measured):
        return found
    values = [f for f in found.facts if isinstance(f, Measure) and f.value is not None]
    if len(values) != 2 or (values[0].value or 0.0) <= (values[1].value or 0.0):
        return found
    swapped = replace(of, left=of.right, right=of.left)
    return Finding(False, answer=Verdict(swapped, False, tuple(reversed(found.facts))))


def _tallied(of: Compares, asked: Asked) -> Finding:
    """Weigh that there were as many, or that something was done as often, as a number says."""
    such = of.left.about.thing if isinstance(of.left.about, Exists) else None
    found = how_many(HowMany(of.left.event or of.left.thing, such), asked)
    if not isinstance(found, Counted) or not isinstance(of.right, Quantity):
        return unknown("not-recorded")
    holds = _holds(of.comparator, found.count - of.right.value, 0.0, of.by)
    return Finding(holds, answer=replace(found, said=holds))


def _compared(of: Compares, asked: Asked) -> Finding:
    at = instant(asked, of.left.time, of.left.tense)
    left = _left_side(of, asked, at)
    right = _other_side(of, asked, left)
    if left.value is None or right is None or right.value is None:
        gap = left.gap or (None if right is None else right.gap) or "not-recorded"
        facts = known(left, *(() if right is None else (right,)))
        return unknown(gap, *facts)
    margin = SAME.get(of.left.attribute, 0.0)
    if left.attribute == right.attribute == "speed" and of.by is None and of.comparator != "same":
        margin = _as_told(left.value, right.value)
    holds = _holds(of.comparator, left.value - right.value, margin, of.by)
    if isinstance(of.right, Measured):
        return Finding(holds, (left, right))
    return Finding(holds, (replace(left, reference=right.value),))


def _as_told(one: float, other: float) -> float:
    """Return the maximum difference of two speeds that round to the same figure."""
    return abs(one - other) if round(KMH * one) == round(KMH * other) else 0.0


def _left_side(of: Compares, asked: Asked, at: float) -> Measure:
    """Return the left side; over the whole ride, the extreme that the comparison is about."""
    whole = isinstance(of.left.time, WholeRide) or (
        isinstance(of.left.time, Unsaid) and of.left.tense in ("past", "perfect")
    )
    about = window(asked, of.left.time, of.left.tense)
    limit = isinstance(of.right, Measured) and of.right.attribute == "limit"
    if not whole or about.instant or not (limit or isinstance(of.right, Quantity)):
        return best_of(asked, of.left, at)
    which: Extreme = "lowest" if of.comparator in ("less", "at-most") and not limit else "highest"
    things = somebodies(asked, of.left.thing, at) or (of.left.thing,)
    return asked.world.extreme(
        of.left.attribute, things[0], which, about.begin, about.end, of.left.to
    )


def _other_side(of: Compares, asked: Asked, left: Measure) -> Measure | None:
    """Return the value that the left side is compared with; by default the limit."""
    match of.right:
        case Measured(attribute="limit", thing=thing) if left.extreme is not None:
            return asked.world.measure("limit", thing, left.time)
        case Measured(thing=Everyone()):
            found = [m for m in values(asked, of.right) if m.value is not None]
            most = 1.0 if of.comparator == "more" else -1.0
            return max(found, key=lambda m: most * (m.value or 0.0), default=None)
        case Measured():
            return best_of(asked, of.right, left.time)
        case Quantity(value=value):
            share = value / 100.0 if of.right.unit == "%" else value
            return Measure(left.attribute, left.thing, left.time, value=share)
    if left.attribute == "speed" and isinstance(left.thing, Ego | Vehicle):
        return asked.world.measure("limit", left.thing, left.time)
    return None


def _holds(comparator: Comparator, difference: float, margin: float, by: Quantity | None) -> bool:
    least = margin if by is None else by.value - margin
    match comparator:
        case "more" | "too-much":
            return difference > least
        case "less":
            return difference < -least
        case "at-least" | "enough":
            return difference >= -margin
        case "at-most":
            return difference <= margin
        case "same":
            return abs(difference) <= margin
