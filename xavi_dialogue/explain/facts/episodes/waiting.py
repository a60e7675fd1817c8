"""Episodes of waiting: for whom a vehicle stands, and to whom the ego gave way.

The ego waits for those who hold it up, from the moment of a decision on, in its rollouts. Another
vehicle waits for those who do so on its predicted ways; this is never sure.
"""

import math
from collections.abc import Iterable, Iterator

from msgspec.structs import replace

from planner.record.trace import HoldUp, PlanTrace
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego
from xavi_dialogue.explain.facts.actions import named
from xavi_dialogue.explain.facts.episodes.light_waits import held_then, waits_at_lights
from xavi_dialogue.explain.facts.episodes.meetings import crossings
from xavi_dialogue.explain.facts.episodes.speeds import speeds
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.kept import of_decision
from xavi_dialogue.explain.history.restraints import slowed_for
from xavi_dialogue.explain.history.ride import prediction
from xavi_dialogue.explain.history.thresholds import AT_ONCE, FOLLOWING_GAP, HELD_UP, YIELDING

Holder = tuple[int, HoldUp]
STARTING = 4.0  # [s] after the other is past, in which a vehicle that waited for it moves off
UNSETTLED = 4.0  # [s] after we slowed for another in which it may still go before us
BEFORE = 1.0  # [s] before we slowed, from which on its crossing counts
AFTER = 10.0  # [s] after we slowed, up to which it does
AWAY = 6.0  # [m] minimum distance behind the other's back from which it is past


def waits(states: States, vehicle: int) -> list[Episode]:
    """Return when a vehicle stood for somebody, or gave way, and to whom."""
    return states.memo(("waits", vehicle), lambda: _waits(states, vehicle))


def _waits(states: States, vehicle: int) -> list[Episode]:
    stood = [e for e in speeds(states, vehicle) if e.action in ("stop", "stand")]
    if vehicle != EGO:
        found = [wait for still in stood for wait in _stood_for(states, vehicle, still)] + [
            wait for still in stood for wait in _let_us_go(states, vehicle, still)
        ]
        ended = (_until_past(states, vehicle, wait) for wait in found)
        lit = list(waits_at_lights(states.ride, vehicle, stood))
        lightless = (_apart_from(states, lit, wait) for wait in ended if wait is not None)
        return [*(wait for wait in lightless if wait is not None), *lit]
    given = _merged((*_gave_way(states, stood), *_slowed_for(states)))
    lit = list(waits_at_lights(states.ride, EGO, stood))
    given += lit
    apart = [rest for still in stood for rest in _after_lights(states, still, lit)]
    waited = [wait for still in apart for wait in _stood_for(states, EGO, still)]
    told = [
        wait
        for wait in waited
        if not any(g.object == wait.object and _meet(g, wait) for g in given)
    ]
    return given + told


def _apart_from(states: States, lit: list[Episode], wait: Episode) -> Episode | None:
    """Return the part of a vehicle's wait in which no light holds it; None if there is none.

    Who waits in a row at a light, behind somebody, waits for both.
    """
    met = [one for one in lit if _meet(one, wait)]
    if not met or (wait.object != Ego() and wait.how != "right-of-way"):
        return wait
    if wait.object == Ego():
        return None
    since = min(one.begin for one in met)
    if since - wait.begin > STARTING:
        return replace(wait, end=since)
    begin = max(_end(states, one) for one in met)
    return replace(wait, begin=begin) if _end(states, wait) - begin > STARTING else None


def _until_past(states: States, vehicle: int, wait: Episode) -> Episode | None:
    """End a wait that goes on at the time at which the other vehicle was past.

    None if the other was past before, or the vehicle still stands long after: it stood for
    something else.
    """
    other = EGO if isinstance(wait.object, Ego) else getattr(wait.object, "number", None)
    end = _end(states, wait)
    if other is None or not _past(states, vehicle, other, end):
        return wait
    times = (t.sim_time for t in reversed(states.ride.traces) if wait.begin < t.sim_time <= end)
    before = (time for time in times if not _past(states, vehicle, other, time))
    until = next(before, wait.begin)
    if until <= wait.begin or end - until > STARTING:
        return None
    return wait if wait.end is not None else replace(wait, end=until)


def _past(states: States, vehicle: int, other: int, time: float) -> bool:
    """Check whether another is behind a vehicle, or ahead with its back to it and some way off."""
    ours, theirs = states.offset(vehicle, other, time), states.offset(other, vehicle, time)
    if ours is None or theirs is None:
        return False
    return ours.ahead < 0.0 or theirs.ahead < -ours.clear - AWAY


