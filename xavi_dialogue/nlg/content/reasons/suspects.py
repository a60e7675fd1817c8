"""Suspects: whether the vehicle that a question supposes to be the cause is one."""

from typing import Final

from xavi_dialogue.domain.reasons import NobodyElse, Suspected
from xavi_dialogue.domain.terms import Vehicle, Vehicles
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Who

FEW: Final = 3  # maximum of others who are named


def suspected(
    reason: Message,
    suspect: int | None,
    part: Suspected | None,
    time: float,
    cleared: tuple[int, ...] = (),
    besides: tuple[int, ...] = (),
    *,
    past: bool,
    told: bool,
) -> tuple[Message, ...]:
    """Return the verdict on the vehicle that the question suspects, followed by the reason.

    Args:
        reason: the reason that is stated.
        suspect: the vehicle; None if the question names none.
        part: its part in the reason.
        time: [s] at which it is described.
        cleared: vehicles that make no difference.
        besides: other causes, if the question supposes that there are none.
        past: the reason is in the past tense.
        told: the reason names it.
    """
    if suspect is None or part is None:
        return (reason,)
    without_part = part in ("none", "neither")
    group = besides and (without_part or part in ("all", "all-alike"))
    slots = {
        "who": Who(Vehicles((suspect, *besides))) if group else Who(Vehicle(suspect), time),
        "part": part,
        "cleared": suspect in cleared,
        "besides": all_of(besides, time),
        "whole": part in ("all", "all-alike"),
        "two": len(besides) == 1,
        "past": past,
    }
    if told or without_part:
        return (message("VERDICT_ON", reason=reason, **slots),)
    return (message("SUSPECTED", **slots), reason)


def plan_nobody_else(answer: NobodyElse, context: SpeechContext) -> Plan:
    """Plan whether others than those named mattered; a few others are named."""
    few = answer.matter and len(answer.others) <= FEW
    slots = {
        "alone": not answer.others,
        "several": len(answer.named) > 1,
        "named": all_of(answer.named, answer.decided),
        "others": all_of(answer.others, answer.decided) if few else None,
        "kind": {True: "other", False: "same", None: "open"}[answer.matter],
        "past": answer.past,
    }
    return Plan((message("NOBODY_ELSE", **slots),))


def all_of(vehicles: tuple[int, ...], time: float) -> Who | None:
    """Return a reference to vehicles as they were at a time [s]; None if there are none."""
    if not vehicles:
        return None
    return Who(Vehicle(vehicles[0]) if len(vehicles) == 1 else Vehicles(vehicles), time)
