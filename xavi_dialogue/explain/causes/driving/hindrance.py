"""Hindrance: who holds up another vehicle, as its predicted ways show.

A predicted way records who holds the vehicle up on it. The probability that somebody does is the
sum over the goals and ways on which that happens. It is stated only of a vehicle that was seen to
brake or stand: what is predicted but not seen explains nothing. We are vehicle 0.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from planner.record.trace import HeldUp, HoldUp, PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.model import Choice
from xavi_dialogue.domain.answers import Evidence, MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.explain.causes.driving.traffic_lights import light_of_other
from xavi_dialogue.explain.causes.vehicles.involved import LIKELY, expected_actions
from xavi_dialogue.explain.history.ride import ROUNDING, Ride, planned, prediction

LEEWAY = 1.0  # [s] by which a hold-up may precede or follow the braking that it explains
SHORTEST = 0.5  # [s] of being held up that can make somebody brake
LONG = 3.0  # [s] at a standstill from which a vehicle may be parked
FRESH = 1.5  # [s] maximum age of a decision that shows what is going on now


@dataclass(frozen=True, slots=True)
class Hindrance:
    """The road users in the way of another vehicle, the longest hold-up first."""

    causes: tuple[MotionCause, ...] = ()
    traces: tuple[str, ...] = ()

    @property
    def evidence(self) -> Evidence:
        """The decisions that this rests on."""
        return Evidence("tree", 0, 0, self.traces)


@dataclass(frozen=True, slots=True)
class _Meeting:
    """One way of the vehicle on which somebody holds it up, in one decision."""

    weight: float  # probability of the way, divided by the number of decisions
    start: float  # [s] time of the decision
    choice: Choice  # the way
    stretches: tuple[HeldUp, ...]

    @property
    def duration(self) -> float:
        """The total length of all stretches [s]."""
        return sum(stretch.until - stretch.since for stretch in self.stretches)


def slowed(ride: Ride, vehicle: int, begin: float, end: float) -> Hindrance:
    """Find who made a vehicle slow down from `begin` to `end` [s].

    All decisions taken meanwhile count, each with the same weight, so that what came up last
    explains no more than its part. If several took turns, and none of them alone is probable
    enough, the most probable one is named.
    """
    known = [trace for trace in ride.traces if prediction(trace, vehicle) is not None]
    if not known:
        return Hindrance()
    nearest = min(known, key=lambda trace: abs(trace.sim_time - begin))
    meanwhile = [t for t in known if begin - ROUNDING <= t.sim_time <= end + ROUNDING]
    return _explained(ride, meanwhile or [nearest], vehicle, _within(begin, end), LIKELY)


def stood(ride: Ride, vehicle: int, begin: float, least: float = LIKELY) -> Hindrance:
    """Find who made a vehicle stand from a time [s] on, by the decision nearest to that time."""
    known = [trace for trace in ride.traces if prediction(trace, vehicle) is not None]
    nearest = min(known, key=lambda trace: abs(trace.sim_time - begin), default=None)
    if nearest is None or abs(nearest.sim_time - begin) > FRESH:
        return Hindrance()
    return _explained(ride, [nearest], vehicle, _within(begin, begin), least)


def at_present(ride: Ride, vehicle: int, time: float, least: float = LIKELY) -> Hindrance:
    """Find who makes a vehicle brake or stand at a time [s], if it is seen to then.

    Args:
        ride: the record.
        vehicle: the vehicle that brakes or stands.
        time: [s] the moment.
        least: the minimum probability that somebody is in its way.
    """
    trace = ride.at(time, vehicle)
    if trace is None or time - trace.sim_time > FRESH or prediction(trace, vehicle) is None:
        return Hindrance()
    if ride.motion(vehicle).until(time).trend not in ("slowing", "standing"):
        return Hindrance()
    return _explained(ride, [trace], vehicle, _within(trace.sim_time, time), least)


def holds_up(ride: Ride, other: int, vehicle: int, time: float, least: float) -> bool:
    """Check whether somebody may hold a vehicle up at a time [s]: nobody else in front of it does.

    Args:
        ride: the record.
        other: who may hold it up.
        vehicle: the vehicle that brakes or stands.
        time: [s] the moment.
        least: the minimum probability that somebody is in its way.
    """
    causes = at_present(ride, vehicle, time, least).causes
    ahead = [cause for cause in causes if cause.kind in ("blocked", "leader")]
    return not ahead or any(cause.vehicle == other for cause in causes)


def parked(ride: Ride, vehicle: int, standing: Episode, moment: float, now: float) -> bool:
    """Check whether a vehicle has stood since it was first seen, and shows no lights.

    Args:
        ride: the record.
        vehicle: the vehicle that stands.
        standing: its standing.
        moment: [s] the time asked about.
        now: [s] the time of the question.
    """
    first = ride.motion(vehicle).time[:1]
    since = bool(first) and standing.begin <= first[0] + ROUNDING and standing.end is None
    trace = ride.at(moment, vehicle)
    lit = trace is None or bool(trace.scene[vehicle].signals)
    return since and not lit and now - standing.begin >= LONG


def lit_too(
    ride: Ride, vehicle: int, found: Hindrance, when: tuple[float, float, float]
) -> Hindrance:
    """Put the traffic light that holds a vehicle, if one does, before who is in its way.

    Args:
        ride: the record.
        vehicle: the vehicle that slows or stands.
        found: who is in its way.
        when: [s] when it began to, when is asked about, and until when it was seen to.
    """
    begin, moment, end = when
    lit = light_of_other(ride, vehicle, max(begin, moment - FRESH), end)
    return found if lit is None else Hindrance((lit, *found.causes), found.traces)


def _within(start: float, end: float) -> Callable[[HeldUp], bool]:
    """Return a check whether a stretch overlaps two times [s], with some leeway on both sides."""
    low, high = start - LEEWAY, end + LEEWAY
    return lambda stretch: stretch.since <= high and stretch.until >= low


def _explained(
    ride: Ride,
    traces: Sequence[PlanTrace],
    vehicle: int,
    relevant: Callable[[HeldUp], bool],
    least: float,
) -> Hindrance:
    met = _meetings(ride, traces, vehicle, relevant)
    named = [other for other in sorted(met) if _share(met[other]) >= least]
    if not named and _share([one for ones in met.values() for one in ones]) >= least:
        named = [max(sorted(met), key=lambda other: _share(met[other]))]
    named.sort(key=lambda other: -sum(one.weight * one.duration for one in met[other]))
    return Hindrance(
        tuple(_cause(ride, traces[-1], other, met[other]) for other in named),
        tuple(dict.fromkeys(trace.trace_id for trace in traces)),
    )


def _meetings(
    ride: Ride,
    traces: Sequence[PlanTrace],
    vehicle: int,
    relevant: Callable[[HeldUp], bool],
) -> dict[int, list[_Meeting]]:
    met: dict[int, list[_Meeting]] = {}
    for trace in traces:
        chances = ride.model(trace).choices(vehicle)
        mass = sum(chances.values()) * len(traces)
        for choice, chance in chances.items():
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
    """Return who holds a vehicle up on one of its ways, and when."""
    known = prediction(trace, vehicle)
    if known is None:
        return {}
    held = known.goals[choice[0]].trajectories[choice[1]].held_up
    others = sorted({stretch.vehicle for stretch in held if relevant(stretch)})
    return {other: tuple(s for s in held if s.vehicle == other and relevant(s)) for other in others}


def _cause(ride: Ride, trace: PlanTrace, other: int, met: Sequence[_Meeting]) -> MotionCause:
    share, how = _share(met), _kind(met)
    if other == EGO:
        return MotionCause(how, EGO, planned(trace), share)
    model = ride.model(trace)
    if other not in model.vehicles:
        return MotionCause(how, other, (), share)
    chances = model.choices(other)
    actions, _ = expected_actions(model, other, max(chances, key=lambda c: chances[c]))
    return MotionCause(how, other, actions, share)


def _share(met: Iterable[_Meeting]) -> float:
    """Return the probability of the ways that meetings are on, each counted once."""
    ways = {(one.start, one.choice): one.weight for one in met}
    return min(sum(ways.values()), 1.0)


def _kind(met: Iterable[_Meeting]) -> HoldUp:
    """Return the kind of hold-up that lasts longest, in the mean."""
    lasted: dict[HoldUp, float] = {}
    for one in met:
        for s in one.stretches:
            lasted[s.how] = lasted.get(s.how, 0.0) + one.weight * (s.until - s.since)
    return max(lasted, key=lambda kind: lasted[kind])
