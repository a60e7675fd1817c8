"""What could be asked: it comes from what happened, is understood, and has an answer."""

import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import replace

from planner.record.events import Event
from planner.record.trace import PlanTrace
from sim.roads.netfile import read_network
from sim.roads.network import Network
from tests.dialogue.talking import PIPELINE, driven, ride
from tests.stories import rides
from tests.traces import s1_ride, straight_track
from xavi_dialogue.dashboard.suggestions import MOST, suggestions
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.service.in_process import Conversation, NoPlan, planner_for
from xavi_dialogue.storage import ride_file

SCENARIOS = Path(__file__).parents[2] / "sim" / "scenarios"
RIDES = ("s1-0", "s2-0", "s3-0", "s4-0", "town-0", "motorway-0", "bend-0")
STEP = 3.1  # [s]


@cache
def network(scenario: str) -> Network | None:
    path = SCENARIOS / scenario / f"{scenario}.net.xml"
    return read_network(path) if path.exists() else None


def conversation(name: str) -> Conversation:
    """With the plans that were recorded, and the planner for all others."""
    known, roads = ride(name), network(name.partition("-")[0])

    def again(trace: PlanTrace, need: NeedRollout) -> PlanTrace:
        found = known.whatifs.get(ride_file.key(need))
        if found is not None:
            return found
        if roads is None:
            raise NoPlan("planner-unavailable")
        return planner_for(roads)(trace, need)

    return Conversation(PIPELINE, again, driven(name))


def moments(name: str) -> list[float]:
    last = ride(name).ended or ride(name).traces[-1].sim_time
    return [round(float(time), 2) for time in np.arange(0.5, last + STEP, STEP)]


def suggested(name: str, at: float) -> tuple[str, ...]:
    before = [trace for trace in ride(name).traces if trace.sim_time <= at]
    return suggestions(before[-1], ride(name).events, at)


@pytest.mark.parametrize("name", RIDES)
def test_nearly_all_that_is_suggested_has_an_answer(name: str) -> None:
    asked, refused = 0, []
    for at in moments(name):
        for text in suggested(name, at):
            reply = conversation(name).ask(text, at)
            asked += 1
            if reply.kind != "answer":
                refused.append((at, text, reply.text))
    assert asked >= 3 * len(moments(name))
    assert len(refused) <= 0.05 * asked, refused


@pytest.mark.parametrize("name", RIDES)
def test_suggestions_are_few_and_understood_and_never_about_ourselves_as_a_vehicle(
    name: str,
) -> None:
    for at in moments(name):
        found = suggested(name, at)
        assert 3 <= len(found) <= MOST
        assert len(set(found)) == len(found)
        seen = frozenset(v for t in ride(name).traces if t.sim_time <= at for v in t.scene)
        for text in found:
            [best, *_] = PIPELINE.read(text)
            assert best.acts, text
            assert not best.unknown, text
            named = {int(number) for number in re.findall(r"vehicle (\d+)", text)}
            assert named <= seen - {0}


def test_before_the_first_decision_there_is_nothing_to_ask() -> None:
    assert suggestions(None, (), 0.0) == ()


def test_a_lane_change_invites_why_and_what_if_not() -> None:
    told = s1_ride()
    found = suggestions(told.traces[-1], told.events, 7.0)
    assert found[:2] == ("Why did you move to the left lane?", "What if you had gone straight on?")


def test_what_is_yet_to_come_or_long_past_invites_nothing() -> None:
    told = s1_ride()
    for at in (3.0, 60.0):
        found = suggestions(told.traces[-1], told.events, at)
        assert not any("left lane" in text for text in found)
        assert len(found) >= 3


def test_a_lane_change_that_was_given_up_invites_nothing() -> None:
    told = s1_ride()
    events = (
        Event("action-started", 4.0, "change-left", 4),
        Event("action-ended", 5.0, "change-left", 4),
    )
    assert not any("left lane" in text for text in suggestions(told.traces[-1], events, 7.0))


def test_giving_way_and_stopping_are_asked_about() -> None:
    trace = s1_ride().traces[-1]
    track = straight_track(7.0, 0, [8.0 - 0.4 * k for k in range(21)])
    halted = replace(trace, history={**trace.history, 0: track})
    gave = (Event("gave-way", 6.0, "exit-right", 3, 1),)
    found = suggestions(halted, gave, 7.0)
    assert found[:2] == ("Why did you give way?", "Why did you stop?")


def test_a_vehicle_that_slows_is_asked_about_and_one_that_is_hidden_is_not() -> None:
    trace = s1_ride().traces[-1]
    track = straight_track(7.0, 1, [12.0 - 0.3 * k for k in range(26)])
    slowing = replace(trace, history={**trace.history, 1: track})
    question = "Why is vehicle 1 slowing down?"
    assert question in suggestions(slowing, (), 7.0)
    assert question not in suggestions(trace, (), 7.0)
    assert question not in suggestions(replace(slowing, unseen={1: 5.0}), (), 7.0)


def test_a_collision_comes_first() -> None:
    crash = rides()["crash"]
    found = suggestions(crash.traces[-1], crash.events, crash.halt)
    assert found[0] == "How could that have been avoided?"


def test_what_the_car_said_could_be_asked_comes_after_what_has_just_happened() -> None:
    told = s1_ride()
    said = ("How fast were we going?", "Why did you move to the left lane?")
    found = suggestions(told.traces[-1], told.events, 7.0, said)
    assert found[:3] == (
        "Why did you move to the left lane?",
        "What if you had gone straight on?",
        "How fast were we going?",
    )
    assert len(set(found)) == len(found) <= MOST


def test_a_long_calm_has_questions_too() -> None:
    calm = rides()["nobody"]
    found = suggestions(calm.traces[-1], (), calm.halt)
    assert "What are you doing?" in found
    assert len(found) >= 3
