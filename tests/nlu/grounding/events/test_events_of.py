"""Events matched with the record: who did them, where, and what "do it" stands for."""

from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.places import RoadFacts, RoadPlace
from tests.nlu.grounding.events.test_events import BRAKE, NOW, TWO, Said, route
from tests.nlu.grounding.fakes import did, talk
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    Ago,
    At,
    Between,
    Described,
    Ego,
    Event,
    Feature,
    Junction,
    Next,
    Nobody,
    Pronoun,
    Related,
    Relative,
    Unsaid,
    Vehicle,
    Wanted,
)


def test_a_described_actor_is_who_did_it() -> None:
    brakes = (did("brake", 5.0, 7.0, who=2), did("brake", 9.0, 11.0, who=3))
    car = Event("brake", Described(kind="vehicle"), tense="past")
    assert Said(car, *brakes).event.actor == Vehicle(3)
    bus = Event("brake", Described(kind="bus"), tense="past")
    assert Said(bus, *brakes).event.actor == Vehicle(2)
    waited = Event("wait", object=Described(kind="vehicle"), tense="past")
    assert Said(waited, did("wait", 5.0, 7.0, whom=2)).event.object == Vehicle(2)


def test_whether_anybody_did_it_exactly() -> None:
    anyone = Event("brake", Described(definite=False), tense="past")
    assert Said(anyone, did("brake", 5.0, who=2), mode="asked").event.actor == Vehicle(2)
    nobody = Said(anyone, did("slow-down", 5.0, who=2), mode="asked").event.actor
    assert isinstance(nobody, Nobody)
    some = Event("brake", Described("bus", definite=False), tense="past")
    assert Said(some, did("slow-down", 5.0, who=2), mode="asked").event.actor == Vehicle(2)


def test_somebody_described_who_is_only_supposed_is_nobody() -> None:
    spoken = Event("brake", Described("bus", definite=False))
    found = Said(spoken, mode="supposed").event
    assert found.actor == Nobody(described=spoken.actor)  # type: ignore[arg-type]
    # "you pulled out in front of a lorry": it is known by its looks.
    before = Event("overtake", object=Described("truck", definite=False), tense="past")
    assert Said(before).event.object == Vehicle(3)
    plain = Event("overtake", object=Described("car", definite=False), tense="past")
    assert isinstance(Said(plain).event.object, Nobody)


def test_is_it_braking_is_of_whom_was_spoken_of() -> None:
    it = Event("brake", Pronoun("it"), tense="present")
    other = did("brake", 38.0, who=2, going_on=True)
    spoken = talk(Vehicle(1), Vehicle(2))
    assert Said(it, other, mode="asked", discourse=spoken).event.actor == Vehicle(1)
    past = replace(it, tense="past")
    assert Said(past, other, mode="asked", discourse=spoken).event.actor == Vehicle(2)


def test_who_is_named_beside_another_is_somebody_else() -> None:
    followed = Event("follow", Vehicle(1), object=Pronoun("it"), tense="past")
    found = Said(followed, discourse=talk(Vehicle(1), Vehicle(2)))
    assert found.event.object == Vehicle(2)


@pytest.mark.parametrize(
    ("spoken", "leaned"),
    [
        (Event("do"), True),
        (Event("do", object=Pronoun("that")), True),
        (Event("do", object=Vehicle(1)), False),
    ],
)
def test_doing_it_is_what_was_spoken_of(spoken: Event, leaned: bool) -> None:
    told = talk(propositions=(happens(replace(BRAKE, time=Between(5.0, 7.0), manner=("hard",))),))
    found = Said(replace(spoken, tense="past"), *TWO, discourse=told)
    assert found.leaned is leaned
    assert found.event.action == ("brake" if leaned else "do")
    if leaned:
        assert (found.event.time, found.event.manner) == (Between(5.0, 7.0), ("hard",))
        again = replace(spoken, tense="past", time=At(21.0), manner=("gently",))
        other = Said(again, *TWO, discourse=told).event
        assert (other.time, other.manner) == (Between(20.0, 22.0), ("gently",))


def happens(event: Event) -> Any:
    from xavi_dialogue.domain.terms import Happens

    return Happens(event)


