"""What would come of not slowing down, not waiting, or going before another one; at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.stated import did, driven, look, result, scene
from xavi_dialogue.domain.answers import (
    DidNotHappen,
    MotionCause,
    MotionReason,
    NeedRollout,
    Unslowed,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.terms import Ego, Event, Related, Vehicle
from xavi_dialogue.explain.answers.reasons import motions
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.suppositions import hastening as room
from xavi_dialogue.explain.causes.driving.crossing import Crossing

US, IT, OTHER = Ego(), Vehicle(1), Vehicle(2)
SEEN = {1: look(1), 2: look(2)}
BRAKES = did("brake", 5.0, 8.0, speed_from=9.0)
BY_RIGHT = MotionCause("right-of-way", vehicle=1)
LEADER = MotionCause("leader", vehicle=2)


class Facts:
    """What other modules tell; what was asked of them is kept."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.reason: Any = MotionReason(BRAKES, (BY_RIGHT,))
        self.meets: dict[int, Crossing] = {}
        self.cost: float | None = None
        self.asked: list[Any] = []
        patch.setattr(motions, "slow", lambda _: "slow")
        patch.setattr(motions, "motion", self._motion)
        patch.setattr(room, "crossing", self._crossing)
        patch.setattr(room, "lost", self._lost)

    def _motion(self, event: Event, _: Any) -> Any:
        self.asked.append(event)
        if isinstance(self.reason, Exception):
            raise self.reason
        return self.reason

    def _crossing(self, _: Any, vehicle: int, begin: float, speed: float, **more: Any) -> Any:
        self.asked.append((vehicle, begin, speed, more["setting_off"]))
        return self.meets.get(vehicle)

    def _lost(self, _: Any, deed: Episode) -> Measure | None:
        return None if self.cost is None else Measure("delay", US, deed.begin, value=self.cost)


@pytest.fixture
def facts(monkeypatch: pytest.MonkeyPatch) -> Facts:
    return Facts(monkeypatch)


def setting(span: Span | None = None, speed: float | None = 9.0, **more: Any) -> Any:
    """A ride in which we drive at a speed, beside two vehicles."""
    ours = {} if speed is None else {0: driven((0.0,) * 21, speed=speed)}
    return scene(span, looks=SEEN, motions=ours, **more)


def supposed(event: Event, asked: Any = None, **more: Any) -> Any:
    return result(lambda: room.hastened(event, asked or setting(), **more))


GO = Event("go", modal="would")


def test_to_speed_up_is_asked_of_driving_no_faster(facts: Facts) -> None:
    assert supposed(Event("speed-up")) == "slow"


def test_without_slowing_we_would_have_crossed_another_way(facts: Facts) -> None:
    facts.meets[1] = Crossing(1, 7.0, 7.5)
    facts.cost = 3.0
    found = supposed(GO, setting(values={("arrival-time", 0): 95.0}), form="crash")
    assert found == Unslowed(
        BRAKES, BY_RIGHT, 7.0, 7.5, going=True, vehicle=1, right=True, past=True, form="crash",
        saved=3.0, arrival=92.0,
    )  # fmt: skip
    assert facts.asked[1:] == [(1, 5.0, 9.0, False)]


def test_what_is_not_known_is_left_open(facts: Facts) -> None:
    found = supposed(GO)
    assert (found.ours, found.theirs, found.vehicle, found.right) == (None, None, None, True)
    assert (found.saved, found.arrival, found.cause) == (None, None, BY_RIGHT)
    facts.cost = 3.0
    assert (supposed(GO).saved, supposed(GO).arrival) == (3.0, None)
    facts.cost, facts.reason = None, MotionReason(BRAKES, ())
    found = supposed(GO, setting(values={("arrival-time", 0): 95.0}))
    assert (found.cause, found.arrival) == (None, None)


@pytest.mark.parametrize(
    ("manner", "going"), [((), True), (("fast",), False), (("slowly",), False), (("first",), True)]
)
def test_another_speed_is_no_going_on(facts: Facts, manner: Any, going: bool) -> None:
    assert supposed(Event("go", manner=manner, modal="would")).going is going


