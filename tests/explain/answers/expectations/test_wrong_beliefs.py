"""What else was likely, which beliefs were wrong, and how probable a collision was."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.expectations.test_foreseen import ONE
from tests.explain.answers.stated import aim, belief, decision, look, scene, they
from tests.explain.trust import trusted
from tests.traces import End
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.explain.answers.expectations.foreseen import (
    besides,
    came_of,
    chance,
    collision_chance,
    is_open,
    wrong_belief,
)
from xavi_dialogue.explain.answers.reference.moments import Window

# --- collisions ---------------------------------------------------------------------------------


def risky(plan: Any = ("continue",)) -> Any:
    aims = {1: (aim("exit-left", 0.3), aim("continue", 0.7)), 2: (aim("continue", 1.0),)}

    def crash(chosen: Any) -> Any:
        return End("collision", collided_with=1) if chosen[1][0] == "exit-left" else End()

    return decision(10.0, plan, aims=aims, ends={plan: crash})


def test_the_chance_of_a_collision_is_that_under_the_plan() -> None:
    asked = scene(traces=[decision(5.0), risky()])
    assert collision_chance(asked, 20.0) == pytest.approx(trusted(0.3))
    assert collision_chance(asked, 20.0, 1) == pytest.approx(trusted(0.3))
    assert collision_chance(asked, 20.0, 2) == trusted(0.0)
    assert collision_chance(asked, 7.0) == trusted(0.0)
    assert collision_chance(asked, 4.0) is None
    for action in ("collide", "nearly-collide"):
        found = chance(asked, Event(action, ONE), 20.0)
        assert found == pytest.approx(trusted(0.3))


def test_where_the_whole_plan_was_not_tried_its_beginning_tells() -> None:
    trace = risky(("continue", "exit-left"))
    short = replace(
        trace, rollouts=tuple(replace(r, actions=r.actions[:1]) for r in trace.rollouts)
    )
    assert collision_chance(scene(traces=[short]), 20.0) == pytest.approx(trusted(0.3))
    untried = replace(trace, rollouts=())
    assert collision_chance(scene(traces=[untried]), 20.0) is None


# --- beliefs ------------------------------------------------------------------------------------


def test_what_else_is_likely() -> None:
    told = belief(1, 3.0, ("exit-left", 0.6), ("continue", 0.2), ("stop", 0.1),
                  ("exit-right", 0.09))  # fmt: skip
    found = besides(told, Event("exit-left", ONE))
    assert [e.actions for e in found] == [("continue",), ("stop",)]
    assert [e.actions for e in besides(told, Event("turn", ONE))] == [("continue",), ("stop",)]
    assert besides(told, Event("honk", ONE)) == ()
    assert besides(None, Event("turn", ONE)) == ()
    after = belief(1, 3.0, (("continue-next-exit", "leave"), 0.6))
    assert besides(after, Event("leave", ONE)) == ()


def wrong(event: Event, *known: Any, came: bool = True, begin: float = 15.0) -> Any:
    asked = scene(beliefs=known, looks={1: look(1)})
    found = wrong_belief(asked, event, Window(begin, begin), came)
    return None if found is None else found.time


RIGHT = Event("exit-right", ONE)


def test_the_last_belief_that_was_wrong() -> None:
    left, right = ("exit-left", 0.9), ("exit-right", 0.9)
    assert wrong(RIGHT, belief(1, 8.0, left), belief(1, 12.0, left)) == 12.0
    assert wrong(RIGHT, belief(1, 8.0, left), belief(1, 12.0, right)) == 8.0
    assert wrong(RIGHT, belief(1, 8.0, right)) is None
    assert wrong(RIGHT, belief(1, 8.0, ("exit-left", 0.7), ("exit-right", 0.3))) == 8.0
    assert wrong(RIGHT, belief(1, 8.0, right), came=False) == 8.0
    assert wrong(RIGHT, belief(1, 8.0, left), came=False) is None
    assert wrong(RIGHT, belief(1, 8.0, left), belief(1, 16.0, left)) == 8.0  # up to then


def test_a_belief_has_to_be_clear_and_recent() -> None:
    assert wrong(RIGHT, belief(1, 8.0, ("exit-left", 0.6))) == 8.0
    assert wrong(RIGHT, belief(1, 8.0, ("exit-left", 0.59))) is None
    assert wrong(RIGHT, belief(1, 5.0, ("exit-left", 0.9))) == 5.0
    assert wrong(RIGHT, belief(1, 4.9, ("exit-left", 0.9))) is None
    assert wrong(RIGHT, belief(1, 7.0, ("exit-left", 0.9)), belief(1, 8.0)) == 7.0
    early = Event("exit-right", ONE)
    assert wrong(early, belief(1, 0.0, ("exit-left", 0.9)), begin=2.0) == 0.0


def test_what_beliefs_do_not_tell_is_no_mistake() -> None:
    left = belief(1, 8.0, ("exit-left", 0.9))
    for event in (Event("overtake", ONE), Event("pass", ONE), Event("brake", ONE), Event("turn")):
        assert wrong(event, left) is None


WAYS = (
    they(1, "brake", 3.0, 4.0), they(1, "change-left", 5.0, 7.0), they(1, "stop", 8.0, 9.0),
    they(1, "exit-right", 10.0, 12.0), they(1, "exit-left", 14.0, 16.0),
)  # fmt: skip


@pytest.mark.parametrize(
    ("told", "since", "came"),
    [
        (WAYS, 2.0, WAYS[3]),  # where it went tells more than how
        (WAYS, 13.0, WAYS[4]),
        (WAYS, 11.0, WAYS[3]),
        (WAYS[:3], 2.0, WAYS[1]),
        (WAYS[:3], 5.4, WAYS[1]),
        (WAYS[:3], 7.5, WAYS[2]),
        (WAYS[:3], 9.5, None),
        (WAYS[:3], 8.8, None),  # it stood already
        (WAYS[:1], 2.0, None),
        ((they(1, "exit-straight", 9.0), WAYS[1]), 2.0, they(1, "exit-straight", 9.0)),
        ((they(1, "change-right", 9.0),), 2.0, they(1, "change-right", 9.0)),
    ],
)
def test_what_a_vehicle_did_first_that_tells_where_it_went(
    told: Any, since: float, came: Any
) -> None:
    asked = scene(episodes=(*told, they(2, "exit-left", since)), looks={1: look(1), 2: look(2)})
    assert came_of(asked, 1, since) == came


@pytest.mark.parametrize(
    ("told", "seen", "still"),
    [
        ((), look(1), True),
        ((), look(1, in_view=False), False),
        ((they(1, "change-left", 9.0),), look(1), True),
        ((they(1, "change-right", 9.0),), look(1), True),
        ((they(1, "exit-left", 9.0),), look(1), False),
        ((they(1, "stop", 9.0),), look(1), False),
        ((they(1, "exit-left", 4.0, 6.0),), look(1), True),  # before
    ],
)
def test_whether_it_is_yet_to_be_seen(told: Any, seen: Any, still: bool) -> None:
    asked = scene(episodes=told, looks={1: seen})
    assert is_open(asked, belief(1, 8.0, ("continue", 0.9))) is still


def test_of_the_unseen_nothing_is_open() -> None:
    assert is_open(scene(), belief(1, 8.0, ("continue", 0.9))) is False
