"""Re-simulation: SUMO run on from a decision, with the ego doing a foil and then planning on."""

from dataclasses import dataclass

import msgspec

from planner.driver import Driver
from planner.trace import Action, EgoGoal, Outcome, PlanTrace
from sim.network import Network
from sim.scenario import Goal
from sim.scene import Scene
from sim.sumo import EgoGone, Simulation
from xavi_dialogue.app.bench.forking import in_fork
from xavi_dialogue.app.bench.watch import reached

EPSILON = 1e-6  # [s]


class Happened(msgspec.Struct, frozen=True):
    """What came of a drive from a decision on."""

    outcome: Outcome
    time: float | None = None  # [s] from the decision to the goal, where that was reached
    collided_with: int | None = None


@dataclass(frozen=True)
class Aim:
    """What the rollouts of a decision aimed for, and when they gave up."""

    network: Network
    goal: EgoGoal  # or the waypoint
    start: float  # [s] of the decision
    horizon: float  # [s]

    @classmethod
    def of(cls, network: Network, trace: PlanTrace) -> "Aim":
        """That of a decision."""
        goal = trace.goal if trace.waypoint is None else trace.waypoint
        return cls(network, goal, trace.sim_time, trace.settings.horizon)

    def come_to(self, scene: Scene, touched: tuple[int, ...]) -> Happened | None:
        """What a drive has come to by a scene, as rollouts are judged; None: it goes on.

        Args:
            scene: the latest one.
            touched: the vehicles that the ego touches in it.
        """
        if touched:
            return Happened("collision", collided_with=touched[0])
        goal = Goal(self.goal.edge, self.goal.position, self.goal.lane)
        if reached(self.network, goal, scene):
            return Happened("done", round(scene.time - self.start, 3))
        if scene.time >= self.start + self.horizon - EPSILON:
            return Happened("termination")
        return None if self._leads_there(scene) else Happened("dead")

    def _leads_there(self, scene: Scene) -> bool:
        """Whether the goal can still be reached from the road the ego is on."""
        places = self.network.locate(scene.ego.position, scene.ego.heading)
        lane = self.network.lanes[places[0].lane] if places else None
        if lane is None or lane.internal:
            return True
        if lane.edge == self.goal.edge:
            return places[0].offset <= self.goal.position
        return lane.edge in self.network.distance_to(self.goal.edge)


def drive_foil(
    world: Simulation, driver: Driver, aim: Aim, foil: Action, scene: Scene, step: float
) -> Happened:
    """What comes of a foil in SUMO, from the scene in which the driver has just decided.

    It happens in a forked process: world and driver stay as they are.

    Args:
        world: at the scene.
        driver: has decided in it.
        aim: of the decision.
        foil: is carried out to its end; then the driver goes on as it finds best.
        scene: of the decision.
        step: [s] of the simulation.

    Raises:
        ChildFailed: the driver or SUMO cannot go on.
    """
    return in_fork(lambda: _drive_on(world, driver, aim, foil, scene, step), Happened)


def _drive_on(
    world: Simulation, driver: Driver, aim: Aim, foil: Action, scene: Scene, step: float
) -> Happened:
    command = driver.carry_out(foil, scene, step).command
    while True:
        try:
            scene = world.step(command)
        except EgoGone:
            return Happened("dead")
        found = aim.come_to(scene, world.collisions())
        if found is not None:
            return found
        command = driver.step(scene, step).command
