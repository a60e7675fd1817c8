"""Causes: which deed is asked about, how answers are judged, and a world from end to end."""

from dataclasses import replace
from pathlib import Path

import pytest

from planner.events import Event
from xavi_dialogue.app.bench.asking import Question, Ridden, question, ride
from xavi_dialogue.app.bench.causes import Case, examine, report
from xavi_dialogue.app.bench.necessity import (
    Removal,
    compared,
    delay,
    plan_changes,
    ride_changes,
)
from xavi_dialogue.app.bench.worlds.generate import generate, kind_of
from xavi_dialogue.app.ride import network_of
from xavi_dialogue.domain.meaning import Ask, Why
from xavi_dialogue.domain.terms import Event as Deed
from xavi_dialogue.domain.terms import Happens, Not

STEP = 0.1  # [s]


def ridden(*speeds: float, events: tuple[Event, ...] = ()) -> Ridden:
    """A ride at these speeds [m/s], each for a second."""
    fine = [speed for speed in speeds for _ in range(10)]
    time = tuple(round(k * STEP, 3) for k in range(len(fine)))
    gone = tuple(sum(fine[:k]) * STEP for k in range(len(fine)))
    return Ridden("arrived", (), events, time, gone, tuple(fine))


def change(end: float) -> tuple[Event, ...]:
    return (
        Event("action-started", end - 3.0, "change-left", 1),
        Event("action-committed", end - 2.0, "change-left", 1),
        Event("action-ended", end, "change-left", 1),
    )


ALONE = ridden(*[10.0] * 12)


def test_a_lane_change_comes_first() -> None:
    ride = ridden(10, 9, 2, 0, 0, 5, 10, 10, events=change(6.0))
    assert question(ride, ALONE) == Question("change-left", 6.0)


def test_a_lane_change_that_is_made_alone_as_well_is_no_deed() -> None:
    ride = ridden(10, 9, 4, 4, 5, 8, 10, 10, events=change(6.0))
    alone = replace(ALONE, events=change(5.0))
    assert question(ride, alone).deed == "slow-down"


def test_the_slowest_place_against_driving_alone_is_asked_about() -> None:
    assert question(ridden(10, 9, 4, 4, 5, 8, 10, 10), ALONE) == Question("slow-down", 4.0)
    assert question(ridden(10, 5, 0, 0, 5, 8, 10, 10), ALONE).deed == "stop"
    wait = (Event("gave-way", 1.0, "exit-left", 1, vehicle=3),)
    assert question(ridden(10, 5, 0, 0, 5, 8, 10, events=wait), ALONE).deed == "give-way"


def test_giving_way_long_before_is_another_matter() -> None:
    wait = (Event("gave-way", 0.5, "exit-left", 1, vehicle=3),)
    ride = ridden(9, 9, 9, 9, 9, 9, 9, 9, 3, 3, 9, 10, events=wait)
    assert question(ride, ridden(*[10.0] * 20)).deed == "slow-down"


def test_being_slower_than_alone_later_on_hides_no_giving_way() -> None:
    wait = (Event("gave-way", 2.0, "exit-right", 1, vehicle=3),)
    slow_exit = ridden(8, 8, 3, 2, 4, 8, 9, 9, 9, events=wait)
    alone = ridden(8, 8, 5, 5, 8, 14, 14, 14, 14)
    assert question(slow_exit, alone).deed == "give-way"


def test_what_the_road_alone_slows_is_no_deed() -> None:
    bend = ridden(10, 10, 5, 5, 10, 10)
    assert question(bend, bend).deed == "continue"


def test_being_slow_from_the_start_is_no_slowing_down() -> None:
    found = question(ridden(*[5.0] * 12), ALONE)
    assert found.deed == "continue"
    assert found.act.act == Ask(Why(Not(Happens(Deed("continue")))))


def test_deeds_are_asked_about_as_facts() -> None:
    assert Question("give-way", 1.0).act.act == Ask(Why(Happens(Deed("give-way"))))


def test_the_record_ends_when_it_is_asked() -> None:
    ride = ridden(10, 10, 10, 10, 10, 10, 10, events=change(6.0))
    assert [event.kind for event in ride.record(4.5).events] == [
        "action-started",
        "action-committed",
    ]
    assert ride.manoeuvres == ("change-left",)


