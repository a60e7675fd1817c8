"""Suspected: whether those whom a question takes for the reason are one."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import Feature, Junction, Thing, Vehicles
from xavi_dialogue.explain.answers.reasons.suspects import (
    meant_on_foot,
    or_road,
    with_suspect,
    with_suspects,
)
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import check_seen, walking


def road_last(question: Why) -> Why:
    """Put a road user before what stands in the road: "because of the light or the bus?"."""
    if not isinstance(question.suspect, Feature | Junction) or question.rival is None:
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
    return told if (kinds := _kinds(question.rival)) is None else or_road(told, kinds)


def _kinds(rival: Thing | None) -> tuple[str, ...] | None:
    """Return what in the road a question names beside a road user, as kinds of reasons."""
    match rival:
        case Feature(kind="light"):
            return ("light",)
        case Feature() | Junction():
            return ("turn", "bend", "roundabout", "give-way-line", "light")
    return None
