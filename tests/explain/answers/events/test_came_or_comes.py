"""Whether an event goes on, is about to come, or will come; asked at 20 s of a ride."""

from typing import Any

import pytest

from planner.record.events import Event as Told
from tests.explain.answers.stated import belief, did, look, result, scene, they
from xavi_dialogue.domain.answers import Bound, NoSuchVehicle, Verdict
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import (
    At,
    Ego,
    Event,
    Everyone,
    Exit,
    Happens,
    Junction,
    Next,
    Now,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.explain.answers.events import happens as room
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.causes.vehicles.course import Expected

IT, US = Vehicle(1), Ego()
SEEN = {1: look(1), 2: look(2)}
SAID = Span(4.0, 6.0, said=True)
LATER = Expected(0.8, 24.0, 22.0, 26.0)


class Plans:
    """What others tell, in a test: what is foreseen of us, and how likely others do something."""

    def __init__(self) -> None:
        self.plan: dict[str, Expected] = {}
        self.chance: float | None = None


@pytest.fixture
def told(monkeypatch: pytest.MonkeyPatch) -> Plans:
    known = Plans()
    monkeypatch.setattr(room, "foreseen", lambda _, event: known.plan.get(event.action))
    monkeypatch.setattr(room, "chance", lambda *_: known.chance)
    monkeypatch.setattr(room, "likeliest", lambda _, event: Finding(None, gap="hidden"))
    return known


def weighed(event: Event, span: Span | None = None, **more: Any) -> Any:
    return result(room.happens, Happens(event), scene(span, **({"looks": SEEN} | more)))


# Who is asked -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "by"),
    [
        (Event("see", IT), "sees"),
        (Event("arrive"), "arrived"),
        (Event("block"), "_blocks"),
        (Event("collide", IT, US), "_collides"),
        (Event("nearly-collide"), "_collides"),
        (Event("come", IT, tense="present"), "comes"),
        (Event("come", IT), "_has_been"),
        (Event("arrive", IT), "_has_been"),
        (Event("block", object=IT), "_has_been"),
        (Event("block", IT, US), "_has_been"),
        (Event("u-turn", IT), "_has_been"),
        (Event("honk"), "_has_been"),
        (Event("stop", tense="future"), "_to_come"),
        (Event("stop", tense="present"), "_has_been"),
        (Event("stop", time=Next(), tense="present"), "_to_come"),
        (Event("keep-lane", time=WholeRide(), tense="present"), "_to_come"),
        (Event("continue", time=WholeRide(), tense="present"), "_to_come"),
        (Event("keep-lane", IT, time=WholeRide(), tense="present"), "_has_been"),
        (Event("keep-lane", time=WholeRide()), "_has_been"),
        (Event("stop", time=WholeRide(), tense="present"), "_has_been"),
    ],
)
def test_each_event_is_weighed_by_its_kind(
    monkeypatch: pytest.MonkeyPatch, event: Event, by: str
) -> None:
    for name in ("sees", "arrived", "_blocks", "_collides", "comes", "_has_been", "_to_come"):
        monkeypatch.setattr(room, name, lambda *_, name=name: name)
    assert weighed(event) == by


def test_who_was_never_seen_or_cannot_be_heard() -> None:
    assert isinstance(weighed(Event("stop", Vehicle(9))), NoSuchVehicle)
    assert weighed(Event("honk", IT)) == Finding(None, gap="not-sensed")


def test_who_does_not_come_yet_may_have_come(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "comes", lambda *_: None)
    came = they(1, "come", 18.0)
    found = weighed(Event("come", IT, tense="present"), episodes=(came,))
    assert (found.holds, found.facts) == (True, (came,))


