"""What was decided at a time, and what was different at another decision."""

from typing import Any

import pytest

from tests.explain.answers.stated import US, belief, decision, did, look, result, scene, they
from xavi_dialogue.domain.answers import NotRecorded
from xavi_dialogue.domain.meaning import Changed
from xavi_dialogue.domain.terms import Between, Vehicle
from xavi_dialogue.explain.answers.events.decisions import changed, decided_at

ONE = Vehicle(1)


@pytest.mark.parametrize(
    ("plan", "steps"),
    [
        (("continue",), ("continue",)),
        (("continue", "exit-left"), ("exit-left",)),
        (("continue", "change-left", "exit-left"), ("change-left",)),
        (("stop", "continue", "exit-left"), ("stop", "exit-left")),
        (("stop", "continue"), ("stop",)),
        (("exit-left", "continue"), ("exit-left",)),
        (("change-left", "exit-left"), ("change-left",)),
        (("continue", "stop"), ("continue",)),
    ],
)
def test_what_matters_of_a_plan(plan: Any, steps: Any) -> None:
    assert decided_at(scene(traces=[decision(5.0, plan)]), 9.0).steps == steps


def test_it_is_the_last_decision_up_to_then() -> None:
    asked = scene(traces=[decision(5.0), decision(8.0), decision(11.0)])
    assert decided_at(asked, 10.0).time == 8.0
    assert decided_at(asked, 11.0).time == 11.0
    before = result(decided_at, asked, 4.0)
    assert before == NotRecorded("before-record", about="decision", since=4.0)


@pytest.mark.parametrize(
    ("before", "after", "kept"),
    [
        (("continue", "exit-left"), ("continue", "exit-left"), True),
        (("continue", "exit-left"), ("exit-left",), True),
        (("continue", "exit-left", "continue"), ("continue", "exit-left"), True),
        (("continue", "exit-left"), ("exit-right",), False),
        (("exit-left",), ("continue", "exit-left"), False),
    ],
)
def test_a_plan_is_kept_as_far_as_it_is_not_carried_out(
    before: Any, after: Any, kept: bool
) -> None:
    traces = [decision(5.0, before), decision(6.0, after)]
    assert decided_at(scene(traces=traces), 6.0).kept is kept
    assert decided_at(scene(traces=traces), 5.0).kept is False  # the first is kept from none


def test_how_we_drove_then_is_told() -> None:
    traces = [decision(5.0), decision(8.0)]
    waits, brakes = did("give-way", 5.4, 6.0, object=ONE), did("brake", 4.0, 5.2)
    wait = did("wait", 5.45, 6.0)
    asked = scene(traces=traces, episodes=(brakes, waits), looks={1: look(1)})
    assert decided_at(asked, 5.0).doing == (waits,)
    assert decided_at(scene(traces=traces, episodes=(brakes,)), 7.0).doing == (brakes,)
    assert decided_at(scene(traces=traces, episodes=(waits, wait)), 5.0).doing == (wait,)
    late = did("brake", 5.6, 6.0)
    assert decided_at(scene(traces=traces, episodes=(late,)), 5.0).doing == ()
    early = did("brake", 4.0, 4.9)
    assert decided_at(scene(traces=traces, episodes=(early,)), 5.0).doing == ()
    slows = did("slow-down", 4.0, 5.2)
    assert decided_at(scene(traces=traces, episodes=(slows,)), 5.0).doing == ()


def altered(begin: float, end: float, **facts: Any) -> Any:
    return result(changed, Changed(Between(begin, end)), scene(**facts))


TRACES = [decision(5.0, ("continue",)), decision(8.0, ("change-left",)), decision(11.0, ("stop",))]


def test_two_decisions_are_held_against_each_other() -> None:
    found = altered(6.0, 12.0, traces=TRACES)
    assert (found.before.time, found.after.time) == (5.0, 11.0)
    assert (found.before.steps, found.after.steps) == (("continue",), ("stop",))
    found = altered(9.0, 10.0, traces=TRACES)  # of one, with that before
    assert (found.before.time, found.after.time) == (5.0, 8.0)
    found = altered(6.0, 7.0, traces=TRACES)
    assert (found.before.time, found.after.time) == (5.0, 5.0)
    found = altered(6.0, 7.0, traces=TRACES[:1])
    assert (found.before.time, found.after.time) == (5.0, 5.0)
    found = altered(6.0, 12.0, traces=TRACES[:2])
    assert (found.before.time, found.after.time) == (5.0, 8.0)
    found = altered(9.0, 10.0, traces=TRACES[:2])
    assert (found.before.time, found.after.time) == (5.0, 8.0)
    found = altered(2.0, 12.0, traces=TRACES)
    assert found == NotRecorded("before-record", about="decision", since=2.0)


