"""From when to when a time reaches, and where an event at it is looked for: by hand."""

from dataclasses import replace
from typing import Any

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, did, road, talk
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.terms import (
    Ago,
    At,
    AtDecision,
    Back,
    Between,
    Destination,
    Event,
    Exit,
    Junction,
    Next,
    Now,
    Rank,
    Relative,
    Start,
    Tense,
    Time,
    Unsaid,
    Vehicle,
    WholeRide,
    Within,
)
from xavi_dialogue.nlu.grounding.context import Context, Window
from xavi_dialogue.nlu.grounding.events.spans import notable
from xavi_dialogue.nlu.grounding.events.windows import pointed, window
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

NOW, BEGIN = 40.0, 2.0
CROSS, RING = Junction("junction", time=10.0), Junction("roundabout", time=20.0)
HAPPENED = (
    did("change-left", 6.0, 8.0, side="left"),
    did("exit-left", 10.0, 12.0, side="left", place=CROSS),
    did("enter", 20.0, 20.0, place=RING),
    did("leave", 26.0, 26.0, place=RING),
    did("brake", 30.0, 32.0, whom=1),
    did("brake", 31.0, 33.0, who=2),
)


class Ride(FakeWorld):
    """A world that knows when decisions were taken."""

    def decided(self, number: int) -> float | None:
        return {3: 5.0, 4: 6.0, 60: 60.0}.get(number)


def grounder(discourse: Discourse | None = None, happened: Any = HAPPENED) -> TermGrounder:
    cars = {1: Car(20.0), 2: Car(-9.0), 3: Car(50.0, seen=(2.0, 9.0))}
    world = Ride(cars, happened, now=NOW, begin=BEGIN, facts=road("junction"))
    return TermGrounder(Context(world, discourse or Discourse()))


def found(time: Time, tense: Tense = "past", discourse: Discourse | None = None) -> Window:
    return window(time, tense, grounder(discourse))


def stretch(begin: float, end: float, search: tuple[float, float], **more: Any) -> Window:
    known: dict[str, Any] = {"term": Between(begin, end), "said": True, **more}
    return Window(begin, end, search=search, **known)


@pytest.mark.parametrize(
    ("time", "expected"),
    [
        (Now(), stretch(40.0, 40.0, (37.0, 40.0), term=Now())),
        (At(9.0), stretch(9.0, 9.0, (6.5, 11.5), term=At(9.0), prefer="nearest")),
        (At(40.4), stretch(40.4, 40.4, (37.9, 42.9), term=At(40.4), prefer="nearest")),
        (
            At(41.0),
            stretch(41.0, 41.0, (38.5, 43.5), term=At(41.0), prefer="nearest", ahead=True),
        ),
        (Ago(), stretch(35.0, 40.0, (35.0, 40.0))),
        (Ago(10.0), stretch(30.0, 30.0, (27.5, 32.5), term=At(30.0), prefer="nearest")),
        (Ago(10.0, span=True), stretch(30.0, 40.0, (30.0, 40.0), whole=True)),
        (Ago(99.0, span=True), stretch(2.0, 40.0, (2.0, 40.0), whole=True)),
        (AtDecision(3), stretch(5.0, 5.0, (2.5, 7.5), term=At(5.0), prefer="nearest")),
        (AtDecision(3, 4), stretch(5.0, 6.0, (5.0, 6.0))),
        (AtDecision(4, 99), stretch(6.0, 40.0, (6.0, 40.0))),
        (AtDecision(60), stretch(60.0, 60.0, (57.5, 62.5), term=At(60.0), prefer="nearest",
                                 ahead=True)),
        (AtDecision(99), Window(2.0, 40.0, Unsaid(), (2.0, 40.0))),
        (Within(), stretch(40.0, 55.0, (40.0, 55.0), term=Next(), ahead=True)),
        (Within(4.0), stretch(40.0, 44.0, (40.0, 44.0), term=Within(4.0), ahead=True)),
        (Next(), stretch(40.0, 55.0, (40.0, 55.0), term=Next(), ahead=True)),
        (Between(9.0, 5.0), stretch(5.0, 9.0, (5.0, 9.0), whole=True)),
        (Between(30.0, 50.0), stretch(30.0, 40.0, (30.0, 40.0), whole=True)),
        (Between(45.0, 50.0), stretch(45.0, 50.0, (45.0, 50.0), whole=True, ahead=True)),
        (Rank(2), stretch(2.0, 40.0, (2.0, 40.0), term=WholeRide(), rank=2)),
        (Start(), stretch(2.0, 10.0, (2.0, 10.0), prefer="first")),
        (WholeRide(), stretch(2.0, 40.0, (2.0, 40.0), term=WholeRide(), whole=True)),
    ],
)  # fmt: skip
def test_times(time: Time, expected: Window) -> None:
    assert found(time) == expected


