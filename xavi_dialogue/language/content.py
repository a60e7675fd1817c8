"""Content selection: what of an explanation is said.

Nothing is put into words yet, and nothing is added to what the explanation holds: numbers are
passed on as they are, to be rounded when they are spelt out.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from xavi_dialogue.explain.explanation import Cause, Effect, Explanation
from xavi_dialogue.explain.query import Query, Tense
from xavi_dialogue.language.morphology import EGO, KMH, Doing, Quantity, Vehicle
from xavi_dialogue.language.points import (
    ActivityPoint,
    CausePoint,
    Content,
    Contrast,
    EffectPoint,
    EvidencePoint,
    Motive,
    Supposition,
)
from xavi_dialogue.language.wording import lexicon

LANE_CHANGES = ("change-left", "change-right", "overtake")
STANDSTILL = 0.5  # [m/s] slower than this counts as standing
SLOWING = 2.0 / KMH  # [m/s] a loss of speed worth calling so
NARROW = 1.0  # [s] a range of time differences not worth giving


@dataclass(frozen=True, slots=True)
class Budget:
    """How much an answer may hold; the first of a row of budgets that keeps it short is used."""

    effects: int
    causes: int
    purpose: bool = True
    particulars: bool = True  # speeds and intentions of a vehicle that held us up
    describe: bool = True  # describe vehicles besides naming them
    more: bool = False  # ranges, chances and evidence


def select(query: Query, found: Explanation, budget: Budget) -> Content:
    """What to say in answer to `query`, within `budget`."""
    actor = vehicle_of(query.actor)
    if query.type in ("what", "where_goal", "confidence", "when", "how"):
        return _activity(query, found)
    if actor is not None and query.type == "why" and found.activity is not None:
        return _motive(query, found, actor, budget)
    if actor is not None and query.type == "what_if":
        return _supposition(query, found, actor, budget)
    if found.counterfactual and found.outcome is not None:
        return _contrast(query, found, budget)
    return _activity(query, found)


def vehicle_of(actor: str) -> int | None:
    """The number in "vehicle:N"; None for the ego and for descriptions."""
    _, _, number = actor.partition(":")
    return int(number) if number.isdecimal() and int(number) != EGO else None


def plain(actions: Iterable[str]) -> tuple[str, ...]:
    """The actions without repetition, and without going on as an afterthought."""
    kept: list[str] = []
    for action in actions:
        if not kept or kept[-1] != action:
            kept.append(action)
    while len(kept) > 1 and kept[-1] == "continue":
        kept.pop()
    return tuple(kept)


def doing(actor: int, actions: Iterable[str], tense: Tense, in_lane: bool = False) -> Doing | None:
    """The actions as a phrase to be, or None where there is none."""
    kept = plain(actions)
    return Doing(actor, kept, tense, in_lane) if kept else None


def _contrast(query: Query, found: Explanation, budget: Budget) -> Contrast:
    assert found.outcome is not None
    past = query.tense == "past"
    fact = plain(query.factual or found.factual[: len(found.counterfactual)])
    in_lane = bool(fact) and fact[0] in LANE_CHANGES
    foil = plain(found.counterfactual)
    outcome = found.outcome
    effects = _effects(found.effects, budget.effects) if outcome.name == "done" else ()
    points = tuple(_cause(c, query.tense, budget) for c in found.causes[: budget.causes])
    # Only what holds us up explains a foil that is worse; an impossible way explains itself.
    worse = outcome.name in ("collision", "termination") or any(e.more for e in effects)
    because = points[0] if points and worse else None
    struck = outcome.collided_with
    purpose = outcome.name if outcome.name != "done" else _purpose(effects)
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
        evidence=EvidencePoint(
            Quantity(found.evidence.rollouts, "count"),
            _situations(found.evidence.distinct_samples),
        ),
    )


def _situations(count: int) -> str:
    return "one situation" if count == 1 else f"{count} different situations"


def _purpose(effects: tuple[EffectPoint, ...]) -> str | None:
    return next((e.component for e in effects if e.more), None)


def _effects(effects: tuple[Effect, ...], limit: int) -> tuple[EffectPoint, ...]:
    """The differences worth naming: time first, then as ranked.

    Where none of the first `limit` speaks for what was done, the first that does is added; and
    one that outranks all of them and speaks against them is not kept back.
    """
    negligible = lexicon().negligible
    worth = [e for e in effects if abs(e.delta) > negligible[e.component]]
    ranked = sorted(worth, key=lambda e: e.component != "time")
    chosen = ranked[:limit]
    if chosen and not any(e.delta > 0 for e in chosen):
        chosen += [e for e in ranked if e.delta > 0][:1]
    elif chosen and worth[0].delta < 0 and worth[0] not in chosen:
        chosen.append(worth[0])
    points: list[EffectPoint] = []
    for effect in chosen:
        opposed = bool(points) and points[-1].more != (effect.delta > 0)
        points.append(_effect(effect, opposed))
    return tuple(points)


def _effect(effect: Effect, opposed: bool) -> EffectPoint:
    return EffectPoint(
        component=effect.component,
        size=Quantity(abs(effect.delta), "s"),
        more=effect.delta > 0,
        opposed=opposed,
        unsure=effect.low < 0 < effect.high,
        narrow=effect.high - effect.low < NARROW,
        low=Quantity(effect.low, "s"),
        high=Quantity(effect.high, "s"),
    )


def _cause(cause: Cause, tense: Tense, budget: Budget) -> CausePoint:
    mechanism = cause.mechanism
    start = mechanism.speed_from if mechanism else None
    lowest = mechanism.speed_to if mechanism else None
    slows = start is not None and lowest is not None and start - lowest >= SLOWING
    actions = plain(cause.actions)
    last = actions[-1:]
    changes_only = bool(actions) and all(a in LANE_CHANGES for a in actions)
    halts = slows and lowest is not None and lowest < STANDSTILL
    after = () if changes_only or last in (("continue",), ("stop",) if halts else ()) else last
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
        particulars=budget.particulars,
        speed_from=None if start is None else Quantity(start, "km/h"),
        speed_to=None if lowest is None or lowest < STANDSTILL else Quantity(lowest, "km/h"),
        necessary=necessary.get(cause.decision_changes),
    )


def _supposition(query: Query, found: Explanation, actor: int, budget: Budget) -> Supposition:
    asked = query.counterfactual or ()
    mine = found.counterfactual or found.factual
    in_lane = bool(found.factual) and found.factual[0] in LANE_CHANGES
    mine_now = plain(mine[:1]) or ("continue",)
    return Supposition(
        vehicle=Vehicle(actor),
        doing=doing(actor, asked, query.tense),
        removed=query.intervention == "remove" or not asked,
        negated=query.negated,
        past=query.tense == "past",
        same=plain(found.factual[:1]) == mine_now,
        mine=Doing(EGO, mine_now, query.tense, in_lane),
        effects=_effects(found.effects, budget.effects),
    )


def _motive(query: Query, found: Explanation, actor: int, budget: Budget) -> Motive:
    activity = found.activity
    assert activity is not None
    deed = query.factual or ()
    actions = plain(activity.actions)
    done = max((i + 1 for i, action in enumerate(actions) if action in deed), default=0)
    aims = actions[done:]
    known = activity.probability is not None
    probability = 1.0 if activity.probability is None else activity.probability
    return Motive(
        vehicle=Vehicle(actor),
        past=query.tense == "past",
        deed=doing(actor, deed, query.tense),
        expected=done > 0,
        aim=doing(actor, aims, query.tense),
        onward=aims == ("continue",),
        probability=probability,
        chance=Quantity(probability, "probability") if known else None,
        more=budget.more,
    )


def _activity(query: Query, found: Explanation) -> ActivityPoint:
    activity = found.activity
    actor = activity.vehicle if activity else vehicle_of(query.actor) or EGO
    actions = plain(activity.actions if activity else found.factual)
    mine = actor == EGO
    known = mine or (activity is not None and activity.probability is None)
    probability = _probability(found)
    speed = activity.speed if activity else None
    trend = activity.trend if activity else None
    rules: dict[str, Literal["WHERE", "CONFIDENCE"]] = {
        "where_goal": "WHERE",
        "confidence": "CONFIDENCE",
    }
    return ActivityPoint(
        rule=rules.get(query.type, "WHAT"),
        mine=mine,
        vehicle=Vehicle(actor),
        tense=query.tense,
        past=query.tense == "past",
        now=doing(actor, actions[:1], query.tense) if known else None,
        next=doing(actor, actions[1:], "future") if known else None,
        forecast=None if known else doing(actor, actions, query.tense),
        probability=probability,
        chance=Quantity(probability, "probability"),
        motion=known or speed is not None or trend is not None,
        speed=None if speed is None else Quantity(speed, "km/h"),
        trend=trend,
        arrival=None if found.arrival is None else Quantity(found.arrival, "s"),
        outcome=found.outcome.name if found.outcome else None,
    )


def _probability(found: Explanation) -> float:
    if found.activity is not None and found.activity.probability is not None:
        return found.activity.probability
    return found.outcome.probability if found.outcome is not None else 1.0
