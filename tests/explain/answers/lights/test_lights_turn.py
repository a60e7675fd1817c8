"""Whose turn it is while a light holds us: what asks for it, and what does not."""

from types import SimpleNamespace
from typing import Any

import pytest

from xavi_dialogue.domain.meaning import Whether, Which
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Everyone,
    Happens,
    Is,
    Not,
    Now,
    Related,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.traffic_lights import LightTold
from xavi_dialogue.explain.answers import turns
from xavi_dialogue.explain.answers.lights import lights_turn

HELD = LightTold("turn")
GO = Event("go", tense="present")


@pytest.fixture
def scene(monkeypatch: pytest.MonkeyPatch) -> Any:
    for module in (lights_turn, turns):
        monkeypatch.setattr(module, "held", lambda asked: asked.light)
    return SimpleNamespace(light=HELD, now=20.0, past=None, span=None)


@pytest.mark.parametrize(
    ("that", "turn"),
    [
        (Is("allowed", event=GO), True),
        (Happens(Event("go", tense="present", modal="can")), True),
        (Related("has-priority-over", Ego(), Everyone()), True),
        (Related("has-priority-over", Ego(), Everyone(), tense="past"), False),
        (Related("has-priority-over", Ego(), Vehicle(1)), False),
        (Is("allowed", event=Event("go", Vehicle(1), tense="present")), False),
        (Is("allowed", event=Event("overtake", tense="present")), False),
        (Not(Is("allowed", event=GO)), False),
        (Happens(GO), False),
    ],
)
def test_whether_we_may_go_is_a_matter_of_the_light(scene: Any, that: Any, turn: bool) -> None:
    assert lights_turn.is_turn(that, scene) is turn
    scene.light = None
    assert not lights_turn.is_turn(that, scene)


def test_the_reply_is_no(scene: Any) -> None:
    found = lights_turn.whether(Whether(Is("allowed", event=GO)), scene)
    assert found == LightTold("turn", holds=False)


@pytest.mark.parametrize("modal", [None, "must"])
def test_who_goes_or_has_to_move_first_is_told_by_the_light(scene: Any, modal: Any) -> None:
    event = Event("move", Wanted(), manner=("first",), time=Now(), tense="present", modal=modal)
    assert turns.who(Which(Wanted(), Happens(event)), scene) == HELD
