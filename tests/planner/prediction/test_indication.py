"""What indicators say of where a vehicle goes."""

from dataclasses import replace

import pytest

from planner.motion.tracks import Side
from planner.prediction.goals import goals_in_view
from planner.prediction.indication import indicated
from sim.scene import VehicleState
from tests.planner.prediction.test_recognise import beliefs, probability
from tests.planner.worlds import VIEW, Seen, before_end, roads, situation, still

NEAR, FAR = 15.0, 80.0  # [m] before the junction


def shown(name: str, lane: str, distance: float, *lights: str) -> dict[str, float]:
    """How probable lights are for each goal of a vehicle at a distance [m] before a junction."""
    at = before_end(name, lane, distance)
    here = situation(name, lane, at)
    goals = goals_in_view(roads(name), (here,), VIEW)
    sides: frozenset[Side] = frozenset(s for s in ("left", "right") if s in lights)
    seen = _Watched(sides)
    found = indicated(roads(name), seen, here, goals, VIEW)  # type: ignore[arg-type]
    return {goal.kind: share for goal, share in zip(goals, found, strict=True)}


class _Watched:
    """Of a vehicle, what recognition reads its indicators from."""

    def __init__(self, indicating: frozenset[Side]) -> None:
        self.indicating = indicating


def lit(seen: Seen, *lights: str) -> Seen:
    state: VehicleState = replace(seen.state, signals=lights)
    return replace(seen, state=state)


def test_who_indicates_left_will_most_likely_turn_left() -> None:
    west = still("s2", ("west_in_0",), before_end("s2", "west_in_0", NEAR))
    dark = beliefs("s2", {1: west})[1]
    left = beliefs("s2", {1: lit(west, "left")})[1]
    right = beliefs("s2", {1: lit(west, "right")})[1]
    assert probability(left, "exit-left") > 0.9
    assert probability(right, "exit-left") < 0.1 < probability(right, "exit-right")
    assert probability(dark, "exit-left") < probability(left, "exit-left")


def test_the_brake_light_says_nothing_of_the_way() -> None:
    west = still("s2", ("west_in_0",), before_end("s2", "west_in_0", NEAR))
    dark, braking = beliefs("s2", {1: west})[1], beliefs("s2", {1: lit(west, "brake")})[1]
    assert [b.probability for b in dark] == [b.probability for b in braking]


def test_who_is_near_and_does_not_indicate_hardly_turns() -> None:
    near, far = shown("s2", "west_in_0", NEAR), shown("s2", "west_in_0", FAR)
    assert near["exit-left"] < far["exit-left"] < 0.5
    assert near["exit-left"] < 0.2 * near["stop"]


def test_to_a_side_with_a_lane_an_indicator_may_mean_a_lane_change() -> None:
    """On the left lane of s1, the right indicator may be for the right lane or for the exit."""
    left_lane = shown("s1", "main_in_1", FAR, "right")
    right_lane = shown("s1", "main_in_0", FAR, "right")
    assert left_lane["continue"] > 3.0 * right_lane["continue"]
    assert left_lane["exit-right"] == right_lane["exit-right"]


@pytest.mark.parametrize("lights", [("left", "right"), ("left", "right", "brake")])
def test_hazard_lights_and_roundabouts_say_nothing(lights: tuple[str, ...]) -> None:
    assert set(shown("s2", "west_in_0", NEAR, *lights).values()) == {1.0}
    ring = next(name for name in roads("s3").network.lanes if name.startswith("south_in"))
    assert set(shown("s3", ring, NEAR, "right").values()) == {1.0}


@pytest.mark.parametrize("lights", [(), ("left",), ("right",)])
def test_shares_are_probabilities(lights: tuple[str, ...]) -> None:
    for distance in (NEAR, FAR):
        for name, lane in (("s1", "main_in_0"), ("s1", "main_in_1"), ("s2", "west_in_0")):
            assert all(0.0 < p < 1.0 for p in shown(name, lane, distance, *lights).values())


def test_what_those_with_a_goal_show_sums_to_one() -> None:
    """Where there is no lane beside, the three lights that can be shown share all of them."""
    for distance in (NEAR, FAR):
        cases = [
            shown("s2", "west_in_0", distance, *lights) for lights in ((), ("left",), ("right",))
        ]
        for kind in cases[0]:
            assert sum(case[kind] for case in cases) == pytest.approx(1.0)
