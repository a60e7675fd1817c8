"""A simple rival of statements about foils: the outcomes of foils of that name on other rides."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import NamedTuple, TypeAlias

from benchmarks.fidelity.cases import Case
from benchmarks.figures import mean
from planner.record.trace import OUTCOMES, Action, Outcome

Key: TypeAlias = tuple[str, int, float, Action]


class Guess(NamedTuple):
    """The expectation by the name of a foil alone."""

    outcome: Outcome  # what happens most often; ties go to the earlier one of OUTCOMES
    later: float | None  # [s] mean of those that arrived


def key_of(case: Case) -> Key:
    """Return the key of a case, which is unique."""
    return case.scenario, case.seed, case.time, case.foil


def by_name(cases: Sequence[Case]) -> Mapping[Key, Guess]:
    """Guess each case by the foil's name, from other seeds of its scenario or family.

    If there are none, all other rides are used. A foil that no other ride has is left out.
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
