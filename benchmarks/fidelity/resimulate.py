"""Re-simulation: SUMO runs on from a decision while the ego carries out a plan."""

from collections.abc import Sequence
from dataclasses import dataclass

import msgspec

from benchmarks.drive.monitor import reached
from benchmarks.fidelity.forking import in_fork
from planner.driving.driver import Driver, DriverError, DriveStep
from planner.record.trace import Action, EgoGoal, Outcome, PlanTrace
from sim.roads.network import Network
from sim.scene import Scene
from sim.setup.goal import Goal
from sim.sumo import EgoGone, Simulation

EPSILON = 1e-6  # [s]
PATIENCE = 45.0  # [s] from a decision, after which a drive is ended without arrival


class Happened(msgspec.Struct, frozen=True):
    """The result of a drive from a decision on."""

    outcome: Outcome
    time: float | None = None  # [s] from the decision to the place aimed for, if reached
    collided_with: int | None = None
    arrived: float | None = None  # [s] from the decision to the destination
    carried: int = 0  # actions of the plan that were begun, including the first


@dataclass(frozen=True)
class Aim:
    """The goal and the horizon of a decision's rollouts, and the destination."""

    network: Network
    goal: EgoGoal  # or the waypoint
    destination: EgoGoal
    start: float  # [s] of the decision
    horizon: float  # [s]

    @classmethod
    def of(cls, network: Network, trace: PlanTrace) -> "Aim":
        """Return the aim of a decision."""
        goal = trace.goal if trace.waypoint is None else trace.waypoint
        return cls(network, goal, trace.goal, trace.sim_time, trace.settings.horizon)

    def come_to(self, scene: Scene, touched: tuple[int, ...]) -> Happened | None:
        """Return the result of a drive at a scene, judged like rollouts; None: it goes on.

        Args:
            scene: the latest one.
            touched: the vehicles that the ego touches in it.
        """
        if touched:
            return Happened("collision", collided_with=touched[0])
        if self._at(self.goal, scene):
            return Happened("done", round(scene.time - self.start, 3))
        if scene.time >= self.start + self.horizon - EPSILON:
            return Happened("termination")
        return None if self._leads_there(scene) else Happened("dead")

    def arrived(self, scene: Scene) -> float | None:
        """Return the time [s] since the decision if the ego is at the destination, else None."""
        there = self._at(self.destination, scene)
        return round(scene.time - self.start, 3) if there else None

    def over(self, scene: Scene) -> bool:
        """Check whether the time to wait for the arrival is over."""
        return scene.time >= self.start + PATIENCE - EPSILON

    def _at(self, goal: EgoGoal, scene: Scene) -> bool:
        return reached(self.network, Goal(goal.edge, goal.position, goal.lane), scene)

    def _leads_there(self, scene: Scene) -> bool:
        """Check whether the goal can still be reached from the road the ego is on."""
        places = self.network.locate(scene.ego.position, scene.ego.heading)
        lane = self.network.lanes[places[0].lane] if places else None
        if lane is None or lane.internal:
            return True
        if lane.edge == self.goal.edge:
            return places[0].offset <= self.goal.position
        return lane.edge in self.network.distance_to(self.goal.edge)


def drive_foil(
    world: Simulation, driver: Driver, aim: Aim, plan: Sequence[Action], scene: Scene, step: float
) -> Happened:
    """Return the result of a plan in SUMO, from the scene in which the driver has just decided.

    This happens in a forked process; world and driver stay unchanged.

    Args:
        world: at the scene.
        driver: has decided in it.
        aim: of the decision.
        plan: its actions are carried out to their ends, one after the other, as long as they
            apply; then the driver goes on as it finds best.
        scene: of the decision.
        step: [s] of the simulation.

    Raises:
        ChildFailed: the driver or SUMO cannot go on.
    """
    return in_fork(lambda: _drive_on(world, driver, aim, plan, scene, step), Happened)


def _drive_on(
    world: Simulation, driver: Driver, aim: Aim, plan: Sequence[Action], scene: Scene, step: float
) -> Happened:
    command = driver.carry_out(plan[0], scene, step).command
    rest, carried = list(plan[1:]), 1
    found: Happened | None = None
    while True:
        try:
            scene = world.step(command)
        except EgoGone:
            return msgspec.structs.replace(found or Happened("dead"), carried=carried)
        touched = world.collisions()
        found = found or aim.come_to(scene, touched)
        arrived = aim.arrived(scene)
        if found is not None and (arrived is not None or touched or _ends(found, aim, scene)):
            return msgspec.structs.replace(found, arrived=arrived, carried=carried)
        driven = driver.step(scene, step)
        if rest and driven.trace is not None and driven.trace.under_way is None:
            driven = _next(driver, rest, driven, scene, step)
            carried += bool(rest)
            rest = rest[1:]
        command = driven.command


def _ends(found: Happened, aim: Aim, scene: Scene) -> bool:
    """Check whether a drive with a result need not go on to the destination."""
    return aim.over(scene) or (found.outcome == "dead" and aim.goal == aim.destination)


def _next(
    driver: Driver, rest: list[Action], driven: DriveStep, scene: Scene, step: float
) -> DriveStep:
    """Begin the next action of a plan; if it does not apply, empty the plan in place."""
    try:
        return driver.carry_out(rest[0], scene, step)
    except DriverError:
        rest.clear()
        return driven
