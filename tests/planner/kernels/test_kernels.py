"""The compiled kernels agree with the plain ones, on scenes drawn at random."""

import math
import random

import numpy as np
import pytest

from planner.kernels import driving
from planner.kernels.along import place
from planner.kernels.collision import first_hit
from planner.kernels.limits import GAP_HORIZON
from planner.manoeuvres.actions import ActionPlan, Situation, expand
from planner.motion import forward
from planner.motion.forward import DT, Motion
from planner.motion.obstacles import HOW, NOBODY, Obstacle, Traffic, occupancy
from planner.motion.tracks import links_of
from planner.record.trace import ACTIONS
from sim.roads.network import Lane, Location, point_at, project
from tests.planner import reference
from tests.planner.worlds import SIZE, roads

SCENES = 100
HORIZON = 60
WORLDS = ("s1", "s2", "s3")

scenes = pytest.mark.parametrize("seed", range(SCENES))


class Scene:
    """A vehicle with something to do, among others that drive along lanes, more or less."""

    def __init__(self, seed: int) -> None:
        self.rng = random.Random(seed)
        self.roads = roads(WORLDS[seed % len(WORLDS)])
        self.lanes = [lane for lane in self.roads.network.lanes.values() if not lane.internal]
        self.plan, self.start = self._task()
        self.first = self.rng.choice((0, 0, 7))
        self.obstacles = [self._obstacle(k + 1) for k in range(self.rng.randint(1, 6))]
        self.traffic = Traffic.of(self.obstacles)

    def _task(self) -> tuple[ActionPlan, Motion]:
        while True:
            lane = self.rng.choice(self.lanes)
            offset = max(0.0, lane.length - self.rng.uniform(0.0, 50.0))
            position, heading = point_at(lane.centreline, offset)
            speed = self.rng.uniform(0.0, 13.0)
            here = Situation(0.0, position, heading, speed, 0.0, Location(lane.id, offset, 0.0))
            plan = expand(self.roads, here, self.rng.choice(ACTIONS), None, 100.0)
            if isinstance(plan, ActionPlan):
                self.near = position
                return plan, Motion(0.0, speed, 0.0)

    def _near(self) -> list[Lane]:
        """The lanes that pass within 40 m of the vehicle."""
        return [
            lane
            for lane in self.lanes
            if abs(project(lane.centreline, self.near)[1]) < 20.0
            or min(math.dist(point, self.near) for point in lane.centreline) < 40.0
        ]

    def _obstacle(self, vehicle: int) -> Obstacle:
        """Another vehicle: near us, along the lanes, aside of them or across."""
        lane = self.rng.choice(self._near())
        links = self.roads.network.links_from(lane.id)
        row = (lane.id,)
        if links:
            link = self.rng.choice(links)
            row = (lane.id, *link.via, link.to_lane)
        line, before = self.roads.line(row), lane.length
        arc, speed = max(0.0, before - self.rng.uniform(0.0, 50.0)), self.rng.uniform(0.0, 12.0)
        slowing = self.rng.choice((0.0, 0.5, -1.0, -2.0))
        aside, turned = self.rng.gauss(0.0, 0.5), self.rng.choice((0.0, 0.0, 0.1, 1.5))
        states = []
        for _ in range(HORIZON + 1):
            (x, y), heading = line.pose(min(arc, line.length))
            states.append((x + aside, y - aside, heading + turned, speed))
            speed = max(0.0, speed + slowing * DT)
            arc += speed * DT
        table = np.array(states)
        if self.rng.random() < 0.2:
            table[self.rng.randrange(HORIZON) :, 0] = np.nan  # it leaves the network
        length, width = self.rng.choice(((4.8, 1.8), (12.0, 2.5)))
        return Obstacle(
            vehicle,
            length,
            width,
            table[:, :2],
            table[:, 2],
            table[:, 3],
            links_of(self.roads, row),
        )


@scenes
def test_a_path_is_occupied_alike(seed: int) -> None:
    scene = Scene(seed)
    path = scene.plan.path
    fast = occupancy(path, scene.traffic, SIZE[1], scene.first, HORIZON + GAP_HORIZON).stretches
    for m, obstacle in enumerate(scene.obstacles):
        plain = reference.occupancy(path, obstacle, SIZE, scene.first, HORIZON + GAP_HORIZON)
        there = ~np.isnan(plain._low)
        np.testing.assert_allclose(fast.low[m], plain._low, atol=1e-6)
        np.testing.assert_allclose(fast.high[m], plain._high, atol=1e-6)
        np.testing.assert_allclose(fast.wide_low[m], plain._wide_low, atol=1e-6)
        np.testing.assert_allclose(fast.wide_high[m], plain._wide_high, atol=1e-6)
        np.testing.assert_allclose(fast.along[m][there], np.array(plain._along)[there], atol=1e-9)
        np.testing.assert_array_equal(fast.entered[m], plain._entered)
        assert fast.last[m] == plain.last
        assert fast.top[m] == pytest.approx(plain.top)


@scenes
def test_a_plan_is_driven_alike(seed: int) -> None:
    scene = Scene(seed)
    fast = forward.drive(scene.plan, scene.start, scene.first, scene.traffic, SIZE, HORIZON)
    plain = reference.drive(scene.plan, scene.start, scene.first, scene.obstacles, SIZE, HORIZON)
    motions = np.array([(m.arc, m.speed, m.acceleration) for m in plain.motions])
    np.testing.assert_allclose(fast.motion, motions, atol=1e-6)
    assert fast.finished == plain.finished
    assert fast.goal_time == pytest.approx(plain.goal_time)
    held = fast.hindrances
    assert held.step.tolist() == [h.step for h in plain.hindrances]
    assert held.vehicle.tolist() == [h.vehicle for h in plain.hindrances]
    assert [HOW[k] for k in held.how] == [h.how for h in plain.hindrances]
    np.testing.assert_allclose(held.speed, [h.speed for h in plain.hindrances])


@scenes
@pytest.mark.parametrize("careless", [False, True])
def test_a_collision_is_found_alike(seed: int, careless: bool) -> None:
    scene = Scene(seed)
    path = scene.plan.path
    free = forward.drive(scene.plan, scene.start, scene.first, NOBODY, SIZE, HORIZON)
    own, _ = place(path.points, path.arc, path.heading, path.curvature, free.motion, SIZE[0])
    fast = first_hit(
        own, SIZE, scene.first, scene.traffic.states, scene.traffic.sizes, careless, 0.0
    )
    assert fast == reference.first_hit(own, SIZE, scene.first, scene.obstacles, careless)


def test_the_scenes_hold_all_that_can_happen() -> None:
    """The comparison is worth something: every kind of hold-up and collisions occur."""
    hows, hits = set(), 0
    for seed in range(SCENES):
        scene = Scene(seed)
        driven = forward.drive(scene.plan, scene.start, scene.first, scene.traffic, SIZE, HORIZON)
        hows |= {HOW[k] for k in driven.hindrances.how}
        path = scene.plan.path
        free = forward.drive(scene.plan, scene.start, scene.first, NOBODY, SIZE, HORIZON).motion
        own, _ = place(path.points, path.arc, path.heading, path.curvature, free, SIZE[0])
        states, sizes = scene.traffic.states, scene.traffic.sizes
        hits += first_hit(own, SIZE, scene.first, states, sizes, False, 0.0)[1] >= 0
    assert hows == set(HOW)
    assert hits >= 5


def test_the_kernels_are_compiled() -> None:
    assert driving.drive.signatures
