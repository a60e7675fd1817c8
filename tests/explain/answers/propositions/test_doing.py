"""What somebody does, did or will do; asked at 20 s."""

from typing import Any

import pytest

from sim.scene import Scene, VehicleState
from tests.explain.answers.stated import (
    belief,
    did,
    driven,
    look,
    result,
    scene,
    they,
)
from xavi_dialogue.domain.answers import (
    Activity,
    Happenings,
    Identified,
    NotRecorded,
)
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.meaning import Doing, Whither
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Destination,
    Ego,
    Event,
    Next,
    Now,
    Unsaid,
    Vehicle,
    Vehicles,
    WholeRide,
)
from xavi_dialogue.explain.answers.propositions import happenings as room
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.causes.vehicles.course import Expected

IT, US = Vehicle(1), Ego()
LATER = Expected(0.8, 24.0, 22.0, 26.0)
SEEN = {1: look(1), 2: look(2)}


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    """What other modules tell is told by their names."""
    for name in ("plan_ahead", "whither", "summary", "since_when", "announced", "time_to_go"):
        monkeypatch.setattr(
            room, name, lambda *args, name=name, **more: (name, *_plain(args), *more.values())
        )
    return monkeypatch


def _plain(args: Any) -> Any:
    return [a for a in args if isinstance(a, float | int | Event | Window | Whither | Episode)]


def doing(actor: Any, tense: Any = "present", time: Any = None, span: Any = None, **more: Any) -> Any:  # fmt: skip  # noqa: E501
    question = Doing(actor, Unsaid() if time is None else time, tense)
    return result(room.doing, question, scene(span, looks=SEEN, **more))


def test_who_does_what_is_told_by_its_time(told: Any) -> None:
    assert doing(US, "future") == ("plan_ahead",)
    assert doing(US, "present", Next()) == ("plan_ahead",)
    assert doing(IT, "future") == ("whither", Whither(IT))
    assert doing(IT, "present", Next()).time == 20.0
    assert doing(IT).time == 20.0
    assert doing(IT, "past", At(3.0)).time == 3.0
    assert isinstance(doing(IT, "past"), Happenings)
    assert isinstance(doing(IT, "perfect"), Happenings)
    assert isinstance(doing(IT, "present", Between(2.0, 9.0)), Activity)
    assert doing(Destination()) == NotRecorded("not-recorded", Destination(), about="doing")


def test_what_goes_on_is_of_us_and_what_happened_of_everybody(told: Any) -> None:
    now = doing(None)
    assert isinstance(now, Activity)
    assert (now.actor, now.time) == (US, 20.0)
    assert doing(None, "past") == ("summary", Window(0.0, 20.0), False)
    assert doing(None, "past", WholeRide()) == ("summary", Window(0.0, 20.0, True), True)
    assert doing(None, "present", At(9.0)) == ("summary", Window(9.0, 9.0, True), False)
    assert isinstance(doing(None, "present", Now()), Activity)


def test_an_indicator_tells_what_somebody_is_up_to(told: Any) -> None:
    left = they(1, "signal", 15.0, side="left")
    assert doing(IT, "future", episodes=(left,)) == ("announced", 1, left, 20.0)
    later = they(1, "signal", 17.0, side="right")
    assert doing(IT, "future", episodes=(left, later)) == ("announced", 1, later, 20.0)
    for none in (they(1, "signal", 15.0, 18.0), they(1, "signal", 21.0), they(2, "signal", 9.0)):
        assert doing(IT, "future", episodes=(none,)) == ("whither", Whither(IT))


@pytest.mark.parametrize(
    ("begin", "end", "on"),
    [
        (9.0, None, True),
        (9.0, 9.8, True),
        (9.0, 9.6, False),
        (10.1, 12.0, True),
        (10.2, 12.0, False),
    ],
)
def test_under_way_is_what_goes_on_at_about_the_time(begin: float, end: Any, on: bool) -> None:
    stop = did("stop", begin, end)
    found = room.activity(scene(episodes=(stop,), values={("speed", 0): 7.0}), US, 10.0)
    assert found.doing == ((stop,) if on else ())
    assert (found.actor, found.time, found.speed) == (US, 10.0, 7.0)


def test_who_does_nothing_else_drives_on() -> None:
    goes = (did("continue", 2.0), they(1, "continue", 2.0))
    assert room.activity(scene(episodes=goes, looks=SEEN), US, 10.0).doing[-1:] == goes[:1]


