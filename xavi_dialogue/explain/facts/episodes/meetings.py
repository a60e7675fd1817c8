"""Episodes of two vehicles that meet: overtaking, passing, cutting in, crossing, following."""

import math
from collections.abc import Iterator
from typing import TypeAlias

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from planner.record.trace import ON_FOOT
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.vocabulary import Side
from xavi_dialogue.explain.facts.actions import named
from xavi_dialogue.explain.facts.episodes.walks import steps_onto, walks_across
from xavi_dialogue.explain.facts.episodes.ways import ways
from xavi_dialogue.explain.facts.states import Pair, States
from xavi_dialogue.explain.history.motion import Array
from xavi_dialogue.explain.history.restraints import restraints
from xavi_dialogue.explain.history.thresholds import (
    CROSSING,
    CUT_IN,
    CUT_IN_GAP,
    FOLLOWED,
    FOLLOWING,
    FOLLOWING_GAP,
    MOVING,
    OPPOSITE,
    PULLED_OUT,
    ROAD_WIDTH,
    SAME_LANE,
    SAME_WAY,
)

Flags: TypeAlias = NDArray[np.bool_]
FAST_ENOUGH = 2.0  # [m/s] minimum speed of a vehicle that is overtaken, not just passed
STEPPED_OUT = 4.0  # [m] maximum offset sideways of somebody on foot on our way
WALKING = 0.3  # [m/s] minimum speed of somebody on foot who moves on
JUST_NOW = 1.0  # [s] after its last sample in which something still goes on
NOTICED = 1.0  # [s] after it within which somebody who moves in restrains the ego
BESIDE = 3.0  # [s] duration of a lane change that is still going on


def passings(states: States, vehicle: int) -> list[Episode]:
    """Return when one of another vehicle and the ego went past the other."""
    pair = states.pair(EGO, vehicle)
    return [] if pair is None else list(_passing(pair, vehicle))


def crossings(states: States, vehicle: int) -> list[Episode]:
    """Return when another road user crossed the ego's way."""
    pair = states.pair(EGO, vehicle)
    if pair is None:
        return []
    shape = states.shape(vehicle)
    if shape is not None and shape.kind in ON_FOOT:
        seen = list(_walking_across(states, pair, vehicle))
        later = [e for e in walks_across(states, vehicle) if not any(_overlap(e, o) for o in seen)]
        known = [*seen, *later]
        onto = steps_onto(states, vehicle)
        return [*known, *(e for e in onto if not any(_overlap(e, o) for o in known))]
    return list(_crossing(pair, vehicle))


def _overlap(one: Episode, other: Episode) -> bool:
    ends = (math.inf if e.end is None else e.end for e in (one, other))
    return max(one.begin, other.begin) <= min(ends)


def followings(states: States, vehicle: int) -> list[Episode]:
    """Return when one of another vehicle and the ego followed the other."""
    key = ("followings", vehicle)
    pair = states.pair(EGO, vehicle)
    if pair is None:
        return []
    return states.memo(key, lambda: list(_following(states, pair, vehicle)))


def movings_in(states: States, vehicle: int) -> list[Episode]:
    """Return when one of another vehicle and the ego moved in ahead of the other."""
    pair = states.pair(EGO, vehicle)
    return [] if pair is None else list(_moving_in(states, pair, vehicle))


def _runs(mask: Flags, time: Array) -> Iterator[tuple[int, int]]:
    """Yield the first and last sample of each stretch in which a mask holds."""
    if not mask.any():
        return
    edges = np.flatnonzero(np.diff(np.concatenate(([0], mask.astype(np.int8), [0]))))
    for first, after in zip(edges[::2], edges[1::2], strict=True):
        yield int(first), int(after) - 1


def _passing(pair: Pair, vehicle: int) -> Iterator[Episode]:
    """Yield when one went past the other: abreast, ahead before and behind after, or vice versa."""
    abreast = (np.abs(pair.ahead) <= pair.clear) & (np.abs(pair.left) <= ROAD_WIDTH)
    abreast &= (np.abs(pair.turn) <= SAME_WAY) | (np.abs(pair.turn) >= OPPOSITE)
    for first, last in _runs(abreast, pair.time):
        sooner, later = max(first - 1, 0), min(last + 1, len(pair.time) - 1)
        before, after = pair.ahead[sooner], pair.ahead[later]
        if before * after >= 0.0:
            continue
        ours = before > 0.0
        opposite = abs(pair.turn[first]) >= OPPOSITE
        passed_speed = pair.speed[first] if ours else pair.eye_speed[first]
        same = not opposite and passed_speed >= FAST_ENOUGH
        beside = pair.left[first] > 0.0
        we_pass = (ours and not opposite) or (opposite and pair.speed[first] < MOVING)
        side: Side = "left" if beside != we_pass else "right"
        actor, other = (EGO, vehicle) if we_pass else (vehicle, EGO)
        yield Episode(
            named(actor),
            "overtake" if same else "pass",
            float(pair.time[first]),
            float(pair.time[last]),
            named(other),
            side,
        )