@pytest.mark.parametrize(
    ("tense", "expected"),
    [
        ("present", Window(40.0, 40.0, Now(), (37.0, 40.0))),
        ("future", Window(40.0, 55.0, Next(), (40.0, 55.0), ahead=True)),
        ("perfect", Window(2.0, 40.0, WholeRide(), (2.0, 40.0))),
        ("past", Window(2.0, 40.0, Unsaid(), (2.0, 40.0))),
    ],
)
def test_a_tense_alone(tense: Tense, expected: Window) -> None:
    assert found(Unsaid(), tense) == expected


#: We braked for vehicle 1 from 30 to 32 s.
BRAKE = Event("brake", object=Vehicle(1))
BRAKE_WINDOWS: dict[str, Window] = {
    "before": stretch(22.0, 29.8, (2.0, 29.75)),
    "after": stretch(32.0, 40.0, (32.05, 40.0), prefer="first"),
    "until": stretch(2.0, 30.0, (2.0, 30.0)),
    "since": stretch(32.0, 40.0, (32.0, 40.0)),
    "during": stretch(30.0, 32.0, (27.5, 34.5)),
}


def near(one: Window, other: Window) -> None:
    assert (one.begin, one.end) == pytest.approx((other.begin, other.end))
    assert one.search == pytest.approx(other.search)
    assert (one.said, one.prefer, one.ahead) == (other.said, other.prefer, other.ahead)


@pytest.mark.parametrize("relation", BRAKE_WINDOWS)
def test_beside_a_deed(relation: Any) -> None:
    near(found(Relative(relation, BRAKE)), BRAKE_WINDOWS[relation])


def test_beside_a_deed_near_the_ends_of_the_ride() -> None:
    early = Relative("before", Event("change-left"))
    near(found(early), stretch(2.0, 5.8, (2.0, 5.75)))
    after = Relative("after", Event("change-left"))
    near(found(after), stretch(8.0, 16.0, (8.05, 40.0), prefer="first"))


def test_a_place_begins_with_the_way_to_it() -> None:
    near(found(Relative("during", Junction("junction"))), stretch(10.0, 12.0, (4.0, 14.5)))
    near(found(Relative("during", Exit())), stretch(20.0, 26.0, (14.0, 28.5)))
    near(found(Relative("after", Junction("roundabout"))),
         stretch(26.0, 34.0, (26.05, 40.0), prefer="first"))  # fmt: skip


COMING = Window(40.0, 55.0, Next(), (40.0, 55.0), said=True, ahead=True)


@pytest.mark.parametrize(
    ("time", "tense"),
    [
        (Relative("before", Destination()), "past"),
        (Relative("before", Event("turn", tense="present")), "present"),
        (Relative("until", Event("turn", tense="present")), "future"),
        (Relative("after", Event("collide", tense="future")), "future"),
        (Relative("after", Event("collide", tense="past")), "future"),
        (Relative("after", Event("collide", tense="perfect")), "past"),
        (Relative("after", Junction("roundabout", rank=1)), "future"),
    ],
)
def test_what_is_yet_to_come(time: Time, tense: Tense) -> None:
    happened = HAPPENED[:2] + HAPPENED[4:]
    assert window(time, tense, grounder(happened=happened)) == COMING


def test_what_never_happened_leaves_the_tense_alone_at_a_cost() -> None:
    g = grounder()
    assert window(Relative("after", Event("collide", tense="past")), "past", g) == Window(
        2.0, 40.0, Unsaid(), (2.0, 40.0)
    )
    assert g.notes.cost >= 0.6
    assert not g.notes.presupposed


@pytest.mark.parametrize(
    ("rank", "begin"), [(None, 20.0), (1, 6.0), (2, 20.0), (9, 20.0), (-2, 6.0), (-9, 6.0)]
)
def test_of_several_deeds_the_last_or_the_one_counted(rank: int | None, begin: float) -> None:
    happened = (did("brake", 6.0, 8.0), did("brake", 20.0, 22.0))
    time = Relative("during", Event("brake"), rank=rank)
    assert window(time, "past", grounder(happened=happened)).begin == begin


def test_when_somebody_was_there() -> None:
    # Our braking for vehicle 1; vehicle 2's own deed; nothing of vehicle 3.
    near(found(Relative("during", Vehicle(1))), stretch(30.0, 32.0, (27.5, 34.5)))
    near(found(Relative("during", Vehicle(2))), stretch(31.0, 33.0, (28.5, 35.5)))
    g = grounder()
    window(Relative("during", Vehicle(3)), "past", g)
    assert g.notes.cost == pytest.approx(0.6)


def test_seeing_somebody_begins_with_the_ride_where_nothing_tells() -> None:
    assert found(Relative("since", Event("see", object=Vehicle(1)))).begin == 2.0
    appeared = (did("appear", 7.0, 8.0, who=1),)
    time = Relative("since", Event("see", object=Vehicle(1)))
    assert window(time, "past", grounder(happened=appeared)).begin == 8.0


