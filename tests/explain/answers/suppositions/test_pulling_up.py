"""Whether somebody stops in time: by the room behind us, by the right of way, by how it brakes."""

from types import SimpleNamespace
from typing import Any

import pytest

from tests.explain.answers.given import NOW, look
from xavi_dialogue.domain.answers import PullingUp
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.terms import Ego, Event, Next, Vehicle
from xavi_dialogue.explain.answers.suppositions import pulling_up
from xavi_dialogue.explain.causes.driving.stopping import stopping_distance

V = Vehicle(1)
BRAKES = Episode(V, "brake", 18.0, speed_from=12.0, speed_to=8.0)
MANAGES = Event("stop", V, time=Next(), tense="future", modal="can")
STOPS = Event("stop", V, time=Next(), tense="future")


class Given:
    """A world of one other vehicle."""

    begin = 0.0
    states = SimpleNamespace(offset=lambda *args: None)

    def __init__(self, **values: Any) -> None:
        self.values = {"speed": 10.0, "ours": 4.0, "distance": 14.0, "deceleration": 0.0} | values

    def look(self, vehicle: int, time: float) -> Any:
        return look(vehicle, speed=self.values["speed"])

    def measure(self, attribute: Any, thing: Any, at: float, to: Any = None) -> Measure:
        name = "ours" if attribute == "speed" and isinstance(thing, Ego) else attribute
        return Measure(attribute, thing, at, self.values[name], to=to)

    def episodes(self, actor: Any = None, actions: Any = None, **more: Any) -> tuple[Episode, ...]:
        return self.values.get("deeds", ())


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> Any:
    def ask(event: Event, *, behind: bool = False, rule: Any = None, **values: Any) -> Any:
        monkeypatch.setattr(pulling_up, "_comes_up", lambda *args: behind)
        met = None if rule is None else (NOW, rule)
        monkeypatch.setattr(pulling_up, "rule_between", lambda *args: met)
        ruled = SimpleNamespace(first=values.get("first"))
        monkeypatch.setattr(pulling_up, "priority_at", lambda *args: ruled)
        monkeypatch.setattr(pulling_up, "collision_chance", lambda *args: 0.01)
        monkeypatch.setattr(pulling_up, "chance", lambda *args: values.get("chance", 0.9))
        scene: Any = SimpleNamespace(now=NOW, past=None, span=None, world=Given(**values))
        found = pulling_up.pulls_up(scene, event)
        return None if found is None else found.answer

    return ask


def test_behind_us_it_is_the_room_to_come_down_to_our_speed(asked: Any) -> None:
    needed = stopping_distance(6.0)
    found = asked(MANAGES, behind=True, distance=needed + 0.1)
    assert isinstance(found, PullingUp)
    assert (found.how, found.needed, found.risk) == ("able", needed, 0.01)
    assert asked(MANAGES, behind=True, distance=needed - 0.1).how == "unable"
    assert asked(MANAGES, behind=True, distance=20.0, deeds=(BRAKES,)).how == "brakes"
    slower = asked(MANAGES, behind=True, speed=3.0)
    assert (slower.how, slower.needed) == ("able", 0.0)


def test_across_our_way_it_is_the_right_of_way(asked: Any) -> None:
    assert asked(STOPS, rule="give-way").how == "goes-first"
    owes = asked(STOPS, rule="priority")
    assert (owes.how, owes.chance) == ("owes", 0.9)
    assert asked(MANAGES).how == "apart"
    assert asked(STOPS, rule="priority", first=V) is None  # it has gone by


def test_who_brakes_to_a_standstill_soon_stops_whatever_the_rule(asked: Any) -> None:
    for rate, how in ((4.0, "brakes"), (3.9, "goes-first")):
        found = asked(STOPS, rule="give-way", deeds=(BRAKES,), deceleration=rate)
        assert found.how == how
    assert asked(STOPS, rule="give-way", deceleration=9.0).how == "goes-first"


def test_who_goes_first_may_brake_without_stopping_for_us(asked: Any) -> None:
    for chance, how in ((0.09, "goes-first"), (0.1, "brakes"), (None, "brakes")):
        found = asked(STOPS, rule="give-way", deeds=(BRAKES,), deceleration=9.0, chance=chance)
        assert found.how == how


def test_it_is_asked_of_who_moves_and_concerns_us(asked: Any) -> None:
    assert asked(STOPS) is None  # a vehicle that neither follows nor crosses
    assert asked(STOPS, speed=0.0) is None
    assert asked(MANAGES, speed=0.0).how == "stands"
    assert asked(Event("stop", V, tense="past")) is None
    assert asked(Event("turn", V, tense="future", time=Next())) is None