def _crossing(pair: Pair, vehicle: int) -> Iterator[Episode]:
    """Yield when a vehicle crossed our line ahead of us."""
    across = (np.abs(pair.turn) > SAME_WAY) & (np.abs(pair.turn) < OPPOSITE)
    across &= (pair.ahead > 0.0) & (pair.ahead <= CROSSING) & (pair.speed >= MOVING)
    signs = np.sign(pair.left)
    for k in np.flatnonzero((signs[1:] != signs[:-1]) & across[1:] & across[:-1]):
        side: Side = "left" if pair.left[k] > 0.0 else "right"
        wide = np.abs(pair.left) <= pair.clear
        first = last = int(k)
        while first > 0 and wide[first - 1] and across[first - 1]:
            first -= 1
        while last + 1 < len(wide) and wide[last + 1] and across[last + 1]:
            last += 1
        yield Episode(
            named(vehicle),
            "cross",
            float(pair.time[first]),
            float(pair.time[last]),
            named(EGO),
            side,
        )


def _walking_across(states: States, pair: Pair, vehicle: int) -> Iterator[Episode]:
    """Yield when somebody on foot walked across our lane ahead of us."""
    across = (np.abs(pair.turn) > SAME_WAY) & (np.abs(pair.turn) < OPPOSITE)
    across &= (pair.ahead > 0.0) & (pair.ahead <= CROSSING) & (pair.speed >= WALKING)
    across &= np.abs(pair.left) <= STEPPED_OUT
    for first, last in _runs(_closed(across, pair.time), pair.time):
        begin, end = float(pair.time[first]), float(pair.time[last])
        over = end < states.ride.now - JUST_NOW or states.ride.ended
        side: Side = "left" if pair.left[first] > 0.0 else "right"
        until = end if over else None
        yield Episode(named(vehicle), "cross", begin, until, named(EGO), side)


def _following(states: States, pair: Pair, vehicle: int) -> Iterator[Episode]:
    """Yield the stretches in which one follows the other on one line, with nobody between them."""
    gap = np.abs(pair.ahead) - pair.clear
    behind = np.where(pair.ahead > 0.0, pair.eye_speed, pair.speed)
    near = (np.abs(pair.left) <= SAME_LANE) & (np.abs(pair.turn) <= SAME_WAY) & (gap > -1.0)
    near &= (gap <= FOLLOWING * behind) | (gap <= FOLLOWING_GAP)
    for ours in (True, False):
        held = near & ((pair.ahead > 0.0) == ours)
        for first, last in _runs(_closed(held, pair.time), pair.time):
            begin, end = float(pair.time[first]), float(pair.time[last])
            if end - begin < FOLLOWED or _between(states, vehicle, (begin + end) / 2.0, ours):
                continue
            actor, other = (EGO, vehicle) if ours else (vehicle, EGO)
            old = 1.5 if states.ride.scene is None else 0.5
            over = end < states.ride.now - old or states.ride.ended
            yield Episode(named(actor), "follow", begin, end if over else None, named(other))


def _closed(mask: Flags, time: Array) -> Flags:
    """Return a mask with breaks of up to a second closed, such as those on a winding road."""
    if not mask.any():
        return mask
    closed = mask.copy()
    for first, last in _runs(~mask, time):
        inner = first > 0 and last + 1 < len(mask)
        if inner and time[last + 1] - time[first - 1] <= 1.0 and mask[first - 1]:
            closed[first : last + 1] = True
    return closed


