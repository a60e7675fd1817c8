"""Reasons: why we did or did not do something, and what would have come of doing otherwise."""

from typing import Any, Literal

from xavi_dialogue.domain.answers import ChoiceReason, Contrast, SupposedOfUs
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.contrasts import (
    cause_message,
    consequence_slots,
    kind_of,
    risks,
    told_cause,
)
from xavi_dialogue.nlg.content.evidence import continued, further
from xavi_dialogue.nlg.content.manoeuvres import deed_clause, own_verbs, planned_clause
from xavi_dialogue.nlg.content.plan import Plan
from xavi_dialogue.nlg.content.proposals import about_cause
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Clause, Who

GAIN = 0.5  # [s] from which something was worth it
Need = Literal["forced", "needed", "not-strictly", "close", "no-choice", "way"]
#: How a vehicle makes the foil worse only where it is done: no reason to be told before it.
OF_FOIL = ("right-of-way", "collision", None)


def plan_choice(answer: ChoiceReason, context: SpeechContext) -> Plan:
    """Plan why we did something or not, whether we had to, or whether it was worth it."""
    contrast, past = answer.contrast, answer.past
    slots = {
        **consequence_slots(contrast, context, past=past, that=answer.form == "why-not"),
        "deed": _deed(answer, context),
        "denied": _denied(contrast, past=past),
        "need": _need(contrast),
        "worth": _worth(contrast),
        "cause": _cause(contrast, context, past=past),
        "lead": _leads(contrast),
    }
    rule = {
        "why": "WHY", "why-not": "WHY_NOT", "necessary": "NECESSARY", "worth-it": "WORTH_IT",
    }[answer.form]  # fmt: skip
    verdict = suspected(answer.suspect, answer.suspected, contrast.cleared, contrast.decided)
    risk = risks(contrast, context, past=past)
    core = [m for m in (verdict, risk, Message(rule, slots)) if m is not None]
    if context.detail == "less":
        core = [_without_cause(m) for m in core]
    more = further(contrast, context, past=past)
    return Plan(tuple(core), _unsaid(answer, slots, context), more, (), about_cause(answer))


def _without_cause(said: Message) -> Message:
    return Message(said.rule, {**said.slots, "cause": None, "lead": False})


def _unsaid(
    answer: ChoiceReason, slots: dict[str, Any], context: SpeechContext
) -> tuple[Message, ...]:
    """What belongs to the reason and is not in its sentence: what the foil holds further."""
    del slots, context
    if answer.form in ("why", "why-not") and kind_of(answer.contrast) == "effort":
        found = continued(answer.contrast, past=answer.past)
        return () if found is None else (found,)
    return ()


def suspected(
    suspect: int | None,
    part: Literal["main", "part", "none"] | None,
    cleared: tuple[int, ...] = (),
    time: float | None = None,
) -> Message | None:
    """Make the verdict on the vehicle that the question takes for the cause."""
    if suspect is None or part is None:
        return None
    who = Who(Vehicle(suspect), time)
    return message("SUSPECTED", who=who, part=part, cleared=suspect in cleared)


def _deed(answer: ChoiceReason, context: SpeechContext) -> Clause:
    """What we did, or what we decided to do."""
    against = answer.contrast.foil
    if answer.deed is None:
        steps = answer.contrast.fact[: max(len(against), 1)]
        return planned_clause(steps, past=answer.past, against=against)
    return deed_clause(answer.deed, context.now, past=_told_past(answer, context), against=against)


def _told_past(answer: ChoiceReason, context: SpeechContext) -> bool:
    deed: Episode | None = answer.deed
    ended = deed is not None and deed.end is not None and context.now - deed.end > 1.0
    return answer.past or ended


def _denied(contrast: Contrast, *, past: bool) -> Clause:
    """That we did not, or do not, do what the foil is."""
    verbs = own_verbs(contrast.foil, contrast.fact) or (Clause(Who(), "do otherwise"),)
    rest = tuple(part for one in verbs[1:] for part in (f"and then {one.verb}",))
    tense: Literal["past", "present"] = "past" if past else "present"
    return Clause(Who(), verbs[0].verb, rest, tense, progressive=not past, negated=True)


def _cause(contrast: Contrast, context: SpeechContext, *, past: bool) -> Message | None:
    cause = told_cause(contrast)
    return None if cause is None else cause_message(cause, contrast, context, past=past)


def _leads(contrast: Contrast) -> bool:
    """Whether the cause is told before what the foil would have come to."""
    cause = told_cause(contrast)
    how = None if cause is None or cause.mechanism is None else cause.mechanism.how
    return how not in OF_FOIL


def _need(contrast: Contrast) -> Need:
    """Whether we had to: what the best alternative would have come to."""
    kind = kind_of(contrast)
    if contrast.way and kind in ("alone", "dead"):
        return "way"
    if kind == "alone":
        return "no-choice"
    if kind in ("collision", "dead"):
        return "forced"
    if kind in ("risk", "late"):
        return "needed"
    return "close" if kind in ("close", "same", "effort") else "not-strictly"


def _worth(contrast: Contrast) -> Literal["yes", "hardly", "no"]:
    """Whether it was worth it, in the planner's own reckoning."""
    if contrast.value is not None and contrast.value < -GAIN / 2:
        return "no"
    if contrast.close or (contrast.value is not None and contrast.value < GAIN):
        return "hardly"
    return "yes"


# --- What if we had done otherwise ----------------------------------------------------------------


def plan_supposed_of_us(answer: SupposedOfUs, context: SpeechContext) -> Plan:
    """Plan what would have come of another action of ours."""
    contrast, past = answer.contrast, answer.past
    cause = _cause(contrast, context, past=past)
    slots = {
        **consequence_slots(contrast, context, past=past),
        "fact": own_verbs(contrast.fact, contrast.foil),
        "cause": None if context.detail == "less" else cause,
    }
    risk = risks(contrast, context, past=past)
    more = further(contrast, context, past=past)
    if answer.done:
        just = message("JUST_THAT", fact=slots["fact"], past=past)
        rest = (Message("INSTEAD_OF_IT", slots),) if kind_of(contrast) != "alone" else ()
        core = (just, *(m for m in (risk,) if m is not None), *rest)
        return Plan(core, (), more, (), about_cause(answer))
    told = Message("IF_WE", slots)
    first = contrast.collision > contrast.fact_collision  # where what was done is riskier: second
    core = tuple(m for m in ((risk, told) if first else (told, risk)) if m is not None)
    after = continued(contrast, past=past)
    return Plan(core, () if after is None else (after,), more, (), about_cause(answer))
