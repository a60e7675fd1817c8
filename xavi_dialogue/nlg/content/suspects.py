"""Suspects: whether the vehicle that a question takes for the cause is one, with the reason."""

from xavi_dialogue.domain.reasons import Suspected
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Who


def suspected(
    reason: Message,
    suspect: int | None,
    part: Suspected | None,
    time: float,
    cleared: tuple[int, ...] = (),
    *,
    told: bool,
) -> tuple[Message, ...]:
    """Put the verdict on the vehicle that the question takes for the cause before the reason.

    Args:
        reason: the reason that is told.
        suspect: the vehicle; None where the question names none.
        part: which part it has.
        time: [s] at which it is described.
        cleared: vehicles that make no difference.
        told: the reason names it.
    """
    if suspect is None or part is None:
        return (reason,)
    slots = {"who": Who(Vehicle(suspect), time), "part": part, "cleared": suspect in cleared}
    if told or part in ("none", "neither"):
        return (message("VERDICT_ON", reason=reason, **slots),)
    return (message("SUSPECTED", **slots), reason)
