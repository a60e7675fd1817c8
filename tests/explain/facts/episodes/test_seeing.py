"""Who came into view and was lost, which indicators showed, and what was believed of whom."""

import pytest

from planner.record.places import LightChange
from tests.explain.facts.scenes import Actor, made, straight
from tests.traces import Aim, Way
from xavi_dialogue.domain.facts import Expectation
from xavi_dialogue.domain.terms import Ego, Event, Vehicle, Vehicles, Wanted
from xavi_dialogue.explain.facts.beliefs import belief, over, probability
from xavi_dialogue.explain.facts.episodes.seeing import sights, signals
from xavi_dialogue.explain.facts.states import States

OURS = Actor(straight(0.0, 0.0, 10.0))


def seen(
    since: float, until: float, hidden: tuple[float, float] | None, ended: bool = False
) -> list[tuple[str, float]]:
    other = Actor(straight(30.0, 0.0, 10.0), since=since, until=until, hidden=hidden)
    found = sights(States(made({0: OURS, 1: other}, 10.0, ended=ended)), 1)
    assert all(e.actor == Vehicle(1) and e.object == Ego() and e.begin == e.end for e in found)
    return [(e.action, e.begin) for e in found]


@pytest.mark.parametrize(
    ("since", "until", "hidden", "told"),
    [
        (0.0, 99.0, None, []),
        (3.0, 99.0, None, [("appear", 3.0)]),
        (0.0, 6.0, None, [("disappear", 6.0)]),
        (0.0, 99.0, (4.0, 7.0), [("disappear", 4.0), ("appear", 7.0)]),
        (2.0, 9.0, (4.0, 7.0), [("appear", 2.0), ("disappear", 4.0), ("appear", 7.0),
                                ("disappear", 9.0)]),
        (4.0, 99.0, (4.0, 7.0), [("appear", 7.0)]),
        (0.0, 7.0, (4.0, 7.0), [("disappear", 4.0)]),
    ],
)  # fmt: skip
def test_who_comes_into_view_and_is_lost(
    since: float, until: float, hidden: tuple[float, float] | None, told: list[tuple[str, float]]
) -> None:
    assert seen(since, until, hidden) == told


def test_the_end_of_the_ride_takes_nobody_out_of_view() -> None:
    assert seen(3.0, 99.0, None, ended=True) == [("appear", 3.0)]
    assert seen(3.0, 9.0, None, ended=True) == [("appear", 3.0), ("disappear", 9.0)]
    assert sights(States(made({0: OURS}, 5.0)), 0) == []


BLINKS = (
    LightChange(0.0, ("brake",)),
    LightChange(2.4, ("left",)),
    LightChange(3.0, ("left", "brake")),
    LightChange(5.0, ("right",)),
    LightChange(6.0, ("left", "right")),
)


@pytest.mark.parametrize(
    ("until", "ended", "end"), [(99.0, False, None), (99.0, True, 9.0), (7.0, False, 7.0)]
)
def test_when_indicators_were_shown(until: float, ended: bool, end: float | None) -> None:
    other = Actor(straight(30.0, 0.0, 10.0), lights=BLINKS, until=until)
    found = signals(States(made({0: OURS, 1: other}, 9.0, ended=ended)), 1)
    assert [(e.action, e.side, e.begin, e.end) for e in found] == [
        ("signal", "left", 2.4, 5.0),
        ("signal", "left", 6.0, end),
        ("signal", "right", 5.0, end),
    ]
    assert all(e.actor == Vehicle(1) for e in found)


def test_nobody_signals_who_was_never_seen() -> None:
    assert signals(States(made({0: OURS}, 9.0)), 1) == []


# Beliefs -----------------------------------------------------------------------------------

LEFT = Aim("exit-left", 0.3, (Way(("exit-left",), 0.75), Way(("change-left", "exit-left"), 0.25)))
OFF = Aim("continue", 0.1, (Way(("continue",)),), "the road that branches off to the right")
ON = Aim("continue", 0.6, (Way(("continue",), 0.5), Way(("continue",), 0.5)))


def believing(*aims: Aim, until: float = 99.0) -> States:
    other = Actor(straight(30.0, 0.0, 10.0), aims=aims, until=until)
    return States(made({0: OURS, 1: other}, 6.0))


def test_ways_of_one_sequence_are_one_belief() -> None:
    found = belief(believing(LEFT, ON), 1, 3.5)
    assert found is not None
    assert (found.vehicle, found.time) == (1, 3.0)
    assert [e.actions for e in found.expectations] == [
        ("continue",),
        ("exit-left",),
        ("change-left", "exit-left"),
    ]
    chances = [e.probability for e in found.expectations]
    assert chances == pytest.approx([0.6, 0.225, 0.075])


def test_a_place_is_that_of_the_likelier_goal() -> None:
    one = Aim("stop", 0.3, (Way(("stop",)),))
    two = Aim("continue", 0.5, (Way(("stop",)),))
    three = Aim("exit-left", 0.2, (Way(("stop",)),))
    found = belief(believing(one, two, three), 1, 3.0)
    assert found is not None
    assert found.expectations == (Expectation(("stop",), pytest.approx(1.0), "continue"),)  # type: ignore[arg-type]


def test_a_belief_is_that_of_the_last_decision_that_knew_it() -> None:
    found = believing(ON, until=4.0)
    late = belief(found, 1, 5.9)
    assert late is not None
    assert late.time == 4.0
    assert belief(found, 1, -1.0) is None
    assert belief(found, 2, 5.0) is None
    assert [b.time for b in over(found, 1, 1.0, 3.0)] == [1.0, 2.0, 3.0]
    assert [b.time for b in over(found, 1, 3.5, 9.0)] == [4.0]


@pytest.mark.parametrize(
    ("event", "chance"),
    [
        (Event("exit-left", Vehicle(1)), 0.3),
        (Event("turn", Vehicle(1)), 0.3),
        (Event("turn", Vehicle(1), side="left"), 0.3),
        (Event("turn", Vehicle(1), side="right"), 0.0),
        (Event("change-lane", Vehicle(1)), 0.075),
        (Event("continue", Vehicle(1)), 0.7),
        (Event("continue", Vehicles((1,))), 0.7),
        (Event("continue", Vehicles((1, 2))), None),
        (Event("continue", Wanted()), None),
        (Event("continue", Vehicle(2)), None),
    ],
)
def test_how_probable_it_was_held(event: Event, chance: float | None) -> None:
    plain = Aim("continue", 0.1, (Way(("continue",)),))
    found = probability(believing(LEFT, plain, ON), event, 3.0)
    assert found == (None if chance is None else pytest.approx(chance))
    assert probability(believing(ON), Event("continue", Vehicle(1)), -1.0) is None


def test_a_probability_is_one_at_most() -> None:
    twice = (
        Aim("continue", 0.7, (Way(("continue",)),)),
        Aim("continue", 0.4, (Way(("continue",)),)),
    )
    assert probability(believing(*twice), Event("continue", Vehicle(1)), 3.0) == 1.0
    found = belief(believing(*twice), 1, 3.0)
    assert found is not None
    assert found.expectations[0].probability == 1.0
    assert probability(believing(*twice, until=2.0), Event("continue", Vehicle(1)), 5.0) is None
