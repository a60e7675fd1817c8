"""Actual causes: the smallest sets of vehicles without which an action does not come about.

This is the but-for test on sets, after Halpern and Pearl (2005). A set is a cause if the action is
gone without it and is not gone without any part of it. Sets of one and of two vehicles are tried. A
single necessary vehicle is the cause; several that are each necessary are causes together ("both").
If no single one is necessary but a set of two is, either would have been enough (symmetric
overdetermination), provided that both are at work in the plan as it is. If one of them is at work
only without the other, it is pre-empted by that one (Halpern 2016, Actual Causality, 2.3).

If no such set is a cause, all vehicles are removed at once. If the action is not gone then, no
vehicle is a cause. If it is, the set is reduced. The vehicles are put in order: at work as things
are, at work without those, near. Halving finds the shortest beginning of that list without which
the action is gone. Of these, each is dropped if the action is gone without the rest. What is gone
without some vehicles is taken to be gone without more. If there are too few trials for that, nobody
is named: only several vehicles together are the cause.

A vehicle may matter only by what it makes a cause do, such as making the vehicle ahead wait. So
those that have held up a necessary vehicle are tried as well.

Each trial plans again, so trials are few: the smallest and most suspicious sets come first.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from msgspec.structs import replace

from xavi_dialogue.domain.evidence import Causation

SINGLES = 3  # vehicles that are tried one by one
PAIRS = 2  # sets of two that are tried if none of these is necessary
TRIALS = 8  # maximum number of sets that are tried while the set of all is reduced


@dataclass(frozen=True, slots=True)
class Trial:
    """What planning again without a set of vehicles shows."""

    gone: bool | None  # the action does not come about; None: that could not be planned
    instead: tuple[int, ...] = ()  # vehicles that are at work then, most important first


Try = Callable[[tuple[int, ...]], Trial]


def actual_causes(
    suspects: Sequence[int],
    reserve: Sequence[int],
    trial: Try,
    behind: Callable[[int], Sequence[int]] = lambda _: (),
    everybody: Sequence[int] = (),
) -> Causation:
    """Find the vehicles that an action depends on: the smallest set of one or two, else several.

    Args:
        suspects: the vehicles at work as things are, most important first.
        reserve: vehicles that may matter besides a necessary one, without being at work.
        trial: plans again without a set.
        behind: returns who makes a necessary vehicle do what it does, and so is necessary, too.
        everybody: all vehicles that are there except for the ego, most relevant first.
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
        if without(other).gone:  # the vehicle at work is held up itself, and does not matter
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
    """Yield the pairs to try: each vehicle with the one that takes its place, then other pairs.

    If there are only two vehicles, they are one of the pairs.
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
    """Find a set without which the action is gone, as small as the number of trials allows."""
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
    """Reduce a set without which the action is gone, and check whether the result is minimal.

    Args:
        ranked: the set; the first vehicles are the last to be removed from it.
        at_work: how many of the first are tried by themselves before the set is halved.
        without: plans again without vehicles, as long as there are trials left.
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
    """Return the vehicles without which, one at a time, the action comes about all the same."""
    return tuple(group[0] for group, one in known.items() if len(group) == 1 and one.gone is False)
