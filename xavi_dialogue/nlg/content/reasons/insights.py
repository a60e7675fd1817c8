"""Insights: how we know and decide, how sure we are, and what a decision depends on."""

from typing import Any

from xavi_dialogue.domain.answers import (
    Avoidance,
    Certainty,
    Contrast,
    DecisiveFactor,
    Grounds,
    Method,
)
from xavi_dialogue.domain.facts import OptionValue
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.nlg.content.clauses.clauses import doing, episode_clause, subject_of
from xavi_dialogue.nlg.content.clauses.facts import option_message
from xavi_dialogue.nlg.content.clauses.manoeuvres import other_verbs, own_verbs
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.proposals import about_vehicle
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT
from xavi_dialogue.nlg.content.reasons.contrasts import (
    RISK,
    cause_message,
    consequence_slots,
    kind_of,
    risks,
)
from xavi_dialogue.nlg.content.reasons.evidence import further, rests_on
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.quantities import clock
from xavi_dialogue.nlg.surface.values import Chance, Clause, Moment, Number, Quantity, Who

EVEN = 0.45  # probability below which we are not sure at all
CLOSE = 0.65  # probability below which it was close
AGREEING = 0.2  # maximum difference between a probability and a count of situations that agree
BETTER = 1.2  # minimum factor of a better fit that is stated
UNFORESEEN = 0.25  # maximum probability of what could not have been foreseen
MOVED = 0.02  # minimum change of probability that is stated
DOUBTED = 0.1  # probability below which something is not believed
SETTLED = 0.65  # minimum probability of what is believed
EQUAL = 2.0  # maximum factor between fits that are about as good
NAMED = 3  # maximum of options named


def plan_grounds(answer: Grounds, context: SpeechContext) -> Plan:
    """Plan how we came to believe something of another vehicle."""
    who = Who(Vehicle(answer.vehicle), answer.end)
    simple = context.detail == "simpler"
    latest = answer.history[-1][1] if answer.history else answer.after
    slots: dict[str, Any] = {
        "who": who,
        "acts": other_verbs(answer.actions),
        "seen": answer.seen,
        "simple": simple,
        "deed": None,
        "light": answer.light,
        "chance": None if latest is None else Chance(latest),
        "doubted": latest is not None and (latest < DOUBTED or _has_sunk(answer, latest)),
    }
    slots["rival"] = other_verbs(answer.rival) if _is_open(answer, latest) else None
    if answer.deed is not None:
        clause = episode_clause(answer.deed, context.now, tense="past")
        slots["deed"] = Clause("it", clause.verb, clause.rest, "past")
    moved = abs((answer.after or 0.0) - (answer.before or 0.0)) >= MOVED
    if answer.before is not None and answer.after is not None and moved:
        slots |= {"before": Chance(answer.before), "after": Chance(answer.after),
                  "fell": answer.after < answer.before}  # fmt: skip
    if answer.start is not None and answer.end is not None:
        slots |= {"start": Moment(answer.start), "end": Moment(answer.end),
                  "at_once": clock(answer.start) == clock(answer.end)}  # fmt: skip
    since = None
    if answer.since is not None and not simple and not answer.seen:
        since = message("GROUNDS_SINCE", when=Moment(answer.since))
    fit = None if slots["doubted"] else _fit(answer, context)
    details = tuple(one for one in (fit, since) if one is not None)
    return Plan((Message("GROUNDS", slots),), details, (), (), about_vehicle(answer.vehicle))


def _has_sunk(answer: Grounds, latest: float) -> bool:
    """Check whether what was more probable than not for a while is no longer believed."""
    return latest < EVEN <= (answer.after or 0.0)


def _is_open(answer: Grounds, latest: float | None) -> bool:
    """Check whether what was seen fits something else about as well."""
    if latest is None or answer.seen or not answer.rival or answer.fit is None:
        return False
    return 1.0 - SETTLED < latest < SETTLED and 1.0 / EQUAL < answer.fit < EQUAL


def _fit(answer: Grounds, context: SpeechContext) -> Message | None:
    """Return how much better the path fits what is believed than the likeliest alternative."""
    if answer.fit is None or answer.fit < BETTER or not answer.rival:
        return None
    simple = context.detail == "simpler"
    return message(
        "GROUNDS_FIT",
        times=None if simple else _times(answer.fit),
        acts=other_verbs(answer.actions),
        rival=other_verbs(answer.rival),
    )


