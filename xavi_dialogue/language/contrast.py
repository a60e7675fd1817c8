"""Content of contrasts: what we did against what we might have done, and who caused it."""

from typing import Literal

from xavi_dialogue.explain.explanation import Cause, Effect, Evidence, Explanation
from xavi_dialogue.explain.query import Query, Tense
from xavi_dialogue.language.doings import LANE_CHANGES, doing, plain
from xavi_dialogue.language.morphology import EGO, Doing, Vehicle
from xavi_dialogue.language.points import (
    Budget,
    CausePoint,
    Constraint,
    Contrast,
    EffectPoint,
    EvidencePoint,
    SuspectPoint,
)
from xavi_dialogue.language.quantities import KMH, Quantity, Span
from xavi_dialogue.language.wording import lexicon

STANDSTILL = 0.5  # [m/s] slower than this counts as standing
SLOWING = 2.0 / KMH  # [m/s] a loss of speed worth calling so
FEW = 2  # actions of a vehicle that are named where the answer must be short
NARROW = 1.0  # [s] a range of time differences not worth giving

#: What a turn may be the reason for.
BRAKING = frozenset({"slow-down", "stop", "give-way"})


def contrast(query: Query, found: Explanation, budget: Budget) -> Contrast:
    """What speaks for what we did, how the foil would have turned out, and because of whom."""
    assert found.outcome is not None
    past = query.tense == "past"
    fact = plain(found.done or query.factual or found.factual[: len(found.counterfactual)])
    in_lane = bool(fact) and fact[0] in LANE_CHANGES
    foil = plain(found.counterfactual)
    outcome = found.outcome
    effects = effect_points(found.effects, budget.effects) if outcome.name == "done" else ()
    points = tuple(cause_point(c, query.tense, budget) for c in found.causes[: budget.causes])
    # Only what holds us up explains a foil that is worse; an impossible way explains itself.
    worse = outcome.name in ("collision", "termination") or (bool(effects) and effects[0].more)
    because = points[0] if points and worse else None
    struck = outcome.collided_with
    purpose = outcome.name if outcome.name != "done" else _purpose(effects)
    if purpose == "termination" and fact[:1] in (("stop",), ("slow-down",)):
        purpose = None  # who stops does not do so to be there in good time
    rule: Literal["WHY", "WHAT_IF", "BRIEF"] = "WHAT_IF" if query.type == "what_if" else "WHY"
    return Contrast(
        rule="BRIEF" if rule == "WHY" and not budget.purpose else rule,
        past=past,
        fact=doing(EGO, fact, query.tense, in_lane=foil[0] in LANE_CHANGES),
        foil=Doing(EGO, foil, query.tense, in_lane),
        purpose=purpose,
        outcome=outcome.name,
        probability=outcome.probability,
        struck=None if struck is None else Vehicle(struck),
        effects=effects,
        because=because,
        also=points[1:] if because else points,
        more=budget.more,
        evidence=_evidence(found.evidence),
        suspect=suspect_point(found),
        denied=doing(EGO, query.factual or (), query.tense) if found.done else None,
    )


def _evidence(evidence: Evidence) -> EvidencePoint | None:
    if not (evidence.rollouts and evidence.distinct_samples):
        return None
    return EvidencePoint(
        drives=Quantity(evidence.rollouts, "count"),
        situations=Quantity(evidence.distinct_samples, "count"),
    )


def _purpose(effects: tuple[EffectPoint, ...]) -> str | None:
    return next((e.component for e in effects if e.more), None)


