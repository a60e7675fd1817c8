"""How long a state lasts, and how long we mean to stay behind somebody; asked at 20 s."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.stated import decision, did, look, result, scene
from xavi_dialogue.domain.answers import Happenings, Lasted, Staying, Verdict
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.meaning import HowLong
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Measured,
    Next,
    Not,
    Now,
    Quantity,
    Related,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.explain.answers.propositions import lasting

IT, US = Vehicle(1), Ego()
WAIT, LEFT = Measure("waiting-time", US, 20.0, value=3.0), Measure("time-to-go", US, 20.0, value=90.0)  # fmt: skip  # noqa: E501
FASTER = Compares(Measured("speed"), "more", Quantity(10.0, "m/s"))


def moving(*fast: tuple[float, float], span: Any = None, now: float = 20.0) -> Any:
    """A ride in which we drive faster than 10 m/s from when to when [s]."""
    speed = {("speed", 0): lambda t: 12.0 if any(a <= t <= b for a, b in fast) else 8.0}
    return scene(span, values=speed, now=now)


@pytest.mark.parametrize(
    ("fast", "begin", "end", "since"),
    [
        (((14.0, 20.0),), 14.0, None, False),
        (((0.0, 20.0),), 0.0, None, True),
        (((0.5, 20.0),), 0.5, None, False),
        (((5.0, 9.0),), 5.0, 9.0, False),
        (((5.0, 9.0), (12.0, 14.0)), 12.0, 14.0, False),  # the last time
        (((5.0, 9.0), (10.5, 14.0)), 5.0, 14.0, False),  # hardly interrupted
        (((5.0, 9.0), (11.5, 14.0)), 11.5, 14.0, False),
        (((5.0, 18.5),), 5.0, None, False),
        (((5.0, 18.0),), 5.0, 18.0, False),
    ],
)
def test_a_state_lasted_from_when_to_when(
    fast: Any, begin: float, end: float | None, since: bool
) -> None:
    found = lasting.state_lasting(FASTER, moving(*fast))
    assert found == Lasted(FASTER, begin, end, 20.0, since)


def test_a_state_that_never_held_is_denied() -> None:
    found = lasting.state_lasting(FASTER, moving())
    assert isinstance(found, Verdict)
    assert found.holds is False


def test_it_is_looked_for_within_two_minutes() -> None:
    found = lasting.state_lasting(FASTER, moving((1.0, 200.0), now=200.0))
    assert isinstance(found, Lasted)
    assert (found.begin, found.end) == (80.0, None)


def test_of_a_time_gone_by_only_what_was_up_to_then_counts() -> None:
    fast = Is("moving", IT, tense="past", time=Between(2.0, 10.0))
    speeds = {("speed", 1): lambda t: 5.0 if 4.0 <= t <= 16.0 else 0.0}
    asked = scene(looks={1: look(1)}, values=speeds)
    found = lasting.state_lasting(fast, asked)
    assert isinstance(found, Lasted)
    assert (found.begin, found.end) == (4.0, 10.0)
    later = lasting.state_lasting(Is("moving", IT, tense="past"), asked)
    assert isinstance(later, Lasted)
    assert (later.begin, later.end) == (4.0, 16.0)
    going = scene(Span(2.0, 10.0, said=True), looks={1: look(1)}, values=speeds)
    assert lasting.state_lasting(Is("moving", IT), going) == later.__class__(
        Is("moving", IT), 4.0, 16.0, 20.0
    )


def test_an_event_lasts_as_such(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lasting, "event_lasting", lambda event, _: event)
    stop = Event("stop")
    assert result(lasting.state_lasting, Happens(stop), scene()) == stop
    assert result(lasting.how_long, HowLong(stop), scene()) == stop
    assert result(lasting.how_long, HowLong(Happens(stop)), scene()) == stop


@pytest.mark.parametrize(
    ("of", "then"),
    [
        (Is("fast", US), Is("fast", US, time=At(3.0))),
        (Not(Is("fast", US)), Not(Is("fast", US, time=At(3.0)))),
        (Exists(IT), Exists(IT, time=At(3.0))),
        (FASTER, Compares(Measured("speed", time=At(3.0)), "more", Quantity(10.0, "m/s"))),
    ],
)
def test_a_state_is_put_at_a_moment(of: Any, then: Any) -> None:
    assert lasting.at_time(of, 3.0) == then


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """How long it takes is told by stand-ins: we drive, and plan nothing."""
    for name, found in (
        ("stands", False),
        ("halted", False),
        ("steps", ()),
        ("chance", None),
        ("remaining_wait", WAIT),
        ("time_to_go", LEFT),
    ):
        monkeypatch.setattr(lasting, name, lambda *_, found=found: found)
    return monkeypatch


def put(told: pytest.MonkeyPatch, name: str, found: Any) -> None:
    told.setattr(lasting, name, lambda *_: found)


def test_who_stands_stays_as_long_as_it_waits(told: Any) -> None:
    put(told, "stands", True)
    put(told, "steps", (("change-left", 25.0),))
    assert lasting.staying(scene(), IT) == Staying(IT, left=WAIT)


@pytest.mark.parametrize(
    ("steps", "off", "staying"),
    [
        ((("change-left", 25.0),), 0.9, Staying(IT, "change-left", 25.0)),
        ((("continue", 21.0), ("exit-right", 30.0)), None, Staying(IT, "exit-right", 30.0)),
        ((("continue", 21.0),), None, Staying(IT, left=LEFT)),
        ((), 0.9, Staying(IT, off=0.9)),
        ((), 0.5, Staying(IT, off=0.5)),
        ((), 0.4, Staying(IT, left=LEFT)),
    ],
)
def test_we_stay_until_we_move_out_or_it_turns_off(
    told: Any, steps: Any, off: float | None, staying: Staying
) -> None:
    put(told, "steps", steps)
    turn = (Event("turn", IT), 20.0)
    told.setattr(lasting, "chance", lambda _, *asks: off if asks == turn else None)
    assert lasting.staying(scene(), IT) == staying


FOLLOWS = (did("follow", 2.0, 19.0, object=Vehicle(2)), did("follow", 9.0, object=Vehicle(3)))


@pytest.mark.parametrize(
    ("episodes", "leader"),
    [
        (FOLLOWS, Vehicle(3)),
        ((*FOLLOWS, did("follow", 10.0, object=Vehicle(4))), Vehicle(4)),
        (FOLLOWS[:1], None),
        ((did("follow", 9.0),), None),
        ((), None),
    ],
)
def test_in_front_is_whom_we_follow_now(episodes: Any, leader: Any) -> None:
    assert lasting.in_front(scene(episodes=episodes)) == leader


BEHIND, AHEAD = Staying(IT, left=LEFT), Staying(Vehicle(3), left=LEFT)


@pytest.mark.parametrize(
    ("of", "staying"),
    [
        (Related("behind", US, IT, tense="future"), BEHIND),
        (Related("behind", US, IT, time=Next()), BEHIND),
        (Related("ahead-of", IT, US, tense="future"), BEHIND),
        (Related("ahead-of", US, IT, tense="future"), None),
        (Related("behind", IT, US, tense="future"), None),
        (Related("left-of", US, IT, tense="future"), None),
        (Related("behind", US, IT), None),
        (Event("follow", object=IT, tense="future"), BEHIND),
        (Event("follow", object=IT, tense="present"), BEHIND),
        (Event("follow", object=IT, tense="present", time=Now()), BEHIND),
        (Event("follow", object=IT, tense="present", time=WholeRide()), None),
        (Event("follow", tense="present"), AHEAD),
        (Event("follow", object=IT, tense="present", manner=("already",)), None),
        (Event("follow", object=IT), None),
        (Event("follow", IT, Vehicle(2), tense="present"), None),
        (Event("stand", tense="future"), AHEAD),
        (Event("wait", tense="present"), AHEAD),
        (Event("brake", tense="future"), None),
    ],
)
def test_how_long_we_go_on_behind_somebody_is_of_what_comes(
    told: Any, of: Any, staying: Any
) -> None:
    told.setattr(lasting, "event_lasting", lambda *_: None)
    told.setattr(lasting, "state_lasting", lambda *_: None)
    asked = scene(episodes=FOLLOWS[1:], traces=(decision(1.0),))
    assert lasting.how_long(HowLong(of), asked) == staying


def test_who_halts_already_is_not_asked_how_long_he_follows(told: Any) -> None:
    told.setattr(lasting, "event_lasting", lambda event, _: event)
    put(told, "halted", True)
    asked, stand = scene(episodes=FOLLOWS[1:]), Event("stand", tense="future")
    assert result(lasting.how_long, HowLong(stand), asked) == stand
    follow = Event("follow", tense="future")
    assert result(lasting.how_long, HowLong(follow), asked) == AHEAD
    assert result(lasting.how_long, HowLong(follow), scene()) == follow


@pytest.mark.parametrize(
    ("of", "state"),
    [
        (Event("follow", object=IT, time=At(3.0)), Related("behind", US, IT, At(3.0), "past")),
        (Event("follow", IT, US), Related("behind", IT, US, tense="past")),
        (Event("see", object=IT), Is("visible", IT, tense="past")),
        (Event("see", object=IT, time=At(3.0)), Is("visible", IT, time=At(3.0), tense="past")),
        (Has("lane", "left", US), Has("lane", "left", US)),
        (Event("follow"), None),
        (Event("see", IT, US), None),
        (Event("see"), None),
        (Event("brake", object=IT), None),
    ],
)
def test_following_and_seeing_are_states(told: Any, of: Any, state: Any) -> None:
    told.setattr(lasting, "event_lasting", lambda *_: None)
    told.setattr(lasting, "state_lasting", lambda of, _: of)
    assert lasting.how_long(HowLong(of), scene()) == state


def test_how_long_somebody_is_there_is_how_long_it_stands_there() -> None:
    there = HowLong(Is("present", IT, tense="perfect"))
    stood = Episode(IT, "stop", 15.0)
    found = result(lasting.how_long, there, scene(episodes=(stood,), looks={1: look(1)}))
    assert isinstance(found, Happenings)
    assert found.episodes == (stood,)
    gone = replace(stood, end=17.0)
    found = result(lasting.how_long, there, scene(episodes=(gone,), looks={1: look(1)}))
    assert not isinstance(found, Happenings)
