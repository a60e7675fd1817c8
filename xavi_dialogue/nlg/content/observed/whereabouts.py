"""Whereabouts: where somebody or something is or was, and where we are, in words."""

from xavi_dialogue.domain.answers import Located
from xavi_dialogue.domain.facts import Look, Measure
from xavi_dialogue.domain.terms import Ego, Exit, Vehicle
from xavi_dialogue.nlg.content.clauses.joint_measures import is_within
from xavi_dialogue.nlg.content.clauses.measures import AT_HAND, measure_message
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.tenses import since, tense_at
from xavi_dialogue.nlg.content.observed.surroundings import is_past, plan_by_kind
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.tables import word
from xavi_dialogue.nlg.surface.values import Clause, Moment, Quantity, Who

FEW = 3  # maximum of road users whose places are told one by one


def plan_located(answer: Located, context: SpeechContext) -> Plan:
    """Plan where somebody or something is or was."""
    details = tuple(measure_message(m, context) for m in answer.measures)
    if not answer.looks:
        if answer.gap is None and isinstance(answer.thing, Ego) and details:
            first, *others = _where_we_are(answer.measures, context)
            return Plan((first,), tuple(others))
        if answer.gap is None and details:
            return Plan(details[:1], details[1:])
        who = Who(answer.thing, ride=isinstance(answer.thing, Ego), placed=False)
        gap = answer.gap or "not-recorded"
        return Plan((message("NOT_LOCATED", who=who, gap=gap, past=False),), details)
    here = all(look.in_view and not is_past(look, context) for look in answer.looks)
    if len(answer.looks) > FEW and here and not details:
        return plan_by_kind(answer.looks, (), context)
    parts = tuple(_located(look, context) for look in answer.looks)
    return Plan(parts[:1], (*parts[1:], *details))


def _where_we_are(measures: tuple[Measure, ...], context: SpeechContext) -> list[Message]:
    """Return where we are: how far before what comes next, and in which of several lanes."""
    known = [m for m in measures if m.gap is None and m.value is not None]
    goal = next((m for m in known if m.attribute == "distance" and m.to is not None), None)
    lane = next((m for m in known if m.attribute == "lane" and (m.count or 1) > 1), None)
    others = [measure_message(m, context) for m in known if m.attribute == "distance-to-go"]
    if goal is None or goal.value is None or goal.to is None:
        return ([measure_message(lane, context)] if lane is not None else []) + others or [
            measure_message(m, context) for m in measures
        ]
    past = context.now - goal.time > since(context)
    first = message(
        "WHERE_US",
        when=Moment(goal.time) if past else None,
        were="were" if past else "are",
        far=Quantity(goal.value, "m"),
        within=is_within(goal.to),
        at_hand=goal.value < AT_HAND,
        inside=isinstance(goal.to, Exit),
        to="our exit" if isinstance(goal.to, Exit) else Who(goal.to, goal.time if past else None),
        lane=measure_message(lane, context, when=False) if lane is not None else None,
    )
    return [first] if past else [first, *others]


def _located(look: Look, context: SpeechContext) -> Message:
    tense = tense_at(look.time, context.now, since(context))
    place = word("vehicles", "place", look.bearing)
    who = Who(Vehicle(look.vehicle), look.time, placed=False)
    lost = not look.in_view
    at = look.seen if lost and look.seen is not None else look.time
    return message(
        "LOCATED",
        lost=lost,
        who=who,
        when=Moment(at) if lost or tense == "past" else None,
        place=place,
        clause=Clause(who, "be", (place,), tense),
        far=Quantity(look.distance, "m"),
    )
