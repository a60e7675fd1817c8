"""Displacement errors of predicted trajectories, compared with those of simple rivals.

The average (ADE) and the final error (FDE) are distances [m] between the predicted place and the
true one, averaged over the horizon and at its end (Pellegrini et al., ICCV 2009).
"""

from collections.abc import Sequence

import msgspec
import numpy as np

from benchmarks.prediction.ride_scenes import Recording
from planner.manoeuvres.actions import Situation
from planner.motion.tracks import Observed, sample_path
from planner.prediction.recognise import Belief
from planner.record.trace import SAMPLE_PERIOD
from planner.roads.routes import approach, onward
from planner.roads.trajectory import Array, Roads

HORIZONS = (2.0, 4.0)  # [s]
LIKELIEST, BEST = "likeliest", "best of ours"
STRAIGHT, LANE, EACH = "constant velocity", "keeps its lane", "best of each road"
METHODS = (LIKELIEST, STRAIGHT, LANE, BEST, EACH)
BLEND = 12.0  # [m] of way in which a vehicle returns to the middle of its lane


class Error(msgspec.Struct, frozen=True):
    """The errors of one method at one horizon."""

    method: str
    horizon: float  # [s]
    average: float  # [m]
    final: float  # [m]
    lines: int  # number of trajectories, of which the best counts


def errors(
    recording: Recording, sample: int, vehicle: int, beliefs: Sequence[Belief]
) -> tuple[Error, ...]:
    """Return the errors of all methods, at the horizons for which a vehicle stays in view."""
    now = recording.track(sample, vehicle)
    found: list[Error] = []
    lines: dict[str, list[Array]] = {}
    for horizon in HORIZONS:
        steps = round(horizon / SAMPLE_PERIOD)
        scenes = recording.scenes[sample + 1 : sample + 1 + steps]
        if len(scenes) < steps or any(vehicle not in scene.vehicles for scene in scenes):
            break
        truth = np.array([scene.vehicles[vehicle].position for scene in scenes])
        lines = lines or predicted(recording.roads, recording.settings.view_radius, now, beliefs)
        found += [error(name, horizon, lines[name], truth) for name in METHODS]
    return tuple(found)


def error(method: str, horizon: float, lines: Sequence[Array], truth: Array) -> Error:
    """Return the errors of the best of several predicted lines.

    Args:
        method: the method that predicted the lines.
        horizon: [s]
        lines: each [m] [T, 2] from the next sample on; after its end the last place counts.
        truth: [m] [N, 2] places of the vehicle, T >= N.
    """
    apart = np.array([np.hypot(*(held(line)[: len(truth)] - truth).T) for line in lines])
    least = float(np.min(np.mean(apart, axis=1)))
    return Error(method, horizon, least, float(np.min(apart[:, -1])), len(lines))


def held(line: Array) -> Array:
    """Return a line in which the last place replaces those after its end (NaN)."""
    there = np.isfinite(line[:, 0])
    last = np.maximum.accumulate(np.where(there, np.arange(len(line)), 0))
    found: Array = line[last]
    return found


def predicted(
    roads: Roads, view: float, now: Observed, beliefs: Sequence[Belief]
) -> dict[str, list[Array]]:
    """Return the predicted lines [m] [T, 2] of each method, from the next sample on."""
    ways = [(b.probability * w.probability, w.motion) for b in beliefs for w in b.trajectories]
    mine = [motion.position[1:] for _, motion in ways]
    likeliest = max(range(len(ways)), key=lambda k: ways[k][0])
    steps = round(max(HORIZONS) / SAMPLE_PERIOD)
    gone: Array = float(now.speed[-1]) * SAMPLE_PERIOD * np.arange(1, steps + 1, dtype=np.float64)
    angle = float(now.heading[-1])
    straight = now.position[-1] + gone[:, None] * np.array([np.cos(angle), np.sin(angle)])
    here = now.situation(roads, -1, 0.0)
    along = rows(roads, here[0], view) if here else []
    each = [_along(roads, here[0], row, gone, now) for row in along]
    lane = each[0] if each else straight
    return {
        LIKELIEST: [mine[likeliest]],
        STRAIGHT: [straight],
        LANE: [lane],
        BEST: mine,
        EACH: each or [straight],
    }


def rows(roads: Roads, here: Situation, view: float) -> list[tuple[str, ...]]:
    """Return rows of connected lanes: straight on, and into each road ahead."""
    place, network = here.location, roads.network
    found = [onward(roads, (place.lane,), place.offset + view)]
    ahead = approach(roads, place, view).lanes
    last = network.lanes[ahead[-1]]
    beside = [lane.id for lane in network.edge_lanes(last.edge)] if not last.internal else []
    before = ahead[:-1]
    for lane in beside if not before else [last.id]:
        for link in network.links_from(lane):
            row = (*before, lane, *link.via, link.to_lane)
            edge = network.lanes[link.to_lane].edge
            if not any(network.lanes[lane].edge == edge for other in found for lane in other):
                found.append(onward(roads, row, place.offset + view))
    return found


def _along(
    roads: Roads, here: Situation, row: tuple[str, ...], gone: Array, now: Observed
) -> Array:
    path = roads.path(row, here.position, here.heading, BLEND, float(gone[-1]) + 5.0)
    found, _ = sample_path(path, np.minimum(gone, path.length), now.length)
    return found
