"""Kin: what somebody may be said to have done by another name."""

from tests.nlu.grounding.fakes import Car, FakeWorld, did
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Vehicle
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.kin import like


def alike(event: Event, *happened: Episode) -> tuple[Episode, ...]:
    world = FakeWorld({1: Car(20.0)}, happened)
    return like(Context(world, Discourse()), event, 0.0, 20.0)


def test_who_changes_lanes_has_overtaken_nobody_by_that() -> None:
    shift = did("change-right", 5.0, who=1)
    assert alike(Event("overtake", Vehicle(1), Ego()), shift) == ()
    assert alike(Event("overtake", Vehicle(1)), shift) == (shift,)


def test_who_crossed_while_we_stood_was_let_go() -> None:
    crossed, stood = did("cross", 5.0, 9.0, who=1, whom=0), did("stop", 8.0, 12.0)
    let = Event("let-go", Ego(), Vehicle(1))
    assert alike(let, crossed, stood) == (crossed,)
    assert crossed not in alike(let, crossed, did("stop", 10.0, 12.0))


def test_whom_we_passed_is_who_went_past_us_and_nobody_else() -> None:
    theirs, other = did("pass", 5.0, who=1, whom=0), did("pass", 8.0, who=0, whom=2)
    assert alike(Event("pass", Ego(), Vehicle(1)), theirs, other) == (theirs,)
    assert alike(Event("pass", Ego(), Vehicle(1)), other) == ()
    assert alike(Event("overtake", Ego(), Vehicle(1)), theirs) == ()
