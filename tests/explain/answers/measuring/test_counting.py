"""How many there are, and how often something happened, over which stretch of the ride."""

from typing import Any

import pytest

from tests.explain.answers.stated import (
    US,
    decision,
    did,
    driven,
    look,
    place,
    result,
    roads,
    scene,
    step,
    they,
)
from xavi_dialogue.domain.answers import Counted, Course, Measures, NotRecorded, PlanAhead
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import HowMany
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Described,
    Destination,
    Event,
    Everyone,
    Exit,
    Junction,
    Lane,
    Nobody,
    Road,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.measuring.counting import how_many

ONE, TWO = Vehicle(1), Vehicle(2)
LOOKS = {1: look(1), 2: look(2, kind="truck"), 3: look(3, in_view=False)}


def counted(of: Any, span: Any = None, *, such: Any = None, **facts: Any) -> Any:
    return result(how_many, HowMany(of, such), scene(span, **({"looks": LOOKS} | facts)))


STOPS = (did("stop", 2.0, 4.0), did("stop", 8.0, 9.0), they(1, "stop", 5.0, 6.0))


def test_an_event_is_counted_over_the_ride_unless_a_stretch_is_said() -> None:
    found = counted(Event("stop"), episodes=STOPS)
    assert (found.count, found.facts, found.since, found.until) == (2, STOPS[:2], 0.0, 20.0)
    assert not found.at_least
    found = counted(Event("stop", time=Between(3.0, 7.0)), episodes=STOPS)
    assert (found.count, found.since, found.until) == (1, 3.0, 7.0)
    found = counted(Event("stop", time=At(8.5)), episodes=STOPS)
    assert (found.count, found.since) == (2, 0.0)  # a moment is no stretch to count in
    now = Event("stop", tense="present", time=At(8.5))
    assert (counted(now, episodes=STOPS).count, counted(now, episodes=STOPS).since) == (1, 8.5)


def test_what_runs_on_is_counted_once() -> None:
    runs = (did("give-way", 2.0, 6.0, object=ONE), did("give-way", 3.0, 5.0, object=TWO))
    found = counted(Event("give-way"), episodes=runs)
    assert (found.count, found.facts) == (1, runs)
    for nobody in (Nobody(), Everyone()):
        found = counted(Event("give-way", object=nobody), episodes=runs)
        assert (found.count, found.of) == (1, Event("give-way"))
    found = counted(Event("give-way", object=TWO), episodes=runs)
    assert (found.count, found.of) == (1, Event("give-way", object=TWO))
    assert found.facts == runs[1:]


def test_a_lane_change_back_at_once_is_another_one() -> None:
    for back in (4.6, 4.4):  # also where the first one is not quite over
        weaving = (did("change-left", 2.0, 4.5), did("change-right", back, 7.0))
        assert counted(Event("change-lane"), episodes=weaving).count == 2
    once = (did("change-left", 2.0, 4.5), did("change-left", 2.4, 4.8))
    assert counted(Event("change-lane"), episodes=once).count == 1


@pytest.mark.parametrize(
    ("gap", "lost"),
    [((1.0, 2.0), False), ((1.0, 3.0), True), ((7.0, 9.0), True), ((7.1, 9.0), False)],
)
def test_what_was_lost_of_the_record_may_have_held_more(gap: Any, lost: bool) -> None:
    found = counted(Event("stop", time=Between(3.0, 7.0)), episodes=STOPS, gaps=(gap,))
    assert found.at_least is lost


RING = Junction("roundabout", time=5.0)
#: We come from the west and leave to the south, having turned by a right angle; or go straight on.
ROUND = driven((0.0, 10.0, 20.0), since=4.0)


@pytest.mark.parametrize(
    ("leaving", "count"), [(0.0, 1), (0.8, 1), (0.95, 2), (-0.95, 2)]
)  # 50 degrees are 0.87
def test_a_roundabout_that_we_go_straight_over_is_no_turn(leaving: float, count: int) -> None:
    motion = driven(range(0, 200, 10))
    headings = tuple(leaving if t >= 8.0 else 0.0 for t in motion.time)
    motion = type(motion)(motion.time, motion.position, headings, motion.speed)
    turns = (did("exit-right", 8.0, 9.0, place=RING), did("exit-left", 14.0, 15.0))
    found = counted(Event("turn"), episodes=turns, motions={0: motion})
    assert (found.count, found.facts) == (count, turns[-count:])


def test_only_the_way_over_the_roundabout_counts() -> None:
    motion = driven(range(0, 200, 10))
    headings = tuple(1.2 if t >= 12.0 else 0.0 for t in motion.time)
    bent = type(motion)(motion.time, motion.position, headings, motion.speed)
    turns = (did("exit-right", 8.0, 9.0, place=RING), did("exit-left", 14.0, 15.0))
    assert counted(Event("turn"), episodes=turns, motions={0: bent}).count == 1


def test_a_turn_is_one_where_that_is_not_known() -> None:
    straight = {0: driven(range(0, 200, 10))}
    second = did("exit-left", 14.0, 15.0)
    for place_ in (None, Junction(time=5.0), Junction("roundabout")):
        turns = (did("exit-right", 8.0, 9.0, place=place_), second)
        assert counted(Event("turn"), episodes=turns, motions=straight).count == 2
    theirs = (they(1, "exit-right", 8.0, 9.0, place=RING), they(1, "exit-left", 14.0, 15.0))
    assert counted(Event("turn", ONE), episodes=theirs, motions=straight).count == 2
    over = (did("exit-right", 8.0, 9.0, place=RING),)
    assert counted(Event("turn"), episodes=over, motions=straight).count == 1  # all there is
    assert counted(Event("turn"), episodes=(*over, second)).count == 2
    late = {0: driven(range(0, 200, 10), since=6.0)}
    assert counted(Event("turn"), episodes=(*over, second), motions=late).count == 2
    assert counted(Event("exit-right"), episodes=(*over, did("exit-right", 12.0, 13.0)),
                   motions=straight).count == 2  # fmt: skip


