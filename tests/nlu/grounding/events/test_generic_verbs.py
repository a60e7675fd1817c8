"""Verbs that say little by themselves, by the place at which they are said."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.places import RoadFacts, RoadPlace, RouteStep
from tests.nlu.grounding.fakes import Car, FakeWorld, did
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.terms import (
    At,
    Described,
    Ego,
    Event,
    Everyone,
    Feature,
    Happens,
    Is,
    Junction,
    Not,
    Now,
    Related,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.context import Context, Window
from xavi_dialogue.nlu.grounding.events.generic import come_along, in_order, specified
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

RING = Junction("roundabout")
NOW = 20.0


def place(lane: int = 0, lanes: int = 1, *, ring: bool = False, inside: bool = False) -> RoadPlace:
    return RoadPlace("e", lane, lanes, 13.9, inside, ring)


def step(kind: Any, distance: float) -> RouteStep:
    return RouteStep(distance, kind, "exit-straight", None, None, 4, "priority")


def facts(mine: RoadPlace | None, *route: RouteStep, **others: RoadPlace) -> RoadFacts:
    places = {} if mine is None else {0: mine}
    places |= {int(name[1:]): one for name, one in others.items()}
    return RoadFacts(places=places, route=route)


def meant(event: Event, road: RoadFacts | None = None, *happened: Any, **cars: Car) -> Event:
    """What an event said now is taken for."""
    known = {1: Car(20.0), **{int(name[1:]): car for name, car in cars.items()}}
    world = FakeWorld(known, happened, facts=road)
    now = Window(NOW, NOW, Now(), (NOW, NOW))
    return specified(event, now, TermGrounder(Context(world, Discourse())))


LANES = facts(place(0, 2))
ON_RING = facts(place(ring=True))
PLAIN = facts(place())


@pytest.mark.parametrize(
    ("spoken", "found"),
    [
        (Event("head"), Event("go")),
        (Event("head", object=Feature("way")), Event("head", object=Feature("way"))),
        (Event("go", object=RING), Event("enter", object=RING)),
        (Event("move", object=RING), Event("enter", object=RING)),
        (Event("cross", object=RING), Event("cross", object=RING)),
        (Event("stop"), Event("stop")),
        (Event("enter", object=Feature("way")), Event("enter", object=Feature("way"))),
    ],
)
def test_heading_and_going_round(spoken: Event, found: Event) -> None:
    assert meant(spoken, LANES) == found


@pytest.mark.parametrize(
    ("road", "ours", "theirs"),
    [
        (ON_RING, Event("enter", object=RING), Event("enter", Vehicle(1), RING)),
        (
            facts(place(), step("roundabout", 80.0)),
            Event("enter", object=RING), Event("enter", Vehicle(1), RING),
        ),
        (facts(place(0, 2), step("roundabout", 81.0)), Event("change-left"),
         Event("cut-in", Vehicle(1), Ego())),
        (facts(place(0, 2), step("junction", 40.0)), Event("enter"), Event("enter", Vehicle(1))),
        (facts(place(0, 2), step("junction", 41.0)), Event("change-left"),
         Event("cut-in", Vehicle(1), Ego())),
        (facts(place(0, 2, inside=True)), Event("enter"), Event("enter", Vehicle(1))),
        (LANES, Event("change-left"), Event("cut-in", Vehicle(1), Ego())),
        (facts(place(1, 2)), Event("change-right"), Event("cut-in", Vehicle(1), Ego())),
        (PLAIN, Event("enter"), Event("enter", Vehicle(1))),
        (facts(None), Event("enter"), Event("enter", Vehicle(1))),
        (None, Event("enter"), Event("enter", Vehicle(1))),
    ],
)  # fmt: skip
def test_going_in(road: RoadFacts | None, ours: Event, theirs: Event) -> None:
    assert meant(Event("enter"), road) == ours
    assert meant(Event("enter", Vehicle(1)), road) == theirs


def test_coming_out_is_leaving_the_ring_or_moving_left() -> None:
    out = Event("pull-out", tense="past")
    assert meant(out, ON_RING) == replace(out, action="leave", object=RING)
    theirs = replace(out, actor=Vehicle(1))
    assert meant(theirs, facts(place(), v1=place(ring=True))) == replace(
        theirs, action="leave", object=RING
    )
    assert meant(theirs, ON_RING) == theirs
    assert meant(replace(out, side="left"), ON_RING) == replace(out, side="left")
    assert meant(out, LANES) == replace(out, action="change-left")
    before = replace(out, object=Vehicle(1))
    assert meant(before, LANES) == replace(
        out, action="change-left", where=Related("ahead-of", Ego(), Vehicle(1))
    )
    where = replace(out, where=Related("ahead-of", Ego(), Vehicle(1)))
    crossing = facts(place(0, 1, inside=True))
    assert meant(where, LANES) == meant(before, LANES)
    assert meant(where, crossing) == replace(before, action="go", manner=("first",))
    assert meant(out, PLAIN) == out
    for tense in ("present", "future"):
        soon = Event("pull-out", tense=tense)
        assert meant(soon, PLAIN) == replace(soon, action="leave")
    assert meant(replace(before, tense="present"), PLAIN) == replace(before, tense="present")


def test_who_signals_right_while_it_drives_comes_out_to_the_right() -> None:
    out = Event("pull-out", Vehicle(1), tense="present")
    signals = did("signal", 10.0, who=1, side="right", going_on=True)
    off = replace(out, action="exit-right")
    assert meant(out, PLAIN, signals) == off
    assert meant(replace(out, tense="future"), PLAIN, signals) == replace(off, tense="future")
    assert meant(replace(out, tense="past"), PLAIN, signals) == replace(out, tense="past")
    assert meant(out, PLAIN) == out
    left = did("signal", 10.0, who=1, side="left", going_on=True)
    over = did("signal", 10.0, 18.5, who=1, side="right")
    assert meant(out, PLAIN, left) == meant(out, PLAIN, over) == out
    assert meant(out, PLAIN, signals, v1=Car(20.0, speed=0.9)) == out
    assert meant(out, PLAIN, signals, v1=Car(20.0, speed=1.0)) == off
    assert meant(replace(out, object=Ego()), PLAIN, signals) == replace(out, object=Ego())


@pytest.mark.parametrize(
    ("car", "over"),
    [
        (Car(20.0, 3.5), True),
        (Car(-20.0, -3.5), True),
        (Car(2.0, 3.5), True),
        (Car(20.0, 2.0), True),
        (Car(20.0, 1.9), False),
        (Car(26.0, 3.5), False),
        (Car(20.0, 3.5, speed=0.9), False),
        (Car(20.0, 3.5, oncoming=True), False),
        (Car(20.0, 3.5, crossing=True), False),
        (Car(20.0, 3.5, seen=(0.0, 15.0)), False),
    ],
)
def test_who_comes_from_the_lane_beside_us_changes_lanes(car: Car, over: bool) -> None:
    come = Event("come", Vehicle(1), object=Ego())
    changed = Event("change-lane", Vehicle(1))
    assert meant(come, PLAIN, v1=car) == (changed if over else come)
    beside = replace(come, where=Related("beside", Vehicle(1), Ego()))
    assert meant(beside, PLAIN, v1=car) == beside
    assert meant(replace(come, side="left"), PLAIN, v1=car) == replace(come, side="left")


def test_going_past_an_exit_is_moving_where_there_is_no_ring() -> None:
    on = Event("continue-next-exit")
    assert meant(on, ON_RING) == on
    assert meant(on, facts(place(), step("roundabout", 50.0))) == on
    assert meant(on, PLAIN) == Event("move")
    theirs = Event("continue-next-exit", Vehicle(1))
    assert meant(theirs, facts(place(), v1=place(ring=True))) == theirs
    assert meant(theirs, PLAIN) == Event("move", Vehicle(1))


@pytest.mark.parametrize(
    ("gave", "over"),
    [
        ([did("give-way", 15.0, 18.0, whom=1)], True),
        ([did("give-way", 10.0, 13.0, whom=1)], False),  # too long ago
        ([did("give-way", 15.0, whom=1, going_on=True)], False),
        ([did("give-way", 15.0, 18.0, whom=2)], False),
        ([], False),
        (
            [did("give-way", 15.0, 18.0, whom=1), did("give-way", 19.0, whom=1, going_on=True)],
            False,
        ),
    ],
)
def test_going_after_somebody_is_having_let_him_go(gave: list[Any], over: bool) -> None:
    after = Event("let-go", object=Vehicle(1), tense="present")
    found = replace(after, tense="perfect") if over else after
    assert meant(after, PLAIN, *gave) == found
    for other in (replace(after, tense="past"), replace(after, modal="must")):
        assert meant(other, PLAIN, *gave) == other


def test_coming_along_is_being_with_us_now() -> None:
    there = Related("with", Vehicle(1), Ego(), tense="past")
    assert come_along(there) == replace(there, time=Now(), tense="perfect")
    assert come_along(replace(there, tense="present")) == replace(
        there, time=Now(), tense="present"
    )
    for other in (replace(there, relation="behind"), replace(there, time=At(3.0))):
        assert come_along(other) == other


def first(**fields: Any) -> Happens:
    return Happens(Event(**{"action": "go", "manner": ("first",), "tense": "present", **fields}))


HIM = Vehicle(1)


@pytest.mark.parametrize(
    ("spoken", "found"),
    [
        (first(), Related("has-priority-over", Ego(), Everyone())),
        (first(object=HIM), Related("has-priority-over", Ego(), HIM)),
        (first(actor=HIM), Related("has-priority-over", HIM, Ego())),
        (first(actor=HIM, object=HIM), Related("has-priority-over", HIM, Ego())),
        (first(actor=HIM, action="enter"), Related("has-priority-over", HIM, Ego())),
        (first(actor=HIM, action="cross"), Related("has-priority-over", HIM, Ego())),
        (first(actor=HIM, tense="future"), Related("has-priority-over", HIM, Ego())),
        (first(actor=HIM, modal="must"), Related("has-priority-over", HIM, Ego())),
        (first(actor=HIM, modal="must", tense="past"),
         Related("has-priority-over", HIM, Ego(), tense="past")),
        (first(tense="past"), Not(Happens(Event("give-way", tense="past")), lexical=True)),
        (first(tense="perfect"), Not(Happens(Event("give-way", tense="perfect")), lexical=True)),
    ],
)  # fmt: skip
def test_going_first_is_having_right_of_way(spoken: Happens, found: Any) -> None:
    assert in_order(spoken, "asked") == found
    assert in_order(spoken, "presupposed") == spoken


@pytest.mark.parametrize(
    "spoken",
    [
        first(manner=()),
        first(action="stop"),
        first(modal="could"),
        first(modal="would"),
        first(object=Feature("line")),
        first(actor=Described(kind="bus")),
        first(actor=HIM, tense="past"),
        first(object=HIM, tense="past"),
    ],
)
def test_anything_else_about_order_stays_as_it_is(spoken: Happens) -> None:
    assert in_order(spoken, "asked") == spoken


def went(relation: Any, to: Any, actor: Any = None, tense: Any = "past") -> Happens:
    who = Ego() if actor is None else actor
    return Happens(Event("go", who, tense=tense, where=Related(relation, who, to)))


@pytest.mark.parametrize(
    ("spoken", "found"),
    [
        (went("beside", HIM), Is("close", HIM, tense="past")),
        (went("beside", HIM, tense="present"), None),
        (went("beside", Ego(), HIM), None),
        (went("oncoming-to", Ego(), HIM), Not(Related("with", HIM, Ego(), Now()), lexical=True)),
        (went("oncoming-to", HIM), Not(Related("with", HIM, Ego(), Now()), lexical=True)),
        (went("oncoming-to", Ego(), HIM, "present"), None),
        (went("oncoming-to", Ego()), None),
        (went("behind", HIM), None),
    ],
)
def test_where_somebody_went_may_tell_how_near_he_was(spoken: Happens, found: Any) -> None:
    assert in_order(spoken, "asked") == (spoken if found is None else found)
    assert in_order(spoken, "presupposed") == spoken


def test_the_way_is_ours() -> None:
    way = Feature("way")
    crossed = Happens(Event("cross", HIM, object=way))
    assert in_order(crossed, "asked") == Happens(Event("cross", HIM, object=Ego()))
    left = Happens(Event("leave", HIM, object=way, tense="past"))
    there = Related("in-the-way-of", HIM, Ego(), Unsaid(), "past")
    assert in_order(left, "presupposed") == Not(there, lexical=True)
