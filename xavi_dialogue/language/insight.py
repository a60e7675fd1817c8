"""Content of answers to how, how sure, how to avoid, and what it hangs on."""

import math
from dataclasses import replace

from msgspec.structs import replace as changed

from xavi_dialogue.explain.actions import same
from xavi_dialogue.explain.conditions import condition
from xavi_dialogue.explain.details import Avoidance, Certainty, Grounds, Pivot
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query, Tense
from xavi_dialogue.language.contrast import cause_point, contrast, effect_points
from xavi_dialogue.language.doings import LANE_CHANGES, doing, plain, staying
from xavi_dialogue.language.morphology import EGO, Doing, Vehicle
from xavi_dialogue.language.points import (
    Budget,
    Contrast,
    Evasion,
    Factor,
    GroundsPoint,
    Method,
    Plan,
    StepPoint,
    Supposition,
    Sureness,
    Unmoved,
)
from xavi_dialogue.language.quantities import Quantity, quantity

OVER = 0.975  # probability that is said as "over 95 %"
EVEN = 0.5  # probability from which something is more probable than not
NEVER, ALWAYS = 0.01, 0.99  # what was simulated is neither impossible nor certain
SELDOM = 0.25  # probability up to which an option is said to avoid something
TWICE = 1.5  # from which a fit is so many times better
FEW = 3  # steps that are named
HALTS = ("stop", "slow-down", "hard-brake")  # mishaps that to stop does not help against
DRIVING = ("slow-down", "speed-up", "give-way", "stop")
SLOWING = 0.5  # [m/s] a change of speed worth giving
RECENT = 2.0  # [s] up to which a belief is spoken of as held now
SOON = 1.0  # [s] below which something is at once


def insight(
    query: Query, found: Explanation, budget: Budget, now: float
) -> GroundsPoint | Plan | Method | Sureness | Evasion | Factor | Unmoved | Supposition | None:
    """What an explanation says beyond what all have; None where it has no more than they."""
    if found.grounds is not None:
        return _grounds(query, found, found.grounds, budget, now)
    if found.certainty is not None:
        return _sureness(query, found, found.certainty, budget)
    if found.avoidance is not None and found.moment is not None:
        return _evasion(query, found, found.avoidance, found.moment, budget)
    if found.pivot is not None:
        return _pivot(query, found, found.pivot, budget)
    if found.steps:
        return _plan(found, now)
    if found.options:
        return _method(query, found, budget, now)
    return _conditional(query, found, budget) if query.type == "sensitivity" else None


def _chance(probability: float) -> Quantity:
    return Quantity(min(max(probability, NEVER), ALWAYS), "probability")


def _clock(time: float) -> Quantity:
    return Quantity(time, "clock")


def _speed(speed: float | None) -> Quantity | None:
    return None if speed is None else Quantity(speed, "km/h")


def _grounds(
    query: Query, found: Explanation, grounds: Grounds, budget: Budget, now: float
) -> GroundsPoint:
    vehicle = grounds.vehicle
    old = found.seen is not None or now - found.sim_time > RECENT
    past = query.tense == "past" or grounds.done or old
    start, end = _clock(grounds.start), _clock(grounds.end)
    grew = grounds.after - grounds.before >= 0.05
    fits = budget.particulars and found.seen is None
    moved = plain(() if grounds.deed in (None, *DRIVING) else (grounds.deed,))
    one, other = grounds.speed_from, grounds.speed_to
    changed_speed = (
        budget.describe and one is not None and other is not None and abs(one - other) >= SLOWING
    )
    fit = grounds.fit
    standing = found.activity is not None and found.activity.trend == "standing"
    does = staying(grounds.actions, standing and query.tense != "past" and not grounds.done)
    return GroundsPoint(
        vehicle=Vehicle(vehicle),
        past=past,
        doing=doing(vehicle, does, "future") or Doing(vehicle, ("continue",), "future"),
        chance=_chance(grounds.probability),
        brief=not budget.purpose,
        doubted=grounds.since is None,
        fell=grounds.since is not None and grounds.latest < EVEN,
        at=Quantity(found.sim_time, "clock"),
        latest=_chance(grounds.latest),
        current=query.tense != "past" and not grounds.done and found.seen is None,
        start=start if grew and quantity(start) != quantity(end) else None,
        end=end if grew else None,
        before=_chance(grounds.before),
        after=_chance(grounds.after),
        deed=doing(vehicle, moved, "past") if budget.describe else None,
        speed_from=_speed(one) if changed_speed else None,
        speed_to=_speed(other) if changed_speed else None,
        rival=doing(vehicle, grounds.rival, query.tense),
        times=None if not fits or fit is None or fit < TWICE else Quantity(fit, "count"),
        unfit=fits and fit is None and bool(grounds.rival),
        gone=None if found.seen is None else _clock(found.seen),
    )


