"""Claims: what a sentence in the paper's style says, apart from how probable it is said to be."""

from typing import Literal, TypeAlias

import msgspec

from planner.trace import Outcome
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.language.paper import PaperCause, PaperEffect, select_paper

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


def claim_of(found: Explanation, effects: int, causes: int) -> Claim:
    """What the sentence of an explanation claims.

    Args:
        found: has a counterfactual and its outcome.
        effects: how many it may name.
        causes: likewise.
    """
    content = select_paper(found, effects, causes)
    assert found.outcome is not None
    return Claim(
        outcome=ending(found.outcome.name),
        collided_with=found.outcome.collided_with,
        effects=tuple(_change(effect) for effect in content.effects),
        causes=tuple(_doing(cause) for cause in content.causes),
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
    """Whether our causes are those of the other claim but for first actions."""
    return len(ours) == len(theirs) and all(
        one.vehicle == other.vehicle and one.actions in (other.actions, other.actions[1:])
        for one, other in zip(ours, theirs, strict=True)
    )


def _change(effect: PaperEffect) -> Change:
    lean: Lean = "equal" if effect.delta == 0.0 else "more" if effect.delta > 0.0 else "less"
    return Change(effect.component.name, lean)


def _doing(cause: PaperCause) -> Doing:
    return Doing(cause.vehicle.number, tuple(action.name for action in cause.actions))
