"""Rewriting: functions that replace or collect parts of terms at any depth."""

from collections.abc import Callable, Iterator
from functools import cache
from types import UnionType
from typing import Annotated, Any, Final, Literal, TypeVar, Union, get_args, get_origin

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
    sorts: tuple[type, ...] = sort if isinstance(sort, tuple) else (sort,)
    left = [value]  # parts still to visit; the next one is last
    while left:
        part = left.pop()
        if isinstance(part, sort):
            yield part
        if isinstance(part, tuple):
            left.extend(reversed(part))
        elif isinstance(part, msgspec.Struct):
            left.extend([getattr(part, name) for name in _fields(type(part), sorts)])


@cache
def _fields(kind: type[msgspec.Struct], sorts: tuple[type, ...]) -> tuple[str, ...]:
    """Return the names of the fields that may contain parts of some sorts, the last one first."""
    fields = reversed(_declared(kind))
    return tuple(name for name, declared in fields if _may_contain(declared, sorts))


@cache
def _declared(kind: type[msgspec.Struct]) -> tuple[tuple[str, object], ...]:
    """Return the names of the fields with their declared types."""
    return tuple((field.name, field.type) for field in msgspec.structs.fields(kind))


def _may_contain(declared: object, sorts: tuple[type, ...]) -> bool:
    """Check whether a value of a declared type may be of one of the sorts, or contain one."""
    return any(
        not isinstance(one, type) or any(issubclass(one, s) or issubclass(s, one) for s in sorts)
        for one in _within(declared)
    )


@cache
def _within(declared: object) -> frozenset[object]:
    """Return the types of all values within a declared type; those of unknown sorts as declared."""
    left, found = [declared], set[object]()
    while left:
        one = left.pop()
        if one in found:
            continue
        if get_origin(one) is Literal:
            found.update(type(value) for value in get_args(one))
        elif get_origin(one) in _CONTAINERS:
            left.extend(part for part in get_args(one) if part is not Ellipsis)
        else:
            found.add(one)
            if isinstance(one, type) and issubclass(one, msgspec.Struct):
                left.extend(inner for _, inner in _declared(one))
                left.extend(one.__subclasses__())
    return frozenset(found)


#: Types of which the arguments are the types of parts.
_CONTAINERS: Final = frozenset((tuple, Union, UnionType, Annotated))


def first(value: object, sort: type[V] | tuple[type[V], ...]) -> V | None:
    """Find the first part of a sort."""
    return next(parts(value, sort), None)


def _same(part: object, old: object) -> bool:
    return type(part) is type(old) and part == old