def test_turns_and_lane_changes_to_come_are_told_by_the_plan() -> None:
    traces = [decision(20.0, ("change-left", "continue"))]
    ahead = {("turn", 0): {"value": 50.0, "side": "left"}}
    found = counted(Event("change-lane", tense="future"), traces=traces, values=ahead)
    assert isinstance(found, PlanAhead)
    assert [action for action, _ in found.steps][:1] == ["change-left"]
    assert found.measures == ()
    traces = [decision(20.0, ("continue",))]
    event = Event("change-left", tense="future")
    assert counted(event, traces=traces) == Counted(event, 0)
    changed = (did("change-right", 2.0, 4.0),)
    found = counted(event, traces=traces, episodes=changed)
    assert (found.count, found.of.manner) == (0, ("again",))
    theirs = counted(Event("change-left", ONE, tense="future"), traces=traces)
    assert (theirs.count, theirs.of.manner) == (0, ())
    road = roads(route=(step(50.0, "exit-left"), step(90.0, "exit-straight")))
    found = counted(Event("turn", tense="future"), road=road, traces=traces)
    assert isinstance(found, Course)
    assert found.form == "turns"


# --- things -------------------------------------------------------------------------------------


def test_those_in_view_are_counted() -> None:
    found = counted(Everyone())
    assert (found.count, [one.vehicle for one in found.facts]) == (2, [1, 2])
    assert (found.since, found.until, found.at_least, found.of) == (20.0, 20.0, False, Everyone())
    found = counted(Described(kind="truck"))
    assert (found.count, found.of) == (1, Everyone("truck"))
    assert counted(Everyone("car")).of == Everyone()  # anybody is called a car
    found = counted(Everyone(), such=Described(colour="red"))
    assert found.such == Described(colour="red")
    assert counted(Everyone(), looks={}).count == 0


def test_those_of_a_stretch_are_all_that_were_seen_in_it() -> None:
    def until(time: float) -> Any:
        return lambda t: look(1, in_view=t <= time)

    facts: dict[str, Any] = {
        "looks": {1: until(4.0), 2: look(2, kind="truck"), 3: look(3, in_view=False)},
        "traces": [decision(float(t)) for t in (3, 8, 14)],
    }
    found = counted(Everyone(), Span(3.0, 10.0, said=True), **facts)
    assert (found.count, found.since, found.until) == (2, 3.0, 10.0)
    assert [one.time for one in found.facts] == [0.0, 10.0]
    assert counted(Everyone(), Span(5.0, 10.0, said=True), **facts).count == 1
    assert counted(Everyone(), Span(8.0, 14.0, said=True), **facts).count == 1
    assert counted(Everyone("truck"), Span(3.0, 10.0, said=True), **facts).count == 1
    at = counted(Everyone(), Span(3.0, 4.0, said=True), **facts)
    assert (at.count, at.since, at.until) == (2, 3.5, 3.5)
    assert counted(Everyone(), Span(12.0, 30.0, said=True), **facts).until == 20.0


def test_who_is_named_is_counted_as_named() -> None:
    found = counted(Vehicles((2, 3)))
    assert (found.count, [one.vehicle for one in found.facts]) == (2, [2, 3])
    assert counted(ONE).count == 1
    assert counted(US).count == 1
    assert counted(Nobody()) == Counted(Nobody(), 0)


def test_lanes_and_exits_are_told_by_the_road() -> None:
    values = {("lane-count", 0): 3.0, ("exit-number", 0): 2.0}
    for of in (Lane(), Road()):
        assert [m.value for m in counted(of, values=values).measures] == [3.0]
    ring = roads(route=(step(), step(kind="roundabout", exit=2, exits=4)))
    found = counted(Exit(), road=ring, values=values)
    assert [(m.attribute, m.value) for m in found.measures] == [("exit-number", 2.0)]
    found = counted(Exit(), road=roads(route=(step(),)), values=values)
    assert isinstance(found, Measures)
    assert [(m.attribute, m.gap) for m in found.measures] == [("exit-number", "not-applicable")]
    for unknown in (Exit(), Junction()):
        assert counted(unknown) == NotRecorded("not-recorded", unknown, about="count")
    assert isinstance(counted(Junction(), road=ring, traces=[decision(20.0)]), Course)
    lost = counted(Destination())
    assert lost == NotRecorded("not-recorded", Destination(), about="count")
    assert place().lanes == 2


@pytest.mark.parametrize(
    ("waits", "times"),
    [
        ([("give-way", 2.0, 5.0, 1), ("give-way", 3.0, 4.0, 2)], (2.0,)),
        ([("give-way", 2.0, 5.0, 1), ("give-way", 9.0, 11.0, 2)], (2.0, 9.0)),
        ([("give-way", 2.0, 5.0, 1), ("give-way", 3.0, 4.0, 2), ("give-way", 9.0, 11.0, 2)],
         (2.0, 9.0)),
    ],
)  # fmt: skip
def test_each_time_that_is_counted_has_its_beginning(waits: Any, times: Any) -> None:
    rows = tuple(did(what, begin, end, object=Vehicle(v)) for what, begin, end, v in waits)
    found = counted(Event("give-way"), episodes=rows)
    assert (found.count, found.times) == (len(times), times)
