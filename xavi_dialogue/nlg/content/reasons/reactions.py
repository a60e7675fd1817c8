"""Reactions: whether we could stop for a sudden action of another vehicle, in words."""

from xavi_dialogue.domain.answers import Reaction
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.clauses import event_clause
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.proposals import about_vehicle
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import message
from xavi_dialogue.nlg.surface.values import Clause, Quantity, Tense, Who

LEAST = 1.0  # [m] minimum distance that is named
SLIGHT = 0.5  # [m/s] maximum difference of speeds that is none


def plan_reaction(answer: Reaction, context: SpeechContext) -> Plan:
    """Plan whether we would stop in time, with the distances that show it."""
    well = answer.kind not in ("short", "beside")
    asked = None
    if answer.asked is not None and answer.kind != "anybody":
        asked = "yes" if well == (answer.asked == "stop") else "no"
    who = None
    if answer.vehicle is not None:
        placed = answer.kind not in ("behind", "beside")
        who = Who(Vehicle(answer.vehicle), answer.time if answer.past else None, placed=placed)
    closing = None
    if answer.closing is not None and answer.closing > SLIGHT:
        closing = Quantity(answer.closing, "m/s")
    told = message(
        "REACTION",
        kind=answer.kind,
        verdict=asked,
        who=who,
        condition=condition(answer, context),
        speed=Quantity(answer.speed, "m/s"),
        needed=_metres(answer.needed),
        room=_metres(answer.room),
        near=answer.room is not None and answer.room < LEAST,
        follows=answer.left is not None,
        closing=closing,
        stays=answer.closing is not None and closing is None,
        left=_metres(None if answer.left is None else abs(answer.left)),
        past=answer.past,
        simple=context.detail == "simpler",
    )
    proposed = () if answer.vehicle is None else about_vehicle(answer.vehicle)
    return Plan((told,), (), (), (), proposed)


def _metres(value: float | None) -> Quantity | None:
    return None if value is None else Quantity(max(value, LEAST), "m")


def condition(answer: Reaction, context: SpeechContext) -> Clause | None:
    """Return the supposition, as the clause of an "if"."""
    if answer.supposed is None:
        return None
    tense: Tense = "past-perfect" if answer.past else "past"
    clause = event_clause(answer.supposed, context.now, tense=tense, negated=answer.negated)
    return Clause(clause.subject, clause.verb, clause.rest, tense, negated=answer.negated)
