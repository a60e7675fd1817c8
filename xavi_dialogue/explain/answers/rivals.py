"""Rivals: which of two road users is faster, nearer or bigger."""

from collections.abc import Mapping

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, NotUnderstood
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Compare
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Ego,
    Measured,
    Quantity,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.explain.answers.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.findings import Finding, known
from xavi_dialogue.explain.answers.naming import somebodies

#: What is held against each other, and whether more of it wins.
BY: Mapping[str, tuple[Attribute, bool]] = {
    "speed": ("speed", True), "time": ("speed", True), "size": ("size", True),
    "distance": ("distance", False),
}  # fmt: skip

SAME = 0.6  # up to which difference two values are the same


def rivals(question: Compare, asked: Asked, *, by: bool = False) -> Answer:
    """Tell which of two is faster, nearer or bigger, with the value of each; `by` how much.

    Raises:
        Unanswered: it is not two road users that are compared by what can be measured.
    """
    at = asked.moment
    things = [
        one
        for option in question.options
        if isinstance(option, Ego | Vehicle | Vehicles | Described)
        for one in somebodies(asked, option, at)
    ]
    if question.by not in BY or len(things) < 2:
        raise Unanswered(NotUnderstood())
    attribute, most = BY[question.by]
    most = most != question.least
    values = sorted((_value(asked, attribute, t, at) for t in things), key=_key, reverse=most)
    first, second = values[0], values[1]
    left, right = Measured(attribute, first.thing), Measured(attribute, second.thing)
    if first.value is None or second.value is None:
        missing = first if first.value is None else second
        facts = known(first, second)
        return Finding(None, facts, missing.gap).verdict(Compares(left, "more", right))
    same = abs(first.value - second.value) <= SAME
    that = Compares(left, "same" if same else "more" if most else "less", right)
    if by and not same:
        apart = Quantity(abs(first.value - second.value), "m/s")
        that = replace(that, by=apart)
    verdict = Finding(True, (first, second)).verdict(that)
    return replace(verdict, either=True)


def _value(asked: Asked, attribute: Attribute, thing: Ego | Vehicle, at: float) -> Measure:
    other = Ego() if attribute == "distance" else None
    return asked.world.measure(attribute, thing, at, other)


def _key(one: Measure) -> float:
    return one.value if one.value is not None else -1.0
