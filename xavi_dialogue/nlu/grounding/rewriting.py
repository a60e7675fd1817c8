"""Rewriting: replace or collect parts of terms, whatever they are nested in."""

from collections.abc import Callable, Iterator
from typing import Any, TypeVar

import msgspec
from msgspec.structs import replace

T = TypeVar("T")
V = TypeVar("V")


def rewrite(value: T, change: Callable[[Any], Any]) -> T:
    """Replace every part for which `change` gives something else; outermost parts first."""
    changed = change(value)
    if changed is not value:
        return changed  # type: ignore[no-any-return]
    if isinstance(value, tuple):
        parts = tuple(rewrite(part, change) for part in value)
        same = all(a is b for a, b in zip(parts, value, strict=True))
        return value if same else parts  # type: ignore[return-value]
    if isinstance(value, msgspec.Struct):
        found = {name: getattr(value, name) for name in value.__struct_fields__}
        new = {name: rewrite(part, change) for name, part in found.items()}
        new = {name: part for name, part in new.items() if part is not found[name]}
        return replace(value, **new) if new else value
    return value


def substitute(value: T, old: object, new: object) -> T:
    """Replace every part that equals `old`."""
    return rewrite(value, lambda part: new if _same(part, old) else part)


def parts(value: object, sort: type[V] | tuple[type[V], ...]) -> Iterator[V]:
    """Yield every part of a sort, outermost and leftmost first."""
    if isinstance(value, sort):
        yield value
    if isinstance(value, tuple):
        for part in value:
            yield from parts(part, sort)
    elif isinstance(value, msgspec.Struct):
        for name in value.__struct_fields__:
            yield from parts(getattr(value, name), sort)


def first(value: object, sort: type[V] | tuple[type[V], ...]) -> V | None:
    """Find the first part of a sort."""
    return next(parts(value, sort), None)


def _same(part: object, old: object) -> bool:
    return type(part) is type(old) and part == old