def _times(fit: float) -> str:
    """Return a factor in words."""
    if fit >= 20.0:
        return "more than 20"
    return f"{fit:.0f}" if fit >= 3.0 else f"{fit:.1f}".removesuffix(".0")


def plan_certainty(answer: Certainty, context: SpeechContext) -> Plan:
    """Plan how sure we are of a plan, or that a choice was the better one."""
    contrast, share = answer.contrast, answer.share
    past = context.now - answer.decided > PRESENT
    fact = () if contrast is None else contrast.fact
    foil = () if contrast is None else contrast.foil
    slots: dict[str, Any] = {
        "plan": answer.about == "plan",
        "past": past,
        "unknown": share is None,
        "unsure": share is not None and share < EVEN,
        "fair": share is not None and share < CLOSE,
        "share": None if share is None else Chance(share),
        "fact": own_verbs(fact, foil) if fact else None,
        "simple": context.detail == "simpler",
        "good": Number(answer.good, ""),
        "situations": Number(answer.situations, "situation"),
        "all": answer.good == answer.situations,
        "well": answer.good > 0,
        "one": answer.evidence.distinct_samples <= 1,
        "others": answer.others > 0,
        "low": None if answer.low is None else Chance(answer.low),
        "covered": None if answer.covered is None else Chance(min(answer.covered, 1.0)),
        "weight": _weight(answer),
        "foil": None,
        "verdict": "alone",
    }
    if contrast is not None and foil:
        told = consequence_slots(contrast, context, past=past)
        slots = told | slots | {"foil": own_verbs(foil, fact), "verdict": contrast.verdict}
    held: tuple[Message, ...] = (Message("CERTAIN_OF", slots),)
    counted = share is None or slots["verdict"] == "close"  # if no figure is stated
    details = held if counted else ()
    if slots["verdict"] == "better" and slots["fair"]:
        details = (*_because(contrast, context, past=past), *details)
    risk = None if contrast is None else risks(contrast, context, past=past, unsaid=True)
    more = () if contrast is None else further(contrast, context, past=past)
    shown = () if context.detail == "simpler" else details
    core = (*(() if risk is None else (risk,)), Message("CERTAINTY", slots))
    return Plan(core, shown, (*(() if counted else held), *more[:2]))


def _weight(answer: Certainty) -> str | None:
    """Return whether the situations in which it does better are the likelier ones, or the others.

    None if their share by number agrees with their share by probability.
    """
    if not answer.covered or answer.proven is None or not 0 < answer.good < answer.situations:
        return None
    surplus = answer.proven / answer.covered - answer.good / answer.situations
    if abs(surplus) < AGREEING:
        return None
    return "likelier" if surplus > 0.0 else "unlikelier"


def plan_method(answer: Method, context: SpeechContext) -> Plan:
    """Plan how we decided, or how we decide in general."""
    chosen = next((o for o in answer.options if o.chosen), None)
    others = [o for o in answer.options if not o.chosen]
    first = message(
        "METHOD",
        when=None if answer.decided is None else Moment(answer.decided),
        options=Number(max(answer.tried, len(answer.options)), "option") if chosen else None,
        chosen=None if chosen is None else Clause(Who(), doing(chosen.action, ego=True)),
        vehicles=Number(answer.vehicles, "road user") if answer.vehicles else None,
    )
    basis = rests_on(answer.evidence, None)
    past = answer.decided is not None and context.now - answer.decided > PRESENT
    risk = (
        ()
        if chosen is None
        else _risks(chosen, others, past=past, simple=context.detail == "simpler")
    )
    more = tuple(option_message(o) for o in others[:NAMED])
    details = () if basis is None or context.detail == "simpler" else (basis,)
    by_now = answer.risk_now or 0.0
    now = () if by_now < RISK else (_risk_now(by_now, context),)
    return Plan((*now, *risk, first), details, more)


def _risk_now(risk: float, context: SpeechContext) -> Message:
    return message("RISK_NOW", risk=Chance(risk), simple=context.detail == "simpler")


