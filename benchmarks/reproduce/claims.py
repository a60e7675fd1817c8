"""Claims: the content of a sentence in the paper's style, without its probabilities."""

from typing import Literal, TypeAlias

import msgspec

from planner.record.trace import Outcome
from xavi_dialogue.domain.answers import Cause, Contrast, Effect
from xavi_dialogue.nlg.content.clauses.manoeuvres import plain

Ending: TypeAlias = Literal["done", "collision", "not-reached"]
Lean: TypeAlias = Literal["more", "less", "equal"]
#: "first action": the causes are the same, except for a first action that ours lack, because an
#: action that is over at the time of the decision is no longer predicted.
Part: TypeAlias = Literal["outcome", "effects", "causes", "first action"]


class Change(msgspec.Struct, frozen=True):
    """A component of the reward that the foil raises or lowers."""

    component: str
    lean: Lean


class Doing(msgspec.Struct, frozen=True):
    """A vehicle that is named as a cause, and what it does."""

    vehicle: int
    actions: tuple[str, ...]


class Claim(msgspec.Struct, frozen=True):
    """A claim about a foil."""

    outcome: Ending
    collided_with: int | None = None
    effects: tuple[Change, ...] = ()
    causes: tuple[Doing, ...] = ()


def claim_of(found: Contrast, effects: int, causes: int) -> Claim:
    """Return the claim of a contrast's sentence: its largest effects, if the foil arrives.

    Args:
        found: has a foil and its outcome.
        effects: how many it may name.
        causes: likewise.
    """
    assert found.outcome is not None
    arrives = found.outcome.name == "done"
    largest = sorted(found.effects, key=lambda effect: -abs(effect.delta))
    return Claim(
        outcome=ending(found.outcome.name),
        collided_with=found.outcome.collided_with,
        effects=tuple(_change(effect) for effect in (largest[:effects] if arrives else ())),
        causes=tuple(_doing(cause) for cause in found.causes[:causes] if cause.actions),
    )


def ending(outcome: Outcome) -> Ending:
    """Return the outcome by the paper's grammar, which merges those besides done and collision."""
    return outcome if outcome in ("done", "collision") else "not-reached"


def differing(ours: Claim, theirs: Claim) -> tuple[Part, ...]:
    """Return the parts in which two claims differ."""
    parts: list[Part] = []
    if (ours.outcome, ours.collided_with) != (theirs.outcome, theirs.collided_with):
        parts.append("outcome")
    if ours.effects != theirs.effects:
        parts.append("effects")
    if ours.causes != theirs.causes:
        parts.append("first action" if _later(ours.causes, theirs.causes) else "causes")
    return tuple(parts)


def _later(ours: tuple[Doing, ...], theirs: tuple[Doing, ...]) -> bool:
    """Check whether our causes are those of the other claim, except for first actions."""
    return len(ours) == len(theirs) and all(
        one.vehicle == other.vehicle and one.actions in (other.actions, other.actions[1:])
        for one, other in zip(ours, theirs, strict=True)
    )


def _change(effect: Effect) -> Change:
    lean: Lean = "equal" if effect.delta == 0.0 else "more" if effect.delta > 0.0 else "less"
    return Change(effect.component, lean)


def _doing(cause: Cause) -> Doing:
    return Doing(cause.vehicle, plain(cause.actions))