# What is meant to be done -----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "chance", "asked", "intended"),
    [
        (Event("change-left", tense="present"), None, {}, True),
        (Event("keep-lane", tense="present", time=Now()), None, {}, True),
        (Event("change-left", tense="present", time=At(3.0)), None, {}, False),
        (Event("change-left"), None, {}, False),
        (Event("change-left", tense="present"), None, {"span": SAID}, False),
        (Event("change-left", tense="present"), None, {"on": did("change-left", 19.0)}, False),
        (Event("turn", tense="present"), 0.5, {}, False),
        (Event("turn", IT, tense="present"), 0.5, {}, True),
        (Event("turn", IT, tense="present"), None, {}, False),
        (Event("turn", IT, tense="present"), 0.5, {"span": SAID}, False),
        (Event("turn", IT, tense="present"), 0.5, {"on": they(1, "exit-left", 19.0)}, False),
        (Event("pull-out", IT, tense="present"), 0.5, {}, True),
        (Event("let-go", IT, tense="present"), 0.5, {}, True),
        (Event("brake", IT, tense="present"), 0.5, {}, False),
        (Event("change-left", IT, tense="present"), 0.5, {}, True),
        (Event("turn", Everyone(), tense="present"), 0.5, {}, False),
    ],
)
def test_what_is_not_begun_may_be_meant(
    told: Plans, event: Event, chance: Any, asked: Any, intended: bool
) -> None:
    told.chance = chance
    episodes = (asked["on"],) if "on" in asked else ()
    setting = scene(asked.get("span"), looks=SEEN, episodes=episodes)
    assert room._intended(setting, event) is intended


# What is to come of us --------------------------------------------------------------------------


def begins(found: Expected) -> Measure:
    return Measure("time", US, 20.0, value=found.moment, low=found.low, high=found.high)


@pytest.mark.parametrize(
    ("event", "plan", "on", "finding"),
    [
        (Event("stop"), {"stop": LATER}, None, Finding(True, (begins(LATER),), probability=0.8)),
        (Event("stop"), {}, None, Finding(False, probability=0.0)),
        (
            Event("stop"),
            {},
            "stop",
            Finding(
                True,
                (did("stop", 19.0),),
                probability=0.0,
                answer=Verdict(Happens(Event("stop", tense="present")), True, (did("stop", 19.0),)),
            ),
        ),
        (
            Event("stop"),
            {"stop": LATER},
            "stop",
            Finding(True, (did("stop", 19.0), begins(LATER)), probability=0.8),
        ),
        (
            Event("change-left"),
            {"change-left": LATER},
            "change-left",
            Finding(True, (did("change-left", 19.0),)),
        ),
        (Event("keep-lane"), {}, None, Finding(True, probability=1.0)),
        (Event("keep-lane"), {"change-left": LATER}, None, Finding(False, probability=0.2)),
        (
            Event("follow"),
            {"change-left": Expected(0.3, 24.0, 22.0, 26.0), "change-right": LATER},
            None,
            Finding(False, probability=0.2),
        ),
        (Event("continue"), {"change-right": LATER}, None, Finding(False, probability=0.2)),
        (
            Event("continue"),
            {"continue": LATER},
            None,
            Finding(True, (begins(LATER),), probability=0.8),
        ),
    ],
)
def test_what_we_shall_do_is_told_by_the_plan(
    told: Plans, event: Event, plan: Any, on: Any, finding: Finding
) -> None:
    told.plan = plan
    found = room._to_come(scene(episodes=() if on is None else (did(on, 19.0),)), event)
    assert found.probability == pytest.approx(finding.probability)
    assert (found.holds, found.facts) == (finding.holds, finding.facts)


@pytest.mark.parametrize("over", [{"events": (Told("arrived", 19.0),)}, {"ended": True}])
def test_nothing_comes_after_the_ride(told: Plans, over: Any) -> None:
    told.plan["stop"] = LATER
    assert room._to_come(scene(**over), Event("stop")) == Finding(False)