def _merged(given: Iterable[Episode]) -> list[Episode]:
    """Return episodes without those that overlap another with the same object."""
    found: list[Episode] = []
    for one in given:
        if not any(one.object == other.object and _meet(one, other) for other in found):
            found.append(one)
    return found


def _meet(one: Episode, other: Episode) -> bool:
    first, last = sorted((one, other), key=lambda e: e.begin)
    return first.end is None or last.begin <= first.end


def _gave_way(states: States, stood: list[Episode]) -> Iterator[Episode]:
    """Yield when the ego gave way, by its events, from slowing down to driving on."""
    slowed = [e for e in speeds(states, EGO) if e.action in ("slow-down", "brake")]
    lit = list(waits_at_lights(states.ride, EGO, stood))
    for event in states.ride.events:
        if event.kind != "gave-way" or event.vehicle is None:
            continue
        time = event.sim_time
        if held_then(states.ride, time):
            continue  # the light holds us, though others go
        slowing = [e for e in slowed if e.begin <= time and _end(states, e) >= time - 1.0]
        still = [e for e in stood if e.begin <= time + YIELDING and _end(states, e) >= time]
        still = [e for e in still if not any(time < s.begin < e.begin for s in slowed)]
        still = [e for s in still for e in _not_for_a_light(states, s, lit, time)]
        parts = [*slowing[-1:], *still[:1]]
        ends = [part.end for part in parts]
        first = slowing[-1] if slowing else None
        yield Episode(
            named(EGO),
            "give-way",
            min((part.begin for part in parts), default=time),
            None if None in ends else max((e for e in ends if e is not None), default=time),
            named(event.vehicle),
            speed_from=None if first is None else first.speed_from,
            speed_to=0.0 if still else None if first is None else first.speed_to,
            peak=None if first is None else first.peak,
            how="right-of-way",
            standing=bool(still) or (first is not None and first.standing),
        )


def _slowed_for(states: States) -> Iterator[Episode]:
    """Yield our slowing down for those who had to go first, by what our driving recorded.

    It tells of a giving way only where we came to walking pace.
    """
    for slowing in speeds(states, EGO):
        end = _end(states, slowing)
        if slowing.action not in ("slow-down", "brake"):
            continue
        for vehicle, one in slowed_for(states.ride, slowing.begin, end).items():
            if one.by != "right-of-way" or one.light is not None:  # else the light holds us
                continue
            if went_before(states, vehicle, slowing.begin, end):
                yield replace(slowing, action="give-way", object=named(vehicle), how="right-of-way")


def went_before(states: States, vehicle: int, begin: float, end: float) -> bool:
    """Check whether somebody for whom we slowed went first, or may still do so.

    Who has not crossed our way, and is behind us after it, went after us.
    """
    if states.ride.now - end < UNSETTLED:
        return True
    if any(begin - BEFORE <= e.begin <= end + AFTER for e in crossings(states, vehicle)):
        return True
    after = states.offset(EGO, vehicle, min(end + AFTER, states.ride.now))
    return after is None or after.ahead >= 0.0


def _not_for_a_light(
    states: States, still: Episode, lit: list[Episode], time: float
) -> Iterator[Episode]:
    """Yield the part of a standstill after the lights that held us; none if one did so later.

    Args:
        states: the states of the ride.
        still: the standstill.
        lit: our waits at lights.
        time: [s] when we gave way.
    """
    held = [_end(states, wait) for wait in lit if _meet(wait, still)]
    if not any(end > time for end in held):
        yield replace(still, begin=max([still.begin, *held]))


def _after_lights(states: States, still: Episode, lit: list[Episode]) -> Iterator[Episode]:
    """Yield the part of a standstill after the lights that held us in it, if it is long."""
    met = [wait for wait in lit if _meet(wait, still)]
    if not met:
        yield still
        return
    begin = max(_end(states, wait) for wait in met)
    if _end(states, still) - begin > STARTING:
        yield replace(still, begin=begin)


def _end(states: States, episode: Episode) -> float:
    return states.ride.now if episode.end is None else episode.end