def _risks(
    chosen: OptionValue, others: list[OptionValue], *, past: bool, simple: bool
) -> tuple[Message, ...]:
    """Return the risks of a collision: of the chosen option, and of each alternative with one."""
    risky = [o for o in others if (o.collision or 0.0) >= RISK]
    own = chosen.collision or 0.0
    if not risky:
        alone = message("RISK_ALONE", past=past, risk=Chance(own), when=None)
        return (alone,) if own >= RISK else ()
    return tuple(
        message(
            "BOTH_RISKS" if k == 0 or simple else "RISK_OF",
            past=past,
            when=None,
            foil=own_verbs((option.action,), (chosen.action,)),
            risk=Chance(option.collision or 0.0),
            fact_risk=Chance(own if own >= RISK else 0.0),
            struck=None,
            simple=simple,
            more=(option.collision or 0.0) > own,
            close=option.close and (option.collision or 0.0) < own,
        )
        for k, option in enumerate(risky)
    )


def plan_pivot(answer: DecisiveFactor, context: SpeechContext) -> Plan:
    """Plan what a decision depends on, or what mattered most."""
    contrast = answer.contrast
    past = contrast is None or context.now - contrast.decided > PRESENT
    slots: dict[str, Any] = {
        "kind": answer.kind,
        "most": answer.most,
        "past": past,
        "who": None if answer.vehicle is None else Who(Vehicle(answer.vehicle), _when(contrast)),
        "acts": other_verbs(answer.actions) if answer.actions else None,
        "chance": None if answer.probability is None else Chance(answer.probability),
        "simple": context.detail == "simpler",
        "foil": None,
        "deed": None if answer.deed is None else own_verbs((answer.deed,), ()),
        "fact": None,
        "when": None,
    }
    if contrast is not None and contrast.foil:
        slots["foil"] = own_verbs(contrast.foil, contrast.fact)
        slots["fact"] = own_verbs(contrast.fact, contrast.foil)
        slots["when"] = Moment(contrast.decided) if past else None
    details = _because(contrast, context, past=past)
    more = () if contrast is None else further(contrast, context, past=past)
    return Plan((Message("PIVOT", slots),), details, more)


def _when(contrast: Contrast | None) -> float | None:
    return None if contrast is None else contrast.decided


def _because(
    contrast: Contrast | None, context: SpeechContext, *, past: bool
) -> tuple[Message, ...]:
    """Return how the alternative would have turned out, as things were."""
    if contrast is None or kind_of(contrast) == "alone":
        return ()
    return (Message("AS_THINGS_WERE", consequence_slots(contrast, context, past=past)),)


def plan_avoidance(answer: Avoidance, context: SpeechContext) -> Plan:
    """Plan whether something could have been avoided, and how."""
    contrast = answer.contrast
    simple = context.detail == "simpler"
    impact = answer.impact
    struck = impact.object if impact is not None else None
    slots: dict[str, Any] = {
        "possible": answer.possible,
        "happened": answer.happened,
        "mishap": Clause(
            subject_of(Ego(), answer.mishap), doing(answer.mishap, ego=True), negated=True
        ),
        "none": answer.options == 0,
        "options": Number(answer.options, "option"),
        "risk": Chance(answer.risk),
        "unforeseen": not answer.possible and answer.risk <= UNFORESEEN,
        "other": Chance(answer.other),
        "simple": simple,
        "struck": Who(struck, impact.begin) if isinstance(struck, Vehicle) and impact else None,
        "when": None if contrast is None else Moment(contrast.decided),
        "foil": None,
    }
    if contrast is not None and contrast.foil:
        slots["foil"] = own_verbs(contrast.foil, contrast.fact)
    details: list[Message] = []
    if answer.happened and answer.options and not simple:
        details.append(Message("AVOID_CHANCE", slots))
    cause = contrast.causes[0] if contrast is not None and contrast.causes else None
    if cause is not None and contrast is not None:
        told = cause_message(cause, contrast, context, past=True)
        details.append(message("PLAIN", it=told))
    time = _cost(contrast, context) if answer.possible else ()
    return Plan((Message("AVOIDANCE", slots),), time, tuple(details))


def _cost(contrast: Contrast | None, context: SpeechContext) -> tuple[Message, ...]:
    """Return what the option that avoids it would have cost in time."""
    if contrast is None:
        return ()
    slots = consequence_slots(contrast, context, past=True)
    delta = slots["delta"]
    if not isinstance(delta, Quantity) or slots["kind"] in ("collision", "dead", "late"):
        return ()
    return (Message("AVOID_COST", slots),)
