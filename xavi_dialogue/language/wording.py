"""Wording: the answer side's lexicon and rewrites, read from `grammars/`.

Errors:
    WordingError    a lexicon or rewrite file is at fault, or lacks a word that is asked for
"""

import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Literal

PAPER_ADVERBS = ("never", "unlikely", "probably", "likely", "certainly")
VerbForm = Literal["base", "past", "participle", "gerund"]
_VERB_COLUMNS: dict[VerbForm, int] = {"past": 0, "participle": 1, "gerund": 2}


class WordingError(ValueError):
    """A language file that cannot be used, or a word that it lacks."""


@dataclass(frozen=True, slots=True)
class Rewrite:
    """One post-processing rule: a compiled pattern and what takes its place."""

    find: re.Pattern[str]
    put: str


@dataclass(frozen=True, slots=True)
class Lexicon:
    """Words for actions, components and verbs."""

    actions: Mapping[str, Mapping[str, str]]
    components: Mapping[str, str]
    negligible: Mapping[str, float]  # in each component's unit
    verbs: Mapping[str, tuple[str, ...]]
    described: Mapping[str, str]  # vehicles by the tail of a described actor
    nobody: Mapping[str, str]  # that there is none such, by the same

    def action(self, name: str, *variants: str) -> str:
        """The phrase for an action: of the first variant there is a phrase for."""
        phrases = self.actions.get(name)
        if phrases is None:
            raise WordingError(f"lexicon.toml has no action {name!r}; add [actions.{name}]")
        for variant in (*variants, "say"):
            if variant in phrases:
                return phrases[variant]
        raise WordingError(f"lexicon.toml: [actions.{name}] needs a phrase 'say'")

    def nobody_at(self, place: str) -> str:
        """The phrase for that nobody is where a question describes somebody to be."""
        return self.nobody.get(place, self.nobody["default"])

    def inflect(self, phrase: str, form: VerbForm) -> str:
        """The phrase with its verb, which comes first, in the given form."""
        verb, _, rest = phrase.partition(" ")
        if form == "base":
            return phrase
        forms = self.verbs.get(verb)
        if forms is None:
            raise WordingError(f"lexicon.toml: [verbs] lacks the forms of {verb!r}")
        return f"{forms[_VERB_COLUMNS[form]]} {rest}".strip()


def _read(name: str) -> dict[str, object]:
    try:
        return tomllib.loads((files("grammars") / name).read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as error:
        raise WordingError(f"{name}: {error}") from error


def _table(data: Mapping[str, object], key: str, name: str) -> dict[str, object]:
    table = data.get(key)
    if not isinstance(table, dict):
        raise WordingError(f"{name} needs a table [{key}]")
    return table


@cache
def lexicon() -> Lexicon:
    """The lexicon of `grammars/lexicon.toml`.

    Raises:
        WordingError: a table is missing, or a verb has not three forms.
    """
    data, name = _read("lexicon.toml"), "lexicon.toml"
    actions, verbs = _table(data, "actions", name), _table(data, "verbs", name)
    forms = {k: tuple(map(str, v)) for k, v in verbs.items() if isinstance(v, list)}
    for verb, row in forms.items():
        if len(row) != len(_VERB_COLUMNS):
            raise WordingError(f"{name}: {verb!r} needs past, participle, gerund")
    return Lexicon(
        actions={k: dict(v) for k, v in actions.items() if isinstance(v, dict)},
        components={k: str(v) for k, v in _table(data, "components", name).items()},
        negligible={k: float(str(v)) for k, v in _table(data, "negligible", name).items()},
        verbs=forms,
        described={k: str(v) for k, v in _table(data, "described", name).items()},
        nobody={k: str(v) for k, v in _table(data, "nobody", name).items()},
    )


@cache
def _paper_present() -> dict[str, str]:
    paper = _table(_read("rewrites.toml"), "paper", "rewrites.toml")
    return {k: str(v) for k, v in _table(paper, "present", "rewrites.toml").items()}


@cache
def rewrites(style: str) -> tuple[Rewrite, ...]:
    """The post-processing rules of a style, in order.

    Raises:
        WordingError: a rule lacks `find` or `put`, or its pattern is not a regular expression.
    """
    section = _table(_read("rewrites.toml"), style, "rewrites.toml")
    rules = section.get("rule", [])
    assert isinstance(rules, list)
    past = "|".join(map(re.escape, _paper_present()))
    adverb = "|".join(PAPER_ADVERBS)
    made = []
    for rule in rules:
        try:
            find = rule["find"].replace("<adverb>", f" (?:{adverb})")
            find = find.replace("<past>", f"(?P<past>{past})")
            made.append(Rewrite(re.compile(find), rule["put"]))
        except (KeyError, re.error) as error:
            raise WordingError(f"rewrites.toml: rule {rule!r} of {style}: {error}") from error
    return tuple(made)


def rewrite(text: str, style: str) -> str:
    """Apply a style's post-processing rules, each in turn until it matches no more."""
    present = _paper_present()
    for rule in rewrites(style):
        for _ in range(len(text)):  # a rule that feeds itself for ever is cut off
            match = rule.find.search(text)
            if match is None:
                break
            past = match.groupdict().get("past") or ""
            put = match.expand(rule.put.replace("<present>", present.get(past, "")))
            text = text[: match.start()] + put + text[match.end() :]
    return text
