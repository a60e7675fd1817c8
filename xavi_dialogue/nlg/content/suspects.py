"""Suspects: whether the vehicle that a question takes for the cause is one, with the reason."""

from xavi_dialogue.domain.reasons import Suspected
from xavi_dialogue.domain.terms import Vehicle, Vehicles
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Who


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
    """Put the verdict on the vehicle that the question takes for the cause before the reason.

    Args:
        reason: the reason that is told.
        suspect: the vehicle; None where the question names none.
        part: which part it has.
        time: [s] at which it is described.
        cleared: vehicles that make no difference.
        besides: who else is the cause, where it is taken for the only one.
        past: the reason is told as past.
        told: the reason names it.
    """
    if suspect is None or part is None:
        return (reason,)
    slots = {
        "who": Who(Vehicle(suspect), time),
        "part": part,
        "cleared": suspect in cleared,
        "besides": all_of(besides, time),
        "past": past,
    }
    if told or part in ("none", "neither"):
        return (message("VERDICT_ON", reason=reason, **slots),)
    return (message("SUSPECTED", **slots), reason)


def all_of(vehicles: tuple[int, ...], time: float) -> Who | None:
    """Refer to one or several vehicles as they were at a time [s]; None where there are none."""
    if not vehicles:
        return None
    return Who(Vehicle(vehicles[0]) if len(vehicles) == 1 else Vehicles(vehicles), time)
