"""Hidden parts of the road: what cannot be seen past, and what seeing past it would change."""

from typing import Literal, TypeAlias

from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value

Side: TypeAlias = Literal["left", "right", "ahead"]


class Hider(Value, frozen=True):
    """What hides a part of the road from which somebody with right of way might come."""

    vehicle: int | None  # None: a building
    side: Side  # from which somebody might come
    probability: float | None  # that somebody is there with right of way; None: not reckoned with


class SightTold(Value, frozen=True):
    """What we cannot see, and who might come from there; nobody who is only imagined is counted."""

    #: asked: whether we see past it; what we do not see; whether or how surely somebody is there,
    #: or comes from there; whether somebody came; how we know that nobody does; what if he did;
    #: who drives ahead of one behind whom we drive
    asked: Literal["past", "what", "there", "chance", "came", "known", "if", "beyond"]
    hiders: tuple[Hider, ...]  # the likeliest first; () nothing that matters is hidden
    past: bool = False
    slowed: bool = False  # we came slowly for it


class SupposedSeeing(Value, frozen=True):
    """What would have been had we seen past some who hide the road, and nobody been there."""

    hiders: tuple[Hider, ...]  # these; () nothing that matters was hidden
    decided: float  # [s] of the decision
    plan: tuple[MacroAction, ...]  # as things were
    then: tuple[MacroAction, ...]  # as it would have been
    saved: float  # [s] that the drive would have been shorter
    past: bool = False


HiddenAnswer: TypeAlias = SightTold | SupposedSeeing
