"""Whether something is possible, in view, close, first or big."""

from typing import Any

import pytest

from planner.record.events import Event as RideEvent
from planner.record.trace import NotApplicable as Refused
from tests.explain.answers.propositions.test_conditions import LOOKS, NEAR, ONE, held
from tests.explain.answers.stated import (
    US,
    belief,
    decision,
    did,
    driven,
    look,
    place,
    roads,
    scene,
    step,
    they,
)
from xavi_dialogue.domain.answers import (
    Closeness,
    NotApplicable,
    Priority,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import OptionValue
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Destination,
    Event,
    Is,
    Lane,
    Vehicles,
    WholeRide,
)
from xavi_dialogue.explain.answers.propositions import conditions
from xavi_dialogue.explain.answers.propositions.conditions import condition

# --- what is possible ---------------------------------------------------------------------------


def option(action: Any, time: float = 3.0) -> OptionValue:
    return OptionValue(action, False, "done", 1.0, time, None, -time)


def test_what_was_among_the_options_was_possible(monkeypatch: pytest.MonkeyPatch) -> None:
    facts: dict[str, Any] = {"traces": [decision(5.0), decision(15.0)]}
    monkeypatch.setattr(
        conditions, "options_at", lambda _, t: (option("continue"), option("change-left", t))
    )
    change = Event("change-lane", side="left", tense="present")
    found = held("possible", of={"event": change}, **facts)
    assert (found.holds, found.facts) == (True, (option("change-left", 20.0),))
    found = held("possible", of={"event": change, "time": At(8.0), "tense": "past"}, **facts)
    assert found.facts == (option("change-left", 8.0),)


def test_what_was_not_says_why_where_that_is_known() -> None:
    change = Event("change-lane", side="right", tense="present")
    refused = (
        Refused(("continue",), "change-right", "later"),
        Refused((), "exit-left", "no road"),
        Refused((), "change-right", "no lane"),
    )
    found = held("possible", of={"event": change}, traces=[decision(15.0, not_applicable=refused)])
    assert found == NotApplicable(("change-right",), "no lane", 15.0)
    found = held("possible", of={"event": change}, traces=[decision(15.0)])
    assert (found.holds, found.gap) == (None, "not-recorded")
    busy = [decision(15.0, under_way="change-left")]
    assert held("possible", of={"event": change}, traces=busy).holds is False
    for of, traces in (({}, busy), ({"event": change}, []), ({"event": Event("brake")}, busy)):
        found = held("possible", of=of, traces=traces)
        assert (found.holds, found.gap) == (None, "not-recorded")


# --- what is seen -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("state", "in_view", "hidden"),
    [("visible", True, False), ("present", True, False), ("hidden", False, True),
     ("lost", False, True)],
)  # fmt: skip
def test_who_is_in_view(state: Any, in_view: bool, hidden: bool) -> None:
    assert held(state, ONE).holds is in_view
    lost = {1: look(1, in_view=False), 2: look(2)}
    found = held(state, ONE, looks=lost, values={("visibility", 1): 4.0})
    assert found.holds is hidden
    assert (found.facts[0].vehicle, found.facts[1].value) == (1, 4.0)
    assert held(state, of={"event": Event("stop", ONE)}, looks=lost).holds is hidden
    ours = held(state, US)
    assert (ours.holds, ours.gap) == (None, "not-applicable")
    assert held(state, Lane("left")).gap == "not-sensed"


def test_who_had_not_come_yet_was_hidden() -> None:
    late = {1: lambda t: look(1) if t >= 12.0 else None}
    then = {"time": At(9.0), "tense": "past"}
    traces = [decision(12.0)]
    assert held("hidden", ONE, of=then, looks=late, traces=traces).holds is True
    assert held("lost", ONE, of=then, looks=late, traces=traces).facts[0].vehicle == 1
    assert held("visible", ONE, of=then, looks=late, traces=traces).holds is False
    assert held("visible", ONE, of=then, looks=late).facts == ()


def test_of_several_all_have_to_be_in_view() -> None:
    both = Vehicles((1, 2))
    lost = {1: look(1), 2: look(2, in_view=False)}
    found = held("visible", both, looks=lost)
    assert (found.holds, [one.vehicle for one in found.facts]) == (False, [2])
    found = held("visible", both)
    assert (found.holds, [one.vehicle for one in found.facts]) == (True, [1, 2])
    found = held("hidden", both, looks=lost)
    assert (found.holds, [one.vehicle for one in found.facts]) == (False, [1])
    assert held("present", both, looks=lost).holds is False


# --- what is close ------------------------------------------------------------------------------


def near(state: Any, *, too: bool = False, **values: float) -> Any:
    known = {(name.replace("_", "-"), 0, 1): value for name, value in values.items()}
    return held(state, ONE, of={"too": too}, values=known)


@pytest.mark.parametrize(
    ("values", "close"),
    [
        ({"headway": 1.9, "gap": 19.0, "distance": 19.0}, True),
        ({"headway": 2.1, "gap": 21.0, "distance": 2.0}, False),
        ({"distance": 4.9}, True),
        ({"distance": 5.1}, False),
    ],
)
def test_closeness_is_told_by_headway_else_by_distance(values: Any, close: bool) -> None:
    found = near("close", **values)
    assert found.holds is close
    assert near("far", **values).holds is not close
    told = [m.attribute for m in found.facts]
    assert told == (["gap", "headway"] if "gap" in values else ["distance"])


