"""Why we drive no faster, or so fast; asked at 20 s.

The limit is 20 m/s unless something else is said.
"""

from typing import Any

import pytest

from tests.explain.answers.stated import decision, did, driven, look, place, result, roads, scene
from xavi_dialogue.domain.answers import (
    DidNotHappen,
    Evidence,
    MotionCause,
    MotionReason,
    NotRecorded,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Vehicle
from xavi_dialogue.explain.answers.reasons import motions as room
from xavi_dialogue.explain.causes.driving.slowness import Slowness
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons
from xavi_dialogue.explain.history.nearing import speed_at

IT, US = Vehicle(1), Ego()
SEEN = {1: look(1), 2: look(2)}
SAID = Span(4.0, 6.0, said=True)
TRACE = decision(2.0, road=roads(places={0: place(limit=20.0)}))
LEADER, LIMIT = MotionCause("leader", vehicle=1), MotionCause("limit", value=20.0)
CUT_IN = MotionCause("cut-in", vehicle=2)
PLAN, LINE = MotionCause("plan"), MotionCause("give-way-line", vehicle=1)


def driving(speed: float | tuple[float, ...] = 9.0) -> dict[int, Any]:
    """Our motion at a speed, or at one speed each second up to 20 s."""
    return {0: driven((0.0,) * 21, speed=speed)}


# Driving slowly ---------------------------------------------------------------------------------


class Slow:
    """How slowly we drive and why; at which time it was asked is kept."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.causes: tuple[MotionCause, ...] = (LEADER,)
        self.is_slow: bool | None = True
        self.slowed: tuple[MotionCause, ...] = ()
        self.kept: tuple[MotionCause, ...] | None = None
        self.times: list[float] = []
        self.deeds: list[Episode] = []
        patch.setattr(room, "slowness", self._slowness)
        patch.setattr(room, "driven_for", self._reasons)
        patch.setattr(room, "as_of", self._as_of)

    def _slowness(self, ride: Any, _: Any, time: float) -> Slowness:
        self.times.append(time)
        speed = speed_at(ride, time)
        deed = Episode(US, "move", time, speed_from=speed, speed_to=speed)
        reasons = Reasons(self.causes, None, Evidence("tree", traces=("t2",)), TRACE)
        return Slowness(deed, reasons, 20.0, self.is_slow)

    def _reasons(self, _ride: Any, _world: Any, deed: Episode) -> Reasons:
        self.deeds.append(deed)
        return Reasons(self.slowed, None, Evidence(), TRACE)

    def _as_of(self, _: Any, causes: Any, time: float) -> Any:
        assert time == 20.0
        return causes if self.kept is None else self.kept


@pytest.fixture
def slow(monkeypatch: pytest.MonkeyPatch) -> Slow:
    return Slow(monkeypatch)


def asked(span: Span | None = None, speed: Any = 9.0, **more: Any) -> Any:
    return scene(span, motions=driving(speed), traces=(TRACE,), looks=SEEN, **more)


def test_the_state_is_told_with_its_reasons(slow: Slow) -> None:
    assert room.slow(asked()) == MotionReason(
        Episode(US, "move", 20.0, speed_from=9.0, speed_to=9.0), (LEADER,), asked="move",
        evidence=Evidence("tree", traces=("t2",)), manner="slowly", limit=20.0,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("manner", "is_slow", "premise"),
    [
        ("slowly", True, True),
        ("slowly", None, True),
        ("slowly", False, False),
        ("close", False, True),
    ],
)
def test_who_is_not_slow_is_not_said_to_be(
    slow: Slow, manner: Any, is_slow: Any, premise: bool
) -> None:
    slow.is_slow = is_slow
    assert result(room.slow, asked(), manner).premise is premise


@pytest.mark.parametrize(
    ("event", "span", "time"),
    [
        (None, None, 20.0),
        (None, SAID, 5.0),
        (Event("move", tense="present"), SAID, 20.0),
        (Event("move"), SAID, 5.0),
        (Event("move", tense="perfect"), SAID, 5.0),
        (Event("move", tense="perfect"), Span(4.0, 6.0), 20.0),
        (Event("move", tense="perfect"), Span(12.0, 18.0, said=True), 20.0),
        (Event("move", tense="perfect"), Span(12.0, 17.9, said=True), 14.95),
    ],
)
def test_a_state_is_of_its_time(slow: Slow, event: Any, span: Any, time: float) -> None:
    room.slow(asked(span), event=event)
    assert slow.times[0] == pytest.approx(time)


STOOD = (9.0,) * 15 + (0.0,) * 6
SETS_OFF = (9.0,) * 15 + (2.0, 3.0, 4.0, 5.0, 6.0, 7.0)


def test_who_stands_is_told_why_it_stands(slow: Slow, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "motion", lambda event, _, asked: (event, asked))
    stands = (Event("stand", tense="present"), "stand")
    assert result(room.slow, asked(speed=STOOD)) == stands
    assert result(room.standing_or_slow, asked(speed=STOOD)) == stands
    assert result(room.standing_or_slow, asked(SAID, STOOD)).deed.begin == 5.0
    now = Event("move", tense="present")
    assert result(room.standing_or_slow, asked(SAID, STOOD), now) == stands
    assert result(room.standing_or_slow, asked(speed=0.3)).manner == "slowly"
    assert result(room.standing_or_slow, asked(speed=0.2)) == stands
    assert result(room.slow, asked(speed=STOOD), "close").manner == "close"


@pytest.mark.parametrize(
    ("causes", "is_slow", "speed", "rising"),
    [
        ((LIMIT,), True, SETS_OFF, True),
        ((PLAN, LIMIT), True, SETS_OFF, True),
        ((LEADER, LIMIT), True, SETS_OFF, False),
        ((LIMIT,), False, SETS_OFF, False),
        ((LIMIT,), None, SETS_OFF, False),
        ((LIMIT,), True, 9.0, False),
    ],
)
def test_who_picks_up_speed_is_told_so(
    slow: Slow, causes: Any, is_slow: Any, speed: Any, rising: bool
) -> None:
    slow.causes, slow.is_slow = causes, is_slow
    told = result(room.slow, asked(speed=speed, episodes=(did("brake", 18.5, 19.0),)))
    assert told.causes == ((MotionCause("picking-up"),) if rising else causes)
    assert slow.deeds == [] or not rising


@pytest.mark.parametrize(
    ("causes", "is_slow", "slowed", "kept", "told"),
    [
        ((LIMIT,), True, (LEADER,), None, (LEADER,)),
        ((LIMIT,), None, (LEADER,), None, (LEADER,)),
        ((LIMIT,), False, (LEADER,), None, (LIMIT,)),
        ((CUT_IN,), True, (LEADER,), None, (CUT_IN,)),
        ((LIMIT, CUT_IN), True, (LEADER,), None, (LIMIT, CUT_IN)),
        ((LIMIT,), True, (LINE,), None, (LIMIT,)),
        ((LIMIT,), True, (PLAN,), None, (LIMIT,)),
        ((LIMIT,), True, (LINE, LEADER), None, (LINE, LEADER)),
        ((LIMIT,), True, (LEADER,), (), (LIMIT,)),
        ((LIMIT,), True, (PLAN, LEADER), (PLAN,), (LIMIT,)),
        ((LIMIT,), True, (PLAN, LEADER), (LEADER,), (LEADER,)),
    ],
)  # fmt: skip
def test_for_whom_we_slowed_down_just_now_is_why(
    slow: Slow, causes: Any, is_slow: Any, slowed: Any, kept: Any, told: Any
) -> None:
    slow.causes, slow.is_slow, slow.slowed, slow.kept = causes, is_slow, slowed, kept
    assert result(room.slow, asked(episodes=(did("brake", 15.0, 18.5),))).causes == told


@pytest.mark.parametrize(
    ("episode", "counts"),
    [
        (did("brake", 15.0, 18.0), True),
        (did("slow-down", 15.0), True),
        (did("give-way", 15.0), True),
        (did("brake", 15.0, 17.9), False),
        (did("wait", 15.0), False),
        (did("stop", 15.0), False),
    ],
)
def test_only_slowing_down_of_late_counts(slow: Slow, episode: Episode, counts: bool) -> None:
    slow.causes, slow.slowed = (LIMIT,), (LEADER,)
    room.slow(asked(episodes=(did("brake", 5.0, 6.0), episode)))
    assert slow.deeds == ([episode] if counts else [])


def test_of_several_slowings_the_latest_counts(slow: Slow) -> None:
    slow.causes, slow.slowed = (LIMIT,), (LEADER,)
    two = (did("brake", 14.0, 18.5), did("slow-down", 15.0))
    room.slow(asked(episodes=two))
    assert slow.deeds == [two[1]]


# Driving fast -----------------------------------------------------------------------------------

OFF = (9.0,) * 12 + (0.0, 0.0, 0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0)


@pytest.mark.parametrize(
    ("span", "speed", "causes", "premise", "end"),
    [
        (None, 9.0, (LIMIT,), False, None),
        (None, 21.0, (LIMIT,), True, None),
        (None, 20.0, (LIMIT,), False, None),
        (None, OFF, (MotionCause("starting"), LIMIT), False, None),
        (SAID, 9.0, (LIMIT,), False, 5.0),
        (Span(19.4, 19.8, said=True), 9.0, (LIMIT,), False, None),
        (Span(19.2, 19.6, said=True), 9.0, (LIMIT,), False, 19.4),
        (Span(1.0, 1.0, said=True), 9.0, (PLAN,), True, 1.0),
    ],
)
def test_our_speed_is_told_by_the_limit_where_nobody_holds_us_up(
    slow: Slow, span: Any, speed: Any, causes: Any, premise: bool, end: float | None
) -> None:
    slow.causes = (LIMIT,)
    found = room.fast(asked(span, speed))
    assert isinstance(found, MotionReason)
    assert (found.causes, found.premise, found.manner) == (causes, premise, "fast")
    assert (found.asked, found.limit) == ("move", None if causes == (PLAN,) else 20.0)
    begin = 20.0 if span is None else (span.begin + span.end) / 2.0
    assert found.deed.begin == pytest.approx(begin)
    assert found.deed.end == (None if end is None else pytest.approx(end))
    assert found.deed.speed_from == found.deed.speed_to == (12.0 if speed is OFF else speed)


@pytest.mark.parametrize(
    ("speed", "causes", "told"),
    [
        (9.0, (LEADER,), (LEADER,)),
        (18.0, (LEADER,), (LEADER,)),
        (18.8, (LEADER,), (LIMIT,)),
        (9.0, (LIMIT,), (LIMIT,)),
        (OFF, (LEADER,), (MotionCause("starting"), LIMIT)),
    ],
)
def test_below_the_limit_our_speed_is_told_by_who_holds_us_up(
    slow: Slow, speed: Any, causes: Any, told: Any
) -> None:
    slow.causes = causes
    found = room.fast(asked(None, speed))
    assert isinstance(found, MotionReason)
    assert found.causes == told
    assert found.manner == ("slowly" if told == (LEADER,) else "fast")


def test_before_the_record_there_is_no_speed() -> None:
    found = result(room.fast, scene(SAID))
    assert found == NotRecorded("before-record", since=5.0)


# Where nothing of it goes on --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("action", "is_slow", "speed", "told"),
    [
        ("brake", True, 9.0, True),
        ("stop", True, 0.3, True),
        ("brake", False, 9.0, False),
        ("brake", None, 9.0, False),
        ("brake", True, 0.2, False),
        ("speed-up", True, 9.0, False),
    ],
)
def test_who_does_not_slow_down_now_may_drive_slowly(
    slow: Slow, action: Any, is_slow: Any, speed: float, told: bool
) -> None:
    slow.is_slow = is_slow
    event = Event(action, tense="present")
    found = result(room.motion, event, asked(speed=speed))
    if told:
        assert (found.premise, found.asked, found.causes) == (False, action, (LEADER,))
    else:
        assert found == DidNotHappen(event)
    past = result(room.motion, Event("brake"), asked(speed=speed))
    assert past == DidNotHappen(Event("brake"))
