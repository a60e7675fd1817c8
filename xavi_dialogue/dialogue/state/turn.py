"""Turn: one question and its reply, with all that later turns need to know. Plain data."""

from collections.abc import Callable
from functools import cached_property, wraps
from typing import Any, Literal, TypeAlias, TypeVar

import msgspec

from planner.record.trace import Action
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.domain.answers import Answer, Posed, Refusal
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Act
from xavi_dialogue.domain.terms import Thing

#: Judgement of a reply; "passed": the passenger does not know, or does not settle on one answer.
Judgement: TypeAlias = Literal["right", "wrong", "passed"]


T = TypeVar("T")


class Part(msgspec.Struct, frozen=True):
    """One act of the passenger with its result."""

    act: GroundedAct | None  # None: the result belongs to no act
    result: Answer | Refusal


class Quiz(msgspec.Struct, frozen=True, kw_only=True):
    """A question of ours to the passenger, with its solution from the record."""

    posed: Posed
    at: float  # [s] when it was asked
    vehicle: int | None = None  # of kind vehicle: the one that is meant
    actions: tuple[Action, ...] = ()  # of kind deed: what we would have done
    same: bool | None = None  # of kind deed: whether that is what we did anyway
    sooner: bool | None = None  # whether we would have been there sooner; None: not clear


class Offer(msgspec.Struct, frozen=True, kw_only=True):
    """The readings or vehicles that a clarification offered, in the order of their numbers."""

    acts: tuple[Act, ...] = ()  # one for each choice that is a whole act
    things: tuple[Thing, ...] = ()  # the vehicles to choose from
    pending: Act | None = None  # the act that one of them is to complete


class Turn(msgspec.Struct, frozen=True, kw_only=True, dict=True):
    """One question and its reply; what was found out about it is kept with it."""

    text: str  # as typed
    parts: tuple[Part, ...] = ()  # as understood, in order
    reply: Reply
    ride: str | None = None  # id of the first trace of the ride that it is about
    mentioned: tuple[int, ...] = ()  # vehicles that the reply names, in order
    offer: Offer | None = None  # of a clarification
    quiz: Quiz | None = None  # asked by the reply
    answered: Quiz | None = None  # the question of ours that the text answers ...
    right: bool | None = None  # ... and whether rightly; None: the passenger does not know
    turned_away: bool = False  # the question was not answered at all

    @cached_property
    def acts(self) -> tuple[GroundedAct, ...]:
        """Return the acts of the text, each once."""
        return tuple(dict.fromkeys(p.act for p in self.parts if p.act is not None))

    @cached_property
    def results(self) -> tuple[Answer | Refusal, ...]:
        """Return the results of all parts."""
        return tuple(part.result for part in self.parts)


def kept(find: Callable[[Turn], T]) -> Callable[[Turn], T]:
    """Let what a function finds out about a turn be kept with the turn."""
    name = f"{find.__module__}.{find.__qualname__}"

    @wraps(find)
    def found(turn: Turn) -> T:
        known: dict[str, Any] = turn.__dict__
        if name not in known:
            known[name] = find(turn)
        return known[name]  # type: ignore[no-any-return]

    return found
