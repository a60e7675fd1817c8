"""How we came to expect something of another vehicle: how the belief grew, and what spoke for it.

The record holds the belief of every decision. What told most is what the vehicle did between the
two decisions between which the odds rose most; nothing else is claimed to be a sign.
"""

import math
from collections.abc import Sequence
from itertools import pairwise

from msgspec.structs import replace

from planner.trace import GoalPrediction, PlanTrace
from xavi_dialogue.explain.deeds import HALTS
from xavi_dialogue.explain.details import Grounds
from xavi_dialogue.explain.expectation import last_seen, likeliest
from xavi_dialogue.explain.explanation import Activity, Evidence, Explanation
from xavi_dialogue.explain.motion import CHANGED, Motion, foresees
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import ROUNDING, Ride, prediction
from xavi_dialogue.explain.vehicles import actor_of, halted, last_with, matching

EVEN = 0.5  # probability from which something is more probable than not
CERTAIN = 1e-3  # of probability, within which odds are not told apart
LEAST_FIT = 1e-3  # relative likelihood below which a path does not fit at all


def how(query: Query, ride: Ride) -> Explanation:
    """How we came to know what a vehicle would do, or what it is most likely to do.

    Where it did so, the decisions up to then count; else all of them, or those up to the moment
    that the question is about.

    Raises:
        Unanswered: the vehicle is unknown, or no decision expects anything of it.
    """
    if ride.past is not None and ride.past.instant:
        return how(query, ride.back(ride.past.moment))
    vehicle = actor_of(query, ride)
    latest = last_with(ride, vehicle)
    asked = query.factual or query.counterfactual or ()
    actions: tuple[QueryAction, ...] = asked or _expected(ride, latest, vehicle)
    stays = query.tense != "past" and set(actions) <= HALTS and halted(ride, vehicle)
    end = None if stays else _done(ride, vehicle, actions)
    known = _before(ride, vehicle, end)
    beliefs = [_belief(ride, trace, vehicle, actions, stays) for trace in known]
    last = beliefs[-1]
    if last < EVEN <= max(beliefs):
        top = max(range(len(known)), key=lambda k: (round(beliefs[k], 6), k))
        known, beliefs = known[: top + 1], beliefs[: top + 1]
    trace, motion = known[-1], ride.motion(vehicle)
    return Explanation(
        factual=(),
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=Evidence("tree", 0, 0, (trace.trace_id,)),
        activity=Activity(vehicle, actions, beliefs[-1], None, motion.until(trace.sim_time).trend),
        sim_time=trace.sim_time,
        seen=last_seen(ride, vehicle),
        grounds=replace(
            _grounds(ride, known, beliefs, vehicle, actions), done=end is not None, latest=last
        ),
    )


def _expected(ride: Ride, trace: PlanTrace, vehicle: int) -> tuple[QueryAction, ...]:
    known = prediction(trace, vehicle)
    assert known is not None
    best = max(range(len(known.goals)), key=lambda g: known.goals[g].probability)
    return likeliest(ride.model(trace), vehicle, best)[0]


def _done(ride: Ride, vehicle: int, actions: tuple[QueryAction, ...]) -> float | None:
    """When [s] a vehicle had done all that is asked about; None if it has not."""
    seen = [ride.motion(vehicle).last(action) for action in actions]
    if not seen or not all(seen):
        return None
    return max(s.start if s.action == "stop" else s.end for s in seen if s)


def _before(ride: Ride, vehicle: int, end: float | None) -> list[PlanTrace]:
    """The decisions that expect something of a vehicle, up to when it did what is asked about."""
    known = [trace for trace in ride.traces if prediction(trace, vehicle) is not None]
    if end is None:
        return known
    return [trace for trace in known if trace.sim_time <= end + ROUNDING] or known[:1]


