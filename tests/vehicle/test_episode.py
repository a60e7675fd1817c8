import pytest

from planner.record.events import Event
from tests.dialogue.scripted import scripted_pipeline
from tests.fakes import FakeDriver, FakeWorld, again, s1_moments
from xavi_dialogue.service.in_process import Conversation, drive_to
from xavi_dialogue.vehicle.episode import halts, moments

CHANGE = (
    Event("action-started", 1.0, "change-left", 1),
    Event("action-committed", 1.1, "change-left", 1),
    Event("action-ended", 4.0, "change-left", 1),
)


def test_a_ride_ends_where_the_driver_arrives() -> None:
    ride = list(moments(FakeWorld(), FakeDriver(arrives_at=2.0), 0.5, 60.0))
    assert [moment.scene.time for moment in ride] == [0.0, 0.5, 1.0, 1.5, 2.0]
    assert [moment.ending for moment in ride] == [None] * 4 + ["arrived"]
    assert [event.kind for moment in ride for event in moment.events] == ["arrived"]


def test_a_ride_ends_with_its_time() -> None:
    *_, last = moments(FakeWorld(), FakeDriver(), 0.5, 1.5)
    assert (last.scene.time, last.ending) == (1.5, "duration")
    assert last.events == (Event("ended", 1.5),)


def test_a_collision_ends_a_ride_even_at_its_goal() -> None:
    *_, last = moments(FakeWorld(collides_at=2.0), FakeDriver(arrives_at=2.0), 0.5, 60.0)
    assert (last.ending, last.collisions) == ("collided", (2,))
    assert last.events == (Event("collided", 2.0, vehicle=2),)


@pytest.mark.parametrize(
    ("until", "time", "halted"),
    [(2.0, 1.9, False), (2.0, 2.0, True), (0.0, 0.0, True), (None, 3.9, False), (None, 4.0, True)],
)
def test_where_a_ride_halts(until: float | None, time: float, halted: bool) -> None:
    assert halts(until, time, CHANGE) is halted


def test_without_a_manoeuvre_a_ride_goes_to_its_end() -> None:
    given_up = (CHANGE[0], CHANGE[2])
    assert not halts(None, 60.0, given_up)


@pytest.mark.parametrize(("until", "reached"), [(None, 7.0), (4.0, 4.0), (99.0, 7.0)])
def test_driving_to_a_moment_records_all_up_to_it(until: float | None, reached: float) -> None:
    conversation = Conversation(scripted_pipeline(), again)
    at = drive_to(s1_moments(), conversation, until)
    assert at == reached
    known = conversation.dialogue
    assert all(trace.sim_time <= reached for trace in known.traces)
    assert (known.ended_at is not None) == (until != 4.0)


def test_planning_again_is_part_of_a_local_answer() -> None:
    conversation = Conversation(scripted_pipeline(), again)
    drive_to(s1_moments(), conversation, None)
    assert conversation.ask("answer", 7.0).kind == "answer"
    assert conversation.ask("lack", 7.0).kind == "answer"
    assert len(conversation.dialogue.planned) == 1


def test_a_decision_that_was_never_taken_cannot_be_planned_again() -> None:
    conversation = Conversation(scripted_pipeline(), again)
    refused = conversation.ask("lack", 7.0)
    assert (refused.kind, refused.reason) == ("refusal", "planner-failed")