def _stood_for(states: States, vehicle: int, still: Episode) -> Iterator[Episode]:
    """Yield the parts of a standstill, each with the vehicle that it was for."""
    end = _end(states, still)
    runs: list[tuple[Holder, float]] = []
    for trace in states.ride.traces:
        if still.begin - 1.0 <= trace.sim_time <= end:
            for holder in top_holders(states, trace, vehicle)[:1]:
                if not runs or runs[-1][0][0] != holder[0]:
                    runs.append((holder, max(trace.sim_time, still.begin)))
    if not runs and (ahead := _leader(states, vehicle, still.begin)) is not None:
        runs = [((ahead, "leader"), still.begin)]
    for k, ((who, how), since) in enumerate(runs):
        begin = still.begin if k == 0 else since
        until = runs[k + 1][1] if k + 1 < len(runs) else still.end
        yields = how == "right-of-way" and vehicle != EGO
        yield Episode(
            named(vehicle),
            "give-way" if yields else "wait",
            begin,
            until,
            named(who),
            speed_to=0.0,
            how=how,
            standing=True,
            sure=vehicle == EGO,
        )


def _let_us_go(states: States, vehicle: int, still: Episode) -> Iterator[Episode]:
    """Yield the last part of a standstill in which the ego has right of way.

    Nothing, if predictions show already that the vehicle waits for us.
    """
    end = _end(states, still)
    traces = [t for t in states.ride.traces if still.begin <= t.sim_time <= end]
    if any(who == EGO for t in traces for who, _ in top_holders(states, t, vehicle)[:1]):
        return
    first = None
    for trace in reversed(traces):
        facts = () if trace.road is None else trace.road.priority
        if not any(fact.vehicle == vehicle and fact.who == "ego" for fact in facts):
            break
        first = trace.sim_time
    if first is not None:
        yield Episode(
            named(vehicle),
            "give-way",
            max(first, still.begin),
            still.end,
            named(EGO),
            speed_to=0.0,
            how="right-of-way",
            standing=True,
            sure=False,
        )


def top_holders(states: States, trace: PlanTrace, vehicle: int) -> tuple[Holder, ...]:
    """Return who holds a vehicle up at a decision in most of its rollouts, most often first."""
    shares = of_decision(trace, ("holders", vehicle), lambda: _holders(trace, vehicle))
    found = sorted(shares.items(), key=lambda item: (-item[1], item[0]))
    return tuple(holder for holder, share in found if share >= HELD_UP)


def _holders(trace: PlanTrace, vehicle: int) -> dict[Holder, float]:
    return _of_ego(trace) if vehicle == EGO else _of_other(trace, vehicle)


def let_first(trace: PlanTrace, vehicle: int) -> float:
    """Return the share of the chosen rollouts in which we let a road user go first at any time."""
    shares = of_decision(trace, ("let first",), lambda: _of_ego(trace, math.inf))
    return shares.get((vehicle, "right-of-way"), 0.0)


def _of_ego(trace: PlanTrace, within: float = AT_ONCE) -> dict[Holder, float]:
    """Return who holds us up within some time [s] of a decision, with the share of rollouts."""
    chosen = trace.plan[0].action if trace.plan else None
    drives = [r for r in trace.rollouts if r.actions and r.actions[0].action == chosen]
    weighed = any(drive.weight is not None for drive in drives)
    total = sum(drive.weight or 0.0 for drive in drives) if weighed else float(len(drives))
    found: dict[Holder, float] = {}
    for drive in drives:
        weight = (drive.weight or 0.0) if weighed else 1.0
        held = {(s.vehicle, s.how) for s in drive.held_up if s.since <= trace.sim_time + within}
        for holder in held:
            found[holder] = found.get(holder, 0.0) + weight / total
    return found


def _of_other(trace: PlanTrace, vehicle: int) -> dict[Holder, float]:
    known = prediction(trace, vehicle)
    found: dict[Holder, float] = {}
    for goal in () if known is None else known.goals:
        for way in goal.trajectories:
            chance = goal.probability * way.probability
            for holder in {
                (s.vehicle, s.how) for s in way.held_up if s.since <= trace.sim_time + AT_ONCE
            }:
                found[holder] = found.get(holder, 0.0) + chance
    return found


def _leader(states: States, vehicle: int, time: float) -> int | None:
    """Return who stands right ahead of a vehicle at a time [s]."""
    found: list[tuple[float, int]] = []
    for other in (EGO, *states.ride.vehicles):
        if other == vehicle:
            continue
        seen = states.offset(vehicle, other, time)
        if seen is None or not seen.same_way or abs(seen.left) > 1.5 or seen.ahead <= 0.0:
            continue
        gap = seen.ahead - seen.clear
        if gap <= FOLLOWING_GAP:
            found.append((gap, other))
    return min(found)[1] if found else None
