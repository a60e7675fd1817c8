"""Hidden parts of the road: what hides them, and what the ego would do if it could see them."""

from typing import Literal, TypeAlias

from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.facts import Look

Side: TypeAlias = Literal["left", "right", "ahead"]


class Hider(Value, frozen=True):
    """Something that hides a part of the road from which somebody with priority might come."""

    vehicle: int | None  # None: a building
    side: Side  # from which somebody might come
    probability: float | None  # that somebody with right of way is there; None: not considered


class SightTold(Value, frozen=True):
    """The answer what we cannot see, and who might come from there; phantoms are not counted."""

    #: The question: do we see past it; what do we not see; is somebody there, or how probably;
    #: did somebody come; how do we know that nobody comes; what if somebody came; who drives
    #: ahead of the vehicle in front of us.
    asked: Literal["past", "what", "there", "chance", "came", "known", "if", "beyond"]
    hiders: tuple[Hider, ...]  # the likeliest first; () nothing that matters is hidden
    past: bool = False
    slowed: bool = False  # we came slowly because of it


class SupposedSeeing(Value, frozen=True):
    """The answer what we would have done if we had seen past hiders, and nobody had been there."""

    hiders: tuple[Hider, ...]  # that are seen past; () nothing that matters was hidden
    decided: float  # [s] of the decision
    plan: tuple[MacroAction, ...]  # as things were
    then: tuple[MacroAction, ...]  # as it would have been
    saved: float  # [s] by which the drive would have been shorter
    past: bool = False


class AllRound(Value, frozen=True):
    """The answer whether we attend to the road: we look to all sides; who was nearest to us."""

    looks: tuple[Look, ...]  # the nearest first; () nobody was near
    time: float  # [s] of the looks
    past: bool = False


HiddenAnswer: TypeAlias = SightTold | SupposedSeeing | AllRound
