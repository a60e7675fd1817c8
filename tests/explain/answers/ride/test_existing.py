"""Whether there is or was anybody, or anything, of a sort."""

from typing import Any

import pytest

from tests.explain.answers.stated import US, decision, look, place, result, roads, scene, step
from xavi_dialogue.domain.answers import CannotSay, Located, Verdict
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Described,
    Destination,
    Event,
    Everyone,
    Exists,
    Exit,
    Feature,
    Junction,
    Lane,
    Nobody,
    Road,
    Unknown,
    Vehicle,
    Vehicles,
    WholeRide,
)
from xavi_dialogue.explain.answers.ride.existing import exists

ONE, TWO = Vehicle(1), Vehicle(2)
LOOKS = {1: look(1, 30.0), 2: look(2, 10.0, kind="truck")}


def there(thing: Any, span: Any = None, *, more: Any = None, **facts: Any) -> Any:
    asked = scene(span, **({"looks": LOOKS} | facts))
    return result(exists, Exists(thing, **(more or {})), asked)


def numbers(found: Any) -> list[int]:
    return [one.vehicle for one in found.facts]


def test_nobody_is_denied_with_the_nearest_there_is() -> None:
    found = there(Nobody())
    assert (found.holds, numbers(found)) == (False, [2])
    assert there(Nobody(), looks={}).holds is True
    such = Nobody(Described(kind="truck", colour="green"))
    found = there(such, looks={1: look(1, 5.0), 2: look(2, 10.0, kind="truck")})
    assert (found.holds, numbers(found)) == (False, [2])
    found = there(Nobody(Described(kind="bus")))
    assert (found.holds, found.facts) == (False, ())


FOLLOWS = Described(colour="red", doing=Event("follow", object=US))


@pytest.mark.parametrize(
    ("described", "seen", "holds"),
    [
        (FOLLOWS, look(1, -20.0), True),
        (Described(doing=Event("follow", object=US)), look(1, -20.0, colour="blue"), True),
        (FOLLOWS, look(1, -20.0, bearing="behind-left"), True),
        (FOLLOWS, look(1, -20.0, colour="blue"), False),
        (FOLLOWS, look(1, 20.0), False),
        (FOLLOWS, look(1, -20.0, oncoming=True), False),
        (Described(doing=Event("follow", object=TWO)), look(1, -20.0), False),
        (Described(doing=Event("overtake", object=US)), look(1, -20.0), False),
        (Described(colour="red"), look(1, -20.0), False),
    ],
)
def test_who_drives_behind_us_in_another_lane_follows_us_too(
    described: Any, seen: Any, holds: bool
) -> None:
    found = there(Nobody(described), looks={1: seen}, more={"time": At(5.0), "tense": "past"})
    assert (found.holds, numbers(found)) == (holds, [1])
    if holds:
        that = Exists(ONE, At(5.0), "past")
        assert found.answer == Verdict(that, True, found.facts)
    else:
        assert found.answer is None


@pytest.mark.parametrize(
    ("lane", "which", "holds"),
    [
        (0, "left", True), (0, "right", False), (0, "other", True), (0, "own", True),
        (1, "left", False), (1, "right", True), (1, "rightmost", True),
    ],
)  # fmt: skip
def test_lanes_beside_ours(lane: int, which: Any, holds: bool) -> None:
    road = roads(places={0: place(lane=lane)})
    found = there(Lane(which), road=road, values={("lane", 0): 1.0})
    assert (found.holds, [m.value for m in found.facts]) == (holds, [1.0])


def test_of_an_unknown_lane_nothing_is_told() -> None:
    one = roads(places={0: place(lane=0, lanes=1)})
    assert there(Lane("other"), road=one, values={("lane", 0): 1.0}).holds is False
    lost = {("lane", 0): {"gap": "hidden"}}
    assert there(Lane("left"), road=one, values=lost).gap == "hidden"
    for road in (None, roads(), roads(places={0: place(lane=None)})):
        found = there(Lane("left"), road=road, values={("lane", 0): 1.0})
        assert (found.holds, found.gap) == (None, "not-recorded")


