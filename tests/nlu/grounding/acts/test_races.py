"""Who gets somewhere first, what was believed when, and which of what was offered is meant."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.fakes import Car, FakeWorld, talk
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Ask,
    Changed,
    Elliptic,
    HowMuch,
    HowSure,
    Repair,
    Whether,
    Which,
)
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Between,
    Described,
    Ego,
    Event,
    Happens,
    Is,
    Junction,
    Measured,
    Passenger,
    Pronoun,
    Related,
    Relative,
    Unsaid,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.nlu.grounding.acts.races import race
from xavi_dialogue.nlu.grounding.completion.repairs import answers_clarification
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.events.timing import (
    believed_last,
    believed_then,
    changed,
    foreseen,
)
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

CAR, PLACE = Vehicle(1), Junction()
BEFORE_US = Relative("before", Event("arrive", Ego(), tense="present"))
BEFORE_IT = Relative("before", Event("pass", CAR, tense="present"))


def goes(one: Any, other: Any) -> Happens:
    return Happens(Event("go", one, other, manner=("first",), tense="future"))


def event(action: Any, actor: Any, **more: Any) -> Happens:
    more.setdefault("tense", "future")
    return Happens(Event(action, actor, **more))


@pytest.mark.parametrize(
    ("that", "meant"),
    [
        (event("arrive", CAR, manner=("first",)), goes(CAR, Ego())),
        (event("arrive", CAR, manner=("first",), tense="present"), goes(CAR, Ego())),
        (event("arrive", CAR, manner=("first",), tense="past"), None),
        (event("arrive", Ego(), manner=("first",)), None),  # before whom?
        (event("arrive", CAR), None),
        (event("brake", CAR, manner=("first",)), None),
        (event("arrive", CAR, where=Related("ahead-of", CAR, Ego())), goes(CAR, Ego())),
        (event("arrive", CAR, where=Related("ahead-of", CAR, Passenger())), goes(CAR, Ego())),
        (event("arrive", CAR, where=Related("behind", CAR, Ego())), None),
        (event("pass", CAR, time=BEFORE_US), goes(CAR, Ego())),
        (event("pass", CAR, object=PLACE, time=BEFORE_US), goes(CAR, Ego())),
        (event("pass", CAR, object=Vehicle(2), time=BEFORE_US), None),
        (event("enter", Ego(), time=BEFORE_IT), goes(Ego(), CAR)),
        (event("enter", Passenger(), time=BEFORE_IT), goes(Ego(), CAR)),
        (event("enter", Vehicle(2), time=BEFORE_IT), None),  # neither is us
        (event("brake", CAR, time=BEFORE_US), None),
        (event("pass", CAR, time=Relative("after", Event("arrive", Ego(), tense="present"))), None),
        (event("pass", CAR, time=Relative("before", Event("brake", Ego(), tense="present"))), None),
        (event("pass", CAR, time=Relative("before", Event("arrive", Ego(), tense="past"))), None),
        (event("pass", CAR, time=Relative("before", Ego())), goes(CAR, Ego())),
        (event("pass", Ego(), time=Relative("before", Pronoun("it"))), goes(Ego(), Pronoun("it"))),
        (Related("on", CAR, PLACE, BEFORE_US, "future"), goes(CAR, Ego())),
        (Related("on", CAR, PLACE, BEFORE_US, "past"), None),
        (Related("on", CAR, PLACE, tense="future"), None),
        (Related("behind", CAR, PLACE, BEFORE_US, "future"), None),
        (Is("over", CAR, time=BEFORE_US, tense="future"), goes(CAR, Ego())),
        (Is("close", CAR, time=BEFORE_US, tense="future"), None),
    ],
)  # fmt: skip
def test_who_is_there_first_is_who_goes_first(that: Any, meant: Any) -> None:
    assert race(Whether(that)) == (None if meant is None else Whether(meant))
    assert race(HowSure(that)) == (None if meant is None else HowSure(meant))


def test_who_arrives_first_is_who_goes_before_us() -> None:
    first = Event("arrive", Wanted(), manner=("first",), tense="future")
    assert race(Which(Wanted(), Happens(first))) == Which(Wanted(), goes(Wanted(), Ego()))
    for other in (
        replace(first, tense="past"),
        replace(first, manner=()),
        replace(first, action="go"),
    ):
        assert race(Which(Wanted(), Happens(other))) is None
    assert race(HowSure()) is None
    assert race(HowMuch(Measured("speed"))) is None


TURNS = Event("exit-right", CAR, time=At(13.0), tense="present")
TO_COME = Happens(Event("exit-right", CAR, tense="future"))


def test_a_time_beside_what_is_to_come_is_that_of_the_belief() -> None:
    assert foreseen(HowSure(Happens(TURNS))) == HowSure(TO_COME, time=At(13.0))
    assert foreseen(HowSure(Happens(TURNS), time=At(13.0))) == HowSure(TO_COME, time=At(13.0))
    during = replace(TURNS, time=Relative("during", Event("brake")))
    assert foreseen(HowSure(Happens(during))).time == during.time
    for kept in (
        HowSure(Happens(TURNS), time=At(9.0)),
        HowSure(Happens(replace(TURNS, tense="past"))),
        HowSure(Happens(replace(TURNS, time=Unsaid()))),
        HowSure(Happens(replace(TURNS, time=Relative("before", Event("brake"))))),
        HowSure(),
    ):
        assert foreseen(kept) == kept


def test_what_was_rated_so_was_believed_then() -> None:
    then = Believed(TO_COME, time=At(13.0), tense="past")
    assert believed_then(Believed(Happens(TURNS))) == then
    assert believed_then(Believed(Believed(Happens(TURNS)))) == then
    for kept in (
        Believed(Happens(TURNS), time=At(9.0)),
        Believed(Happens(replace(TURNS, tense="past"))),
        Believed(Happens(replace(TURNS, time=Unsaid()))),
    ):
        assert believed_then(kept) == kept


WORLD = FakeWorld(
    {
        1: Car(20.0, colour="red"),
        2: Car(-10.0, colour="blue", kind="truck"),
        3: Car(60.0, colour="red"),
    },
    now=40.0,
)


def grounder(**said: Any) -> TermGrounder:
    return TermGrounder(Context(WORLD, talk(**said) if said else Discourse()))


def test_that_estimate_is_what_was_said_to_be_believed() -> None:
    told = (Is("close", CAR), Believed(TO_COME))
    g = grounder(propositions=told)
    assert believed_last(g) == TO_COME
    assert g.notes.leaned
    assert believed_last(grounder(propositions=told, question=HowSure(TO_COME))) is None
    assert believed_last(grounder(propositions=told[:1])) is None
    ours = Believed(Happens(Event("exit-right", tense="future")))
    assert believed_last(grounder(propositions=(ours,))) is None


def test_what_changed_did_so_since_the_times_that_were_named() -> None:
    assert changed(Changed(), grounder(times=(30.0, 12.0, 5.0))).time == Between(12.0, 30.0)
    assert changed(Changed(), grounder(times=(30.0,))) == Changed()
    assert changed(Changed(), grounder(named=(13.0, 14.0))).time == Between(13.0, 40.0)
    said = changed(Changed(At(9.0)), grounder(times=(30.0, 12.0)))
    assert said.time == At(9.0)


OFFERED = tuple(Ask(HowMuch(Measured("speed", Vehicle(n)))) for n in (1, 2, 3))
THINGS = (Vehicle(1), Vehicle(2), Vehicle(3))
PENDING = Ask(HowMuch(Measured("speed", Described())))


@pytest.mark.parametrize(
    ("thing", "number"),
    [
        (Vehicle(2), 2),
        (Vehicle(9), None),
        (Described(colour="blue"), 2),
        (Described("truck"), None),  # a kind alone is told from others by no look
        (Described(colour="red"), None),  # two of them
        (Described(colour="red", extreme="nearest"), 1),
        (Described(colour="red", extreme="farthest"), 3),
        (Described(colour="green"), None),
        (Described(rank=1), 1),
        (Described(rank=3), 3),
        (Described(rank=-1), 3),
        (Described(rank=4), None),
        (Pronoun("it"), None),
        (Vehicles((1, 2)), None),
    ],
)
def test_what_was_offered_is_chosen_by_number_rank_or_looks(thing: Any, number: int | None) -> None:
    chosen = None if number is None else OFFERED[number - 1]
    whole = grounder(offered=OFFERED, offered_things=THINGS)
    assert answers_clarification(Elliptic(thing), whole) == chosen
    waiting = grounder(offered_things=THINGS, pending=PENDING)
    if thing != Described(rank=-1):  # the last of the readings, which here are none
        assert answers_clarification(Elliptic(thing), waiting) == chosen
    assert answers_clarification(Elliptic(thing), grounder()) is None


def test_a_deed_chooses_the_reading_that_has_it() -> None:
    offers = tuple(
        Ask(Whether(Happens(Event(action, CAR)))) for action in ("exit-left", "exit-right")
    )
    g = grounder(offered=offers)
    assert answers_clarification(Elliptic(event=Event("exit-right")), g) == offers[1]
    assert answers_clarification(Elliptic(event=Event("stop")), g) is None
    assert answers_clarification(Elliptic(event=Event("exit-right"), form="why"), g) is None
    assert answers_clarification(Repair("yes"), g) is None
