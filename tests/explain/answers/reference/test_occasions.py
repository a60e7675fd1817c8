"""Which episodes of a ride of 20 s a question is about, and what is told in their place."""

from typing import Any

import pytest

from tests.explain.answers.stated import decision, did, look, result, scene, they
from xavi_dialogue.domain.answers import DidNotHappen, NoSuchVehicle, NotRecorded
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Ego,
    Event,
    Everyone,
    Junction,
    Lane,
    Passenger,
    Vehicle,
    Vehicles,
    WholeRide,
)
from xavi_dialogue.explain.answers.reference import occasions as room
from xavi_dialogue.explain.answers.reference.moments import Window

BOTH = {1: look(1), 2: look(2)}
STOPS = (did("stop", 5.0, 6.0), did("stop", 12.0, 13.0))


def begins(episodes: Any) -> list[float]:
    return [e.begin for e in episodes]


def names(episodes: Any) -> list[tuple[str, float]]:
    return [(e.action, e.begin) for e in episodes]


def test_occasions_come_in_order_of_time() -> None:
    asked = scene(episodes=(*STOPS, did("stop", 5.0, 5.5)))
    found = room.occasions(asked, Event("stop"))
    assert [(e.begin, e.end) for e in found] == [(5.0, 5.5), (5.0, 6.0), (12.0, 13.0)]
    ending = scene(episodes=(did("stop", 5.0), did("stop", 5.0, 6.0)))
    assert [e.end for e in room.occasions(ending, Event("stop"))] == [6.0, None]


HAPPENED: dict[str, Episode] = {
    "wait": did("wait", 4.0, 5.0),
    "leave": did("leave", 4.0, 5.0),
    "leave-left": did("leave", 4.0, 5.0, side="left"),
    "straight": did("exit-straight", 4.0, 5.0),
    "pass": did("pass", 4.0, 5.0, object=Vehicle(1)),
    "cross": did("cross", 4.0, 5.0, object=Vehicle(1)),
    "gone": they(1, "disappear", 4.0),
}
RING = Junction("roundabout")


@pytest.mark.parametrize(
    ("event", "happened", "told"),
    [
        (Event("let-go"), "wait", True),
        (Event("exit-right"), "leave", True),
        (Event("turn"), "leave", True),
        (Event("turn", side="left"), "leave-left", False),
        (Event("turn"), "leave-left", True),
        (Event("cross"), "straight", True),
        (Event("overtake", object=Vehicle(1)), "pass", True),
        (Event("pass", object=Vehicle(1)), "cross", True),
        (Event("pass", object=Vehicle(1)), "straight", False),
        (Event("pass"), "straight", True),
        (Event("leave", object=RING), "straight", True),
        (Event("leave"), "straight", False),
        (Event("leave", Vehicle(1)), "gone", True),
        (Event("leave", Vehicle(1), Junction("junction")), "gone", False),
        (Event("stop"), "leave", False),
    ],
)
def test_an_event_may_go_by_another_name(event: Event, happened: str, told: bool) -> None:
    episode = HAPPENED[happened]
    found = room.occasions(scene(episodes=(episode,), looks=BOTH), event)
    assert found == ((episode,) if told else ())


def test_its_own_name_goes_before_any_other() -> None:
    asked = scene(episodes=(did("wait", 2.0, 3.0), did("give-way", 8.0, 9.0)))
    assert names(room.occasions(asked, Event("let-go"))) == [("give-way", 8.0)]


def test_we_see_a_vehicle_from_when_it_comes_into_view() -> None:
    def late(time: float) -> Any:
        return look(1) if time >= 4.0 else None

    times = tuple(decision(t) for t in (2.0, 4.0))
    asked = scene(looks={1: late, 2: look(2, in_view=False, seen=9.0)}, traces=times)
    (on,) = room.occasions(asked, Event("see", object=Vehicle(1)))
    (off,) = room.occasions(asked, Event("see", object=Vehicle(2)))
    assert (on.actor, on.object, on.end) == (Ego(), Vehicle(1), None)
    assert (off.begin, off.end) == (0.0, 9.0)
    assert room.occasions(asked, Event("see", object=Lane())) == ()
    hidden = scene(looks={1: lambda _: None}, traces=times)
    assert room.occasions(hidden, Event("see", object=Vehicle(1))) == ()


def test_occasions_within_a_stretch_meet_it_and_a_moment_not_quite() -> None:
    asked = scene(episodes=STOPS)
    for stretch, found in (
        (Window(0.0, 4.0), []),
        (Window(0.0, 5.0), [5.0]),
        (Window(7.4, 7.4), [5.0]),
        (Window(7.6, 7.6), []),
        (Window(13.5, 20.0), []),
        (Window(13.0, 20.0), [12.0]),
    ):
        assert begins(room.within(asked, Event("stop"), stretch)) == found


