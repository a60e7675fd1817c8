"""Which of several vehicles is meant: the nearest, the likeliest, the head of a queue."""

from typing import Any

import pytest

from planner.record.places import RoadFacts
from tests.explain.answers.given import (
    NOW,
    Given,
    deed,
    expects,
    look,
    place,
)
from xavi_dialogue.domain.answers import Identified, Verdict
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Which
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Nobody,
    Related,
    Vehicle,
    Wanted,
)
from xavi_dialogue.explain.answers import queues
from xavi_dialogue.explain.answers.events import picking
from xavi_dialogue.explain.answers.events.picking import (
    extreme_of,
    in_line,
    likeliest,
    owed_by_other,
)

ONE = look(1, distance=12.0, speed=9.0, length=4.0)
TWO = look(2, distance=30.0, speed=14.0, length=12.0)
THREE = look(3, distance=20.0, speed=2.0, length=5.0)


@pytest.mark.parametrize(
    ("extreme", "vehicle"),
    [("nearest", 1), ("farthest", 2), ("fastest", 2), ("slowest", 3), ("biggest", 2)],
)
def test_one_is_kept_where_a_description_wants_the_most(extreme: Any, vehicle: int) -> None:
    found = extreme_of(Described(extreme=extreme), (THREE, ONE, TWO))
    assert [one.vehicle for one in found] == [vehicle]
    assert extreme_of(Described(extreme=extreme), ()) == ()


def test_all_are_kept_where_no_description_wants_one() -> None:
    assert extreme_of(Described(), (ONE, TWO)) == (ONE, TWO)
    assert extreme_of(Everyone(), (ONE, TWO)) == (ONE, TWO)


@pytest.mark.parametrize(
    ("seen", "in_view", "word", "around"),
    [
        (12.0, False, None, True),
        (10.0, False, None, True),  # ten seconds ago
        (9.0, False, None, False),
        (9.0, False, "hidden", True),
        (12.0, True, None, False),
        (None, False, None, False),
    ],
)
def test_who_was_lost_lately_may_be_around(
    seen: Any, in_view: bool, word: Any, around: bool
) -> None:
    shown = Measure("visibility", Vehicle(1), NOW, word=word)
    asked = Given(measures={("visibility", Vehicle(1)): shown}).asked()
    assert picking.lately_lost(asked, look(1, seen=seen, in_view=in_view)) is around


def test_who_has_right_of_way_over_another_is_whom_he_gives_way_to() -> None:
    wanted = Happens(Event("give-way", Vehicle(2), Wanted(), tense="present"))
    assert owed_by_other(Related("has-priority-over", Wanted(), Vehicle(2))) == wanted
    assert owed_by_other(Related("must-yield-to", Vehicle(2), Described())) == wanted
    assert owed_by_other(Related("has-priority-over", Vehicle(2), Wanted())) is None
    assert owed_by_other(Related("has-priority-over", Wanted(), Ego())) is None
    assert owed_by_other(Exists(Vehicle(2))) is None


def chances(*shares: float, anybody: bool = False) -> Any:
    """What is told of a turn that the vehicles in view are to take with some probabilities."""
    beliefs = {
        v: expects(v, (("exit-right",), share), (("continue",), 1.0 - share))
        for v, share in enumerate(shares, 1)
    }
    given = Given(looks={v: look(v) for v in beliefs}, beliefs=beliefs)
    who = Nobody() if anybody else Everyone()
    return likeliest(given.asked(), Event("exit-right", who, tense="future"))


def test_of_several_the_likeliest_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picking, "chance", _chance)
    found = chances(0.3, 0.7, 0.6)
    turn = Event("exit-right", Vehicle(2), tense="future")
    assert found.answer == Verdict(Happens(turn), None, probability=0.7)
    assert (found.holds, found.probability) == (None, 0.7)
    assert chances(0.3, 0.7, anybody=True) == found
    assert chances(0.2, 0.5).answer.probability == 0.5
    low = chances(0.3, 0.2)
    assert (low.holds, low.probability, low.answer) == (False, 0.3, None)
    assert chances().gap == "in-future"


def _chance(asked: Any, event: Event, at: float) -> float | None:
    assert at == NOW
    assert isinstance(event.actor, Vehicle)
    return float(asked.world.belief(event.actor.number, at).expectations[0].probability)