def test_another_has_a_look_and_a_belief() -> None:
    thought, speeds = belief(1, 9.0, ("exit-left", 0.7)), {("speed", 1): 4.0}
    shown = {1: look(1), 2: look(2, in_view=False, seen=5.0)}
    episodes = (they(1, "stop", 9.0), they(2, "stop", 9.0))
    asked = scene(looks=shown, values=speeds, beliefs=(thought,), episodes=episodes)
    found = room.activity(asked, IT, 10.0)
    assert found.look is not None
    assert (found.look.vehicle, found.look.time, found.belief) == (1, 10.0, thought)
    assert (found.speed, found.doing, found.trend) == (4.0, episodes[:1], None)
    lost = room.activity(asked, Vehicle(2), 10.0)
    assert (lost.speed, lost.doing, lost.trend, lost.belief) == (None, (), None, None)


SLOWING = driven((0.0,) * 6, speed=(10.0, 10.0, 9.0, 7.0, 5.0, 3.0))
SPEEDING = driven((0.0,) * 6, speed=(3.0, 3.0, 5.0, 7.0, 9.0, 11.0))


@pytest.mark.parametrize(
    ("motion", "at", "rate", "trend"),
    [
        (SLOWING, 5.0, None, "slowing"),
        (SLOWING, 5.0, -1.0, "slowing"),
        (SLOWING, 5.0, -0.05, "steady"),
        (SLOWING, 5.0, 1.0, "steady"),
        (SLOWING, 4.0, 1.0, "slowing"),
        (SLOWING, 0.5, 1.0, "steady"),
        (SPEEDING, 5.0, 1.0, "speeding-up"),
        (SPEEDING, 5.0, 0.05, "steady"),
        (SPEEDING, 5.0, -1.0, "steady"),
    ],
)
def test_a_speed_changes_no_more_once_the_newest_scene_shows_so(
    motion: Any, at: float, rate: float | None, trend: str
) -> None:
    asked = scene(now=5.0, looks=SEEN, motions={0: motion, 1: motion})
    if rate is not None:
        state = VehicleState((0.0, 0.0), 0.0, 3.0, rate, 4.5, 1.8)
        asked.ride.__dict__["scene"] = Scene(4.5, {0: state, 1: state})
    for who in (US, IT):
        assert room.activity(asked, who, at).trend == trend


def test_what_somebody_did_is_told_in_order() -> None:
    episodes = (
        they(1, "follow", 1.0, 12.0),
        they(1, "brake", 6.0, 7.0, object=Vehicle(2)),
        they(1, "exit-left", 4.0, 5.0),
        did("stop", 6.0, 8.0),
    )
    found = doing(IT, "past", Between(3.0, 30.0), episodes=episodes)
    assert [(e.action, e.begin) for e in found.episodes] == [("exit-left", 4.0), ("brake", 6.0)]
    assert (found.form, found.actor, found.since, found.until) == ("doing", IT, 3.0, 20.0)
    assert [(x.vehicle, x.time) for x in found.looks] == [(1, 4.0), (2, 6.0)]
    ours = doing(US, "past", episodes=episodes)
    assert (ours.episodes, ours.since, ours.looks) == ((episodes[3],), 0.0, ())
    plain = doing(IT, "past", episodes=episodes[:1])
    assert plain.episodes == episodes[:1]
    nothing = doing(IT, "past", Between(3.0, 9.0))
    assert [(x.vehicle, x.time) for x in nothing.looks] == [(1, 3.0)]
    assert doing(US, "past", Between(3.0, 9.0)).looks == ()


def test_several_are_told_by_their_speeds_and_deeds() -> None:
    speeds = {("speed", 1): 4.0}
    episodes = (they(1, "stop", 9.0), they(1, "wait", 9.5), they(2, "brake", 9.0))
    found = doing(Vehicles((1, 2)), values=speeds, episodes=episodes)
    assert isinstance(found, Identified)
    assert [one.vehicle for one in found.looks] == [1, 2]
    assert found.facts == (Measure("speed", IT, 20.0, value=4.0), episodes[1], episodes[2])


@pytest.mark.parametrize(("speed", "doing"), [(5.0, ["pass", "wait"]), (0.0, ["wait"])])
def test_who_stands_drives_past_nobody(speed: float, doing: list[str]) -> None:
    deeds = (did("pass", 18.0, 20.0, object=IT), did("wait", 19.0))
    asked = scene(episodes=deeds, values={("speed", 0): speed}, looks=SEEN)
    found = room.activity(asked, US, 20.0)
    assert [one.action for one in found.doing] == doing
