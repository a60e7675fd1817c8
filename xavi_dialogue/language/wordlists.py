"""Word lists: the closed vocabulary, read from the TOML files in `grammars/`.

Errors::

    WordListError   a word list breaks the notation; names file, terminal and phrase

A phrase is a sequence of slots: `a|b` one of several words, `x?` may be left out, `~x` in any
inflection. All phrases together form one automaton, which `longest` walks: the longest phrase
wins, and among equally long ones the one that the files name first.
"""

import tomllib
from dataclasses import dataclass, field
from functools import cache
from importlib import resources
from typing import Any, NamedTuple

WORD_FILES = (
    "words_actions.toml",
    "words_actors.toml",
    "words_frames.toml",
    "words_talk.toml",
    "words_english.toml",
)
_TABLES = frozenset({"contractions", "numbers", "homophones", "irregular", "languages"})
_VOWELS = frozenset("aeiou")


class WordListError(ValueError):
    """A word list breaks the notation."""


class Sense(NamedTuple):
    """What a phrase stands for: a terminal of the grammar, with a value."""

    terminal: str
    value: str


class _Phrase(NamedTuple):
    slots: tuple[tuple[frozenset[str], bool], ...]  # (words, may be left out)
    sense: Sense


_State = tuple[tuple[int, int], ...]  # (phrase, slot) pairs, in order


@cache
def load(name: str) -> dict[str, Any]:
    """One TOML file of the package `grammars`."""
    return tomllib.loads(resources.files("grammars").joinpath(name).read_text(encoding="utf-8"))


def english() -> dict[str, Any]:
    """Contractions, numbers, irregular verbs and the like."""
    return load("words_english.toml")


@cache
def inflections(verb: str) -> dict[str, str]:
    """All forms of a verb, each with the name of the form: base, third, past, part, gerund."""
    forms = {verb: "base", _with_s(verb): "third", _with_ing(verb): "gerund"}
    irregular = english()["irregular"].get(verb)
    if irregular:
        past, participle = irregular.split()
        forms.setdefault(participle, "part")
        if past != verb:
            forms[past] = "past"
    else:
        forms[_with_ed(verb)] = "past"
    return forms


def _with_s(verb: str) -> str:
    if verb.endswith(("s", "x", "z", "ch", "sh", "o")):
        return verb + "es"
    if verb.endswith("y") and verb[-2] not in _VOWELS:
        return verb[:-1] + "ies"
    return verb + "s"


def _doubles(verb: str) -> bool:
    """One syllable, consonant-vowel-consonant: stop, stopping."""
    return (
        len(verb) >= 3
        and verb[-1] not in "aeiouwxy"
        and verb[-2] in _VOWELS
        and verb[-3] not in _VOWELS
        and sum(c in _VOWELS for c in verb) == 1
    )


def _with_ing(verb: str) -> str:
    if verb.endswith("e") and not verb.endswith(("ee", "ye", "oe")) and len(verb) > 2:
        return verb[:-1] + "ing"
    return verb + (verb[-1] if _doubles(verb) else "") + "ing"


def _with_ed(verb: str) -> str:
    if verb.endswith("e"):
        return verb + "d"
    if verb.endswith("y") and verb[-2] not in _VOWELS:
        return verb[:-1] + "ied"
    return verb + (verb[-1] if _doubles(verb) else "") + "ed"


@dataclass(slots=True)
class Vocabulary:
    """Every phrase the parser knows, and every word in them."""

    phrases: tuple[_Phrase, ...]
    words: dict[str, int]  # word -> rank: domain words before plain English
    forms: dict[str, str]  # word -> form of a verb
    _first: dict[str, _State]
    _next: dict[tuple[_State, str], _State] = field(default_factory=dict)
    _ends: dict[_State, Sense | None] = field(default_factory=dict)

    def longest(self, words: tuple[str, ...], start: int) -> tuple[int, Sense] | None:
        """The longest phrase that begins at `start`: (where it ends, its sense)."""
        state = self._first.get(words[start])
        best = None
        position = start + 1
        while state:
            sense = self._end(state)
            if sense is not None:
                best = (position, sense)
            if position == len(words):
                break
            state = self._step(state, words[position])
            position += 1
        return best

    def _step(self, state: _State, word: str) -> _State:
        key = (state, word)
        if key not in self._next:
            self._next[key] = self._advance(state, word)
        return self._next[key]

    def _advance(self, state: _State, word: str) -> _State:
        reached: set[tuple[int, int]] = set()
        for index, slot in state:
            slots = self.phrases[index].slots
            for position in range(slot, len(slots)):
                accepted, optional = slots[position]
                if word in accepted:
                    reached.add((index, position + 1))
                if not optional:
                    break
        return tuple(sorted(reached))

    def _end(self, state: _State) -> Sense | None:
        if state not in self._ends:
            done = (
                self.phrases[index].sense
                for index, slot in state
                if all(optional for _, optional in self.phrases[index].slots[slot:])
            )
            self._ends[state] = next(done, None)
        return self._ends[state]


@cache
def vocabulary() -> Vocabulary:
    """The vocabulary of all word lists.

    Raises:
        WordListError: a phrase that breaks the notation.
    """
    phrases: list[_Phrase] = []
    forms: dict[str, str] = {}
    words: dict[str, int] = {}
    for rank, name in enumerate(WORD_FILES):
        for terminal, values in load(name).items():
            if terminal in _TABLES:
                continue
            for value, templates in values.items():
                for template in templates:
                    slots = _slots(template, f"{name} [{terminal}] {template!r}", forms)
                    phrases.append(_Phrase(slots, Sense(terminal, value)))
                    plain = 9 if terminal == "PLAIN" else rank
                    for accepted, _ in slots:
                        for word in sorted(accepted):
                            words.setdefault(word, plain)
    return Vocabulary(tuple(phrases), words, forms, _first_states(phrases))


def _first_states(phrases: list[_Phrase]) -> dict[str, _State]:
    """For each word, the phrases that may begin with it."""
    first: dict[str, list[tuple[int, int]]] = {}
    for index, phrase in enumerate(phrases):
        for slot, (accepted, optional) in enumerate(phrase.slots):
            for word in accepted:
                first.setdefault(word, []).append((index, slot + 1))
            if not optional:
                break
    return {word: tuple(sorted(set(state))) for word, state in first.items()}


def _slots(
    template: str, where: str, forms: dict[str, str]
) -> tuple[tuple[frozenset[str], bool], ...]:
    """Read one phrase; the verb forms met on the way are added to `forms`."""
    slots = []
    for slot in template.split():
        optional = slot.endswith("?")
        accepted: set[str] = set()
        for word in slot.removesuffix("?").split("|"):
            if not word or "?" in word:
                raise WordListError(f"{where}: slot {slot!r} has an empty word or a stray '?'")
            if word.startswith("~"):
                for form, name in inflections(word[1:]).items():
                    forms.setdefault(form, name)
                    accepted.add(form)
            else:
                accepted.add(word)
        slots.append((frozenset(accepted), optional))
    if all(optional for _, optional in slots):
        raise WordListError(f"{where}: at least one slot must not be optional")
    return tuple(slots)