def test_what_was_to_come_and_was_done_since_is_looked_for_anew() -> None:
    will = talk(propositions=(happens(Event("brake", time=Next(), tense="future")),))
    did_it = Said(Event("do", tense="past"), *TWO, discourse=will)
    assert did_it.event == replace(BRAKE, time=Between(20.0, 22.0))
    would = Said(Event("do", tense="past", modal="would"), *TWO, discourse=will, mode="asked")
    assert would.event.time == Next()
    soon = Said(Event("do", tense="future"), *TWO, discourse=will, mode="asked")
    assert soon.event.time == Next()


def test_who_leaves_a_ring_leaves_it() -> None:
    ring = RoadPlace("e", 0, 1, 13.9, True, True)
    on_ring = RoadFacts({0: ring, 1: ring})
    for actor in (Ego(), Vehicle(1)):
        spoken = Event("leave", actor, tense="past")
        assert Said(spoken, facts=on_ring).event.object == Junction("roundabout")
        assert Said(spoken, facts=route("exit-left")).event.object is None
        assert Said(spoken).event.object is None
    assert Said(Event("leave", Vehicle(2), tense="past"), facts=on_ring).event.object is None
    assert Said(Event("stop", tense="past"), facts=on_ring).event.object is None


def test_where_something_was_done_is_grounded_too() -> None:
    where = Related("behind", Ego(), Described(kind="bus"))
    stopped = Said(Event("stop", tense="past", where=where), did("stop", 5.0, 7.0)).event
    assert stopped.where == Related("behind", Ego(), Vehicle(2), Unsaid())
    line = Related("on", Ego(), Feature("line"))
    for action in ("stop", "stand", "wait"):
        assert Said(Event(action, tense="past", where=line)).event.where is None
    assert Said(Event("cross", tense="past", where=line)).event.where is not None
    wanted = Related("near", Wanted(), Ego())
    found = Said(Event("stop", tense="past", where=wanted)).event.where
    assert found is not None
    assert found.thing == Wanted()


def test_what_is_done_after_it_is_supposed() -> None:
    then = Event("stop", Pronoun("it"))
    spoken = Event("brake", Vehicle(1), tense="past", then=then)
    found = Said(spoken, did("brake", 5.0, who=1), discourse=talk(Vehicle(1)))
    assert found.event.then is not None
    assert found.event.then.actor == Vehicle(1)
    assert found.cost == 0.0


def test_while_we_go_is_no_time_of_what_is_to_come() -> None:
    going = Relative("during", Event("go", tense="present"))
    soon = Event("stop", tense="future", time=going)
    assert Said(soon, mode="asked").event.time == Next()
    assert Said(soon, mode="asked").span == Span(40.0, 55.0, ahead=True)
    assert Said(soon, mode="supposed").span is None


def slowed(first: float, last: float, begin: float, end: float | None) -> Episode:
    return Episode(Ego(), "slow-down", begin, end, speed_from=first, speed_to=last, peak=0.6)


@pytest.mark.parametrize("time", [Unsaid(), Ago(), Between(30.0, NOW)])
def test_slowing_of_just_now_that_took_much_of_our_speed_is_felt_as_braking(time: Any) -> None:
    spoken = Event("brake", time=time, tense="past")
    found = Said(spoken, did("brake", 5.0, 7.0), slowed(3.0, 1.5, 37.0, 39.0))
    assert found.holds
    assert found.event.action == "brake"
    assert found.span is not None
    assert found.span.begin in (30.0, 37.0)


@pytest.mark.parametrize(
    "slowing",
    [
        slowed(14.0, 12.5, 37.0, 39.0),  # of a car that drives fast, it is hardly felt
        slowed(3.0, 1.5, 30.0, 32.0),  # long over
        Episode(Ego(), "slow-down", 37.0, 39.0),  # of which nobody knows how much it was
    ],
)
def test_other_slowing_is_no_braking(slowing: Episode) -> None:
    found = Said(Event("brake", tense="past"), did("brake", 5.0, 7.0), slowing)
    assert found.event.time == Between(5.0, 7.0)
    hard = Event("brake", manner=("hard",), tense="past")
    gentle = slowed(3.0, 1.5, 37.0, 39.0)
    assert Said(hard, did("brake", 5.0, 7.0), gentle).event.time == Between(5.0, 7.0)
