"""Claims: what a sentence in the paper's style says, apart from how probable it is said to be."""

from typing import Literal, TypeAlias

import msgspec

from planner.record.trace import Outcome
from xavi_dialogue.domain.answers import Cause, Contrast, Effect
from xavi_dialogue.nlg.content.clauses.manoeuvres import plain

Ending: TypeAlias = Literal["done", "collision", "not-reached"]
Lean: TypeAlias = Literal["more", "less", "equal"]
#: "first action": the causes are the same, but for a first action that ours lack: one that is
#: done by the time of the decision is not foreseen any more.
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
    """What is claimed of a foil."""

    outcome: Ending
    collided_with: int | None = None
    effects: tuple[Change, ...] = ()
    causes: tuple[Doing, ...] = ()


def claim_of(found: Contrast, effects: int, causes: int) -> Claim:
    """Return what the sentence of a contrast claims: its largest effects, where the foil arrives.

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
    """The outcome as the paper's grammar tells it: all that is neither done nor a collision."""
    return outcome if outcome in ("done", "collision") else "not-reached"


def differing(ours: Claim, theirs: Claim) -> tuple[Part, ...]:
    """In what two claims differ."""
    parts: list[Part] = []
    if (ours.outcome, ours.collided_with) != (theirs.outcome, theirs.collided_with):
        parts.append("outcome")
    if ours.effects != theirs.effects:
        parts.append("effects")
    if ours.causes != theirs.causes:
        parts.append("first action" if _later(ours.causes, theirs.causes) else "causes")
    return tuple(parts)


def _later(ours: tuple[Doing, ...], theirs: tuple[Doing, ...]) -> bool:
    """Check whether our causes are those of the other claim but for first actions."""
    return len(ours) == len(theirs) and all(
        one.vehicle == other.vehicle and one.actions in (other.actions, other.actions[1:])
        for one, other in zip(ours, theirs, strict=True)
    )


def _change(effect: Effect) -> Change:
    lean: Lean = "equal" if effect.delta == 0.0 else "more" if effect.delta > 0.0 else "less"
    return Change(effect.component, lean)


def _doing(cause: Cause) -> Doing:
    return Doing(cause.vehicle, plain(cause.actions))
