"""Own suppositions: what would have happened if we had acted otherwise, in words."""

from typing import Any

from xavi_dialogue.domain.answers import Contrast, SupposedOfUs
from xavi_dialogue.domain.reasons import Asking
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.manoeuvres import (
    CHANGES,
    last_open,
    own_verbs,
    performed,
    performed_later,
)
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.proposals import about_cause
from xavi_dialogue.nlg.content.reasons.contrasts import (
    LIKELY,
    RISK,
    consequence_slots,
    kind_of,
    risks,
    time_effect,
    told_cause,
)
from xavi_dialogue.nlg.content.reasons.evidence import further
from xavi_dialogue.nlg.content.reasons.reasons import cause_of
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Chance, Moment, Who

#: Questions that are about risks themselves.
OF_RISKS = frozenset[Asking](("crash", "chance", "safe", "safer", "riskier", "dangerous"))
TIMED = frozenset[Asking](("arrival", "could", "quicker", "slower"))  # those that are about times
SAFER = 0.01  # minimum difference in the probability of a collision that makes something safer
ALIKE = 0.1  # maximum difference of probabilities of two outcomes that are stated as one
ABOUT = 1.5  # maximum factor between a time and what the question says about it


def plan_supposed_of_us(answer: SupposedOfUs, context: SpeechContext) -> Plan:
    """Plan what would have followed from another action of ours."""
    contrast, past = answer.contrast, answer.past
    cause = cause_of(contrast, context, past=past)
    slots = {
        **consequence_slots(contrast, context, past=past),
        "way": contrast.way or contrast.route is not None,
        "fact": own_verbs(contrast.fact, contrast.foil),
        "cause": None if context.detail == "less" else cause,
        "trouble": _troubles(contrast),
    }
    both = _both_late(contrast) if slots["kind"] == "late" and not slots["way"] else None
    slots |= {"late_too": both is not None, "chance": slots["chance"] if both is None else both}
    slots["gains"] = slots["delta"] is not None and not slots["later"]
    told_risk = slots["risk_too"] or slots["kind"] in ("risk", "collision")
    done = answer.done is not None
    weighs = answer.form == "what-if"
    risk = risks(contrast, context, past=past, weighs=weighs) if done or not told_risk else None
    more = further(contrast, context, past=past)
    if answer.ahead is not None and answer.ahead.vehicle is not None and not done:
        who = Who(Vehicle(answer.ahead.vehicle), contrast.decided)
        blocked = message("IF_BLOCKED", who=who, past=past, form=answer.form, **_verbs(contrast))
        return Plan((blocked,), (), more, (), about_cause(answer))
    if answer.done is not None:
        just = performed("JUST_THAT", answer.done)
        rest = (Message("INSTEAD_OF_IT", slots),) if kind_of(contrast) != "alone" else ()
        core = (just, *(m for m in (risk,) if m is not None), *rest)
        return Plan(core, (), more, (), about_cause(answer))
    if answer.form != "what-if" and kind_of(contrast) != "alone":
        asked = _asked(answer, slots)
        told = Message("IF_ASKED", {**slots, **asked})
        named = slots["kind"] == "collision" or (answer.form == "could" and asked["riskier"])
        untold = answer.form in TIMED and not named  # only times are stated
        if told_risk and (untold or (named and contrast.fact_collision >= RISK)):
            risk = risks(contrast, context, past=past, unsaid=True)
        beside = () if risk is None or answer.form in OF_RISKS else (risk,)
        core = (told, *beside, *last_open(answer.open_at), *performed_later(answer.later))
        return Plan(core, (), more, (), about_cause(answer))
    told = Message("IF_WE", slots)
    first = contrast.collision > contrast.fact_collision  # else the risk comes second
    core = tuple(m for m in ((risk, told) if first else (told, risk)) if m is not None)
    core = (*core, *last_open(answer.open_at), *performed_later(answer.later))
    return Plan(core, (), more, (), about_cause(answer))


def _both_late(contrast: Contrast) -> Chance | None:
    """Return how certain it is that neither plan arrives in time, if that is likely for both."""
    foil, fact = contrast.outcome, contrast.fact_outcome
    if foil is None or fact is None or not foil.name == fact.name == "termination":
        return None
    least, most = sorted((foil.probability, fact.probability))
    return Chance(least) if most - least <= ALIKE else None


def _troubles(contrast: Contrast) -> bool:
    """Check whether the additional lane changes of a foil decided against it."""
    changes = any(action in CHANGES for action in (*contrast.foil, *contrast.continued))
    return changes and any(s.term == "effort" and s.cost > 0.0 for s in contrast.told)


def _verbs(contrast: Contrast) -> dict[str, object]:
    return {"foil": own_verbs(contrast.foil, contrast.fact)}


def _held_against(claimed: float | None, size: float) -> str | None:
    """Return how a time [s] compares with what the question says; None if it says nothing."""
    if claimed is None:
        return None
    return "less" if claimed > ABOUT * size else "more" if size > ABOUT * claimed else "same"


def _told_in_all(answer: SupposedOfUs) -> bool:
    """Check whether the risk of any collision is greater than that with the vehicle asked about."""
    more = answer.contrast.collision - (answer.struck_risk or 0.0)
    return answer.struck is not None and more >= SAFER


def _asked(answer: SupposedOfUs, slots: dict[str, Any]) -> dict[str, Any]:
    """Return the slots for whether we could, would have collided, or when we would be there."""
    contrast = answer.contrast
    worse = contrast.value is None or contrast.value > 0.0
    asked = answer.struck_risk
    risk = contrast.collision if asked is None else asked
    cause = told_cause(contrast)
    how = None if cause is None or cause.mechanism is None else cause.mechanism.how
    behind = cause is not None and how in ("leader", "blocked", "cut-in")
    effect = time_effect(contrast)
    safer = contrast.fact_collision - risk
    later = tuple(a for a in contrast.continued if a in CHANGES)[:1]
    return {
        "form": answer.form,
        "judged": contrast.verdict,
        "verdict": "yes" if risk >= LIKELY else "maybe" if risk >= RISK else "no",
        "good": not worse and slots["kind"] not in ("collision", "dead", "late"),
        "rival": None if answer.struck is None else Who(Vehicle(answer.struck), contrast.decided),
        "in_all": Chance(contrast.collision) if _told_in_all(answer) else None,
        "behind": Who(Vehicle(cause.vehicle), contrast.decided) if behind and cause else None,
        "arrival": None if answer.arrival is None else Moment(answer.arrival),
        "sooner": effect is not None and effect.delta < 0.0,
        "claimed": None if effect is None else _held_against(answer.claimed, abs(effect.delta)),
        "safer": safer >= SAFER,
        "riskier": safer <= -SAFER,
        "risk": Chance(risk),
        "fact_risk": Chance(contrast.fact_collision),
        "risky": max(risk, contrast.fact_collision) >= RISK,
        "fact_risky": contrast.fact_collision >= RISK,
        "even": effect is None and any(e.component == "time" for e in contrast.effects),
        "afterwards": own_verbs(later, contrast.fact) if later else None,
        "cause": None,
    }