def test_who_came_into_view_between_them_is_told() -> None:
    def since(vehicle: int, time: float) -> Any:
        return lambda t: look(vehicle, in_view=True) if t >= time else None

    looks = {1: look(1), 2: since(2, 9.0), 3: since(3, 12.0), 4: since(4, 8.0)}
    found = altered(5.0, 11.0, traces=TRACES, looks=looks)
    assert [one.vehicle for one in found.appeared] == [2, 4]


def test_what_we_did_between_them_is_told() -> None:
    told = (
        did("stop", 5.0, 6.0), did("overtake", 5.5, 7.0), they(1, "cut-in", 8.0, 9.0, object=US),
        did("enter", 11.0, 11.0), did("leave", 11.5, 12.0),
    )  # fmt: skip
    found = altered(5.0, 11.0, traces=TRACES, episodes=told, looks={1: look(1)})
    assert found.did == told[1:4]


def moved(*pairs: Any, **more: Any) -> Any:
    """What moved of beliefs, each given as (vehicle, before, after)."""
    known = [b for v, old, new in pairs for b in (belief(v, 5.0, *old), belief(v, 11.0, *new))]
    facts = {"looks": {v: look(v) for v, *_ in pairs}, "beliefs": tuple(known)} | more
    found = altered(5.0, 11.0, traces=TRACES, **facts)
    return [(old.vehicle, old.time, new.time) for old, new in found.beliefs]


def test_beliefs_that_moved_are_told_the_most_first() -> None:
    small = (1, [("exit-left", 0.7)], [("exit-left", 0.86)])
    large = (2, [("exit-left", 0.2)], [("exit-left", 0.6)])
    least = (3, [("exit-left", 0.7)], [("exit-left", 0.84)])
    assert moved(small, large, least) == [(2, 5.0, 11.0), (1, 5.0, 11.0)]
    assert moved(least) == []
    several = (1, [("exit-left", 0.2), ("continue", 0.2)], [("exit-left", 0.6), ("continue", 0.2)])
    assert moved(several) == [(1, 5.0, 11.0)]
    fallen = (1, [("continue", 0.9)], [("continue", 0.6)])
    assert moved(fallen) == [(1, 5.0, 11.0)]
    equal = (3, [("exit-left", 0.2)], [("exit-left", 0.6)])
    assert [v for v, *_ in moved(equal, large)] == [2, 3]
    middle = (4, [("exit-left", 0.2)], [("exit-left", 0.5)])
    assert [v for v, *_ in moved(small, middle, large)] == [2, 4]  # two at most


def test_what_was_not_expected_before_had_no_chance() -> None:
    other = (1, [("continue", 0.9)], [("exit-left", 0.14)])
    assert moved(other) == []
    other = (1, [("continue", 0.9)], [("exit-left", 0.5)])
    assert moved(other) == [(1, 5.0, 11.0)]
    unlikely = (1, [("continue", 0.9)], [("exit-left", 0.49)])
    assert moved(unlikely) == []
    second = (1, [("continue", 0.6), ("exit-left", 0.4)], [("exit-left", 0.5)])
    assert moved(second) == []
    assert moved((1, [("continue", 0.6)], [])) == []


def test_whoever_is_behind_us_is_left_out() -> None:
    one = (1, [("continue", 0.2)], [("continue", 0.9)])
    assert moved(one, looks={1: look(1, ahead=-5.0)}) == []


def test_where_no_time_is_said_it_is_of_the_last_change_of_plan() -> None:
    traces = [
        decision(5.0, ("continue",)),
        decision(8.0, ("change-left",)),
        decision(14.0, ("change-left",)),
    ]
    changes = (did("change-plan", 8.0, 8.0),)
    changes = (*changes, did("change-left", 8.0, 10.0))
    found = result(changed, Changed(), scene(traces=traces, episodes=changes, now=15.0))
    assert (found.before.time, found.after.time, found.sudden) == (5.0, 8.0, True)
    still = result(changed, Changed(), scene(traces=traces, now=15.0))
    assert (still.before.time, still.after.time, still.sudden) == (8.0, 14.0, False)


def test_beliefs_of_those_out_of_view_or_new_are_left_out() -> None:
    one = (1, [("continue", 0.2)], [("continue", 0.9)])
    assert moved(one, looks={1: look(1, in_view=False)}) == []
    assert moved(one, beliefs=(belief(1, 11.0, ("continue", 0.9)),)) == []
