"""What is replied to a request: what is done or planned anyway, why it cannot be, what bears on it.

What we are doing, foresee and would give as a reason is given in each test.
"""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.trace import NotApplicable
from tests.explain.answers.given import NOW, Told, deed, look, option, plan, refused
from tests.explain.answers.requested import (
    LEADER,
    ONE,
    SPEED,
    TURN,
    WAIT,
    Setting,
    reply,
    to,
)
from xavi_dialogue.domain.answers import (
    Activity,
    ChoiceReason,
    DidNotHappen,
    MotionCause,
    NeedRollout,
    PlanAhead,
)
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.explain.answers import requests
from xavi_dialogue.explain.answers.reasons import motions


@pytest.fixture
def now(monkeypatch: pytest.MonkeyPatch) -> Setting:
    return Setting(monkeypatch)


# --- whether it is done anyway ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("action", "trend"),
    [("slow-down", "slowing"), ("brake", "slowing"), ("speed-up", "speeding-up")],
)
def test_a_speed_that_is_changing_so_already_is_told(action: Any, trend: Any, now: Setting) -> None:
    for one in ("slowing", "speeding-up", "steady", "standing"):
        now.trend, now.causes = one, ()
        found = reply(to(action))
        assert (found.already, found.able) == (one == trend, True)
        assert found.facts == (SPEED,)


def test_standing_and_going_are_told_as_they_are(now: Setting) -> None:
    for stands in (True, False):
        now.stands = stands
        assert [reply(to(a)).already for a in ("stop", "stand", "wait")] == [stands] * 3
        assert [reply(to(a)).already for a in ("go", "move")] == [not stands] * 2
    now.expects("stop", 0.5)
    assert reply(to("go")).already is False
    now.expects("stop", 0.49)
    assert reply(to("go")).already is True


@pytest.mark.parametrize(("headway", "kept"), [(1.8, True), (1.79, False), (None, False)])
def test_a_distance_is_kept_from_1_8_s_on(headway: Any, kept: bool, now: Setting) -> None:
    known = [] if headway is None else [headway]
    measures = {("headway", Ego(), ONE): headway, ("gap", Ego(), ONE): 17.0}
    found = reply(to("keep-distance", object=ONE), measures=measures)
    assert (found.already, [m.value for m in found.facts]) == (kept, [17.0, *known])
    anybody = {("headway", Ego(), None): headway, ("gap", Ego(), None): 18.0}
    alone = reply(to("keep-distance"), measures=anybody)
    assert (alone.already, [m.value for m in alone.facts]) == (kept, [18.0, *known])


@pytest.mark.parametrize("side", ["change-left", "change-right"])
def test_we_stay_in_our_lane_unless_we_mean_to_leave_it(side: str, now: Setting) -> None:
    for action in ("continue", "keep-lane", "follow"):
        assert reply(to(action)).already is True
    now.expects(side, 0.49)
    assert reply(to("keep-lane")).already is True
    now.expects(side, 0.5)
    assert reply(to("keep-lane")).already is False
    now.expects("change-left", 0.1)
    now.expects("change-right", 0.1)
    now.expects(side, 0.6)
    assert reply(to("keep-lane")).already is False


def test_staying_behind_somebody_needs_him_ahead(now: Setting) -> None:
    follow, gap = to("follow", object=ONE), {("gap", Ego(), ONE): 15.0}
    assert reply(follow, measures=gap).already is True
    assert reply(follow).already is False
    assert reply(follow, measures=gap, looks={1: look(1, ahead=-5.0)}).already is False
    assert reply(follow, measures=gap, looks={1: None}).already is False
    assert reply(to("keep-lane", object=ONE)).already is True
    now.expects("change-left", 0.5)
    assert reply(follow, measures=gap).already is False


