"""Suspected: whether those whom a question takes for the reason are one."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import Feature, Vehicles
from xavi_dialogue.explain.answers.reasons.suspects import (
    meant_on_foot,
    or_light,
    with_suspect,
    with_suspects,
)
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import check_seen, walking


def road_last(question: Why) -> Why:
    """Put a road user before what stands in the road: "because of the light or the bus?"."""
    if not isinstance(question.suspect, Feature) or question.rival is None:
        return question
    return replace(question, suspect=question.rival, rival=question.suspect)


def of_suspects(found: Answer, question: Why, suspect: int | None, scene: Asked) -> Answer:
    """Add to a reason whether it is whom the question suspects.

    Args:
        found: the reason.
        question: the question.
        suspect: the vehicle that it suspects; None: none, or several.
        scene: what is asked, and of which time.

    Raises:
        Unanswered: nobody of the number or description of the second suspect was ever seen.
    """
    if isinstance(question.suspect, Vehicles) and len(question.suspect.numbers) > 1:
        named, walkers = question.suspect.numbers, walking(scene)
        people = walkers.issuperset(named)
        meant = meant_on_foot(found, named, walkers) if people else named
        told = with_suspects(found, meant, together=people)
    else:
        rival = check_seen(scene, question.rival)
        told = with_suspect(found, suspect, rival, alone=question.alone)
    return or_light(told) if isinstance(question.rival, Feature) else told