DID_IT = Relative("during", Event("do"))


@pytest.mark.parametrize(
    ("discourse", "begin"),
    [
        (Discourse(), 20.0),  # the last manoeuvre
        (talk(episode=(10.0, 12.0)), 10.0),
        (talk(episode=(9.5, 11.0)), 10.0),  # the manoeuvre then
        (talk(episode=(30.0, 32.0)), 30.0),  # spoken of, though no manoeuvre
        (talk(episode=(35.0, 36.0)), 20.0),
        (talk(episode=(10.0, 12.0), asked_at=33.0), 20.0),  # long ago
        (talk(episode=(10.0, 12.0), asked_at=35.0), 10.0),
    ],
)
def test_when_we_did_it_is_the_last_manoeuvre_or_that_spoken_of(
    discourse: Discourse, begin: float
) -> None:
    assert found(DID_IT, discourse=discourse).begin == begin


def test_before_and_after_that() -> None:
    focus = talk(episode=(20.0, 26.0))
    near(found(Back("before"), discourse=focus), stretch(12.0, 19.8, (2.0, 19.75)))
    near(found(Back("after"), discourse=focus), stretch(26.0, 34.0, (26.05, 40.0), prefer="first"))
    near(found(Back(), discourse=focus), stretch(20.0, 26.0, (17.5, 28.5)))
    # With nothing spoken of, or long ago, it is the latest thing of note.
    for discourse in (Discourse(), talk(episode=(20.0, 26.0), asked_at=30.0)):
        near(found(Back(), discourse=discourse), stretch(30.0, 32.0, (27.5, 34.5)))
        before = found(Back("before"), discourse=discourse)
        assert before == Window(2.0, 40.0, Unsaid(), (2.0, 40.0), True)
    g = grounder(happened=())
    assert window(Back(), "past", g) == Window(2.0, 40.0, Unsaid(), (2.0, 40.0))
    assert g.notes.leaned


@pytest.mark.parametrize(
    ("asked_at", "stale"), [(None, False), (34.5, False), (34.0, False), (33.9, True)]
)
def test_what_was_asked_long_ago_is_stale(asked_at: float | None, stale: bool) -> None:
    assert grounder(Discourse(asked_at=asked_at)).context.stale is stale


@pytest.mark.parametrize(
    ("happened", "interval"),
    [
        ((), None),
        ((did("see", 5.0, 6.0),), None),
        ((did("brake", 5.0, 6.0, who=2),), None),
        ((did("cut-in", 5.0, 6.0, who=2, whom=0),), (5.0, 6.0)),
        ((did("brake", 5.0, 6.0), did("stop", 7.4, 9.0)), (5.0, 9.0)),
        ((did("brake", 5.0, 6.0), did("stop", 7.6, 9.0)), (7.6, 9.0)),
        ((did("brake", 5.0, 19.0), did("stop", 19.0, 21.0)), (19.0, 21.0)),  # too long in all
        ((did("brake", 5.0, 12.0), did("stop", 6.0, 9.0)), (5.0, 12.0)),
        ((did("stop", 36.0, going_on=True),), (36.0, 40.0)),
    ],
)
def test_the_latest_thing_of_note(happened: Any, interval: tuple[float, float] | None) -> None:
    assert notable(grounder(happened=happened).context) == interval


@pytest.mark.parametrize(
    ("time", "at"),
    [
        (Relative("before", BRAKE), 14.0),
        (Relative("after", BRAKE), 10.0),
        (Relative("during", BRAKE), 10.0),
        (Relative("during", Event("turn")), 12.0),  # at its middle
        (Back("before"), 14.0),
        (Back("after"), 10.0),
        (Back("during"), 10.0),
        (Relative("until", BRAKE), None),
        (Relative("before", Vehicle(1)), None),
        (At(3.0), None),
    ],
)
def test_a_deed_named_as_a_time_is_a_moment(time: Time, at: float | None) -> None:
    whole = stretch(10.0, 14.0, (10.0, 14.0))
    expected = whole if at is None else replace(whole, begin=at, end=at, term=At(at))
    assert pointed(time, whole) == expected
    unsaid = replace(whole, term=Unsaid())
    assert pointed(time, unsaid) == unsaid


def test_spans_are_those_of_the_window() -> None:
    one = found(Within(4.0)).span
    assert (one.begin, one.end, one.said, one.ahead) == (40.0, 44.0, True, True)


@pytest.mark.parametrize(("asked_at", "stale"), [(38.0, False), (37.9, True)])
def test_a_present_that_was_spoken_of_is_soon_past(asked_at: float, stale: bool) -> None:
    fleeting = Discourse(asked_at=asked_at, episode=(asked_at, asked_at))
    assert grounder(fleeting).context.stale is stale
    lasting = Discourse(asked_at=asked_at, episode=(asked_at - 3.0, asked_at))
    assert not grounder(lasting).context.stale
