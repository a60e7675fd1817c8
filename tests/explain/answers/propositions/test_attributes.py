"""Attributes that take more than a look: waits, costs, ways, names."""

from typing import Any

import pytest

from tests.explain.answers.chosen import chosen
from tests.explain.answers.stated import (
    US,
    aim,
    belief,
    decision,
    did,
    driven,
    look,
    result,
    roads,
    scene,
    step,
    they,
)
from xavi_dialogue.domain.answers import (
    Beliefs,
    Bound,
    Comfort,
    Counted,
    DidNotHappen,
    Happenings,
    Identified,
    Located,
    Measures,
    NotRecorded,
    Options,
    Priority,
    SupposedOfUs,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import OptionValue
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Event,
    Everyone,
    Happens,
    Measured,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.propositions import attributes
from xavi_dialogue.explain.answers.propositions.attributes import SPECIAL

ONE, TWO = Vehicle(1), Vehicle(2)
LOOKS = {1: look(1), 2: look(2)}
STANDING = {0: driven((0.0, 0.0), speed=0.0, since=19.0)}
DRIVING = {0: driven((0.0, 10.0), since=19.0)}


def told(of: Measured, span: Any = None, **facts: Any) -> Any:
    return result(SPECIAL[of.attribute], of, scene(span, **({"looks": LOOKS} | facts)))


def values(found: Any) -> list[float | None]:
    assert isinstance(found, Measures)
    return [m.value for m in found.measures]


def test_a_wait_that_is_over_is_summed_up() -> None:
    stood = (did("stand", 4.0, 7.0), did("stand", 12.0, 14.0))
    of = Measured("waiting-time", tense="past")
    assert values(told(of, episodes=stood, motions=STANDING)) == [5.0]
    of = Measured("waiting-time", tense="past", time=Between(10.0, 18.0))
    assert values(told(of, episodes=stood)) == [2.0]
    of = Measured("waiting-time", ONE, tense="past")
    assert values(told(of, episodes=(they(1, "stand", 4.0, 5.0), *stood))) == [1.0]


def test_of_a_wait_to_come_it_is_told_how_long_we_still_stand() -> None:
    of = Measured("waiting-time", tense="future")
    traces = [decision(20.0)]
    stood = (did("stand", 4.0, 7.0),)
    assert values(told(of, motions=STANDING, traces=traces, episodes=stood)) == [0.0]  # no more
    assert values(told(of, motions=DRIVING, traces=traces, episodes=stood)) == [3.0]


def test_values_are_those_of_the_decision(monkeypatch: pytest.MonkeyPatch) -> None:
    def options(t: float) -> Any:
        return (OptionValue("continue", True, "done", 1.0, t, None, -t),)

    monkeypatch.setattr(attributes, "options_at", lambda _, t: options(t))
    traces = [decision(3.0), decision(15.0)]
    for attribute in ("value", "cost"):
        found = told(Measured(attribute), traces=traces)
        assert isinstance(found, Options)
        assert (found.decided, found.options) == (15.0, options(20.0))
        assert found.evidence.method == "tree"
        assert found.evidence.traces == (traces[1].trace_id,)
        found = told(Measured(attribute, time=At(4.0)), traces=traces)
        assert (found.decided, found.options) == (3.0, options(4.0))
        lacking = NotRecorded("not-recorded", about=attribute, since=20.0)
        assert told(Measured(attribute)) == lacking
        with monkeypatch.context() as nothing:
            nothing.setattr(attributes, "options_at", lambda *_: ())
            assert told(Measured(attribute), traces=traces) == lacking


def test_comfort_is_that_of_the_ride_or_of_an_event() -> None:
    hard = {("deceleration", 0): lambda t: 5.0 if t == 6.0 else 1.0}
    found = told(Measured("comfort"), values=hard)
    assert isinstance(found, Comfort)
    assert (found.peak.time, found.hard) == (6.0, True)
    calm = (did("stop", 10.0, 12.0),)
    found = told(Measured("comfort", event=Event("stop")), values=hard, episodes=calm)
    assert (found.peak.value, found.episode) == (1.0, calm[0])


def test_the_duration_is_that_of_the_event_or_of_the_ride() -> None:
    stop = (did("stop", 4.0, 9.5),)
    found = told(Measured("duration", event=Event("stop")), episodes=stop)
    assert isinstance(found, Happenings)
    assert (found.episodes, found.measures[0].value) == (stop, 5.5)
    found = told(Measured("duration"), values={("time-to-go", 0): 30.0})
    assert values(found) == [20.0, 30.0]
    found = told(Measured("duration", time=Between(3.0, 9.0)))
    assert found.measures[0].value == 9.0


# --- delays -------------------------------------------------------------------------------------


def test_a_delay_is_what_the_slowing_down_cost() -> None:
    slowed = (did("slow-down", 3.0, 5.0), did("stop", 12.0, 16.0))
    found = told(Measured("delay"), episodes=slowed, delays={"slow-down": 2.0, "stop": 6.0})
    assert [(m.attribute, m.value) for m in found.measures] == [("delay", 6.0)]
    of = Measured("delay", event=Event("slow-down"))
    assert values(told(of, episodes=slowed, delays={"slow-down": 2.0, "stop": 6.0})) == [2.0]
    of = Measured("delay", time=At(4.0))
    assert values(told(of, episodes=slowed, delays={"slow-down": 2.0, "stop": 6.0})) == [2.0]


def test_the_delay_for_somebody_is_that_of_what_we_did_for_them() -> None:
    held = (did("give-way", 3.0, 5.0, object=ONE), did("stop", 12.0, 16.0))
    of = Measured("delay", ONE)
    assert values(told(of, episodes=held, delays={"give-way": 2.0, "stop": 6.0})) == [2.0]
    missing = told(Measured("delay", TWO), episodes=held, delays={"give-way": 2.0, "stop": 6.0})
    assert values(missing) == [0.0]


def test_what_somebody_cost_is_the_sum_over_the_ride() -> None:
    held = (did("give-way", 3.0, 5.0, object=ONE), did("brake", 20.0, 22.0, object=ONE))
    delays = {"give-way": 2.0, "brake": 6.0}
    found = told(Measured("delay", ONE), episodes=held, delays=delays)
    assert [(m.value, m.count) for m in found.measures] == [(8.0, 2)]
    early = told(Measured("delay", ONE, time=Between(2.0, 6.0)), episodes=held, delays=delays)
    assert values(early) == [2.0]


def test_whoever_holds_up_those_we_follow_costs_us_the_time() -> None:
    slow = (did("brake", 3.0, 9.0), did("follow", 2.0, 15.0, object=ONE), did("brake", 12.0, 13.0))
    crawling = Measured("delay", event=Event("move", object=TWO))
    for asked, cost in ((Measured("delay", TWO), 8.0), (crawling, 4.0)):
        assert values(told(asked, episodes=slow, delays={"brake": 4.0})) == [cost]


def test_the_cost_of_a_choice_is_what_it_saved() -> None:
    changed = (did("change-left", 6.5, 9.0),)
    asked = chosen(episodes=changed)
    for event in (Event("change-left"), Event("change-lane"), Event("change-lane", side="left")):
        found = result(SPECIAL["delay"], Measured("delay", event=event), asked)
        assert [(m.attribute, m.value, m.time) for m in found.measures] == [("delay", -5.0, 6.5)]
    passed = chosen(episodes=(did("overtake", 6.5, 9.0, object=ONE),), looks=LOOKS)
    event = Event("overtake", object=ONE, side="right")
    found = result(SPECIAL["delay"], Measured("delay", event=event), passed)
    assert [m.value for m in found.measures] == [-5.0]


def test_the_cost_of_what_we_did_not_do_is_supposed() -> None:
    right = Measured("delay", event=Event("change-right"))
    found = result(SPECIAL["delay"], right, chosen())
    assert isinstance(found, SupposedOfUs)
    assert (found.contrast.foil, found.contrast.decided) == (("change-right",), 12.0)
    stop = Measured("delay", event=Event("stop"), time=At(2.5))
    found = result(SPECIAL["delay"], stop, chosen(Span(2.5, 2.5, said=True)))
    assert isinstance(found, SupposedOfUs)
    assert (found.contrast.foil[:1], found.contrast.decided) == (("stop",), 2.0)
    theirs = result(SPECIAL["delay"], Measured("delay", event=Event("stop", ONE)),
                    chosen(looks=LOOKS))  # fmt: skip
    assert isinstance(theirs, DidNotHappen)


# --- probabilities ------------------------------------------------------------------------------


def test_a_probability_is_of_the_event_or_of_what_is_said() -> None:
    known = (belief(1, 3.0, ("exit-left", 0.9)), belief(2, 3.0, ("exit-left", 0.8)))
    aims = {1: (aim("exit-left", 0.9), aim("continue", 0.1)), 2: (aim("exit-left", 0.8),)}
    facts: dict[str, Any] = {"beliefs": known, "traces": [decision(3.0, aims=aims)]}
    turn = Event("exit-left", ONE, tense="future")
    for of in (Measured("probability", event=turn), Measured("probability", about=Happens(turn))):
        found = told(of, **facts)
        assert isinstance(found, Beliefs)
        assert (found.vehicle, found.of) == (1, turn)
        assert found.probability == pytest.approx(0.9)
    other = Happens(Event("exit-left", TWO, tense="future"))
    assert told(Measured("probability", event=turn, about=other), **facts).vehicle == 2
    assert told(Measured("probability", event=turn, time=At(1.0)), **facts).probability is None


# --- names, places, ways ------------------------------------------------------------------------


def test_our_name_is_a_measure_and_others_are_shown() -> None:
    found = told(Measured("name"), values={("name", 0): lambda t: t})
    assert values(found) == [20.0]
    found = told(Measured("name", Vehicles((2, 1))))
    assert [(one.vehicle, one.time) for one in found.looks] == [(2, 20.0), (1, 20.0)]
    assert not found.none
    found = told(Measured("name", ONE, time=At(4.0), tense="past"))
    assert [(one.vehicle, one.time) for one in found.looks] == [(1, 4.0)]
    assert told(Measured("name", Everyone()), looks={}) == Identified((), none=True)


def test_where_somebody_is_and_goes() -> None:
    found = told(Measured("place", ONE, time=At(4.0)))
    assert isinstance(found, Located)
    assert (found.thing, found.looks[0].time) == (ONE, 4.0)
    turned = (they(1, "exit-left", 8.0, 9.0),)
    for attribute in ("heading", "route"):
        found = told(Measured(attribute, ONE, time=At(4.0)), episodes=turned)
        assert isinstance(found, Bound)
        assert (found.actor, found.went) == (ONE, turned[0])


@pytest.mark.parametrize("attribute", ["turn", "exit-number"])
def test_the_turn_of_another_is_where_it_goes_or_went(attribute: Any) -> None:
    turned = (they(1, "exit-left", 8.0, 9.0), they(1, "exit-right", 14.0, 16.0))
    past = told(Measured(attribute, ONE, tense="past"), episodes=turned)
    assert (past.went, past.belief) == (turned[1], None)
    then = told(Measured(attribute, ONE, time=At(4.0), tense="past"), episodes=turned)
    assert then.went == turned[0]
    known = (belief(1, 18.0, ("exit-left", 0.9)),)
    now = told(Measured(attribute, ONE), beliefs=known, episodes=turned)
    assert (now.went, now.belief) == (None, known[0])


def test_our_turn_is_our_way() -> None:
    road = roads(route=(step(50.0, "exit-left"),))
    found = told(Measured("turn"), road=road, traces=[decision(20.0, road=road)])
    assert not isinstance(found, Bound)
    assert "exit-left" in str(found)


def test_somebody_comes_from_where_it_was_first_seen() -> None:
    found = told(Measured("origin", ONE), values={("origin", 1): {"word": "left"}})
    assert found.measures[0].word == "left"
    found = told(Measured("origin", ONE))
    assert (found.thing, [x.time for x in found.looks], found.gap) == (ONE, [0.0], "not-recorded")
    late = {1: lambda t: look(1) if t >= 5.0 else None}
    found = told(Measured("origin", ONE), looks=late, traces=[decision(3.0), decision(6.0)])
    assert len(found.looks) == 1
    assert told(Measured("origin", ONE), looks={}).looks == ()
    ours = told(Measured("origin"), values={("lane", 0): lambda t: t, ("lane", 1): 7.0})
    assert isinstance(ours, Located)
    assert [m.time for m in ours.measures][:1] == [0.0]


def test_right_of_way_is_told_of_whom_it_is_asked() -> None:
    traces = [decision(20.0, road=roads((1, "vehicle"), (2, "ego")))]
    found = told(Measured("right-of-way", ONE), traces=traces)
    assert isinstance(found, Priority)
    assert (found.vehicle, found.rule) == (1, "give-way")
    found = told(Measured("right-of-way", US, TWO), traces=traces)
    assert (found.vehicle, found.rule) == (2, "priority")


def test_a_count_is_of_all_unless_somebody_is_named() -> None:
    found = told(Measured("count"))
    assert isinstance(found, Counted)
    assert (found.count, found.of) == (2, Everyone())
    assert told(Measured("count", ONE)).count == 1
