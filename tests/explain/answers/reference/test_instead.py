"""What is told in place of what did not happen, what is nearest, and what counts once; at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.stated import did, look, scene, they
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    At,
    Event,
    Everyone,
    Passenger,
    Vehicle,
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


def test_instead_is_what_is_most_alike() -> None:
    episodes = (
        did("change-left", 3.0, 5.0),
        did("wait", 7.0, 8.0),
        did("follow", 9.0, 12.0),
        they(1, "brake", 9.0, 10.0),
    )

    def told(event: Event, *kept: Episode) -> Any:
        return names(room.instead(scene(episodes=kept, looks=BOTH), event, Window(0.0, 20.0)))

    assert told(Event("stop"), *episodes) == [("wait", 7.0)]
    assert told(Event("cut-in"), *episodes) == [("change-left", 3.0)]
    assert told(Event("speed-up"), *episodes) == [("change-left", 3.0), ("wait", 7.0)]
    assert told(Event("stop"), episodes[0], episodes[2]) == [("change-left", 3.0)]
    assert told(Event("stop"), episodes[2]) == [("follow", 9.0)]
    assert told(Event("stop", Vehicle(1)), *episodes) == [("brake", 9.0)]
    assert told(Event("stop", Passenger()), *episodes) == [("wait", 7.0)]
    assert told(Event("stop", Everyone()), *episodes) == [("wait", 7.0), ("brake", 9.0)]


def test_the_two_nearest_in_time_are_told_in_order() -> None:
    episodes = (
        did("wait", 2.0, 3.0),
        did("change-right", 6.0, 6.5),
        did("brake", 8.0, 9.0),
        did("slow-down", 7.5, 9.5),
        did("give-way", 13.0, 14.0),
    )
    asked = scene(episodes=episodes)
    about = Window(10.0, 10.0)
    assert names(room.instead(asked, Event("stop"), about)) == [
        ("slow-down", 7.5),  # which has the braking in it
        ("give-way", 13.0),
    ]
    said = Event("stop", time=At(4.5))
    assert names(room.instead(asked, said, Window(4.5, 4.5))) == [("wait", 2.0), ("slow-down", 7.5)]
    late = Event("stop", time=At(18.0))
    assert names(room.instead(asked, late, Window(18.0, 18.0))) == []
    inferred = room.instead(asked, Event("stop"), Window(18.0, 18.0))
    assert names(inferred) == [("slow-down", 7.5), ("give-way", 13.0)]


def test_seeing_is_no_driving() -> None:
    asked = scene(
        episodes=(they(1, "appear", 1.0), they(1, "signal", 4.0, 6.0), they(1, "follow", 3.0)),
        looks=BOTH,
    )
    whole = Window(0.0, 20.0)
    assert names(room.instead(asked, Event("stop", Vehicle(1)), whole)) == [("follow", 3.0)]
    assert names(room.instead(asked, Event("disappear", Vehicle(1)), whole)) == [
        ("follow", 3.0),
        ("signal", 4.0),
    ]


@pytest.mark.parametrize(
    ("about", "far", "meets"),
    [
        (Window(0.0, 3.0), 2.0, False),
        (Window(0.0, 5.0), 0.0, True),
        (Window(5.5, 5.6), 0.0, True),
        (Window(6.0, 9.0), 0.0, True),
        (Window(9.0, 9.5), 3.0, False),
    ],
)
def test_how_far_an_episode_lies_from_a_stretch(about: Window, far: float, meets: bool) -> None:
    asked = scene()
    assert room.away(asked, STOPS[0], about) == far
    assert room.overlaps(asked, STOPS[0], about) is meets


def test_what_goes_on_reaches_up_to_now() -> None:
    asked, on = scene(), did("stop", 15.0)
    assert room.overlaps(asked, on, Window(19.0, 19.0))
    assert room.away(asked, on, Window(23.0, 24.0)) == 3.0
    assert room.duration(asked, on) == 5.0
    assert room.duration(asked, STOPS[0]) == 1.0
    assert room.duration(asked, did("stop", 5.0, 4.0)) == 0.0
    planned = did("stop", 25.0)
    assert room.overlaps(asked, planned, Window(30.0, 31.0))


def test_of_several_as_near_the_last_is_nearest() -> None:
    two = (did("stop", 4.0, 6.0), did("stop", 5.0, 6.0))
    assert room.nearest(scene(), two, Window(8.0, 9.0)) is two[1]
    assert room.nearest(scene(), two[::-1], Window(8.0, 9.0)) is two[1]
    assert room.nearest(scene(), STOPS, Window(8.0, 9.4)) is STOPS[0]


@pytest.mark.parametrize(
    ("episodes", "kept"),
    [
        ((did("wait", 2.0, 5.0), did("stop", 3.0, 4.0)), [2.0]),
        ((did("wait", 2.0, 5.0), did("stop", 5.4, 7.0)), [2.0]),
        ((did("wait", 2.0, 5.0), did("stop", 5.5, 7.0)), [2.0, 5.5]),
        ((did("wait", 2.0), did("stop", 19.0)), [2.0]),
        ((did("wait", 2.0, 5.0), they(1, "stop", 3.0, 4.0)), [2.0, 3.0]),
        ((did("stop", 2.0, 3.0), they(1, "stop", 2.5), did("stop", 2.8, 4.0)), [2.0, 2.5]),
        ((did("change-left", 2.0, 5.0), did("change-left", 5.0, 7.0)), [2.0, 5.0]),
        ((did("change-left", 2.0, 5.0), did("change-left", 4.9, 7.0)), [2.0]),
        ((did("change-left", 2.0, 5.0), did("change-right", 5.0, 7.0)), [2.0, 5.0]),
        ((did("stop", 2.0, 5.0), did("stop", 5.0, 7.0)), [2.0]),
        (
            (did("wait", 2.0, 5.0, object=Vehicle(1)), did("wait", 3.0, 4.0, object=Vehicle(2))),
            [2.0, 3.0],
        ),
        (
            (did("wait", 2.0, 5.0, object=Vehicle(1)), did("wait", 3.0, 4.0, object=Vehicle(1))),
            [2.0],
        ),
        ((did("wait", 2.0, 5.0, object=Vehicle(1)), did("wait", 3.0, 4.0)), [2.0]),
        ((did("wait", 2.0, 5.0), did("wait", 3.0, 4.0, object=Vehicle(1))), [2.0]),
        ((did("wait", 2.0, 3.0), did("stop", 2.0, 5.0), did("stand", 5.2, 6.0)), [2.0]),
    ],
)
def test_what_runs_on_counts_once(episodes: Any, kept: list[float]) -> None:
    assert begins(room.merged(scene(), episodes)) == kept
