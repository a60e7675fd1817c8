"""Rewriting: functions that replace or collect parts of terms at any depth."""

from collections.abc import Callable, Iterator
from functools import cache
from types import NoneType
from typing import Any, Final, TypeVar

import msgspec
from msgspec.structs import replace

from xavi_dialogue.domain.terms import Wanted

T = TypeVar("T")
V = TypeVar("V")


def rewrite(value: T, change: Callable[[Any], Any]) -> T:
    """Replace every part for which `change` returns another object; outermost parts first."""
    changed = change(value)
    if changed is not value:
        return changed  # type: ignore[no-any-return]
    if isinstance(value, tuple):
        parts = tuple(rewrite(part, change) for part in value)
        same = all(a is b for a, b in zip(parts, value, strict=True))
        return value if same else parts  # type: ignore[return-value]
    if isinstance(value, msgspec.Struct):
        new: dict[str, Any] = {}
        for name in value.__struct_fields__:
            part = getattr(value, name)
            made = rewrite(part, change)
            if made is not part:
                new[name] = made
        return replace(value, **new) if new else value
    return value


def substitute(value: T, old: object, new: object) -> T:
    """Replace every part that equals `old`."""
    return rewrite(value, lambda part: new if _same(part, old) else part)


def with_wanted(value: T, thing: object) -> T:
    """Replace every `Wanted`, which stands for what is asked for, by a thing."""
    return rewrite(value, lambda part: thing if isinstance(part, Wanted) else part)


def parts(value: object, sort: type[V] | tuple[type[V], ...]) -> Iterator[V]:
    """Yield every part of a sort, outermost and leftmost first."""
    left = [value]  # parts still to visit; the next one is last
    while left:
        part = left.pop()
        if isinstance(part, sort):
            yield part
        kind: type = type(part)
        if kind in _PLAIN:
            continue
        if isinstance(part, tuple):
            left.extend(reversed(part))
        elif isinstance(part, msgspec.Struct):
            left.extend([getattr(part, name) for name in _fields(kind)])


_PLAIN: Final = frozenset((str, int, float, bool, NoneType))


@cache
def _fields(kind: type[msgspec.Struct]) -> tuple[str, ...]:
    """Return the names of fields, the last one first."""
    return tuple(reversed(kind.__struct_fields__))


def first(value: object, sort: type[V] | tuple[type[V], ...]) -> V | None:
    """Find the first part of a sort."""
    return next(parts(value, sort), None)


def _same(part: object, old: object) -> bool:
    return type(part) is type(old) and part == old
