"""The traffic lights in view of a passenger, with the time since which they show their state.

A light is in view if its stop line is near and not far behind the ego. Lights of the other arms of
a junction count too: what they show can be seen from how the traffic there moves.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping

from sim.scene import Light, LightState, Point, Signal, VehicleState

BEHIND = 15.0  # [m] how far behind the ego's front a stop line may be
_STATES = {
    **{state.value: state for state in LightState},
    # SUMO also accepts these letters, from old files.
    "R": LightState.RED,
    "Y": LightState.AMBER,
}


class Signals:
    """The traffic lights of a network as the ego sees them during a ride."""

    def __init__(
        self, stop_lines: Mapping[Signal, tuple[Point, ...]], state: Callable[[str], str]
    ) -> None:
        """Begin with no light seen.

        Args:
            stop_lines: the points [m] where the links of each signal begin.
            state: returns SUMO's current letters for a controller.
        """
        self._state = state
        self._lines: dict[str, dict[int, tuple[Point, ...]]] = {}
        for signal, points in stop_lines.items():
            self._lines.setdefault(signal.controller, {})[signal.index] = points
        self._around = {name: _circle(lines.values()) for name, lines in self._lines.items()}
        self._seen: dict[Signal, Light] = {}

    def look(self, time: float, ego: VehicleState, radius: float) -> tuple[Light, ...]:
        """Return the lights in view, by controller and index.

        Args:
            time: [s] of this look, later than that of the last one.
            ego: the vehicle that looks.
            radius: [m] how far it sees.

        Raises:
            ValueError: SUMO returns a letter that stands for no state of a light.
        """
        now = {light.signal: light for light in self._lights(time, ego, radius)}
        self._seen = dict(sorted(now.items(), key=lambda x: (x[0].controller, x[0].index)))
        return tuple(self._seen.values())

    def _lights(self, time: float, ego: VehicleState, radius: float) -> Iterator[Light]:
        for controller, lines in self._lines.items():
            middle, reach = self._around[controller]
            if math.dist(middle, ego.position) > radius + reach:
                continue
            near = [index for index, points in lines.items() if _in_view(points, ego, radius)]
            letters = self._state(controller) if near else ""
            for index in near:
                if index < len(letters):
                    yield self._light(Signal(controller, index), _named(letters[index]), time)

    def _light(self, signal: Signal, state: LightState, time: float) -> Light:
        before = self._seen.get(signal)
        if before is not None and before.state is state:
            return before
        return Light(signal, state, time, change_seen=before is not None)


def _circle(lines: Iterable[tuple[Point, ...]]) -> tuple[Point, float]:
    """Return a circle around all stop lines of a controller: its middle and radius [m]."""
    points = [point for line in lines for point in line]
    xs, ys = zip(*points, strict=True)
    middle = ((min(xs) + max(xs)) / 2.0, (min(ys) + max(ys)) / 2.0)
    return middle, max(math.dist(middle, point) for point in points)


def _named(letter: str) -> LightState:
    state = _STATES.get(letter)
    if state is None:
        raise ValueError(f"{letter!r} is not a state of a traffic light")
    return state


def _in_view(points: tuple[Point, ...], ego: VehicleState, radius: float) -> bool:
    """Check whether one of several points is within a radius [m] of the ego and not far behind."""
    ahead_x, ahead_y = math.cos(ego.heading), math.sin(ego.heading)
    for x, y in points:
        dx, dy = x - ego.position[0], y - ego.position[1]
        if dx * dx + dy * dy <= radius * radius and dx * ahead_x + dy * ahead_y >= -BEHIND:
            return True
    return False
