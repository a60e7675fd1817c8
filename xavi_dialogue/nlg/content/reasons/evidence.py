"""Evidence: what is added to a comparison if more is wanted: ranges, causes and basis."""

from collections.abc import Collection

from xavi_dialogue.domain.answers import Cause, Contrast, Effect, Evidence
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.reasons.contrasts import (
    cause_message,
    kind_of,
    time_effect,
    told_cause,
    worth_telling,
)
from xavi_dialogue.nlg.content.reasons.suspects import all_of
from xavi_dialogue.nlg.content.reasons.terms import foil_verbs
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Moment, Number, Quantity, Range, Who

NARROW = 1.0  # [s] minimum width of a range that is stated
NOTHING = 0.25  # [s] maximum difference that counts as none
MOST = 2  # maximum of further causes that are stated
NAMED = 4  # a group of causes is named one by one if it is smaller, or not larger


def further(contrast: Contrast, context: SpeechContext, *, past: bool) -> tuple[Message, ...]:
    """Return what is stated after the reason, most important first."""
    first = told_cause(contrast)
    others = [c for c in contrast.causes if c != first][:MOST]
    found = [
        range_of(contrast),
        _other_effects(contrast, past=past),
        *(_also(c, contrast, context, past=past) for c in others),
        None
        if first is None or not is_needed(contrast.causation)
        else _needed(first, contrast, past=past),
        cleared(contrast.cleared, contrast.decided, past=past),
        rests_on(contrast.evidence, contrast.decided),
    ]
    return tuple(one for one in found if one is not None)


def range_of(contrast: Contrast) -> Message | None:
    """Return the range of the difference in time, if one was calibrated for such cases."""
    found = contrast.likely
    if found is None or time_effect(contrast) is None or found.high - found.low < NARROW:
        return None
    if kind_of(contrast) in ("alone", "collision", "dead", "late", "way"):
        return None
    ends = sorted((abs(found.low), abs(found.high)))
    both = found.low < -NOTHING and found.high > NOTHING
    return message(
        "RANGE",
        both=both,
        sooner=Quantity(abs(found.low), "s"),
        later=Quantity(abs(found.high), "s"),
        is_later=found.low + found.high > 0.0,
        up_to=ends[0] <= NOTHING or found.low < 0.0 < found.high,
        most=Quantity(ends[1], "s"),
        range=Range(Quantity(ends[0], "s"), Quantity(ends[1], "s")),
        waypoint=contrast.waypoint,
    )


def _other_effects(contrast: Contrast, *, past: bool) -> Message | None:
    """Return effects other than the one that decided."""
    if kind_of(contrast) in ("alone", "collision", "dead", "late", "way"):
        return None
    said = {"time", *(share.term for share in contrast.told)}
    rest: list[Effect] = [e for e in worth_telling(contrast) if e.component not in said][:MOST]
    if not rest:
        return None
    rides = tuple(message("RIDE_EFFECT", ride=e.component, more=e.delta > 0.0) for e in rest)
    foil = foil_verbs(contrast)
    return message("ALSO_MEANT", foil=foil, rides=rides, past=past)


def _also(cause: Cause, contrast: Contrast, context: SpeechContext, *, past: bool) -> Message:
    return message("ALSO_CAUSE", cause=cause_message(cause, contrast, context, past=past))


def _needed(cause: Cause, contrast: Contrast, *, past: bool) -> Message | None:
    """Return whether we would have decided the same without the first cause."""
    if cause.decision_changes is None:
        return None
    who = Who(Vehicle(cause.vehicle), contrast.decided)
    return message("WITHOUT_CAUSE", who=who, changes=cause.decision_changes, past=past)


def hangs_on(
    causation: Causation | None, time: float, *, past: bool, brief: Collection[int] = ()
) -> Message | None:
    """Return how a decision depends on vehicles, unless it depends on one alone.

    Args:
        causation: the vehicles that it depends on.
        time: [s] at which vehicles are described.
        past: state it in the past tense.
        brief: the vehicles that the answer names; for several causes, only the others are added.
    """
    if causation is None or causation.kind in ("one", "open"):
        return None
    if brief and causation.kind in ("both", "several"):
        others = tuple(v for v in causation.vehicles if v not in brief)
        if not others or len(brief) > 1:
            return None
        told = causation.minimal and 0 < len(others) < NAMED
        who = all_of(others, time) if told else None
        return message("OTHERS", who=who, many=len(others) > 1 or not told, past=past)
    first = sorted(causation.vehicles, key=lambda vehicle: vehicle not in causation.alters)
    one, other = (*(Who(Vehicle(v), time) for v in first[:2]), None, None)[:2]
    mixed = not causation.decides and any(v in causation.alters for v in causation.vehicles)
    few = causation.kind == "several" and causation.minimal and len(causation.vehicles) <= NAMED
    every = all_of(causation.vehicles, time) if few else None
    return message(
        "HANGS_ON",
        kind="mixed" if mixed else causation.kind,
        one=one,
        other=other,
        every=every,
        count=None if every is not None else len(causation.vehicles),
        past=past,
        decides=causation.decides,
        minimal=causation.minimal,
    )


def is_joint(causation: Causation | None, *, asked: bool) -> bool:
    """Check whether a reason that names one vehicle must name the other causes too.

    If we would do the same without them, only a question about causes needs it.
    """
    return causation is not None and causation.is_joint and (causation.decides or asked)


def is_needed(causation: Causation | None) -> bool:
    """Check whether it is worth stating whether the first cause was necessary."""
    return causation is None or causation.kind in ("one", "open")


def cleared(vehicles: tuple[int, ...], time: float, *, past: bool) -> Message | None:
    """Return which vehicles made no difference."""
    if not vehicles:
        return None
    who = all_of(vehicles, time)
    return message("NO_DIFFERENCE", who=who, past=past, many=len(vehicles) > 1)


def rests_on(evidence: Evidence, decided: float | None) -> Message | None:
    """Return on how many situations an answer rests, and when it was decided."""
    if not evidence.distinct_samples:
        return None
    return message(
        "RESTS_ON",
        situations=Number(evidence.distinct_samples, "situation"),
        when=None if decided is None else Moment(decided),
        one=evidence.distinct_samples == 1,
    )
