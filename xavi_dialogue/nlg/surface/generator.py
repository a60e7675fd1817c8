"""Generator: the expansion of an answer grammar into tokens.

Expansion is deterministic: it takes the first alternative whose guard holds and whose slots have
values. Its result is a row of tokens: words of the grammar, and slots. A slot carries a value and
the form in which morphology puts it into words. A slot that holds a message is expanded by the
rule that the message names; several messages are joined by the form of the slot.

Errors: see `rules`.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from xavi_dialogue.nlg.surface.message import Message
from xavi_dialogue.nlg.surface.rules import (
    Alternative,
    Call,
    Comparison,
    Grammar,
    GrammarError,
    Item,
    Literal,
    Path,
    Rule,
    Word,
)

TOLERANCE = 1e-9  # numbers this close to a bound count as equal to it
#: Punctuation and words between messages in a row, and before the last one, by form of the slot.
JOINTS: dict[str, tuple[str, str]] = {
    "plain": (",", "and"),
    "and": (",", ", and"),
    "or": (",", "or"),
    "but": (",", ", but"),
    "semicolon": (";", ";"),
    "sentences": (".", "."),
    "then": (",", ", then"),
}


class ExpansionError(GrammarError):
    """No alternative of a rule provides for the values at hand, or a slot has no value."""


@dataclass(frozen=True, slots=True)
class Slot:
    """A value to be put into words, in the given form."""

    value: object
    form: str


Token: TypeAlias = Word | Slot


def expand(grammar: Grammar, start: str, *values: object) -> tuple[Token, ...]:
    """Return the tokens of rule `start` with `values` for its parameters.

    Raises:
        ExpansionError: no alternative fits, or a slot has no value.
    """
    rule = grammar[start]
    scope = dict(zip(rule.parameters, values, strict=True))
    lacking: ExpansionError | None = None
    for alternative in fitting(rule, scope):
        try:
            return filled(alternative, scope, grammar, start)
        except ExpansionError as error:
            lacking = lacking or error
    raise lacking or ExpansionError(
        f"rule {rule.name} has no alternative for {scope!r}; add one to the grammar"
    )


def fitting(rule: Rule, scope: Mapping[str, object]) -> Iterator[Alternative]:
    """Yield the alternatives of a rule whose guards hold for the values in its scope, in order."""
    for alternative in rule.alternatives:
        if all(_holds(comparison, scope) for comparison in alternative.guard):
            yield alternative


def filled(
    alternative: Alternative, scope: Mapping[str, object], grammar: Grammar, rule: str
) -> tuple[Token, ...]:
    """Return the tokens of an alternative of a rule, with the values in its scope."""
    return tuple(token for item in alternative.items for token in _fill(item, scope, grammar, rule))


def _fill(
    item: Item, scope: Mapping[str, object], grammar: Grammar, rule: str
) -> tuple[Token, ...]:
    if isinstance(item, Word):
        return (item,)
    if isinstance(item, Call):
        return expand(grammar, item.rule, *(_value(a, scope) for a in item.arguments))
    value = _value(item.path, scope)
    if not _present(value):
        raise ExpansionError(f"rule {rule}: no value at {'.'.join(item.path.names)}")
    return fill(grammar, value, item.form)


def fill(grammar: Grammar, value: object, form: str = "plain") -> tuple[Token, ...]:
    """Return the tokens of a value in a slot; messages are expanded by their rules.

    Raises:
        ExpansionError: as `expand`.
    """
    if isinstance(value, Message):
        return expand(grammar, value.rule, value)
    if isinstance(value, tuple) and value and all(isinstance(v, Message) for v in value):
        rows = [expand(grammar, v.rule, v) for v in value]
        return _joined(rows, *JOINTS.get(form, JOINTS["plain"]))
    return (Slot(value, form),)


def _joined(rows: list[tuple[Token, ...]], joint: str, last: str) -> tuple[Token, ...]:
    tokens: list[Token] = []
    for k, row in enumerate(rows):
        if k:
            words = last if k == len(rows) - 1 else joint
            tokens += [Word(word) for word in words.split()]
        tokens += row
    return tuple(tokens)


def _holds(comparison: Comparison, scope: Mapping[str, object]) -> bool:
    left = _value(comparison.left, scope)
    if comparison.right is None:
        return _present(left) == (comparison.operator == "present")
    right = _value(comparison.right, scope)
    if isinstance(left, int | float) and isinstance(right, int | float):
        return _related(left - right, comparison.operator)
    if comparison.operator == "=":
        return left == right
    return comparison.operator == "!=" and left != right


def _related(difference: float, operator: str) -> bool:
    equal = abs(difference) <= TOLERANCE
    if operator == "=":
        return equal
    if operator == "!=":
        return not equal
    return equal if operator == "<=" and equal else difference < 0 and not equal


def _value(operand: Path | Literal, scope: Mapping[str, object]) -> object:
    """Follow a path through attributes, keys, and `size`, `first`, `rest` of a tuple."""
    if isinstance(operand, Literal):
        return operand.value
    value = scope[operand.names[0]]
    for name in operand.names[1:]:
        if isinstance(value, tuple):
            value = _of_tuple(value, name)
        elif isinstance(value, Message):
            value = value.slots.get(name)
        elif isinstance(value, Mapping):
            value = value.get(name)
        else:
            value = getattr(value, name, None)
    return value


def _of_tuple(value: tuple[object, ...], name: str) -> object:
    if name == "size":
        return len(value)
    if name == "first":
        return value[0] if value else None
    return value[1:] if name == "rest" else None


def _present(value: object) -> bool:
    """Check whether a value counts as present: 0 does, but None, False, "" and () do not."""
    return not (value is None or value is False or value in ("", ()))
