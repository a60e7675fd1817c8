import math

import pytest

from planner.events import Event
from sim.scene import VehicleState
from xavi_dialogue.dialogue.choices import chosen
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.dialogue.referents import Scope, candidates, described, vehicle_words
from xavi_dialogue.explain.bearings import bearing, place


def at(x: float, y: float, heading: float = 0.0, **more: object) -> VehicleState:
    return VehicleState((x, y), heading, 10.0, 0.0, 4.5, 1.8, **more)  # type: ignore[arg-type]


EGO = at(0.0, 0.0)
SCENE = {
    0: EGO,
    1: at(20.0, 0.5),
    2: at(45.0, 0.0, kind="truck"),
    3: at(-15.0, 3.5, colour="blue"),
    4: at(60.0, 7.0, math.pi),
    5: at(30.0, -25.0, math.pi / 2),
}


@pytest.mark.parametrize(
    ("vehicle", "where"),
    [
        (1, "ahead"),
        (2, "ahead"),
        (3, "behind-left"),
        (4, "oncoming"),
        (5, "crossing-right"),
    ],
)
def test_places_are_seen_from_our_car(vehicle: int, where: str) -> None:
    assert place(bearing(EGO, SCENE[vehicle])) == where


def test_who_came_towards_us_has_passed_once_behind() -> None:
    gone = at(-20.0, 3.5, math.pi)
    assert place(bearing(EGO, gone)) == "passed"
    assert vehicle_words({0: EGO, 4: gone})[4].description == "the car going the other way"


def test_places_turn_with_our_car() -> None:
    north = at(0.0, 0.0, math.pi / 2)
    assert place(bearing(north, at(0.0, 30.0, math.pi / 2))) == "ahead"
    assert place(bearing(north, at(-3.5, 0.0, math.pi / 2))) == "beside-left"


@pytest.mark.parametrize(
    ("description", "topic", "meant"),
    [
        ("front", None, (1,)),
        ("behind", None, (3,)),
        ("truck", None, (2,)),
        ("blue", None, (3,)),
        ("oncoming", None, (4,)),
        ("right", None, (5,)),
        ("from-right", None, (5,)),
        ("from-left", None, (3,)),
        ("behind-2", None, (1,)),
        ("behind-1", None, (0,)),
        ("front-1", None, (2,)),
        ("front-3", None, ()),
        ("behind-9", None, ()),
        ("nearest", None, (3,)),
        ("nearest", 4, (3,)),
        ("it", 4, (4,)),
        ("it", None, (1, 2, 3, 4, 5)),
        ("other", 1, (2, 3, 4, 5)),
        ("bus", None, ()),
        ("unknown", None, None),
    ],
)
def test_descriptions(description: str, topic: int | None, meant: tuple[int, ...] | None) -> None:
    assert candidates(description, Scope((SCENE,), topic)) == meant


def test_the_first_scene_in_which_anything_fits_decides() -> None:
    without = {name: state for name, state in SCENE.items() if name in (0, 4)}
    assert candidates("front", Scope((without, SCENE), None)) == (1,)
    assert candidates("front", Scope((without,), None)) == ()


def test_who_is_at_a_place_is_seen_in_the_scenes_of_that_moment_alone() -> None:
    without = {name: state for name, state in SCENE.items() if name in (0, 4)}
    now = Scope((without, SCENE), None, moments=(without,))
    for place_ in ("front", "behind", "right", "from-right", "beside", "front-1"):
        assert candidates(place_, now) == ()
    assert candidates("oncoming", now) == (4,)
    assert candidates("truck", now) == (2,)


@pytest.mark.parametrize(
    ("description", "other", "meant"),
    [
        ("front", at(30.0, 8.0, -math.pi / 2), (1,)),  # it crosses before us ...
        ("front", at(30.0, 25.0, -math.pi / 2), ()),  # ... or is far to the side
        ("front", at(30.0, 0.0, math.pi), (1,)),  # it stands in our way
        ("front", at(30.0, 3.5, math.pi), ()),  # it passes us
        ("behind", at(-30.0, 3.5, math.pi), ()),
        ("left", at(30.0, 3.5, math.pi), (1,)),
        ("right", at(30.0, 3.5, math.pi), ()),
        ("beside", at(0.0, 3.5, math.pi), (1,)),
        ("beside", at(9.0, 3.5, math.pi), ()),
        ("parked", at(9.0, 3.5), ()),
    ],
)
def test_nobody_is_at_a_place_only_where_that_is_true(
    description: str, other: VehicleState, meant: tuple[int, ...]
) -> None:
    assert candidates(description, Scope(({0: EGO, 1: other},), None)) == meant


def test_numbers_and_the_ego_are_no_descriptions() -> None:
    assert described("ego") is None
    assert described("vehicle:3") is None
    assert described("vehicle:front") == "front"


def test_each_description_belongs_to_one_vehicle() -> None:
    words = vehicle_words(SCENE)
    assert words[1].description == "the car ahead"
    assert words[2].description == "the truck ahead"
    assert words[2].kind == "truck"
    two = vehicle_words({0: EGO, 1: at(40.0, 0.0), 2: at(20.0, 0.0)})
    assert (two[1].description, two[2].description) == (None, "the car ahead")


@pytest.mark.parametrize(
    ("text", "index"),
    [
        ("2", 1),
        ("The second one, please", 1),
        ("number 3", 2),
        ("the last", 2),
        ("one", 0),
        ("4", None),
        ("0", None),
        ("why did you stop?", None),
        ("the first and the second", None),
    ],
)
def test_a_choice_is_picked(text: str, index: int | None) -> None:
    assert chosen(text, 3) == index


def test_what_was_given_up_was_not_carried_out() -> None:
    events = (
        Event("action-started", 1.0, "change-left", 1),
        Event("action-ended", 2.0, "change-left", 1),
        Event("action-started", 2.0, "exit-right", 2),
        Event("action-committed", 3.0, "exit-right", 2),
        Event("gave-way", 3.5, "exit-right", 2, 1),
        Event("action-ended", 6.0, "exit-right", 2),
        Event("action-started", 6.0, "continue", 6),
        Event("action-committed", 6.1, "continue", 6),
        Event("action-ended", 9.0, "continue", 6),
    )
    assert [event.sim_time for event in carried_out(events)] == [6.0]