def test_junctions_and_exits_ahead() -> None:
    road = roads(route=(step(80.0),))
    found = there(Junction(rank=1), road=road, traces=[decision(20.0, road=road)])
    assert (found.holds, [m.value for m in found.facts]) == (True, [80.0])
    found = there(Junction("roundabout"), road=road)
    assert (found.holds, found.facts) == (False, ())
    assert there(Junction()).gap == "not-recorded"
    for thing in (Exit(), Destination()):
        found = there(thing, values={("exit-number", 0): 2.0})
        assert (found.holds, [m.value for m in found.facts]) == (True, [2.0])
        assert there(thing).holds is False
    assert there(Feature("light")).gap == "not-recorded"
    assert there(Road()).gap == "not-recorded"
    assert isinstance(there(Unknown("gizmo")), CannotSay)


def seen_until(time: float) -> Any:
    return {1: lambda t: look(1, in_view=t <= time, seen=None if t <= time else time)}


def test_anybody_of_a_kind() -> None:
    assert (there(Everyone()).holds, numbers(there(Everyone()))) == (True, [1, 2])
    assert numbers(there(Everyone("truck"))) == [2]
    found = there(Everyone("bus"))
    assert (found.holds, found.facts, found.gap) == (False, (), None)
    for kind in ("pedestrian", "tram"):
        found = there(Everyone(kind))
        assert (found.holds, found.gap) == (None, "not-recorded")
    walker = {1: look(1, kind="pedestrian")}
    assert there(Everyone("pedestrian"), looks=walker).holds is True


def test_over_a_stretch_all_that_were_ever_seen_count() -> None:
    lost = seen_until(4.0)
    assert there(Everyone(), looks=lost).holds is False
    ever = {"time": WholeRide(), "tense": "past"}
    assert there(Everyone(), looks=lost, more=ever).holds is True
    short = {"time": Between(6.0, 7.5), "tense": "past"}
    assert there(Everyone(), looks=lost, more=short).holds is False
    longer = {"time": Between(6.0, 7.6), "tense": "past"}
    assert there(Everyone(), looks=lost, more=longer).holds is True


def test_who_is_named_is_there_while_it_is_seen() -> None:
    found = there(ONE)
    assert (found.holds, numbers(found)) == (True, [1])
    found = there(Vehicles((1, 2)))
    assert (found.holds, numbers(found)) == (True, [1, 2])
    lost = there(ONE, looks=seen_until(4.0))
    assert isinstance(lost.answer, Located)
    assert (lost.holds, lost.answer.thing, lost.answer.gap) == (None, ONE, "out-of-view")
    then = {"time": At(9.0), "tense": "past"}
    found = there(ONE, looks=seen_until(4.0), more=then)
    assert (found.holds, found.answer) == (False, None)
    assert there(ONE, looks=seen_until(12.0), more=then).holds is True
    one_of = there(Vehicles((1, 2)), looks=seen_until(4.0) | {2: look(2)})
    assert (one_of.holds, one_of.answer) == (True, None)
    assert there(US).gap == "not-recorded"


def test_who_came_later_was_not_there_yet() -> None:
    late = {1: lambda t: look(1, in_view=True) if t >= 12.0 else None}

    def timed(t: float) -> Any:
        found = late[1](t)
        return None if found is None else type(found)(**{**_fields(found), "time": t})

    traces = [decision(3.0), decision(12.0)]
    then = {"time": At(9.0), "tense": "past"}
    found = there(ONE, looks={1: timed}, traces=traces, more=then)
    assert (found.holds, numbers(found), found.facts[0].time) == (False, [1], 12.0)
    assert there(ONE, Span(13.0, 13.0, said=True), looks={1: timed}, traces=traces).holds is True


def _fields(found: Any) -> dict[str, Any]:
    return {name: getattr(found, name) for name in found.__struct_fields__}