def test_the_reason_is_whose_way_it_is(facts: Facts) -> None:
    facts.reason = MotionReason(BRAKES, (LEADER, BY_RIGHT))
    facts.meets[1] = Crossing(1, 7.0, 7.5)
    assert supposed(GO).cause == BY_RIGHT
    facts.meets = {2: Crossing(2, 7.0, 7.5)}
    assert (supposed(GO).cause, supposed(GO).right) == (LEADER, False)
    gave = did("wait", 5.5, 7.0, object=OTHER)
    assert supposed(GO, setting(episodes=(gave,))).right is True
    facts.meets = {}
    assert supposed(GO).cause == LEADER


def test_who_is_named_is_the_one_that_is_met(facts: Facts) -> None:
    facts.meets = {1: Crossing(1, 7.0, 7.1), 2: Crossing(2, 7.0, 9.0)}
    facts.reason = MotionReason(BRAKES, (LEADER, BY_RIGHT))
    assert supposed(GO).vehicle == 1  # the closest in time
    assert supposed(Event("go", object=OTHER, modal="would")).vehicle == 2
    assert supposed(GO, struck=2).vehicle == 2
    before = Event("go", where=Related("ahead-of", US, OTHER), modal="would")
    assert supposed(before).vehicle == 2
    behind = Event("go", where=Related("behind", US, OTHER), modal="would")
    assert supposed(behind).vehicle == 1


def test_who_was_past_already_is_not_met(facts: Facts) -> None:
    facts.meets = {1: Crossing(1, 7.0, 3.9)}
    assert supposed(GO).vehicle is None
    facts.meets = {1: Crossing(1, 7.0, 4.1)}
    assert supposed(GO).vehicle == 1
    facts.meets = {1: Crossing(1, 7.0, 5.0), 2: Crossing(2, 7.0, 8.0)}
    facts.reason = MotionReason(BRAKES, (LEADER, BY_RIGHT))
    assert supposed(GO).vehicle == 2  # 1 s after us, the other 2 s before


def test_where_we_did_not_slow_another_answer_is_given(facts: Facts) -> None:
    facts.reason = "choice"
    assert supposed(GO) == "choice"
    facts.reason = Unanswered(DidNotHappen(Event("brake")))
    assert supposed(GO) == "slow"
    facts.reason = Unanswered(NeedRollout("t4"))
    assert supposed(GO) == NeedRollout("t4")


@pytest.mark.parametrize(
    ("event", "asked"),
    [
        (Event("go", object=IT, tense="past", modal="would"), Event("slow-down")),
        (Event("brake", manner=("hard",), tense="future", modal="would"), Event("brake")),
        (Event("wait", where=Related("behind", US, IT), modal="would"), Event("wait")),
    ],
)
def test_it_is_asked_why_we_slowed_or_waited(facts: Facts, event: Event, asked: Event) -> None:
    room._cause(event, setting())
    assert facts.asked == [asked]


# Now --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "span", "speed", "action"),
    [
        (Event("go", tense="present"), None, 2.0, "wait"),
        (Event("go", tense="future", modal="would"), None, 3.9, "wait"),
        (Event("go", tense="present"), None, 4.0, "slow-down"),
        (Event("go", tense="present"), Span(4.0, 6.0), 2.0, "wait"),
        (Event("go", tense="present"), Span(4.0, 18.9, said=True), 2.0, None),
        (Event("go", tense="present"), Span(4.0, 19.1, said=True), 2.0, "wait"),
        (Event("go"), None, 2.0, "wait"),
        (Event("go"), None, 4.0, None),
        (Event("go", modal="would"), None, 2.0, None),
        (Event("go"), Span(4.0, 6.0), 2.0, None),
        (Event("go", tense="perfect"), None, 2.0, None),
        (Event("go", tense="present"), None, None, None),
    ],
)
def test_what_would_end_now_is_the_waiting_or_slowing(
    event: Event, span: Any, speed: float | None, action: Any
) -> None:
    found = room._now(event, setting(span, speed))
    expected = None if action is None else Episode(US, action, 20.0, speed_from=speed)
    assert found == expected


def test_going_now_would_be_setting_off(facts: Facts) -> None:
    facts.meets = {2: Crossing(2, 24.0, 25.0)}
    found = supposed(Event("go", tense="present"), setting(speed=2.0))
    assert (found.deed.action, found.deed.begin, found.vehicle) == ("wait", 20.0, 2)
    assert (found.cause, found.past, found.right) == (None, False, False)
    assert facts.asked == [(1, 20.0, 2.0, True), (2, 20.0, 2.0, True)]
    facts.asked.clear()
    facts.cost = 3.0
    fast = supposed(Event("go", tense="present"), setting(values={("arrival-time", 0): 95.0}))
    assert (fast.saved, fast.arrival) == (None, None)
    assert [one[-1] for one in facts.asked] == [False, False]
    facts.asked.clear()
    supposed(Event("go", object=OTHER, tense="present"), setting(speed=2.0))
    assert facts.asked == [(2, 20.0, 2.0, True)]


