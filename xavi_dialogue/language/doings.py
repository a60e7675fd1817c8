"""Doings: the actions of a query or an explanation, as phrases to be."""

from collections.abc import Iterable

from xavi_dialogue.explain.query import Tense
from xavi_dialogue.language.morphology import EGO, Doing

LANE_CHANGES = ("change-left", "change-right", "overtake")


def vehicle_of(actor: str) -> int | None:
    """The number in "vehicle:N"; None for the ego and for descriptions."""
    _, _, number = actor.partition(":")
    return int(number) if number.isdecimal() and int(number) != EGO else None


def plain(actions: Iterable[str]) -> tuple[str, ...]:
    """The actions without repetition, and without going on as an afterthought."""
    kept: list[str] = []
    for action in actions:
        if not kept or kept[-1] != action:
            kept.append(action)
    while len(kept) > 1 and kept[-1] == "continue":
        kept.pop()
    return tuple(kept)


def staying(actions: Iterable[str], standing: bool) -> tuple[str, ...]:
    """The actions of a vehicle: where it stands, to stop is to stay."""
    return tuple("stay" if standing and action == "stop" else action for action in actions)


def doing(actor: int, actions: Iterable[str], tense: Tense, in_lane: bool = False) -> Doing | None:
    """The actions as a phrase to be, or None where there is none."""
    kept = plain(actions)
    return Doing(actor, kept, tense, in_lane) if kept else None
