"""Legs among others that react, among phantoms, and those that time ends."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from planner.motion.forward import DT, Motion
from planner.motion.obstacles import Obstacle, Traffic
from planner.record.trace import Action, EgoGoal
from planner.rollouts.rollout import Leg, Task, take
from tests.planner.drives import LENGTH, WIDTH, corner, crossing, standing
from tests.planner.nets import on_lane
from tests.planner.rollouts.test_legs import at, leg, plan_of, task

STEPS = 400


def moving(x: float, speed: float, y: float = 0.0, vehicle: int = 3) -> Obstacle:
    """A vehicle that keeps its speed [m/s]."""
    place = np.column_stack((x + speed * DT * np.arange(STEPS), np.full(STEPS, y)))
    return Obstacle(
        vehicle, LENGTH, WIDTH, place, np.zeros(STEPS), np.full(STEPS, speed), frozenset()
    )


class Answers:
    """How others answer to what we drive, as told beforehand."""

    def __init__(self, patch: pytest.MonkeyPatch, answer: Obstacle) -> None:
        self.asked: list[np.ndarray] = []
        self.answer = replace(Traffic.of([answer]), braking=np.array([True]))
        patch.setattr(Traffic, "reacting", self._reacting)

    def _reacting(self, states: np.ndarray, *_: object) -> Traffic:
        self.asked.append(states)
        return self.answer


REACTING = replace(task(), reacting=True)
FREE = leg(task(), at(100.0, 10.0), "continue")


def test_who_brakes_ahead_because_of_us_is_stopped_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    answers = Answers(monkeypatch, standing(180.0, vehicle=3))
    found = leg(REACTING, at(100.0, 10.0), "continue", Traffic.of([moving(180.0, 10.0)]))
    assert found.speed[-1] == pytest.approx(0.0, abs=0.3)
    assert found.end.location.offset < 180.0 - LENGTH
    assert set(found.hindrances.vehicle.tolist()) == {3}
    assert found.traffic is answers.answer
    # What we then do is what they answer to.
    first, second = answers.asked
    assert first[-1, 0] > 250.0
    assert second[-1, 0] == pytest.approx(found.end.location.offset, abs=LENGTH)


def test_who_brakes_behind_because_of_us_changes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    answers = Answers(monkeypatch, standing(60.0, vehicle=3))
    found = leg(REACTING, at(100.0, 10.0), "continue", Traffic.of([moving(60.0, 9.0)]))
    assert found.position.tolist() == FREE.position.tolist()
    assert found.traffic is answers.answer
    assert len(answers.asked) == 1


def test_nobody_answers_unless_others_react(monkeypatch: pytest.MonkeyPatch) -> None:
    answers = Answers(monkeypatch, standing(180.0, vehicle=3))
    traffic = Traffic.of([moving(180.0, 10.0)])
    found = leg(task(), at(100.0, 10.0), "continue", traffic)
    assert found.outcome == "done"
    assert found.traffic is traffic
    assert answers.asked == []


def test_those_who_do_not_brake_need_no_second_look() -> None:
    traffic = Traffic.of([moving(250.0, 10.0)])
    found = leg(REACTING, at(100.0, 10.0), "continue", traffic)
    assert found.position.tolist() == FREE.position.tolist()
    assert found.traffic.braking.tolist() == [False]


@pytest.mark.parametrize(("vehicle", "outcome"), [(-1, "done"), (3, "collision")])
def test_a_phantom_never_collides(vehicle: int, outcome: str) -> None:
    # It shoots across our way from the side, too fast for either to brake.
    place = np.column_stack((np.full(STEPS, 160.0), -110.0 + 20.0 * DT * np.arange(STEPS)))
    north, fast = np.full(STEPS, np.pi / 2.0), np.full(STEPS, 20.0)
    through = Obstacle(vehicle, 20.0, WIDTH, place, north, fast, frozenset())
    others: Sequence[Obstacle] = (moving(20.0, 5.0, y=30.0, vehicle=7), through)
    found = leg(task(), at(100.0, 10.0), "continue", Traffic.of(others))
    assert (found.outcome, found.collided_with) == (
        outcome, vehicle if outcome == "collision" else None
    )  # fmt: skip


def cut_off(action: Action, edge: str, x: float = 60.0, steps: int = 10) -> Leg:
    """A leg towards a fork that time ends on the way."""
    frame = task(corner(), EgoGoal(edge, 100.0, None), steps)
    return leg(frame, on_lane(frame.roads, "in_0", x, 8.0), action)


@pytest.mark.parametrize(
    ("action", "edge", "outcome"),
    [
        ("exit-right", "south", "termination"), ("exit-right", "on", "dead"),
        ("continue", "on", "termination"), ("stop", "on", "termination"),
    ],
)  # fmt: skip
def test_when_time_is_up_the_way_that_was_taken_must_lead_to_the_goal(
    action: Action, edge: str, outcome: str
) -> None:
    assert cut_off(action, edge).outcome == outcome


def test_what_was_not_driven_in_time_is_left_by_lane() -> None:
    found = cut_off("exit-right", "south")
    assert [lane for lane, _ in found.ahead] == ["in_0", ":R_0", "south_0"]
    first, bend, last = (length for _, length in found.ahead)
    assert first == pytest.approx(100.0 - found.end.location.offset, abs=0.05)
    assert bend == pytest.approx(8.0 * np.pi / 2.0, abs=0.1)
    frame = task(corner(), EgoGoal("south", 100.0, None), 10)
    plan = plan_of(frame, on_lane(frame.roads, "in_0", 60.0, 8.0), "exit-right")
    assert first + bend + last == pytest.approx(plan.end - (found.end.location.offset - 60.0))
    inside = cut_off("exit-right", "south", x=95.0, steps=8)
    assert [lane for lane, _ in inside.ahead] == [":R_0", "south_0"]
    assert 0.0 < inside.ahead[0][1] < bend


def test_nothing_is_left_of_what_stops_or_reaches_the_goal() -> None:
    assert cut_off("stop", "on").ahead == ()
    found = leg(task(horizon=20), at(100.0, 10.0), "continue")
    assert (found.outcome, found.ahead) == ("termination", ())
    assert turned().ahead == ()


def turned() -> Leg:
    """A leg that is over in time."""
    return cut_off("exit-right", "south", x=95.0, steps=150)


def test_a_hidden_road_is_approached_slowly_and_the_steps_told() -> None:
    frame = Task(
        crossing(limit=15.0), EgoGoal("out", 60.0, None), (LENGTH, WIDTH), 50.0, 150, 100.0
    )
    here = on_lane(frame.roads, "in_0", 40.0, 15.0)
    plan = plan_of(frame, here, "exit-straight")
    (line,) = plan.give_ways
    key = (line.link.junction, line.link.index)
    slow = replace(frame, slow={key: 1.0})
    start = Motion(0.0, 15.0, 0.0)
    free, careful = (take(x, plan, start, 5, Traffic.of(())) for x in (frame, slow))
    assert free.careful == ()
    assert {k for k, _ in careful.careful} == {key}
    steps = [step for _, step in careful.careful]
    assert min(steps) >= 5
    assert np.min(careful.speed) < np.min(free.speed) - 2.0
    assert all(careful.position[step - 5, 0] < 105.0 for step in steps)
    other = replace(frame, slow={("elsewhere", 3): 1.0})
    elsewhere = take(other, plan, start, 5, Traffic.of(()))
    assert elsewhere.speed.tolist() == free.speed.tolist()
    assert elsewhere.careful == ()
