"""Whether a thing or an event is safe, comfortable, allowed, necessary or amiss."""

from typing import Any

import pytest

from tests.explain.answers.stated import (
    US,
    belief,
    decision,
    did,
    look,
    place,
    result,
    roads,
    scene,
    they,
)
from xavi_dialogue.domain.answers import (
    Closeness,
    Comfort,
    DidNotHappen,
    Measures,
    Options,
    Priority,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import Fault, HowSure, Listing, Whether, Why
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Event,
    Happens,
    Is,
    Lane,
    Now,
    Vehicle,
)
from xavi_dialogue.explain.answers.propositions import conditions
from xavi_dialogue.explain.answers.propositions.conditions import condition

ONE, TWO = Vehicle(1), Vehicle(2)
LOOKS = {1: look(1), 2: look(2)}


def held(state: Any, thing: Any = None, span: Any = None, *, of: Any = None, **facts: Any) -> Any:
    asked = scene(span, **({"looks": LOOKS} | facts))
    return result(condition, Is(state, thing, **(of or {})), asked)


@pytest.fixture
def handed(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The questions that are handed on to the explainers of reasons, which answer all of them."""
    asked: list[Any] = []

    def answer(question: Any, scene: Any) -> Any:
        asked.append(question)
        return Measures(())

    monkeypatch.setattr(conditions, "handed", answer)
    return asked


# --- safety -------------------------------------------------------------------------------------

#: The first is nearest at 4 s, with 2 m, and the second at 15 s, with 3 m.
NEAR = {
    ("distance", 0, 1): lambda t: 2.0 + abs(t - 4.0),
    ("distance", 0, 2): lambda t: 3.0 + abs(t - 15.0),
}


@pytest.mark.parametrize(
    ("state", "how"), [("safe", "safe"), ("dangerous", "dangerous"), ("roomy", "room")]
)
def test_safety_is_how_close_somebody_came(state: Any, how: str) -> None:
    found = held(state, ONE, of={"tense": "past"}, values=NEAR)
    assert isinstance(found.answer, Closeness)
    assert found.answer.closest is not None
    assert (found.holds, found.answer.asked, found.answer.vehicle, found.answer.past) == (
        None, how, 1, True,
    )  # fmt: skip
    assert found.answer.closest.value == 2.0
    now = held(state, ONE, values=NEAR).answer
    assert (now.closest.value, now.past, now.time) == (18.0, False, 20.0)


def test_the_safety_of_an_event_is_of_its_stretch_and_of_whom_it_concerns() -> None:
    told = (did("overtake", 14.0, 16.0, object=TWO), they(1, "cut-in", 3.0, 5.0, object=US))
    past: dict[str, Any] = {"tense": "past", "event": Event("overtake", object=TWO)}
    found = held("safe", of=past, values=NEAR, episodes=told).answer
    assert (found.vehicle, found.closest.value, found.time) == (2, 3.0, 16.0)
    past["event"] = Event("cut-in", ONE)
    assert held("safe", of=past, values=NEAR, episodes=told).answer.vehicle == 1
    assert held("safe", TWO, of=past, values=NEAR, episodes=told).answer.vehicle == 2
    past["event"] = Event("cut-in", TWO)  # the other one was nearer
    told = (they(2, "cut-in", 3.0, 5.0, object=US),)
    assert held("safe", of=past, values=NEAR, episodes=told).answer.vehicle == 2
    past["event"] = Event("overtake", object=TWO)
    told = (did("overtake", 3.0, 5.0, object=TWO),)
    assert held("safe", of=past, values=NEAR, episodes=told).answer.vehicle == 2
    past["event"] = Event("turn")
    assert isinstance(held("safe", of=past, values=NEAR, episodes=told), DidNotHappen)


def test_room_in_a_lane_is_who_is_in_it() -> None:
    road = roads(places={0: place(lane=0), 1: place(lane=1)})
    found = held("roomy", Lane("left"), road=road, looks={1: look(1, 5.0)})
    assert (found.holds, [one.vehicle for one in found.facts]) == (False, [1])


# --- comfort ------------------------------------------------------------------------------------


def hard_at(*times: float) -> Any:
    return {("deceleration", 0): lambda t: 5.0 if t in times else 1.0}


def test_comfort_of_the_ride_of_lately_and_of_an_event() -> None:
    assert held("comfortable", values=hard_at()).holds is True
    found = held("uncomfortable", values=hard_at(6.0))
    assert isinstance(found.answer, Comfort)
    assert (found.holds, found.answer.peak.time) == (True, 6.0)
    assert held("comfortable", values=hard_at(6.0)).holds is False
    lately = {"tense": "past"}
    just = Span(19.0, 20.0)
    assert held("comfortable", None, just, of=lately, values=hard_at(14.0), now=20.5).holds is True
    assert held("comfortable", None, just, of=lately, values=hard_at(14.5), now=20.5).holds is False
    told = (did("stop", 5.0, 8.0),)
    of_stop: dict[str, Any] = {"tense": "past", "event": Event("stop")}
    assert held("comfortable", of=of_stop, values=hard_at(6.0), episodes=told).holds is False
    assert held("comfortable", of=of_stop, values=hard_at(9.0), episodes=told).holds is True
    assert isinstance(held("comfortable", of=of_stop, values=hard_at(6.0)), DidNotHappen)


def test_comfort_of_a_moment_or_stretch_that_is_said_is_of_that() -> None:
    for time, times, holds in (
        (Between(4.0, 8.0), (6.0,), False), (Between(8.0, 12.0), (6.0,), True),
        (At(6.0), (6.0,), False), (At(6.0), (19.0,), True),
    ):  # fmt: skip
        of = {"tense": "past", "time": time}
        assert held("comfortable", of=of, values=hard_at(*times)).holds is holds
    assert held("comfortable", of={"time": Now()}, values=hard_at(6.0)).holds is False


@pytest.mark.parametrize(
    "action", ["follow", "keep-lane", "continue", "move", "stand", "wait"]
)  # fmt: skip
def test_what_goes_on_all_the_time_is_asked_of_the_ride(action: Any) -> None:
    of = {"event": Event(action, tense="present")}
    found = held("comfortable", of=of, values=hard_at(6.0))
    assert (found.holds, found.answer.peak.time) == (False, 6.0)


# --- what is allowed ----------------------------------------------------------------------------

RULE = [decision(20.0, road=roads((1, "vehicle")))]
SPEEDS = {("speed", 0): 12.0, ("limit", 0): 13.9, ("speed", 1): 15.0, ("limit", 1): 13.9}


def test_what_is_allowed_in_general_is_what_bears_on_it() -> None:
    facts: dict[str, Any] = {"values": SPEEDS, "traces": RULE, "road": RULE[0].road}
    for of in ({}, {"event": Event("honk", tense="present")}):
        found = held("allowed", of=of, **facts)
        assert isinstance(found.answer, Priority)
        assert (found.holds, found.answer.legal, found.answer.time) == (None, True, 20.0)
        assert found.answer.limit is not None
        assert found.answer.limit.value == 12.0


@pytest.mark.parametrize(
    "action",
    ["enter", "turn", "exit-left", "exit-right", "exit-straight", "cross", "go", "merge"],
)
def test_going_first_is_allowed_by_the_right_of_way(action: Any) -> None:
    facts: dict[str, Any] = {"values": SPEEDS, "traces": RULE, "road": RULE[0].road}
    found = held("allowed", of={"event": Event(action, tense="present")}, **facts)
    assert (found.holds, found.answer.rule, found.answer.holds) == (False, "give-way", False)
    theirs = held("allowed", of={"event": Event(action, ONE, tense="present")}, **facts)
    assert (theirs.holds, theirs.answer.holds) == (True, True)
    fast = Event(action, manner=("fast",), tense="present")
    assert held("allowed", of={"event": fast}, **facts).facts[0].value == 12.0
    slow = Event(action, manner=("slowly",), tense="present")
    assert held("allowed", of={"event": slow}, **facts).facts[0].value == 12.0


def test_without_a_rule_it_is_the_limit_or_what_bears_on_it() -> None:
    free: dict[str, Any] = {"values": SPEEDS, "traces": [decision(20.0, road=roads())],
                            "road": roads()}  # fmt: skip
    theirs = held("allowed", of={"event": Event("turn", ONE, tense="present")}, **free)
    assert (theirs.holds, theirs.facts[0].value) == (False, 15.0)
    ours = held("allowed", of={"event": Event("turn", tense="present")}, **free)
    assert (ours.holds, ours.answer.legal) == (None, True)
    first = Event("go", manner=("first",), tense="present")
    assert held("allowed", of={"event": first}, **free).answer.legal is False
    assert held("allowed", ONE, **free).facts[0].value == 15.0
    assert held("allowed", US, **free).holds is True


def test_of_the_past_the_rule_of_that_time_holds() -> None:
    traces = [decision(5.0, road=roads((1, "ego"))), decision(20.0, road=roads((1, "vehicle")))]
    told = (did("turn", 4.0, 6.0),)
    of = {"event": Event("exit-left", time=At(5.0)), "tense": "past", "time": At(5.0)}
    found = held("allowed", of=of, traces=traces, values=SPEEDS, episodes=told)
    assert (found.answer.rule, found.answer.time, found.holds) == ("priority", 5.0, True)
    road = lambda t: traces[0].road if t < 20.0 else traces[1].road  # noqa: E731
    for event in (None, Event("honk", time=At(5.0))):
        of = {"event": event, "tense": "past", "time": At(5.0)}
        found = held("allowed", of=of, traces=traces, road=road, values=SPEEDS)
        assert (found.answer.rule, found.answer.legal) == ("priority", True)


# --- what is judged -----------------------------------------------------------------------------


@pytest.mark.parametrize("state", ["necessary", "worth-it", "better"])
def test_what_is_judged_is_told_by_reasons(handed: list[Any], state: Any) -> None:
    of = Is(state, event=Event("stop"))
    assert held(state, of={"event": Event("stop")}).answer == Measures(())
    assert handed == [Whether(of)]


def test_where_that_has_no_answer_the_reason_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []

    def answer(question: Any, scene: Any) -> Any:
        asked.append(question)
        return Measures(()) if isinstance(question, Why) else None

    monkeypatch.setattr(conditions, "handed", answer)
    stop = Event("stop")
    assert held("necessary", of={"event": stop}).answer == Measures(())
    assert asked == [Whether(Is("necessary", event=stop)), Why(Happens(stop))]
    assert held("necessary").gap == "not-recorded"


def test_what_hinders_us_is_what_is_amiss(handed: list[Any]) -> None:
    for told, plainest in (
        ((did("brake", 15.0), did("stop", 18.0)), "stop"),
        ((did("wait", 15.0), did("give-way", 18.0)), "wait"),
        ((did("slow-down", 15.0), did("brake", 18.0)), "brake"),
        ((did("give-way", 15.0, 19.8),), "give-way"),
    ):
        assert held("wrong", episodes=told).answer == Measures(())
        assert handed[-1] == Why(Happens(Event(plainest, tense="present")))  # type: ignore[arg-type]
    for told in ((did("stop", 15.0, 19.6),), (they(1, "stop", 15.0),), (did("overtake", 15.0),)):
        found = held("wrong", episodes=told, values=NEAR)
        assert found.answer.asked == "dangerous"
    assert len(handed) == 4


def test_whether_a_belief_was_wrong_is_asked_of_somebody(handed: list[Any]) -> None:
    told = (they(1, "exit-left", 6.0, 8.0),)
    beliefs = (belief(1, 3.0, ("exit-right", 0.9)),)
    found = held("wrong", ONE, of={"tense": "past"}, episodes=told, beliefs=beliefs)
    assert (found.holds, found.mistaken) == (True, True)
    assert handed == []


def test_surety_and_fault_are_asked_on(handed: list[Any]) -> None:
    turn = Event("exit-left", ONE)
    held("sure", of={"event": turn, "time": At(3.0)})
    held("sure")
    assert handed == [HowSure(Happens(turn), At(3.0)), HowSure()]


def test_whose_fault_it_was_is_told_by_who_had_right_of_way() -> None:
    road = roads((1, "vehicle"))
    found = held("at-fault", ONE, traces=[decision(5.0, road=road)], road=road)
    assert isinstance(found.answer, Priority)
    assert (found.holds, found.answer.blame, found.answer.vehicle) == (None, True, 1)


def test_what_reasons_do_not_answer_is_not_handed_on() -> None:
    asked = scene(traces=[decision(20.0)])
    assert conditions.handed(Fault(), asked) is None
    assert isinstance(conditions.handed(Listing("options"), asked), Options)


@pytest.fixture
def tried(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """What is handed on to be tried as another action of ours, and as which question."""
    given: list[Any] = []

    def answer(event: Any, scene: Any, form: Any) -> Any:
        given.append((event.action, form))
        return Measures(())

    monkeypatch.setattr(conditions, "of_us", answer)
    return given


@pytest.mark.parametrize(("state", "form"), [("safe", "safe"), ("dangerous", "dangerous")])
@pytest.mark.parametrize("action", ["change-left", "exit-right", "stop", "overtake"])
def test_whether_something_else_is_safe_is_asked_of_what_would_come_of_it(
    state: Any, form: str, action: Any, tried: list[Any]
) -> None:
    held(state, of={"event": Event(action, US, tense="present", time=Now())})
    held(state, of={"tense": "future", "event": Event(action, US, tense="future")})
    assert tried == [(action, form)] * 2


def test_whether_what_we_or_others_do_is_safe_is_asked_of_distances(tried: list[Any]) -> None:
    def told(of: Any, **facts: Any) -> bool:
        return isinstance(held("safe", of=of, **facts).answer, Closeness)

    doing = did("change-left", 8.0, None)
    event = Event("change-left", US, tense="present", time=Now())
    assert told({"event": event}, episodes=(doing,))
    other = Event("change-left", ONE, tense="present", time=Now())
    assert told({"event": other})
    assert told({"event": Event("follow", US, tense="present")})
    assert tried == []


def test_whether_we_were_ever_unsure_is_asked_of_what_we_did(handed: list[Any]) -> None:
    held("sure", of={"tense": "past"})
    held("sure")
    did_so = HowSure(Happens(handed[0].of.event))
    assert handed == [did_so, HowSure()]
    assert (handed[0].of.event.action, handed[0].of.event.tense) == ("do", "past")
