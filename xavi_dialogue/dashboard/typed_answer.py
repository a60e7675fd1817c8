"""The typed answer in a reply, whose evidence the dashboard shows."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeAlias

import msgspec

from xavi_dialogue.dialogue.explanation import Contrastive, contrastive, kind_of
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.domain.answers import (
    Again,
    Answer,
    Avoidance,
    Certainty,
    ChoiceReason,
    Comforting,
    Compared,
    Contrast,
    DecisiveFactor,
    Evidence,
    Judged,
    Method,
    MotionReason,
    Options,
    Refusal,
    SupposedOfOther,
    SupposedOfUs,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import Vehicle, Vehicles

Result: TypeAlias = Answer | Refusal

#: Answers about what our own car did, does or might do.
OURS = (ChoiceReason, MotionReason, SupposedOfUs, SupposedOfOther, Compared, DecisiveFactor,
        Avoidance, Certainty, Options, Method)  # fmt: skip


@dataclass(frozen=True, slots=True)
class TypedAnswer:
    """The part of a reply that explains something."""

    answer: Result
    said: Contrastive

    @property
    def ours(self) -> bool:
        """Whether it is about what the ego did, does or might do."""
        return isinstance(self.answer, OURS)

    @property
    def decided(self) -> float | None:
        """The time [s] of the decision that is explained; None if not stated."""
        if isinstance(self.answer, Options | Method | Certainty):
            return self.answer.decided
        return next((one.decided for one in parts(self.answer, Contrast)), None)


def told_of(reply: Reply) -> TypedAnswer | None:
    """Return the explanation in a reply: the first causal answer, or the first with evidence."""
    if reply.kind != "answer":
        return None
    results = [_inner(result) for result in msgspec.convert(reply.answers, tuple[Result, ...])]
    for result in results:
        found = contrastive(result)
        if found is not None:
            return TypedAnswer(result, found)
    for result in results:
        evidence = next((e for e in parts(result, Evidence) if e.traces), None)
        if evidence is not None:
            return TypedAnswer(result, Contrastive(kind=kind_of(result), evidence=evidence))
    return None


def title_of(told: TypedAnswer, reply: Reply) -> str:
    """Return the role of the counterfactual: "asked" about, "then", or what we did "instead"."""
    match told.answer:
        case SupposedOfOther():
            return "then"
        case SupposedOfUs(done=None) | ChoiceReason(form="why-not") | Compared():
            return "asked"
        case ChoiceReason(form="why"):
            named = any(why.instead is not None for why in parts(acts_of(reply), Why))
            return "asked" if named else "instead"
    return "instead"


def asked_about(reply: Reply) -> Iterable[int]:
    """Yield the vehicles that were asked about."""
    acts = acts_of(reply)
    yield from (vehicle.number for vehicle in parts(acts, Vehicle))
    for several in parts(acts, Vehicles):
        yield from several.numbers


def acts_of(reply: Reply) -> tuple[GroundedAct, ...]:
    """Return what was asked."""
    return msgspec.convert(reply.acts, tuple[GroundedAct, ...])


def _inner(result: Result) -> Result:
    """Return the answer within one that only frames it."""
    match result:
        case Comforting(fact=inner) | Again(answer=inner) | Judged(answer=inner):
            return result if inner is None else inner
    return result
