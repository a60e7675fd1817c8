"""At which decision something that is supposed is tried."""

from types import SimpleNamespace
from typing import Any

import pytest

from planner.record.trace import Action
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.explain.answers.suppositions.supposed_when import is_turn_ahead
from xavi_dialogue.explain.history.deeds import Deed

NOW = 30.0
STRAIGHT = Event("exit-straight", modal="would")


def scene(plan: tuple[Action, ...], *deeds: Deed, past: Any = None) -> Any:
    """A setting of which nothing is known but the plan in force and what was done."""
    latest = SimpleNamespace(plan=[SimpleNamespace(action=action) for action in plan])
    return SimpleNamespace(now=NOW, past=past, ride=SimpleNamespace(deeds=deeds, latest=latest))


def turned(action: Action, ended: float | None) -> Deed:
    return Deed(action, 1, 5.0, 6.0, ended)


@pytest.mark.parametrize(
    ("plan", "deeds", "ahead"),
    [
        (("exit-right",), (), True),
        (("continue", "exit-right"), (turned("exit-left", 12.0),), True),
        (("continue",), (), False),  # no turn is planned
        (("exit-right",), (turned("exit-left", 21.0),), False),  # that one was just made
        (("exit-right",), (turned("exit-left", None),), False),  # or is being made
        (("exit-right",), (turned("exit-straight", 12.0),), False),  # the one asked about
    ],
)
def test_a_turn_that_would_have_been_made_is_the_next_one(
    plan: tuple[Action, ...], deeds: tuple[Deed, ...], ahead: bool
) -> None:
    assert is_turn_ahead(scene(plan, *deeds), STRAIGHT) == ahead


def test_other_deeds_and_times_that_are_said_are_not_of_the_turn_ahead() -> None:
    plan: tuple[Action, ...] = ("exit-right",)
    assert not is_turn_ahead(scene(plan), None)
    assert not is_turn_ahead(scene(plan), Event("stop", modal="would"))
    assert not is_turn_ahead(scene(plan, past=SimpleNamespace(said=True)), STRAIGHT)
    assert is_turn_ahead(scene(plan, past=SimpleNamespace(said=False)), STRAIGHT)


@pytest.mark.parametrize("event", [Event("turn"), Event("leave"), Event("exit-left")])
def test_any_turn_may_be_ahead(event: Event) -> None:
    """Without a side, any of the turns may be meant."""
    assert is_turn_ahead(scene(("exit-right",)), event)
    assert not is_turn_ahead(scene(("exit-right",), turned("exit-left", 12.0)), event)
    assert not is_turn_ahead(scene(("stop",)), event)
