"""What passengers call an action, and what that means to the planner."""

from typing import get_args

import pytest

from planner.record.trace import ACTIONS
from tests.traces import s1_world, trace_of
from xavi_dialogue.causal.model import Actions, CausalModel
from xavi_dialogue.domain.answers import NotApplicable
from xavi_dialogue.domain.terms import Event, Junction, Lane, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.vehicles.actions import (
    is_macro,
    means,
    names_of,
    same,
    sequence,
    to_macros,
)
from xavi_dialogue.explain.history.ride import Unanswered


def test_the_planners_actions_mean_themselves() -> None:
    for action in get_args(ActionName):
        assert is_macro(action) is (action in ACTIONS)
    assert means("change-left") == ("change-left",)
    assert means("continue") == ("continue", "exit-straight")
    assert means("turn") == ("exit-left", "exit-right")
    assert means("speed-up") == ()


@pytest.mark.parametrize(
    ("one", "other", "alike"),
    [
        ("turn", "exit-left", True),
        ("exit-left", "turn", True),
        ("stop", "wait", True),
        ("speed-up", "speed-up", True),
        ("turn", "change-left", False),
        ("speed-up", "slow-down", False),
    ],
)
def test_two_names_of_one_deed(one: ActionName, other: ActionName, alike: bool) -> None:
    assert same(one, other) is alike


@pytest.mark.parametrize(
    ("event", "names"),
    [
        (Event("change-lane", side="left"), ("change-left",)),
        (Event("change-lane"), ("change-left", "change-right")),
        (Event("merge", side="right"), ("change-right",)),
        (Event("enter", object=Lane("left"), side="left"), ("change-left",)),
        (Event("leave", object=Lane()), ("change-left", "change-right")),
        (Event("enter", object=Junction()), ("go",)),
        (Event("overtake", side="right"), ("change-right",)),
        (Event("overtake", object=Vehicle(1)), ("overtake",)),
        (Event("pass"), ("overtake",)),
        (Event("turn", side="straight"), ("exit-straight",)),
        (Event("turn"), ("exit-left", "exit-right")),
        (Event("leave", side="right"), ("exit-right",)),
        (Event("leave"), ("exit-left", "exit-right", "exit-straight")),
        (Event("brake"), ("slow-down",)),
        (Event("let-go"), ("give-way",)),
        (Event("stop"), ("stop",)),
    ],
)
def test_what_an_event_is_called(event: Event, names: tuple[ActionName, ...]) -> None:
    assert names_of(event) == names


def test_what_is_done_after_it() -> None:
    last = Event("stop")
    then = Event("turn", then=last)
    first = Event("change-lane", then=then)
    assert sequence(first) == (first, then, last)
    assert sequence(last) == (last,)


@pytest.mark.parametrize(
    ("asked", "node", "found"),
    [
        (("turn",), (), ("exit-right",)),  # the one that is possible
        (("overtake",), (), ("change-left",)),
        (("exit-straight",), (), ("continue",)),
        (("overtake", "continue"), (), ("change-left", "continue")),
        (("change-left", "change-left"), (), ("change-left",)),
        (("go",), ("stop",), ("continue",)),
        (("turn",), ("stop",), ("exit-left",)),  # neither is: the first
    ],
)
def test_a_foil_in_the_planners_actions(
    asked: tuple[ActionName, ...], node: Actions, found: Actions
) -> None:
    assert to_macros(CausalModel(trace_of(s1_world())), asked, node) == found


def test_a_speed_is_no_choice() -> None:
    with pytest.raises(Unanswered) as refused:
        to_macros(CausalModel(trace_of(s1_world(), time=6.0)), ("speed-up",))
    found = refused.value.result
    assert isinstance(found, NotApplicable)
    assert (found.asked, found.time) == ((), 6.0)
