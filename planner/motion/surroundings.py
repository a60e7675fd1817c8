"""The inputs that predictions share: roads, courses of lights, and other road users."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace

from planner.kernels.limits import GAP_HORIZON
from planner.motion.obstacles import Motions, Obstacle, Pool, Traffic
from planner.motion.tracks import Observed, coast
from planner.roads.classes import roads_of
from planner.roads.trajectory import Roads
from planner.traffic_lights.signals import Lights, Outlook
from sim.roads.network import UNSIGNALLED
from sim.scene import Signal


@dataclass(frozen=True, slots=True, eq=False)
class Surroundings:
    """The inputs that all vehicles share: the roads, and the possible courses of lights."""

    roads: Roads
    outlook: Outlook
    steps: int
    _lights: dict[tuple[int, ...], Lights] = field(default_factory=dict)
    _before: dict[int, Lights] = field(default_factory=dict)

    def on(self, kind: str) -> "Surroundings":
        """Return the surroundings with the roads for a kind of vehicle."""
        roads = roads_of(self.roads, kind)
        return self if roads is self.roads else replace(self, roads=roads)

    def lights(self, courses: tuple[int, ...]) -> Lights:
        """Return the lights from now on if controllers take certain courses."""
        found = self._lights.get(courses)
        if found is None:
            found = self.outlook.lights(courses, self.steps + GAP_HORIZON)
            self._lights[courses] = found
        return found

    def lights_before(self, elapsed: int) -> Lights:
        """Return the lights from `elapsed` steps ago on; from now on, in their likeliest course."""
        found = self._before.get(elapsed)
        if found is None:
            found = self.outlook.before(elapsed, self.steps + GAP_HORIZON)
            self._before[elapsed] = found
        return found

    def motions(self, make: Callable[[tuple[int, ...]], Obstacle]) -> Motions:
        """Return the motions of a vehicle under each course of controllers on its way."""
        usual = self.outlook.usual
        motion = make(usual)
        if len(self.outlook.joint) == 1:
            return Motions(motion)
        near = _controllers(self.roads, motion.links)
        made = {usual: motion}

        def under(courses: tuple[int, ...]) -> Obstacle:
            alike = self.outlook.with_usual(courses, near)
            if alike not in made:
                made[alike] = make(alike)
            return made[alike]

        return Motions(motion, under)

    def coast(self, track: Observed) -> Motions:
        """Return the motions of a vehicle that coasts, under each course of the lights."""
        return self.motions(
            lambda courses: coast(
                self.roads, track, self.steps, past=False, lights=self.lights(courses)
            )
        )


@dataclass(frozen=True, slots=True, eq=False)
class Others:
    """The motions of the others from now on, and the lights."""

    surroundings: Surroundings
    motions: tuple[Motions, ...]
    pool: Pool = field(default_factory=Pool)  # shared with others in which most are the same
    _traffic: dict[tuple[int, ...], Traffic] = field(default_factory=dict)

    def under(self, courses: tuple[int, ...]) -> Traffic:
        """Return the traffic if controllers take certain courses."""
        found = self._traffic.get(courses)
        if found is None:
            known = [motion.under(courses) for motion in self.motions]
            lights = self.surroundings.lights(courses)
            found = self._traffic[courses] = Traffic.of(known, lights, self.pool)
        return found

    @property
    def usual(self) -> Traffic:
        """The traffic if lights take their likeliest courses."""
        return self.under(self.surroundings.outlook.usual)


def _controllers(roads: Roads, ways: Iterable[tuple[str, int]]) -> frozenset[str]:
    """Return the controllers of the lights of links and crossings, given as (junction, index)."""
    network = roads.network
    found = []
    for junction, index in ways:
        link = network.junction_links(junction).get(index)
        way = link or network.junction_others(junction).get(index)
        found.append(UNSIGNALLED if way is None else way.control)
    return frozenset(control.controller for control in found if isinstance(control, Signal))
