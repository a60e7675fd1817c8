"""Maps: the roads around the moment, and where everybody was at some times."""

import math
from collections.abc import Iterator

from sim.roads.network import Network
from sim.scene import EGO, Point, Signal
from xavi_dialogue.report.content import Body, Frame, LightShown, Map, RoadShown
from xavi_dialogue.report.figures import rounded
from xavi_dialogue.report.ridden import Ridden
from xavi_dialogue.report.road_users.tracks import Tracks

MOMENTS = (-4.0, -3.0, -2.0, -1.0, 0.0, 2.0)  # [s] of the maps, relative to the moment
LEAST, MOST = 25.0, 60.0  # [m] from the centre of a map to its edges
MARGIN = 8.0  # [m] around what is shown
CENTIMETRES = 2  # decimals of positions


def strip(
    ridden: Ridden,
    tracks: Tracks,
    moment: float,
    window: tuple[float, float],
    involved: tuple[int, ...],
) -> Map:
    """Return the maps of a moment [s].

    Args:
        ridden: the ride.
        tracks: where everybody was.
        moment: [s]
        window: [s] the report's.
        involved: whose tracks are drawn.
    """
    seen = tracks.times(EGO, *window)
    last = seen[-1] if seen else moment
    times = [min(rounded(moment + by, 3), last) if by <= 0.0 else moment + by for by in MOMENTS]
    times = [t for t in dict.fromkeys(times) if window[0] - 1e-6 <= t <= last + 1e-6]
    centre, reach = _view(tracks, times, min(moment, last), involved)
    known = ridden.network if ridden.network is not None and _fits(ridden) else None
    return Map(
        centre=centre,
        reach=reach,
        roads=() if known is None else tuple(_roads(known, centre, reach)),
        frames=tuple(_frame(ridden, known, tracks, time, centre, reach) for time in times),
        tracks={v: _track(tracks, v, window, centre, reach) for v in (EGO, *involved)},
    )


def _fits(ridden: Ridden) -> bool:
    """Check whether the roads are those of the ride."""
    return ridden.network is not None and ridden.network.hash == ridden.record.traces[0].network


def _view(
    tracks: Tracks, times: list[float], moment: float, involved: tuple[int, ...]
) -> tuple[Point, float]:
    """Return the centre [m] of the maps and how far [m] they reach."""
    here = tracks.state(EGO, moment) or tracks.state(EGO, times[0])
    if here is None:
        return (0.0, 0.0), LEAST
    x, y = here.position
    seen = [tracks.state(v, t) for v in (EGO, *involved) for t in times]
    far = [
        max(abs(one.position[0] - x), abs(one.position[1] - y)) for one in seen if one is not None
    ]
    reach = min(max(max(far, default=0.0) + MARGIN, LEAST), MOST)
    return (round(x, 1), round(y, 1)), math.ceil(reach)


def _roads(network: Network, centre: Point, reach: float) -> Iterator[RoadShown]:
    for lane in (*network.lanes.values(), *network.other_lanes.values()):
        if any(_within(point, centre, 3.0 * reach) for point in lane.centreline):
            line = tuple((round(x, CENTIMETRES), round(y, CENTIMETRES)) for x, y in lane.centreline)
            if _crosses(line, centre, reach):
                yield RoadShown(line, round(lane.width, CENTIMETRES), lane.internal)


def _within(point: Point, centre: Point, reach: float) -> bool:
    return abs(point[0] - centre[0]) <= reach and abs(point[1] - centre[1]) <= reach


def _crosses(line: tuple[Point, ...], centre: Point, reach: float) -> bool:
    """Check whether the bounds of a line overlap those of the map."""
    xs, ys = [x for x, _ in line], [y for _, y in line]
    return (
        min(xs) <= centre[0] + reach
        and max(xs) >= centre[0] - reach
        and min(ys) <= centre[1] + reach
        and max(ys) >= centre[1] - reach
    )


def _track(
    tracks: Tracks, vehicle: int, window: tuple[float, float], centre: Point, reach: float
) -> tuple[Point, ...]:
    motion = tracks.motion(vehicle)
    return tuple(
        (round(motion.position[k][0], CENTIMETRES), round(motion.position[k][1], CENTIMETRES))
        for k in motion.within(*window)
        if _within(motion.position[k], centre, 1.5 * reach)
    )


def _frame(
    ridden: Ridden,
    network: Network | None,
    tracks: Tracks,
    time: float,
    centre: Point,
    reach: float,
) -> Frame:
    bodies = []
    for vehicle in sorted(tracks.motions):
        state = tracks.state(vehicle, time)
        if state is None or not _within(state.position, centre, reach + MARGIN):
            continue
        x, y = state.position
        bodies.append(
            Body(
                vehicle=vehicle,
                position=(round(x, CENTIMETRES), round(y, CENTIMETRES)),
                heading=rounded(state.heading, 4),
                length=state.length,
                width=state.width,
                speed=rounded(state.speed, 3),
            )
        )
    source = tracks.source("position", EGO, how=f"at {time:g} s, of all in view")
    shown = () if network is None else tuple(_lights(ridden, network, time, centre, reach))
    return Frame(time, tuple(bodies), shown, source)


def _lights(
    ridden: Ridden, network: Network, time: float, centre: Point, reach: float
) -> Iterator[LightShown]:
    """Yield what the lights showed by the scene, else by the decision before."""
    states: dict[Signal, str] = {}
    trace = ridden.decision_at(time)
    for known in () if trace is None else trace.lights:
        for k, place in enumerate(known.places):
            seen = [one for one in known.seen if one.time <= time + 1e-6]
            if seen and seen[-1].states[k] != "?":
                states[Signal(known.controller, place)] = seen[-1].states[k]
    scenes = [scene for scene in ridden.scenes if abs(scene.time - time) < 0.06]
    for scene in scenes[:1]:
        states.update({light.signal: light.state.value for light in scene.lights})
    done: set[tuple[Point, str]] = set()
    for signal, state in states.items():
        for link in network.signalled(signal):
            x, y = network.lanes[link.from_lane].centreline[-1]
            shown = LightShown((round(x, CENTIMETRES), round(y, CENTIMETRES)), state)
            if _within(shown.position, centre, reach) and (shown.position, state) not in done:
                done.add((shown.position, state))
                yield shown
