"""Standing: whether a result is an answer, refusal or clarification, and for which reason.

This is the only module that maps the types of results to the reasons of the contract.
"""

from collections.abc import Iterable
from typing import Literal, TypeAlias, get_args

from xavi_dialogue.domain.answers import (
    Again,
    Answer,
    CannotSay,
    Declined,
    DidNotHappen,
    Measures,
    NoSuchVehicle,
    NotApplicable,
    NotRecorded,
    NotUnderstood,
    Reason,
    Refusal,
    TooLittle,
    Unavailable,
    Verdict,
    WhichOne,
)
from xavi_dialogue.domain.facts import Gap

Kind: TypeAlias = Literal["answer", "refusal", "clarification"]
Result: TypeAlias = Answer | Refusal

REFUSALS: tuple[type, ...] = get_args(Refusal)

_BY_GAP: dict[Gap, Reason] = {
    "before-record": "outside-record",
    "in-future": "outside-record",
    "gap-in-record": "trace-gap",
    "out-of-view": "outside-record",
    "hidden": "outside-record",
    "out-of-sight": "outside-record",
    "not-sensed": "out-of-scope",
    "not-recorded": "outside-record",
    "no-deeds": "outside-record",
    "no-way": "not-applicable",
    "not-applicable": "not-applicable",
    "others-thoughts": "out-of-scope",
    "unknown-plans": "out-of-scope",
}


def reason_of(result: Result) -> Reason | None:
    """Return the contract's reason why a result is not an answer; None if it is one."""
    match result:
        case NotUnderstood():
            return "not-understood"
        case WhichOne():
            return "ambiguous"
        case NoSuchVehicle():
            return "unknown-vehicle"
        case DidNotHappen():
            return "did-not-happen"
        case NotApplicable():
            return "not-applicable"
        case TooLittle(reason=why) | CannotSay(reason=why) | Unavailable(reason=why):
            return why
        case NotRecorded(gap=gap):
            return _BY_GAP[gap]
        case Again(answer=inner) if inner is not None and not isinstance(inner, WhichOne):
            return reason_of(inner)
        case Declined(able=able, already=already):
            return None if already else "out-of-scope" if able else "not-an-action"
    return _of_gaps(result)


def failed(reason: Reason, *, roadless: bool = False) -> Refusal:
    """Return the refusal for a failure of the planner, by its reason.

    Args:
        reason: why there is no plan.
        roadless: whether the reason is that the record holds no roads.
    """
    match reason:
        case "planner-unavailable" | "timed-out" | "busy":
            return Unavailable(reason, roadless)
        case "too-little-evidence" | "effect-too-small" | "no-influence":
            return TooLittle(reason)
        case "outside-record":
            return NotRecorded("not-recorded")
        case "trace-gap":
            return NotRecorded("gap-in-record")
    return Unavailable("planner-failed")


def standing_of(results: Iterable[Result]) -> tuple[Kind, Reason | None]:
    """Return the kind of a reply of several results, and the reason if it is not an answer.

    It is a clarification if one of them is; else an answer if one of them is.
    """
    results = tuple(results)
    reasons = [reason_of(result) for result in results]
    if "ambiguous" in reasons:
        return "clarification", "ambiguous"
    if not reasons or None in reasons:
        return "answer", None
    return "refusal", reasons[0]


def _of_gaps(result: Result) -> Reason | None:
    """Return the reason why none of the values asked for is known; None if one is known."""
    if isinstance(result, Measures) and result.measures:
        gaps = [m.gap for m in result.measures]
        known = any(gap in (None, "not-applicable") for gap in gaps)
        first = next((gap for gap in gaps if gap is not None), None)
        return None if known or first is None else _BY_GAP[first]
    if not isinstance(result, Verdict) or result.holds is not None or result.facts:
        return None
    expected = result.probability is not None or result.believed
    return None if expected or result.gap is None else _BY_GAP[result.gap]
