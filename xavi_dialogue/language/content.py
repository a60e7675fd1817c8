"""Content selection: what of an explanation is said.

Nothing is put into words yet, and nothing is added to what the explanation holds: numbers are
passed on as they are, to be rounded when they are spelt out.
"""

from dataclasses import replace
from typing import Literal, TypeAlias

from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query, Tense
from xavi_dialogue.explain.timing import ARRIVAL
from xavi_dialogue.language.contrast import constraint, contrast, effect_points, suspect_point
from xavi_dialogue.language.doings import LANE_CHANGES, doing, plain, staying, vehicle_of
from xavi_dialogue.language.hindrance import in_the_way
from xavi_dialogue.language.impact import ImpactPoint, impact_point
from xavi_dialogue.language.insight import EVEN, insight, whole
from xavi_dialogue.language.morphology import EGO, Doing, Vehicle
from xavi_dialogue.language.options import Aspect, aspect
from xavi_dialogue.language.points import ActivityPoint, Budget, Content, Motive, Supposition, Time
from xavi_dialogue.language.quantities import Quantity, Span
from xavi_dialogue.language.ranking import Comparison, comparison
from xavi_dialogue.language.sights import pace

#: All that an answer may say.
AnyContent: TypeAlias = Content | Comparison | Aspect | ImpactPoint
SPREAD = 2.0  # [s] a range of times worth giving


def select(query: Query, found: Explanation, budget: Budget, now: float) -> AnyContent:
    """What to say at time `now` [s] in answer to `query`, within `budget`."""
    actor = vehicle_of(query.actor)
    watched = found.activity or found.destination
    if found.impact is not None:
        return impact_point(query, found, found.impact, budget, now)
    aside = aspect(query, found, budget, now)
    if aside is not None:
        return aside
    if query.type == "when" or (query.event == ARRIVAL and query.type != "confidence"):
        return _time(query, found, actor, now)
    deeper = insight(query, found, budget, now)
    if deeper is not None:
        return deeper
    held_up = query.type == "how" or (query.type == "what" and found.causes)
    if actor is None and held_up and query.factual and not found.counterfactual:
        return constraint(query, query.factual, found, budget)
    if query.type in ("what", "where_goal", "confidence", "how"):
        return _activity(query, found)
    if actor is not None and query.type in ("why", "why_not") and watched is not None:
        return _motive(query, found, actor, budget)
    if actor is not None and query.type == "what_if":
        return _supposition(query, found, actor, budget)
    ranked = comparison(query, found, found.ranking) if found.ranking is not None else None
    if ranked is not None:
        return ranked
    if found.counterfactual and found.outcome is not None:
        return contrast(query, found, budget)
    if actor is None and query.type == "why" and query.factual:
        return constraint(query, query.factual, found, budget)
    return _activity(query, found)


def _supposition(query: Query, found: Explanation, actor: int, budget: Budget) -> Supposition:
    mine = plain((found.counterfactual or found.factual)[:1]) or ("continue",)
    fact = plain(found.factual[:1])
    cause = next((c for c in found.causes if c.vehicle == actor), None)
    changes = cause.decision_changes if cause else None
    removed = query.intervention == "remove" or not query.counterfactual
    known = cause is not None and not removed
    return Supposition(
        vehicle=Vehicle(actor),
        doing=doing(actor, query.counterfactual or (), query.tense),
        removed=removed,
        negated=query.negated,
        past=query.tense == "past",
        same=mine == fact if changes is None else not changes,
        mine=Doing(EGO, mine, query.tense, in_lane=bool(fact) and fact[0] in LANE_CHANGES),
        effects=effect_points(found.effects, budget.effects),
        chance=Quantity(cause.probability, "probability") if cause and known else None,
        more=budget.more,
    )


def _motive(query: Query, found: Explanation, actor: int, budget: Budget) -> Motive:
    contrary = found.contrary
    deed = query.factual or ((contrary.deed,) if contrary and contrary.deed else ())
    actions, probability = _expected(found)
    done = max((i + 1 for i, action in enumerate(actions) if action in deed), default=0)
    aims = actions[done:]
    held = in_the_way(query.tense, found, actor, aims)
    standing = found.activity is not None and found.activity.trend == "standing"
    return Motive(
        vehicle=Vehicle(actor),
        past=query.tense == "past",
        deed=doing(actor, deed, query.tense),
        expected=done > 0,
        aim=doing(actor, staying(aims, standing), query.tense),
        rival=doing(actor, staying(plain(found.rival), standing), query.tense),
        unlikely=probability is not None and probability < EVEN,
        onward=aims == ("continue",),
        probability=1.0 if probability is None else probability,
        chance=None if probability is None else Quantity(probability, "probability"),
        more=budget.more,
        held=held,
        suspect=suspect_point(found),
        waits=standing and query.tense == "present" and (not deed or "stop" in deed),
        ahead=query.tense == "future" or (query.tense == "present" and found.moment is None),
        withheld=None if contrary is None else doing(actor, contrary.asked, "past"),
        after=None
        if contrary is None or contrary.done is None
        else Quantity(contrary.done, "clock"),
        yet=contrary is not None and contrary.chance is not None,
        could=query.event == "could",
        going=query.tense == "present" and found.moment is not None and "stop" not in deed,
    )


