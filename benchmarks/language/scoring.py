"""Scoring of how well the fields of a reading agree with an annotated question.

The fields are a projection of the typed meaning, for scoring only. A question has one annotated
query and may have equally good alternatives. Time phrases, reasons and the like are not compared;
it counts that the car answers the right question.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import msgspec

from xavi_dialogue.nlu.projection.fields import TALK, FieldActions, QueryFields


class Question(msgspec.Struct, frozen=True):
    """A line of an annotated file."""

    id: str
    text: str
    query: QueryFields
    style: str
    alternatives: tuple[QueryFields, ...] = ()
    context: tuple[str, ...] = ()  # the passenger's earlier turns, oldest first
    underspecified: str | None = None  # "direction": left or right may be taken for the other

    @property
    def accepted(self) -> tuple[QueryFields, ...]:
        """The annotated query, then its alternatives."""
        return (self.query, *self.alternatives)


@dataclass(frozen=True, slots=True)
class Verdict:
    """The score of a prediction."""

    type: bool  # whether the type is one of those accepted
    exact: bool  # whether all compared fields equal those of an accepted query
    exact_primary: bool  # whether they equal those of the annotated query itself
    false_confident: bool  # whether the car would answer another question without noticing


class Agreement(msgspec.Struct, frozen=True):
    """The verdicts on a group of questions [percent of them]."""

    group: str
    n: int
    type: float
    exact: float
    exact_primary: float
    false_confident: float


def verdict(question: Question, predicted: QueryFields) -> Verdict:
    """Score a prediction.

    It is falsely confident if it is answerable and not exact, and each accepted query either has
    no answer, or is answerable for another actor or with the opposite negation. If some have no
    answer, only the answerable ones decide.
    """
    blurred = question.underspecified == "direction"
    wanted = [_essence(query, blurred) for query in question.accepted]
    got = _essence(predicted, blurred)
    exact = got in wanted
    return Verdict(
        type=any(predicted.type == query.type for query in question.accepted),
        exact=exact,
        exact_primary=got == wanted[0],
        false_confident=not exact
        and predicted.type not in TALK
        and not any(_comparable(predicted, query) for query in question.accepted),
    )


def agreement(group: str, verdicts: Sequence[Verdict]) -> Agreement:
    """Return the shares of verdicts in a group, at least one."""
    return Agreement(
        group,
        len(verdicts),
        _percent([one.type for one in verdicts]),
        _percent([one.exact for one in verdicts]),
        _percent([one.exact_primary for one in verdicts]),
        _percent([one.false_confident for one in verdicts]),
    )


def _percent(held: Sequence[bool]) -> float:
    return 100 * sum(held) / len(held)


def _comparable(predicted: QueryFields, accepted: QueryFields) -> bool:
    """Check whether both are about the same actor, with the same negation."""
    return (
        accepted.type not in TALK
        and predicted.actor == accepted.actor
        and predicted.negated == accepted.negated
    )


def _essence(query: QueryFields, blurred: bool) -> tuple[object, ...]:
    """Return the fields of a query that are compared."""
    if query.type in TALK:
        return (query.type,)
    return (
        query.type,
        query.actor,
        _actions(query.factual, blurred),
        _actions(query.counterfactual, blurred),
        query.negated,
        query.tense,
        query.detail,
    )


def _actions(actions: FieldActions | None, blurred: bool) -> tuple[str, ...]:
    """Return actions for comparison; blurred ones have one direction only."""
    return tuple(a.replace("-right", "-left") if blurred else a for a in actions or ())