def _sureness(query: Query, found: Explanation, certainty: Certainty, budget: Budget) -> Sureness:
    depth = max(len(found.counterfactual) - 1, 0)  # of the choice: before it both are the same
    foil = found.counterfactual[depth:]
    chosen = found.factual[depth : depth + 1] or found.factual[-1:]
    asked = (query.factual or ())[:1]
    named = bool(asked and chosen) and same(asked[0], chosen[0])
    fact: tuple[str, ...] = asked if named else chosen
    in_lane = any(action in LANE_CHANGES for action in (*fact, *foil))
    return Sureness(
        choice=certainty.about == "choice" and bool(foil),
        past=query.tense == "past",
        fact=Doing(EGO, fact or ("continue",), query.tense, in_lane),
        foil=Doing(EGO, foil, query.tense, in_lane) if foil else None,
        share=certainty.share,
        chance=_chance(certainty.share),
        low=certainty.low,
        least=_at_least(certainty.low),
        loose=certainty.share - certainty.low >= 0.05,
        all=certainty.good == certainty.situations,
        none=certainty.good == 0,
        late=Quantity(certainty.late, "count") if certainty.late else None,
        good=Quantity(certainty.good, "count"),
        situations=Quantity(certainty.situations, "count"),
        brief=not budget.purpose and budget.causes == 0,
    )


def _evasion(
    query: Query, found: Explanation, avoidance: Avoidance, moment: float, budget: Budget
) -> Evasion:
    foil = plain(found.counterfactual)[:1]
    in_lane = any(action in LANE_CHANGES for action in (*found.factual[:1], *foil))
    done = found.outcome is not None and found.outcome.name == "done"
    return Evasion(
        mishap=avoidance.mishap,
        possible=avoidance.possible and bool(foil),
        at=Quantity(found.sim_time, "clock"),
        moment=Quantity(moment, "clock"),
        foil=Doing(EGO, foil, "past", in_lane) if foil else None,
        named=avoidance.mishap not in HALTS or foil != ("stop",),
        risk=_chance(avoidance.risk),
        other=_chance(avoidance.other),
        helps=avoidance.other <= SELDOM,
        unforeseen=avoidance.risk - avoidance.other < SELDOM,
        outcome=found.outcome.name if found.outcome else "done",
        options=Quantity(avoidance.options, "count"),
        effects=effect_points(found.effects, budget.effects) if done else (),
    )


def _pivot(
    query: Query, found: Explanation, pivot: Pivot, budget: Budget
) -> Factor | Unmoved | Supposition | None:
    against = (
        replace(contrast(query, found, budget), fact=None)
        if found.counterfactual and found.outcome is not None
        else None
    )
    if pivot.kind == "factor":
        return _factor(query, found, budget, against)
    foil = plain(found.counterfactual) or ("continue",)
    mine = Doing(EGO, foil, query.tense, any(a in LANE_CHANGES for a in found.factual[:1]))
    past = query.tense == "past"
    if pivot.kind == "none" or pivot.vehicle is None:
        return None if against is None else Unmoved(mine, past, against, brief=not budget.purpose)
    chance = pivot.probability
    return Supposition(
        vehicle=Vehicle(pivot.vehicle),
        doing=doing(pivot.vehicle, pivot.actions, query.tense),
        removed=pivot.kind == "removal" or not pivot.actions,
        negated=False,
        past=past,
        same=False,
        mine=mine,
        effects=(),
        chance=None if chance is None else _chance(chance),
        more=True,
    )


