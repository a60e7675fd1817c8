"""Planting a fault in modules that are loaded: the code of their functions is exchanged."""

import functools
import gc
from collections import defaultdict
from collections.abc import Iterable, Iterator
from types import CodeType, FunctionType
from typing import Any, TypeAlias

Key: TypeAlias = tuple[str, int]  # qualified name and first line
OPTIMISED = 0x01  # flag of a code: it is that of a function, not of a class or module
Functions: TypeAlias = dict[str, dict[Key, list[FunctionType]]]  # by file


class NotSwapped(Exception):
    """The loaded functions cannot take this change; the module must be loaded anew."""


def living(files: Iterable[str]) -> Functions:
    """The functions that exist now and come from these files."""
    wanted = set(files)
    found: Functions = defaultdict(lambda: defaultdict(list))
    for thing in gc.get_objects():
        if isinstance(thing, FunctionType) and thing.__code__.co_filename in wanted:
            found[thing.__code__.co_filename][key(thing.__code__)].append(thing)
    return found


def caches(files: Iterable[str]) -> list[Any]:
    """The caches that exist now around functions of these files."""
    wanted = set(files)
    return [
        thing
        for thing in gc.get_objects()
        if isinstance(thing, functools._lru_cache_wrapper)
        and (inner := getattr(thing, "__wrapped__", None)) is not None
        and getattr(getattr(inner, "__code__", None), "co_filename", None) in wanted
    ]


def key(code: CodeType) -> Key:
    """What tells a function from others of its file, but for two lambdas on one line."""
    return code.co_qualname, code.co_firstlineno


def codes(code: CodeType) -> Iterator[CodeType]:
    """Every code that is made within a code, at any depth, and itself."""
    yield code
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield from codes(inner)


def swap(old: CodeType, new: CodeType, functions: dict[Key, list[FunctionType]]) -> None:
    """Give the functions of a module its new code, wherever that differs.

    Raises:
        NotSwapped: if what differs is not in a function, or its variables are bound differently.
    """
    before, after = list(codes(old)), list(codes(new))
    if [key(code) for code in before] != [key(code) for code in after]:
        raise NotSwapped("the functions differ")
    if old.co_code != new.co_code or _plain(old) != _plain(new):
        raise NotSwapped("the module itself differs")
    for one, other in zip(before[1:], after[1:], strict=True):
        if one == other:
            continue
        living_ones = functions.get(key(one), [])
        if not living_ones and one.co_flags & OPTIMISED and "<locals>" not in one.co_qualname:
            raise NotSwapped("it is run when the module is loaded")
        for function in living_ones:
            if function.__code__ != one:
                raise NotSwapped("two functions are called alike")
            if one.co_freevars != other.co_freevars:
                raise NotSwapped("its variables are bound differently")
            function.__code__ = other


def _plain(code: CodeType) -> list[object]:
    """The constants of a code, and the codes of the classes within it, without its functions."""
    return [
        _of_class(constant) if isinstance(constant, CodeType) else (type(constant), constant)
        for constant in code.co_consts
    ]


def _of_class(code: CodeType) -> object:
    return None if code.co_flags & OPTIMISED else (code.co_code, _plain(code))
