"""What came otherwise than expected, and whether anything was amiss; asked at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.stated import belief, did, look, result, scene, they
from xavi_dialogue.domain.answers import DidNotHappen
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import At, Ego, Event, Is, Lane, Vehicle
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.ride import mistakes as room

IT, OTHER, US = Vehicle(1), Vehicle(2), Ego()
SEEN = {1: look(1), 2: look(2)}
RIGHT = belief(1, 4.0, ("exit-right", 0.9))
ALSO = belief(2, 7.0, ("exit-left", 0.8))
LEFT, STRAIGHT = they(1, "exit-left", 9.0, 12.0), they(2, "exit-straight", 8.0, 10.0)
ALL = Window(0.0, 20.0)


def wrong(of: Is, span: Span | None = None, **more: Any) -> Any:
    known = {"looks": SEEN, "episodes": (LEFT, STRAIGHT), "beliefs": (RIGHT, ALSO)}
    return result(room.wrong, of, scene(span, **(known | more)))


@pytest.mark.parametrize(
    ("vehicle", "about", "found"),
    [
        (None, ALL, [(ALSO, STRAIGHT), (RIGHT, LEFT)]),
        (1, ALL, [(RIGHT, LEFT)]),
        (None, Window(0.0, 8.5), [(ALSO, STRAIGHT)]),
        (None, Window(13.4, 13.4), [(RIGHT, LEFT)]),
        (None, Window(13.6, 13.6), []),
        (None, Window(13.0, 20.0), []),
    ],
)
def test_what_came_otherwise_is_listed_in_order(
    vehicle: Any, about: Window, found: list[Any]
) -> None:
    asked = scene(looks=SEEN, episodes=(LEFT, STRAIGHT), beliefs=(RIGHT, ALSO))
    assert list(room.mistakes(asked, vehicle, about)) == found


def test_what_came_as_expected_is_no_mistake() -> None:
    right = they(1, "exit-right", 9.0, 12.0)
    asked = scene(looks=SEEN, episodes=(right, they(1, "stop", 5.0)), beliefs=(RIGHT,))
    assert room.mistakes(asked, None, ALL) == ()
    late = belief(1, 11.0, ("exit-left", 0.9))  # only what was expected before it came counts
    assert room.mistakes(scene(looks=SEEN, episodes=(right,), beliefs=(late,)), None, ALL) == ()


def test_we_were_wrong_where_we_were() -> None:
    last = Finding(True, (LEFT,), None, (RIGHT,), mistaken=True)
    assert wrong(Is("wrong", None, tense="past")) == last
    assert wrong(Is("right", None, tense="past")).holds is False
    assert wrong(Is("wrong", IT)) == Finding(True, (LEFT,), None, (RIGHT,), mistaken=True)
    assert wrong(Is("wrong", None, time=At(3.0))) == Finding(False)
    assert wrong(Is("right", None, time=At(3.0))) == Finding(True)


@pytest.mark.parametrize(
    ("of", "came", "holds"),
    [
        (Is("right", IT), they(1, "exit-right", 9.0, 12.0), True),
        (Is("wrong", IT), they(1, "exit-right", 9.0, 12.0), False),
        (Is("right", IT), they(1, "stop", 9.0, 12.0), None),
        (Is("right", IT), None, None),
    ],
)
def test_what_was_believed_of_one_is_borne_out_or_open(of: Is, came: Any, holds: Any) -> None:
    found = wrong(of, episodes=() if came is None else (came,))
    shown = () if came is None else (came,)
    if holds is None:
        assert found == Finding(None, (RIGHT, *shown), "in-future")
    else:
        assert found == Finding(holds, shown, None, (RIGHT,))


def test_the_belief_is_that_of_the_time() -> None:
    early, late = belief(1, 2.0, ("exit-left", 0.5)), belief(1, 15.0, ("continue", 0.5))
    three = (early, RIGHT, late)
    right = they(1, "exit-right", 9.0, 12.0)
    assert wrong(Is("right", IT), beliefs=three, episodes=(right,)).believed == (RIGHT,)
    assert wrong(Is("right", IT), beliefs=three, episodes=()).facts == (late,)
    then = Is("right", IT, time=At(3.0))
    assert wrong(then, beliefs=three, episodes=(right,)).believed == (early,)
    span = Span(3.0, 9.0, said=True)
    assert wrong(Is("right", IT), span, beliefs=three, episodes=()).facts == (early,)
    just = belief(1, 7.6, ("exit-right", 0.9))  # within 1.5 s of the turn, and so not before it
    assert wrong(Is("right", IT), beliefs=(RIGHT, just), episodes=(right,)).believed == (RIGHT,)
    assert wrong(Is("right", IT), beliefs=(), episodes=(right,)) == Finding(
        None, gap="not-recorded"
    )


@pytest.mark.parametrize(
    ("peak", "crash", "amiss"),
    [
        (2.0, None, False),
        (4.0, None, True),
        (None, None, False),
        (2.0, did("collide", 7.0, 7.0), True),
        (2.0, did("nearly-collide", 7.4, 7.4), True),
        (2.0, did("nearly-collide", 7.6, 7.6), False),
        (2.0, they(1, "collide", 7.0, 7.0, object=OTHER), False),
    ],
)
def test_something_was_amiss_in_what_we_did(peak: Any, crash: Any, amiss: bool) -> None:
    brakes = did("brake", 5.0, 6.0, peak=peak)
    episodes = (brakes,) if crash is None else (brakes, crash)
    near = episodes[1:] if amiss else ()
    event = Event("brake")
    told = wrong(Is("wrong", event=event), episodes=episodes)
    assert told == Finding(amiss, (brakes, *near))
    assert wrong(Is("right", event=event), episodes=episodes).holds is not amiss
    never = wrong(Is("wrong", event=Event("stop")), episodes=episodes)
    assert isinstance(never, DidNotHappen)
    assert isinstance(wrong(Is("wrong", event=Event("stop", IT))), Finding)


# Breaking down ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("speed", "episodes", "found"),
    [
        (None, (), Finding(None, gap="out-of-view")),
        (3.0, (), Finding(False, (Measure("speed", IT, 20.0, value=3.0),))),
        (0.5, (), Finding(False, (Measure("speed", IT, 20.0, value=0.5),))),
        (0.0, (), Finding(None, gap="not-sensed")),
        (0.0, (they(1, "wait", 9.0),), Finding(False, (they(1, "wait", 9.0),))),
        (
            0.0,
            (they(1, "stop", 8.0), they(1, "give-way", 9.0)),
            Finding(False, (they(1, "give-way", 9.0),)),
        ),
        (0.0, (they(1, "wait", 9.0, 12.0),), Finding(None, gap="not-sensed")),
        (
            0.0,
            (they(1, "stop", 8.0), they(2, "wait", 9.0)),
            Finding(None, (they(1, "stand", 8.0),), "not-sensed"),
        ),
        (0.0, (they(1, "stop", 8.0, 12.0),), Finding(None, gap="not-sensed")),
    ],
)
def test_who_stands_for_nobody_may_have_broken_down(
    speed: Any, episodes: Any, found: Finding
) -> None:
    asked = scene(looks=SEEN, values={("speed", 1): speed}, episodes=episodes)
    assert room.broken_down(Is("faulty", IT), asked) == found


def test_of_several_the_latest_is_told() -> None:
    asked = scene(
        looks=SEEN,
        values={("speed", 1): 0.0, ("speed", 2): 0.0},
        episodes=(
            *(they(1, "wait", 7.0), they(1, "give-way", 9.0), they(1, "wait", 8.0)),
            *(they(2, "stop", 7.0), they(2, "stand", 9.0), they(2, "stop", 8.0)),
        ),
    )
    assert room.broken_down(Is("faulty", IT), asked).facts == (they(1, "give-way", 9.0),)
    assert room.broken_down(Is("faulty", OTHER), asked).facts == (they(2, "stand", 9.0),)


def test_we_have_not_broken_down() -> None:
    asked = scene(values={("speed", 0): 0.0})
    ours = Measure("speed", US, 20.0, value=0.0)
    assert room.broken_down(Is("faulty", US), asked) == Finding(False, (ours,))
    assert room.broken_down(Is("faulty", Lane()), asked) == Finding(None, gap="not-recorded")
