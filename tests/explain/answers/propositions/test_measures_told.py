"""How much something is or was: values, extremes and ranges; asked at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.stated import look, result, scene
from xavi_dialogue.domain.answers import (
    CannotSay,
    DidNotHappen,
    Measures,
    NoSuchVehicle,
    NotRecorded,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Compare, HowMuch
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Destination,
    Ego,
    Event,
    Everyone,
    Junction,
    Lane,
    Measured,
    Nobody,
    Relative,
    Unknown,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.propositions import measures as room

IT, OTHER, US = Vehicle(1), Vehicle(2), Ego()
SEEN = {1: look(1, 30.0), 2: look(2, 50.0)}
LOST = {1: look(1, in_view=False, seen=12.0)}
HIDDEN: dict[str, Any] = {"gap": "hidden"}
NO_VALUE: dict[str, Any] = {"gap": "not-applicable"}


def setting(span: Span | None = None, *, on_our_way: Any = (1, 2), **more: Any) -> Any:
    """A ride beside two vehicles, both ahead of us on our way unless a test says otherwise."""
    asked = scene(span, **({"looks": SEEN} | more))
    known = asked.world.extreme

    def extreme(attribute: Any, thing: Any, which: Any, begin: float, end: float, to: Any) -> Measure:  # fmt: skip  # noqa: E501
        if which != "mean":
            return known(attribute, thing, which, begin, end, to)
        value = asked.world.measure(attribute, thing, (begin + end) / 2.0, to).value
        return Measure(attribute, thing, end, value=value, to=to, extreme="mean")

    asked.world.extreme = extreme  # type: ignore[method-assign, assignment]
    asked.world.relation = (  # type: ignore[method-assign]
        lambda relation, thing, to, at: thing.number in on_our_way  # type: ignore[union-attr]
    )
    return asked


def much(of: Measured, extreme: Any = None, span: Span | None = None, **more: Any) -> Any:
    return result(room.how_much, HowMuch(of, extreme), setting(span, **more))


def brief(found: Any) -> list[Any]:
    """Each measure as its attribute, things, time and value."""
    assert isinstance(found, Measures), found
    return [(m.attribute, m.thing, m.to, m.time, m.value) for m in found.measures]


# Of whom it is asked ----------------------------------------------------------------------------


def test_what_has_no_sense_is_refused() -> None:
    moon = CannotSay("perception", "the moon")
    assert much(Measured("speed", Unknown("the moon"))) == moon
    assert much(Measured("distance", US, Unknown("the moon"))) == moon
    gone = NotRecorded("not-applicable", thing=Nobody(), about="speed")
    assert much(Measured("speed", Nobody())) == gone
    to_nobody = much(Measured("distance", US, Nobody()))
    assert to_nobody == NotRecorded("not-applicable", thing=Nobody(), about="distance")
    assert isinstance(much(Measured("speed", Vehicle(9))), NoSuchVehicle)


def test_before_what_never_came_there_is_no_value() -> None:
    after = Relative("after", Event("overtake"))
    refused = much(Measured("speed", time=after))
    assert isinstance(refused, DidNotHappen)
    assert refused.asked == Event("overtake")
    speeds = {("speed", 0): lambda t: t}
    whole = much(Measured("speed", time=after), "highest", values=speeds)
    assert brief(whole) == [("speed", US, None, 20.0, 20.0)]
    brake = Measured("speed", time=Relative("after", Event("brake")))
    assert much(brake, "highest", values=speeds).asked == Event("brake")


def test_others_answer_some_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "rivals", lambda question, _, by: (question, by))
    assert much(Measured("speed", US, IT)) == (Compare((US, IT), "speed"), True)
    monkeypatch.setattr(room, "SPECIAL", {"lane": lambda of, _: of.attribute})
    assert much(Measured("lane", US)) == "lane"


@pytest.mark.parametrize(
    ("of", "things"),
    [
        (Measured("speed"), (US,)),
        (Measured("speed", Vehicles((2, 1))), (OTHER, IT)),
        (Measured("speed", Everyone()), (IT, OTHER)),
        (Measured("speed", Lane()), (Lane(),)),
        (Measured("distance-to-go", Lane()), (US,)),
        (Measured("time-to-go", IT), (IT,)),
    ],
)
def test_each_road_user_has_its_own(of: Measured, things: Any) -> None:
    assert room.things_of(setting(), of, 20.0) == things


@pytest.mark.parametrize(
    ("of", "thing", "sides"),
    [
        (Measured("speed", IT), IT, (IT, None)),
        (Measured("distance", IT), IT, (US, IT)),
        (Measured("gap", IT, OTHER), IT, (IT, OTHER)),
        (Measured("headway"), US, (US, IT)),
        (Measured("distance", Lane()), Lane(), (US, Lane())),
        (Measured("distance-to-go"), US, (US, Destination())),
        (Measured("time-to-go"), US, (US, Destination())),
        (Measured("arrival-time"), US, (US, None)),
        (Measured("arrival-time", US, Junction()), US, (US, Junction())),
    ],
)
def test_a_measure_of_two_is_between_that_and_us(of: Measured, thing: Any, sides: Any) -> None:
    assert room.sides(setting(), of, thing, 20.0) == sides


@pytest.mark.parametrize(
    ("first", "second", "on_our_way", "ahead"),
    [
        ({}, {}, (1, 2), 1),
        ({"ahead": 60.0}, {}, (1, 2), 2),
        ({}, {}, (2,), 2),
        ({"bearing": "ahead-left"}, {}, (1, 2), 2),
        ({"oncoming": True}, {}, (1, 2), 2),
        ({"in_view": False}, {}, (1, 2), 2),
        ({"ahead": 50.0}, {}, (1, 2), 1),
        ({}, {}, (), None),
    ],
)
def test_ahead_is_the_nearest_on_our_way(first: Any, second: Any, on_our_way: Any, ahead: Any) -> None:  # fmt: skip  # noqa: E501
    known = {1: look(1, **({"ahead": 30.0} | first)), 2: look(2, **({"ahead": 50.0} | second))}
    found = room._ahead(setting(looks=known, on_our_way=on_our_way), 20.0)
    assert found == (None if ahead is None else Vehicle(ahead))


# Values -----------------------------------------------------------------------------------------


def test_a_gap_has_its_seconds_beside_it() -> None:
    values: dict[Any, Any] = {("gap", 0, 1): 25.0, ("headway", 0, 1): 2.5}
    both = [("gap", US, IT, 20.0, 25.0), ("headway", US, IT, 20.0, 2.5)]
    assert brief(much(Measured("gap"), values=values)) == both
    assert brief(much(Measured("headway"), values=values)) == both[1:]
    assert brief(much(Measured("gap"), values={("gap", 0, 1): 25.0})) == both[:1]
    assert brief(much(Measured("gap"), values=values, on_our_way=())) == [
        ("gap", US, None, 20.0, None)
    ]


def test_nobody_knows_where_others_are_bound() -> None:
    (found,) = much(Measured("time-to-go", IT), values={("time-to-go", 1): 9.0}).measures
    assert (found.thing, found.gap) == (IT, "others-thoughts")


def test_who_is_out_of_sight_is_told_as_seen_last() -> None:
    speeds = {("speed", 1): lambda t: HIDDEN if t > 12.0 else 7.0}
    found = much(Measured("speed", IT), looks=LOST, values=speeds).measures
    assert [(m.time, m.value, m.gap) for m in found] == [(20.0, None, "hidden"), (12.0, 7.0, None)]
    never = much(Measured("speed", IT), looks=LOST, values={("speed", 1): HIDDEN})
    assert [m.gap for m in never.measures] == ["hidden"]
    there = much(Measured("speed", IT), values={("speed", 1): HIDDEN})
    assert [m.gap for m in there.measures] == ["hidden"]
    away = {("distance", 0, 1): lambda t: {"gap": "out-of-view"} if t > 12.0 else 9.0}
    to_it = much(Measured("distance", US, IT), looks=LOST, values=away).measures
    assert [m.value for m in to_it] == [None, 9.0]
    plain = much(Measured("speed", IT), looks=LOST, values={("speed", 1): NO_VALUE})
    assert [m.gap for m in plain.measures] == ["not-applicable"]


@pytest.mark.parametrize(
    ("attribute", "value", "told"),
    [
        ("gap", NO_VALUE, ["distance"]),
        ("headway", NO_VALUE, ["distance"]),
        ("time-to-collision", NO_VALUE, ["time-to-collision", "distance"]),
        ("time-to-collision", None, ["distance"]),
        ("speed", NO_VALUE, ["speed"]),
    ],
)
def test_where_there_is_no_gap_the_distance_is_told(
    attribute: Any, value: Any, told: list[str]
) -> None:
    values = {(attribute, 0, 1): value, (attribute, 1): value, ("distance", 0, 1): 9.0}
    found = much(Measured(attribute, IT), values=values).measures
    assert [m.attribute for m in found] == told
    no_distance = much(Measured(attribute, IT), values={(attribute, 0, 1): value})
    assert [m.attribute for m in no_distance.measures] == [attribute]


def test_a_value_is_of_its_moment() -> None:
    speeds = {("speed", 0): lambda t: t}
    for of, span, time in (
        (Measured("speed"), None, 20.0),
        (Measured("speed", time=At(7.0), tense="past"), None, 7.0),
        (Measured("speed"), Span(7.0, 8.0, said=True), 7.5),
        (Measured("limit", tense="past", time=Between(4.0, 8.0)), None, 6.0),
        (Measured("speed", tense="future"), None, 20.0),
    ):
        found = much(of, None, span, values=speeds | {("limit", 0): lambda t: t})
        assert [m[3:] for m in brief(found)] == [(time, time)]


def test_a_stretch_has_a_range_and_a_mean() -> None:
    speeds = {("speed", 0): lambda t: t}
    past = Measured("speed", tense="past", time=Between(4.0, 8.0))
    (found,) = much(past, values=speeds).measures
    assert (found.low, found.value, found.high) == (4.0, 6.0, 8.0)
    assert (found.time, found.until, found.extreme) == (4.0, 8.0, "mean")
    (late,) = much(Measured("speed", tense="past"), None, Span(4.0, 14.5), values=speeds).measures
    assert (late.low, late.high, late.until) == (4.0, 20.0, 20.0)  # up to now, as nothing was said
    said = Span(4.0, 14.5, said=True)
    (upto,) = much(Measured("speed", tense="past"), None, said, values=speeds).measures
    assert upto.high == 14.5
    (early,) = much(Measured("speed", tense="past"), None, Span(4.0, 13.5), values=speeds).measures
    assert early.high == 13.5
    (none,) = much(past).measures
    assert (none.gap, none.value) == ("not-recorded", None)


def test_a_stretch_has_the_hardest_braking_and_the_least_distance() -> None:
    values = {("deceleration", 0): lambda t: t, ("distance", 0, 1): lambda t: 50.0 - t}
    stretch = Between(4.0, 8.0)
    hard = much(Measured("deceleration", tense="past", time=stretch), values=values)
    assert brief(hard) == [("deceleration", US, None, 8.0, 8.0)]
    near = much(Measured("distance", IT, tense="past", time=stretch), values=values)
    assert brief(near) == [("distance", US, IT, 8.0, 42.0)]


def test_a_distance_of_whom_we_no_longer_see_is_the_least_there_was() -> None:
    def away(time: float) -> Any:
        return 30.0 - time if time <= 8.0 else HIDDEN

    of = Measured("distance", IT, tense="past")
    known: Any = {"looks": LOST, "values": {("distance", 0, 1): away}}
    assert brief(much(of, **known)) == [("distance", US, IT, 8.0, 22.0)]
    at = much(Measured("distance", IT, tense="past", time=At(15.0)), **known)
    assert brief(at) == [("distance", US, IT, 8.0, 22.0)]
    said = much(of, None, Span(15.0, 15.0, said=True), **known)
    assert [m.value for m in said.measures] == [None]
    now = much(Measured("distance", IT), **known)
    assert [m.value for m in now.measures] == [None]
    never = much(of, looks=LOST, values={("distance", 0, 1): HIDDEN})
    assert [m.gap for m in never.measures] == ["hidden"]