@pytest.mark.parametrize(
    ("event", "span", "begin"),
    [
        (Event("stop"), None, 12.0),
        (Event("stop", time=At(5.5)), None, 5.0),
        (Event("stop", time=At(7.4)), None, 5.0),
        (Event("stop", time=At(9.0)), None, None),
        (Event("stop", time=At(12.9)), None, 12.0),
        (Event("stop", time=Between(0.0, 9.0)), None, 5.0),
        (Event("stop", time=Between(0.0, 14.0)), None, 12.0),
        (Event("stop"), Span(8.6, 8.8), 5.0),  # the nearest, as no time was said
        (Event("stop"), Span(9.6, 9.8), 12.0),
        (Event("stop"), Span(8.6, 8.8, said=True), None),
        (Event("stop", time=WholeRide()), None, 12.0),
        (Event("stop", tense="present", time=WholeRide()), None, None),
        (Event("stop", tense="present"), None, None),
        (Event("stop", tense="present"), Span(5.0, 6.0), 5.0),
        (Event("stop", tense="present"), Span(6.6, 6.6), None),
        (Event("stop", tense="past"), Span(6.6, 6.6), 5.0),
        (Event("brake"), None, None),
    ],
)
def test_the_occasion_is_the_last_that_fits(event: Event, span: Any, begin: float | None) -> None:
    found = room.occasion(scene(span, episodes=STOPS), event)
    assert (None if found is None else found.begin) == begin


@pytest.mark.parametrize(
    ("end", "tense", "going"),
    [
        (None, "present", True),
        (19.6, "present", True),
        (19.4, "present", False),
        (18.6, "future", True),  # of what is to come, a moment is not taken exactly
        (18.4, "future", True),  # nor need it go on, as no time was said
    ],
)
def test_what_is_over_for_half_a_second_goes_on_no_more(
    end: float | None, tense: Any, going: bool
) -> None:
    asked = scene(episodes=(did("stop", 17.0, end),))
    assert (room.occasion(asked, Event("stop", tense=tense)) is not None) is going


def test_of_two_at_about_a_moment_the_nearer_is_meant() -> None:
    asked = scene(episodes=(did("stop", 4.0, 5.0), did("stop", 7.0, 8.0)))
    for at, begin in ((5.7, 4.0), (6.3, 7.0)):
        found = room.occasion(asked, Event("stop", time=At(at)))
        assert found is not None
        assert found.begin == begin


def test_what_did_not_take_place_is_refused() -> None:
    asked = scene(episodes=STOPS)
    assert room.taken_place(asked, Event("stop")) == STOPS[1]
    found = result(room.taken_place, asked, Event("change-left"))
    assert found == DidNotHappen(Event("change-left"), STOPS)


def test_the_refusal_tells_when_it_was_else() -> None:
    asked = scene(episodes=STOPS)
    found = room.did_not_happen(asked, Event("stop", time=At(9.4)), planned=25.0).result
    assert isinstance(found, DidNotHappen)
    assert (found.elsewhen, found.planned, found.instead) == (12.0, 25.0, ())


@pytest.mark.parametrize(
    ("gap", "time", "episodes", "lost"),
    [
        ((8.0, 9.0), At(8.5), (), True),
        ((8.0, 9.0), At(9.5), (), False),
        ((8.0, 9.0), At(7.5), (), False),
        ((8.0, 9.0), At(8.5), (did("brake", 8.5, 9.0),), False),
        ((8.0, 9.0), At(8.5), (did("stop", 2.0, 3.0),), False),
    ],
)
def test_a_hole_in_the_record_is_told_where_nothing_else_is_known(
    gap: tuple[float, float], time: At, episodes: Any, lost: bool
) -> None:
    asked = scene(episodes=episodes, gaps=(gap,))
    found = room.did_not_happen(asked, Event("stop", time=time)).result
    if lost:
        assert found == NotRecorded("gap-in-record", since=8.0, until=9.0)
    else:
        assert isinstance(found, DidNotHappen)


def test_of_several_actors_and_objects_each_pair_counts() -> None:
    asked = scene(
        looks=BOTH,
        episodes=(
            they(1, "wait", 2.0, 3.0, object=Vehicle(2)),
            they(2, "wait", 4.0, 5.0, object=Vehicle(1)),
            did("wait", 6.0, 7.0, object=Vehicle(2)),
        ),
    )
    two = Vehicles((1, 2))
    assert begins(room.occasions(asked, Event("wait", two, two))) == [2.0, 4.0]
    assert begins(room.occasions(asked, Event("wait", Everyone(), Vehicle(1)))) == [4.0]
    assert begins(room.occasions(asked, Event("wait", Vehicle(0), two))) == [6.0]
    assert begins(room.occasions(asked, Event("wait", Passenger(), two))) == [6.0]
    for unseen in (Event("wait", Vehicle(9)), Event("wait", object=Vehicle(9))):
        assert isinstance(result(room.occasions, asked, unseen), NoSuchVehicle)
