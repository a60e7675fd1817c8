"""Findings: the results of checking propositions against the record."""

from dataclasses import dataclass, replace

from msgspec.structs import replace as changed

from xavi_dialogue.domain.answers import Answer, Beliefs, Course, Priority, Verdict
from xavi_dialogue.domain.facts import Belief, Fact, Gap, Measure
from xavi_dialogue.domain.terms import Proposition

EXPECTED = 0.5  # minimum probability of what is expected


@dataclass(frozen=True, slots=True)
class Finding:
    """Whether a proposition holds, and what supports it, holds instead, or hides it."""

    holds: bool | None
    facts: tuple[Fact, ...] = ()
    gap: Gap | None = None
    believed: tuple[Belief, ...] = ()
    mistaken: bool = False
    probability: float | None = None
    answer: Answer | None = None  # an answer of another type that fits better

    def negated(self) -> "Finding":
        """Return the finding for the negated proposition."""
        probability = None if self.probability is None else 1.0 - self.probability
        holds = None if self.holds is None else not self.holds
        answer: Answer | None = self.answer if isinstance(self.answer, Beliefs) else None
        if isinstance(self.answer, Course | Priority) and self.answer.holds is not None:
            answer = changed(self.answer, holds=not self.answer.holds)
        return replace(self, holds=holds, probability=probability, answer=answer)

    def verdict(
        self, that: Proposition, *, claim: bool = False, challenge: bool = False
    ) -> Verdict:
        """Return the finding as an answer."""
        return Verdict(
            that, self.holds, self.facts, self.gap, claim, challenge,
            self.believed, self.mistaken, self.probability,
        )  # fmt: skip


def unknown(gap: Gap, *facts: Fact) -> Finding:
    """Return the finding that nothing can be known, for a reason."""
    return Finding(None, facts, gap)


def expected(probability: float | None, *facts: Fact, believed: tuple[Belief, ...] = ()) -> Finding:
    """Return the finding about what is still to come, by its probability."""
    if probability is None:
        return Finding(None, facts, "in-future", believed)
    return Finding(probability >= EXPECTED, facts, None, believed, probability=probability)


def known(*measures: Measure) -> tuple[Measure, ...]:
    """Keep those measures that have a value."""
    return tuple(m for m in measures if m.gap is None)
