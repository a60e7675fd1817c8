"""Suppositions: what the ego would do if another vehicle did otherwise, or were not there."""

import dataclasses
from dataclasses import dataclass

import numpy as np
from msgspec.structs import replace

from planner.record.trace import Action as MacroAction
from planner.record.trace import PlanTrace
from xavi_dialogue.causal.model import Actions, CausalModel, Choice, Intervention
from xavi_dialogue.domain.answers import Contrast, Evidence, NeedRollout, NotRecorded, TooLittle
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons
from xavi_dialogue.explain.causes.plans.contrast import (
    alternatives,
    evidence,
    factual,
    sides,
)
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES, is_macro, means
from xavi_dialogue.explain.causes.vehicles.conduct import matching, probability
from xavi_dialogue.explain.causes.vehicles.course import lines, speed_mark, stands
from xavi_dialogue.explain.causes.vehicles.hindsight import in_hindsight
from xavi_dialogue.explain.causes.vehicles.necessity import trial_of
from xavi_dialogue.explain.causes.vehicles.profile import Array, speeds
from xavi_dialogue.explain.history.ride import (
    ROUNDING,
    Ride,
    Unanswered,
    enough,
    planned,
    prediction,
    thin,
)

QUICKER = 1.0  # [m/s] minimum gain in speed with which the ego drives faster
BEYOND = 5  # places behind the slowest one where the ego may slow down instead
HALF, LEAST = 0.5, 1.5  # share of a fall in speed, and the fall [m/s], that is one all the same
FASTER = 5.0  # [m/s] by which another vehicle drives faster if that is supposed
#: By action that is supposed and in no sample: the action with which it is planned again.
STANDS_FOR: dict[ActionName, ActionName] = {
    "slow-down": "stop",
    "give-way": "stop",
    "leave": "exit-right",
}


@dataclass(frozen=True, slots=True)
class Supposed:
    """What was decided, and what would have been decided under a supposition."""

    trace: PlanTrace  # the decision
    again: PlanTrace  # the same, or planned again
    here: Intervention
    there: Intervention
    prior: float | None  # probability of what is supposed, as it was believed
    contrast: Contrast
    model: CausalModel  # of the supposed world
    proxy: MacroAction | None = None  # what was supposed instead, if the action itself could not be

    @property
    def same(self) -> bool:
        """Whether the ego would have begun with the same action."""
        return self.there.plan[:1] == self.here.plan[:1]


def is_faster(found: Supposed) -> bool:
    """Check whether the ego would drive faster somewhere on the next stretch of road."""
    here, there = speeds(found.trace, found.here), speeds(found.again, found.there)
    return here is not None and there is not None and float(np.max(there - here)) >= QUICKER


def slows_still(found: Supposed) -> bool:
    """Check whether the ego would slow down all the same where it did, if perhaps less."""
    here, there = speeds(found.trace, found.here), speeds(found.again, found.there)
    if here is None or there is None:
        return False
    reach = int(np.argmin(here)) + 1 + BEYOND
    as_was, now = _dip(here[:reach]), _dip(there[:reach])
    return now >= max(LEAST, HALF * as_was)


def _dip(speed: Array) -> float:
    """Return the greatest fall in speed [m/s] from a place to a later one."""
    return float(np.max(np.maximum.accumulate(speed) - speed))


def known_to(ride: Ride, vehicle: int, moment: float) -> list[PlanTrace]:
    """List the decisions up to a time [s] that had a choice and reckoned with a vehicle."""
    return [
        trace
        for trace in ride.traces
        if trace.sim_time <= moment + ROUNDING
        and trace.under_way is None
        and prediction(trace, vehicle) is not None
    ]


def decision_for(ride: Ride, vehicle: int, moment: float) -> PlanTrace:
    """Find the last decision up to a time [s] that reckons with a vehicle, else the first after.

    Raises:
        Unanswered: there is none.
    """
    known = known_to(ride, vehicle, moment)
    later = [t for t in known_to(ride, vehicle, ride.now) if t.sim_time > moment]
    found = known[-1:] or later[:1]
    if not found:
        raise Unanswered(NotRecorded("out-of-view", thing=Vehicle(vehicle), since=moment))
    return found[0]


