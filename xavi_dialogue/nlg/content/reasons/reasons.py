"""Reasons: why we did or did not do something, and what would have followed otherwise."""

from collections.abc import Mapping
from typing import Literal

from xavi_dialogue.domain.answers import ChoiceReason, Contrast, Mechanism, MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.nlg.content.clauses.manoeuvres import (
    deed_clause,
    last_open,
    own_verbs,
    performed_later,
    planned_clause,
)
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.proposals import about_cause
from xavi_dialogue.nlg.content.clauses.tenses import dated, goes_on
from xavi_dialogue.nlg.content.reasons import terms
from xavi_dialogue.nlg.content.reasons.contrasts import (
    RISK,
    cause_message,
    consequence_slots,
    kind_of,
    risks,
    told_cause,
)
from xavi_dialogue.nlg.content.reasons.driven import STANDING, motion_cause
from xavi_dialogue.nlg.content.reasons.evidence import further, hangs_on, is_joint
from xavi_dialogue.nlg.content.reasons.suspects import suspected
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message
from xavi_dialogue.nlg.surface.values import Clause, Who

OTHERWISE = 1.0  # [m/s] minimum difference between two speeds
DECIDED = 0.95  # [s] after a decision, when the next one is in force
Need = Literal["forced", "needed", "not-strictly", "close", "worse", "no-choice", "way"]
#: Terms that a vehicle in our way explains.
DELAYS = frozenset(("time", "late"))
#: Mechanisms that only matter under the foil, and so are not stated before it.
OF_FOIL = ("right-of-way", "collision", None)


def plan_choice(answer: ChoiceReason, context: SpeechContext) -> Plan:
    """Plan why we did something or not, whether we had to, or whether it was worth it."""
    contrast = answer.contrast
    past = answer.past or _superseded(contrast, context)
    slots = {
        **consequence_slots(contrast, context, past=past, that=answer.form == "why-not"),
        "deed": _deed(answer, context),
        "denied": _denied(contrast, past=answer.past),
        "need": _need(contrast),
        "cause": cause_of(contrast, context, past=past),
        "lead": _leads(contrast),
        "ahead": _ahead(answer, context),
        "weak": _weak(answer),
        "turn": _lane_for(answer),
        "over": _told_past(answer, context),
        "beside": answer.ahead is not None and answer.ahead.kind in ("lane-beside", "lane-ahead"),
    }
    rule = {
        "why": "WHY", "why-not": "WHY_NOT", "necessary": "NECESSARY", "worth-it": "WORTH_IT",
        "mistaken": "WAS_WRONG",
    }[answer.form]  # fmt: skip
    risk = risks(contrast, context, past=past, unsaid=_silent(rule, slots))
    if slots["ahead"] is not None and slots["weak"] and contrast.fact_collision < RISK:
        risk = risk if contrast.verdict == "better" else None  # a small risk of what was not done
    first = Message(rule, slots)
    if context.detail == "less":
        first = _without_cause(first)
    core = suspected(
        first,
        answer.suspect,
        answer.suspected,
        contrast.decided,
        contrast.cleared,
        answer.besides,
        past=past,
        told=_names(answer, answer.suspect) or context.detail == "less",
    )
    more = further(contrast, context, past=past)
    core = core if risk is None else (risk, *core)  # a risk is stated first
    if answer.behind is not None:
        core = (motion_cause(answer.behind, context.now, context, past=False), *core)
    core = (*core, *last_open(answer.open_at), *performed_later(answer.later))
    hangs = hangs_on(contrast.causation, contrast.decided, past=past)
    if hangs is not None and _jointly(answer):
        named = answer.ahead if answer.ahead is not None and slots["weak"] else told_cause(contrast)
        whole = answer.of_causes or answer.suspected is not None or named is None
        brief = () if whole or named is None or named.vehicle is None else (named.vehicle,)
        joint = hangs_on(contrast.causation, contrast.decided, past=past, brief=brief)
        core = core if joint is None else (*core, joint)  # a single vehicle is not the whole reason
        hangs = None if joint == hangs else hangs
    asked = answer.of_causes and _of_vehicles(contrast)
    details = () if hangs is None or not asked else (hangs,)
    more = more if hangs is None or details else (hangs, *more)
    return Plan(core, details, more, (), about_cause(answer))


def _of_vehicles(contrast: Contrast) -> bool:
    """Check whether the reason names vehicles, so that how it depends on them belongs to it."""
    hangs = contrast.causation is not None and contrast.causation.kind != "none"
    return hangs and not contrast.way and told_cause(contrast) is not None


def _jointly(answer: ChoiceReason) -> bool:
    """Check whether a reason must name several vehicles as causes: together, or each on its own.

    A question whether one of them is the cause always asks for that.
    """
    causation = answer.contrast.causation
    asked = answer.suspected not in (None, "none", "neither")
    known = is_joint(causation, asked=asked or answer.of_causes)
    if causation is None or not known or answer.contrast.way or _lane_for(answer) is not None:
        return False
    return asked or any(_names(answer, vehicle) for vehicle in causation.vehicles)


def _silent(rule: str, slots: Mapping[str, object]) -> bool:
    """Check whether a reason states the way, or who was ahead, and nothing about the foil."""
    if rule in ("WHY", "WHY_NOT") and slots["ahead"] is not None and slots["weak"]:
        return True
    if rule == "WHY" and slots["turn"] is not None:
        return True
    due = {"WHY_NOT": slots["kind"] == "late", "NECESSARY": slots["need"] == "way"}
    return bool(slots["way"]) and due.get(rule, True)


