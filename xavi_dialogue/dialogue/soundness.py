"""Soundness: the check for answers without content, about nobody or an open question word. Pure.

Such an answer shows that the question was misread, whatever its words. It is dropped.
"""

from collections.abc import Iterable
from typing import Any

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Declined, Identified, Refusal, Verdict
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Request
from xavi_dialogue.domain.rewriting import first, parts, rewrite
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Is,
    Nobody,
    Proposition,
    Related,
    Unknown,
    Wanted,
)


def says_something(result: Answer | Refusal) -> bool:
    """Check whether an answer has content for a passenger."""
    match result:
        case Verdict(that=that):
            return not (_is_open(that) or _twice_of_all(that) or _of_nobody(result))
        case Identified(such=Compares(right=None), none=True):
            return False
        case Identified(such=such, none=True) if such is not None:
            return not _twice_of_all(such)
        case Declined(already=True, request=Request(event=Event(action="do" | "happen"))):
            return False
    return True


def is_told_within(result: Answer | Refusal, others: Iterable[Answer | Refusal]) -> bool:
    """Check whether another answer of the reply states the one episode that a yes rests on."""
    if not (isinstance(result, Verdict) and result.holds and len(result.facts) == 1):
        return False
    fact = result.facts[0]
    told = (other for other in others if not isinstance(other, Verdict))
    return isinstance(fact, Episode) and any(fact in parts(one, Episode) for one in told)


def _is_open(that: Proposition) -> bool:
    """Check whether a proposition contains a question word or a thing without meaning."""
    return first(rewrite(that, _plain), (Wanted, Unknown)) is not None


def _plain(part: Any) -> Any:
    """Remove the relative clause of a description, in which "who" refers to the description."""
    clause = isinstance(part, Described) and (part.doing is not None or part.such is not None)
    return replace(part, doing=None, such=None) if clause else part


def _twice_of_all(that: Proposition) -> bool:
    """Check whether both sides of an event or relation are everybody, nobody or a question word."""
    for one in parts(that, Event):
        if _is_all(one.actor) and _is_all(one.object):
            return True
    return any(_is_all(one.thing) and _is_all(one.to) for one in parts(that, Related))


def _is_all(thing: object) -> bool:
    return isinstance(thing, Nobody | Everyone | Wanted)


def _of_nobody(verdict: Verdict) -> bool:
    """Check whether a verdict is unknown because it is about nobody, or about our own state."""
    that = verdict.that
    if verdict.holds is not None or first(that, Exists) is not None:
        return False
    if verdict.gap in ("others-thoughts", "not-sensed"):
        return False
    ours = isinstance(that, Is) and isinstance(that.thing, Ego)
    return (ours and verdict.gap == "not-recorded") or first(that, Nobody) is not None
