"""Why another vehicle does what it does, or did not do something; asked at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.reasons.test_others_braking import (
    BY,
    LEADER,
    OTHER,
    SAID,
    US,
    Ways,
    does,
    why,
)
from tests.explain.answers.stated import (
    aim,
    decision,
    driven,
    place,
    roads,
    they,
)
from xavi_dialogue.domain.answers import DidNotHappen, MotionCause
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.explain.answers.reasons import others as room


@pytest.fixture
def ways(monkeypatch: pytest.MonkeyPatch) -> Ways:
    return Ways(monkeypatch)


# Other deeds ------------------------------------------------------------------------------------

LATER = Span(14.0, 16.0, said=True)
TURN, OVER = they(1, "exit-left", 9.0, 12.0), they(1, "exit-left", 2.0, 3.0)


def thinks(goal: Any, share: float, time: float = 6.0) -> Any:
    """What a decision expects of the vehicle."""
    rest = aim("continue", round(1.0 - share, 3))
    return decision(time, aims={1: (aim(goal, share), rest)})


@pytest.mark.parametrize(
    ("event", "episodes", "span", "deed"),
    [
        (does("turn"), (OVER, TURN), None, TURN),
        (does("turn"), (OVER, TURN), SAID, None),
        (does("turn"), (they(1, "exit-left", 4.5, 5.0), TURN), SAID, 0),
        (does("turn", tense="present"), (TURN,), None, None),
        (does("turn", tense="present"), (they(1, "exit-left", 15.0, 18.0),), None, 0),
        (does("turn", tense="present"), (they(1, "exit-left", 15.0, 17.9),), None, None),
        (does("turn", tense="present"), (they(1, "exit-left", 15.0),), None, 0),
        (does("turn"), (they(2, "exit-left", 9.0, 12.0),), None, None),
        (does("pull-out"), (they(1, "pull-out", 9.0, 12.0),), None, 0),
    ],
)
def test_what_it_did_is_told_as_an_episode(
    ways: Ways, event: Event, episodes: Any, span: Any, deed: Any
) -> None:
    found = why(event, *episodes, span=span)
    if deed is None:
        assert isinstance(found, DidNotHappen)
    else:
        assert (found.deed, found.asked) == (episodes[0] if deed == 0 else deed, None)


@pytest.mark.parametrize(
    ("event", "share", "told"),
    [
        (does("exit-left", tense="present"), 0.3, True),
        (does("exit-left", tense="present"), 0.29, False),
        (does("exit-left", tense="future"), 0.9, True),
        (does("exit-left"), 0.9, False),
    ],
)
def test_what_is_expected_of_it_may_be_asked_for(
    ways: Ways, event: Event, share: float, told: bool
) -> None:
    found = why(event, traces=(thinks("exit-left", share),))
    if told:
        assert (found.deed, found.asked, found.causes) == (None, event, ())
        assert {e.actions for e in found.goal.expectations} == {("exit-left",), ("continue",)}
    else:
        assert found == DidNotHappen(event)
    assert why(event) == DidNotHappen(event)


def test_the_goal_is_of_the_last_decision_that_knew_it(ways: Ways) -> None:
    traces = (thinks("exit-left", 0.9, 6.0), thinks("exit-right", 0.9, 10.0))
    found = why(does("turn"), TURN, traces=traces)
    assert (found.goal.time, found.goal.expectations[0].actions) == (6.0, ("exit-left",))
    early = why(does("turn"), they(1, "exit-left", 3.0, 4.0), traces=traces)
    assert early.goal.time == 10.0  # none knew it then
    assert why(does("turn"), TURN).goal is None


# What it does at the time -----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "episodes", "deed"),
    [
        (does("do"), (they(1, "brake", 15.0),), 0),
        (does("do"), (they(1, "brake", 15.0, 18.0), they(1, "exit-left", 16.0)), 1),
        (does("do"), (they(1, "brake", 15.0, 17.9),), None),
        (does("do"), (they(1, "brake", 20.1),), None),
        (does("do"), (they(1, "appear", 19.0), they(1, "follow", 15.0)), None),
        (does("appear"), (they(1, "appear", 19.0), they(1, "brake", 19.5)), 0),
        (does("happen"), (they(2, "brake", 15.0),), None),
    ],
)
def test_what_it_does_is_told_with_who_is_in_its_way(
    ways: Ways, event: Event, episodes: Any, deed: int | None
) -> None:
    ways.present = BY
    found = why(event, *episodes)
    named = deed is not None and episodes[deed].action == event.action
    assert found.deed == (None if deed is None else episodes[deed])
    assert (found.asked, found.causes) == (None if named else event, (LEADER,))
    assert ways.asked == [("present", 1, 20.0)]


def test_what_it_did_then_is_of_that_time(ways: Ways) -> None:
    brakes = they(1, "brake", 2.0, 3.0)
    assert why(does("do"), brakes, they(1, "brake", 9.0), span=SAID).deed == brakes
    assert ways.asked == [("present", 1, 5.0)]


def test_an_indicator_is_told_by_what_it_announces(
    ways: Ways, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[Any] = []
    found = {"found": ("announced",)}

    def announced(_ride: Any, _world: Any, *args: Any) -> Any:
        told.append(args)
        return found["found"]

    monkeypatch.setattr(room, "announced", announced)
    lit = they(1, "signal", 15.0, side="left")
    assert why(does("signal", tense="present"), lit) == ("announced",)
    assert told == [(1, lit, 20.0)]
    found["found"] = None  # type: ignore[assignment]
    assert why(does("signal"), lit) == DidNotHappen(does("signal"), (lit,))
    assert why(does("signal")) == DidNotHappen(does("signal"))
    assert len(told) == 2


# Where it did not -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "episodes", "deed"),
    [
        (does("exit-left"), (they(1, "exit-right", 9.0, 12.0),), 0),
        (does("turn"), (they(1, "exit-straight", 9.0, 12.0),), 0),
        (does("turn"), (they(1, "change-left", 9.0, 12.0),), None),
        (does("turn"), (they(1, "stop", 8.0, 9.0), they(1, "exit-straight", 13.0, 15.0)), 1),
        (does("exit-left"), (they(1, "exit-right", 9.0), they(1, "exit-straight", 13.0)), 1),
        (does("merge"), (they(1, "exit-straight", 9.0, 12.0),), 0),
        (does("merge"), (they(1, "follow", 9.0, 12.0), they(1, "appear", 9.0)), None),
        (does("slow-down"), (they(1, "go", 9.0, 12.0),), 0),
        (does("slow-down"), (they(1, "exit-left", 9.0, 12.0),), None),
    ],
)
def test_what_it_did_instead_is_why_not(
    ways: Ways, event: Event, episodes: Any, deed: int | None
) -> None:
    found = why(event, *episodes, no=True)
    assert (found.deed, found.asked) == (None if deed is None else episodes[deed], event)


def test_what_it_did_after_all_is_told(ways: Ways) -> None:
    late = they(1, "exit-right", 15.0, 17.0)
    event = does("exit-left")
    assert why(event, TURN, no=True) == DidNotHappen(event, (TURN,))
    assert why(event, OVER, TURN, no=True) == DidNotHappen(event, (TURN,))
    assert why(event, TURN, late, no=True).deed == late
    before = they(1, "exit-right", 5.0, 9.0)
    assert why(event, TURN, before, no=True) == DidNotHappen(event, (TURN,))
    assert why(event, OVER, before, TURN, no=True) == DidNotHappen(event, (TURN,))
    assert why(event, TURN, before, no=True, span=SAID).deed == before
    assert why(event, TURN, no=True, span=SAID).deed is None


def test_who_stops_instead_is_told_for_whom(ways: Ways) -> None:
    ways.stood = ways.slowed = BY
    stop = they(1, "stop", 9.0, 12.0)
    found = why(does("overtake", object=OTHER), stop, no=True)
    assert (found.deed, found.asked, found.causes) == (stop, does("overtake", object=OTHER), (LEADER,))  # fmt: skip  # noqa: E501
    brake = they(1, "brake", 9.0, 12.0)
    assert why(does("turn", tense="past"), they(1, "exit-straight", 9.0), no=True).causes == ()
    assert why(does("cut-in"), brake, no=True).causes == (LEADER,)


@pytest.mark.parametrize(
    ("event", "ours", "its", "pace"),
    [
        (does("overtake"), 9.0, 10.0, True),
        (does("pass", object=US), 9.0, 8.0, True),
        (does("overtake"), 9.0, 10.1, False),
        (does("overtake", object=OTHER), 9.0, 8.0, False),
        (does("cut-in"), 9.0, 8.0, False),
        (does("overtake"), None, 8.0, False),
        (does("overtake"), 9.0, None, False),
    ],
)
def test_who_is_no_faster_does_not_pass_us(
    ways: Ways, event: Event, ours: Any, its: Any, pace: bool
) -> None:
    found = why(
        event, no=True, values={("speed", 1): its},
        motions={} if ours is None else {0: driven((0.0,) * 21, speed=ours)},
        traces=(decision(4.0, road=roads(places={0: place(limit=13.0)})),),
    )  # fmt: skip
    limit = MotionCause("limit", 0, speed=its, value=13.0)
    assert found.causes == ((limit,) if pace else ())
    assert (found.deed, found.asked) == (None, event)


@pytest.mark.parametrize(
    ("span", "episodes", "refusal"),
    [
        (SAID, (TURN,), DidNotHappen(does("turn"), (TURN,), elsewhen=9.0)),
        (SAID, (OVER, TURN), DidNotHappen(does("turn"), (TURN,), elsewhen=9.0)),
        (None, (they(1, "merge", 15.0, 16.0),), 0),
        (None, (they(1, "merge", 15.0, 16.0), they(1, "cross", 17.0, 18.0)), 1),
        (SAID, (they(1, "merge", 2.0, 3.0), they(1, "cross", 9.0, 10.0)), 0),
        (LATER, (they(1, "merge", 6.0, 9.0), they(1, "cross", 18.0, 19.0)), 1),
        (LATER, (they(1, "merge", 6.0, 11.0), they(1, "cross", 18.0, 19.0)), 0),
        (None, (they(1, "merge", 2.0, 3.0),), 0),
        (None, (they(1, "merge", 2.0, 3.0), they(1, "cross", 15.5, 16.0)), 1),
        (None, (they(1, "merge", 14.0, 15.1), they(1, "approach", 19.0)), 0),
        (None, (they(1, "appear", 19.0), they(1, "disappear", 19.5)), None),
        (None, (they(2, "merge", 15.0, 16.0),), None),
    ],
)
def test_the_refusal_tells_what_it_did(ways: Ways, span: Any, episodes: Any, refusal: Any) -> None:
    found = why(does("turn"), *episodes, span=span)
    if not isinstance(refusal, DidNotHappen):
        told = () if refusal is None else (episodes[refusal],)
        refusal = DidNotHappen(does("turn"), told)
    assert found == refusal
