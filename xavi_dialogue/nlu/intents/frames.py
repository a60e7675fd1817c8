"""Frames: the plain question of each intent, as the grammar reads it."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Final

from xavi_dialogue.domain.meaning import Act
from xavi_dialogue.domain.rewriting import substitute
from xavi_dialogue.domain.terms import Thing, Vehicle
from xavi_dialogue.nlu.intents.classifier import Intent
from xavi_dialogue.nlu.intents.signature import signature
from xavi_dialogue.nlu.parse import Parser
from xavi_dialogue.nlu.text.tables import load

FORM: Final = 3  # words of a signature that tell the form of a question
_SLOT: Final = "{x}"
_STAND_IN: Final = Vehicle(0)
_SPOKEN: Final = "vehicle 0"  # reads as the stand-in
_SHOWN: Final = "that vehicle"
_ALWAYS: Final = "any"
_VAGUE: Final = "vague"
_PERSONS: Final = frozenset(("other", "that", "duty", "yes"))


@dataclass(frozen=True, slots=True)
class Plain:
    """A plain question."""

    text: str  # as the passenger would put it
    acts: tuple[Act, ...]
    vague: bool  # it says less than most questions of its intent


def plain(intent: Intent, thing: Thing | None) -> Plain | None:
    """Give the plain question of an intent; None where there is none.

    Args:
        intent: what is asked.
        thing: the other vehicle that is spoken of, if any.
    """
    table: dict[str, Any] = load("intents.toml").get(intent.name, {})
    special = table.get(intent.action)
    entries = [entry for entry in (special, table) if isinstance(entry, dict)]
    for entry in entries:
        found = entry.get(intent.tense, entry.get(_ALWAYS)) or ()
        for text in (found,) if isinstance(found, str) else found:
            if (question := spoken(text, thing)) is not None:
                return replace(question, vague=bool(entry.get(_VAGUE)))
    return None


def spoken(text: str, thing: Thing | None) -> Plain | None:
    """Give a plain question by its text; None where it is of another vehicle, and there is none."""
    if _SLOT in text and thing is None:
        return None
    acts = substitute(_acts(text), _STAND_IN, thing)
    return Plain(text.replace(_SLOT, _SHOWN), acts, vague=False)


def is_of(act: Act, name: str) -> bool:
    """Tell whether an act asks what the plain questions of an intent ask, of whomever.

    The form of the question is the same, and what is said of somebody.
    """
    form, said = _core(act)
    return any(form == one and (not other or said == other) for one, other in _cores(name))


@cache
def _cores(name: str) -> frozenset[tuple[str, str]]:
    table: dict[str, Any] = load("intents.toml").get(name, {})
    return frozenset(_core(act) for text in _all(table) for act in _acts(text))


def _all(table: dict[str, Any]) -> Iterator[str]:
    for key, entry in table.items():
        if isinstance(entry, dict):
            yield from _all(entry)
        elif key != _VAGUE:
            yield from (entry,) if isinstance(entry, str) else entry


def _core(act: Act) -> tuple[str, str]:
    """Give the form of an act and what is said in it: ("Ask Why Not", "overtake")."""
    words = signature(act).split()
    said = next((word for word in words if word[0].islower() and word not in _PERSONS), "")
    denied = ("Not",) if "Not" in words else ()
    return " ".join((*words[:FORM], *denied)), said


@cache
def _acts(text: str) -> tuple[Act, ...]:
    return Parser().read(text.replace(_SLOT, _SPOKEN))[0].acts