def test_a_vehicle_of_which_nothing_is_known_does_not_count(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    known = {1: None, 2: 0.6, 3: 0.1}
    monkeypatch.setattr(picking, "chance", lambda asked, event, at: known[event.actor.number])
    given = Given(looks={v: look(v) for v in known})
    found = likeliest(given.asked(), Event("exit-right", Everyone(), tense="future"))
    assert found.answer.that.event.actor == Vehicle(2)  # type: ignore[union-attr]


FIRST = Vehicle(1)
LANES = RoadFacts(
    {1: place(lane=0), 2: place(lane=0), 3: place(lane=1), 4: place("side", lane=1)},
)


def ahead_of(
    relation: Any = "ahead-of", road: Any = LANES, to: Any = FIRST, **more: Any
) -> list[int]:
    """Who is told to be in front of vehicle 1, 20 m ahead of us, of three others."""
    first = look(1, ahead=20.0, distance=20.0, **more)
    seen = (
        look(2, ahead=50.0, distance=30.0),
        look(3, ahead=30.0, distance=60.0),
        look(4, ahead=-10.0, distance=40.0),
    )
    asked = Given(looks={1: first}, road=road).asked()
    return [one.vehicle for one in in_line(Related(relation, Wanted(), to), seen, asked, NOW)]


def test_who_is_in_the_lane_of_another_counts_the_nearest_to_him_first() -> None:
    assert ahead_of() == [2, 4]  # 30 m from him each; 3 is in another lane of his road
    assert ahead_of("behind") == [2, 4]
    assert ahead_of(road=None) == [3, 2, 4]
    assert ahead_of(road=RoadFacts({3: place(lane=1)})) == [3, 2, 4]
    assert ahead_of("left-of") == [2, 4, 3]  # by the distance from us
    assert ahead_of(bearing="crossing-left") == [2, 4, 3]
    assert ahead_of(to=Ego()) == [2, 4, 3]


@pytest.mark.parametrize(
    ("action", "rate", "over"),
    [
        ("slow-down", 0.0, True),
        ("brake", -0.29, True),
        ("speed-up", 0.29, True),
        ("speed-up", 0.31, False),
        ("slow-down", -0.31, False),
        ("slow-down", None, False),
        ("follow", 0.0, False),
    ],
)
def test_a_change_of_speed_is_over_once_the_speed_is_held(
    action: Any, rate: float | None, over: bool
) -> None:
    asked = Given(measures={("acceleration", Ego()): rate}).asked()
    assert picking.spent(asked, deed(action, 15.0), NOW) is over


# --- the head of a queue ------------------------------------------------------------------------


def row(gaps: dict[tuple[int, int], float], **looks: Any) -> Given:
    """Vehicles of which each pair (who, ahead of whom) stands at a gap; 0 is us."""

    def thing(number: int) -> Any:
        return Vehicle(number) if number else Ego()

    slow = {"speed": 0.0} | looks
    return Given(
        looks={v: look(v, **slow) for v, _ in gaps},
        measures={
            ("distance", thing(to), thing(who)): gap for (who, to), gap in gaps.items()
        },
        relations={("ahead-of", thing(who), thing(to)): True for who, to in gaps},
    )  # fmt: skip


QUEUE = {(1, 0): 4.0, (2, 1): 15.0, (3, 2): 16.0}


def test_the_head_of_a_queue_is_the_foremost_of_those_who_stand_close() -> None:
    assert queues.head(row(QUEUE).asked(), NOW) == Vehicle(2)  # 3 stands too far from 2
    assert queues.head(row({(1, 0): 15.1}).asked(), NOW) is None
    assert queues.head(row(QUEUE, speed=3.0).asked(), NOW) == Vehicle(2)
    assert queues.head(row(QUEUE, speed=3.1).asked(), NOW) is None
    assert queues.head(row(QUEUE, oncoming=True).asked(), NOW) is None
    assert queues.head(row(QUEUE, in_view=False).asked(), NOW) is None
    assert queues.head(row({(1, 0): 9.0, (2, 0): 4.0}).asked(), NOW) == Vehicle(2)


def test_a_ring_of_vehicles_is_gone_round_once() -> None:
    assert queues.head(row({(1, 0): 4.0, (2, 1): 4.0, (1, 2): 4.0}).asked(), NOW) == Vehicle(2)


def test_who_is_close_but_not_ahead_is_not_in_the_queue() -> None:
    given = row(QUEUE)
    given.relations = {("ahead-of", Vehicle(1), Ego()): True}
    assert queues.head(given.asked(), NOW) == Vehicle(1)


@pytest.mark.parametrize(
    ("such", "asked"),
    [
        (Related("ahead-of", Wanted(), Feature("queue")), True),
        (Related("on", Wanted(), Feature("queue")), True),
        (Related("near", Wanted(), Feature("queue")), True),
        (Related("behind", Wanted(), Feature("queue")), False),
        (Related("ahead-of", Vehicle(1), Feature("queue")), False),
        (Related("ahead-of", Wanted(), Feature("light")), False),
        (Exists(Feature("queue")), False),
        (None, False),
    ],
)
def test_a_question_for_the_head_of_the_queue_is_recognised(such: Any, asked: bool) -> None:
    assert queues.is_head(such) is asked


def test_who_is_at_the_front_is_the_head_or_else_whom_it_holds_of(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(queues, "which", lambda question, asked: question)
    front = Which(Wanted(), Related("ahead-of", Wanted(), Feature("queue")))
    found: Any = queues.who(front, row(QUEUE).asked())
    assert isinstance(found, Identified)
    assert [one.vehicle for one in found.looks] == [2]
    found = queues.who(front, row({(1, 0): 20.0}).asked())
    assert found is front
    other = Which(Wanted(), Related("behind", Wanted(), Ego()))
    found = queues.who(other, row(QUEUE).asked())
    assert found is other
