"""Whether we arrived, collided, or blocked a junction; asked at 20 s of a ride."""

from typing import Any

import pytest

from planner.record.events import Event as Recorded
from planner.record.places import RoadFacts
from tests.explain.answers.stated import (
    decision,
    did,
    look,
    place,
    result,
    roads,
    scene,
    they,
)
from xavi_dialogue.domain.answers import Closeness, Course
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Ego,
    Event,
    Happens,
    Vehicle,
)
from xavi_dialogue.explain.answers.events import arriving
from xavi_dialogue.explain.answers.events import happens as room
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.causes.vehicles.course import Expected

IT, US = Vehicle(1), Ego()
SEEN = {1: look(1), 2: look(2)}
SAID = Span(4.0, 6.0, said=True)


def weighed(event: Event, span: Span | None = None, **more: Any) -> Any:
    return result(room.happens, Happens(event), scene(span, **({"looks": SEEN} | more)))


def arrives(tense: Any, share: float | None, monkeypatch: pytest.MonkeyPatch, **more: Any) -> Any:
    found = None if share is None else Expected(share, 24.0, 22.0, 26.0)
    monkeypatch.setattr(arriving, "foreseen", lambda *_: found)
    to_go = tuple(
        Measure(name, US, 20.0, value=more.pop(name))
        for name in ("distance-to-go", "time-to-go")
        if name in more
    )
    monkeypatch.setattr(arriving, "to_go", lambda *_: to_go)
    return weighed(Event("arrive", tense=tense), **more), to_go


@pytest.mark.parametrize(("share", "holds"), [(None, True), (0.6, True), (0.5, True), (0.4, False)])
def test_we_shall_be_there_unless_the_plan_fails(
    monkeypatch: pytest.MonkeyPatch, share: Any, holds: bool
) -> None:
    found, far = arrives("future", share, monkeypatch, **{"distance-to-go": 300.0})
    assert found == Finding(holds, far)


@pytest.mark.parametrize(
    ("left", "soon", "nearly"),
    [
        (100.0, 9.0, True),
        (150.0, 10.0, True),
        (151.0, 9.0, False),
        (100.0, 10.5, False),
        (None, 9.0, True),
        (100.0, None, False),
    ],
)
def test_we_are_nearly_there(
    monkeypatch: pytest.MonkeyPatch, left: Any, soon: Any, nearly: bool
) -> None:
    known = {"distance-to-go": left, "time-to-go": soon}
    found, far = arrives(
        "perfect", 0.9, monkeypatch, **{k: v for k, v in known.items() if v is not None}
    )
    if nearly:
        assert found == Finding(None, far, answer=Course("nearly", (), left=left, soon=soon))
    else:
        assert found == Finding(False, far)


def test_we_are_there(monkeypatch: pytest.MonkeyPatch) -> None:
    there = (Recorded("action-started", 3.0, "continue", 3), Recorded("arrived", 19.0))
    for tense in ("perfect", "future"):
        found, _ = arrives(tense, 0.1, monkeypatch, events=there)
        assert (found.holds, [(f.action, f.begin, f.end) for f in found.facts]) == (
            True,
            [("arrive", 19.0, 19.0)],
        )


NEAR = Measure("distance", US, 6.0, value=0.8, to=IT)


