"""Explanation: the object `explanation` of the contract, derived from a typed answer."""

import re
from collections.abc import Iterable
from functools import cache
from types import NoneType
from typing import Final, get_args

import msgspec

from planner.record.trace import Action
from xavi_dialogue.dialogue.standing import Result, reason_of
from xavi_dialogue.domain.answers import (
    Acknowledged,
    Again,
    Aim,
    Avoidance,
    Cause,
    Certainty,
    ChoiceReason,
    Comforting,
    Compared,
    Contrast,
    DecisiveFactor,
    Declined,
    Effect,
    Evidence,
    Helpful,
    Judged,
    Mechanism,
    MotionCause,
    MotionReason,
    NothingToAsk,
    OtherReason,
    OutcomeEstimate,
    Posed,
    Share,
    Sociable,
    SupposedOfOther,
    SupposedOfUs,
    TakenAs,
    Unfamiliar,
    Weighing,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.rewriting import parts

_MACRO: frozenset[str] = frozenset(get_args(Action))
#: Types of talk, which explain nothing.
TALK: tuple[type, ...] = (
    *(Acknowledged, Again, Comforting, Declined, Helpful, Judged, NothingToAsk, Posed),
    *(Sociable, TakenAs, Unfamiliar),
)


class Contrastive(msgspec.Struct, frozen=True, kw_only=True):
    """The common fields of causal answers; see `Explanation` in the contract."""

    kind: str
    factual: tuple[Action, ...] = ()
    counterfactual: tuple[Action, ...] = ()
    outcome: OutcomeEstimate | None = None
    effects: tuple[Effect, ...] = ()
    causes: tuple[Cause, ...] = ()
    evidence: Evidence = Evidence()
    continued: tuple[Action, ...] = ()  # actions that would follow the counterfactual
    aim: Aim | None = None
    verdict: Weighing | None = None  # whether the factual is better, as far as the record shows
    terms: tuple[Share, ...] = ()  # terms of the difference of the rewards
    told: tuple[Share, ...] = ()  # those that the answer states, the decisive one first
    error: float | None = None  # [s] standard error of the difference


def contrastive(result: Result) -> Contrastive | None:
    """Return fact, foil, effects and causes of a causal answer; None of any other answer."""
    kind = kind_of(result)
    match result:
        case ChoiceReason(contrast=contrast) | SupposedOfUs(contrast=contrast):
            return _of_contrast(kind, contrast)
        case SupposedOfOther():
            return _of_supposition(kind, result)
        case MotionReason() | OtherReason():
            deed = () if result.deed is None else _macro(result.deed)
            causes = tuple(_cause(c) for c in result.causes if c.vehicle is not None)
            return Contrastive(kind=kind, factual=deed, causes=causes, evidence=result.evidence)
        case Compared() | DecisiveFactor() | Avoidance() | Certainty() if (
            result.contrast is not None
        ):
            return _of_contrast(kind, result.contrast)
        case Comforting(fact=inner) | Again(answer=inner) | Judged(answer=inner):
            return None if inner is None else contrastive(inner)
    return None


def explanation_of(results: Iterable[Result]) -> dict[str, object] | None:
    """Return the object of the contract for the first causal result, else for the first result.

    For a causal answer: fact, foil, outcome, effects, causes and evidence. For any other: its kind
    and its fields. None if there is no answer, or only talk.
    """
    answers = [_told(result) for result in results if reason_of(result) is None]
    for answer in answers:
        found = contrastive(answer)
        if found is not None:
            return _flat(found)
    for answer in answers:
        if not isinstance(answer, TALK):
            held = as_json(answer)
            return {"kind": kind_of(answer), **{k: v for k, v in held.items() if k != "is"}}
    return None


def as_json(value: msgspec.Struct) -> dict[str, object]:
    """Return a value as a JSON object, from which the value can be decoded again.

    Equal values give equal objects. When msgspec encodes, it leaves out a default only if it is
    the same object, which the same value is not once it was stored and read again.
    """
    found = _canonical(value)
    assert isinstance(found, dict)
    return found


#: Types of values that are JSON as they are.
_ATOMS: Final = frozenset((str, int, float, bool, NoneType))


def _canonical(value: object) -> object:
    """Return a value as JSON, without the fields that equal their defaults."""
    if type(value) in _ATOMS:
        return value
    match value:
        case msgspec.Struct():
            config = value.__struct_config__
            held = {} if config.tag is None else {str(config.tag_field): config.tag}
            for name, default in _defaults(type(value)):
                inner = getattr(value, name)
                same = type(inner) is type(default) and inner == default
                if not (config.omit_defaults and same):
                    held[name] = _canonical(inner)  # type: ignore[assignment]
            return held
        case tuple() | list():
            return [_canonical(one) for one in value]
        case dict():
            return {str(name): _canonical(one) for name, one in value.items()}
    return msgspec.to_builtins(value)


@cache
def _defaults(kind: type[msgspec.Struct]) -> tuple[tuple[str, object], ...]:
    """Return the fields of a struct with their defaults."""
    found = msgspec.structs.fields(kind)
    return tuple((one.name, one.default) for one in found)


def kind_of(result: Result) -> str:
    """Return the name of a type of answer, such as `choice-reason`."""
    return re.sub(r"(?<!^)(?=[A-Z])", "-", type(result).__name__).lower()


def evidence_of(results: Iterable[Result]) -> Evidence | None:
    """Return the first evidence that names a decision."""
    found = (e for result in results for e in parts(result, Evidence) if e.traces)
    return next(found, None)


def _told(result: Result) -> Result:
    """Return the inner answer of one that only frames it."""
    match result:
        case Comforting(fact=inner) | Again(answer=inner) | Judged(answer=inner):
            return result if inner is None else inner
    return result


def _of_contrast(kind: str, contrast: Contrast) -> Contrastive:
    return Contrastive(
        kind=kind,
        factual=contrast.fact,
        counterfactual=contrast.foil,
        continued=contrast.continued,
        aim=contrast.aim,
        verdict=contrast.verdict,
        terms=contrast.terms,
        told=contrast.told,
        error=contrast.error,
        outcome=contrast.outcome,
        effects=contrast.effects,
        causes=contrast.causes,
        evidence=contrast.evidence,
    )


def _of_supposition(kind: str, found: SupposedOfOther) -> Contrastive:
    """Return the hypothetical plan as the counterfactual, and the vehicle as the only cause."""
    supposed = found.supposed
    named = supposed is not None and supposed.action in _MACRO
    actions = msgspec.convert((supposed.action,), tuple[Action, ...]) if named and supposed else ()
    cause = Cause(
        vehicle=found.vehicle,
        actions=actions,
        probability=1.0 if found.prior is None else found.prior,
        decision_changes=not found.same,
    )
    contrast = found.contrast
    whole = Contrastive(kind=kind) if contrast is None else _of_contrast(kind, contrast)
    return msgspec.structs.replace(
        whole, factual=found.plan, counterfactual=found.then, causes=(cause,)
    )


def _cause(cause: MotionCause) -> Cause:
    """Return a reason for how we drove as a cause; without a probability, it was certain."""
    hold_ups = {"leader", "right-of-way", "cut-in", "blocked"}
    how = cause.kind if cause.kind in hold_ups else None
    mechanism = None
    if how is not None:
        shape = {"how": how, "speed_from": cause.speed, "speed_to": None, "delay": None, "share": 1}
        mechanism = msgspec.convert({"is": "Mechanism", **shape}, Mechanism, strict=False)
    assert cause.vehicle is not None
    return Cause(
        vehicle=cause.vehicle,
        actions=cause.actions,
        probability=1.0 if cause.probability is None else cause.probability,
        mechanism=mechanism,
        necessary=cause.necessary,
    )


def _macro(deed: Episode) -> tuple[Action, ...]:
    return msgspec.convert((deed.action,), tuple[Action, ...]) if deed.action in _MACRO else ()


def _flat(value: object) -> dict[str, object]:
    """Return a struct as JSON with all its fields, and no tags."""

    def plain(inner: object) -> object:
        if isinstance(inner, tuple):
            return [plain(one) for one in inner]
        if isinstance(inner, msgspec.Struct):
            return {name: plain(getattr(inner, name)) for name in inner.__struct_fields__}
        return inner

    found = plain(value)
    assert isinstance(found, dict)
    return found