def _superseded(contrast: Contrast, context: SpeechContext) -> bool:
    """Check whether the stated chances are from an earlier decision than the one in force."""
    risky = max(contrast.collision, contrast.fact_collision) >= RISK
    return (risky or told_cause(contrast) is not None) and context.now - contrast.decided > DECIDED


def _without_cause(said: Message) -> Message:
    return Message(said.rule, {**said.slots, "cause": None, "ahead": None, "lead": False})


def _deed(answer: ChoiceReason, context: SpeechContext) -> Clause:
    """Return what we did, or what we decided to do."""
    against = answer.contrast.foil
    if answer.deed is None:
        steps = answer.contrast.fact[: max(len(against), 1)]
        return planned_clause(steps, past=answer.past, against=against)
    past = _told_past(answer, context)
    clause = deed_clause(answer.deed, context.now, past=past, against=against)
    return dated(clause, answer.deed, context)


def _told_past(answer: ChoiceReason, context: SpeechContext) -> bool:
    deed: Episode | None = answer.deed
    return answer.past or (deed is not None and not goes_on(deed, context.now))


def _weak(answer: ChoiceReason) -> bool:
    """Check whether the vehicle ahead in the lane that we left is the better reason to state."""
    kind, ahead = kind_of(answer.contrast), answer.ahead
    if ahead is None:
        return False
    cause = told_cause(answer.contrast)
    how = None if cause is None or cause.vehicle != ahead.vehicle else cause.mechanism
    stands = ahead.speed is not None and ahead.speed < STANDING
    struck = ahead.vehicle == answer.contrast.collided_with
    if stands and (struck or kind not in ("collision", "risk")):
        return True  # where it would go does not matter while it stands
    if how is not None and not how.present and not _goes_on(how, ahead):
        return False  # what it was expected to do matters more than where it was
    if ahead.vehicle in answer.contrast.cleared:
        return False
    if ahead.kind in ("lane-beside", "lane-ahead") and answer.contrast.collision >= RISK:
        return False  # the risk of what was not done comes first
    first = answer.contrast.decisive
    return kind in ("alone", "close") or first in DELAYS or (first == "collision" and struck)


def _goes_on(how: Mechanism, ahead: MotionCause) -> bool:
    """Check whether somebody ahead is expected to hold us up at its present speed."""
    if how.how != "leader" or how.speed_to is None or ahead.speed is None:
        return False
    return abs(how.speed_to - ahead.speed) <= OTHERWISE


def _lane_for(answer: ChoiceReason) -> tuple[Clause, ...] | None:
    """Return the turn that a lane change is for, unless the question or answer names vehicles."""
    turn = answer.contrast.lane_for
    of_vehicles = answer.of_causes or answer.suspected is not None or answer.ahead is not None
    return None if turn is None or of_vehicles else own_verbs((turn,))


def _names(answer: ChoiceReason, vehicle: int | None) -> bool:
    """Check whether the reason names a vehicle."""
    cause = told_cause(answer.contrast)
    if answer.ahead is not None and _weak(answer):
        return answer.ahead.vehicle == vehicle
    if kind_of(answer.contrast) in ("collision", "risk"):
        return vehicle is not None and answer.contrast.collided_with == vehicle
    return cause is not None and cause.vehicle == vehicle


def _ahead(answer: ChoiceReason, context: SpeechContext) -> Message | None:
    """Return the vehicle that stood or drove slowly in the lane that we left."""
    if answer.ahead is None:
        return None
    if answer.ahead.vehicle == answer.contrast.collided_with and not _weak(answer):
        return None  # the risk names it
    decided = answer.contrast.decided
    past = _told_past(answer, context) or _differs(answer.ahead, context)
    return motion_cause(answer.ahead, decided, context, past=past)


def _differs(cause: MotionCause, context: SpeechContext) -> bool:
    """Check whether a vehicle drives at another speed now than at the decision."""
    look = None if cause.vehicle is None else context.look(cause.vehicle)
    if look is None or cause.speed is None:
        return False
    return not look.in_view or abs(look.speed - cause.speed) > OTHERWISE


def _denied(contrast: Contrast, *, past: bool) -> Clause:
    """Return that we did not, or do not, do the foil."""
    apart = terms.parted(contrast)
    done = len(apart.foil) > 1 and apart.foil[:1] == apart.fact[:1]
    foil = apart.foil[1:] if done else apart.foil  # the part of the foil that we do is not denied
    verbs = own_verbs(foil, apart.fact) or (Clause(Who(), "do otherwise"),)
    rest = tuple(part for one in verbs[1:] for part in (f"and then {one.verb}",))
    tense: Literal["past", "present"] = "past" if past else "present"
    return Clause(Who(), verbs[0].verb, rest, tense, progressive=not past, negated=True)


def cause_of(contrast: Contrast, context: SpeechContext, *, past: bool) -> Message | None:
    """Return the cause that belongs to the reason as a clause."""
    cause = told_cause(contrast)
    return None if cause is None else cause_message(cause, contrast, context, past=past)


def _leads(contrast: Contrast) -> bool:
    """Check whether the cause is stated before the consequences of the foil."""
    cause = told_cause(contrast)
    how = None if cause is None or cause.mechanism is None else cause.mechanism.how
    return how not in OF_FOIL


def _need(contrast: Contrast) -> Need:
    """Return whether we had to, by the consequences of the best alternative."""
    kind = kind_of(contrast)
    if contrast.way and kind in ("alone", "dead"):
        return "way"
    if kind == "alone":
        return "no-choice"
    if contrast.verdict in ("close", "worse"):
        return "close" if contrast.verdict == "close" else "worse"
    if kind in ("collision", "dead"):
        return "forced"
    return "needed" if kind in ("risk", "late") else "not-strictly"
