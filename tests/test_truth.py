"""Answers on the shipped scenarios, checked number by number against their traces.

The oracle below shares no code with the causal model: it reads rollouts and predictions as they
stand in the trace.
"""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

import msgspec
import pytest

from planner.record.trace import PlanTrace, Rollout
from sim.setup import scenario
from xavi_dialogue.dialogue.explanation import Contrastive
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.service.in_process import Conversation, drive_to, make_pipeline, planner_for
from xavi_dialogue.vehicle.episode import network_of, start

pytestmark = pytest.mark.slow

SEEDS = range(10)
KMH = 3.6


@dataclass(frozen=True)
class Asked:
    """One question about one ride, at the end of its first lane change or turn."""

    seed: int
    reply: Reply
    traces: dict[str, PlanTrace]
    changed: bool  # whether the car changed lanes or turned at all

    @property
    def trace(self) -> PlanTrace:
        """The trace that the answer rests on."""
        assert self.reply.trace_id is not None
        return self.traces[self.reply.trace_id]

    @property
    def contrast(self) -> Contrastive | None:
        """What the answer compares; None of a refusal."""
        found = self.reply.explanation
        return None if found is None else msgspec.convert(found, Contrastive)


def ask(name: str, seed: int, text: str) -> Asked:
    world = scenario.load(name, seed)
    network = network_of(world)
    conversation = Conversation(make_pipeline(), planner_for(network))
    with start(world, network) as ride:
        at = drive_to(ride, conversation, None)
    reply = conversation.ask(text, at)
    dialogue = conversation.dialogue
    traces = {trace.trace_id: trace for trace in dialogue.traces}
    done = any(
        event.kind == "action-ended" and event.action in {"change-left", "exit-right"}
        for event in dialogue.events
    )
    return Asked(seed, reply, traces, done)


@pytest.fixture(scope="module")
def lane_changes() -> list[Asked]:
    text = "Why did you change left instead of continuing straight?"
    return [ask("s1", seed, text) for seed in SEEDS]


@pytest.fixture(scope="module")
def straight_on() -> list[Asked]:
    return [ask("s2", seed, "What if you had gone straight?") for seed in SEEDS]


def starting_with(trace: PlanTrace, *actions: str) -> list[Rollout]:
    return [
        rollout
        for rollout in trace.rollouts
        if tuple(step.action for step in rollout.actions)[: len(actions)] == actions
    ]


def times(trace: PlanTrace, *actions: str) -> list[float]:
    """Times [s] to the goal of the rollouts that begin so and reach it."""
    found = (rollout.components["time"] for rollout in starting_with(trace, *actions))
    return [time for time in found if time is not None]


def numbers(text: str) -> Iterator[tuple[float, str]]:
    """Every number of a sentence with the word that follows it."""
    for match in re.finditer(r"(\d+(?:\.\d+)?)(?: to (\d+(?:\.\d+)?))? ?(%|[a-z/]+)?", text):
        for value in (match[1], match[2]):
            if value is not None:
                yield float(value), match[3] or ""


def speeds(trace: PlanTrace, vehicle: int) -> list[float]:
    """Speeds [km/h] at which a vehicle holds the ego up in any rollout."""
    return [
        KMH * speed
        for rollout in trace.rollouts
        for stretch in rollout.held_up
        if stretch.vehicle == vehicle
        for speed in (stretch.speed_from, stretch.speed_to)
    ]


def chance(trace: PlanTrace, vehicle: int, actions: tuple[str, ...]) -> float:
    """How probable it is that a vehicle acts so, from its prediction."""
    (prediction,) = (p for p in trace.predictions if p.vehicle == vehicle)
    return sum(
        goal.probability * way.probability
        for goal in prediction.goals
        for way in goal.trajectories
        if set(actions) <= set(way.actions)
    )


def stated(asked: Asked) -> list[float]:
    """How probable it is that the vehicles that an answer blames do as it says, from the trace."""
    causes = () if asked.contrast is None else asked.contrast.causes
    return [chance(asked.trace, cause.vehicle, cause.actions) for cause in causes]


def test_lane_changes_are_explained_by_the_vehicle_that_cuts_in(lane_changes: list[Asked]) -> None:
    answers = [asked for asked in lane_changes if asked.reply.kind == "answer"]
    assert len(answers) >= 8
    for asked in answers:
        assert "vehicle 1" in asked.reply.text
        assert re.search(r"\b(cost us|later|longer|slower)\b", asked.reply.text)
        assert " because " in asked.reply.text
    for asked in lane_changes:
        if asked.reply.kind != "answer":  # sound only if there was no lane change, and it says so
            assert not asked.changed
            assert asked.reply.reason == "did-not-happen"


def test_the_stated_delay_is_that_of_the_rollouts(lane_changes: list[Asked]) -> None:
    for asked in lane_changes:
        explanation = asked.contrast
        if explanation is None:
            continue
        (delay,) = (e for e in explanation.effects if e.component == "time")
        fact = times(asked.trace, "change-left", "continue")
        foil = times(asked.trace, "continue")
        assert min(foil) - max(fact) - 1e-6 <= delay.delta <= max(foil) - min(fact) + 1e-6
        assert delay.delta > 0.0
        assert delay.low <= delay.delta <= delay.high
        said = [value for value, unit in numbers(asked.reply.text) if unit.startswith("second")]
        assert said
        assert all(math.isclose(value, delay.delta, abs_tol=0.51) for value in said)


def test_every_number_and_vehicle_stands_in_the_trace(lane_changes: list[Asked]) -> None:
    for asked in lane_changes:
        trace, text = asked.trace, asked.reply.text
        named = {int(name) for name in re.findall(r"vehicle (\d+)", text)}
        assert named <= set(trace.scene)
        held = [speed for vehicle in named for speed in speeds(trace, vehicle)]
        chances = [100.0 * p for p in stated(asked)]
        for value, unit in numbers(re.sub(r"vehicle \d+", "", text)):
            if unit == "km/h":
                assert min(held) - 0.51 <= value <= max(held) + 0.51
            elif unit == "%":
                assert any(abs(value - chance) <= 1.0 for chance in chances)
            else:
                assert unit.startswith("second")


def test_causes_are_as_probable_as_predicted(lane_changes: list[Asked]) -> None:
    checked = 0
    for asked in lane_changes:
        explanation = asked.contrast
        for cause in explanation.causes if explanation is not None else ():
            predicted = chance(asked.trace, cause.vehicle, cause.actions)
            assert cause.probability == pytest.approx(predicted, abs=0.02)
            checked += 1
    assert checked >= 8


def test_the_vehicle_blamed_really_slows_and_turns(lane_changes: list[Asked]) -> None:
    for asked in lane_changes:
        blamed = [s for s in asked.trace.rollouts if any(h.vehicle == 1 for h in s.held_up)]
        assert blamed, "vehicle 1 holds the ego up in no rollout of the trace"


def test_going_straight_does_not_reach_the_goal(straight_on: list[Asked]) -> None:
    for asked in straight_on:
        reply = asked.reply
        assert reply.kind == "answer", reply.text
        assert asked.contrast is not None
        assert asked.contrast.outcome is not None
        assert asked.contrast.outcome.name != "done"
        assert "destination" in reply.text
        tried = starting_with(asked.trace, "exit-straight")
        assert tried
        assert all(rollout.outcome != "done" for rollout in tried)