def _expected(found: Explanation) -> tuple[tuple[str, ...], float | None]:
    """What a vehicle is expected to do, and how probably; what it is known to do is left out."""
    activity, destination = found.activity, found.destination
    if activity is not None and activity.probability is not None:
        return plain(activity.actions), activity.probability
    if destination is not None and destination.kind is not None:
        return (destination.kind,), destination.probability
    return (), None


def _time(query: Query, found: Explanation, actor: int | None, now: float) -> Time:
    moment = found.moment
    deed = doing(actor or EGO, query.factual or query.counterfactual or (), query.tense)
    standing = found.activity is not None and found.activity.trend == "standing"
    waiting = (standing and found.moment is None) or (standing and found.span is not None)
    foreseen = moment is not None and found.span is not None
    past = moment is not None and moment <= now and not foreseen
    low, high = found.span or (0.0, 0.0)
    spread = foreseen and high - low >= SPREAD
    waits_for = found.causes[0].vehicle if waiting and found.causes else None
    return Time(
        subject=None if actor is None else Vehicle(actor),
        deed=None if deed is None else replace(deed, tense="past" if past else "future"),
        past=past,
        at=None if moment is None else Quantity(moment, "clock"),
        ago=Quantity(now - moment, "s") if moment is not None and now - moment >= 1 else None,
        ahead=Quantity(moment - now, "s") if moment is not None and moment - now >= 1 else None,
        arrival=None if found.arrival is None else Quantity(found.arrival, "s"),
        arrived=found.arrival == 0.0,
        foreseen=foreseen,
        waiting=waiting,
        waits_for=None if waits_for is None else Vehicle(waits_for),
        between=_between(low - now, high - now) if spread else None,
        slow=found.outcome is not None and found.outcome.name == "termination",
        least=whole(found.least) if found.least is not None and found.least >= 1.0 else None,
    )


def _between(low: float, high: float) -> Span:
    return Span(Quantity(max(low, 0.0), "s"), Quantity(max(high, 0.0), "s"))


def _activity(query: Query, found: Explanation) -> ActivityPoint:
    activity, destination = found.activity, found.destination
    watched = activity or destination
    actor = watched.vehicle if watched else vehicle_of(query.actor) or EGO
    mine = actor == EGO
    expected, probability = ((), None) if mine else _expected(found)
    known = plain(found.factual) if activity is None else plain(activity.actions)
    if not mine and (activity is None or activity.probability is not None):
        known = ()
    if probability is None and found.outcome is not None:
        probability = found.outcome.probability
    speed = activity.speed if activity else None
    trend = pace(speed, activity.trend if activity else None)
    halted = trend == "standing"
    gone = found.seen is not None and not mine
    tense: Tense = "past" if gone else query.tense
    rules: dict[str, Literal["WHERE", "CONFIDENCE"]] = {
        "where_goal": "WHERE",
        "confidence": "CONFIDENCE",
    }
    if watched is None and found.outcome is not None and found.outcome.name == "collision":
        rules["what"] = "CONFIDENCE"  # "will we crash?"
    return ActivityPoint(
        rule=rules.get(query.type, "WHAT"),
        mine=mine,
        vehicle=Vehicle(actor),
        tense=tense,
        past=tense == "past",
        now=doing(actor, known[:1] if mine else known, tense),
        next=doing(actor, known[1:], "future"),
        forecast=doing(actor, staying(expected, halted), tense),
        rival=doing(actor, staying(plain(found.rival), halted), tense),
        halted=halted,
        probability=probability,
        chance=None if probability is None else Quantity(probability, "probability"),
        motion=bool(known) or speed is not None or trend is not None,
        speed=None if speed is None else Quantity(speed, "km/h"),
        trend=trend,
        arrival=None if found.arrival is None else Quantity(found.arrival, "s"),
        arrived=found.arrival == 0.0,
        outcome=found.outcome.name if found.outcome else None,
        gone=Quantity(found.seen, "clock") if gone and found.seen is not None else None,
        held=None if mine or tense != "present" else in_the_way(query.tense, found, actor, ()),
        instant=found.instant,
        planned=found.then is not None and query.tense == "future",
        done_at=None
        if found.moment is None or found.then is not None or not mine
        else Quantity(found.moment, "clock"),
    )
