"""Whom another vehicle gives way to, or has in its way: read off the ways predicted of it.

A predicted way carries who holds the vehicle up on it. How probable it is that somebody does is
the sum over the goals and ways on which that happens. It is claimed only of a vehicle that was
seen to brake or stand: what is foreseen and not seen explains nothing.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from msgspec.structs import replace

from planner.trace import HeldUp, HoldUp, PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.model import Choice
from xavi_dialogue.explain.causes import AT_ONCE, LIKELY, expected_actions
from xavi_dialogue.explain.explanation import Cause, Explanation, Mechanism
from xavi_dialogue.explain.motion import Sighting
from xavi_dialogue.explain.query import QueryAction
from xavi_dialogue.explain.ride import ROUNDING, Ride, planned, prediction

BRAKING: tuple[QueryAction, ...] = ("slow-down", "stop", "give-way")
LEEWAY = 1.0  # [s] by which a hold-up may lie beside the braking that it explains
SHORTEST = 0.5  # [s] of being held up that can make somebody brake
FRESH = 1.5  # [s] how old a decision may be that tells what is going on now


@dataclass(frozen=True, slots=True)
class _Meeting:
    """One way of the vehicle on which somebody holds it up, in one decision."""

    weight: float  # probability of the way, over the number of decisions
    start: float  # [s] of the decision
    choice: Choice  # the way
    stretches: tuple[HeldUp, ...]

    @property
    def duration(self) -> float:
        """[s] over all stretches."""
        return sum(stretch.until - stretch.since for stretch in self.stretches)


def behind(found: Explanation, ride: Ride, vehicle: int, seen: Sighting) -> Explanation:
    """With those who made a vehicle brake or stand as it was seen to, longest in its way first.

    Of a standstill, the decision nearest to its beginning tells; of slowing down, all that were
    taken meanwhile, each with the same weight, so that what came up last explains no more than
    its part. Where several took turns, of whom none is probable alone, it is the most probable.

    Args:
        found: what is explained beside.
        ride: the record.
        vehicle: that braked.
        seen: its slowing down or standstill.
    """
    known = [trace for trace in ride.traces if prediction(trace, vehicle) is not None]
    if not known or seen.action not in BRAKING:
        return found
    nearest = min(known, key=lambda trace: abs(trace.sim_time - seen.start))
    if seen.action == "slow-down":
        meanwhile = [t for t in known if seen.start - ROUNDING <= t.sim_time <= seen.end + ROUNDING]
        window = _within(seen.start, seen.end)
        return _explained(found, ride, meanwhile or [nearest], vehicle, window)
    if abs(nearest.sim_time - seen.start) > FRESH:
        return found
    return _explained(found, ride, [nearest], vehicle, _within(seen.start, seen.start))


def at_present(found: Explanation, ride: Ride, vehicle: int, least: float = LIKELY) -> Explanation:
    """With those who make a vehicle brake or stand, if it is now seen to.

    Args:
        found: what is explained beside.
        ride: the record.
        vehicle: that brakes or stands.
        least: how probable it must be that somebody is in its way.
    """
    trace = ride.traces[-1] if ride.traces else None
    if trace is None or ride.now - trace.sim_time > FRESH or prediction(trace, vehicle) is None:
        return found
    if ride.motion(vehicle).trend not in ("slowing", "standing"):
        return found
    window = _within(trace.sim_time, ride.now)
    return _explained(found, ride, [trace], vehicle, window, least=least)


def foreseen(
    found: Explanation, ride: Ride, trace: PlanTrace, vehicle: int, given: frozenset[Choice]
) -> Explanation:
    """With those who will hold a vehicle up on the ways on which it does what is asked about."""
    return _explained(found, ride, [trace], vehicle, _within(trace.sim_time, math.inf), given)


def _within(start: float, end: float) -> Callable[[HeldUp], bool]:
    """Whether a stretch lies between two times [s], at least in part."""
    low, high = start - LEEWAY, end + LEEWAY
    return lambda stretch: stretch.since <= high and stretch.until >= low


def _explained(
    found: Explanation,
    ride: Ride,
    traces: Sequence[PlanTrace],
    vehicle: int,
    relevant: Callable[[HeldUp], bool],
    given: frozenset[Choice] | None = None,
    least: float = LIKELY,
) -> Explanation:
    met = _meetings(ride, traces, vehicle, relevant, given)
    named = [other for other in sorted(met) if _share(met[other]) >= least]
    if not named and _share([one for ones in met.values() for one in ones]) >= least:
        named = [max(sorted(met), key=lambda other: _share(met[other]))]
    if not named:
        return found
    named.sort(key=lambda other: -sum(one.weight * one.duration for one in met[other]))
    rests_on = (*found.evidence.traces, *(trace.trace_id for trace in traces))
    return replace(
        found,
        causes=tuple(_cause(ride, traces[-1], other, met[other]) for other in named),
        evidence=replace(found.evidence, traces=tuple(dict.fromkeys(rests_on))),
    )


def _meetings(
    ride: Ride,
    traces: Sequence[PlanTrace],
    vehicle: int,
    relevant: Callable[[HeldUp], bool],
    given: frozenset[Choice] | None,
) -> dict[int, list[_Meeting]]:
    met: dict[int, list[_Meeting]] = {}
    for trace in traces:
        chances = ride.model(trace).choices(vehicle)
        chosen = {c: p for c, p in chances.items() if given is None or c in given}
        mass = sum(chosen.values()) * len(traces)
        for choice, chance in chosen.items():
            if chance <= 0.0:
                continue
            for other, stretches in _stretches(trace, vehicle, choice, relevant).items():
                one = _Meeting(chance / mass, trace.sim_time, choice, stretches)
                if one.duration >= SHORTEST - ROUNDING:
                    met.setdefault(other, []).append(one)
    return met


def _stretches(
    trace: PlanTrace, vehicle: int, choice: Choice, relevant: Callable[[HeldUp], bool]
) -> dict[int, tuple[HeldUp, ...]]:
    """Who holds a vehicle up on one of its ways, and when."""
    known = prediction(trace, vehicle)
    if known is None:
        return {}
    held = known.goals[choice[0]].trajectories[choice[1]].held_up
    others = sorted({stretch.vehicle for stretch in held if relevant(stretch)})
    return {other: tuple(s for s in held if s.vehicle == other and relevant(s)) for other in others}


def _cause(ride: Ride, trace: PlanTrace, other: int, met: Sequence[_Meeting]) -> Cause:
    share = _share(met)
    how = _kind(met)
    alike = [s for one in met for s in one.stretches if s.how == how]
    first = min(alike, key=lambda s: s.since)
    delay = sum(one.weight * one.duration for one in met) / share
    present = any(min(s.since for s in one.stretches) <= one.start + AT_ONCE for one in met)
    lowest = min(s.speed_to for s in alike)
    mechanism = Mechanism(how, first.speed_from, lowest, delay, share, present)
    if other == EGO:
        return Cause(other, planned(trace), 1.0, mechanism, None, None)
    chances = ride.model(trace).choices(other) if prediction(trace, other) is not None else {}
    likeliest = max(chances, key=lambda choice: chances[choice], default=None)
    model = ride.model(trace)
    actions, chance = expected_actions(model, other, likeliest) if likeliest else ((), share)
    return Cause(other, actions, chance, mechanism, None, None)


def _share(met: Iterable[_Meeting]) -> float:
    """The probability of all ways met with, each counted once."""
    ways = {(one.start, one.choice): one.weight for one in met}
    return min(sum(ways.values()), 1.0)


def _kind(met: Iterable[_Meeting]) -> HoldUp:
    """The way of holding up that lasts longest, in the mean."""
    lasted: dict[HoldUp, float] = {}
    for one in met:
        for s in one.stretches:
            lasted[s.how] = lasted.get(s.how, 0.0) + one.weight * (s.until - s.since)
    return max(lasted, key=lambda kind: lasted[kind])
