"""What a question takes for granted of how we drove, and to whom we gave way."""

from typing import Any

import pytest

from planner.record.trace import Action
from tests.explain.answers.given import NOW, Given, deed, look, plan
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.evidence import Evidence
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.explain.answers.reasons import kept, premises
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons

SAID, INFERRED = Span(NOW - 5.0, NOW - 5.0, said=True), Span(NOW - 5.0, NOW - 5.0)
STOP = Event("stop", tense="present")
GOING, HALTING = plan(NOW, "continue"), plan(NOW, "stop")


def asked(*deeds: Any, trace: Any = GOING, span: Span | None = None, **more: Any) -> Any:
    return Given(deeds=deeds, traces=(trace,), **more).asked(span)


@pytest.mark.parametrize(
    ("action", "end", "named", "trace", "stopping"),
    [
        ("slow-down", None, "stop", HALTING, True),
        ("brake", None, "stop", HALTING, True),
        ("stand", None, "stop", HALTING, False),
        ("slow-down", NOW, "stop", HALTING, False),
        ("slow-down", None, "wait", HALTING, False),
        ("slow-down", None, "stop", GOING, False),
    ],
)
def test_we_are_stopping_where_we_brake_for_it(
    action: Any, end: Any, named: Any, trace: Any, stopping: bool
) -> None:
    assert premises.is_stopping(asked(trace=trace), deed(action, 15.0, end), named) is stopping


@pytest.mark.parametrize(
    ("tense", "end", "span", "over"),
    [
        ("present", NOW - 4.1, None, True),
        ("present", NOW - 4.0, None, False),
        ("present", None, None, False),
        ("past", NOW - 9.0, None, False),
        ("present", NOW - 9.0, SAID, False),
        ("present", NOW - 9.0, INFERRED, True),
    ],
)
def test_what_ended_seconds_ago_is_not_present(tense: Any, end: Any, span: Any, over: bool) -> None:
    event = Event("stop", tense=tense)
    assert premises.is_over(asked(span=span), event, deed("stop", 5.0, end)) is over


@pytest.mark.parametrize(
    ("action", "end", "off", "left"),
    [
        ("slow-down", None, None, False),
        ("slow-down", NOW - 2.1, None, True),
        ("slow-down", NOW - 2.0, None, False),
        ("stop", NOW - 0.6, None, True),
        ("stand", NOW - 0.6, None, True),
        ("stop", NOW - 0.5, None, False),
        ("stop", NOW - 0.6, "go", False),  # we drive off from it
        ("stop", NOW - 0.6, "speed-up", False),
        ("stop", NOW - 2.1, "go", True),
        ("wait", NOW - 0.6, None, False),
    ],
)
def test_a_standstill_is_left_behind_once_we_move(
    action: Any, end: Any, off: Any, left: bool
) -> None:
    deeds = () if off is None else (deed(off, NOW - 0.5),)
    assert premises.is_left(asked(*deeds), deed(action, 5.0, end)) is left
    over = () if off is None else (deed(off, NOW - 0.5, NOW - 0.1),)
    moved = end is not None and action in ("stop", "stand") and end < NOW - 0.5
    assert premises.is_left(asked(*over), deed(action, 5.0, end)) is (left or moved)


@pytest.mark.parametrize(
    ("tense", "end", "span", "now"),
    [
        ("present", None, None, True),
        ("present", None, INFERRED, True),
        ("present", None, SAID, False),
        ("past", None, INFERRED, False),
        ("present", 18.0, INFERRED, False),
    ],
)
def test_the_moment_of_what_goes_on_is_now(tense: Any, end: Any, span: Any, now: bool) -> None:
    scene = asked(span=span)
    found = premises.asked_moment(scene, Event("stop", tense=tense), deed("stop", 5.0, end))
    assert found == (NOW if now else scene.moment)


@pytest.mark.parametrize(
    ("end", "said", "before"),
    [(NOW - 1.1, True, True), (NOW - 1.0, True, False), (NOW - 5.0, False, False)],
)
def test_a_past_moment_is_one_that_was_named(end: float, said: bool, before: bool) -> None:
    assert premises.is_before(asked(span=Span(end, end, said=said))) is before
    assert not premises.is_before(asked())


def reasons(*kinds: Any, trace: Any = HALTING) -> Reasons:
    """Reasons, each of a kind, or of a kind and a vehicle."""
    causes = tuple(
        MotionCause(*kind) if isinstance(kind, tuple) else MotionCause(kind) for kind in kinds
    )
    return Reasons(causes, None, Evidence(), trace)


@pytest.mark.parametrize(
    ("begin", "chosen", "latest", "kinds", "halts"),
    [
        (18.0, "stop", "stop", (), True),
        (NOW - 0.4, "stop", "stop", (), True),
        (NOW - 0.2, "stop", "stop", (), False),  # the decision for it came first
        (18.0, "continue", "stop", (), False),
        (18.0, "stop", "continue", (), False),
        (18.0, "stop", "exit-right", (), True),
        (18.0, "stop", "stop", ("given-up",), False),
    ],
)
def test_we_decided_to_stop_while_slowing_down(
    begin: float, chosen: Action, latest: Action, kinds: Any, halts: bool
) -> None:
    found = reasons(*kinds, trace=plan(NOW, chosen))
    scene = asked(trace=plan(NOW, latest))
    expected = NOW if halts else None
    assert premises.halted_at(scene, deed("slow-down", begin), found) == expected


