"""What a sudden act of another vehicle asks of us, and whether we could stop."""

from dataclasses import replace as changed
from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.given import NOW, Given, look, plan, refused
from xavi_dialogue.domain.answers import (
    NotRecorded,
    Reaction,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import Doing, Whether
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Is,
    Lane,
    Nobody,
    Not,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.suppositions import reacting
from xavi_dialogue.explain.causes.driving.stopping import Stopping

ONE = Vehicle(1)


def can(action: Any, modal: Any = "could", **more: Any) -> Whether:
    return Whether(Happens(Event(action, modal=modal, **more)))


@pytest.mark.parametrize(
    ("then", "asks"),
    [
        (None, None),
        (Doing(), None),
        (can("collide", "would"), "collide"),
        (can("nearly-collide", None), "collide"),
        (can("collide", None, actor=ONE), "collide"),
        (can("stop"), "stop"),
        (can("brake", "can"), "stop"),
        (can("avoid"), "stop"),
        (Whether(Not(can("swerve").that)), "stop"),
        (can("turn"), None),
        (can("stop", "would"), None),
        (can("stop", "would", manner=("early",)), "stop"),
        (can("stop", actor=ONE), None),
        (Whether(Exists(Feature("space"))), "stop"),
        (Whether(Exists(Feature("queue"))), None),
        (Whether(Is("far")), "stop"),
        (Whether(Is("safe", Ego())), "stop"),
        (Whether(Is("possible", Lane("left"))), "stop"),
        (Whether(Is("roomy")), "stop"),
        (Whether(Is("far", ONE)), None),
        (Whether(Is("fast")), None),
        (Whether(Exists(ONE)), None),
        (Whether(Related("near", ONE)), None),
    ],
)
def test_stopping_in_time_and_collisions_are_recognised(then: Any, asks: Any) -> None:
    assert reacting.asks(then) == asks


def sudden(event: Event, then: Any = None, *, negated: bool = False, **track: Any) -> bool:
    trace = plan(NOW, **track)
    trace = replace(trace, history=trace.history | {1: trace.history[0]})
    asked = Given(traces=(trace,)).asked()
    return reacting.is_sudden(event, then, asked, 1, NOW, negated=negated)


def test_what_leaves_us_nothing_but_to_brake_is_sudden() -> None:
    for action in ("stop", "brake", "pull-out", "cut-in", "block", "swerve", "merge", "stand"):
        assert sudden(Event(action, ONE))
    assert not sudden(Event("turn", ONE))
    assert sudden(Event("turn", ONE), can("stop"))
    assert sudden(Event("turn", ONE, manner=("suddenly",)))
    assert sudden(Event("turn", ONE, manner=("hard",)))
    assert not sudden(Event("turn", ONE, manner=("slowly",)))


def test_not_doing_what_one_has_to_is_sudden() -> None:
    for action in ("wait", "give-way", "let-go", "stop", "brake", "see", "slow-down"):
        assert sudden(Event(action, ONE), negated=True)
    assert not sudden(Event("cut-in", ONE), negated=True)
    assert sudden(Event("cut-in", ONE), can("stop"), negated=True)


def test_setting_off_is_sudden_of_who_stands_or_slows_down() -> None:
    for action in ("go", "move", "enter", "cross"):
        assert sudden(Event(action, ONE), speed=0.0)
        assert not sudden(Event(action, ONE), speed=8.0)
    assert not sudden(Event("turn", ONE), speed=0.0)


# --- whether we could stop ----------------------------------------------------------------------

ROOM = Stopping("room", 10.0, 12.0, 30.0, 8.0)


def react(
    event: Event | None,
    patch: pytest.MonkeyPatch,
    found: Any = ROOM,
    span: Span | None = None,
    **more: Any,
) -> Any:
    """The reaction at 15 s, with what is found at each time and whether in its lane."""

    def stopping(
        states: Any, vehicle: int, time: float, *, in_lane: bool, halts: bool = False
    ) -> Any:
        assert vehicle == 1
        return found(time, in_lane) if callable(found) else found

    patch.setattr(reacting, "stopping", stopping)
    asked = Given(looks={1: look(1)}).asked(span)
    then = more.pop("then", None)
    return reacting.reaction(event, then, asked, 1, 15.0, **more)


def test_a_reaction_has_the_distances_of_its_time(monkeypatch: pytest.MonkeyPatch) -> None:
    stop = Event("stop", ONE)
    found = react(stop, monkeypatch, then=can("stop"))
    assert found == Reaction(1, "room", stop, 15.0, 10.0, 12.0, 30.0, 8.0, asked="stop")
    gone = refused(react, stop, monkeypatch, lambda time, lane: None)
    assert gone == NotRecorded("out-of-view", thing=ONE, since=15.0)
    negated = react(stop, monkeypatch, negated=True)
    assert (negated.negated, negated.kind, negated.past) == (True, "room", False)
    unknown = react(None, monkeypatch)
    assert unknown.supposed is None


def test_what_is_done_in_a_lane_is_tried_in_it(monkeypatch: pytest.MonkeyPatch) -> None:
    def kind(time: float, lane: bool) -> Stopping:
        return changed(ROOM, kind="short" if lane else "room")

    for action in ("stop", "brake", "slow-down", "stand", "speed-up"):
        assert react(Event(action, ONE), monkeypatch, kind).kind == "short"
    for action in ("cut-in", "pull-out", "turn"):
        assert react(Event(action, ONE), monkeypatch, kind).kind == "room"  # type: ignore[arg-type]
    assert react(Event("stop", ONE), monkeypatch, kind, negated=True).kind == "room"
    assert react(None, monkeypatch, kind).kind == "room"


def test_who_stops_right_in_front_of_us_is_in_our_way(monkeypatch: pytest.MonkeyPatch) -> None:
    def kind(time: float, lane: bool) -> Stopping:
        return changed(ROOM, kind="apart" if lane else "short")

    before_us = Event("stop", ONE, where=Related("ahead-of", ONE, Ego()))
    assert react(before_us, monkeypatch, kind).kind == "short"
    behind = Event("stop", ONE, where=Related("behind", ONE, Ego()))
    assert react(behind, monkeypatch, kind).kind == "apart"


def test_one_behind_us_that_does_not_brake_comes_closer(monkeypatch: pytest.MonkeyPatch) -> None:
    behind = Stopping("behind", 10.0, room=30.0, closing=3.0)
    found = react(Event("brake", ONE), monkeypatch, behind, negated=True)
    assert (found.kind, found.room, found.closing) == ("behind", 30.0, 3.0)
    assert react(Event("brake", ONE), monkeypatch, behind).closing is None


def test_who_gets_under_way_ahead_of_us_joins_us(monkeypatch: pytest.MonkeyPatch) -> None:
    for action, kind in (("go", "joins"), ("move", "joins"), ("stop", "room"), ("enter", "room")):
        assert react(Event(action, ONE), monkeypatch).kind == kind  # type: ignore[arg-type]
    beside = changed(ROOM, left=None)
    assert react(Event("go", ONE), monkeypatch, beside).kind == "room"


def test_only_what_can_be_said_is_told_to_be_supposed(monkeypatch: pytest.MonkeyPatch) -> None:
    for action in ("do", "happen"):
        assert react(Event(action, ONE), monkeypatch).supposed is None
    lane = Event("merge", ONE, Lane("own"))
    assert react(lane, monkeypatch).supposed == Event("merge", ONE)
    for thing in (Ego(), Vehicle(2)):
        cut = Event("cut-in", ONE, thing)
        assert react(cut, monkeypatch).supposed == cut


def test_of_the_past_it_is_told_of_when_there_was_least_room(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def room(time: float, lane: bool) -> Any:
        return changed(ROOM, room=abs(time - 11.5) + 20.0)

    found = react(Event("stop", ONE), monkeypatch, room, past=True)
    assert (found.time, found.past, found.room) == (11.5, True, 20.0)
    said = react(Event("stop", ONE), monkeypatch, room, Span(14.0, 16.0, said=True), past=True)
    assert said.time == 15.0
    inferred = react(Event("stop", ONE), monkeypatch, room, Span(14.0, 16.0), past=True)
    assert inferred.time == 11.5
    long_ago = react(Event("stop", ONE), monkeypatch, lambda t, lane: room(t + 11.5, lane),
                     past=True)  # fmt: skip
    assert long_ago.time == 5.0  # 15 s are looked back


def test_what_needs_more_room_counts_first(monkeypatch: pytest.MonkeyPatch) -> None:
    def needs(time: float, lane: bool) -> Any:
        return changed(ROOM, needed=40.0 if time == 9.0 else 12.0)

    assert react(Event("stop", ONE), monkeypatch, needs, past=True).time == 9.0

    def unknown(time: float, lane: bool) -> Any:
        return changed(ROOM, needed=None, room=5.0 if time == 8.0 else 30.0)

    assert react(Event("stop", ONE), monkeypatch, unknown, past=True).time == 8.0


def test_driving_ahead_of_us_counts_before_our_own_standstill(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def both(time: float, lane: bool) -> Any:
        if time == 10.0:
            return changed(ROOM, room=50.0)
        return changed(ROOM, kind="standing", left=None, room=2.0)

    assert react(Event("stop", ONE), monkeypatch, both, past=True).time == 10.0

    def first(time: float, lane: bool) -> Any:
        return ROOM if time == 10.0 else changed(ROOM, kind="first", room=29.0 + abs(time - 7.0))

    assert react(Event("stop", ONE), monkeypatch, first, past=True).time == 10.0
    assert react(Event("cut-in", ONE), monkeypatch, first, past=True).time == 7.0


def test_where_it_never_was_ahead_it_is_told_of_now(monkeypatch: pytest.MonkeyPatch) -> None:
    def beside(time: float, lane: bool) -> Any:
        room = 3.0 if time == 12.0 else 20.0
        return changed(ROOM, kind="apart" if lane else "room", left=None, room=room)

    assert react(Event("stop", ONE), monkeypatch, beside, past=True).time == NOW
    go = react(Event("go", ONE), monkeypatch, beside, past=True)
    assert (go.time, go.kind) == (12.0, "room")
    assert react(Event("cut-in", ONE), monkeypatch, beside, past=True).time == 12.0
    apart = changed(ROOM, kind="apart", room=None)
    assert react(Event("stop", ONE), monkeypatch, apart, past=True).time == NOW


@pytest.mark.parametrize(
    ("event", "somebody"),
    [
        (Event("cross", Nobody()), True),
        (Event("appear", Described("pedestrian")), True),
        (Event("stop", Described("pedestrian")), True),
        (Event("turn", Nobody()), False),
        (Event("come", Nobody()), True),
        (Event("cross", ONE), False),
        (None, False),
    ],
)
def test_somebody_who_is_not_there_may_get_in_our_way(event: Any, somebody: bool) -> None:
    assert reacting.is_somebody(event) is somebody


def test_for_anybody_it_is_told_how_far_we_need_to_stop() -> None:
    asked = Given(measures={("speed", Ego()): 10.0}).asked()
    found = reacting.for_anybody(Event("cross", Nobody(), tense="perfect"), asked)
    assert (found.vehicle, found.kind, found.speed, found.past) == (None, "anybody", 10.0, True)
    assert found.time == NOW
    assert found.needed is not None
    assert found.needed > 5.0
    still = reacting.for_anybody(Event("cross", Nobody()), Given().asked())
    assert (still.speed, still.needed, still.past) == (0.0, 0.0, False)
