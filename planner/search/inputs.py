"""The inputs of a decision."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from planner.manoeuvres.actions import ActionPlan, Situation
from planner.motion.forward import Motion
from planner.motion.tracks import lanes_at
from planner.record.hidden_record import Phantom
from planner.record.light_record import LightPrediction
from planner.record.trace import Action, EgoGoal, Settings, Track
from planner.roads.trajectory import Roads
from planner.traffic_lights.signals import Outlook
from sim.roads.network import Location
from sim.scene import VehicleState


@dataclass(frozen=True, slots=True)
class Frame:
    """The inputs that stay the same from decision to decision."""

    roads: Roads
    goal: EgoGoal
    settings: Settings
    seed: int
    vehicle: str  # the car's id on the bus


@dataclass(frozen=True, slots=True)
class Root:
    """The situation in which the search begins."""

    here: Situation
    under_way: tuple[ActionPlan, Motion] | None = None  # must be finished first
    driving: Action | None = None  # being driven, but can be abandoned


@dataclass(frozen=True, slots=True)
class Moment:
    """The inputs that are new in every decision."""

    number: int
    time: float  # [s]
    scene: Mapping[int, VehicleState]
    history: Mapping[int, Track]
    root: Root
    unseen: Mapping[int, float] = field(default_factory=dict)  # [s] when last seen
    unpaced: frozenset[int] = frozenset()  # whose speed a removed vehicle limited
    lights: tuple[LightPrediction, ...] = ()
    phantoms: tuple[Phantom, ...] = ()

    @property
    def outlook(self) -> Outlook:
        """The courses that the lights may take."""
        return Outlook(self.time, self.lights)


def root_at(roads: Roads, ego: VehicleState, time: float) -> Situation | None:
    """Return the situation of the ego, from its state alone; None off the road."""
    found = lanes_at(roads, ego.position, ego.heading)
    if not found:
        return None
    return at_place(ego, time, found[0])


def on_lane(roads: Roads, ego: VehicleState, time: float, known: Location) -> Situation:
    """Return the situation of the ego on a known lane, as it follows from its recorded state."""
    found = lanes_at(roads, ego.position, ego.heading)
    return at_place(ego, time, next((place for place in found if place.lane == known.lane), known))


def at_place(ego: VehicleState, time: float, place: Location) -> Situation:
    """Return the situation of the ego at a place of the road network."""
    return Situation(time, ego.position, ego.heading, ego.speed, ego.acceleration, place)
