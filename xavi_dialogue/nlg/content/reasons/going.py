"""Going: why we went when we did, and what if we had not slowed down."""

from xavi_dialogue.domain.answers import CrossingVehicle, GoReason, MotionCause, Unslowed
from xavi_dialogue.domain.reasons import Asking
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.clauses import doing
from xavi_dialogue.nlg.content.clauses.manoeuvres import deed_clause
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.proposals import about_vehicle
from xavi_dialogue.nlg.content.reasons.contrasts import consequence_slots, kind_of, risks
from xavi_dialogue.nlg.content.reasons.driven import motion_cause
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Clause, Moment, Quantity, Who

TOGETHER = 1.2  # [s] maximum time between two who are at a place together
TIGHT = 3.0  # [s] maximum time between two, one of whom would have to brake
LEAST = 0.5  # [s] minimum time that is named
FAR = 60.0  # [m] minimum distance of somebody far away
#: The order of naming: those we let go, those with right of way, those without.
_ORDER = {"vehicle": 1, "depends": 2, "ego": 3, "ahead": 4, "none": 5}


def plan_going(answer: GoReason, context: SpeechContext) -> Plan:
    """Plan why we went when we did."""
    past = answer.past
    deed = Clause(Who(), "go", (), "past" if past else "present", progressive=not past)
    if answer.refrained is not None:
        ahead = answer.refrained == "let-go"
        verb = "go first" if ahead else doing(answer.refrained, ego=True)
        deed = Clause(Who(), verb, (), "past" if past else "present", negated=not ahead)
    elif answer.deed is not None and answer.deed.action not in ("continue", "continue-next-exit"):
        deed = deed_clause(answer.deed, context.now, past=past)
    time = None if answer.deed is None else answer.deed.begin
    ranked = sorted(answer.others, key=lambda one: (not one.gone, _ORDER[one.first]))
    gone = [one for one in ranked if one.gone][:2]
    let_go = tuple(Who(Vehicle(one.vehicle), time) for one in gone)
    told = [one for one in ranked if not one.gone][: 2 - len(gone[:1])]
    first = (message("LET_GO", whos=let_go, past=past),) if gone else ()
    if answer.freed is not None:
        held = motion_cause(answer.freed, context.now if time is None else time, context, past=past)
        yielded = answer.freed.kind == "let-go"
        first = (first or (held,)) if yielded else (held, *first)
        told = told if yielded else [one for one in told if one.first in ("vehicle", "depends")]
    free = (*first, *(_free(one, time, past=past) for one in told))
    then = answer.refrained is None and past
    core = message("WENT", deed=deed, free=free, past=past, then=then)
    proposed = about_vehicle(ranked[0].vehicle) if ranked else ()
    waiting = _waiting(answer, context)
    against = answer.contrast
    risk = None if against is None else risks(against, context, past=past, unsaid=True)
    whole = (core,) if risk is None else (risk, core)  # a risk is stated first
    return Plan(whole, (), () if waiting is None else (waiting,), (), proposed)


def _free(one: CrossingVehicle, time: float | None, *, past: bool) -> Message:
    near = one.distance is not None and one.distance < FAR
    return message(
        "WAY_FREE",
        who=Who(Vehicle(one.vehicle), time),
        first=one.first,
        trend=one.trend,
        far=None if one.distance is None else Quantity(one.distance, "m"),
        near=near,
        past=past,
    )


def _waiting(answer: GoReason, context: SpeechContext) -> Message | None:
    """Return what waiting would have cost."""
    if answer.contrast is None or answer.contrast.verdict != "better":
        return None
    if kind_of(answer.contrast) not in ("time", "late", "collision"):
        return None
    slots = consequence_slots(answer.contrast, context, past=answer.past)
    return Message("WAITING_COST", slots)


_RISKY: dict[Asking, Asking] = {"dangerous": "crash", "riskier": "crash", "safer": "safe"}


_BENDS = ("turn", "bend", "roundabout")


def plan_unslowed(answer: Unslowed, context: SpeechContext) -> Plan:
    """Plan what can be said if we had not slowed down, or if we went now."""
    cause = answer.cause
    vehicle = answer.vehicle or (None if cause is None else cause.vehicle)
    begin = answer.deed.begin
    seen = vehicle is not None and context.look(vehicle, begin) is not None
    time = begin if answer.past and seen else None
    ahead = None
    if answer.ours is not None and answer.theirs is not None:
        ahead = answer.theirs - answer.ours
    form: str = _RISKY.get(answer.form, answer.form)
    if form != "could" and not answer.going and cause is not None and cause.kind in _BENDS:
        form = "paced"
    slots: dict[str, object] = {
        "who": None if not vehicle else Who(Vehicle(vehicle), time),
        "kind": None if cause is None else cause.kind,
        "cause": None if cause is None else _cause_of(answer, cause, context),
        "met": ahead is not None,
        "together": ahead is not None and abs(ahead) <= TOGETHER,
        "tight": ahead is not None and abs(ahead) <= TIGHT,
        "before": ahead is not None and ahead > 0.0,
        "gap": None if ahead is None else Quantity(abs(ahead), "s"),
        "simple": context.detail == "simpler",
        "past": answer.past,
        "right": answer.right,
        "through": answer.through,
        "red": answer.red,
        "form": "what-if" if answer.red and form in ("crash", "safe") else form,
    }
    timed = answer.form in ("arrival", "quicker")
    if timed and answer.saved is not None and answer.arrival is not None:
        coming = answer.arrival > context.now + LEAST
        slots |= {"saved": Quantity(answer.saved, "s"), "none": answer.saved < LEAST,
                  "arrival": Moment(answer.arrival) if coming else None}  # fmt: skip
    core = Message("UNSLOWED", slots)
    proposed = about_vehicle(vehicle) if vehicle else ()
    first = (message("AGAINST_RED"),) if answer.red else ()
    return Plan((*first, core), (), (), (), proposed)


def _cause_of(answer: Unslowed, cause: MotionCause, context: SpeechContext) -> Message:
    past, deed = answer.past, answer.deed
    return motion_cause(cause, deed.begin, context, past=past, deed=deed.action)
