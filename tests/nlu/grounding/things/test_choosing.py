"""Of several vehicles that fit, who is meant."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.fakes import Car, FakeWorld, did, talk
from tests.nlu.grounding.things.test_looks import PLAIN
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Described, Event, Vehicle, Vehicles, Wanted
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.things.choosing import bare, choose, several
from xavi_dialogue.nlu.grounding.things.match import Match

CARS = {1: Car(30.0), 2: Car(28.0, 3.5), 3: Car(29.0, -3.5), 4: Car(31.0, 3.5), 5: Car(33.0, 3.5)}
NOW = 20.0


def match(
    vehicle: int,
    cost: float = 0.0,
    distance: float = 20.0,
    done: float | None = None,
    deed: float | None = None,
    misses: dict[str, float] | None = None,
    **look: Any,
) -> Match:
    def episode(begin: float | None) -> Episode | None:
        return None if begin is None else Episode(Vehicle(vehicle), "cut-in", begin, begin + 1.0)

    seen = replace(PLAIN, vehicle=vehicle, distance=distance, **look)
    known = {"kind": 0.0, **(misses or {})}
    return Match(vehicle, seen, known, cost, episode(done), episode(deed))


def context(discourse: Discourse | None = None, cars: dict[int, Car] | None = None) -> Context:
    return Context(FakeWorld(CARS if cars is None else cars), discourse or Discourse())


def chosen(
    *matches: Match,
    discourse: Discourse | None = None,
    cars: dict[int, Car] | None = None,
    reference: Vehicle | None = None,
    **wanted: Any,
) -> tuple[int, ...]:
    world = context(discourse, cars)
    return choose(world, Described(**wanted), matches, NOW, reference)


RED: dict[str, Any] = {"kind": "car", "colour": "red"}


def test_a_match_adds_up_what_does_not_fit() -> None:
    one = match(1, 0.2, misses={"colour": 0.45, "size": 0.44, "kind": 0.5})
    assert one.cost == pytest.approx(1.39)
    assert one.total == pytest.approx(1.59)
    assert set(one.wrong) == {"colour", "kind"}


def test_who_fits_clearly_best_is_meant() -> None:
    assert chosen(match(3, 0.1), match(1, 0.26), **RED) == (3,)
    assert len(chosen(match(3, 0.1), match(1, 0.24), **RED)) > 1


@pytest.mark.parametrize(
    ("rank", "vehicle"), [(1, 3), (2, 1), (3, 2), (4, 2), (0, 3), (-1, 2), (-2, 1), (-5, 3)]
)
def test_ranks_count_by_nearness(rank: int, vehicle: int) -> None:
    found = chosen(match(1, distance=20.0), match(2, distance=30.0), match(3, distance=10.0),
                   rank=rank, **RED)  # fmt: skip
    assert found == (vehicle,)


def test_ranks_count_by_time_where_all_did_something() -> None:
    early, late = match(1, distance=30.0, done=4.0), match(2, distance=10.0, done=9.0)
    assert chosen(early, late, rank=1, **RED) == (1,)
    assert chosen(late, early, rank=-1, **RED) == (2,)
    assert chosen(early, replace_done(late), rank=1, **RED) == (2,)


def replace_done(one: Match) -> Match:
    return Match(one.vehicle, one.look, one.misses, one.stage)


def test_ranks_count_among_those_that_were_offered_or_named_together() -> None:
    three = (match(1, distance=20.0), match(2, distance=30.0), match(3, distance=10.0))
    offered = Discourse(offered_things=(Vehicle(2), Vehicle(1)))
    assert chosen(*three, discourse=offered, rank=1, **RED) == (2,)
    assert chosen(*three, discourse=offered, rank=2, **RED) == (1,)
    one = Discourse(offered_things=(Vehicle(2),))  # one alone has no order
    assert chosen(*three, discourse=one, rank=1, **RED) == (3,)
    group = Discourse(offered_things=(Vehicles((1, 9, 3)),))
    assert chosen(*three, discourse=group, rank=2, **RED) == (3,)
    assert chosen(*three, discourse=talk(Vehicles((2, 3))), rank=1, **RED) == (2,)


@pytest.mark.parametrize(
    ("extreme", "vehicle"),
    [("nearest", 1), ("farthest", 2), ("fastest", 2), ("slowest", 3), ("biggest", 3)],
)
def test_extremes(extreme: Any, vehicle: int) -> None:
    three = (
        match(1, distance=10.0, speed=8.0, length=4.0),
        match(2, distance=30.0, speed=9.0, length=5.0),
        match(3, distance=20.0, speed=7.0, length=6.0),
    )
    assert chosen(*three, extreme=extreme, **RED) == (vehicle,)


def test_who_was_offered_is_meant() -> None:
    two = (match(1), match(2))
    assert chosen(*two, discourse=Discourse(offered_things=(Vehicle(2),)), **RED) == (2,)
    both = Discourse(offered_things=(Vehicle(1), Vehicle(2)))
    assert len(chosen(*two, discourse=both, **RED)) == 2


def test_the_other_one_is_who_was_spoken_of_too() -> None:
    two = (match(1), match(2))
    assert chosen(*two, discourse=talk(Vehicle(2)), other=True, **RED) == (2,)
    assert chosen(*two, discourse=talk(Vehicle(2), Vehicle(1)), other=True, **RED) == (2,)
    assert len(chosen(*two, other=True, **RED)) == 2


@pytest.mark.parametrize(
    ("first", "second", "found"),
    [((4.0, None), (7.0, None), (2,)), ((4.0, None), (6.9, None), None),
     ((7.0, None), (4.0, None), (1,)), ((None, 4.0), (None, 7.0), (2,)),
     ((4.0, None), (None, 9.0), (1,)), ((None, None), (None, 9.0), (2,))],
)  # fmt: skip
def test_who_did_it_clearly_last_is_meant(
    first: tuple[float | None, ...], second: tuple[float | None, ...], found: tuple[int, ...] | None
) -> None:
    two = (match(1, done=first[0], deed=first[1]), match(2, done=second[0], deed=second[1]))
    meant = chosen(*two, **RED)
    assert meant == found if found else len(meant) == 2


def test_with_a_bearing_the_nearest_is_meant() -> None:
    two = (match(1, distance=20.0), match(2, distance=19.0))
    assert chosen(*two, bearing="ahead", **RED) == (2,)
    beside = (
        match(1, distance=19.0, ahead=30.0, left=0.0),
        match(3, distance=20.0, ahead=29.0, left=-3.5),
    )

    # Seen from vehicle 2 at (28, 3.5): 2 + 3.5 m to the one, 1 + 7 m to the other.
    assert chosen(*beside, bearing="beside", reference=Vehicle(2), **RED) == (1,)
    far = (match(1, distance=19.0, ahead=40.0), beside[1])
    assert chosen(*far, bearing="beside", reference=Vehicle(2), **RED) == (3,)
    assert chosen(*far, bearing="beside", reference=Vehicle(99), **RED) == (1,)


def test_a_bare_description_means_whom_was_spoken_of() -> None:
    two = (match(1), match(2))
    assert chosen(*two, discourse=talk(Vehicle(2)), kind="car") == (2,)
    assert chosen(*two, discourse=talk(Vehicle(1), Vehicle(2)), kind="vehicle") == (1,)


def test_who_stands_out_is_meant_and_else_it_is_asked() -> None:
    near = {1: Car(30.0), 2: Car(10.0, 3.5)}
    assert chosen(match(1), match(2), cars=near, **RED) == (2,)
    assert len(chosen(match(1), match(2), **RED)) == 2
    assert len(chosen(*(match(k) for k in range(1, 6)), **RED)) == 4  # not more than four
    assert len(chosen(match(1), match(2), definite=False, **RED)) == 1


def test_a_bare_description_means_who_has_to_do_with_us() -> None:
    world = FakeWorld(CARS, (did("follow", 1.0, 3.0, whom=3),))
    alike = [match(k) for k in (1, 2, 3)]
    assert choose(Context(world, Discourse()), Described(kind="car"), alike, 5.0, None) == (3,)
    assert len(choose(Context(world, Discourse()), Described(**RED), alike, 50.0, None)) == 3


@pytest.mark.parametrize(
    ("wanted", "plain"),
    [
        (Described(kind="car"), True),
        (Described(), True),
        (Described(kind="car", definite=False), True),
        (Described(kind="bus"), False),
        (Described(kind="car", colour="red"), False),
        (Described(kind="car", plural=True), False),
    ],
)
def test_bare_descriptions(wanted: Described, plain: bool) -> None:
    assert bare(wanted) is plain


def listed(*matches: Match, discourse: Discourse | None = None, **wanted: Any) -> tuple[int, ...]:
    described = Described(plural=True, **wanted)
    return several(context(discourse), described, matches, NOW)


def test_a_plural_means_all_that_fit_about_as_well_nearest_first() -> None:
    three = (match(1, 0.0, 30.0), match(2, 0.29, 20.0), match(3, 0.31, 10.0))
    assert listed(*three) == (2, 1)
    assert listed(*three, number=1) == (2,)


def test_a_plural_means_the_kind_exactly_where_there_are_enough() -> None:
    taxi = match(2, 0.0, 10.0, misses={"kind": 0.1})
    assert listed(match(1), taxi, match(3)) == (1, 3)
    assert listed(match(1), taxi, number=2) == (2, 1)
    assert listed(taxi) == (2,)


def test_of_more_than_were_counted_those_spoken_of_are_meant() -> None:
    three = tuple(match(k, 0.0, 10.0 * k) for k in (1, 2, 3))
    together = talk(Vehicles((3, 2)))
    assert listed(*three, number=2, discourse=together) == (3, 2)
    assert listed(*three, number=2) == (1, 2)
    assert listed(*three, number=3, discourse=together) == (1, 2, 3)
    assert listed(*three, discourse=together) == (1, 2, 3)
    assert listed(*three[:2], number=2, discourse=together) == (1, 2)
    assert listed(*three, number=1, discourse=together) == (1,)


def test_of_those_who_do_it_now_on_one_side_the_nearest_is_meant() -> None:
    near, far = match(3, distance=3.0, done=8.0), match(5, distance=7.0, done=14.0)
    now = Described("car", bearing="left", doing=Event("stand", Wanted(), tense="present"))
    past = replace(now, doing=Event("stop", Wanted(), tense="past"))
    assert choose(context(), now, (far, near), NOW, None) == (3,)
    assert choose(context(), past, (far, near), NOW, None) == (5,)
    assert choose(context(), replace(now, bearing=None), (far, near), NOW, None) == (5,)