def test_rides_differ_in_arrival_ending_or_manoeuvres() -> None:
    ride = ridden(10, 10, 10, 10)
    later = ridden(10, 10, 10, 10, 10)
    assert not ride_changes(ride, ride)
    assert ride_changes(ride, later)
    assert delay(ride, later) == pytest.approx(1.0)
    assert ride_changes(ride, replace(ride, ending="duration"))
    assert delay(ride, replace(ride, ending="duration")) is None
    assert ride_changes(ride, replace(ride, events=change(3.0)))


def case(seed: int, named: tuple[int, ...], **known: object) -> Case:
    """A leader-world in which vehicle 1 was planted."""
    values = {"planted": 1, "named": named, "asked": "slow-down", **known}
    return Case(seed, "leader", **values)  # type: ignore[arg-type]


def test_precision_counts_names_and_recall_answers() -> None:
    found = report([case(0, (1,)), case(6, (1, 2)), case(12, (2,)), case(18, ())])
    row = found.rows[0]
    assert (row.precision.hits, row.precision.n) == (2, 4)
    assert (row.recall.hits, row.recall.n) == (2, 4)
    assert [one.seed for one in found.wrong] == [6, 12, 18]
    assert found.rows[-1].kind == "all"
    assert found.asked == {"slow-down": 4}


def test_recall_is_told_for_those_worlds_too_in_which_our_own_ride_hangs_on_it() -> None:
    cases = [case(0, (1,), nearest=1), case(6, (), matters=False, nearest=2), case(12, ())]
    row = report(cases).rows[0]
    assert (row.recall.hits, row.recall.n) == (1, 3)
    found = row.recall_where_it_matters
    assert (found.hits, found.n) == (1, 2)
    assert (row.nearest.hits, row.nearest.n) == (1, 3)
    assert "of no matter to our own ride" in report(cases).wrong[0].what


def test_refusals_and_failures_are_counted_apart() -> None:
    cases = [case(0, (1,)), case(6, (), refused="trace-gap"), case(12, (), error="it broke")]
    row = report(cases).rows[0]
    assert (row.worlds, row.failed, row.refused) == (3, 1, 1)
    assert (row.recall.hits, row.recall.n) == (1, 1)
    assert row.matters.n == 2
    whats = [one.what for one in report(cases).wrong]
    assert "trace-gap" in whats[0]
    assert "it broke" in whats[1]
    assert report(cases).wrong[0].reproduce == "xavi bench causes --worlds 1 --seed 6"


def test_necessity_is_told_for_named_and_unnamed_and_where_it_could_be_tried() -> None:
    removals = (Removal(1, True, True, True), Removal(2, False, None, False))
    shares = {s.name: (s.hits, s.n) for s in report([case(0, (1,), removals=removals)]).necessity}
    assert shares == {
        "named: the plan": (1, 1),
        "named: the ride": (1, 1),
        "not named: the plan": (0, 0),
        "not named: the ride": (0, 1),
    }


def test_the_table_names_what_went_wrong() -> None:
    text = report([case(0, (2,)), case(6, (1,))]).table()
    assert "named 2" in text
    assert "xavi bench causes --worlds 1 --seed 0" in text
    assert "--seed 6" not in text
    assert "none" in report([case(6, (1,))]).table()


@pytest.mark.slow
def test_a_world_is_driven_asked_about_and_driven_without_the_named() -> None:
    found = examine((0, None))
    assert found.error is None
    assert found.kind == kind_of(0)
    assert found.planted > 0
    assert found.matters
    assert found.asked in ("stop", "slow-down")
    assert found.refused is None
    assert {removal.vehicle for removal in found.removals if removal.named} == set(found.named)
    assert examine((0, None)) == found


@pytest.mark.slow
def test_a_decision_hangs_on_the_planted_vehicle_and_on_nobody_out_of_view(tmp_path: Path) -> None:
    planted = generate(0, tmp_path / "world")
    network, name = network_of(planted.scenario), planted.world.planted
    traces = ride(planted.scenario, network).traces
    trace = min((t for t in traces if name in t.scene), key=lambda t: t.scene[0].speed)
    assert plan_changes(trace, network, name) is True
    assert plan_changes(trace, network, 99) is None
    others = set(trace.scene) - {0, name}
    assert set(compared(trace, (name,), 0)) <= others
    assert len(compared(trace, (name,), 0)) == min(1, len(others))
    assert compared(trace, (), 0) == ()


@pytest.mark.slow
def test_what_goes_wrong_in_a_world_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    from xavi_dialogue.app.bench import causes

    def broken(*_: object) -> None:
        raise ValueError("no such road")

    monkeypatch.setattr(causes, "generate", broken)
    found = examine((3, None))
    assert found.error == "ValueError: no such road"
    assert not found.answered
