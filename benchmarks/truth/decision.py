"""The decision that an answer is about: fact and foil, with their outcomes in the record."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product

from benchmarks.truth.phrases import acts
from benchmarks.truth.reckoning import Actions, Reckoning, Side, Term, gains, recorded
from planner.record.trace import Action, Outcome, PlanTrace


@dataclass(frozen=True)
class Decision:
    """A recorded decision, with the plans made again from it with further rollouts."""

    trace: PlanTrace
    again: tuple[PlanTrace, ...] = ()
    before: PlanTrace | None = None  # the decision before the one in force at the question
    latest: PlanTrace | None = None  # the decision in force at the question
    without: tuple[PlanTrace, ...] = ()  # plans made again with vehicles removed
    asked: Actions = ()  # the foil that the question names

    @cached_property
    def records(self) -> tuple[Reckoning, ...]:
        """Return the decision, and each plan made again from it, for calculations."""
        return tuple(Reckoning(trace) for trace in (self.trace, *self.again))

    @property
    def plan(self) -> Actions:
        """Return the actions that were chosen."""
        return self.records[0].plan

    def prefixes(self, kinds: Sequence[frozenset[Action]]) -> list[Actions]:
        """Return the sequences of actions that a phrase may mean, the most literal first.

        An action that is not taken at once may be taken after the plan has continued for a while.
        """
        found: list[Actions] = []
        for depth in range(len(self.plan) + 1):
            head = self.plan[:depth]
            if set(head) - {"continue"} and depth > 0:
                break
            found += [(*head, *tail) for tail in product(*(sorted(one) for one in kinds))]
        return [one for one in found if one != self.plan[: len(one)]]

    def pairs(self, foil: Actions) -> Iterator[tuple[Side, Side]]:
        """Yield fact and foil by record and estimator, each unpaired, then paired by situation."""
        for record in self.records:
            for fact, there in zip(record.chosen(), record.sides(foil), strict=False):
                yield fact, there
                both = record.paired(fact, there)
                if both is not None:
                    yield both

    def foil_of(self, text: str) -> Actions | None:
        """Return the foil that a phrase names; None if it was not tried."""
        kinds = acts(text)
        for depth in range(len(kinds), 0, -1):
            for prefix in self.prefixes(kinds[:depth]):
                if any(record.sides(prefix) for record in self.records):
                    return prefix
        return None

    def risks(self, prefix: Actions | None, struck: tuple[int, ...] = ()) -> list[float]:
        """Return P(collision) of a plan by record and estimator; None is the plan chosen."""
        return self.chances("collision", prefix, struck)

    def chances(
        self, outcome: Outcome, prefix: Actions | None, struck: tuple[int, ...] = ()
    ) -> list[float]:
        """Return the probability of an outcome of a plan, by record and estimator."""
        found = [
            side.chance(outcome, struck)
            for record in self.records
            for side in (record.chosen() if prefix is None else record.sides(prefix))
        ]
        if prefix is not None:
            found += [foil.chance(outcome, struck) for _, foil in self.pairs(prefix)]
        return found

    def drives(self) -> list[Side]:
        """Return the plan that was chosen, by record and estimator."""
        return [side for record in self.records for side in record.chosen()]

    def gains(self, foil: Actions) -> list[dict[Term, float]]:
        """Return the advantage [s] of the plan over a foil by term, by record and estimator.

        Terms are calculated from the rollouts that arrive, and also as the rollouts record them.
        """
        pairs = list(self.pairs(foil))
        found = [gains(fact, there) for fact, there in pairs]
        return found + [one for pair in pairs if (one := recorded(*pair)) is not None]

    def values(self, foil: Actions) -> list[float]:
        """Return the total advantage [s] of the plan over a foil, by record and estimator."""
        return [fact.value - there.value for fact, there in self.pairs(foil)]

    def rivals(self) -> Actions:
        """Return the other first actions that were tried."""
        return tuple(a for a in self.records[0].first_actions if a not in self.plan[:1])
