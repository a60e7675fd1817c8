"""Synthetic moments on a straight road with any number of other vehicles."""

from collections.abc import Mapping
from dataclasses import dataclass

from planner.record.trace import SAMPLE_PERIOD, EgoGoal, Settings, Track
from planner.roads.trajectory import Roads
from planner.rollouts.waypoints import survey
from planner.search.inputs import Frame, Moment, Root, root_at
from sim.roads.network import Lane, Network, point_at
from sim.scene import EGO, VehicleState

SEEN = 25  # samples of 0.2 s for which everybody has been in view
LENGTH, WIDTH = 4.8, 1.8  # [m]
PACE = 22.0  # [m/s] of the ego


@dataclass(frozen=True, slots=True)
class Spot:
    """The place of another vehicle relative to the ego."""

    lane: int  # to the left of the ego's
    ahead: float  # [m]
    faster: float  # [m/s]


# The nearest come first: with n others, the first n are there.
SPOTS = (
    *(Spot(0, 30.0, -6.0), Spot(1, 12.0, 2.0), Spot(-1, -16.0, -2.0), Spot(0, -28.0, -3.0)),
    *(Spot(1, -22.0, 3.0), Spot(-1, 26.0, -7.0), Spot(0, 62.0, -6.0), Spot(1, 48.0, 2.0)),
    *(Spot(-1, -48.0, -2.0), Spot(0, -60.0, -3.0), Spot(1, -64.0, 3.0), Spot(-1, 66.0, -7.0)),
    *(
        Spot(lane, side * ahead, faster)
        for ahead in (80.0, 94.0, 108.0, 122.0, 136.0)
        for side in (1.0, -1.0)
        for lane, faster in ((0, -3.0), (1, 2.0), (-1, -6.0))
    ),
)


def crowd(
    network: Network, goal: EgoGoal, settings: Settings, others: int, shift: float = 0.0
) -> tuple[Frame, Moment]:
    """Return a moment of decision on the middle lane of the longest road of three lanes.

    Args:
        network: has such a road, at least 300 m long.
        goal: of the ego, beyond it.
        settings: of the planner.
        others: number of other vehicles, up to 42.
        shift: [m] by which all of them are farther ahead.

    Raises:
        ValueError: there is no such road, or there are not so many spots.
    """
    lanes = _road(network)
    if others > len(SPOTS):
        raise ValueError(f"{others} others; at most {len(SPOTS)} have a place")
    middle = lanes[1].length / 2.0
    tracks = {EGO: _track(lanes[1], middle, PACE)}
    for name, spot in enumerate(SPOTS[:others], 1):
        tracks[name] = _track(lanes[1 + spot.lane], middle + spot.ahead + shift, PACE + spot.faster)
    scene = _scene(tracks)
    frame = Frame(Roads(network), goal, settings, 0, "car")
    survey(frame.roads, goal)  # as a driver does before it drives
    here = root_at(frame.roads, scene[EGO], 0.0)
    assert here is not None
    return frame, Moment(0, 0.0, scene, tracks, Root(here))


def _road(network: Network) -> tuple[Lane, ...]:
    edges = dict.fromkeys(lane.edge for lane in network.lanes.values() if not lane.internal)
    wide = [lanes for edge in edges if len(lanes := network.edge_lanes(edge)) == 3]
    longest = max(wide, key=lambda lanes: lanes[0].length, default=None)
    if longest is None or longest[0].length < 300.0:
        raise ValueError("there is no road of three lanes and 300 m")
    return longest


def _track(lane: Lane, offset: float, speed: float) -> Track:
    """Return a track at a steady speed [m/s] whose front is now at an offset [m]."""
    places = [
        point_at(lane.centreline, offset - k * SAMPLE_PERIOD * speed)
        for k in range(SEEN - 1, -1, -1)
    ]
    return Track(
        round(-(SEEN - 1) * SAMPLE_PERIOD, 3),
        tuple((round(x, 2), round(y, 2)) for (x, y), _ in places),
        tuple(round(heading, 4) for _, heading in places),
        (speed,) * SEEN,
    )


def _scene(tracks: Mapping[int, Track]) -> dict[int, VehicleState]:
    return {
        name: VehicleState(
            track.position[-1], track.heading[-1], track.speed[-1], 0.0, LENGTH, WIDTH
        )
        for name, track in tracks.items()
    }
