"""Actual causes: the smallest sets of vehicles without which a deed does not come about.

But-for on sets, after Halpern and Pearl (2005): a set is a cause where the deed is gone without
it and is not gone without any part of it. Sets of one and of two vehicles are tried. One vehicle
that is necessary is the cause; several, each of which is, are causes together ("both"). Where
none is and two are, either would have been enough (symmetric overdetermination) if both are at
work as things are; if one of them is at work only where the other is not there, it is pre-empted
by that one (Halpern 2016, Actual Causality, 2.3). Where no one and no two are, all others are
taken away at once: where it is not gone then, no vehicle is a cause; where it is, that set is made
as small as it gets: in the order of who is at work as things are, then of who is so where those
are not there, then of who is near, the shortest beginning without which it is gone, found by
halving; of that one after the other is kept where it is not gone without the rest. What is gone
without some is taken to be gone without more. Where the trials do not suffice for that, nobody is
named: only several are it, together.

One may matter only by what it makes a cause do, as somebody because of whom the one ahead waits.
So those who have held a necessary vehicle up are tried as well.

A trial is planning again, so they are few: the smallest and most suspicious sets come first.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from msgspec.structs import replace

from xavi_dialogue.domain.evidence import Causation

SINGLES = 3  # vehicles that are tried one by one
PAIRS = 2  # sets of two that are tried where none of these is necessary
TRIALS = 8  # sets that are tried at most before that of all others is made no smaller


@dataclass(frozen=True, slots=True)
class Trial:
    """What planning again without a set of vehicles shows."""

    gone: bool | None  # the deed does not come about; None: that could not be planned
    instead: tuple[int, ...] = ()  # who is then at work, most important first


Try = Callable[[tuple[int, ...]], Trial]


def actual_causes(
    suspects: Sequence[int],
    reserve: Sequence[int],
    trial: Try,
    behind: Callable[[int], Sequence[int]] = lambda _: (),
    everybody: Sequence[int] = (),
) -> Causation:
    """Find the vehicles that a deed hangs on: the smallest sets of at most two, else several.

    Args:
        suspects: the vehicles at work as things are, most important first.
        reserve: who may matter beside one that is necessary, without being at work itself.
        trial: plans again without a set.
        behind: who makes a vehicle that is necessary do what it does, and so is necessary too.
        everybody: all vehicles that are there, but the ego, most relevant first.
    """
    known: dict[tuple[int, ...], Trial] = {}

    def without(*vehicles: int) -> Trial:
        group = tuple(sorted(vehicles))
        if group not in known:
            known[group] = trial(group)
        return known[group]

    singles = list(suspects[:SINGLES])
    needed = [vehicle for vehicle in singles if without(vehicle).gone]
    if needed:
        others = [v for v in reserve if v not in singles][: SINGLES - len(singles)]
        needed += [vehicle for vehicle in others if without(vehicle).gone]
        needed += dict.fromkeys(v for one in needed for v in behind(one) if v not in needed)
        return Causation("one" if len(needed) == 1 else "both", tuple(needed), _cleared(known))
    for one, other in _pairs(singles, without, everybody):
        if without(other).gone:  # who is at work is held up itself, and of no matter
            return Causation("one", (other,), _cleared(known))
        if without(one, other).gone:
            at_work = one in suspects and other in suspects
            rest = tuple(v for v in _cleared(known) if v not in (one, other))
            return Causation("either" if at_work else "pre-empted", (one, other), rest)
    if len(everybody) > 2 and without(*everybody).gone:
        several = _several(suspects, everybody, known, without)
        rest = tuple(v for v in _cleared(known) if v not in several.vehicles)
        return replace(several, cleared=rest)
    untried = any(one.gone is None for one in known.values())
    return Causation("open" if untried else "none", (), _cleared(known))


def _pairs(
    singles: Sequence[int], without: Callable[..., Trial], everybody: Sequence[int]
) -> Iterator[tuple[int, int]]:
    """The sets of two to try: each with who takes its place first, then those at work in pairs.

    Where there are but two vehicles, they are one of these sets.
    """
    refuted = [vehicle for vehicle in singles if without(vehicle).gone is False]
    replaced = ((one, other) for one in refuted for other in without(one).instead[:1])
    pairs = [*replaced, *combinations(refuted, 2)]
    if len(everybody) == 2 and refuted:
        pairs.append((refuted[0], next(v for v in everybody if v != refuted[0])))
    yield from list(_distinct(pairs))[:PAIRS]


def _several(
    suspects: Sequence[int],
    everybody: Sequence[int],
    known: Mapping[tuple[int, ...], Trial],
    without: Callable[..., Trial],
) -> Causation:
    """Without whom together it is gone, made as small as it gets within the trials."""
    at_work = dict.fromkeys((*suspects, *(v for one in known.values() for v in one.instead)))
    ranked = [v for v in dict.fromkeys((*at_work, *everybody)) if v in everybody]

    def affordable(*vehicles: int) -> Trial:
        is_known = tuple(sorted(vehicles)) in known
        return without(*vehicles) if is_known or len(known) < TRIALS else Trial(None)

    found, minimal = _smallest(ranked, len(at_work), affordable)
    if not minimal or len(found) > 2:
        return Causation("several", tuple(sorted(found)), minimal=minimal)
    if len(found) == 1:
        return Causation("one", found)
    apart = found[0] in suspects and found[1] not in suspects
    return Causation("pre-empted" if apart else "either", found)


def _smallest(
    ranked: Sequence[int], at_work: int, without: Callable[..., Trial]
) -> tuple[tuple[int, ...], bool]:
    """Make a set without which it is gone smaller, and tell whether none of the rest is too many.

    Args:
        ranked: the set, those that are kept longest first.
        at_work: how many of them are tried by themselves before they are halved.
        without: plans again, as often as it may.
    """
    unknown = False

    def gone(*vehicles: int) -> bool:
        nonlocal unknown
        found = without(*vehicles).gone
        unknown = unknown or found is None
        return bool(found)

    low, high, middle = 0, len(ranked), at_work
    while high - low > 1:  # gone without the first `high`, not without the first `low`
        middle = middle if low < middle < high else (low + high) // 2
        low, high = (low, middle) if gone(*ranked[:middle]) else (middle, high)
    kept = list(ranked[:high])
    for one in reversed(ranked[: high - 1]):
        rest = [v for v in kept if v != one]
        if gone(*rest):
            kept = rest
    return tuple(kept), not unknown


def _distinct(pairs: Iterable[tuple[int, int]]) -> Iterator[tuple[int, int]]:
    found: set[frozenset[int]] = set()
    for pair in pairs:
        if frozenset(pair) not in found and pair[0] != pair[1]:
            found.add(frozenset(pair))
            yield pair


def _cleared(known: dict[tuple[int, ...], Trial]) -> tuple[int, ...]:
    """Return those without whom, each by itself, the deed comes about as well."""
    return tuple(group[0] for group, one in known.items() if len(group) == 1 and one.gone is False)