@pytest.fixture
def close(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """How near somebody came is told by what it was asked of; the risk is as a test says."""
    known: dict[str, Any] = {"risk": None, "closest": NEAR}

    def near(_: Any, vehicle: Any, about: Window, how: Any, *, past: bool) -> Closeness:
        known["asked"] = (vehicle, about.begin, about.end, how, past)
        return Closeness(vehicle, known["closest"], past=past)

    monkeypatch.setattr(room, "closeness", near)
    monkeypatch.setattr(room, "collision_chance", lambda _, at, vehicle: known["risk"])
    return known


def test_a_collision_is_an_event(close: Any) -> None:
    crash = did("collide", 8.0, 8.0, object=IT)
    for event in (Event("collide", object=IT), Event("collide")):
        assert weighed(event, episodes=(crash,)) == Finding(True, (crash,))
    near = weighed(Event("nearly-collide", object=IT), episodes=(crash,))
    assert (near.holds, near.answer) == (None, Closeness(1, NEAR))


@pytest.mark.parametrize(
    ("event", "risk", "holds", "asked"),
    [
        (Event("collide", object=IT), None, False, (1, 0.0, 20.0, "hit", True)),
        (Event("collide", IT, US), 0.9, False, (1, 0.0, 20.0, "hit", True)),
        (Event("nearly-collide"), None, None, (None, 0.0, 20.0, "hit", True)),
        (Event("collide", object=IT, tense="present"), 0.5, True, (1, 20.0, 20.0, "hit", False)),
        (Event("collide", object=IT, tense="future"), 0.4, False, (1, 20.0, 20.0, "hit", False)),
        (Event("nearly-collide", tense="future"), 0.9, True, (None, 20.0, 20.0, "hit", False)),
        (Event("nearly-collide", tense="future"), None, None, (None, 20.0, 20.0, "hit", False)),
        (Event("collide", time=At(5.0)), None, False, (None, 5.0, 5.0, "hit", True)),
    ],
)
def test_else_it_is_told_how_near_it_was_and_the_risk(
    close: Any, event: Event, risk: Any, holds: Any, asked: Any
) -> None:
    close["risk"] = risk
    found = weighed(event)
    ahead = not asked[-1]
    assert close["asked"] == asked
    assert (found.holds, found.facts) == (holds, (NEAR,))
    assert found.probability == (risk if ahead else None)
    assert (found.answer is None) is (event.action == "collide" and not ahead)
    close["closest"] = None
    assert weighed(event).facts == ()


def test_two_others_may_collide(close: Any) -> None:
    crash = they(1, "collide", 8.0, 8.0, object=Vehicle(2))
    found = weighed(Event("collide", IT, Vehicle(2)), episodes=(crash,))
    assert found == Finding(True, (crash,))
    assert "asked" not in close


HALT = did("stop", 5.0, 9.0, standing=True)


@pytest.mark.parametrize(
    ("episode", "event", "inside", "holds"),
    [
        (HALT, Event("block"), (9.0, 9.0), True),
        (HALT, Event("block"), (20.0, 20.0), False),
        (HALT, Event("block", time=Between(0.0, 3.0)), (9.0, 9.0), False),
        (HALT, Event("block", time=At(3.6)), (9.0, 9.0), True),
        (HALT, Event("block", tense="present"), (9.0, 9.0), False),
        (did("stop", 5.0, 9.0), Event("block"), (9.0, 9.0), False),
        (did("stand", 5.0, standing=True), Event("block", tense="present"), (20.0, 20.0), True),
        (did("stand", 5.0, standing=True), Event("block"), (5.0, 19.0), False),
        (they(1, "stop", 5.0, 9.0, standing=True), Event("block"), (9.0, 9.0), False),
    ],
)
def test_who_stood_inside_a_junction_blocked_it(
    episode: Any, event: Event, inside: Any, holds: bool
) -> None:
    def road(time: float) -> RoadFacts:
        return roads(places={0: place(in_junction=inside[0] <= time <= inside[1])})

    traces = (decision(1.0, road=roads()),)
    found = weighed(event, episodes=(episode,), road=road, traces=traces)
    assert found == Finding(holds, (episode,) if holds else ())


def test_without_a_road_it_cannot_be_told_who_blocked() -> None:
    found = weighed(Event("block"), episodes=(HALT, did("stop", 12.0, 13.0, standing=True)))
    assert (found.holds, found.gap, [f.begin for f in found.facts]) == (
        None,
        "not-recorded",
        [12.0],
    )
    known = (decision(1.0), decision(2.0, road=roads()))
    assert weighed(Event("block"), episodes=(HALT,), traces=known) == Finding(False)
    off = roads(places={1: place(in_junction=True)})
    assert weighed(Event("block"), episodes=(HALT,), traces=known, road=off) == Finding(False)