# Whom we let go ---------------------------------------------------------------------------------

GAVE = did("give-way", 6.0, 9.0, object=OTHER)


def test_who_is_named_was_let_go_by_slowing(facts: Facts) -> None:
    facts.meets[2] = Crossing(2, 7.0, 7.5)
    event = Event("go", object=OTHER, modal="would")
    slows = did("brake", 5.6, 8.0, speed_from=7.0)
    found = supposed(event, setting(episodes=(GAVE, slows)))
    assert (found.deed, found.past, found.right) == (slows, True, True)
    assert found.cause == MotionCause("right-of-way", vehicle=2)
    assert facts.asked == [(2, 5.6, 7.0, False)]
    unnamed = supposed(GO, setting(episodes=(GAVE, slows)))
    assert unnamed.deed == BRAKES
    now = supposed(Event("go", object=OTHER, tense="present"), setting(speed=2.0, episodes=(GAVE,)))
    assert (now.deed.action, now.cause) == ("wait", None)
    facts.asked.clear()
    plain = supposed(event, setting(episodes=(GAVE,)))
    assert plain.deed == GAVE
    assert facts.asked[-1] == (2, 6.0, 0.0, False)


@pytest.mark.parametrize(
    ("episodes", "deed"),
    [
        ((GAVE, did("brake", 3.0, 5.6, speed_from=7.0)), 1),
        ((GAVE, did("brake", 3.0, 5.4, speed_from=7.0)), 0),
        ((GAVE, did("slow-down", 6.4, 8.0, speed_from=7.0)), 1),
        ((GAVE, did("slow-down", 6.6, 8.0, speed_from=7.0)), 0),
        ((GAVE, did("brake", 5.8, 8.0)), 0),
        ((GAVE, did("wait", 12.0, 15.0, object=OTHER)), 1),
        ((did("give-way", 6.0, 9.0, object=IT),), None),
        ((), None),
    ],
)
def test_letting_somebody_go_begins_with_slowing(episodes: Any, deed: int | None) -> None:
    found = room._letting(setting(episodes=episodes), 2)
    assert found == (None if deed is None else episodes[deed])


@pytest.mark.parametrize(
    ("episode", "found"),
    [
        (did("wait", 5.0, 6.0, object=OTHER), {2}),
        (did("give-way", 2.0, 4.1, object=OTHER), {2}),
        (did("give-way", 2.0, 3.9, object=OTHER), set()),
        (did("give-way", 8.0, 9.0, object=OTHER), {2}),
        (did("give-way", 8.1, 9.0, object=OTHER), set()),
        (did("give-way", 6.0, 9.0, object=Vehicle(0)), set()),
        (did("give-way", 6.0, 9.0), set()),
        (did("stop", 6.0, 9.0, object=OTHER), set()),
    ],
)
def test_way_was_given_about_then(episode: Episode, found: set[int]) -> None:
    assert room._let_go(setting(episodes=(episode,)), BRAKES) == found


def test_of_a_long_wait_only_its_beginning_counts() -> None:
    waits = did("wait", 5.0)
    for begin, found in ((29.9, {2}), (30.1, set())):
        asked = setting(now=40.0, episodes=(did("give-way", begin, 35.0, object=OTHER),))
        assert room._let_go(asked, waits) == found


# What we did anyway -----------------------------------------------------------------------------


def test_to_turn_while_he_was_there_is_not_to_let_him_go(
    facts: Facts, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(room, "closeness", lambda _, who, about, how, **more: (who, more))
    facts.meets = {2: Crossing(2, 10.0, 10.5)}
    let_go = (BRAKES, did("give-way", 5.0, 8.0, object=OTHER))
    asked = setting(episodes=let_go)
    found = result(lambda: room.as_it_was(asked, "crash", 2, past=True))
    assert isinstance(found, Unslowed)
    assert (found.vehicle, found.form) == (2, "crash")
    assert room.as_it_was(asked, "crash", 2, past=False) == (2, {"past": False})
    assert room.as_it_was(asked, "crash", 1, past=True) == (1, {})
