"""Whose way met ours at a junction, who came there first, and who stood meanwhile."""

from typing import Any

import pytest

from tests.explain.answers.stated import (
    US,
    decision,
    did,
    driven,
    look,
    place,
    roads,
    scene,
    they,
)
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.ride.crossings import (
    crossing_now,
    entries,
    line_order,
    met_about,
    stood,
    went_first,
)

ONE, TWO = Vehicle(1), Vehicle(2)
ALL = Window(0.0, 20.0)


# --- who crosses our way now --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("looks", "priority", "told", "who"),
    [
        ({1: 30.0, 2: 20.0}, [(1, "vehicle"), (2, "vehicle")], (), 2),
        ({1: 30.0, 2: 20.0}, [(1, "vehicle"), (2, "ego")], (), 1),
        ({1: 30.0, 2: 20.0}, [(1, "ego"), (2, "vehicle")], (did("give-way", 18.0, object=ONE),), 1),
        ({1: 30.0, 2: 20.0}, [(1, "ego"), (2, "vehicle")],
         (did("give-way", 15.0, 19.9, object=ONE),), 2),
        ({1: 30.0}, [(1, "depends"), (3, "vehicle")], (), 1),
        ({}, [(1, "vehicle")], (), None),
        ({1: 30.0}, [], (), None),
    ],
)  # fmt: skip
def test_who_crosses_next(looks: Any, priority: Any, told: Any, who: int | None) -> None:
    seen = {v: look(v, ahead) for v, ahead in looks.items()}
    assert crossing_now(scene(looks=seen, road=roads(*priority), episodes=told)) == who


def test_who_is_out_of_view_or_off_the_record_does_not_cross() -> None:
    lost = {1: look(1, in_view=False)}
    assert crossing_now(scene(looks=lost, road=roads((1, "vehicle")))) is None
    assert crossing_now(scene(looks={1: look(1)})) is None


# --- who came first -----------------------------------------------------------------------------

#: We drive east and are at x = 100 m at 10 s.
OURS = driven([10.0 * k for k in range(21)])


def crossing(at: float, *, x: float = 100.0, y: float = 0.0) -> Any:
    """Somebody who drives north and comes to (x, y) at a time [s]."""
    return driven([x] * 21, ys=[y + 10.0 * (k - at) for k in range(21)])


@pytest.mark.parametrize(
    ("theirs", "order"),
    [
        (crossing(8.0), (10.0, 8.0)),
        (crossing(12.0), (10.0, 12.0)),
        (crossing(8.0, x=102.4), (10.0, 8.0)),
        (crossing(8.0, x=105.0), None),
        (crossing(8.0, x=250.0), None),
    ],
)
def test_the_order_in_which_lines_are_come_to(theirs: Any, order: Any) -> None:
    asked = scene(motions={0: OURS, 1: theirs}, looks={1: look(1)})
    assert line_order(asked, 1, ALL) == order
    first = None if order is None else (US if order[0] < order[1] else ONE)
    assert went_first(asked, 1, ALL, None) == first


def test_only_who_moves_in_the_stretch_crosses() -> None:
    asked = scene(motions={0: OURS, 1: crossing(8.0)}, looks={1: look(1)})
    assert line_order(asked, 1, Window(9.0, 20.0)) is None
    assert line_order(asked, 1, Window(0.0, 9.0)) is None
    stands = driven([100.0] * 21, speed=0.5)
    assert line_order(scene(motions={0: OURS, 1: stands}), 1, ALL) is None
    creeps = driven([100.0] * 21, speed=0.6)
    assert line_order(scene(motions={0: OURS, 1: creeps}), 1, ALL) == (10.0, 0.0)
    halted = driven([10.0 * k for k in range(21)], speed=0.5)
    assert line_order(scene(motions={0: halted, 1: crossing(8.0)}), 1, ALL) is None


def inside(*times: float, vehicle: int = 0, **more: Any) -> list[Any]:
    """A decision each second; a vehicle is in a junction at some times."""
    kinds = {"in_junction": True} | more
    return [
        decision(float(t), road=roads(places={
            vehicle: place(**kinds) if float(t) in times else place(), 9: place(),
        }))
        for t in range(21)
    ]  # fmt: skip


def test_junctions_are_entered_where_we_are_first_inside() -> None:
    assert entries(scene(traces=inside(5.0, 6.0, 12.0))) == [5.0, 12.0]
    assert entries(scene(traces=inside(0.0, 1.0, 12.0))) == [0.0, 12.0]
    assert entries(scene(traces=inside())) == []
    assert entries(scene(traces=inside(5.0, in_junction=False, roundabout=True))) == [5.0]
    assert entries(scene(traces=inside(5.0, vehicle=1))) == []
    assert entries(scene()) == []


def both(ours: Any, theirs: Any) -> list[Any]:
    """Where we and another vehicle are inside a junction, by decision."""
    return [
        decision(float(t), road=roads(places={
            0: place(in_junction=float(t) in ours), 1: place(in_junction=float(t) in theirs),
        }))
        for t in range(21)
    ]  # fmt: skip


WAITS = (they(1, "wait", 4.0, 9.0),)


