"""Parts of the search: what it draws, what options cost, and what it compares."""

import math
import random
from dataclasses import replace

import numpy as np
import pytest
from msgspec.structs import replace as replace_struct

from planner.manoeuvres.actions import ActionPlan
from planner.motion.obstacles import Motions
from planner.record.hidden_record import Phantom, PhantomSample
from planner.record.light_record import LightCourse, LightPrediction, LightSample, Showing
from planner.record.trace import Action, EgoGoal, Sample, Settings
from planner.roads.trajectory import Roads
from planner.rollouts.rollout import Task
from planner.search.comparison import draw, likeliest, source_of, weighted
from planner.search.inputs import Root
from planner.search.mcts import Search
from planner.traffic_lights.signals import Outlook
from tests.planner.drives import SIZE
from tests.planner.hidden_areas.test_hidden import ROADS as HIDDEN_ROADS
from tests.planner.nets import drawn, lane, on_lane
from tests.planner.search.test_comparison import STILL, beliefs
from tests.planner.search.test_search_drawn import CORNER, ROAD, ran, search
from tests.planner.worlds import run


def light(name: str, *chances: float) -> LightPrediction:
    """A controller with courses of these probabilities."""
    courses = tuple(LightCourse(p, (Showing(0.0, "G"),)) for p in chances)
    return LightPrediction(name, (0,), (Showing(-5.0, "G"),), courses)


def phantom(probability: float) -> Phantom:
    return Phantom(
        ("south_0", ":J_1"), 0.0, 30.0, (108.0, -16.0), math.pi / 2.0, 14.0, 10.0, 30.0, 0.1,
        probability, "J", 1, (0,), (5.0,),
    )  # fmt: skip


LIGHTS = Outlook(0.0, (light("A", 0.2, 0.8), light("sure", 1.0), light("B", 0.5, 0.3, 0.2)))
HIDDEN = (phantom(0.25), phantom(0.9))
KNOWN = {4: beliefs([0.7], [0.2, 0.1])}
SOURCES = (4, "A", "B", source_of(0), source_of(1))


def sources(seed: str = "") -> dict[int | str, random.Random]:
    return {name: random.Random(f"{seed}/{name}") for name in SOURCES}


def test_each_draw_is_of_road_users_then_lights_then_phantoms() -> None:
    one = draw(KNOWN, sources(), LIGHTS, HIDDEN)
    user, *lights, first, second = one
    assert isinstance(user, Sample)
    assert user.vehicle == 4
    # One whose course is certain is not drawn.
    assert [x.controller for x in lights if isinstance(x, LightSample)] == ["A", "B"]
    assert isinstance(first, PhantomSample)
    assert isinstance(second, PhantomSample)
    assert (first.phantom, second.phantom) == (0, 1)


def test_lights_and_phantoms_are_drawn_by_their_chances() -> None:
    rngs = sources()
    found = [draw(KNOWN, rngs, LIGHTS, HIDDEN) for _ in range(2000)]
    expected = {
        LightSample("A", 0): 0.2, LightSample("A", 1): 0.8, LightSample("B", 0): 0.5,
        LightSample("B", 2): 0.2, PhantomSample(0, True): 0.25, PhantomSample(1, True): 0.9,
        PhantomSample(1, False): 0.1,
    }  # fmt: skip
    for sample, chance in expected.items():
        assert sum(sample in one for one in found) / 2000 == pytest.approx(chance, abs=0.04)


@pytest.mark.parametrize("other", SOURCES)
def test_each_is_drawn_by_a_generator_of_its_own(other: int | str) -> None:
    """With another generator for one, only its own draws change."""
    plain, changed = sources(), sources()
    changed[other] = random.Random("another")
    rows = [[draw(KNOWN, rngs, LIGHTS, HIDDEN) for _ in range(60)] for rngs in (plain, changed)]
    parts = [list(zip(*row, strict=True)) for row in rows]
    differ = [a != b for a, b in zip(*parts, strict=True)]
    assert differ == [name == other for name in SOURCES]


def test_joint_samples_of_lights_and_phantoms_come_likeliest_first() -> None:
    found = list(likeliest(KNOWN, LIGHTS, HIDDEN))
    assert len(found) == 3 * 2 * 3 * 2 * 2
    samples, chance = found[0]
    assert samples == (
        Sample(4, 0, 0), LightSample("A", 1), LightSample("B", 0), PhantomSample(0, False),
        PhantomSample(1, True),
    )  # fmt: skip
    assert chance == pytest.approx(0.7 * 0.8 * 0.5 * 0.75 * 0.9)
    assert sum(p for _, p in found) == pytest.approx(1.0)
    common = weighted(KNOWN, [], 200, LIGHTS, HIDDEN)
    assert common[0][0] == samples
    assert sum(weight for _, weight in common) == pytest.approx(1.0)


@pytest.mark.parametrize(("chance", "comes"), [(0.0, [False]), (1.0, [True])])
def test_what_a_phantom_never_does_is_left_out(chance: float, comes: list[bool]) -> None:
    found = [one for samples, _ in likeliest({}, phantoms=(phantom(chance),)) for one in samples]
    assert found == [PhantomSample(0, it) for it in comes]


def test_a_course_of_no_probability_is_left_out() -> None:
    found = [s for s, _ in likeliest({}, Outlook(0.0, (light("A", 0.0, 0.4, 0.6),)))]
    assert found == [(LightSample("A", 2),), (LightSample("A", 1),)]


