"""Rivals: which of several road users is faster, nearer, bigger or ahead."""

from collections.abc import Mapping, Sequence

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Measures, NotUnderstood
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Compare
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Ego,
    Measured,
    Quantity,
    Related,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.vocabulary import Attribute, Relation
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding, known
from xavi_dialogue.explain.answers.reference.naming import somebodies

#: By what is asked: the attribute that is compared, and whether more of it comes first.
BY: Mapping[str, tuple[Attribute, bool]] = {
    "speed": ("speed", True), "time": ("speed", True), "size": ("size", True),
    "distance": ("distance", False),
}  # fmt: skip

BOTH = 2  # number of things in a plain comparison
SAME = 0.6  # maximum difference of two values that count as the same


def rivals(question: Compare, asked: Asked, *, by: bool = False) -> Answer:
    """Return which of several is faster, nearer or bigger, with the values; `by`: how much.

    Raises:
        Unanswered: these are not road users, or not compared by what can be measured.
    """
    at = asked.moment
    things = [
        one
        for option in question.options
        if isinstance(option, Ego | Vehicle | Vehicles | Described)
        for one in somebodies(asked, option, at)
    ]
    things = list(dict.fromkeys(things))
    if len(things) < 2:
        raise Unanswered(NotUnderstood())
    if question.by == "place":
        return _in_line(question, things, asked, at)
    if question.by not in BY:
        raise Unanswered(NotUnderstood())
    attribute, most = BY[question.by]
    most = most != question.least
    values = sorted((_value(asked, attribute, t, at) for t in things), key=_key, reverse=most)
    if by and Ego() in things and len(things) > BOTH:
        values = _before_us(asked, values, at)
    first, second = values[0], values[1]
    to = Ego() if attribute == "distance" else None
    left, right = Measured(attribute, first.thing, to), Measured(attribute, second.thing, to)
    missing = next((one for one in values if one.value is None), None)
    if missing is not None or first.value is None or second.value is None:
        gap = None if missing is None else missing.gap
        return Finding(None, known(*values), gap).verdict(Compares(left, "more", right))
    same = abs(first.value - second.value) <= SAME
    that = Compares(
        left, "same" if same else "more" if first.value > second.value else "less", right
    )
    if by and not same:
        apart = Quantity(abs(first.value - second.value), "m/s")
        that = replace(that, by=apart)
    verdict = Finding(True, tuple(values)).verdict(that)
    return replace(verdict, either=True)


def _before_us(asked: Asked, values: list[Measure], at: float) -> list[Measure]:
    """Order values of several by their distance to us, with ours in the second place."""
    near = sorted(
        (one for one in values if one.thing != Ego()),
        key=lambda one: _key(_value(asked, "distance", _who(one), at)),
    )
    return [near[0], *(one for one in values if one.thing == Ego()), *near[1:]]


def _who(one: Measure) -> Ego | Vehicle:
    assert isinstance(one.thing, Ego | Vehicle)
    return one.thing


def _in_line(question: Compare, things: Sequence[Ego | Vehicle], asked: Asked, at: float) -> Answer:
    """Return which of two is ahead of the other, else where each of them is."""
    one, other = things[0], things[1]
    for first, second in ((one, other), (other, one)):
        if asked.world.relation("ahead-of", first, second, at):
            ahead, behind = (second, first) if question.least else (first, second)
            relation: Relation = "behind" if question.least else "ahead-of"
            return replace(Finding(True).verdict(Related(relation, ahead, behind)), either=True)
    placed = [asked.world.measure("place", t, at) for t in things if isinstance(t, Vehicle)]
    return Measures(tuple(placed))


def _value(asked: Asked, attribute: Attribute, thing: Ego | Vehicle, at: float) -> Measure:
    other = Ego() if attribute == "distance" else None
    return asked.world.measure(attribute, thing, at, other)


def _key(one: Measure) -> float:
    return one.value if one.value is not None else -1.0
