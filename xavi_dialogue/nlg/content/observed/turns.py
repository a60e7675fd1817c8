"""Turns: who must move first so that we can go, in words."""

from xavi_dialogue.domain.answers import Unblocking
from xavi_dialogue.domain.terms import Vehicle, Vehicles
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import message
from xavi_dialogue.nlg.surface.values import Who


def these(numbers: tuple[int, ...], at: float | None = None) -> Who | None:
    """Return a reference to some vehicles; None if there are none."""
    if not numbers:
        return None
    return Who(Vehicles(numbers) if numbers[1:] else Vehicle(numbers[0]), at)


def plan_unblocking(answer: Unblocking, context: SpeechContext) -> Plan:
    """Plan who is at the head of our queue, and for whom it waits."""
    del context
    told = message(
        "UNBLOCKING",
        who=Who(Vehicle(answer.head)),
        going=answer.going,
        waits=these(answer.waits),
    )
    return Plan((told,))