def test_another_deed_is_done_already_while_it_goes_on(now: Setting) -> None:
    on, over = deed("change-left", 18.0), deed("change-left", 18.0, 19.8)
    change = to("change-lane", side="left")
    assert reply(change, deeds=(on,)).already is True
    assert reply(change, deeds=(over,)).already is False
    assert reply(change).already is False


# --- whether it comes, or cannot be -------------------------------------------------------------


@pytest.mark.parametrize(
    ("share", "in_", "soon"),
    [(0.5, 3.0, 23.0), (0.5, 3.1, None), (0.49, 2.0, None), (1.0, -2.0, 20.0)],
)
def test_what_the_plan_comes_to_shortly_is_told(
    share: float, in_: float, soon: Any, now: Setting
) -> None:
    now.expects("exit-right", share, in_)
    assert reply(to("turn", side="right")).soon == soon


def test_going_on_or_doing_something_is_not_to_come(now: Setting) -> None:
    for action in ("continue", "do", "happen", "enter"):
        now.expects(action, 1.0)
        now.expects("change-left", 1.0)  # so that going on is not what is done
        assert reply(to(action)).soon is None
    now.stands = True
    assert reply(to("enter")).soon == 22.0
    now.expects("exit-right", 1.0)
    assert reply(to("turn", side="right"), deeds=(deed("exit-right", 18.0),)).soon is None


def cannot(*reasons: Any, under_way: Any = None, node: Any = (), **more: Any) -> Any:
    refusals = tuple(NotApplicable(node, action, f"no {action}") for action in reasons)
    trace = replace(plan(NOW, "continue", under_way=under_way), not_applicable=refusals)
    return reply(to("change-lane"), traces=(trace,), **more).cannot