def without(ride: Ride, vehicles: tuple[int, ...], moment: float) -> Supposed:
    """Compare a decision with the same made again without some vehicles.

    The decision is taken for the first of them that any decision up to a time [s] reckons with.

    Raises:
        Unanswered: no decision reckons with them; or it must be planned again first.
    """
    known = [vehicle for vehicle in vehicles if known_to(ride, vehicle, moment)]
    return planned_without(ride, decision_for(ride, (known or [*vehicles])[0], moment), vehicles)


def planned_without(ride: Ride, trace: PlanTrace, vehicles: tuple[int, ...]) -> Supposed:
    """Compare a decision with the same made again without some vehicles.

    Raises:
        Unanswered: it must be planned again first.
    """
    gone = tuple(vehicle for vehicle in vehicles if vehicle in trace.scene)
    again = ride.without(trace, *gone)
    if again is None:  # the planner could not make it; the caller finds out why
        removed = gone[0] if len(gone) == 1 else tuple(sorted(gone))
        raise Unanswered(NeedRollout(trace_id=trace.trace_id, removed=removed))
    return compared(ride, trace, again, None)


def happens_without(ride: Ride, reasons: Reasons, vehicles: tuple[int, ...]) -> bool | None:
    """Check whether the ego drives so without vehicles, by the trial that makes them causes.

    Args:
        ride: the record.
        reasons: why it drives so.
        vehicles: vehicles of the decision that are supposed not to be there.

    Returns:
        Whether it does; None if that cannot be planned.

    Raises:
        Unanswered: it does, but one of them is stated as a reason that could not be tried; or the
            record lacks what was decided; or rollouts are needed.
    """
    model = ride.model(reasons.trace)
    plan = in_hindsight(ride, model, factual(model, reasons.trace))
    gone = trial_of(ride, model, plan, vehicles).gone
    open_ = {cause.vehicle for cause in reasons.causes if cause.necessary is None}
    if gone is False and open_ & set(vehicles):
        raise Unanswered(TooLittle("too-little-evidence"))
    return None if gone is None else not gone


def together(
    ride: Ride,
    vehicles: tuple[int, ...],
    names: tuple[ActionName, ...],
    moment: float,
    *,
    negated: bool,
) -> Supposed | None:
    """Compare a decision with what it would be if several vehicles did, or did not do, something.

    That is read off the samples of the decision in which all of them do. None if there are too
    few, since the planner can change the conduct of only one vehicle.
    """
    trace = decision_for(ride, vehicles[0], moment)
    model = ride.model(trace)
    if not set(vehicles) <= set(model.vehicles):
        return None
    given: dict[int, frozenset[Choice]] = {}
    for vehicle in vehicles:
        every, matched = frozenset(model.choices(vehicle)), matching(model, vehicle, names)
        given[vehicle] = every - matched if negated else matched
    if not all(given.values()):
        return None
    try:
        return _given(ride, model, given)
    except Unanswered:
        return None


def otherwise(
    ride: Ride, vehicle: int, names: tuple[ActionName, ...], moment: float, *, negated: bool
) -> Supposed:
    """Compare a decision with what it would be if a vehicle did, or did not do, something.

    That is read off the samples of the decision itself. If they are too few, the decision is
    planned again with the vehicle acting so.

    Raises:
        Unanswered: it must be planned again first; or there is too little evidence.
    """
    trace = decision_for(ride, vehicle, moment)
    model = ride.model(trace)
    every, matched = frozenset(model.choices(vehicle)), matching(model, vehicle, names)
    supposed = every - matched if negated else matched
    refused: Unanswered = thin(tuple(n for n in names if is_macro(n)), None)
    if supposed and matched:
        try:
            return _given(ride, model, {vehicle: supposed})
        except Unanswered as unanswered:
            refused = unanswered
    believed = probability(ride, trace, vehicle, names)
    if negated and set(names) == {"leave"}:
        found = _acting(ride, trace, vehicle, ("continue-next-exit",), refused)
        return dataclasses.replace(found, prior=1.0 - believed)
    if negated and not matched:  # nobody thought that it would: things are as they are
        return _given(ride, model, {vehicle: every})
    if names[:1] == ("speed-up",) and not negated:
        need = NeedRollout(trace_id=trace.trace_id, vehicle=vehicle, faster=FASTER)
        again = ride.supposed(trace, need)
        if again is None and not ride.cannot_have(need):
            raise Unanswered(need)
        if again is not None:
            return compared(ride, trace, again, believed)
    meant = [STANDS_FOR.get(name, name) for name in names]
    steps = tuple(name for name in meant if is_macro(name))
    if negated or not steps:
        raise refused
    found = _acting(ride, trace, vehicle, steps[:1], refused)
    proxy = None if names[0] == steps[0] else steps[0]
    return dataclasses.replace(found, prior=believed, proxy=proxy)


