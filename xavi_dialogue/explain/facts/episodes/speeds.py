"""Episodes of speed: slowing down, braking, speeding up, stopping, standing, setting off."""

from collections.abc import Iterator

from planner.record.trace import SAMPLE_PERIOD, Action, Rollout
from sim.scene import EGO, VehicleState
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.facts.actions import named
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.motion import EPSILON, Motion, Sighting
from xavi_dialogue.explain.history.ride import ROUNDING
from xavi_dialogue.explain.history.thresholds import BEGINNING, BRAKING, MOVING, STANDING

FRESH = 1.5  # [s] maximum age of a decision whose plan shows what is going on now
SOON = 0.5  # [s] after now in which what begins counts as begun
RATE = 0.2  # [m/s2] minimum rate at which a speed counts as changing
GROWS = 0.2  # [m/s] minimum gain within five samples of a speed that grows


def speeds(states: States, vehicle: int) -> list[Episode]:
    """Return what a vehicle did with its speed."""
    return states.memo(("speeds", vehicle), lambda: _speeds(states, vehicle))


def _speeds(states: States, vehicle: int) -> list[Episode]:
    found: list[Episode] = []
    motion = states.motion(vehicle)
    for sighting in motion.sightings():
        if sighting.action in ("slow-down", "speed-up"):
            found.append(_changed(states, vehicle, motion, sighting))
    found += _standstills(states, vehicle, motion)
    if vehicle == EGO and not any(e.end is None and e.action != "speed-up" for e in found):
        found += list(underway(states)) or _lit(states)
    return found


def _lit(states: States) -> Iterator[Episode]:
    """Yield braking of the ego that its brake light shows, but its speed hardly shows yet."""
    seen = _seen_now(states, EGO)
    if seen is None or states.ride.ended or "brake" not in seen.signals:
        return
    if seen.speed > MOVING and seen.acceleration < RATE:
        speed = seen.speed
        yield Episode(named(EGO), "brake", states.ride.now, speed_from=speed, speed_to=speed)


def _seen_now(states: States, vehicle: int) -> VehicleState | None:
    """Return how a vehicle is seen now: in the newest scene, or at a decision that is taken now."""
    ride = states.ride
    if ride.scene is not None:
        return ride.scene.vehicles.get(vehicle)
    latest = ride.traces[-1] if ride.traces else None
    fresh = latest is not None and ride.now - latest.sim_time <= ROUNDING
    return latest.scene.get(vehicle) if latest is not None and fresh else None


def underway(states: States) -> Iterator[Episode]:
    """Yield slowing down of the ego that its plan has from now on, and the record not yet."""
    ride = states.ride
    trace = ride.traces[-1] if ride.traces else None
    if trace is None or ride.ended or ride.now - trace.sim_time > FRESH:
        return
    if _rate_now(states, EGO) > RATE:
        return
    plan = tuple(step.action for step in trace.plan)
    driven = (r for r in trace.rollouts if r.speed and _drives(r, plan[:1]))
    speed = next((r.speed for r in driven if r.speed), ())
    ahead = speed[: round((ride.now + SOON - trace.sim_time) / SAMPLE_PERIOD) + 1]
    if len(ahead) < 2 or ahead[0] - ahead[-1] < BEGINNING:
        return
    first = next(k for k in range(len(ahead) - 1) if ahead[k + 1] < ahead[k])
    begin = trace.sim_time + first * SAMPLE_PERIOD
    peak = (ahead[first] - ahead[-1]) / max(ride.now + SOON - begin, SOON)
    action: ActionName = "brake" if peak >= BRAKING else "slow-down"
    yield Episode(
        named(EGO),
        action,
        begin,
        speed_from=ahead[first],
        speed_to=ahead[-1],
        peak=round(peak, 2),
    )


def _drives(rollout: Rollout, plan: tuple[Action, ...]) -> bool:
    return tuple(timed.action for timed in rollout.actions)[: len(plan)] == plan


