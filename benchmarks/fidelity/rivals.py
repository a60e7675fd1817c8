"""A cheap rival of what is said of foils: what foils of that name came to on other rides."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple, TypeAlias

from benchmarks.fidelity.cases import Case
from benchmarks.figures import mean
from planner.record.trace import OUTCOMES, Action, Outcome

Key: TypeAlias = tuple[str, int, float, Action]


class Guess(NamedTuple):
    """What the name of a foil alone lets one expect."""

    outcome: Outcome  # what happens most often; ties go to the earlier one of OUTCOMES
    later: float | None  # [s] mean of those that arrived


def key_of(case: Case) -> Key:
    """Return what tells a case from all others."""
    return case.scenario, case.seed, case.time, case.foil


def by_name(cases: Sequence[Case]) -> Mapping[Key, Guess]:
    """Guess each case by the foil's name, from other seeds of its scenario or family.

    Where there are none, from all other rides; a foil that no other ride has is left out.
    """
    found = {}
    for case in cases:
        alike = [c for c in cases if c.foil == case.foil]
        known = [c for c in alike if c.scenario == case.scenario and c.seed != case.seed]
        known = known or [c for c in alike if c.scenario != case.scenario]
        if known:
            found[key_of(case)] = _guess(known)
    return found


def _guess(known: Sequence[Case]) -> Guess:
    counts = Counter(case.happened.outcome for case in known)
    outcome = max(OUTCOMES, key=lambda one: counts[one])
    return Guess(outcome, mean([case.later for case in known if case.later is not None]))