def test_whom_we_reach_is_told_by_the_speeds(told: Plans) -> None:
    asked = scene(looks=SEEN, values={("speed", 0): 12.0, ("speed", 1): 10.0})
    assert room._to_come(asked, Event("pass", object=IT)).holds is True


@pytest.mark.parametrize(
    ("to", "number", "denied"),
    [
        (Exit(1), {"value": 2.0, "count": 4}, True),
        (Exit(2), {"value": 2.0, "count": 4}, False),
        (Exit(), {"value": 2.0, "count": 4}, False),
        (Exit(1), {"value": 2.0}, False),
        (Exit(1), {"count": 4}, False),
        (Junction("roundabout"), {"value": 2.0, "count": 4}, False),
    ],
)
def test_another_exit_is_not_taken(told: Plans, to: Any, number: Any, denied: bool) -> None:
    asked = scene(values={("exit-number", 0): number})
    found = room._to_come(asked, Event("leave", object=to))
    assert found.facts == ((Measure("exit-number", US, 20.0, **number),) if denied else ())
    assert found.holds is False


# What is to come of others ----------------------------------------------------------------------

THOUGHT = belief(1, 19.0, ("exit-left", 0.7), ("continue", 0.2), ("exit-right", 0.05))
BESIDES = belief(1, 19.0, ("continue", 0.2))
TURN = Event("exit-left", IT, tense="future")


def test_what_another_does_is_a_chance(told: Plans) -> None:
    told.chance = 0.7
    found = weighed(TURN, beliefs=(THOUGHT,))
    assert (found.holds, found.probability, found.believed) == (True, 0.7, (BESIDES,))
    assert weighed(TURN).believed == ()
    going = they(1, "exit-left", 19.0)
    on = weighed(TURN, beliefs=(THOUGHT,), episodes=(going,))
    assert (on.facts, on.believed) == ((going,), (THOUGHT,))
    told.chance = 0.4
    assert weighed(TURN).holds is False


def test_of_whom_no_chance_is_known_the_belief_is_told(told: Plans) -> None:
    bound = Finding(None, (), "in-future", answer=Bound(IT, THOUGHT))
    assert weighed(TURN, beliefs=(THOUGHT,)) == bound
    assert weighed(TURN) == Finding(None, (), "in-future")
    assert weighed(TURN, beliefs=(THOUGHT,), looks={1: lambda _: None}) == bound


@pytest.mark.parametrize(
    ("seen", "lost"), [(5.0, True), (17.9, True), (18.1, False), (None, False)]
)
def test_of_who_is_lost_from_view_nothing_is_told(told: Plans, seen: Any, lost: bool) -> None:
    told.chance = 0.7
    gone = {1: look(1, in_view=False, seen=seen)}
    found = weighed(TURN, looks=gone, beliefs=(THOUGHT,))
    assert (found.gap == "out-of-view") is lost
    if lost:
        assert (found.holds, [f.vehicle for f in found.facts]) == (None, [1])
        assert found.believed == (THOUGHT,)
        assert weighed(TURN, looks=gone).believed == ()


def test_who_passes_or_stays_is_told_by_what_is_seen(told: Plans) -> None:
    told.chance = 0.1
    quick = {1: look(1, -12.0, 3.5, bearing="behind-left", speed=15.0)}
    found = weighed(Event("pass", IT, tense="future"), looks=quick, values={("speed", 0): 9.0})
    assert found.holds is True
    yields = they(1, "give-way", 12.0, object=US)
    stays = weighed(Event("wait", IT, tense="future"), episodes=(yields,))
    assert (stays.holds, stays.facts) == (True, (yields,))
    assert weighed(Event("turn", Everyone(), tense="future")).gap == "hidden"


def test_what_goes_on_is_not_denied_for_what_is_to_come() -> None:
    standing = did("stop", 18.0)
    found = weighed(Event("stand", tense="future"), episodes=(standing,))
    assert (found.holds, found.facts) == (True, (standing,))
    assert weighed(Event("stand", tense="future")).holds is False
