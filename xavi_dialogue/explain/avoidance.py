"""How something unpleasant could have been avoided: which option known then does without it.

Looked at are the decisions of the last seconds before it, and at each of them the options that
were tried often enough. An option avoids it where its rollouts seldom have it, up to the time at
which it happened, and where what was chosen has it markedly more often.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from msgspec.structs import replace

from planner.events import Event
from planner.trace import Action, PlanTrace, Rollout
from sim.scene import EGO
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.explain import ego
from xavi_dialogue.explain.contrast import alternatives, evidence, factual, outcome, to_effects
from xavi_dialogue.explain.course import HARD, brakes, hard_braking, lines, speed_mark, stands
from xavi_dialogue.explain.deeds import did_not_happen
from xavi_dialogue.explain.details import Avoidance, Mishap
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.motion import Motion
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import ROUNDING, Ride, Unanswered, decline, planned

BEFORE = 10.0  # [s] before something happens, in which decisions may have avoided it
LEEWAY = 2.0  # [s] by which it may happen later in a rollout than it did
SELDOM = 0.25  # probability up to which an option avoids it
LESS = 0.25  # probability by which it must be rarer than under what was chosen
CRASH = "crash"  # the event of a question that names a collision
NAMED: Mapping[QueryAction, Mishap] = {
    "stop": "stop",
    "slow-down": "slow-down",
    "give-way": "give-way",
}

Occurs: TypeAlias = Callable[[Rollout, Motion | None], bool | None]  # None: not recorded


@dataclass(frozen=True, slots=True)
class _Way:
    """One way to act at one decision."""

    model: CausalModel
    here: Intervention  # what was chosen
    there: Intervention
    foil: tuple[Action, ...]
    risk: float  # under what was chosen
    other: float


def how_avoid(query: Query, ride: Ride) -> Explanation:
    """Which option would have avoided it, with what that would have cost; or that none would.

    Raises:
        Unanswered: it did not happen, or the record lacks the decisions before it.
    """
    if query.factual and not set(query.factual) & set(NAMED):
        return ego.why(replace(query, type="why"), ride)  # of its own choice: against what else
    mishap, moment = _mishap(query, ride)
    traces = [
        trace
        for trace in ride.traces
        if moment - BEFORE <= trace.sim_time < moment - ROUNDING and trace.under_way is None
    ]
    occurs = _occurs(mishap, moment + LEEWAY)
    looked: list[PlanTrace] = []
    ways: list[_Way] = []
    for trace in traces:
        found = _ways(ride, trace, occurs)
        if found is not None:
            looked.append(trace)
            ways += found
    if not looked:
        raise decline("outside-record", vehicle=EGO, time=moment)
    good = [w for w in ways if w.other <= SELDOM and w.risk - w.other >= LESS and _sound(w)]
    if good:
        best = max(good, key=lambda w: (w.there.value - w.here.value, w.model.trace.sim_time))
        return _explanation(ride, mishap, moment, best, looked, len(ways), possible=True)
    if ways:
        least = min(ways, key=lambda w: (w.other, -w.model.trace.sim_time))
        return _explanation(ride, mishap, moment, least, looked, len(ways), possible=False)
    return _without_options(ride, mishap, moment, looked)


def crashed(ride: Ride) -> Event | None:
    """The last collision, if there was one."""
    return next((event for event in reversed(ride.events) if event.kind == "collided"), None)


def _mishap(query: Query, ride: Ride) -> tuple[Mishap, float]:
    """What happened and when [s]: what the question names, else the worst.

    Raises:
        Unanswered: it did not happen.
    """
    crash = crashed(ride)
    motion = ride.motion(EGO)
    named = [NAMED[action] for action in query.factual or () if action in NAMED]
    if not named:
        if crash is not None:
            return "collision", crash.sim_time
        if query.event == CRASH:
            raise decline("did-not-happen", vehicle=EGO, did=False, what=CRASH)
        braked = hard_braking(motion)
        if braked is not None:
            return "hard-brake", braked
    for mishap in named or ("stop", "give-way", "slow-down"):
        moment = _happened(ride, motion, mishap)
        if moment is not None:
            return mishap, moment
    if "stop" in named and (braked := hard_braking(motion)) is not None:
        return "hard-brake", braked  # who says brake may mean either
    if not named:
        raise decline("did-not-happen", vehicle=EGO, did=False, what="mishap")
    raise did_not_happen(ride, query.factual or ())


def _happened(ride: Ride, motion: Motion, mishap: Mishap) -> float | None:
    """When [s] the ego last stopped, gave way or began to slow down."""
    if mishap == "give-way":
        waits = [event.sim_time for event in ride.events if event.kind == "gave-way"]
        return waits[-1] if waits else None
    last = motion.last("stop" if mishap == "stop" else "slow-down")
    return None if last is None else last.start


def _occurs(mishap: Mishap, until: float) -> Occurs:
    """Tells whether it happens in a rollout up to a time [s]."""

    def occurs(rollout: Rollout, line: Motion | None) -> bool | None:
        if mishap == "collision":
            return rollout.outcome == "collision"
        if mishap == "give-way":
            stretches = (s for s in rollout.held_up if s.how == "right-of-way")
            return any(s.since <= until for s in stretches)
        if line is None:
            return None
        part = line.until(until)
        if mishap == "hard-brake":
            return brakes(part) >= HARD
        if mishap == "stop":
            return stands(part)
        return speed_mark(part, "slow-down") is not None

    return occurs


def _ways(ride: Ride, trace: PlanTrace, occurs: Occurs) -> list[_Way] | None:
    """The alternatives of a decision; None where it is not known what was chosen leads to."""
    model, plan = ride.model(trace), planned(trace)
    try:
        here = factual(model, trace)
    except Unanswered:
        return None
    known = lines(trace)
    risk = _risk(here, occurs, known)
    if risk is None:
        return None
    found = []
    for foil, there in alternatives(model, plan[0]):
        other = _risk(there, occurs, known)
        if other is not None:
            found.append(_Way(model, here, there, foil, risk, other))
    return found


def _risk(plan: Intervention, occurs: Occurs, known: Mapping[int, Motion]) -> float | None:
    """The probability that it happens under a plan; None where too little is recorded."""
    bad = total = 0.0
    for result, weight in zip(plan.results, plan.weights, strict=True):
        there = occurs(result.rollout, known.get(result.rollout.index))
        if there is not None:
            total += weight
            bad += weight * there
    return min(bad / total, 1.0) if total >= 0.5 else None


def _sound(way: _Way) -> bool:
    """Whether an option is no worse a choice: it neither collides nor loses the way."""
    return all(
        way.there.outcomes[name] <= max(way.here.outcomes[name], 0.05)
        for name in ("collision", "dead")
    )


def _explanation(
    ride: Ride,
    mishap: Mishap,
    moment: float,
    way: _Way,
    looked: Sequence[PlanTrace],
    options: int,
    *,
    possible: bool,
) -> Explanation:
    return Explanation(
        factual=way.here.plan,
        counterfactual=way.foil,
        outcome=outcome(way.there),
        effects=to_effects(effects(way.there, way.here)),
        causes=(),
        evidence=evidence(way.model, ride, way.here, way.there),
        sim_time=way.model.trace.sim_time,
        moment=moment,
        avoidance=Avoidance(mishap, possible, way.risk, way.other, len(looked), options),
    )


def _without_options(
    ride: Ride, mishap: Mishap, moment: float, looked: Sequence[PlanTrace]
) -> Explanation:
    """There was nothing else to do."""
    trace = looked[-1]
    model = ride.model(trace)
    here = factual(model, trace)
    risk = _risk(here, _occurs(mishap, moment + LEEWAY), lines(trace)) or 0.0
    return Explanation(
        factual=here.plan,
        counterfactual=(),
        outcome=outcome(here),
        effects=(),
        causes=(),
        evidence=evidence(model, ride, here),
        sim_time=trace.sim_time,
        moment=moment,
        avoidance=Avoidance(mishap, False, risk, risk, len(looked), 0),
    )
