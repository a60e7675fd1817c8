"""Who a thing is, and of whom something holds or held; asked at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.stated import did, look, result, scene, they
from xavi_dialogue.domain.answers import (
    CannotSay,
    DidNotHappen,
    Identified,
    Located,
    NoSuchVehicle,
    Priority,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Identify, Which
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Described,
    Destination,
    Ego,
    Event,
    Everyone,
    Happens,
    Lane,
    Nobody,
    Passenger,
    Unknown,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.explain.answers.propositions import identify as room
from xavi_dialogue.explain.answers.reference.findings import Finding

IT, OTHER, US, WHO = Vehicle(1), Vehicle(2), Ego(), Wanted()
SEEN = {1: look(1), 2: look(2, 40.0, kind="truck"), 3: look(3, -15.0, colour="blue")}
SAID = Span(4.0, 6.0, said=True)


def numbers(found: Any) -> list[int]:
    return [one.vehicle for one in found.looks]


def which(such: Any, thing: Any = WHO, span: Span | None = None, among: Any = (), **more: Any) -> Any:  # fmt: skip  # noqa: E501
    such = Happens(such) if isinstance(such, Event) else such
    return result(room.which, Which(thing, such, among), scene(span, **({"looks": SEEN} | more)))


# Who it is --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("thing", "found"),
    [
        (Vehicle(2), [2]),
        (Vehicles((3, 1)), [3, 1]),
        (Everyone(), [1, 2, 3]),
        (Everyone("truck"), [2]),
        (Everyone("bus"), []),
        (Nobody(), []),
    ],
)
def test_a_thing_is_who_it_names(thing: Any, found: list[int]) -> None:
    told = result(room.identify, Identify(thing), scene(looks=SEEN))
    assert isinstance(told, Identified)
    assert (numbers(told), told.none) == (found, not found)


def test_we_are_told_by_our_speed_and_places_by_where_they_are() -> None:
    asked = scene(values={("speed", 0): 9.0})
    for thing in (US, Passenger()):
        found = result(room.identify, Identify(thing), asked)
        assert found == Identified((), facts=(Measure("speed", US, 20.0, value=9.0),))
    assert isinstance(result(room.identify, Identify(Lane()), asked), Located)
    assert isinstance(result(room.identify, Identify(Destination()), asked), Located)
    unknown = result(room.identify, Identify(Unknown("the moon")), asked)
    assert unknown == CannotSay("perception", "the moon")
    assert isinstance(result(room.identify, Identify(IT), asked), NoSuchVehicle)


def test_it_is_told_as_it_was_then() -> None:
    found = which(None, IT, SAID, values={("speed", 1): lambda t: t})
    assert [one.time for one in found.looks] == [5.0]
    assert [fact.value for fact in found.facts] == [5.0]


@pytest.mark.parametrize(
    ("episodes", "shown"),
    [
        ((they(1, "brake", 15.0),), ["brake"]),
        ((they(1, "brake", 15.0), they(1, "wait", 16.0)), ["wait"]),
        ((they(1, "follow", 15.0),), ["follow"]),
        ((they(1, "approach", 15.0),), []),
        ((they(1, "wait", 15.0, 19.6),), ["wait"]),
        ((they(1, "wait", 15.0, 19.4),), []),
        ((they(2, "wait", 15.0),), []),
        ((they(1, "wait", 20.4),), []),
    ],
)
def test_each_is_told_with_what_it_does(episodes: Any, shown: list[str]) -> None:
    found = which(None, IT, episodes=episodes)
    assert [fact.action for fact in found.facts] == shown


def test_a_change_of_speed_that_is_over_is_not_under_way() -> None:
    brakes = they(1, "brake", 15.0)
    for rate, shown in ((-2.0, (brakes,)), (-0.1, ())):
        found = which(None, IT, episodes=(brakes,), values={("acceleration", 1): rate})
        assert found.facts == shown


def test_of_many_it_is_not_told_what_each_does() -> None:
    speeds = {("speed", n): 5.0 for n in range(1, 6)}
    crowd = {n: look(n) for n in range(1, 6)}
    four = which(None, Vehicles((1, 2, 3, 4)), looks=crowd, values=speeds)
    assert len(four.facts) == 4
    five = which(None, Vehicles((1, 2, 3, 4, 5)), looks=crowd, values=speeds)
    assert (len(five.looks), five.facts) == (5, ())


# Who did ----------------------------------------------------------------------------------------

BRAKES = (they(1, "brake", 5.0, 6.0), they(2, "brake", 3.0, 4.0), they(1, "brake", 12.0, 13.0))


@pytest.mark.parametrize(
    ("event", "span", "found"),
    [
        (Event("brake", WHO), None, [2, 1]),
        (Event("brake", WHO, time=At(5.6)), None, [1]),
        (Event("brake", WHO, time=At(4.6)), None, [2, 1]),
        (Event("brake", WHO, time=Between(0.0, 4.5)), None, [2]),
        (Event("brake", WHO), Span(8.0, 9.0), [2, 1]),  # nothing then, and no time was said
        (Event("brake", WHO), Span(8.0, 9.0, said=True), []),
        (Event("brake", WHO, tense="present"), None, []),
        (Event("brake"), None, [2, 1]),  # "who braked?" with nobody in it
    ],
)
def test_who_did_is_told_by_the_time(event: Event, span: Any, found: list[int]) -> None:
    told = which(event, span=span, episodes=BRAKES)
    assert (numbers(told), told.none) == (found, not found)
    if found:
        begins = [fact.begin for fact in told.facts]
        assert begins == sorted(begins)
        assert told.such == Happens(event)


def test_who_does_so_now_has_not_stopped() -> None:
    brakes = (they(1, "brake", 5.0, 6.0), they(2, "brake", 19.0))
    told = which(Event("brake", WHO, tense="present"), episodes=brakes)
    assert numbers(told) == [2]
    then = which(Event("brake", WHO, tense="present"), span=SAID, episodes=brakes)
    assert numbers(then) == [1]


def test_whom_somebody_did_it_to_is_told_with_us_among_them() -> None:
    gave = (they(1, "give-way", 5.0, 6.0, object=OTHER), they(1, "give-way", 9.0, 9.5, object=US))
    told = which(Event("give-way", IT, WHO), episodes=gave)
    assert (numbers(told), told.facts, told.none) == ([2], gave, False)
    ours = which(Event("give-way", IT, WHO), episodes=gave[1:])
    assert (numbers(ours), ours.facts, ours.none) == ([], gave[1:], False)
    assert [one.time for one in told.looks] == [5.0]


def test_nobody_did_it_to_himself() -> None:
    alone = they(1, "give-way", 5.0, 6.0, object=IT)
    told = which(Event("give-way", WHO, WHO), episodes=(alone,))
    assert told.none


def test_who_was_there_once_counts_too() -> None:
    gone = SEEN | {2: look(2, kind="truck", in_view=False, seen=6.0)}
    told = which(Event("brake", WHO), episodes=BRAKES, looks=gone)
    assert numbers(told) == [2, 1]


@pytest.mark.parametrize(
    ("thing", "among", "found"),
    [
        (Wanted("truck"), (), [2]),
        (Described("car"), (), [1]),
        (Described(colour="red"), (), [2, 1]),
        (Described("car", colour="blue"), (), []),
        (Everyone("truck"), (), [2]),
        (Vehicle(1), (), [1]),
        (Vehicles((2,)), (), [2]),
        (WHO, (OTHER, US), [2]),
        (WHO, (Vehicles((1, 3)),), [1]),
        (Lane(), (), [2, 1]),
    ],
)
def test_only_those_asked_for_are_meant(thing: Any, among: Any, found: list[int]) -> None:
    assert numbers(which(Event("brake", WHO), thing, among=among, episodes=BRAKES)) == found


def test_we_count_where_no_kind_is_said() -> None:
    ours = did("brake", 5.0, 6.0)
    assert which(Event("brake", WHO), episodes=(ours,)).facts == (ours,)
    assert not which(Event("brake", WHO), episodes=(ours,)).none
    assert which(Event("brake", WHO), Wanted("car"), episodes=(ours,)).none
    assert which(Event("brake", WHO), Lane(), episodes=(ours,)).none


def test_a_car_may_be_anything_where_there_is_none() -> None:
    trucks = {2: look(2, kind="truck")}
    brakes = (they(2, "brake", 5.0, 6.0),)
    assert numbers(which(Event("brake", WHO), Wanted("car"), looks=trucks, episodes=brakes)) == [2]
    assert which(Event("brake", WHO), Wanted("bus"), looks=trucks, episodes=brakes).none


# Nobody did -------------------------------------------------------------------------------------


def test_what_we_did_for_nobody_is_told() -> None:
    waits, goes = did("wait", 5.0, 6.0), did("follow", 2.0, 9.0)
    told = which(Event("wait", US, WHO), episodes=(waits, goes))
    assert told == Identified((), Happens(Event("wait", US, WHO)), (waits,), none=True)
    brakes, stops = did("brake", 8.0, 9.0), did("stop", 11.0, 12.0)
    never = which(Event("overtake", US, WHO), episodes=(waits, brakes, stops, goes))
    assert never == DidNotHappen(Event("overtake"), (stops,))
    assert which(Event("overtake", US, WHO), episodes=(goes,)) == DidNotHappen(Event("overtake"))
    assert which(Event("brake", WHO, US)) == Identified((), Happens(Event("brake", WHO, US)), none=True)  # fmt: skip  # noqa: E501


def test_whom_somebody_waits_for_is_told_by_the_rule_or_why(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rule = Priority(20.0, "priority", 1, holds=True)
    owed = {"found": Finding(True, answer=rule)}
    monkeypatch.setattr(room, "weigh", lambda of, _: owed["found"])
    monkeypatch.setattr(room, "why", lambda event, _, negated: (event, negated))
    now, then = Event("wait", IT, WHO, tense="present"), Event("give-way", IT, WHO)
    assert which(now) == Priority(20.0, "priority", 1)
    assert which(then) == (Event("wait", IT), False)
    for other in (Finding(False, answer=rule), Finding(True)):
        owed["found"] = other
        assert which(now) == (Event("wait", IT, tense="present"), False)
    assert which(Event("brake", IT, WHO)) == Identified(
        (), Happens(Event("brake", IT, WHO)), none=True
    )


BESIDE: dict[str, Any] = {"ahead": -10.0, "left": 3.5, "bearing": "behind-left", "speed": 12.0}


@pytest.mark.parametrize(
    ("more", "comes"),
    [
        ({}, True),
        ({"left": 2.0}, False),
        ({"left": -3.5}, True),
        ({"ahead": 4.5}, True),
        ({"ahead": 4.6}, False),
        ({"ahead": -30.0}, True),
        ({"ahead": -30.1}, False),
        ({"speed": 10.5}, False),
        ({"speed": 10.6}, True),
        ({"speed": 5.0, "oncoming": True}, True),
        ({"bearing": "crossing-left"}, False),
    ],
)
def test_who_is_about_to_pass_us_is_told_where_nobody_did(more: Any, comes: bool) -> None:
    looks = {1: look(1, **(BESIDE | more))}
    told = which(Event("pass", WHO, US), looks=looks, values={("speed", 0): 10.0})
    assert (numbers(told), told.none) == ([1] if comes else [], not comes)


def test_the_nearest_of_them_is_told_with_what_it_does() -> None:
    looks = {1: look(1, **(BESIDE | {"ahead": -20.0})), 2: look(2, **BESIDE)}
    values = {("speed", 0): 10.0, ("speed", 2): 12.0}
    told = which(Event("overtake", WHO, US), looks=looks, values=values)
    assert (numbers(told), [fact.value for fact in told.facts]) == ([2], [12.0])
    assert which(Event("overtake", US, IT), Nobody(), looks={1: look(1)}).none
    assert which(Event("brake", WHO), looks=looks, values=values).none
