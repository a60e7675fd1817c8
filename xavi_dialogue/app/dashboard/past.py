"""What a car has seen on this ride, moment by moment, as browsers draw it.

What was missed because one joined late is filled in from the histories in the plan traces.
"""

from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass, field

from planner.trace import SAMPLE_PERIOD, PlanTrace, Track
from sim.scene import VehicleState
from xavi_dialogue.app.dashboard.roads import seen
from xavi_dialogue.transports.web.wire import Seen

MAX_MOMENTS = 18_000  # an hour
SPACING = 0.95 * SAMPLE_PERIOD  # [s] at least, between moments that are kept


@dataclass
class Moments:
    """The moments of one ride, in order of time."""

    kept: list[tuple[float, tuple[Seen, ...]]] = field(default_factory=list)

    def see(self, time: float, vehicles: Mapping[int, VehicleState]) -> None:
        """Keep what is seen at a time [s], unless so late a moment is known already."""
        if self.kept and time < self.kept[-1][0] + SPACING:
            return
        self.kept.append((time, seen(vehicles)))
        if len(self.kept) > MAX_MOMENTS:
            del self.kept[: MAX_MOMENTS // 10]

    def learn(self, trace: PlanTrace) -> None:
        """Fill in, from the history of a decision, what was not seen."""
        times = sorted({time for track in trace.history.values() for time in _times(track)})
        for time in times:
            index = bisect_right(self.kept, time, key=lambda moment: moment[0])
            after = self.kept[index][0] if index < len(self.kept) else float("inf")
            before = self.kept[index - 1][0] if index else float("-inf")
            if time - before >= SPACING and after - time >= SPACING:
                self.kept.insert(index, (time, seen(_as_of(trace, time))))


def _times(track: Track) -> list[float]:
    return [round(track.start + SAMPLE_PERIOD * k, 3) for k in range(len(track.position))]


def _as_of(trace: PlanTrace, time: float) -> dict[int, VehicleState]:
    """The vehicles at a time of a history; what does not change is as in the trace's scene."""
    found = {}
    for vehicle, track in trace.history.items():
        k = round((time - track.start) / SAMPLE_PERIOD)
        now = trace.scene.get(vehicle)
        if now is None or not 0 <= k < len(track.position):
            continue
        found[vehicle] = VehicleState(
            position=track.position[k],
            heading=track.heading[k],
            speed=track.speed[k],
            acceleration=0.0,
            length=now.length,
            width=now.width,
            kind=now.kind,
            colour=now.colour,
        )
    return found
