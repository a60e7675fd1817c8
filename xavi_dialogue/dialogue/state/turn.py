"""Turn: what was said once by either side, with all that later turns need of it. Plain data."""

from typing import Literal, TypeAlias

import msgspec

from planner.record.trace import Action
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.domain.answers import Answer, Posed, Refusal
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Act
from xavi_dialogue.domain.terms import Thing

#: What a reply comes to; "passed": the passenger does not know, or does not settle on one answer.
Judgement: TypeAlias = Literal["right", "wrong", "passed"]


class Part(msgspec.Struct, frozen=True):
    """One act of the passenger with what answers it."""

    act: GroundedAct | None  # None where it could not be grounded
    result: Answer | Refusal


class Quiz(msgspec.Struct, frozen=True, kw_only=True):
    """A question of ours to the passenger, with its solution from the record."""

    posed: Posed
    at: float  # [s] when it was put
    vehicle: int | None = None  # of kind vehicle: the one that is meant
    actions: tuple[Action, ...] = ()  # of kind deed: what we would have done
    same: bool | None = None  # of kind deed: whether that is what we did anyway
    sooner: bool | None = None  # whether we would have been there sooner; None: not clear


class Offer(msgspec.Struct, frozen=True, kw_only=True):
    """What a clarification offered: the readings, in the order in which they are numbered."""

    acts: tuple[Act, ...] = ()  # one for each choice, as far as they are whole acts
    things: tuple[Thing, ...] = ()  # the vehicles to choose from
    pending: Act | None = None  # the act to be completed with one of them


class Turn(msgspec.Struct, frozen=True, kw_only=True):
    """One question and its reply."""

    text: str  # as typed
    parts: tuple[Part, ...] = ()  # as understood, in order
    reply: Reply
    ride: str | None = None  # id of the first trace of the ride that it is about
    mentioned: tuple[int, ...] = ()  # vehicles that the reply names, in order
    offer: Offer | None = None  # of a clarification
    quiz: Quiz | None = None  # put by the reply
    answered: Quiz | None = None  # which the text answers ...
    right: bool | None = None  # ... and whether rightly; None: the passenger does not know
    turned_away: bool = False  # the question was not taken up

    @property
    def acts(self) -> tuple[GroundedAct, ...]:
        """What was meant, each act once."""
        return tuple(dict.fromkeys(p.act for p in self.parts if p.act is not None))

    @property
    def results(self) -> tuple[Answer | Refusal, ...]:
        """What was replied to it."""
        return tuple(part.result for part in self.parts)
