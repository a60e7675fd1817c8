"""The scenes of a ride, as browsers draw them.

Scenes that were missed by joining late are filled in from the histories in plan traces.
"""

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field

import msgspec

from planner.record.trace import SAMPLE_PERIOD, PlanTrace, Track
from sim.scene import Light, LightState, Scene, Signal, VehicleState
from xavi_dialogue.dashboard.views.map import hidden, lights, seen

MAX_MOMENTS = 18_000  # moments of an hour
MAX_BYTES = 24 * 1024 * 1024  # of all moments, as JSON
STATES = {state.value: state for state in LightState}
SPACING = 0.95 * SAMPLE_PERIOD  # [s] least time between moments that are kept


@dataclass
class SceneHistory:
    """The scenes of one ride, in order of time; as JSON, which takes a tenth of the memory."""

    times: list[float] = field(default_factory=list)  # [s]
    _packed: list[bytes] = field(default_factory=list)  # the time of each, and its JSON
    _taken: int = 0  # bytes of all packed moments

    def see(self, scene: Scene) -> None:
        """Add a scene, unless one of the same time or later is known."""
        if not self.times or scene.time >= self.times[-1] + SPACING:
            who = seen({**scene.vehicles, **scene.people})
            row = (scene.time, who, lights(scene.lights), hidden(scene.unseen))
            self._keep(len(self.times), scene.time, msgspec.json.encode(row))

    def learn(self, trace: PlanTrace) -> None:
        """Add missing scenes from the history of a decision."""
        for time in sorted({time for track in trace.history.values() for time in _times(track)}):
            index = bisect_right(self.times, time)
            after = self.times[index] if index < len(self.times) else float("inf")
            before = self.times[index - 1] if index else float("-inf")
            if time - before >= SPACING and after - time >= SPACING:
                row = (time, seen(_as_of(trace, time)), lights(_shown(trace, time)), None)
                self._keep(index, time, msgspec.json.encode(row))

    def document(self, ride: str) -> bytes:
        """Return all moments: `documents.Past` as JSON."""
        return b'{"ride":%b,"scenes":[%b]}' % (msgspec.json.encode(ride), b",".join(self._packed))

    def _keep(self, index: int, time: float, packed: bytes) -> None:
        self.times.insert(index, time)
        self._packed.insert(index, packed)
        self._taken += len(packed)
        if len(self.times) > MAX_MOMENTS or self._taken > MAX_BYTES:
            oldest = len(self.times) // 10 + 1
            self._taken -= sum(map(len, self._packed[:oldest]))
            del self.times[:oldest], self._packed[:oldest]


def _times(track: Track) -> list[float]:
    return [round(track.start + SAMPLE_PERIOD * k, 3) for k in range(len(track.position))]


def _shown(trace: PlanTrace, time: float) -> Iterator[Light]:
    """Return the states of lights at a time, as the decision used them, if in view."""
    for one in trace.lights:
        known = [showing for showing in one.seen if showing.time <= time]
        for place, letter in zip(one.places, known[-1].states if known else "", strict=False):
            if letter in STATES:
                signal = Signal(one.controller, place)
                yield Light(signal, STATES[letter], known[-1].time, change_seen=True)


def _as_of(trace: PlanTrace, time: float) -> dict[int, VehicleState]:
    """Return the vehicles at a time of a history; constant values are from the trace's scene."""
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
