"""Proposals: suggested next questions, all of which the record can answer."""

from typing import Any

from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    MotionReason,
    OtherReason,
    SupposedOfOther,
    SupposedOfUs,
)
from xavi_dialogue.nlg.context import SpeechContext

#: Questions that have an answer at any time of a ride.
ALWAYS = (
    "What are you going to do next?",
    "What do you see around us?",
    "How fast are we going?",
)


def about_cause(answer: Answer) -> tuple[str, ...]:
    """Return what to ask after an answer about our conduct: without the vehicle, and how sure."""
    vehicle = _first(answer)
    found: list[str] = []
    if vehicle is not None and not isinstance(answer, SupposedOfOther):
        found.append(f"What if vehicle {vehicle} had not been there?")
    if vehicle is not None:
        found.append(f"Where is vehicle {vehicle} going?")
    if isinstance(answer, ChoiceReason):
        found.append("How sure are you of that?")
    return tuple(found[:2])


def _first(answer: Any) -> int | None:
    """Return the vehicle that an answer names first as a cause; None if there is none."""
    match answer:
        case ChoiceReason(contrast=contrast) | SupposedOfUs(contrast=contrast):
            named = [cause.vehicle for cause in contrast.causes]
        case MotionReason(causes=causes):
            named = [cause.vehicle for cause in causes if cause.vehicle is not None]
        case OtherReason(vehicle=vehicle) | SupposedOfOther(vehicle=vehicle):
            named = [vehicle]
        case _:
            named = []
    return next((vehicle for vehicle in named if vehicle), None)


def always(context: SpeechContext, most: int = 2) -> tuple[str, ...]:
    """Return what can be asked at any time and was not proposed lately."""
    fresh = [one for one in ALWAYS if one not in context.suggested]
    return tuple(fresh[:most])


def about_vehicle(vehicle: int) -> tuple[str, ...]:
    """Return what can be asked about a vehicle that is known."""
    return (f"What is vehicle {vehicle} doing?",)


def fresh(proposed: tuple[str, ...], context: SpeechContext) -> tuple[str, ...]:
    """Return the proposals that were not made recently."""
    return tuple(one for one in proposed if one not in context.suggested)


__all__ = ["ALWAYS", "about_cause", "about_vehicle", "always", "fresh"]
