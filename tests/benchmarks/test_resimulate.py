"""Foils driven in SUMO from the very same state."""

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from benchmarks.fidelity.forking import ChildFailed, in_fork
from benchmarks.fidelity.resimulate import Aim, Happened, drive_foil
from planner.driving.driver import Driver
from planner.record.trace import Action, EgoGoal, PlanTrace
from sim.roads.network import Network
from sim.scene import Scene
from sim.setup.scenario import Scenario, load
from sim.sumo import Simulation
from xavi_dialogue.vehicle.episode import network_of, settings_of


class Halted:
    """A ride that halts at a decision."""

    def __init__(self, name: str, world: Simulation) -> None:
        self.scenario: Scenario = load(name)
        self.network: Network = network_of(self.scenario)
        wanted = self.scenario.goal
        goal = EgoGoal(wanted.edge, wanted.position, wanted.lane)
        self.world = world
        self.driver = Driver(self.network, goal, settings_of(self.scenario), 0)
        self.scene: Scene = world.scene()

    def drive_to(self, time: float) -> PlanTrace:
        """Drive up to the first decision from a time [s] on that has alternatives."""
        while True:
            step = self.driver.step(self.scene, self.scenario.step)
            found = step.trace
            if found is not None and found.under_way is None and self.scene.time >= time - 1e-6:
                return found
            self.scene = self.world.step(step.command)

    def foil(self, trace: PlanTrace, *plan: Action) -> Happened:
        """What comes of a foil."""
        aim = Aim.of(self.network, trace)
        return drive_foil(self.world, self.driver, aim, plan, self.scene, self.scenario.step)


@contextmanager
def halted(name: str) -> Iterator[Halted]:
    with Simulation(load(name, 0)) as world:
        yield Halted(name, world)


def test_work_in_a_fork_leaves_no_trace() -> None:
    kept = [1]

    def work() -> list[int]:
        kept.append(2)
        return kept

    assert in_fork(work, list[int]) == [1, 2]
    assert kept == [1]


def test_what_goes_wrong_in_a_fork_is_told() -> None:
    def work() -> int:
        raise KeyError("no such thing")

    with pytest.raises(ChildFailed, match="KeyError: 'no such thing'"):
        in_fork(work, int)


def test_foils_come_to_what_the_roads_say_and_the_ride_goes_on_as_it_was() -> None:
    with halted("s1") as ride:
        trace = ride.drive_to(3.0)
        assert trace.plan[0].action == "change-left"
        before = ride.scene
        found = {action: ride.foil(trace, action) for action in ("continue", "stop", "exit-right")}
        assert found["exit-right"] == Happened("dead", carried=1)
        slow, stopped = found["continue"].time, found["stop"].time
        assert slow is not None
        assert stopped is not None
        assert ride.world.scene() == before
        assert found["continue"].arrived == slow  # no waypoint: it is the destination
        both = ride.foil(trace, "stop", "change-left")  # the whole plan is carried out
        assert both.carried == 2
        assert both.time is not None
        assert both.time > slow
        rest = ride.foil(trace, "continue", "change-left")  # after it there is no lane to the left
        assert rest == found["continue"]
        again = ride.foil(trace, "continue")
        assert again == found["continue"]  # the same state gives the same drive
    with halted("s1") as ride:
        trace = ride.drive_to(3.0)
        aim, happened = Aim.of(ride.network, trace), None
        while happened is None:
            step = ride.driver.step(ride.scene, ride.scenario.step)
            ride.scene = ride.world.step(step.command)
            happened = aim.come_to(ride.scene, ride.world.collisions())
        assert happened.outcome == "done"
        assert happened.time is not None
        assert happened.time + 2.0 < slow < stopped


def test_two_that_wait_for_one_another_do_not_wait_forever_and_nobody_is_touched() -> None:
    with halted("s2") as ride:
        trace = ride.drive_to(3.9)
        # Past its line, the ego stops for one that goes first, which stops for the ego, while a
        # third stands so near its way that the side of the ego would touch it.
        assert ride.foil(trace, "exit-left") == Happened("dead", carried=1)
