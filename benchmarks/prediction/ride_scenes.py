"""A ride as scenes, with the planner's beliefs about the others at any moment."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field

from benchmarks.prediction.approach import track_at
from planner.motion.tracks import Observed
from planner.prediction.recognise import Belief, recognise
from planner.record.events import Event
from planner.record.trace import SAMPLE_PERIOD, Settings
from planner.roads.trajectory import Roads
from sim.scene import EGO, Scene
from sim.setup.scenario import Scenario
from sim.sumo import EgoGone, Simulation
from xavi_dialogue.vehicle.episode import network_of, settings_of, start

MEMORY = 50  # samples of a track that the car remembers


@dataclass(frozen=True)
class Recording:
    """A ride at 5 Hz."""

    roads: Roads
    settings: Settings
    scenes: Sequence[Scene]
    events: Sequence[Event]
    _known: dict[int, Mapping[int, Sequence[Belief]]] = field(default_factory=dict)

    def beliefs(self, sample: int) -> Mapping[int, Sequence[Belief]]:
        """Return the beliefs about everybody in view, from their tracks up to a sample."""
        found = self._known.get(sample)
        if found is None:
            scene = self.scenes[sample]
            tracks = [self.track(sample, name) for name in scene.vehicles]
            found = recognise(self.roads, tracks, self.settings, scene.time, EGO)
            self._known[sample] = found
        return found

    def track(self, sample: int, vehicle: int) -> Observed:
        """Return the track of a vehicle that the car remembers at a sample."""
        return track_at(self.scenes, sample, vehicle, MEMORY)


def record(scenario: Scenario) -> Recording:
    """Drive a scenario to its end, by our planner.

    Raises:
        SimulationError: SUMO is not installed or fails.
        DriverError: the car cannot go on.
    """
    network = network_of(scenario)
    stride = max(1, round(SAMPLE_PERIOD / scenario.step))
    scenes: list[Scene] = []
    events: list[Event] = []
    with start(scenario, network) as ride:
        for count, moment in enumerate(ride):
            events.extend(moment.events)
            if count % stride == 0:
                scenes.append(moment.scene)
    return Recording(Roads(network), settings_of(scenario), scenes, events)


def record_by_sumo(scenario: Scenario) -> Recording:
    """Record a scenario whose ego SUMO drives, to the end of its way or of the time.

    Raises:
        SimulationError: SUMO is not installed or fails.
    """
    network = network_of(scenario)
    stride = max(1, round(SAMPLE_PERIOD / scenario.step))
    scenes: list[Scene] = []
    with Simulation(scenario) as world, suppress(EgoGone):
        scene = world.scene()
        for count in range(round(scenario.duration / scenario.step) + 1):
            if count % stride == 0:
                scenes.append(scene)
            scene = world.step(None)
    return Recording(Roads(network), settings_of(scenario), scenes, ())