def _between(states: States, vehicle: int, time: float, ours: bool) -> bool:
    """Check whether somebody else is between the ego and a vehicle on its line."""
    own = states.offset(EGO, vehicle, time)
    if own is None:
        return False
    for other in states.ride.vehicles:
        seen = states.offset(EGO, other, time) if other != vehicle else None
        if seen is None or not seen.same_way or abs(seen.left) > SAME_LANE:
            continue
        if (0.0 < seen.ahead < own.ahead) if ours else (own.ahead < seen.ahead < 0.0):
            return True
    return False


def _moving_in(states: States, pair: Pair, vehicle: int) -> Iterator[Episode]:
    """Yield when one moved in close ahead of the other, by a lane change or from a side road."""
    for episode in ways(states, vehicle):
        close: list[Episode] = []
        if episode.action in ("change-left", "change-right"):
            close = list(_cut_in(states, pair, episode, vehicle, ours=False))
        elif episode.action in ("exit-left", "exit-right", "enter"):
            yield from _pulled_out(pair, episode, vehicle)
        else:
            continue
        if not close and _slowed_us(states, episode, vehicle):
            close = [replace(episode, actor=named(vehicle), action="cut-in", object=named(EGO))]
        yield from close
    for episode in ways(states, EGO):
        if episode.action in ("change-left", "change-right"):
            yield from _cut_in(states, pair, episode, vehicle, ours=True)


def _slowed_us(states: States, move: Episode, vehicle: int) -> bool:
    """Check whether the ego's driving was restrained since a vehicle moved in ahead of it."""
    end = move.begin + BESIDE if move.end is None else move.end
    return any(
        one.restraint.by == "cut-in" and one.restraint.vehicle == vehicle
        for one in restraints(states.ride)
        if one.begin <= end + NOTICED and one.end >= move.begin
    )


def _cut_in(
    states: States, pair: Pair, change: Episode, vehicle: int, *, ours: bool
) -> Iterator[Episode]:
    """Yield a lane change to close ahead in the other's lane, which the other may be leaving."""
    end = change.begin + BESIDE if change.end is None else change.end
    before, after = _sample(pair, change.begin), _sample(pair, end)
    if before is None or after is None or abs(pair.turn[after]) > SAME_WAY:
        return
    sign = -1.0 if ours else 1.0
    speed = pair.speed[after] if ours else pair.eye_speed[after]
    gap = sign * pair.ahead[after] - pair.clear
    inside = slice(before, after + 1)
    in_line = (np.abs(pair.left[inside]) <= SAME_LANE) & (sign * pair.ahead[inside] > pair.clear)
    was_aside = abs(pair.left[before]) > SAME_LANE
    into = in_line.any() or _into_lane_of(states, change, EGO, vehicle, ours=ours)
    if was_aside and into and -1.0 < gap <= max(CUT_IN * speed, CUT_IN_GAP):
        actor, other = (EGO, vehicle) if ours else (vehicle, EGO)
        yield replace(change, actor=named(actor), action="cut-in", object=named(other))


def _into_lane_of(states: States, change: Episode, eye: int, vehicle: int, *, ours: bool) -> bool:
    """Check whether a lane change leads into the lane that the other had when it began."""
    mover, other = (eye, vehicle) if ours else (vehicle, eye)
    end = change.begin + BESIDE if change.end is None else change.end
    there, his = states.place(mover, end + 0.5), states.place(other, change.begin)
    if there is None or his is None or there.lane is None:
        return False
    return (there.edge, there.lane) == (his.edge, his.lane)


def _pulled_out(pair: Pair, turn: Episode, vehicle: int) -> Iterator[Episode]:
    end = turn.begin + BESIDE if turn.end is None else turn.end
    before, after = _sample(pair, turn.begin), _sample(pair, end + 1.0) or _sample(pair, end)
    if before is None or after is None:
        return
    aside = abs(pair.turn[before]) > SAME_WAY / 2.0 or abs(pair.left[before]) > SAME_LANE
    ahead = 0.0 < pair.ahead[after] <= PULLED_OUT and abs(pair.turn[after]) <= SAME_WAY
    if aside and ahead and abs(pair.left[after]) <= 2.0 * SAME_LANE:
        yield Episode(
            named(vehicle),
            "pull-out",
            turn.begin,
            turn.end,
            named(EGO),
            turn.side,
            place=turn.place,
            sure=False,
        )


def _sample(pair: Pair, time: float) -> int | None:
    """Return the sample nearest to a time [s]; None if none is near."""
    k = int(np.argmin(np.abs(pair.time - time)))
    return k if abs(pair.time[k] - time) <= 0.6 else None