@pytest.mark.parametrize(
    ("action", "trace", "speed", "given_up"),
    [
        ("slow-down", GOING, 2.6, True),
        ("slow-down", GOING, None, True),
        ("slow-down", GOING, 2.5, False),
        ("slow-down", HALTING, 5.0, False),
        ("stop", GOING, 5.0, False),
        ("stand", GOING, 5.0, False),
    ],
)
def test_a_stop_was_given_up_before_we_stood(
    action: Any, trace: Any, speed: Any, given_up: bool
) -> None:
    found = deed(action, 15.0, 18.0, speed_to=speed)
    assert premises.was_given_up(asked(trace=trace), found) is given_up


# --- to whom we gave way, and how that goes on --------------------------------------------------


@pytest.mark.parametrize("manner", ["hard", "suddenly"])
def test_how_hard_we_braked_is_told_where_it_is_asked(manner: Any) -> None:
    highest = {("deceleration", Ego(), "highest"): lambda begin, end: 10.0 * begin + end}
    scene = asked(extremes=highest)
    event = Event("brake", manner=(manner,))
    assert kept.peak(scene, event, deed("brake", 5.0, 7.0)) == 57.0
    assert kept.peak(scene, event, deed("stop", 5.0)) == 50.0 + NOW
    assert kept.peak(scene, event, deed("wait", 5.0, 7.0)) is None
    assert kept.peak(scene, Event("brake"), deed("brake", 5.0, 7.0)) is None


@pytest.fixture
def gone(monkeypatch: pytest.MonkeyPatch) -> set[int]:
    """Who has passed."""
    found: set[int] = set()
    monkeypatch.setattr(kept, "has_passed", lambda ride, vehicle, time: vehicle in found)
    return found


GAVE = (deed("give-way", 10.0, 12.0, to=1), deed("give-way", 14.0, 18.0, to=2))


def to_whom(found: Reasons) -> list[tuple[str, int | None]]:
    return [(cause.kind, cause.vehicle) for cause in found.causes]


@pytest.mark.parametrize("kind", ["limit", "plan", "starting", "turn", "picking-up"])
def test_to_whom_we_gave_way_is_the_reason_where_no_other_tells(kind: Any, gone: set[int]) -> None:
    scene = asked(*GAVE, looks={1: look(1), 2: look(2)})
    found = kept.with_yielding(scene, reasons(kind), 9.0, NOW)
    assert to_whom(found) == [("right-of-way", 2)]
    early = kept.with_yielding(scene, reasons(kind), 9.0, 13.0)
    assert to_whom(early) == [("right-of-way", 1)]
    known = reasons(kind, ("leader", 5))
    assert kept.with_yielding(scene, known, 9.0, NOW) == known
    gone.add(2)
    assert to_whom(kept.with_yielding(scene, reasons(kind), 9.0, NOW)) == [("right-of-way", 1)]
    # Of the past it does not matter that he has passed since.
    assert to_whom(kept.with_yielding(scene, reasons(kind), 9.0, 19.0)) == [("right-of-way", 2)]
    gone.add(1)
    plain = reasons(kind)
    assert kept.with_yielding(scene, plain, 9.0, NOW) == plain
    assert kept.with_yielding(asked(), plain, 9.0, NOW) == plain


def test_who_has_passed_is_no_reason_any_more(gone: set[int]) -> None:
    found = reasons(("right-of-way", 1), ("leader", 1), ("right-of-way", 2))
    gone.add(1)
    left = [("leader", 1), ("right-of-way", 2)]
    assert to_whom(kept.without_passed(asked(), STOP, found)) == left
    assert kept.without_passed(asked(), Event("stop"), found) == found
    assert kept.without_passed(asked(span=SAID), STOP, found) == found
    assert to_whom(kept.without_passed(asked(span=INFERRED), STOP, found)) == left
    only = reasons(("right-of-way", 1))
    assert kept.without_passed(asked(), STOP, only) == only  # rather him than nobody


ROWS: Any = (("give-way",), ("slow-down", "brake"), ("stand",))


def test_giving_way_that_is_over_is_the_slowing_that_goes_on() -> None:
    over, slows = deed("give-way", 10.0, 12.0, to=1), deed("slow-down", 11.0)
    stands = deed("stand", 15.0)
    assert kept.going_on(asked(over, slows), over, ROWS) == slows
    assert kept.going_on(asked(over, slows, stands), over, ROWS) == stands
    assert kept.going_on(asked(over, deed("slow-down", 11.0, 13.0)), over, ROWS) == over
    assert kept.going_on(asked(over, deed("turn", 11.0)), over, ROWS) == over
    assert kept.going_on(asked(over, slows, span=INFERRED), over, ROWS) == over
    still = deed("give-way", 10.0, to=1)
    assert kept.going_on(asked(still, slows), still, ROWS) == still
    assert kept.going_on(asked(slows, stands), slows, ROWS) == slows


def test_a_standstill_long_over_is_the_one_that_we_are_coming_to(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    speed = {"now": 0.9}
    monkeypatch.setattr(kept, "speed_at", lambda ride, time: speed["now"])
    stood, slows = deed("stop", 5.0, 9.0), deed("brake", 17.0)
    assert kept.coming_to(asked(stood, slows), stood, ROWS) == slows
    assert kept.coming_to(asked(stood, slows, span=SAID), stood, ROWS) == stood
    assert kept.coming_to(asked(stood, slows, span=INFERRED), stood, ROWS) == slows
    for other in (deed("stop", 5.0), deed("wait", 5.0, 9.0), deed("stop", 5.0, 18.0)):
        assert kept.coming_to(asked(other, slows), other, ROWS) == other
    assert kept.coming_to(asked(stood, deed("brake", 17.0, 18.0)), stood, ROWS) == stood
    speed["now"] = 1.0
    assert kept.coming_to(asked(stood, slows), stood, ROWS) == stood