@pytest.mark.parametrize(
    ("traces", "told", "first"),
    [
        (both((5.0, 6.0), ()), WAITS, US),
        (both((5.0, 6.0), ()), (they(1, "give-way", 4.0, 9.0),), US),
        (both((5.0, 6.0), ()), (they(1, "stop", 4.0, 9.0),), US),
        (both((5.0, 6.0), ()), (they(1, "stand", 4.0, 9.0),), US),
        (both((5.0, 6.0), ()), (), None),
        (both((5.0, 6.0), (6.0,)), WAITS, None),
        (both((), ()), WAITS, None),
        (both((), (5.0, 6.0)), (), ONE),
        (both((), (19.0, 20.0)), (), None),  # it is still inside
        (both((12.0,), (5.0, 6.0)), (), None),
    ],
)
def test_where_lines_do_not_meet_the_junction_tells(traces: Any, told: Any, first: Any) -> None:
    asked = scene(traces=traces, episodes=told, looks={1: look(1)})
    assert went_first(asked, 1, ALL, None) == first


def test_only_the_stretch_counts() -> None:
    asked = scene(traces=both((5.0, 6.0), ()), episodes=WAITS, looks={1: look(1)})
    assert went_first(asked, 1, Window(6.0, 20.0), None) is None
    assert went_first(asked, 1, Window(5.0, 20.0), None) == US
    gone = scene(traces=both((), (5.0, 6.0)), looks={1: look(1)})
    assert went_first(gone, 1, Window(7.0, 20.0), None) is None
    late = scene(traces=both((15.0,), ()), episodes=WAITS, looks={1: look(1)})
    assert went_first(late, 1, Window(9.5, 20.0), None) is None  # it no longer waits


def test_else_whom_we_stood_for_went_first() -> None:
    asked = scene(looks={1: look(1)})
    stood_ = did("give-way", 4.0, 9.0, standing=True)
    assert went_first(asked, 1, ALL, stood_) == ONE
    assert went_first(asked, 1, ALL, did("give-way", 4.0, standing=True)) is None
    assert went_first(asked, 1, ALL, did("give-way", 4.0, 9.0)) is None
    assert went_first(asked, None, ALL, stood_) is None


def test_who_stood_when_we_came_in() -> None:
    for speed, stands in ((0.4, True), (0.5, False)):
        values = {("speed", 1): lambda t, v=speed: v if t == 6.0 else 9.0}  # 1 s later
        asked = scene(traces=inside(5.0), looks={1: look(1)}, values=values)
        assert stood(asked, 1, ALL) is stands
        assert stood(asked, 1, Window(6.0, 20.0)) is False
        assert stood(asked, 1, Window(0.0, 4.0)) is False
    stands_then = {("speed", 1): lambda t: 0.0 if t == 6.0 else 9.0}
    twice = scene(traces=inside(5.0, 12.0), looks={1: look(1)}, values=stands_then)
    assert stood(twice, 1, ALL) is False  # the last junction counts
    assert stood(twice, 1, Window(0.0, 10.0)) is True
    assert stood(scene(traces=inside(5.0), looks={1: look(1)}), 1, ALL) is False


# --- whom we met --------------------------------------------------------------------------------


def test_whom_we_met_is_the_last_of_the_stretch() -> None:
    traces = [
        decision(2.0, road=roads((1, "vehicle"))),
        decision(9.0, road=roads((2, "ego"), (1, "vehicle"))),
        decision(11.0, road=roads((3, "depends"))),
        decision(12.0),
    ]
    asked = scene(traces=traces)
    assert met_about(asked, Window(10.0, 13.0)) == 1  # who goes before us
    assert met_about(asked, Window(0.0, 8.9)) == 1
    assert met_about(asked, Window(8.0, 9.5)) == 1
    assert met_about(asked, Window(8.1, 8.9)) is None  # 6 s before at most
    assert met_about(asked, Window(8.0, 8.9)) == 1
    assert met_about(asked, Window(16.0, 18.0)) is None
    waited = (did("give-way", 5.0, 6.0, object=ONE), did("give-way", 12.0, 13.0, object=TWO))
    assert met_about(scene(traces=traces, episodes=waited[:1]), Window(10.0, 13.0)) == 1
    assert met_about(scene(traces=traces, episodes=waited), Window(10.0, 13.0)) == 2
    other = (did("give-way", 5.0, 6.0, object=Vehicle(7)),)
    assert met_about(scene(traces=traces, episodes=other), Window(10.0, 13.0)) == 1


def test_whom_we_met_is_the_closest_of_those_who_go_before_us() -> None:
    both = [decision(9.0, road=roads((1, "ego"), (2, "vehicle"), (3, "vehicle")))]
    looks = {1: look(1, distance=5.0), 2: look(2, distance=40.0), 3: look(3, distance=30.0)}
    assert met_about(scene(traces=both, looks=looks), Window(9.0, 10.0)) == 3
    gone = looks | {3: look(3, distance=30.0, in_view=False)}
    assert met_about(scene(traces=both, looks=gone), Window(9.0, 10.0)) == 2
    none = [decision(9.0, road=roads((1, "ego"), (4, "ego")))]
    assert met_about(scene(traces=none, looks=looks), Window(9.0, 10.0)) == 1


def test_as_long_as_we_are_inside_nobody_has_gone_first() -> None:
    asked = scene(
        traces=both((19.0, 20.0), ()), episodes=(they(1, "wait", 15.0),), looks={1: look(1)}
    )
    assert went_first(asked, 1, ALL, None) is None