def effect_points(effects: tuple[Effect, ...], limit: int) -> tuple[EffectPoint, ...]:
    """The differences worth naming: time first, then as ranked.

    Where none of the first `limit` speaks for what was done, the first that does is added; and
    one that outranks all of them and speaks against them is not kept back.
    """
    negligible = lexicon().negligible
    worth = [e for e in effects if abs(e.delta) > negligible[e.component]]
    ranked = sorted(worth, key=lambda e: e.component != "time")
    chosen = ranked[:limit]
    if not chosen:
        return ()
    if not any(e.delta > 0 for e in chosen):
        chosen += [e for e in ranked if e.delta > 0][:1]
    elif worth[0].delta < 0 and worth[0] not in chosen:
        chosen.append(worth[0])
    leading = chosen[0].delta > 0
    chosen.sort(key=lambda e: (e.delta > 0) != leading)
    points: list[EffectPoint] = []
    for effect in chosen:
        opposed = bool(points) and points[-1].more != (effect.delta > 0)
        points.append(_effect(effect, opposed))
    return tuple(points)


def _effect(effect: Effect, opposed: bool) -> EffectPoint:
    least = lexicon().negligible[effect.component]
    low, high = Quantity(effect.low, "s"), Quantity(effect.high, "s")
    return EffectPoint(
        component=effect.component,
        size=Quantity(abs(effect.delta), "s"),
        more=effect.delta > 0,
        opposed=opposed,
        unsure=effect.low < -least and effect.high > least,
        narrow=effect.high - effect.low < NARROW,
        low=low,
        high=high,
        range=Span(*sorted((low, high), key=lambda end: abs(end.value))),
    )


def suspect_point(found: Explanation) -> SuspectPoint | None:
    """The vehicle that the question takes for the cause."""
    suspect = found.suspect
    return None if suspect is None else SuspectPoint(Vehicle(suspect.vehicle), suspect.part)


def cause_point(cause: Cause, tense: Tense, budget: Budget) -> CausePoint:
    """One vehicle, and how it made things turn out so."""
    mechanism = cause.mechanism
    start = mechanism.speed_from if mechanism else None
    lowest = mechanism.speed_to if mechanism else None
    slows = start is not None and lowest is not None and start - lowest >= SLOWING
    known = (cause.vehicle, tuple(cause.actions)) in budget.told
    particulars = budget.particulars and not known
    actions = plain(cause.actions)
    actions = actions if particulars else actions[-FEW:]
    last = actions[-1:]
    changes_only = bool(actions) and all(a in LANE_CHANGES for a in actions)
    halts = slows and lowest is not None and lowest < STANDSTILL
    after = (
        () if known or changes_only or last in (("continue",), ("stop",) if halts else ()) else last
    )
    necessary: dict[bool | None, Literal["yes", "no"]] = {True: "yes", False: "no"}
    return CausePoint(
        vehicle=Vehicle(cause.vehicle),
        probability=cause.probability,
        chance=Quantity(cause.probability, "probability"),
        past=tense == "past",
        how=mechanism.how if mechanism else None,
        doing=Doing(cause.vehicle, actions, tense) if actions else None,
        before=Doing(cause.vehicle, last, tense) if changes_only else None,
        after=Doing(cause.vehicle, after, tense) if after else None,
        slows=slows,
        halts=halts,
        particulars=particulars,
        speed_from=None if start is None else Quantity(start, "km/h"),
        speed_to=None if lowest is None or lowest < STANDSTILL else Quantity(lowest, "km/h"),
        necessary=necessary.get(cause.decision_changes),
        present=mechanism is not None and mechanism.present,
        doubted=cause.necessary is False,
    )


def constraint(
    query: Query, deed: tuple[str, ...], found: Explanation, budget: Budget
) -> Constraint:
    """Who was in our way when we slowed down, stopped or gave way."""
    points = tuple(cause_point(c, query.tense, budget) for c in found.causes[: budget.causes])
    asked = Doing(EGO, plain(deed), query.tense)
    return Constraint(
        deed=Doing(EGO, found.done, query.tense) if found.done else asked,
        denied=asked if found.done else None,
        past=query.tense == "past",
        gave_way=deed[-1] == "give-way",
        turning=set(deed) <= BRAKING and found.factual[:1] in (("exit-left",), ("exit-right",)),
        because=points[0] if points else None,
        also=points[1:],
        suspect=suspect_point(found),
        cleared=None if found.cleared is None else Vehicle(found.cleared),
    )
