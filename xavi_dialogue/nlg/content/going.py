"""Going: why we went when we did, and what can be said of not having slowed down."""

from xavi_dialogue.domain.answers import Bystander, GoReason, Unslowed
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.contrasts import consequence_slots, kind_of
from xavi_dialogue.nlg.content.manoeuvres import deed_clause
from xavi_dialogue.nlg.content.motives import motion_cause
from xavi_dialogue.nlg.content.plan import Plan
from xavi_dialogue.nlg.content.proposals import about_vehicle
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Clause, Quantity, Who

TOGETHER = 1.0  # [s] within which two are at a place at the same time
FAR = 60.0  # [m] from which somebody is far away
#: Who is told of first: whom we let go, then who had right of way, then who had not.
_ORDER = {"vehicle": 1, "depends": 2, "ego": 3}


def plan_going(answer: GoReason, context: SpeechContext) -> Plan:
    """Plan why we went when we did."""
    past = answer.past
    deed = Clause(Who(), "go", (), "past" if past else "present", progressive=not past)
    if answer.deed is not None and answer.deed.action != "continue":
        deed = deed_clause(answer.deed, context.now, past=past)
    time = None if answer.deed is None else answer.deed.begin
    ranked = sorted(answer.others, key=lambda one: (not one.gone, _ORDER[one.first]))
    free = tuple(_free(one, time, past=past) for one in ranked[:2])
    core = message("WENT", deed=deed, free=free, past=past)
    proposed = about_vehicle(ranked[0].vehicle) if ranked else ()
    waiting = _waiting(answer, context)
    return Plan((core,), () if waiting is None else (waiting,), (), (), proposed)


def _free(one: Bystander, time: float | None, *, past: bool) -> Message:
    near = one.distance is not None and one.distance < FAR
    return message(
        "WAY_FREE",
        who=Who(Vehicle(one.vehicle), time),
        first=one.first,
        gone=one.gone,
        trend=one.trend,
        far=None if one.distance is None else Quantity(one.distance, "m"),
        near=near,
        past=past,
    )


def _waiting(answer: GoReason, context: SpeechContext) -> Message | None:
    """What waiting would have cost."""
    if answer.contrast is None or kind_of(answer.contrast) not in ("time", "late", "collision"):
        return None
    slots = consequence_slots(answer.contrast, context, past=answer.past)
    return Message("WAITING_COST", slots)


def plan_unslowed(answer: Unslowed, context: SpeechContext) -> Plan:
    """Plan what can be said of not having slowed down."""
    cause = answer.cause
    who = None
    if cause is not None and cause.vehicle:
        who = Who(Vehicle(cause.vehicle), answer.deed.begin)
    ahead = None
    if answer.ours is not None and answer.theirs is not None:
        ahead = answer.theirs - answer.ours
    core = message(
        "UNSLOWED",
        who=who,
        kind=None if cause is None else cause.kind,
        cause=None
        if cause is None
        else motion_cause(cause, answer.deed.begin, context, past=True, deed=answer.deed.action),
        met=ahead is not None,
        together=ahead is not None and abs(ahead) <= TOGETHER,
        before=ahead is not None and ahead > 0.0,
        gap=None if ahead is None else Quantity(abs(ahead), "s"),
        simple=context.detail == "simpler",
        going=answer.going,
    )
    proposed = about_vehicle(cause.vehicle) if cause is not None and cause.vehicle else ()
    return Plan((core,), (message("NO_SIMULATION", speed=not answer.going),), (), (), proposed)
