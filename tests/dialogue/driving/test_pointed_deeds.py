"""Deeds of ours that are pointed at, with who may be behind them."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Claim, Why
from xavi_dialogue.domain.terms import Ego, Happens
from xavi_dialogue.nlu.notation import compact
from xavi_dialogue.nlu.parse import Parser


@pytest.mark.parametrize(
    ("text", "action", "suspect"),
    [
        ("And this slowing down, another light?", "slow-down", "Feature(light)"),
        ("this braking, another light?", "brake", "Feature(light)"),
        ("And this slowing down, is that another light?", "slow-down", "Feature(light)"),
        ("that slowing down, was it the bus", "slow-down", "Described(bus)"),
        ("And this braking, the lorry again?", "brake", "Described(truck)"),
        ("So this stop, the bus?", "stop", "Described(bus)"),
        ("this wait, the pedestrians?", "wait", "Described(pedestrian, plural=True)"),
        ("that sudden stop, the cyclist?", "stop", "Described(bicycle)"),
        ("this pause, the lorry?", "stop", "Described(truck)"),
        ("We are stopping. The bus?", "stop", "Described(bus)"),
    ],
)
def test_who_is_named_beside_it_may_be_the_reason(text: str, action: str, suspect: str) -> None:
    [act] = Parser().read(text)[0].acts
    assert isinstance(act, Ask)
    assert isinstance(act.question, Why)
    assert isinstance(act.question.of, Happens)
    assert act.question.of.event.actor == Ego()
    assert act.question.of.event.action == action
    assert compact(act.question.suspect) == suspect


@pytest.mark.parametrize(
    "text",
    ["the traffic light is slowing down", "the space braked", "the crossing is overtaking us"],
)
def test_nothing_is_claimed_that_cannot_be(text: str) -> None:
    for reading in Parser().read(text):
        assert not any(isinstance(act, Claim) for act in reading.acts)