def test_what_the_last_decision_could_not_have_is_told_with_its_reason(
    now: Setting, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert cannot("change-left", "change-right") == "no change-left"
    assert cannot("change-left", "change-right", node=("stop",)) is None
    assert cannot("change-left") is None  # the other side might do
    assert cannot("change-left", under_way="exit-left") == "no change-left"
    assert cannot("exit-left", "stop") is None
    for tried, told in (("change-right", None), ("continue", "no change-left")):
        with monkeypatch.context() as known:
            known.setattr(requests, "options_at", lambda *_, tried=tried: (option(tried),))
            assert cannot("change-left", "change-right") == told
    now.expects("change-lane", 1.0)
    assert cannot("change-left", "change-right") is None


def test_what_no_car_can_do_is_not_tried(now: Setting) -> None:
    found = reply(to("honk"))
    assert (found.able, found.already, found.soon, found.cannot) == (False, False, None, None)
    assert reply(to("honk"), negated=True).already is True


def test_overtaking_is_answered_by_why_we_stay_behind(now: Setting) -> None:
    now.staying = Told("staying")
    overtake = to("overtake", object=ONE)
    assert reply(overtake) == Told("staying")
    assert now.asked[-1] == replace(overtake, action="follow")
    assert reply(to("change-lane", side="left")) != Told("staying")
    now.expects("overtake", 1.0)
    assert reply(overtake).soon == 22.0
    now.foreseen.clear()
    assert reply(overtake, deeds=(deed("overtake", 18.0, to=1),)).already is True
    now.staying = None
    assert reply(overtake).already is False


def test_the_ride_ahead_is_told_without_its_end(now: Setting) -> None:
    found = reply(to("turn", side="left"))
    assert found.ahead == PlanAhead((("continue", NOW),), (TURN,))
    assert found.doing == Activity(Ego(), NOW, (), 9.0, "steady")
    nothing = reply(to("stop"), traces=())
    assert (nothing.ahead, nothing.able, nothing.already) == (None, True, False)


# --- why we drive so ----------------------------------------------------------------------------


def test_a_hurry_is_met_with_why_we_stand_or_slow_down(now: Setting) -> None:
    for trend, action in (("standing", "stand"), ("slowing", "slow-down")):
        now.trend = trend
        for wish in ("go", "enter", "speed-up", "continue"):
            found = reply(to(wish))
            assert (found.cause, found.already, found.facts) == (LEADER, False, ())
            assert Event(action, tense="present") in now.asked  # type: ignore[arg-type]
        assert reply(to("turn", side="left")).cause is None
    now.trend = "steady"
    assert reply(to("go")).cause is None


def test_somebody_is_told_before_something_and_no_mere_plan(now: Setting) -> None:
    now.trend = "slowing"
    bend = MotionCause("bend")
    now.causes = (bend, LEADER)
    assert reply(to("speed-up")).cause == LEADER
    now.causes = (MotionCause("plan"), MotionCause("starting"), bend)
    assert reply(to("speed-up")).cause == bend
    now.causes = (MotionCause("plan"),)
    assert reply(to("speed-up")).cause is None
    now.causes = DidNotHappen(Event("slow-down"))
    assert reply(to("speed-up")).cause is None
    need = NeedRollout("trace")
    now.causes = need
    assert refused(reply, to("speed-up")) == need


def test_a_cause_is_only_of_a_motion(now: Setting, monkeypatch: pytest.MonkeyPatch) -> None:
    now.trend = "slowing"
    monkeypatch.setattr(motions, "motion", lambda *args: ChoiceReason)
    assert reply(to("speed-up")).cause is None


def test_what_comes_anyway_needs_no_reason(now: Setting) -> None:
    now.stands, now.trend = True, "standing"
    now.expects("go", 1.0)
    found = reply(to("go"))
    assert (found.soon, found.cause, found.facts) == (22.0, None, (WAIT,))


# --- what bears on it ---------------------------------------------------------------------------


def test_what_bears_on_a_wish_is_told(now: Setting) -> None:
    arrival = {("arrival-time", Ego()): 50.0}
    for action in ("stop", "pull-over", "drop-off", "park", "open"):
        assert [m.value for m in reply(to(action), measures=arrival).facts] == [50.0]
    assert reply(to("go", manner=("fast",))).facts == (SPEED,)
    assert reply(to("turn", side="left", manner=("slowly",))).facts == (SPEED,)
    assert reply(to("continue")).facts == ()
    now.stands = True
    assert reply(to("continue")).facts == (WAIT,)
    assert reply(to("turn", side="left")).facts == ()


@pytest.mark.parametrize("action", ["pass", "overtake", "go", "move"])
def test_going_slowly_is_a_wish_about_our_speed(action: Any, now: Setting) -> None:
    found = reply(to(action, object=ONE, manner=("slowly",)))
    assert found.request.event == to("slow-down")
    plain = reply(to(action, object=ONE))
    past = "overtake" if action == "pass" else action  # one who drives ahead in our lane
    assert plain.request.event == to(past, object=ONE)
    other = reply(to("turn", manner=("slowly",)))
    assert other.request.event == to("slow-down")


# --- what not to do -----------------------------------------------------------------------------


def test_what_is_not_to_be_done_is_not_meant_unless_it_is(now: Setting) -> None:
    stop = to("stop")
    assert reply(stop, negated=True).already is True
    now.expects("stop", 0.5)
    now.trend = "slowing"
    meant = reply(stop, negated=True)
    assert (meant.already, meant.cause) == (False, LEADER)
    assert (meant.soon, meant.facts, meant.cannot) == (None, (), None)
    now.expects("stop", 0.49)
    assert reply(stop, negated=True).already is True
    now.stands = True
    assert reply(stop, negated=True).already is False
    for action in ("give-way", "slow-down"):
        now.expects(action, 1.0)
        assert reply(to(action), negated=True).cause == LEADER
    now.expects("exit-right", 1.0)
    turn = reply(to("turn", side="right", manner=("hard",)), negated=True)
    assert (turn.already, turn.cause) == (False, None)
    assert Event("turn", side="right", tense="present") in now.asked
