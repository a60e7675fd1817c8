"""Who goes before us and who after, how many still do, and who has to move so that we can go."""

from typing import Any

import pytest

from planner.record.places import PriorityFact, RoadFacts
from tests.explain.answers.given import NOW, Given, deed, look, place, step
from xavi_dialogue.domain.answers import Answer, Priority, Unblocking
from xavi_dialogue.domain.meaning import HowMany, Which
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Happens,
    Next,
    Now,
    Related,
    Vehicle,
    Wanted,
)
from xavi_dialogue.explain.answers import turns

FIRST = Related("has-priority-over", Wanted(), Everyone(), Now())
MOVER = Happens(Event("move", Wanted(), time=Now(), tense="present", modal="must"))
WAIT = Event("wait", Ego(), Wanted(), time=Now(), tense="present", modal="must")


def at_junction(rules: dict[int, Any], turn: str = "exit-left", **route: Any) -> Given:
    """Oncoming vehicles, each ten metres behind the one before, with who goes first."""
    road = RoadFacts(
        places={0: place()},
        route=(step(turn=turn, **route),),
        priority=tuple(PriorityFact(v, who) for v, who in rules.items()),
    )
    looks = {v: look(v, distance=10.0 * v, oncoming=True, left=3.0) for v in rules}
    return Given(looks=looks, road=road)


def told(given: Given, such: Any = FIRST, among: tuple[Any, ...] = ()) -> Answer:
    return turns.who(Which(Wanted(), such, among), given.asked())


def test_all_who_go_before_us_are_told_the_nearest_first_and_who_waits_for_us() -> None:
    given = at_junction({3: "vehicle", 1: "ego", 2: "vehicle"})
    assert told(given) == Priority(NOW, "give-way", 2, others=(3,), after=(1,), why="across")


def test_who_all_has_to_wait_for_us_is_told_where_nobody_goes_before_us() -> None:
    found = told(at_junction({1: "ego", 2: "ego"}, rule="priority"))
    assert found == Priority(NOW, "priority", 1, others=(2,))


def test_where_others_may_come_who_go_first_we_give_way_by_the_rule() -> None:
    found = told(at_junction({1: "ego", 2: "ego"}, rule="give-way"))
    assert found == Priority(NOW, "give-way", after=(1, 2))


@pytest.mark.parametrize(
    ("turn", "rule", "left", "oncoming", "why"),
    [
        ("exit-left", "give-way", 3.0, True, "across"),
        ("exit-straight", "give-way", 3.0, True, None),
        ("exit-left", "equal", -20.0, False, "right"),
        ("exit-left", "give-way", -20.0, False, "road"),
        ("exit-straight", "give-way", 20.0, False, "road"),
        ("exit-right", "give-way", -2.0, False, "beside"),
        ("exit-right", "give-way", 2.0, False, None),
        ("exit-straight", "equal", 20.0, False, None),
    ],
)
def test_it_is_told_on_what_the_right_of_way_rests(
    turn: str, rule: str, left: float, oncoming: bool, why: str | None
) -> None:
    given = at_junction({1: "vehicle", 2: "vehicle"}, turn, rule=rule)
    given.looks = {v: look(v, distance=10.0 * v, oncoming=oncoming, left=left) for v in (1, 2)}
    found = told(given)
    assert isinstance(found, Priority)
    assert found.why == why


def test_of_those_named_whose_way_does_not_meet_ours_is_told_as_well() -> None:
    given = at_junction({1: "vehicle", 3: "vehicle"}, "exit-right")
    given.looks = {**given.looks, 2: look(2)}
    found = told(given, among=(Vehicle(1), Vehicle(2)))
    assert found == Priority(NOW, "give-way", 1, apart=(2,))
    given.looks = {**given.looks, 2: look(2, kind="pedestrian")}
    assert told(given, among=(Vehicle(1), Vehicle(2))).apart == ()


def test_whom_we_have_to_wait_for_leaves_out_who_waits_for_us() -> None:
    given = at_junction({1: "ego", 2: "vehicle", 3: "vehicle"})
    found = told(given, Happens(WAIT))
    assert found == Priority(NOW, "give-way", 2, others=(3,), why="across")


def test_how_many_still_go_before_us_are_counted() -> None:
    such = Described(doing=WAIT, plural=True, definite=False)
    asked = at_junction({1: "ego", 2: "vehicle", 3: "vehicle"}, "exit-right").asked()
    found = turns.how_many(HowMany(Vehicle(1), such), asked)
    assert found == Priority(NOW, "give-way", 2, others=(3,), number=True)
    nobody = at_junction({1: "ego"}).asked()
    assert turns.how_many(HowMany(Vehicle(1), such), nobody) == Priority(NOW, "none", number=True)


@pytest.mark.parametrize(
    ("speed", "going", "waits"), [(0.0, False, (9,)), (0.8, False, (9,)), (0.9, True, ())]
)
def test_who_has_to_move_is_the_head_of_the_row(
    speed: float, going: bool, waits: tuple[int, ...]
) -> None:
    given = Given(
        looks={v: look(v, speed=0.0, distance=6.0 * v) for v in (1, 2)} | {9: look(9)},
        measures={
            ("distance", Ego(), Vehicle(1)): 3.0,
            ("distance", Vehicle(1), Vehicle(2)): 3.0,
            ("speed", Vehicle(2)): speed,
        },
        relations={
            ("ahead-of", Vehicle(1), Ego()): True,
            ("ahead-of", Vehicle(2), Vehicle(1)): True,
        },
        deeds=[
            deed("give-way", 10.0, 15.0, Vehicle(8), actor=Vehicle(2)),
            deed("give-way", 15.0, None, Vehicle(9), actor=Vehicle(2)),
        ],
    )
    assert told(given, MOVER) == Unblocking(NOW, 2, going, waits)


def test_who_goes_next_is_who_goes_before_us() -> None:
    going = Happens(Event("go", Wanted(), time=Next(), tense="present"))
    found = told(at_junction({1: "ego", 2: "vehicle", 3: "vehicle"}), going)
    assert found == Priority(NOW, "give-way", 2, others=(3,), after=(1,), why="across")


def test_who_is_out_of_view_is_in_no_order() -> None:
    given = at_junction({1: "vehicle", 2: "vehicle", 3: "vehicle"})
    given.looks = {1: look(1, in_view=False, seen=3.0), 2: look(2, distance=20.0, oncoming=True)}
    found = told(given)
    assert isinstance(found, Priority)
    assert (found.vehicle, found.others) == (2, ())