def test_too_close_is_a_matter_of_opinion_in_between() -> None:
    for headway, holds in ((0.9, True), (2.1, False)):
        assert near("close", too=True, headway=headway, distance=9.0).holds is holds
    for headway in (1.0, 1.1, 1.9):
        found = near("close", too=True, headway=headway, gap=11.0, distance=9.0)
        assert found.holds is None
        assert [m.value for m in found.answer.measures] == [11.0, headway]
    assert near("close", too=True, headway=2.0, distance=9.0).holds is False
    assert near("close", headway=1.0, distance=9.0).holds is True


def test_without_a_distance_the_way_to_go_is_told_for_far() -> None:
    to_go = {("distance-to-go", 0): 900.0, ("time-to-go", 0): 60.0}
    for thing, state in ((Destination(), "close"), (Destination(), "far"), (ONE, "far")):
        found = held(state, thing, values=to_go)
        assert [m.value for m in found.answer.measures] == [900.0, 60.0]
    found = held("close", ONE, values=to_go)
    assert (found.holds, found.gap) == (None, "not-recorded")
    found = held("far", ONE, values=to_go, events=[RideEvent("arrived", 19.0)])
    assert (found.holds, found.gap) == (None, "not-recorded")


def test_who_came_close_is_told_by_the_nearest_moment() -> None:
    past: dict[str, Any] = {"tense": "past", "time": Between(2.0, 6.0)}
    found = held("close", ONE, of=past, values=NEAR).answer
    assert (found.asked, found.closest.value, found.past) == ("close", 2.0, True)
    now = held("close", of={}, values=NEAR).answer
    assert (now.asked, now.past, now.vehicle) == ("close", False, 2)
    past["time"] = WholeRide()
    assert held("close", of=past, values=NEAR).answer.vehicle == 1


def test_what_came_nearest_may_be_just_over() -> None:
    #: It is nearest at 19 s; a deed of ours towards it ended 6 s before now, or earlier.
    values = {("distance", 0, 1): lambda t: 2.0 + abs(t - 19.0)}
    for end, nearest in ((14.0, 2.0), (13.9, 7.1)):
        told = (did("overtake", 10.0, end, object=ONE),)
        of = {"tense": "past", "event": Event("overtake", object=ONE), "thing": ONE}
        asked = scene(looks=LOOKS, episodes=told, values=values)
        found = condition(Is("close", **of), asked).answer  # type: ignore[arg-type]
        assert isinstance(found, Closeness)
        assert found.closest is not None
        assert found.closest.value == pytest.approx(nearest, abs=0.5)
    said = Span(10.0, 15.0, said=True)
    found = held("close", ONE, said, of={"tense": "past"}, values=values).answer
    assert isinstance(found, Closeness)
    assert found.closest is not None
    assert found.closest.value == 6.0


# --- who is first, big, ... ---------------------------------------------------------------------


def test_who_went_first() -> None:
    #: We come to where lines meet at 10 s, the other one at 8 s or 12 s.
    ours = driven([10.0 * k for k in range(21)])
    for at, first in ((8.0, ONE), (12.0, US)):
        theirs = driven([100.0] * 21, ys=[10.0 * (k - at) for k in range(21)])
        road = roads((1, "vehicle"))
        facts: dict[str, Any] = {
            "motions": {0: ours, 1: theirs}, "traces": [decision(9.0, road=road)], "road": road,
        }  # fmt: skip
        past = {"tense": "past", "time": Between(8.0, 12.0)}
        for thing in (US, ONE):
            assert held("first", thing, of=past, **facts).holds is (thing == first)
            assert held("last", thing, of=past, **facts).holds is (thing != first)
        assert isinstance(held("first", US, of=past, **facts).answer, Priority)
    road = roads((1, "vehicle"))
    yet = held("first", US, traces=[decision(20.0, road=road)], road=road)
    assert (yet.holds, yet.answer.rule) == (None, "give-way")


@pytest.mark.parametrize(("size", "big"), [(7.0, True), (6.9, False)])
def test_what_is_big(size: float, big: bool) -> None:
    found = held("big", ONE, values={("size", 1): size})
    assert (found.holds, found.facts[0].value, found.facts[1].vehicle) == (big, size, 1)
    ours = held("big", US, values={("size", 0): size})
    assert (ours.holds, len(ours.facts)) == (big, 1)
    assert held("big", ONE).gap == "not-recorded"
    assert held("big", ONE, values={("size", 1): {"gap": "hidden"}}).gap == "hidden"


def test_what_is_always_so() -> None:
    assert held("autonomous").holds is True
    assert (held("dirty").holds, held("dirty").gap) == (None, "not-sensed")
    assert (held("normal").holds, held("normal").gap) == (None, "not-recorded")


def test_every_state_is_weighed() -> None:
    values = {("speed", 0): 20.0, ("limit", 0): 13.9, ("speed", 1): 0.0}
    assert held("fast", values=values).holds is True
    assert held("slow", values=values).holds is False
    assert held("stationary", ONE, values=values).holds is True
    assert held("moving", ONE, values=values).holds is False
    assert held("stuck", ONE, episodes=(they(1, "stand", 4.0),), values=values).holds is True
    assert held("late").gap == "unknown-plans"
    assert held("over", of={"event": Event("stop")}, episodes=(did("stop", 3.0, 9.0),)).holds
    road = roads(places={0: place(lane=0)}, route=(step(),))
    assert held("free", Lane("left"), road=road, looks={}).holds is True
    assert held("busy", looks={}).holds is False
    assert held("faulty", US, values=values).holds is False
    assert held("awake", ONE).holds is None
    assert held("upset", ONE).holds is None
    told = (they(1, "exit-left", 6.0, 8.0),)
    beliefs = (belief(1, 3.0, ("exit-right", 0.9)),)
    of = {"tense": "past"}
    assert held("right", ONE, of=of, episodes=told, beliefs=beliefs).holds is False
