"""Rules: answer grammars as values, read from `grammars/*.rules`.

An answer grammar is context-free with parameters and guards; `grammars/answer_notation.lark`
describes the notation.

Errors:
    GrammarError            a grammar file is at fault
      ExpansionError        a grammar does not provide for the value it is given (generator)
      FormError             a grammar asks for a form that a value does not have (morphology)
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from typing import TypeAlias

from lark import Lark, LarkError, Transformer, v_args
from lark.tree import Meta

from xavi_dialogue.errors import XaviError


class GrammarError(XaviError, ValueError):
    """An answer grammar that cannot be read, or that uses what it does not define."""


@dataclass(frozen=True, slots=True)
class Word:
    """A word of the grammar itself."""

    text: str


@dataclass(frozen=True, slots=True)
class Path:
    """The path to a value: a parameter, then names of attributes or keys."""

    names: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Literal:
    """A string or number in the grammar."""

    value: str | float


@dataclass(frozen=True, slots=True)
class Comparison:
    """One condition of a guard: presence (no operator), or a relation between two values."""

    left: Path
    operator: str  # "present", "absent", "=", "!=", "<", "<="
    right: Path | Literal | None = None


@dataclass(frozen=True, slots=True)
class Call:
    """A call of another rule, which is expanded in this place."""

    rule: str
    arguments: tuple[Path | Literal, ...]


@dataclass(frozen=True, slots=True)
class Blank:
    """A slot to be filled: the path of its value, and a form."""

    path: Path
    form: str


Item: TypeAlias = Word | Blank | Call


@dataclass(frozen=True, slots=True)
class Alternative:
    """A guard, all of whose comparisons must hold, and the items that it allows."""

    guard: tuple[Comparison, ...]
    items: tuple[Item, ...]
    line: int = field(default=0, compare=False)  # of the grammar file, from 1; 0: of none


@dataclass(frozen=True, slots=True)
class Rule:
    """One rule: parameters and ordered alternatives."""

    name: str
    parameters: tuple[str, ...]
    alternatives: tuple[Alternative, ...]


Grammar: TypeAlias = Mapping[str, Rule]


class _Reader(Transformer):  # type: ignore[type-arg]
    """Parse tree of the notation -> rules; method names are the notation's rule names."""

    def start(self, rules: list[Rule]) -> tuple[Rule, ...]:
        return tuple(rules)

    def rule(self, parts: list[object]) -> Rule:
        name, inner = re.fullmatch(r"([A-Z_]+)\[(.*)\]\s*->", str(parts[0])).groups()  # type: ignore[union-attr]
        parameters = tuple(p.strip() for p in inner.split(",") if p.strip())
        return Rule(name, parameters, tuple(p for p in parts if isinstance(p, Alternative)))

    @v_args(meta=True)
    def alternative(self, meta: Meta, parts: list[object]) -> Alternative:
        guard = tuple(c for p in parts if isinstance(p, tuple) for c in p)
        items = tuple(p for p in parts if isinstance(p, Word | Blank | Call))
        return Alternative(guard, tuple(i for i in items if i != Word("ε")), meta.line)

    def guard(self, parts: list[tuple[Comparison, ...]]) -> tuple[Comparison, ...]:
        return parts[0]

    def condition(self, parts: list[Comparison]) -> tuple[Comparison, ...]:
        return tuple(parts)

    def presence(self, parts: list[object]) -> Comparison:
        path = parts[-1]
        assert isinstance(path, Path)
        return Comparison(path, "present" if len(parts) == 1 else "absent")

    def relation(self, parts: list[object]) -> Comparison:
        left, operator, right = parts
        assert isinstance(left, Path)
        assert isinstance(right, Path | Literal)
        return Comparison(left, str(operator), right)

    def operand(self, parts: list[Path | Literal]) -> Path | Literal:
        return parts[0]

    def word(self, parts: list[object]) -> Word:
        return Word(str(parts[0]))

    def slot(self, parts: list[object]) -> Blank:
        path = parts[0]
        assert isinstance(path, Path)
        return Blank(path, str(parts[1]) if len(parts) > 1 else "plain")

    def call(self, parts: list[object]) -> Call:
        arguments = tuple(p for p in parts[1:] if isinstance(p, Path | Literal))
        return Call(str(parts[0]), arguments)

    def PATH(self, token: str) -> Path:  # noqa: N802 - lark calls terminals by their name
        return Path(tuple(token.split(".")))

    def STRING(self, token: str) -> Literal:  # noqa: N802
        return Literal(token[1:-1])

    def NUMBER(self, token: str) -> Literal:  # noqa: N802
        return Literal(float(token))


@cache
def _notation() -> Lark:
    text = (files("grammars") / "answer_notation.lark").read_text(encoding="utf-8")
    return Lark(text, parser="lalr", maybe_placeholders=False, propagate_positions=True)


def read_grammar(text: str, name: str = "grammar") -> dict[str, Rule]:
    """Read the rules of a grammar, by name.

    Raises:
        GrammarError: not in the notation, a rule defined twice, a call to an unknown rule or with
            the wrong number of arguments, or a path that does not start at a parameter.
    """
    try:
        rules = _Reader().transform(_notation().parse(text))
    except LarkError as error:
        raise GrammarError(f"{name}: {error}") from error
    grammar: dict[str, Rule] = {}
    for rule in rules:
        if rule.name in grammar:
            raise GrammarError(f"{name}: rule {rule.name} is defined twice; merge the two")
        grammar[rule.name] = rule
    for rule in rules:
        _check(rule, grammar, name)
    return grammar


@cache
def load_grammar(name: str) -> dict[str, Rule]:
    """Return the grammar `grammars/<name>.rules`.

    Raises:
        GrammarError: see `read_grammar`.
    """
    path = files("grammars") / f"{name}.rules"
    return read_grammar(path.read_text(encoding="utf-8"), path.name)


@cache
def load_grammars(*names: str) -> dict[str, Rule]:
    """Return the rules of several grammars as one grammar, in which they may call each other.

    Raises:
        GrammarError: see `read_grammar`.
    """
    texts = ((files("grammars") / f"{name}.rules").read_text(encoding="utf-8") for name in names)
    return read_grammar("\n".join(texts), " + ".join(names))


def _check(rule: Rule, grammar: Grammar, name: str) -> None:
    paths: list[Path] = []
    for alternative in rule.alternatives:
        for comparison in alternative.guard:
            operands = (comparison.left, comparison.right)
            paths += [p for p in operands if isinstance(p, Path)]
        for item in alternative.items:
            if isinstance(item, Blank):
                paths.append(item.path)
            if isinstance(item, Call):
                paths += [a for a in item.arguments if isinstance(a, Path)]
                called = grammar.get(item.rule)
                if called is None:
                    raise GrammarError(f"{name}: {rule.name} calls {item.rule}: no such rule")
                if len(called.parameters) != len(item.arguments):
                    raise GrammarError(
                        f"{name}: {rule.name} gives {item.rule} {len(item.arguments)} arguments; "
                        f"it takes {len(called.parameters)}"
                    )
    for path in paths:
        if path.names[0] not in rule.parameters:
            raise GrammarError(f"{name}: {path.names[0]} is not a parameter of {rule.name}")
