"""What is believed of another vehicle."""

from typing import Any

import pytest

from planner.record.trace import PlanTrace
from tests.explain.causes.decisions import decided, ride
from tests.traces import Aim, End, Way
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.domain.answers import NotRecorded
from xavi_dialogue.domain.terms import Event, Lane, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.vehicles.conduct import (
    belief_of,
    conduct_names,
    last_with,
    likeliest,
    matching,
    probability,
)
from xavi_dialogue.explain.history.ride import Unanswered

approx: Any = pytest.approx  # that compares within tuples, too

LEFT = Aim("exit-left", 0.3, (Way(("exit-left",), 0.75), Way(("change-left", "exit-left"), 0.25)))


ON = Aim("continue", 0.7, (Way(("continue",), 0.5), Way(("stop", "continue"), 0.5)))


OFF = Aim(
    "exit-right",
    0.4,
    (
        Way(
            ("exit-right", "continue"),
        ),
    ),
    "the exit on the right",
)


def believing(*aims: Aim, time: float = 4.0, **fields: object) -> PlanTrace:
    return decided({"continue": End()}, {1: aims}, [("continue",)], time=time, **fields)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("event", "names"),
    [
        (Event("turn"), ("exit-left", "exit-right")),
        (Event("turn", side="left"), ("exit-left",)),
        (Event("leave"), ("leave",)),
        (Event("leave", object=Lane(), side="left"), ("change-left",)),
        (Event("brake"), ("slow-down",)),
        (Event("wait"), ("give-way",)),
        (Event("follow"), ("continue",)),
        (Event("stop"), ("stop",)),
    ],
)
def test_what_anothers_doing_is_called(event: Event, names: tuple[ActionName, ...]) -> None:
    assert conduct_names(event) == names


@pytest.mark.parametrize(
    ("names", "ways"),
    [
        (("exit-left",), {(0, 0), (0, 1)}),
        (("change-left",), {(0, 1)}),
        (("continue",), {(1, 0), (1, 1)}),
        (("change-left", "stop"), {(0, 1), (1, 1)}),
        (("leave",), {(0, 0), (2, 0)}),  # of going on it is not known; a lane comes first
        (("exit-right",), {(2, 0)}),
    ],
)
def test_the_ways_in_which_it_does_so(
    names: tuple[ActionName, ...], ways: set[tuple[int, int]]
) -> None:
    model = CausalModel(believing(LEFT, ON, OFF))
    assert matching(model, 1, names) == ways
    assert matching(model, 7, names) == frozenset()


def test_how_probable_it_is() -> None:
    trace = believing(LEFT, ON)
    whole = ride(trace)
    assert probability(whole, trace, 1, ("exit-left",)) == approx(0.3)
    assert probability(whole, trace, 1, ("change-left", "stop")) == approx(0.075 + 0.35)
    assert probability(whole, trace, 7, ("exit-left",)) == 0.0
    model = CausalModel(trace)
    assert likeliest(model, 1, 0) == (("exit-left",), approx(0.225))
    assert likeliest(model, 1, 0, frozenset({(0, 1)})) == (
        ("change-left", "exit-left"),
        approx(0.075),
    )
    found = belief_of(whole, trace, 1)
    assert (found.vehicle, found.time) == (1, 4.0)
    assert [(e.actions, e.probability) for e in found.expectations] == [
        (("continue",), approx(0.35)),
        (("stop", "continue"), approx(0.35)),
        (("exit-left",), approx(0.225)),
        (("change-left", "exit-left"), approx(0.075)),
    ]
    assert belief_of(whole, trace, 7).expectations == ()


def test_the_last_decision_that_expects_something_of_it() -> None:
    first, then = believing(ON), decided({"continue": End()}, {}, [("continue",)], time=6.0)
    whole = ride(first, then)
    assert last_with(whole, 1, 9.0) is first
    assert last_with(whole, 1, 4.0) is first
    with pytest.raises(Unanswered) as refused:
        last_with(whole, 1, 3.9)
    assert refused.value.result == NotRecorded("out-of-view", thing=Vehicle(1), since=3.9)
