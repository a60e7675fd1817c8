"""Asking the factual explainers about a ride, as the engine does."""

from typing import Any

from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.domain.meaning import Ask, Claim, Feel, Request
from xavi_dialogue.explain.answers import factual
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.facts.world import world_of
from xavi_dialogue.explain.history.ride import Ride


def told(ride: Ride, asked: Any, span: Span | None = None) -> Any:
    """The answer, or the refusal, to a question or act."""
    act = asked if isinstance(asked, Claim | Feel | Request) else Ask(asked)
    world = world_of(ride.record)
    scene = Asked(world.ride, world, span, GroundedAct(act, span))
    table = factual.ACTS if act is asked else factual.QUESTIONS
    try:
        return table[type(asked)](asked, scene)
    except Unanswered as unanswered:
        return unanswered.result
