"""Word lists: the closed vocabulary, read from the TOML files in `grammars/`.

Errors::

    WordListError   a phrase breaks the notation; names file, terminal and phrase
"""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

from xavi_dialogue.language.phrases import Automaton, PhraseError, Sense

WORD_FILES = (
    "words_actions.toml",
    "words_actors.toml",
    "words_frames.toml",
    "words_talk.toml",
    "words_english.toml",
)
PLAIN_RANK = 9  # of words that are English and no more
_TABLES = frozenset(
    {"contractions", "numbers", "homophones", "irregular", "languages", "tags", "repairs"}
)
_VOWELS = frozenset("aeiou")


class WordListError(ValueError):
    """A phrase of a word list breaks the notation."""


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """Every phrase the parser knows, and every word in them."""

    phrases: Automaton
    terminals: frozenset[str]
    words: dict[str, int]  # word -> rank of the first list that has it, actions first
    forms: dict[str, str]  # word -> form of a verb: base, third, past, part, gerund


@cache
def load(name: str) -> dict[str, Any]:
    """One TOML file of the package `grammars`."""
    return tomllib.loads(resources.files("grammars").joinpath(name).read_text(encoding="utf-8"))


def english() -> dict[str, Any]:
    """Contractions, numbers, irregular verbs and the like."""
    return load("words_english.toml")


@cache
def vocabulary() -> Vocabulary:
    """The vocabulary of all word lists.

    Raises:
        WordListError: a phrase that breaks the notation.
    """
    forms: dict[str, str] = {}
    words: dict[str, int] = {}
    terminals: set[str] = set()

    def expand(verb: str) -> frozenset[str]:
        for form, name in inflections(verb).items():
            forms.setdefault(form, name)
        return frozenset(inflections(verb))

    automaton = Automaton(expand)
    for rank, file in enumerate(WORD_FILES):
        for terminal, values in load(file).items():
            if terminal in _TABLES:
                continue
            terminals.add(terminal)
            for value, phrases in values.items():
                for phrase in phrases:
                    try:
                        found = automaton.add(phrase, Sense(terminal, value))
                    except PhraseError as error:
                        raise WordListError(f"{file} [{terminal}] {phrase!r}: {error}") from error
                    for word in sorted(found):
                        words.setdefault(word, PLAIN_RANK if terminal == "PLAIN" else rank)
    return Vocabulary(automaton, frozenset(terminals), words, forms)


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
