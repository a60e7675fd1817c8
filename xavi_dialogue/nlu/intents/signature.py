"""Signature: the shape of an act, in words, without times, manners and who is meant."""

from collections.abc import Sequence
from typing import Any, Final

import msgspec

from xavi_dialogue.domain.meaning import Act, Ask, Elliptic, Request
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Nobody,
    Pronoun,
    Vehicle,
    Vehicles,
    Wanted,
)

_OTHERS: Final = (Vehicle, Vehicles, Described, Nobody, Everyone)
_LEFT_OUT: Final = frozenset(("time", "tense", "manner", "where", "then", "about", "tag", "words"))
_DUTIES: Final = frozenset(("must", "should"))
_POINTING: Final = frozenset(("it", "that", "this"))


def asking_acts(acts: Sequence[Act]) -> tuple[Act, ...]:
    """Give the acts that want something to be stated or done; all of them where none does."""
    found = tuple(act for act in acts if isinstance(act, Ask | Request | Elliptic))
    return found or tuple(acts)


def signature(act: Act) -> str:
    """Give the shape of an act: "Ask Why Not Happens overtake Ego other"."""
    return " ".join(_words(act))


def _words(value: Any) -> list[str]:
    if value is None or isinstance(value, bool | int | float):
        return [] if not isinstance(value, bool) or not value else ["yes"]
    if isinstance(value, str):
        return [value]
    if isinstance(value, tuple):
        return [word for part in value for word in _words(part)]
    if isinstance(value, Pronoun):
        return ["that" if value.form in _POINTING else "other"]
    if isinstance(value, _OTHERS):
        return ["other"]
    if isinstance(value, Ego | Wanted):
        return [type(value).__name__]
    if isinstance(value, Event):
        modal = ["duty"] if value.modal in _DUTIES else []
        parts = (value.action, value.side, value.actor, value.object)
        return modal + [word for part in parts for word in _words(part)]
    if isinstance(value, msgspec.Struct):
        names = (name for name in value.__struct_fields__ if name not in _LEFT_OUT)
        inner = [word for name in names for word in _words(getattr(value, name))]
        return [type(value).__name__, *inner]
    return []
