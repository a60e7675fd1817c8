"""Retorts: what a passenger says to a question of ours, short and sloppy as it may be.

The words are the parser's, and so is the reading of actions; what is said beside these stands in
`grammars/retorts.toml`. Nothing here knows which answer is right.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Literal, TypeAlias

from xavi_dialogue.language.beam import Budget
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.lattice import Lattice, build
from xavi_dialogue.language.loose import clauses
from xavi_dialogue.language.normalise import BREAK, MAX_INPUT, normalise
from xavi_dialogue.language.phrases import Automaton, Sense
from xavi_dialogue.language.slots import ANAPHOR, STRAIGHT, STRAIGHT_ON, TOWARDS, Clause, clause
from xavi_dialogue.language.tokens import Token
from xavi_dialogue.language.wordlists import english, inflections, load
from xavi_dialogue.language.words import hear, is_number

Sign: TypeAlias = Literal[
    "passed", "same", "other", "sooner", "later", "yes", "no", "not", "nobody", "question", "plain"
]
SIGNS: tuple[Sign, ...] = (
    "question", "passed", "same", "other", "sooner", "later", "yes", "no", "not", "nobody", "plain"
)  # fmt: skip

#: What an action that a passenger names may be called by us.
_ALIKE: dict[str, tuple[str, ...]] = {
    STRAIGHT: ("continue", "exit-straight"),
    STRAIGHT_ON: ("continue", "exit-straight"),
    "continue": ("continue", "exit-straight"),
    "overtake": ("overtake", "change-left", "change-right"),
    "give-way": ("give-way", "stop"),
    "stop": ("stop", "give-way"),
}
_SIDELESS = {"change": ("change-left", "change-right"), "exit": ("exit-left", "exit-right")}
_DESCRIBING = ("NUMBER", "COLOUR", "PLACE", "ONLEFT", "ONRIGHT", "LEFT", "RIGHT", "KIND")
_VAGUE = frozenset({"CAR", "OTHER"})
_VAGUELY = "other"
_APART = frozenset({"BECAUSE", "IF", "SUBORD"})  # what comes behind is no part of the answer
_ASIDE = frozenset({"SMALL", "NOISE", "BREAK", "CONJ", "AND", "THINK"})
_PARTS = frozenset({BREAK, "but", "though", "although", "however", "or"})
#: Who is no single other vehicle, and the words around a reply that names nobody else.
_NOBODY = frozenset({"EGO", "ME", "BOTH", "NOBODY"})
_FRAME = _ASIDE | {"IT", "THAT", "BE", "DO", "WOULD", "BECAUSE"}


@dataclass(frozen=True, slots=True)
class Named:
    """One vehicle, as a passenger speaks of it."""

    descriptions: tuple[str, ...]  # "3", "left", "truck", ...; "other" where it says no more
    denied: bool = False  # "not vehicle 3"


@dataclass(frozen=True, slots=True)
class Retort:
    """What was said, in parts."""

    passed: bool = False  # the passenger does not know, or does not want to say
    same: bool | None = None  # that it would be the same; False: that it would be different
    sooner: bool | None = None  # a direction of time
    yes: bool | None = None
    torn: bool = False  # both directions, or this action or that
    vehicles: tuple[Named, ...] = ()
    nobody: bool = False  # no other vehicle, or we ourselves
    deeds: tuple[tuple[str, ...], ...] = ()  # actions in order, each with all it may be
    denied: tuple[tuple[str, ...], ...] = ()  # actions that are said not to be


def retort(text: str) -> Retort | None:
    """What a text says in reply to a question; None where it asks something itself."""
    if len(text) > MAX_INPUT or text.lstrip().startswith("/"):
        return None
    heard = hear(normalise(text), frozenset()).words
    words = tuple("would" if word == "had" else word for word in heard)  # "you'd have stayed"
    parts = [part for part in _split(words) if part]
    said: list[_Part] = []
    for part in parts:
        one = _heard(part)
        if one.asks and not (said and any(p.tells for p in said)):
            return None
        if one.asks:
            break
        said.append(one)
    if not said:
        return None
    return _joined(said, words)


@dataclass(frozen=True, slots=True)
class _Part:
    """What is said up to a clause mark."""

    signs: tuple[Sign, ...]
    asks: bool
    vehicles: tuple[Named, ...]
    ourselves: bool
    deeds: tuple[tuple[str, ...], ...]
    denied: tuple[tuple[str, ...], ...]

    @property
    def tells(self) -> bool:
        return bool(self.signs or self.vehicles or self.deeds)


def _split(words: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    start = 0
    for index, word in enumerate((*words, BREAK)):
        if word in _PARTS:
            yield words[start:index]
            start = index + 1


def _heard(words: tuple[str, ...]) -> _Part:
    found = tuple(_signs(words))
    signs = tuple(sign for _, _, sign in found if sign not in ("plain", "question"))
    lattice = build(words)
    tokens = tuple(edge.token for _, edge in lattice.main())
    said = _clauses(build(_without(words, found)))
    terminals = {t.terminal for t in tokens} - _FRAME
    return _Part(
        signs=signs,
        asks=_asks(words, found, lattice),
        vehicles=_vehicles(tokens),
        ourselves=not signs and bool(terminals) and terminals <= _NOBODY,
        deeds=tuple(kind for c in said if c.role != "denied" for kind in _kinds(c)),
        denied=tuple(kind for c in said if c.role == "denied" for kind in _kinds(c)),
    )


def _joined(parts: list[_Part], words: tuple[str, ...]) -> Retort:
    directions = {d for part in parts for d in _directions(part.signs)}
    signs = {sign for part in parts for sign in part.signs}
    vehicles = tuple(named for part in parts for named in part.vehicles)
    number = _number_alone(words)
    if number is not None and all(named.descriptions == (_VAGUELY,) for named in vehicles):
        vehicles = (Named((number,)),)
    hedged = "or" in words and sum(bool(part.deeds) for part in parts) > 1
    first = next((s for part in parts for s in part.signs if s in ("yes", "no")), None)
    return Retort(
        passed="passed" in signs,
        same=False if "other" in signs else "same" in signs or None,
        sooner=next(iter(directions)) if len(directions) == 1 else None,
        yes=None if first is None else first == "yes",
        torn=len(directions) > 1 or hedged,
        vehicles=vehicles,
        nobody="nobody" in signs or any(part.ourselves for part in parts),
        deeds=tuple(deed for part in parts for deed in part.deeds),
        denied=tuple(deed for part in parts for deed in part.denied),
    )


def _directions(signs: tuple[Sign, ...]) -> Iterator[bool]:
    """Whether it is sooner, for each direction that is named; "not later" is sooner."""
    before = ""
    for sign in signs:
        if sign in ("sooner", "later"):
            yield (sign == "sooner") != (before in ("not", "no"))
        before = sign


@cache
def _phrases() -> Automaton:
    automaton = Automaton(lambda verb: frozenset(inflections(verb)))
    for sign in SIGNS:
        for phrase in load("retorts.toml")[sign]["phrases"]:
            automaton.add(phrase, Sense(sign, sign))
    return automaton


def _signs(words: tuple[str, ...]) -> Iterator[tuple[int, int, Sign]]:
    """The longest phrases from the left: begin, end, and what each comes to."""
    position = 0
    while position < len(words):
        found = _phrases().all_from(words, position)
        end, senses = max(found, key=lambda match: match[0], default=(position + 1, ()))
        if senses:
            names = {sense.terminal for sense in senses}
            yield position, end, next(sign for sign in SIGNS if sign in names)
        position = end


def _asks(
    words: tuple[str, ...], found: tuple[tuple[int, int, Sign], ...], lattice: Lattice
) -> bool:
    """Whether it begins as a question, small talk aside."""
    begin = 0
    for at, edge in lattice.main():
        if edge.token.terminal not in _ASIDE:
            begin = at
            break
    passes = [end for _, end, sign in found if sign == "passed"]
    if passes:
        return bool({"why", "how", "mean", "where"} & set(words[passes[0] :]))
    return any(start <= begin for start, _, sign in found if sign == "question")


def _without(words: tuple[str, ...], found: tuple[tuple[int, int, Sign], ...]) -> tuple[str, ...]:
    """The words without what says that it is the same, or when: "change" in "nothing changed"."""
    dropped = {
        position
        for start, end, sign in found
        if sign in ("same", "other", "passed", "sooner", "later")
        for position in range(start, end)
    }
    return tuple(word for position, word in enumerate(words) if position not in dropped)


def _clauses(lattice: Lattice) -> tuple[Clause, ...]:
    if not lattice.edges:
        return ()
    parse = clauses(lattice, Budget(costs().limits.steps), spoken_of=False)
    if parse is None:
        return ()
    roles = ("said", "denied", "unsaid")
    found = [clause(c) for c in parse.tree.children if not isinstance(c, str) and c.data in roles]
    return tuple(
        Clause(
            "denied" if c.role == "unsaid" else c.role, c.actor, c.actions, c.underspecified, c.span
        )
        for c in found
        if c.actor in (None, "ego", "vehicle:it")
    )


def _kinds(said: Clause) -> Iterator[tuple[str, ...]]:
    """All that each action of a clause may be."""
    for action in said.actions:
        if action == ANAPHOR:
            continue
        if action.startswith(TOWARDS):
            side = action.removeprefix(TOWARDS)
            yield f"exit-{side}", f"change-{side}"
        elif said.underspecified == "direction":
            yield _SIDELESS.get(action.partition("-")[0], (action,))
        elif said.underspecified == "manoeuvre":
            yield action, action.replace("exit-", "change-")
        else:
            yield _ALIKE.get(action, (action,))


def _vehicles(tokens: tuple[Token, ...]) -> tuple[Named, ...]:
    """The vehicles that are named, as far as it is not said what for."""
    named: list[Named] = []
    denied, current, vague = False, list[str](), False
    for token, after in zip(tokens, (*tokens[1:], None), strict=True):
        kind = token.terminal
        if kind in _APART and (named or current):
            break
        if kind in ("NOT", "NO"):
            denied = True
        elif kind in ("AND", "OR") and current:
            named.append(Named(tuple(current), denied))
            current, denied = [], False
        elif kind in _DESCRIBING and not (after and after.terminal == "SECONDS"):
            value = str(int(token.value)) if is_number(token.value) else token.value
            current.append(value)
        vague = vague or kind in _VAGUE
    if current:
        named.append(Named(tuple(current), denied))
    if not named and vague:
        return (Named((_VAGUELY,), denied),)
    return tuple(named)


def _number_alone(words: tuple[str, ...]) -> str | None:
    """The one number of a text that says nothing else: "one", "I think two"."""
    filler = frozenset(load("retorts.toml")["filler"]["words"])
    numbers: dict[str, int] = english()["numbers"]
    if not re.fullmatch(r"[\w ,-]*", " ".join(words)):
        return None
    telling = [w for w in words if w not in filler or (w == "one" and "the" not in words)]
    if len(telling) != 1:
        return None
    (word,) = telling
    return str(int(word)) if is_number(word) else str(numbers[word]) if word in numbers else None
