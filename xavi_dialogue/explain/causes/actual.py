"""Actual causes: the smallest sets of vehicles without which a deed does not come about.

But-for on sets, after Halpern and Pearl (2005): a set is a cause where the deed is gone without
it and is not gone without any part of it. Sets of one and of two vehicles are tried. One vehicle
that is necessary is the cause; several, each of which is, are causes together ("both"). Where
none is and two are, either would have been enough (symmetric overdetermination) if both are at
work as things are; if one of them is at work only where the other is not there, it is pre-empted
by that one (Halpern 2016, Actual Causality, 2.3). Where no one and no two are, all others are
taken away at once: where it is gone then, several are causes together, those at work where they
are enough; where it is not, no vehicle is a cause.

One may matter only by what it makes a cause do, as somebody because of whom the one ahead waits.
So those who have held a necessary vehicle up are tried as well.

A trial is planning again, so they are few: the smallest and most suspicious sets come first.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from xavi_dialogue.domain.evidence import Causation

SINGLES = 3  # vehicles that are tried one by one
PAIRS = 2  # sets of two that are tried where none of these is necessary


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
        everybody: all vehicles that are there, but the ego.
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
    several = _several(suspects, everybody, without)
    if several:
        rest = tuple(v for v in _cleared(known) if v not in several)
        return Causation("several", several, rest)
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
    suspects: Sequence[int], everybody: Sequence[int], without: Callable[..., Trial]
) -> tuple[int, ...]:
    """Without whom together it is gone: those at work, else all that are there; () it is not."""
    every, at_work = tuple(sorted(everybody)), tuple(sorted(suspects))
    if len(every) <= 2 or not without(*every).gone:
        return ()
    return at_work if 2 < len(at_work) < len(every) and without(*at_work).gone else every


def _distinct(pairs: Iterable[tuple[int, int]]) -> Iterator[tuple[int, int]]:
    found: set[frozenset[int]] = set()
    for pair in pairs:
        if frozenset(pair) not in found and pair[0] != pair[1]:
            found.add(frozenset(pair))
            yield pair


def _cleared(known: dict[tuple[int, ...], Trial]) -> tuple[int, ...]:
    """Those without whom, each by itself, the deed comes about as well."""
    return tuple(group[0] for group, one in known.items() if len(group) == 1 and one.gone is False)
