"""How probable an event was for the car at a time, by what it predicted of others."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.prediction.goals import BRANCHES
from planner.record.trace import HeldUp, TrajectoryPrediction
from tests.explain.answers.stated import US, aim, decision, look, scene, they
from tests.traces import Aim, Way
from xavi_dialogue.domain.facts import Belief, Expectation
from xavi_dialogue.domain.terms import Event, Road, Vehicle
from xavi_dialogue.explain.answers.expectations.foreseen import (
    besides,
    chance,
    contains,
    foretells,
    macros,
    sided,
    unconsidered,
)

ONE, TWO = Vehicle(1), Vehicle(2)


def held(vehicle: int = 0, how: Any = "right-of-way") -> tuple[HeldUp, ...]:
    return (HeldUp(vehicle, 0.0, 4.0, how, 10.0, 10.0),)


def way(*actions: Any, speed: tuple[float, ...] = (10.0, 10.0), held_up: Any = ()) -> Any:
    path = tuple((float(k), 0.0) for k in range(len(speed)))
    return TrajectoryPrediction(1.0, actions or ("continue",), path, speed, held_up)


# --- names --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "action", "means"),
    [
        (Event("turn", side="left"), "exit-left", ("exit-left",)),
        (Event("turn", side="right"), "exit-right", ("exit-right",)),
        (Event("leave", side="straight"), "exit-straight", ("continue", "exit-straight")),
        (Event("turn"), "turn", ("exit-left", "exit-right")),
        (Event("leave"), "leave", ("exit-left", "exit-right", "exit-straight")),
        (Event("change-lane", side="left"), "change-left", ("change-left",)),
        (Event("change-lane", side="right"), "change-right", ("change-right",)),
        (Event("overtake", side="left"), "change-left", ("change-left",)),
        (Event("merge", side="right"), "change-right", ("change-right",)),
        (Event("merge"), "merge", ("change-left", "change-right")),
        (Event("cut-in", side="left"), "cut-in", ("change-left", "change-right")),
        (Event("overtake"), "overtake", ("change-left", "change-right")),
        (Event("change-lane", side="straight"), "change-lane", ("change-left", "change-right")),
        (Event("continue"), "continue", ("continue", "exit-straight")),
        (Event("pass"), "pass", ("continue", "exit-straight")),
        (Event("keep-lane"), "keep-lane", ("continue",)),
        (Event("stop"), "stop", ("stop",)),
        (Event("exit-left"), "exit-left", ("exit-left",)),
        (Event("continue-next-exit"), "continue-next-exit", ("continue-next-exit",)),
        (Event("brake"), "brake", ()),
        (Event("signal", side="left"), "signal", ()),
    ],
)
def test_what_an_event_stands_for(event: Event, action: str, means: Any) -> None:
    assert (sided(event), macros(event)) == (action, means)


@pytest.mark.parametrize(
    ("actions", "event", "has"),
    [
        (("continue", "exit-left"), Event("turn"), True),
        (("continue", "exit-left"), Event("turn", side="right"), False),
        (("continue", "exit-left"), Event("leave"), True),
        (("continue-next-exit", "exit-left"), Event("leave"), False),  # not at the next one
        (("continue-next-exit", "exit-left"), Event("leave", side="left"), True),
        (("continue",), Event("leave"), False),
        (("continue",), Event("keep-lane"), True),
        (("continue",), Event("brake"), None),
    ],
)
def test_whether_actions_are_of_an_event(actions: Any, event: Event, has: Any) -> None:
    assert contains(actions, event) is has


# --- one way ------------------------------------------------------------------------------------

CALM, SLOWS, STARTS = (10.0, 10.0), (10.0, 8.0), (0.0, 2.0)


@pytest.mark.parametrize(
    ("action", "path", "does"),
    [
        ("give-way", way(held_up=held()), True),
        ("give-way", way(held_up=held(2)), False),
        ("give-way", way(held_up=held(how="leader")), False),
        ("give-way", way("stop"), False),
        ("let-go", way(held_up=held()), True),
        ("wait", way("stop"), True),
        ("wait", way(), False),
        ("stop", way("stop"), True),
        ("stop", way(speed=(10.0, 0.0)), True),
        ("stop", way(), False),
        ("stop", way(speed=(0.0, 5.0), held_up=held()), True),  # stays where it lets us go first
        ("stop", way(speed=(0.9, 5.0), held_up=held()), True),
        ("stop", way(speed=(1.1, 5.0), held_up=held()), False),
        ("stand", way(speed=(0.0, 5.0), held_up=held()), True),
        ("stand", way(speed=(), held_up=held()), False),
        ("brake", way(speed=SLOWS), True),
        ("brake", way(speed=CALM), False),
        ("slow-down", way(speed=SLOWS), True),
        ("slow-down", way(speed=CALM), False),
        ("speed-up", way(speed=STARTS), True),
        ("speed-up", way(speed=CALM), False),
        ("cross", way(held_up=held()), False),
        ("cross", way(speed=CALM), True),
        ("enter", way(held_up=held(2)), True),
        ("pull-out", way(held_up=held()), False),
        ("go", way(speed=STARTS), True),
        ("go", way(speed=(0.0, 1.0)), True),
        ("go", way(speed=(0.0, 0.9)), False),
        ("go", way(speed=CALM, held_up=held()), True),
        ("go", way(speed=(1.0, 1.0)), True),
        ("go", way(speed=(0.9, 0.9)), False),
        ("go", way(speed=(10.0, 0.0)), False),
        ("go", way(speed=()), None),
        ("turn", way("exit-left"), True),
        ("turn", way("continue"), False),
        ("honk", way("continue"), None),
    ],
)
def test_what_a_predicted_way_tells(action: Any, path: Any, does: Any) -> None:
    assert foretells(path, Event(action, ONE)) is does


def test_to_whom_it_gives_way() -> None:
    to_two = way(held_up=held(2))
    assert foretells(to_two, Event("give-way", ONE, TWO)) is True
    assert foretells(to_two, Event("give-way", ONE, US)) is False
    assert foretells(way(held_up=held()), Event("give-way", ONE, US)) is True


# --- chances ------------------------------------------------------------------------------------


def likely(event: Event, *aims: Aim, at: float = 20.0, **facts: Any) -> float | None:
    """The chance that vehicle 1 does something; its goals are given."""
    traces = facts.pop("traces", [decision(10.0, aims={1: aims})])
    return chance(scene(traces=traces, **({"looks": {1: look(1)}} | facts)), event, at)


def test_the_chance_is_the_sum_over_goals_and_ways() -> None:
    aims = (
        aim("exit-left", 0.5, ways=(Way(("exit-left",), 0.6), Way(("change-left",), 0.4))),
        aim("continue", 0.5, ways=(Way(("change-left",), 0.2), Way(("continue",), 0.8))),
    )
    assert likely(Event("exit-left", ONE), *aims) == pytest.approx(0.3)
    assert likely(Event("change-lane", ONE, side="left"), *aims) == pytest.approx(0.3)
    assert likely(Event("exit-right", ONE), *aims) == 0.0
    assert likely(Event("honk", ONE), *aims) is None
    over = (aim("exit-left", 0.7), aim("exit-left", 0.5))
    assert likely(Event("exit-left", ONE), *over) == 1.0


def test_it_is_of_the_decision_of_that_time_and_of_another_vehicle() -> None:
    traces = [
        decision(5.0, aims={1: (aim("exit-left", 0.2), aim("continue", 0.8))}),
        decision(10.0, aims={1: (aim("exit-left", 0.9), aim("continue", 0.1))}),
        decision(12.0),
    ]
    turn = Event("exit-left", ONE)
    assert likely(turn, at=7.0, traces=traces) == pytest.approx(0.2)
    assert likely(turn, at=20.0, traces=traces) == pytest.approx(0.9)
    assert likely(turn, at=3.0, traces=traces) is None
    assert likely(Event("exit-left"), traces=traces) is None
    assert likely(Event("exit-left", TWO), traces=traces) is None


def test_who_stops_for_others_is_not_predicted() -> None:
    aims = (aim("stop", 0.3), aim("continue", 0.7))
    assert likely(Event("stop", ONE), *aims) == pytest.approx(0.3)
    assert likely(Event("stop", ONE, TWO), *aims) is None


def test_who_gave_way_to_us_soon_after_stopped_for_that() -> None:
    aims = (
        aim("stop", 0.3),
        aim("continue", 0.7, ways=(Way(("continue",), 1.0, (), held()),)),
    )
    given = (they(1, "give-way", 12.0, 14.0, object=US),)
    assert likely(Event("stop", ONE), *aims, at=10.0, episodes=given) == pytest.approx(0.7)
    late = (they(1, "give-way", 18.5, 19.0, object=US),)
    assert likely(Event("stop", ONE), *aims, at=10.0, episodes=late) == pytest.approx(0.3)


def test_who_stops_for_us_gives_way() -> None:
    aims = (
        aim("stop", 0.3),
        aim("continue", 0.7, ways=(Way(("continue",), 1.0, (), held()),)),
    )
    for action in ("stop", "slow-down", "brake"):
        assert likely(Event(action, ONE, US), *aims) == pytest.approx(0.7)
    assert likely(Event("stop", ONE), *aims) == pytest.approx(0.3)


def test_a_road_that_branches_off_is_a_way_to_leave() -> None:
    aims = (
        Aim("continue", 0.4, (Way(("continue",)),), BRANCHES["right"]),
        Aim("continue", 0.6, (Way(("continue",)),)),
    )
    assert likely(Event("leave", ONE), *aims) == pytest.approx(0.4)
    for action in ("continue", "exit-straight", "keep-lane"):
        assert likely(Event(action, ONE), *aims) == pytest.approx(0.6)
    assert likely(Event("exit-left", ONE), *aims) == 0.0


@pytest.mark.parametrize(
    ("action", "seen", "share"),
    [
        ("cut-in", look(1, 20.0, 3.5, bearing="beside-left"), 0.3),  # to its right
        ("cut-in", look(1, 20.0, 0.5, bearing="ahead-left"), 0.3),
        ("cut-in", look(1, 20.0, -3.5, bearing="ahead-right"), 0.2),  # to its left
        ("pull-out", look(1, -9.0, -3.5, bearing="behind-right"), 0.2),
        ("pull-out", look(1, 20.0, bearing="ahead"), 0.5),
        ("pull-out", look(1, -20.0, bearing="behind"), 0.5),
        ("cut-in", look(1, 20.0, 0.0, bearing="ahead"), 0.2),
        ("cut-in", look(1, 20.0, 3.5, bearing="ahead-left", oncoming=True), 0.5),
        ("cut-in", look(1, 20.0, 3.5, bearing="ahead-left", speed=0.9), 0.5),
        ("cut-in", look(1, 20.0, 3.5, bearing="ahead-left", speed=1.0), 0.3),
        ("cut-in", look(1, 20.0, 3.5, bearing="crossing-left"), 0.5),
        ("change-left", look(1, 20.0, 3.5, bearing="ahead-left"), 0.2),
    ],
)
def test_who_drives_beside_us_cuts_in_to_our_side(action: Any, seen: Any, share: float) -> None:
    aims = (aim("change-left", 0.2), aim("change-right", 0.3), aim("continue", 0.5))
    found = likely(Event(action, ONE, US), *aims, looks={1: seen})
    assert found == pytest.approx(share)


def pathed(time: float, path: Any, speed: Any, **more: Any) -> Any:
    """A decision to go east along the x axis at 10 m/s, with what vehicle 1 is thought to do."""
    trace = decision(time, aims={1: (aim("continue", 1.0, **more),)})
    ours = tuple((2.0 * k, 0.0) for k in range(11))
    rollouts = tuple(replace(r, path=ours, speed=(10.0,) * 11) for r in trace.rollouts)
    known = trace.predictions[0]
    goal = known.goals[0]
    moved = replace(goal.trajectories[0], path=path, speed=speed)
    goals = (replace(goal, trajectories=(moved,)),)
    return replace(trace, rollouts=rollouts, predictions=(replace(known, goals=goals),))


#: Our ways meet at x = 16 m, where we are 1.6 s after the decision; it comes there early or late.
EARLY = tuple((16.0, -4.0 + 4.0 * k) for k in range(11))
LATE = tuple((16.0, -40.0 + 4.0 * k) for k in range(11))
APART = tuple((16.0, 40.0 + 4.0 * k) for k in range(11))
FAST = (20.0,) * 11


@pytest.mark.parametrize(
    ("action", "path", "share"),
    [
        ("cross", EARLY, 1.0),
        ("cross", LATE, 0.0),
        ("pull-out", EARLY, 1.0),
        ("pull-out", LATE, 0.0),
        ("give-way", EARLY, 0.0),
        ("give-way", LATE, 1.0),
        ("let-go", LATE, 1.0),
        ("cross", APART, 0.0),
        ("give-way", APART, 0.0),
        ("go", LATE, 1.0),  # no matter of who is first
    ],
)
def test_who_comes_first_where_our_ways_meet(action: Any, path: Any, share: float) -> None:
    traces = [pathed(10.0, path, FAST)]
    looks = {1: look(1, bearing="crossing-left")}
    for whom in (US, None):
        assert likely(Event(action, ONE, whom), traces=traces, looks=looks) == share
    if action == "cross":  # before somebody else, whom no predicted way meets
        assert likely(Event(action, ONE, TWO), traces=traces, looks=looks) is None


def test_into_our_road() -> None:
    into = (
        *((16.0, -12.0 + 4.0 * k) for k in range(3)),
        *((17.0 + 4.0 * k, 0.0) for k in range(6)),
    )
    event = Event("enter", ONE, Road("own"))
    assert likely(event, traces=[pathed(10.0, into, FAST)]) == 1.0
    assert likely(event, traces=[pathed(10.0, EARLY, FAST)]) == 0.0
    side = Event("enter", ONE, Road("side"))
    assert likely(side, traces=[pathed(10.0, EARLY, FAST)]) == 1.0


# --- what was left out of account ---------------------------------------------------------------


def sole(*priors: float) -> Any:
    """A decision that reckons with vehicle 1 going straight on only; priors of its roads."""
    trace = decision(10.0, aims={1: tuple(aim("continue", 1.0 / len(priors)) for _ in priors)})
    known = trace.predictions[0]
    pairs = zip(known.goals, priors, strict=True)
    goals = tuple(replace(goal, prior=prior, edge="on") for goal, prior in pairs)
    return replace(trace, predictions=(replace(known, goals=goals),))


@pytest.mark.parametrize(
    ("event", "priors", "left_out"),
    [
        (Event("leave", ONE), (0.99,), True),
        (Event("turn", ONE, side="left"), (0.99,), True),
        (Event("exit-right", ONE), (0.99,), True),
        (Event("turn", ONE), (0.5, 0.5), False),  # other roads were weighed, and ruled out
        (Event("change-lane", ONE), (0.99,), False),
        (Event("continue", ONE), (0.99,), False),
        (Event("stop", ONE), (0.99,), False),
    ],
)
def test_a_turn_that_was_not_considered_has_no_chance(
    event: Any, priors: Any, left_out: Any
) -> None:
    asked = scene(traces=[sole(*priors)], looks={1: look(1)})
    told = unconsidered(asked, event, 20.0)
    assert (told is not None, chance(asked, event, 20.0) is None) == (left_out, left_out)
    if told is not None:
        assert (told.actor, told.unconsidered, told.signal) == (ONE, event, None)


def test_where_it_goes_is_no_alternative_to_whether_it_stops() -> None:
    on = Expectation(("continue",), 0.57)
    belief = Belief(1, 10.0, (on, Expectation(("exit-left",), 0.43)))
    assert besides(belief, Event("stop", ONE, US)) == ()
    assert besides(belief, Event("turn", ONE, side="left")) == (on,)