def _acting(
    ride: Ride, trace: PlanTrace, vehicle: int, steps: Actions, refused: Unanswered
) -> Supposed:
    """Compare a decision with the same made again with a vehicle that does what no sample has."""
    need = NeedRollout(trace_id=trace.trace_id, vehicle=vehicle, vehicle_actions=steps)
    if len(steps) == 1 and steps[0] not in (
        *CHANGES,
        "continue-next-exit",
    ):  # a goal, whatever the way to it
        need = NeedRollout(trace_id=trace.trace_id, vehicle=vehicle, goal=steps[0])
    again = ride.supposed(trace, need)
    if again is not None:
        return compared(ride, trace, again, 0.0)
    raise refused if ride.cannot_have(need) else Unanswered(need)


def _given(ride: Ride, model: CausalModel, supposed: dict[int, frozenset[Choice]]) -> Supposed:
    """Compare what was decided with the ego's best plan given what is supposed of others."""
    trace, chance = model.trace, 1.0
    for vehicle, choices in supposed.items():  # each chooses by itself
        chances = model.choices(vehicle)
        chance *= min(sum(chances[choice] for choice in choices), 1.0)
    given = CausalModel(trace, supposed)
    there, here = _best(given, planned(trace)), factual(model, trace)
    contrast = replace(sides(ride, model, here, there, there.plan), likely=None)
    return Supposed(trace, trace, here, there, chance, contrast, given)


def _best(given: CausalModel, plan: Actions) -> Intervention:
    """Return the best plan that there is evidence for; of equals, what is planned anyway.

    Raises:
        Unanswered: there is too little evidence of what is planned anyway.
    """
    found = [i for a in given.options() if (i := given.intervene((a,))) is not None]
    options = [intervention for intervention in found if enough(intervention)]
    if not any(intervention.plan[:1] == plan[:1] for intervention in options):
        raise thin(plan[:1], given.intervene(plan[:1]))
    return max(options, key=lambda i: (i.value, i.plan[:1] == plan[:1]))


def compared(ride: Ride, trace: PlanTrace, again: PlanTrace, prior: float | None) -> Supposed:
    """Compare a decision with the same made again under a supposition."""
    model, other = ride.model(trace), ride.model(again)
    here, there = factual(model, trace), factual(other, again)
    one, two = evidence(ride, model, here), evidence(ride, other, there)
    both = Evidence(
        "rollouts",
        one.rollouts + two.rollouts,
        one.distinct_samples + two.distinct_samples,
        (*one.traces, *two.traces),
    )
    contrast = sides(ride, model, here, there, there.plan)
    contrast = replace(contrast, evidence=both, likely=None)
    return Supposed(trace, again, here, there, prior, contrast, other)


def within(ride: Ride, found: Supposed) -> Contrast:
    """Compare, in the supposed world, what would be planned with what was, or the next best.

    Raises:
        Unanswered: there is too little evidence.
    """
    tried = alternatives(found.model, found.there.plan[0])
    rival = next((pair for pair in tried if pair[0] == found.here.plan[:1]), None)
    rival = rival or next(iter(tried), None)
    if rival is None:
        raise thin(found.here.plan[:1], found.model.intervene(found.here.plan[:1]))
    told = sides(ride, found.model, found.there, rival[1], rival[0])
    if told.verdict == "worse":  # by the situations that were tried with both
        raise Unanswered(TooLittle("too-little-evidence"))
    return replace(told, likely=None)


def share_of(trace: PlanTrace, plan: Intervention, name: ActionName) -> float | None:
    """Return how probable it is that the ego drives so under a plan; None: not recorded."""
    if name not in ("slow-down", "speed-up", "stop", "give-way"):
        wanted = means(name)
        pairs = zip(plan.results, plan.weights, strict=True)
        return sum(w for r, w in pairs if any(a.action in wanted for a in r.rollout.actions))
    known = lines(trace)
    there = total = 0.0
    for result, weight in zip(plan.results, plan.weights, strict=True):
        line = known.get(result.rollout.index)
        if line is not None:
            total += weight
            does = stands(line) if name == "stop" else speed_mark(line, name) is not None
            there += weight * does
    return there / total if total > 0.0 else None
