"""Kinds: what a text may be, as the judge tells them apart.

A kind is a query type, or a part of one where texts look alike for another reason: a follow-up
that asks for more, one that puts another vehicle into the question before, a reason to decline.
"""

from xavi_dialogue.explain.query import Query

LEAN = "lean"  # the question before it, with another vehicle, action or time
WHICH = "which"  # which vehicle was meant
_OUT = "out_of_scope"


def kind_of(query: Query, previous: Query | None) -> str:
    """The kind of a query, given the question before it."""
    if query.type == _OUT:
        return f"{_OUT}:{query.reason}"
    if query.detail is not None:
        return query.detail
    if query.actor == "vehicle:unknown":
        return WHICH
    if previous is not None and query.refers_to_previous and _is_variant(query, previous):
        return LEAN
    return query.type


def reason_in(kind: str) -> str | None:
    """The reason to decline that a kind stands for, if any."""
    out, _, reason = kind.partition(":")
    return reason if out == _OUT else None


def _is_variant(query: Query, previous: Query) -> bool:
    """Whether it is the question before but for the vehicle, the actions or the time."""
    if query.type != previous.type:
        return False
    same_deeds = (query.factual, query.counterfactual) == (
        previous.factual,
        previous.counterfactual,
    )
    return same_deeds or query.actor == previous.actor
