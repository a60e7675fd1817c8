"""Causes: which deed is asked about, how answers are judged, and a world from end to end."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from benchmarks.causes.cause_scores import Case, report, score
from benchmarks.causes.causes import EXPECTED, examine
from benchmarks.causes.deed_question import Question, Ridden, question, slowing
from benchmarks.causes.naming import longest, named_by, nearest
from benchmarks.causes.removal import Deeds, agrees
from benchmarks.worlds.generate import kind_of
from benchmarks.worlds.values import KINDS
from planner.record.events import Event
from tests.traces import s1_ride
from xavi_dialogue.domain.answers import TooLittle
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


def test_slowing_down_as_alone_is_asked_about_where_it_is_most() -> None:
    bend = ridden(10, 10, 5, 4, 8, 10, 10)
    found = slowing(bend, bend)
    assert found is not None
    assert (found.deed, found.usual, round(found.moment)) == ("slow-down", True, 3)
    assert slowing(ALONE, ALONE) is None


SLOWED = ridden(10, 10, 8, 4, 4, 4, 8, 10, 10, 10, 10)
FREE = ridden(*[10] * 12)
HALF = ridden(10, 10, 9, 7, 7, 7, 9, 10, 10, 10)


def deeds(without: Callable[[frozenset[int]], Ridden], asked: Question | None = None) -> Deeds:
    """Slowing down in a world of vehicles 1 to 4; 4 is a bystander."""
    wanted = asked or question(SLOWED, FREE)
    return Deeds(wanted, SLOWED, FREE, frozenset((1, 2, 3, 4)), without)


def gone(*groups: set[int]) -> Callable[[frozenset[int]], Ridden]:
    """Rides in which one slows down, but without any of some groups."""
    return lambda away: FREE if any(group <= away for group in groups) else SLOWED


def test_a_deed_vanishes_stays_or_neither() -> None:
    assert deeds(gone({1})).vanishes({1}) is True
    assert deeds(gone({1})).vanishes({2}) is False
    assert deeds(lambda _: HALF).vanishes({2}) is None
    assert deeds(gone()).vanishes({1, 2, 3, 4}) is True  # which is driving alone
    assert deeds(gone()).vanishes(()) is False


def test_a_lane_change_vanishes_where_it_is_not_made() -> None:
    whole = replace(SLOWED, events=change(6.0))
    asked = Question("change-left", 6.0)
    others = frozenset((1, 2))
    found = Deeds(asked, whole, FREE, others, lambda away: FREE if 1 in away else whole)
    assert found.vanishes({1}) is True
    assert found.vanishes({2}) is False


def test_what_is_done_alone_as_well_hangs_on_nobody() -> None:
    asked = Question("slow-down", question(SLOWED, FREE).now, usual=True)
    found = Deeds(asked, SLOWED, SLOWED, frozenset((1,)), gone())
    assert found.vanishes({1}) is False
    assert found.holds(())
    assert not found.holds({1})


def test_a_set_holds_where_the_deed_vanishes_without_it_and_stays_with_it_alone() -> None:
    one = deeds(gone({1}))
    assert one.holds({1})
    assert not one.holds({2})
    assert not one.holds(())
    either = deeds(gone({1, 2}))
    assert either.holds({1, 2})
    assert not either.holds({1})
    both = deeds(gone({1}, {2}))
    assert both.holds({1, 2})
    assert not both.holds({1})  # with it alone the deed is gone


@pytest.mark.parametrize(
    ("kind", "planted", "idle", "groups"),
    [
        ("one", (1,), (), [{1}]),
        ("both", (1, 2), (), [{1}, {2}]),
        ("either", (1, 2), (), [{1, 2}]),
        ("pre-empted", (1, 2), (), [{1, 2}]),
        ("distractor", (1,), (2,), [{1}]),
        ("interactive", (1, 2), (), [{1}, {2}]),
    ],
)
def test_a_world_is_of_its_kind_where_removal_shows_it(kind, planted, idle, groups) -> None:
    assert agrees(deeds(gone(*groups)), planted, idle, EXPECTED[kind])
    assert not agrees(deeds(gone(*groups, {4})), planted, idle, EXPECTED[kind])  # a bystander
    assert not agrees(deeds(gone()), planted, idle, EXPECTED[kind])
    assert not agrees(deeds(lambda _: HALF), planted, idle, EXPECTED[kind])


def case(
    seed: int, named: tuple[int, ...], causes: tuple[int, ...] = (1,), **known: object
) -> Case:
    """A world in which a vehicle is named by us, and vehicle 7 by a rival."""
    claims, holds = {"ours": named, "hold-up": (7,)}, {"ours": named == causes, "hold-up": False}
    values = {"causes": causes, "claims": claims, "holds": holds, "told": "one", **known}
    return Case(seed, kind_of(seed), "straight", **values)  # type: ignore[arg-type]


def test_names_are_scored_against_those_that_matter() -> None:
    cases = [case(0, (1,)), case(1, (1,), (1, 2)), case(2, (1, 3), (1, 2))]
    found = score(cases, "ours")
    assert (found.precision, found.recall) == (3 / 4, 3 / 5)
    assert found.f1 == pytest.approx(2 * 3 / (4 + 5))
    assert found.holds == pytest.approx(1 / 3)
    assert score(cases, "hold-up").f1 == 0.0


def test_naming_nobody_is_right_where_nobody_matters_and_wrong_elsewhere() -> None:
    assert score([case(5, (), ())], "ours").f1 == 1.0
    assert score([case(5, (2,), ())], "ours").f1 == 0.0
    missed = score([case(0, ())], "ours")
    assert (missed.precision, missed.recall) == (0.0, 0.0)


def test_a_refusal_lowers_recall_alone() -> None:
    found = score([case(0, (1,)), case(6, (), refused="trace-gap")], "ours")
    assert (found.precision, found.recall) == (1.0, 0.5)


def test_targets_are_met_only_with_the_lead_over_the_better_rival() -> None:
    right = [case(k, (1,)) for k in range(6)]
    assert report(right).met
    rival = [
        case(0, (1,), claims={"ours": (1,), "hold-up": (1,)}, holds={"ours": True, "hold-up": True})
    ]
    assert not report(rival).met
    assert not report([case(0, (2,))]).met
    assert not report([case(0, (1,), error="it broke")]).met


def test_the_table_tells_each_kind_and_what_went_wrong() -> None:
    text = report([case(0, (2,)), case(6, (1,)), case(1, (), error="it broke")]).table()
    assert "one, continue at 0.0 s, hangs on 1: named 2 (one)" in text
    assert "xavi bench causes --worlds 1 --seed 0 --roads straight" in text
    assert "--seed 6" not in text
    assert "it broke" in text
    assert "missed" in text


def test_rivals_count_seconds_and_metres() -> None:
    trace = s1_ride().traces[1]
    assert longest(trace) == (1,)
    assert len(nearest(trace)) == 1
    assert named_by(TooLittle("no-influence")) == ()


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 3])
def test_a_world_is_driven_asked_about_and_driven_without_the_named(seed: int) -> None:
    found = examine((seed, "straight", None))
    assert found.error is None
    assert found.kind == KINDS[seed % len(KINDS)]
    assert found.refused is None
    assert found.claims["ours"] == found.causes
    assert found.holds["ours"]
    assert 0 < found.replans <= 8


@pytest.mark.slow
def test_what_goes_wrong_in_a_world_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    from benchmarks.causes import causes

    def broken(*_: object) -> None:
        raise ValueError("no such road")

    monkeypatch.setattr(causes, "draw", broken)
    found = examine((3, "straight", None))
    assert found.error == "ValueError: no such road"


def test_where_one_alone_matters_it_is_right_to_tell_of_one_in_any_world() -> None:
    interactive = KINDS.index("interactive")
    assert case(interactive, (1,), (1,), told="one").kind_right
    assert not case(interactive, (1,), (1,), told="both").kind_right
    assert case(interactive, (1, 2), (1, 2), told="both").kind_right
    assert not case(interactive, (1, 2), (1, 2), told="one").kind_right
    assert not case(interactive, (1,), (1,), told="one", refused="trace-gap").kind_right
