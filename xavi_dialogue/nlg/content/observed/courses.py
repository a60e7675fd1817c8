"""Courses: our way ahead, the turns that are left, and whether we stay on the road, in words."""

from xavi_dialogue.domain.answers import Course
from xavi_dialogue.domain.journeys import LaneFits, WayStep
from xavi_dialogue.nlg.content.clauses.manoeuvres import own_verbs
from xavi_dialogue.nlg.content.clauses.measures import measure_message
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.ordinals import ordinal
from xavi_dialogue.nlg.surface.values import Number, Quantity

AT_HAND = 4.0  # [m] distance below which a place is just ahead
COUNTED = {"turns": "turn", "junctions": "junction", "roundabouts": "roundabout"}
SHOWN = 4  # maximum of turns that are listed
SIDES = {"exit-left": "left", "exit-right": "right", "exit-straight": "straight"}


def plan_course(answer: Course, context: SpeechContext) -> Plan:
    """Plan our way ahead."""
    del context
    if answer.arrived:
        return Plan((message("PLAN_NEXT", arrived=True),))
    if answer.form == "bound":
        way = {"lost": answer.left is None, "yes": answer.holds, "left": _left(answer)}
        return Plan((message("COURSE_BOUND", **way),))
    if answer.form in COUNTED:
        return Plan((_turns(answer),))
    if answer.form == "route":
        return Plan((message("COURSE_ROUTE", items=_listed(answer), left=_left(answer)),))
    if answer.form == "choice":
        return Plan((message("COURSE_CHOICE", items=_listed(answer), left=_left(answer)),))
    if answer.form == "halt":
        return Plan((_halt(answer),))
    if answer.form == "nearly":
        soon, left = answer.soon or 0.0, answer.left or 0.0
        return Plan((message("NEARLY", left=Quantity(left, "m"), soon=Quantity(soon, "s")),))
    slots: dict[str, object] = {
        "yes": answer.holds is True,
        "no": answer.holds is False,
        "left": _left(answer),
        "road": answer.form == "road",
        "then": answer.then,
    }
    if not answer.steps:
        return Plan((message("COURSE_STRAIGHT", **slots),))
    first, *others = answer.steps
    told = message("COURSE", it=_step(first), **slots)
    return Plan((told, *(message("COURSE", it=_step(step), then=False) for step in others)))


def plan_lane_fits(answer: LaneFits, context: SpeechContext) -> Plan:
    """Plan which lane we are in, and whether our plan leaves it."""
    turn = answer.turn
    change = None if answer.change is None else own_verbs((answer.change,))
    told = message(
        "LANE_FITS",
        it=measure_message(answer.lane, context),
        change=change,
        turn=None if turn is None else _step(turn),
    )
    return Plan((told,))


def _step(step: WayStep) -> Message:
    """Return what we do at a junction, and how far it is."""
    return message(
        "COURSE_STEP",
        ring=step.kind == "roundabout" and step.exit is not None,
        inside=step.inside,
        exit=ordinal(step.exit) if step.exit is not None else None,
        first=step.exit == 1,
        side=SIDES[step.turn],
        straight=step.turn == "exit-straight",
        rank=None if step.rank == 1 else ordinal(step.rank),
        far=Quantity(step.distance, "m") if step.distance >= AT_HAND else None,
    )


def _halt(answer: Course) -> Message:
    """Return the next junction at which we may have to stop, and why."""
    if not answer.steps:
        return message("COURSE_HALT", none=True, left=_left(answer))
    step = answer.steps[0]
    return message(
        "COURSE_HALT",
        none=False,
        place="roundabout" if step.kind == "roundabout" else "junction",
        far=Quantity(step.distance, "m") if step.distance >= AT_HAND else None,
        light=step.light,
        ring=step.kind == "roundabout",
        equal=step.rule == "equal",
    )


def _turns(answer: Course) -> Message:
    """Return how many turns are left, and which."""
    items = _listed(answer)
    return message(
        "COURSE_TURNS",
        none=not items,
        yes=answer.holds is True,
        no=answer.holds is False,
        one=len(answer.steps) == 1,
        number=Number(len(answer.steps), f"more {COUNTED[answer.form]}"),
        kind=COUNTED[answer.form],
        onward=answer.onward,
        items=items,
        left=_left(answer),
    )


def _left(answer: Course) -> Quantity | None:
    return None if answer.left is None else Quantity(answer.left, "m")


def _listed(answer: Course) -> tuple[Message, ...]:
    """Return the turns in their order, with the distance of the first."""
    return tuple(
        message(
            "COURSE_TURN",
            ring=step.kind == "roundabout" and step.exit is not None,
            inside=step.inside,
            exit=ordinal(step.exit) if step.exit is not None else None,
            side="straight on" if step.turn == "exit-straight" else SIDES[step.turn],
            far=Quantity(step.distance, "m") if rank == 0 and step.distance >= AT_HAND else None,
        )
        for rank, step in enumerate(answer.steps[:SHOWN])
    )
