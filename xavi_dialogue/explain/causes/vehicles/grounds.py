"""Grounds: why we expect something of another vehicle, and how that belief grew.

The record holds the belief of every decision. The strongest sign is what the vehicle did between
the two decisions between which the odds rose most. Nothing else is stated as a sign.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Literal

from planner.record.trace import GoalPrediction, PlanTrace
from xavi_dialogue.causal.model import Actions
from xavi_dialogue.domain.answers import Grounds, NotRecorded
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.vehicles.actions import HALTS, STRAIGHT, is_macro, means
from xavi_dialogue.explain.causes.vehicles.conduct import likeliest, matching
from xavi_dialogue.explain.history.motion import Motion, foresees, steps
from xavi_dialogue.explain.history.ride import ROUNDING, Ride, Unanswered, prediction
from xavi_dialogue.explain.history.thresholds import CHANGED

EVEN = 0.5  # probability from which something is more probable than not
CERTAIN = 1e-3  # probabilities this close to 0 or 1 have the same odds
SPEAKS = 3.0  # minimum ratio by which its lights fit a goal better, to be stated
LEAST_FIT = 1e-3  # relative likelihood below which a path does not fit at all
#: Actions that predicted ways show although the planner does not choose them.
DRIVEN = frozenset[ActionName](("slow-down", "speed-up"))
ANYTHING = frozenset[ActionName](("do", "happen"))  # names that leave the action open


def grounds(
    ride: Ride, vehicle: int, names: tuple[ActionName, ...], moment: float, *, held: bool = True
) -> Grounds:
    """Find how we came to expect an action of a vehicle, or else its most likely one.

    If the vehicle did so, the decisions up to then count, else those up to a moment [s]. With
    `held`, and a belief that has faded since, those up to its highest value count.

    Raises:
        Unanswered: no decision expects anything of the vehicle, or none can expect that.
    """
    before = ride.back(moment)
    every = [trace for trace in before.traces if prediction(trace, vehicle) is not None]
    if not every:
        raise Unanswered(NotRecorded("out-of-view", thing=Vehicle(vehicle), since=moment))
    likely = _expected(before, every[-1], vehicle)
    asked = names if set(names) - ANYTHING else likely
    if len(asked) > 1:  # "that it turns": the way that it is expected to
        asked = tuple(name for name in asked if name in likely) or asked
    stays = set(asked) <= HALTS and before.motion(vehicle).trend == "standing"
    end = None if stays else _done(before, vehicle, asked)
    if end is None and not any(means(name) or name in DRIVEN for name in asked):
        raise Unanswered(NotRecorded("not-recorded", Vehicle(vehicle), about="doing"))
    known = [t for t in every if end is None or t.sim_time <= end + ROUNDING] or every[:1]
    beliefs = [_belief(before, trace, vehicle, asked, stays) for trace in known]
    if held and beliefs[-1] < EVEN <= max(beliefs):
        top = max(range(len(known)), key=lambda k: (round(beliefs[k], 6), k))
        known, beliefs = known[: top + 1], beliefs[: top + 1]
    return _grounds(before, known, beliefs, vehicle, asked, seen=end is not None)


def _expected(ride: Ride, trace: PlanTrace, vehicle: int) -> tuple[ActionName, ...]:
    known = prediction(trace, vehicle)
    if known is None:
        return ()
    best = max(range(len(known.goals)), key=lambda g: known.goals[g].probability)
    return likeliest(ride.model(trace), vehicle, best)[0][-1:] or STRAIGHT


def _done(ride: Ride, vehicle: int, names: Sequence[ActionName]) -> float | None:
    """Return when [s] a vehicle had done what is asked about; None if it has not."""
    seen = [s for name in names if (s := ride.motion(vehicle).last(name)) is not None]
    return max((s.start if s.action == "stop" else s.end for s in seen), default=None)


def _belief(
    ride: Ride, trace: PlanTrace, vehicle: int, names: tuple[ActionName, ...], stays: bool
) -> float:
    """Return the probability that a vehicle takes an action, or that it stays where it is."""
    model, known = ride.model(trace), prediction(trace, vehicle)
    if known is None:
        return 0.0
    chances = model.choices(vehicle)
    ways = (
        frozenset((g, t) for g, t in chances if "stop" in known.goals[g].trajectories[t].actions)
        if stays
        else matching(model, vehicle, names)
    )
    return min(sum(chances[way] for way in ways), 1.0)


def _grounds(
    ride: Ride,
    known: Sequence[PlanTrace],
    beliefs: Sequence[float],
    vehicle: int,
    names: tuple[ActionName, ...],
    *,
    seen: bool,
) -> Grounds:
    rises = [_odds(after) - _odds(before) for before, after in pairwise(beliefs)]
    best = max(range(len(rises)), key=lambda k: (rises[k], -k), default=None)
    grown = best is not None and rises[best] > 0.0
    first, then = (best, best + 1) if best is not None and grown else (0, 0)
    since = next((k for k in range(len(beliefs)) if min(beliefs[k:]) >= EVEN), None)
    start, end = known[first].sim_time, known[then].sim_time
    rival, fit, lit = _rival(ride, known[-1], vehicle, names)
    return Grounds(
        vehicle=vehicle,
        actions=_meant(ride, known[-1], vehicle, names),
        seen=seen,
        history=_moves(known, beliefs),
        since=None if since is None else known[since].sim_time,
        start=start,
        end=end,
        before=beliefs[first],
        after=beliefs[then],
        deed=_deed(ride.motion(vehicle), vehicle, start, end) if grown else None,
        rival=rival,
        fit=fit,
        light=_light(known[-1], vehicle) if lit >= SPEAKS else None,
    )


def _meant(
    ride: Ride, trace: PlanTrace, vehicle: int, names: tuple[ActionName, ...]
) -> tuple[ActionName, ...]:
    """Return the actions that are believed: the likeliest of those that a name may mean.

    An action that the planner does not choose, such as a change of speed, keeps its name.
    """
    if not any(means(name) for name in names[:1]):
        return names[:1]
    model, known = ride.model(trace), prediction(trace, vehicle)
    ways = matching(model, vehicle, names)
    if known is None or not ways or all(is_macro(name) for name in names[:1]):
        return to_macro(names[:1])
    chances = model.choices(vehicle)
    goal, way = max(ways, key=lambda choice: chances[choice])
    return steps(known.goals[goal], known.goals[goal].trajectories[way])


def to_macro(names: Sequence[ActionName]) -> Actions:
    """Return names as macro actions, each once."""
    found = [n if is_macro(n) else next(iter(means(n)), None) for n in names]
    kept = tuple(dict.fromkeys(name for name in found if name is not None))
    return ("exit-straight",) if kept == STRAIGHT else kept


def _moves(known: Sequence[PlanTrace], beliefs: Sequence[float]) -> tuple[tuple[float, float], ...]:
    """Return the times [s] and probabilities at which a belief changed, and the last."""
    kept: list[tuple[float, float]] = []
    for trace, belief in zip(known, beliefs, strict=True):
        if not kept or abs(belief - kept[-1][1]) >= 0.05 or trace is known[-1]:
            kept.append((trace.sim_time, belief))
    return tuple(kept)


def _odds(probability: float) -> float:
    kept = min(max(probability, CERTAIN), 1.0 - CERTAIN)
    return math.log(kept / (1.0 - kept))


def _deed(motion: Motion, vehicle: int, start: float, end: float) -> Episode | None:
    """Return what a vehicle did between two times [s]: a manoeuvre, else a change of speed."""
    actor = Vehicle(vehicle)
    inside = [s for s in motion.until(end).sightings() if s.end > start + ROUNDING]
    one, other = _speed(motion, start), _speed(motion, end)
    moves = [s for s in inside if s.action not in ("slow-down", "speed-up", "stop")]
    if moves:
        return Episode(actor, moves[-1].action, moves[-1].start, moves[-1].end)
    stop = next((s for s in inside if s.action == "stop"), None)
    if stop is not None:
        return Episode(actor, "stop", stop.start, stop.end, standing=True)
    if one is None or other is None or abs(one - other) < CHANGED / 2.0:
        return None
    action: ActionName = "slow-down" if other < one else "speed-up"
    return Episode(actor, action, start, end, speed_from=one, speed_to=other)


def _speed(motion: Motion, time: float) -> float | None:
    speeds = motion.until(time).speed
    return speeds[-1] if speeds else None


def _rival(
    ride: Ride, trace: PlanTrace, vehicle: int, names: tuple[ActionName, ...]
) -> tuple[Actions, float | None, float]:
    """Find the likeliest goal without the actions, and how much worse it fits.

    The likelihood of a goal is that of its best way: the probability of the track under rational
    driving.

    Returns:
        The actions of that goal, and the ratios by which the track and the lights fit better to
        what is believed.
    """
    known = prediction(trace, vehicle)
    if known is None:
        return (), None, 1.0
    for_it = [g for g, goal in enumerate(known.goals) if _contains(goal, names)]
    against = [g for g in range(len(known.goals)) if g not in for_it]
    if not for_it or not against:
        return (), None, 1.0
    mine = max(for_it, key=lambda g: known.goals[g].probability)
    other = max(against, key=lambda g: known.goals[g].probability)
    ways, _ = likeliest(ride.model(trace), vehicle, other)
    shown = [known.goals[g].indicators for g in (mine, other)]
    if min(shown) <= 0.0:
        return ways, None, 1.0
    one, two = (known.goals[g].likelihood / i for g, i in zip((mine, other), shown, strict=True))
    fit = one / two if one > 0.0 and two > LEAST_FIT * one else None
    return ways, fit, shown[0] / shown[1]


def _light(trace: PlanTrace, vehicle: int) -> Literal["left", "right"] | None:
    """Return the side that a vehicle indicates at a decision; None: neither, or both."""
    shown = trace.scene[vehicle].signals
    if "left" in shown:
        return None if "right" in shown else "left"
    return "right" if "right" in shown else None


def _contains(goal: GoalPrediction, names: tuple[ActionName, ...]) -> bool:
    """Check whether a vehicle with a goal may take one of some actions."""
    return any(foresees(way, name) for way in goal.trajectories for name in names)