def test_a_search_draws_each_by_its_seed_and_name() -> None:
    one = search(ROAD, "road", 300.0, 100.0)
    drawing = Search(one.task, one.root, KNOWN, one.settings, "seed", LIGHTS, HIDDEN)
    assert set(drawing._draws) == set(SOURCES)
    told = {name: rng.random() for name, rng in drawing._draws.items()}
    assert len(set(told.values())) == len(SOURCES)
    again = Search(one.task, one.root, {}, one.settings, "seed", LIGHTS)
    assert {name: rng.random() for name, rng in again._draws.items()} == {
        name: told[name] for name in ("A", "B")
    }


def plan_at(one: Search, action: Action) -> ActionPlan:
    plan = one._expand((action,), [])
    assert isinstance(plan, ActionPlan)
    return plan


def test_options_cost_their_time_their_effort_and_the_way_that_is_left() -> None:
    """From x = 100 m at 10 m/s, it is 20 s to the goal."""
    one = search(ROAD, "road", 300.0, 100.0)
    assert one._invites(plan_at(one, "continue")) == pytest.approx(20.0)
    change = plan_at(one, "change-left")
    assert one._invites(change) == pytest.approx(1.0 + 20.0, abs=0.1)
    # The goal is what ends it.
    near = search(ROAD, "road", 300.0, 285.0)
    assert near._invites(plan_at(near, "continue")) == pytest.approx(1.5)
    right = search(CORNER, "south", 100.0, 60.0)
    turn = plan_at(right, "exit-right")
    assert right._invites(turn) == pytest.approx(
        turn.end / 13.0 + (100.0 - (turn.end - 40.0 - 8.0 * math.pi / 2.0)) / 13.0, abs=0.1
    )


@pytest.mark.parametrize(("limit", "first"), [(11.0, "continue"), (25.0, "change-left")])
def test_a_change_to_a_faster_lane_is_tried_first_if_that_pays_for_the_effort(
    limit: float, first: Action
) -> None:
    lanes = [
        lane(f"road_{k}", [(0.0, 3.5 * k), (600.0, 3.5 * k)], fast)
        for k, fast in enumerate((10.0, limit))
    ]
    one = ran(search(drawn(lanes), "road", 300.0, 100.0, rollouts=3))
    plans = {action: one._invites(plan_at(one, action)) for action in ("continue", "change-left")}
    assert plans["change-left"] - 1.0 < plans["continue"]
    assert one.rollouts[0].actions[0] == first


def single(length: float = 600.0) -> Roads:
    """A straight road with one lane."""
    return drawn([lane("road_0", [(0.0, 0.0), (length, 0.0)], 10.0)])


def test_two_first_actions_are_compared() -> None:
    one = ran(search(single(), "road", 300.0, 100.0, rollouts=6))
    assert list(one.compared) == ["continue", "stop"]
    assert one.compared["continue"] == pytest.approx(-20.0)
    assert [r.weight for r in one.rollouts if r.weight is not None] == [1.0, 1.0]
    assert one.plan()[0].value == pytest.approx(one.compared["continue"])


def test_after_a_first_action_the_tree_says_how_to_go_on() -> None:
    one = search(ROAD, "road", 300.0, 100.0)
    one.tree.back_up(("stop", "change-left"), -3.0)
    one.tree.back_up(("stop", "continue"), -9.0)
    one.tree.back_up(("continue",), -1.0)
    choose = one._greedily("stop")
    assert choose((), ("continue", "stop")) == "stop"
    assert choose(("stop",), ("continue", "change-left")) == "change-left"
    assert choose(("stop",), ("continue",)) == "continue"
    assert choose(("change-left",), ("stop", "continue")) == "stop"


def test_where_nothing_applies_a_rollout_is_lost() -> None:
    """At the end of the road there is nothing left to do."""
    roads = single(200.0)
    one = search(roads, "road", 100.0, 199.9)
    known = one._options((), (), [])
    assert known[0].keys() == set(known[1])
    blocked = search(roads, "road", 100.0, 100.0)
    blocked._options = lambda *_: ({}, ())  # type: ignore[method-assign]
    run(blocked)
    assert {r.outcome for r in blocked.rollouts} == {"dead"}
    assert {r.actions for r in blocked.rollouts} == {()}
    assert blocked.compared == {}


def test_the_others_drive_as_they_were_drawn() -> None:
    """Each takes its way to its goal, and a phantom is there only if it comes."""
    (first, second) = beliefs([0.7], [0.2, 0.1])
    paced = tuple(
        replace(way, motions=Motions(replace(STILL, vehicle=4, speed=np.array([float(k)]))))
        for k, way in enumerate(second.trajectories, start=5)
    )
    known = {4: (first, replace(second, trajectories=paced))}
    task = Task(HIDDEN_ROADS, EgoGoal("out", 60.0, None), SIZE, 0.0, 20, 100.0)
    here = on_lane(HIDDEN_ROADS, "in_0", 60.0, 10.0)
    coming = replace_struct(phantom(0.5), lanes=("south_0", ":J_1", "north_0"))
    one = Search(task, Root(here), known, Settings(), "seed", phantoms=(phantom(0.1), coming))
    for k, speed in enumerate((5.0, 6.0)):
        found = one._traffic((Sample(4, 1, k), PhantomSample(0, False), PhantomSample(1, False)))
        assert found.vehicles == (4,)
        assert found.states[0, 0, 3] == speed
    with_it = (Sample(4, 1, 1), PhantomSample(0, False), PhantomSample(1, True))
    found = one._traffic(with_it)
    assert found.vehicles == (4, -2)
    assert found.states[1, 0, 1] < found.states[1, 5, 1] < 6.0  # from the south
    assert one._traffic(with_it) is found