def _factor(
    query: Query, found: Explanation, budget: Budget, against: Contrast | None
) -> Factor | None:
    cause = next(iter(found.causes), None)
    if cause is None:
        return None if against is None else Factor(None, None, None, against)
    held = cause.mechanism
    crash = held is not None and held.how == "collision"
    later = next((e.delta for e in found.effects if e.component == "time" and e.delta > 0.0), None)
    delay = held.delay * held.share if held is not None and held.delay is not None else 0.0
    lost = later if later is not None and delay > 0.0 else delay
    return Factor(
        because=cause_point(cause, query.tense, budget),
        delay=Quantity(lost, "s") if lost >= SOON else None,
        crash=_chance(held.share) if held is not None and crash else None,
        contrast=None,
    )


def _at_least(bound: float) -> Quantity:
    """A lower bound, as it is said: rounded down to 5 %, or "over 95 %"."""
    return _chance(bound if bound >= OVER else math.floor(bound * 20.0 + 1e-9) / 20.0)


def _plan(found: Explanation, now: float) -> Plan:
    names = plain(step.action for step in found.steps)
    steps = tuple(
        StepPoint(
            doing=Doing(
                EGO, (step.action,), "future", step.action == "continue" and len(names) > 1
            ),
            ahead=Quantity(step.moment - now, "s") if step.moment - now >= SOON else None,
        )
        for step in found.steps
        if step.action in names
    )
    arrival = found.arrival
    return Plan(steps[:FEW], None if arrival is None else Quantity(arrival, "s"))


def _method(query: Query, found: Explanation, budget: Budget, now: float) -> Method:
    options = found.options
    in_lane = any(action in LANE_CHANGES for action in options)
    narrow = Budget(budget.effects, 0, False, False, budget.describe)
    past = query.tense == "past" or now - found.sim_time > RECENT
    tense: Tense = "past" if past else query.tense
    asked = changed(query, type="why", factual=None, tense=tense)
    known = found.counterfactual and found.outcome is not None
    ends = None if found.outcome is None else found.outcome.name
    return Method(
        past=past,
        fact=Doing(EGO, options[:1], tense, in_lane),
        options=Doing(EGO, options, tense, in_lane),
        single=len(options) == 1,
        brief=not budget.particulars,
        lost=not known and ends == "dead" and len(options) > 1,
        drives=Quantity(found.evidence.rollouts, "count"),
        situations=Quantity(found.evidence.distinct_samples, "count"),
        contrast=contrast(asked, found, narrow) if known else None,
    )


def _conditional(query: Query, found: Explanation, budget: Budget) -> Supposition | None:
    """Whether we would still have done it."""
    supposed = condition(query.condition or "")
    cause = next(iter(found.causes), None)
    if supposed is None or cause is None or cause.vehicle != supposed.vehicle:
        return None
    named = found.done or query.factual or query.counterfactual
    deed = plain(named or found.factual[:1]) or ("continue",)
    other = plain(found.counterfactual[:1])
    driving = any(action in DRIVING for action in deed)
    changes = cause.decision_changes is True
    done = driving or (deed == other) != changes
    stays = done and not changes
    would = deed if not done and changes else other
    denied = not stays and (driving or not other or (not done and would == other))
    in_lane = any(action in LANE_CHANGES for action in (*deed, *other))
    return Supposition(
        vehicle=Vehicle(supposed.vehicle),
        doing=doing(supposed.vehicle, supposed.actions, query.tense),
        removed=not supposed.actions,
        negated=supposed.negated,
        past=query.tense == "past",
        same=stays,
        mine=Doing(EGO, deed if stays or denied else would, query.tense, in_lane),
        effects=() if denied else effect_points(found.effects, budget.effects),
        chance=Quantity(cause.probability, "probability") if supposed.actions else None,
        more=budget.more,
        denied=denied,
        instead=Doing(EGO, found.done, "past") if found.done else None,
        undone=doing(EGO, query.factual or (), "past") if found.done else None,
    )


def whole(seconds: float) -> Quantity:
    """A time that is not rounded up: what takes longer than it takes longer than this."""
    return Quantity(math.floor(seconds), "s")