def _belief(
    ride: Ride, trace: PlanTrace, vehicle: int, actions: tuple[QueryAction, ...], stays: bool
) -> float:
    """How probable it is that a vehicle does so, or that it stays where it is."""
    model, known = ride.model(trace), prediction(trace, vehicle)
    assert known is not None
    chances = model.choices(vehicle)
    ways = (
        frozenset((g, t) for g, t in chances if "stop" in known.goals[g].trajectories[t].actions)
        if stays
        else matching(model, vehicle, actions)
    )
    return min(sum(chances[way] for way in ways), 1.0)


def _grounds(
    ride: Ride,
    known: Sequence[PlanTrace],
    beliefs: Sequence[float],
    vehicle: int,
    actions: tuple[QueryAction, ...],
) -> Grounds:
    rises = [_odds(after) - _odds(before) for before, after in pairwise(beliefs)]
    best = max(range(len(rises)), key=lambda k: (rises[k], -k), default=None)
    grown = best is not None and rises[best] > 0.0
    first, then = (best, best + 1) if best is not None and grown else (0, 0)
    since = next((k for k in range(len(beliefs)) if min(beliefs[k:]) >= EVEN), None)
    start, end = known[first].sim_time, known[then].sim_time
    motion = ride.motion(vehicle)
    speed_from, speed_to = _speed(motion, start), _speed(motion, end)
    rival, fit = _rival(ride, known[-1], vehicle, actions)
    return Grounds(
        vehicle=vehicle,
        actions=actions,
        done=False,
        probability=beliefs[-1],
        latest=beliefs[-1],
        since=None if since is None else known[since].sim_time,
        start=start,
        end=end,
        before=beliefs[first],
        after=beliefs[then],
        deed=_deed(motion, start, end) if grown else None,
        speed_from=speed_from,
        speed_to=speed_to,
        rival=rival,
        fit=fit,
    )


def _odds(probability: float) -> float:
    kept = min(max(probability, CERTAIN), 1.0 - CERTAIN)
    return math.log(kept / (1.0 - kept))


def _speed(motion: Motion, time: float) -> float | None:
    speeds = motion.until(time).speed
    return speeds[-1] if speeds else None


def _deed(motion: Motion, start: float, end: float) -> QueryAction | None:
    """What a vehicle was seen to do between two times: a move sideways, else a change of speed."""
    inside = [s for s in motion.until(end).sightings() if s.end > start + ROUNDING]
    moves = [s.action for s in inside if s.action not in ("slow-down", "speed-up", "stop")]
    if moves:
        return moves[-1]
    one, other = _speed(motion, start), _speed(motion, end)
    if any(s.action == "stop" for s in inside):
        return "stop"
    if one is None or other is None or abs(one - other) < CHANGED / 2.0:
        return None
    return "slow-down" if other < one else "speed-up"


def _rival(
    ride: Ride, trace: PlanTrace, vehicle: int, actions: tuple[QueryAction, ...]
) -> tuple[tuple[QueryAction, ...], float | None]:
    """The likeliest goal under which a vehicle does not do that, and how much worse it fits.

    Likelihoods are of the goal's best way: the probability of the track under rational driving.
    """
    known = prediction(trace, vehicle)
    assert known is not None
    for_it = [g for g, goal in enumerate(known.goals) if _contains(goal, actions)]
    against = [g for g in range(len(known.goals)) if g not in for_it]
    if not for_it or not against:
        return (), None
    mine = max(for_it, key=lambda g: known.goals[g].probability)
    other = max(against, key=lambda g: known.goals[g].probability)
    ways, _ = likeliest(ride.model(trace), vehicle, other)
    one, two = known.goals[mine].likelihood, known.goals[other].likelihood
    fit = one / two if one > 0.0 and two > LEAST_FIT * one else None
    return ways, fit


def _contains(goal: GoalPrediction, actions: tuple[QueryAction, ...]) -> bool:
    """Whether a vehicle with that goal may do all these."""
    return any(all(foresees(way, a) for a in actions) for way in goal.trajectories)
