"""The true ways of vehicles: up to a choice of roads, and into the road that they took.

They are determined from recorded scenes alone, for comparison with predictions. An approach begins
when a vehicle is in view on its road and has more than one road to choose from in view. It ends
when the vehicle enters one of those roads, which is the truth. A vehicle that leaves the view
before, or goes elsewhere, is left out.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from planner.motion.tracks import Observed, indicating, lanes_at
from planner.prediction.goals import Goal, goals_in_view
from planner.roads.trajectory import Roads
from sim.scene import EGO, Scene, VehicleState

SHORTEST = 10  # least number of samples of an approach


@dataclass(frozen=True, slots=True)
class Approach:
    """The approach of one vehicle to a choice of roads."""

    vehicle: int
    first: int  # sample at which it has the choice in view
    last: int  # sample before it enters the road that it takes
    choices: tuple[Goal, ...]  # all goals at the first sample, including stopping
    truth: str  # edge of the road that it takes


def approaches(roads: Roads, scenes: Sequence[Scene], view: float) -> tuple[Approach, ...]:
    """Return every approach of every vehicle but the ego.

    Args:
        roads: the road network.
        scenes: at 5 Hz.
        view: [m] radius in which roads count as in view.
    """
    names = sorted({name for scene in scenes for name in scene.vehicles if name != EGO})
    return tuple(
        approach
        for name in names
        for stretch in _stretches(scenes, name)
        for approach in _approaches(roads, scenes, name, stretch, view)
    )


def track_at(scenes: Sequence[Scene], sample: int, vehicle: int, longest: int) -> Observed:
    """Return a vehicle as observed up to a sample, over `longest` samples at most."""
    first = sample
    while first > max(0, sample - longest) and vehicle in scenes[first - 1].vehicles:
        first -= 1
    states = [scene.vehicles[vehicle] for scene in scenes[first : sample + 1]]
    return Observed(
        vehicle,
        states[-1].length,
        states[-1].width,
        np.round([state.position for state in states], 2),
        np.round([state.heading for state in states], 4),
        np.round([state.speed for state in states], 2),
        indicating(states[-1]),
    )


def _stretches(scenes: Sequence[Scene], vehicle: int) -> Iterator[range]:
    """Yield the runs of samples in which a vehicle is in view."""
    begun: int | None = None
    for k in range(len(scenes) + 1):
        seen = k < len(scenes) and vehicle in scenes[k].vehicles
        if seen and begun is None:
            begun = k
        elif not seen and begun is not None:
            yield range(begun, k)
            begun = None


def _approaches(
    roads: Roads, scenes: Sequence[Scene], vehicle: int, stretch: range, view: float
) -> Iterator[Approach]:
    edges = [_edge(roads, scenes[k].vehicles[vehicle]) for k in stretch]
    at = 0
    while at < len(stretch):
        choices: tuple[Goal, ...] = ()
        if edges[at] is not None:
            choices = _choices(roads, scenes[stretch[at]].vehicles[vehicle], view)
        roads_to_take = {goal.target.edge for goal in choices if goal.target is not None}
        if len(roads_to_take) < 2:
            at += 1
            continue
        taken = next((k for k in range(at + 1, len(edges)) if edges[k] in roads_to_take), None)
        if taken is None:
            return
        truth = edges[taken]
        if taken - at > SHORTEST and truth is not None:
            yield Approach(vehicle, stretch[at], stretch[taken - 1], choices, truth)
        at = taken


def _edge(roads: Roads, state: VehicleState) -> str | None:
    """Return the road that a vehicle is on; None within junctions and off the road."""
    found = lanes_at(roads, state.position, state.heading)
    lane = roads.network.lanes[found[0].lane] if found else None
    return None if lane is None or lane.internal else lane.edge


def _choices(roads: Roads, state: VehicleState, view: float) -> tuple[Goal, ...]:
    now = Observed(
        EGO,
        state.length,
        state.width,
        np.array([state.position]),
        np.array([state.heading]),
        np.array([state.speed]),
    ).situation(roads, -1, 0.0)
    return goals_in_view(roads, now, view) if now else ()