def _changed(states: States, vehicle: int, motion: Motion, sighting: Sighting) -> Episode:
    inside = motion.within(sighting.start, sighting.end)
    first, last = inside[0], inside[-1]
    peak = max(-motion.rate[k] for k in inside)
    slower = sighting.action == "slow-down"
    going_on = _open(states, vehicle, sighting.end) and _continues(
        states, vehicle, motion, slower=slower
    )
    stands = slower and motion.speed[last] < STANDING
    halt = next(k for k in inside if motion.speed[k] < STANDING) if stands else last
    return Episode(
        named(vehicle),
        "brake" if slower and peak >= BRAKING else sighting.action,
        sighting.start,
        None if going_on else motion.time[halt],
        speed_from=motion.speed[first],
        speed_to=motion.speed[last],
        peak=round(peak, 2) if slower else None,
        standing=stands,
    )


def _continues(states: States, vehicle: int, motion: Motion, *, slower: bool) -> bool:
    """Check whether the speed still changes at the end of the record."""
    if motion.speed[-1] < STANDING:
        return False
    rate, now = motion.rate[-1], _rate_now(states, vehicle)
    return max(rate, now) <= -RATE if slower else min(rate, now) >= RATE


def _rate_now(states: States, vehicle: int) -> float:
    """Return the acceleration [m/s2] now: of the newest scene, else between two samples."""
    scene, motion = states.ride.scene, states.motion(vehicle)
    seen = None if scene is None else scene.vehicles.get(vehicle)
    if seen is not None:
        return seen.acceleration
    apart = motion.time[-1] - motion.time[-2] if len(motion.time) > 1 else 0.0
    return (motion.speed[-1] - motion.speed[-2]) / apart if apart > EPSILON else 0.0


def _open(states: States, vehicle: int, end: float) -> bool:
    """Check whether what was seen up to a time [s] may go on, as that is the end of the record."""
    motion = states.motion(vehicle)
    over = states.ride.ended or not motion.time or end < motion.time[-1] - EPSILON
    return not over and states.known(vehicle, states.ride.now)


def _standstills(states: States, vehicle: int, motion: Motion) -> Iterator[Episode]:
    """Yield standstills, and the setting off after each; short rolls are part of a standstill."""
    for begin, end, from_first in _still(motion):
        first = motion.index(begin)
        assert first is not None
        yield Episode(
            named(vehicle),
            "stand" if from_first else "stop",
            begin,
            None
            if end is None and _open(states, vehicle, motion.time[-1])
            else end or motion.time[-1],
            speed_to=0.0,
            standing=True,
        )
        if end is not None:
            yield _setting_off(states, vehicle, motion, end)


def _setting_off(states: States, vehicle: int, motion: Motion, start: float) -> Episode:
    """Return the setting off after a standstill, until the speed stops growing."""
    k, last = motion.index(start), len(motion.speed) - 1
    assert k is not None
    while k + 1 < len(motion.speed) and motion.speed[min(k + 5, last)] > motion.speed[k] + GROWS:
        k += 1
    going_on = k + 1 == len(motion.speed) and _open(states, vehicle, motion.time[k])
    end = None if going_on else motion.time[k]
    return Episode(named(vehicle), "go", start, end, speed_from=0.0, speed_to=motion.speed[k])


def _still(motion: Motion) -> Iterator[tuple[float, float | None, bool]]:
    """Yield begin and end [s] of each standstill, and whether it is from the first sample on."""
    begin: float | None = None
    last = 0
    for k, speed in enumerate(motion.speed):
        broken = k > 0 and motion.time[k] - motion.time[k - 1] > 2.0
        if begin is not None and (speed >= MOVING or broken):
            yield (
                begin,
                motion.time[last + 1] if not broken else motion.time[last],
                begin <= (motion.time[0] + EPSILON),
            )
            begin = None
        if speed < STANDING:
            last = k
            if begin is None:
                begin = motion.time[k]
    if begin is not None:
        yield begin, None, begin <= motion.time[0] + EPSILON


def moves(states: States, vehicle: int) -> list[Episode]:
    """Return the stretches in which a vehicle was in motion."""
    motion = states.motion(vehicle)
    found, start = [], motion.time[0] if motion.time else None
    for begin, end, _ in _still(motion):
        if start is not None and begin > start + EPSILON:
            found.append(Episode(named(vehicle), "move", start, begin))
        start = end
    if start is not None:
        last = None if _open(states, vehicle, motion.time[-1]) else motion.time[-1]
        found.append(Episode(named(vehicle), "move", start, last))
    return found
