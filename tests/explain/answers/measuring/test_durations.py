"""How long something lasted, and how long we waited."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as RideEvent
from tests.explain.answers.stated import (
    US,
    aim,
    decision,
    did,
    driven,
    look,
    result,
    rolled,
    scene,
    they,
)
from xavi_dialogue.domain.answers import DidNotHappen, Happenings, Measures
from xavi_dialogue.domain.meaning import HowLong
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Event,
    Feature,
    Related,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.explain.answers.measuring.durations import (
    event_lasting,
    halted,
    lasting,
    remaining_wait,
    stands,
    waited,
)
from xavi_dialogue.explain.answers.propositions.lasting import how_long
from xavi_dialogue.explain.answers.reference.moments import Window

ONE, TWO = Vehicle(1), Vehicle(2)
LOOKS = {1: look(1), 2: look(2)}
STILL = {0: driven((0.0, 0.0), speed=(5.0, 0.0), since=19.0)}
MOVING = {0: driven((0.0, 10.0), since=19.0)}
ALL = Window(0.0, 20.0)


def lasted(event: Event, **facts: Any) -> Any:
    given: dict[str, Any] = {"looks": LOOKS, "motions": MOVING}
    return result(event_lasting, event, scene(**(given | facts)))


# --- how long -----------------------------------------------------------------------------------


def test_how_long_an_event_lasted() -> None:
    told = (did("overtake", 3.0, 7.5), did("follow", 10.0, 12.0, object=ONE))
    found = lasted(Event("overtake"), episodes=told)
    assert isinstance(found, Happenings)
    value = found.measures[0]
    assert (found.form, found.episodes, found.asked) == ("how-long", told[:1], Event("overtake"))
    assert (value.attribute, value.value, value.time, value.until, value.at_least) == (
        "duration", 4.5, 3.0, 7.5, False,
    )  # fmt: skip
    assert len(found.measures) == 1
    found = lasted(Event("follow", object=ONE), episodes=told)
    assert [(one.vehicle, one.time) for one in found.looks] == [(1, 10.0)]
    theirs = they(2, "stop", 4.0, 5.0)
    found = lasted(Event("stop", TWO), episodes=(theirs,))
    assert [(one.vehicle, one.time) for one in found.looks] == [(2, 4.0)]
    missing = lasted(Event("turn"), episodes=told)
    assert isinstance(missing, DidNotHappen)


def test_what_goes_on_or_began_before_the_record_lasts_at_least_so_long() -> None:
    asked = scene()
    assert lasting(asked, did("follow", 15.0)).measures[0].at_least
    assert lasting(asked, did("follow", 15.0)).measures[0].value == 5.0
    assert lasting(asked, did("follow", 0.0, 4.0)).measures[0].at_least
    assert not lasting(asked, did("follow", 0.5, 4.0)).measures[0].at_least
    assert lasting(asked, did("follow", 3.0, 7.564)).measures[0].value == 4.56


def test_of_a_halt_that_goes_on_it_is_told_how_long_we_still_stand() -> None:
    traces = [rolled(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 5.0)]
    for end, told in ((None, 2), (19.5, 2), (19.4, 1)):
        halt = did("stop", 15.0, end)
        found = lasting(scene(motions=STILL, traces=traces), halt)
        assert len(found.measures) == told
    moving = lasting(scene(motions=MOVING, traces=traces), did("stop", 15.0))
    assert len(moving.measures) == 1
    theirs = lasting(scene(motions=STILL, traces=traces, looks=LOOKS), they(1, "stop", 15.0))
    assert len(theirs.measures) == 1


def test_how_long_we_still_stand_is_told_by_the_plan() -> None:
    # From the seventh sample on, 1.2 s after the decision, we drive.
    going = [rolled(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 5.0)]
    found = remaining_wait(scene(traces=going))
    assert (found.attribute, found.time, found.at_least) == ("waiting-time", 20.0, False)
    told = [found.value, found.until, found.low, found.high]
    assert told == pytest.approx([1.2, 21.2, 1.2, 1.2])
    earlier = [rolled(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 5.0, time=19.0)]
    assert remaining_wait(scene(traces=earlier)).value == pytest.approx(0.2)
    past = [rolled(0.0, 2.0, 5.0, time=19.0)]
    assert remaining_wait(scene(traces=past)).value == 0.0
    staying = [rolled(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)]
    found = remaining_wait(scene(traces=staying))
    assert [found.value, found.until] == pytest.approx([1.0, 21.0])
    assert found.at_least
    over = [rolled(0.0, 0.0, time=15.0)]
    assert remaining_wait(scene(traces=over)).value == 0.0
    assert remaining_wait(scene()).gap == "in-future"


def test_a_wait_to_come_is_asked_of_our_car_that_stands() -> None:
    facts: dict[str, Any] = {
        "traces": [rolled(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 5.0)],
        "episodes": (did("stop", 15.0), they(1, "stop", 12.0)),
    }
    to_come = Event("stop", tense="future")
    must = Event("stop", tense="present", modal="must")
    for event in (to_come, must, Event("wait", tense="future"), Event("stand", tense="future")):
        found = lasted(event, motions=STILL, **facts)
        assert isinstance(found, Measures)
        assert found.measures[0].value == pytest.approx(1.2)
    now = lasted(Event("stop", tense="present"), motions=STILL, **facts)
    assert [m.attribute for m in now.measures] == ["duration", "waiting-time"]
    had_to = lasted(Event("stop", modal="must"), motions=STILL, **facts)
    assert isinstance(had_to, Happenings)
    theirs = lasted(Event("stop", ONE, tense="future"), motions=STILL, **facts)
    assert isinstance(theirs, Happenings)
    driving = {"traces": facts["traces"], "episodes": (did("stop", 5.0, 8.0),)}
    assert not isinstance(lasted(to_come, **driving), Measures)


def test_standing_is_halting_under_another_name() -> None:
    gave = did("give-way", 5.0, 9.0)
    found = lasted(Event("stand"), episodes=(gave,))
    assert (found.episodes, found.measures[0].value) == ((gave,), 4.0)
    found = lasted(Event("stop"), episodes=(did("wait", 5.0, 8.0),))
    assert found.measures[0].value == 3.0
    brief = did("give-way", 5.0, 5.0)
    assert isinstance(lasted(Event("stand"), episodes=(brief,)), DidNotHappen)
    stood = did("give-way", 5.0, 5.0, standing=True)
    assert lasted(Event("stand"), episodes=(stood,)).episodes == (stood,)
    assert isinstance(lasted(Event("overtake"), episodes=(gave,)), DidNotHappen)
    theirs = they(1, "give-way", 5.0, 9.0)
    assert lasted(Event("stop", ONE), episodes=(theirs, gave)).episodes == (theirs,)


# --- halts that belong together -----------------------------------------------------------------


def test_halts_with_a_little_creeping_between_are_one() -> None:
    row = (did("stop", 2.0, 5.0), did("stop", 8.9, 10.0))
    found = lasted(Event("stop"), episodes=row)
    value = found.measures[0]
    assert (value.attribute, value.value, value.time, value.until, value.extreme) == (
        "waiting-time", 4.1, 2.0, 20.0, "total",
    )  # fmt: skip
    apart = (did("stop", 2.0, 5.0), did("stop", 9.1, 10.0))
    found = lasted(Event("stop"), episodes=apart)
    assert (found.episodes, found.measures[0].value) == (apart[1:], 0.9)
    three = (*row, did("stop", 15.0, 16.0))
    assert lasted(Event("stop"), episodes=three).measures[0].value == 1.0
    assert lasted(Event("stop", time=At(3.0)), episodes=three).measures[0].value == 4.1
    ever = lasted(Event("stop", time=WholeRide()), episodes=three)
    assert ever.measures[0].value == pytest.approx(5.1)
    mixed = (did("give-way", 2.0, 5.0), did("stand", 6.0, 7.0), did("wait", 8.0, 10.0))
    assert lasted(Event("stand"), episodes=mixed).measures[0].value == 3.0  # slowing is no halt


def test_a_queue_that_goes_on_is_told_as_a_whole_with_what_we_stood() -> None:
    going = (did("stop", 12.0, 15.0), did("stop", 17.0))
    found = lasted(Event("stop"), episodes=going)
    assert [(e.begin, e.end) for e in found.episodes] == [(12.0, None)]
    assert [m.value for m in found.measures if m.extreme == "total"] == [6.0]
    queue = HowLong(Related("on", US, Feature("queue"), tense="perfect"))
    asked = scene(episodes=going, looks=LOOKS, motions=MOVING)
    assert result(how_long, queue, asked).measures == found.measures


def test_a_halt_for_somebody_stands_alone() -> None:
    row = (did("wait", 2.0, 5.0, object=ONE), did("wait", 7.0, 10.0, object=TWO))
    found = lasted(Event("wait", object=TWO), episodes=row)
    assert (found.episodes, found.measures[0].value) == (row[1:], 3.0)
    theirs = (they(1, "stop", 2.0, 5.0), they(1, "stop", 7.0, 10.0))
    assert lasted(Event("stop", ONE), episodes=theirs).episodes == theirs[1:]
    slowed = (did("brake", 2.0, 5.0), did("brake", 7.0, 10.0))
    assert lasted(Event("brake"), episodes=slowed).episodes == slowed[1:]


# --- the ride -----------------------------------------------------------------------------------


def test_how_long_the_ride_takes() -> None:
    to_go = {("time-to-go", 0): 30.0}
    for event in (Event("arrive"), Event("move", tense="future"), Event("arrive", tense="future")):
        found = lasted(event, values=to_go)
        assert [(m.attribute, m.value) for m in found.measures] == [("time-to-go", 30.0)]
    for action in ("do", "happen", "move"):
        found = lasted(Event(action), values=to_go)
        assert [(m.attribute, m.value) for m in found.measures] == [
            ("time", 20.0), ("time-to-go", 30.0),
        ]  # fmt: skip
        whole = found.measures[0]
        assert (whole.time, whole.until, whole.extreme) == (0.0, 20.0, "total")
    there = lasted(Event("do"), events=[RideEvent("arrived", 18.0)])
    assert [m.attribute for m in there.measures] == ["time"]
    assert lasted(Event("do", time=Between(3.0, 8.0))).measures[0].value == 8.0
    assert lasted(Event("do"), begin=3.0).measures[0].value == 17.0
    theirs = lasted(Event("move", ONE), episodes=(they(1, "move", 4.0, 7.0),))
    assert theirs.measures[0].value == 3.0


# --- waiting ------------------------------------------------------------------------------------

STOOD = (did("stand", 2.0, 5.0), did("stand", 9.0, 11.0), they(1, "stand", 3.0, 4.0))


def test_how_long_somebody_stood() -> None:
    asked = scene(episodes=STOOD, looks=LOOKS)
    found = waited(asked, US, None, ALL)
    assert (found.attribute, found.thing, found.value, found.to) == ("waiting-time", US, 5.0, None)
    assert (found.time, found.until, found.extreme) == (0.0, 20.0, "total")
    assert waited(asked, US, None, Window(6.0, 12.0)).value == 2.0
    assert waited(asked, US, None, Window(9.5, 10.0)).value == 5.0  # a moment is no stretch
    assert waited(asked, ONE, None, ALL).value == 1.0
    assert waited(asked, TWO, None, ALL).value == 0.0
    odd = scene(episodes=(did("stand", 2.0, 5.123),))
    assert waited(odd, US, None, ALL).value == 3.12


def test_how_long_we_waited_for_somebody() -> None:
    told = (did("wait", 2.0, 5.0, object=ONE), did("wait", 3.0, 6.0, object=ONE),
            did("wait", 9.0, 10.0, object=TWO))  # fmt: skip
    asked = scene(episodes=told, looks=LOOKS)
    found = waited(asked, US, ONE, ALL)
    assert (found.value, found.to) == (3.0, ONE)  # the second runs on in the first
    assert waited(asked, US, TWO, ALL).value == 1.0
    gave = scene(episodes=(did("give-way", 2.0, 4.0, object=ONE),), looks=LOOKS)
    assert waited(gave, US, ONE, ALL).value == 2.0
    assert waited(gave, US, ONE, Window(10.0, 15.0)).value == 2.0  # at any time, then
    assert waited(gave, US, None, ALL).value == 0.0


@pytest.mark.parametrize(
    ("gap", "at_least"),
    [((1.0, 2.0), False), ((1.0, 3.0), True), ((7.0, 9.0), True), ((7.1, 9.0), False)],
)
def test_what_was_lost_makes_it_a_bound(gap: Any, at_least: bool) -> None:
    asked = scene(episodes=STOOD, looks=LOOKS, gaps=(gap,))
    assert waited(asked, US, None, Window(3.0, 7.0)).at_least is at_least


# --- standing -----------------------------------------------------------------------------------


def test_we_stand_below_walking_pace() -> None:
    for speed, still in ((0.13, True), (0.15, False)):
        assert stands(scene(motions={0: driven((0.0,), speed=speed)})) is still
    assert not stands(scene())
    assert stands(scene(motions=STILL))
    assert not stands(scene(motions={0: driven((0.0, 0.0), speed=(0.0, 5.0))}))


def test_we_are_halted_while_we_wait_or_are_about_to_stop() -> None:
    assert halted(scene(motions=STILL))
    for action in ("wait", "stand", "stop", "give-way"):
        assert halted(scene(motions=MOVING, episodes=(did(action, 18.0),)))
    over = (did("stop", 18.0, 19.9),)
    assert not halted(scene(motions=MOVING, episodes=over))
    assert not halted(scene(motions=MOVING, episodes=(did("brake", 18.0),)))
    assert not halted(scene(motions=MOVING, episodes=(they(1, "stop", 18.0),)))


@pytest.mark.parametrize(("samples", "soon"), [(14, True), (16, False)])
def test_about_to_stop_is_within_three_seconds(samples: int, soon: bool) -> None:
    braking = [5.0 * (1.0 - k / samples) for k in range(samples)]
    traces = [rolled(*braking, 0.0, 0.0, 0.0, 0.0, 0.0, plan=("stop",))]
    assert halted(scene(motions=MOVING, traces=traces)) is soon


def either(share: float, speeds: tuple[float, ...], others: tuple[float, ...], plan: Any) -> Any:
    """A decision under whose plan we drive so with a probability, and otherwise else."""
    aims = {1: (aim("exit-left", share), aim("continue", 1.0 - share))}
    trace = decision(20.0, plan, aims=aims)
    path = tuple((float(k), 0.0) for k in range(10))
    rollouts = tuple(
        replace(r, path=path, speed=speeds if r.samples[0].goal == 0 else others)
        for r in trace.rollouts
    )
    return replace(trace, rollouts=rollouts)


HALTING, GOING, STANDING = (5.0, 3.0, 1.0, *(0.0,) * 7), (5.0,) * 10, (0.0,) * 10


@pytest.mark.parametrize(("share", "expected"), [(0.6, True), (0.5, True), (0.4, False)])
def test_what_is_likely_enough_is_about_to_come(share: float, expected: bool) -> None:
    stops = either(share, HALTING, GOING, ("stop",))
    assert halted(scene(motions=MOVING, traces=[stops])) is expected
    goes = either(share, GOING, STANDING, ("continue",))
    found = remaining_wait(scene(motions=STILL, traces=[goes]))
    assert found.at_least is not expected
