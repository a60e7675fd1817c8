"""What a fragment is short for, part by part."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.fakes import Car, FakeWorld, did
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Ask,
    Doing,
    Elliptic,
    Identify,
    Listing,
    Question,
    Summarise,
    WhatIf,
    Where,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    SOMEBODY_ELSE,
    Described,
    Ego,
    Event,
    Exists,
    Exit,
    Happens,
    Is,
    Junction,
    Not,
    Pronoun,
    Related,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.grounding.completion.ellipsis import complete
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

HIM = Vehicle(1)
DEEDS = (did("brake", 12.0, 13.0, who=3), did("wait", 5.0, 8.0, whom=1))
SLOWED = Happens(Event("slow-down", tense="past"))


def grounder(question: Question | None, *happened: Any, **more: Any) -> TermGrounder:
    cars = {1: Car(20.0, kind="bus"), 2: Car(-10.0), 3: Car(30.0, 3.5, colour="red")}
    said = replace(Discourse(turn=2), question=question, **more)
    return TermGrounder(Context(FakeWorld(cars, happened or DEEDS, now=20.0), said))


def asked(spoken: Elliptic, question: Question | None, *happened: Any, **more: Any) -> Any:
    found = complete(spoken, grounder(question, *happened, **more))
    assert isinstance(found, Ask)
    return found.question


@pytest.mark.parametrize("action", [
    "wait", "give-way", "let-go", "brake", "stop", "slow-down", "follow", "stand", "swerve",
    "signal", "honk", "flash",
])  # fmt: skip
def test_somebody_else_is_whom_we_did_it_for(action: Any) -> None:
    ours = Event(action, object=HIM, tense="past")
    found = asked(Elliptic(thing=SOMEBODY_ELSE), Whether(Happens(ours)))
    assert found == Why(Happens(replace(ours, object=None)), suspect=SOMEBODY_ELSE)


@pytest.mark.parametrize("question", [
    Whether(Happens(Event("overtake", object=HIM, tense="past"))),
    Whether(Happens(Event("wait", tense="past"))),
    Whether(Happens(Event("wait", Vehicle(2), object=HIM, tense="past"))),
    Why(Happens(Event("brake", HIM, tense="past"))), Doing(Ego()), None,
])  # fmt: skip
def test_somebody_else_is_whoever_is_there_where_it_was_done_for_nobody(
    question: Question | None,
) -> None:
    assert asked(Elliptic(thing=SOMEBODY_ELSE), question) == Listing("vehicles")


def test_somebody_else_may_be_the_cause_or_who_did_the_same() -> None:
    found = asked(
        Elliptic(thing=SOMEBODY_ELSE), Why(SLOWED, suspect=HIM, rival=Vehicle(2), alone=True)
    )
    assert found == Why(SLOWED, suspect=SOMEBODY_ELSE)
    which = Which(Wanted(), Happens(Event("brake", Wanted(), tense="past")))
    assert asked(Elliptic(thing=SOMEBODY_ELSE), which) == which
    placed = Which(Wanted(), Related("behind", Wanted()))
    assert asked(Elliptic(thing=SOMEBODY_ELSE), placed) == Listing("vehicles")


@pytest.mark.parametrize(
    ("question", "besides"),
    [
        (Why(SLOWED), Listing("reasons")),
        (Listing("causes"), Listing("causes")),
        (Which(Wanted(), Related("can-see", Wanted())), Listing("vehicles")),
        (Which(Wanted(), Related("behind", Wanted())), None),
        (Whether(SLOWED), Doing(besides=SLOWED)),
        (None, Doing()),
    ],
)
def test_what_else(question: Question | None, besides: Question | None) -> None:
    found = asked(Elliptic(besides=True), question)
    assert found == besides or (besides is None and isinstance(found, Doing))


def test_what_else_somebody_does_is_beside_what_was_told() -> None:
    found = asked(Elliptic(besides=True), Doing(HIM), propositions=(SLOWED,))
    assert found == Doing(HIM, besides=SLOWED)


@pytest.mark.parametrize(
    ("question", "negated"),
    [
        (WhatIf(Not(SLOWED)), WhatIf(SLOWED)),
        (WhatIf(SLOWED), WhatIf(Not(SLOWED))),
        (Why(SLOWED), Why(Not(SLOWED))),
        (Why(Not(SLOWED)), Why(Not(SLOWED))),
        (Whether(SLOWED), Whether(Not(SLOWED))),
        (Identify(HIM), Identify(HIM)),
    ],
)
def test_and_if_not(question: Question, negated: Question) -> None:
    assert asked(Elliptic(negated=True), question) == negated


def test_a_fragment_after_nothing_asks_what_it_is_where_or_whether() -> None:
    for thing in (Described(kind="bus"), Pronoun("it"), HIM):
        assert asked(Elliptic(thing=thing), None) == Identify(thing)
    assert asked(Elliptic(thing=Junction("roundabout")), None) == Where(Junction("roundabout"))
    event = Event("overtake", tense="future")
    assert asked(Elliptic(event=event), None) == Whether(Happens(event))
    assert asked(Elliptic(event=event), Listing("vehicles")) == Whether(Happens(event))
    nothing = grounder(None)
    assert complete(Elliptic(), nothing) is None
    assert nothing.notes.cost == pytest.approx(0.6)


@pytest.mark.parametrize(
    ("action", "begun", "meant"),
    [
        ("exit-left", 17.0, "change-left"),
        ("exit-left", 10.0, "exit-left"),  # long over
        ("exit-right", 17.0, "exit-right"),
        ("turn", 17.0, "turn"),
    ],
)
def test_left_again_is_of_the_lane_change_where_we_changed_lanes(
    action: Any, begun: float, meant: str
) -> None:
    changed = did("change-left", begun, begun + 1.0, side="left")
    event = Event(action, tense="future")
    found = asked(Elliptic(event=event), None, changed)
    assert found.that.event.action == meant
    tense = "present" if meant == "change-left" else "future"
    assert found.that.event.tense == tense
    his = replace(event, actor=HIM)
    assert asked(Elliptic(event=his), None, changed).that.event == his


@pytest.mark.parametrize("modal", ["should", "could", "would"])
def test_what_we_should_do_is_not_asked_of_others(modal: Any) -> None:
    judged = Whether(Happens(Event("brake", modal=modal)))
    for thing in (HIM, Described(kind="bus"), Pronoun("he")):
        assert asked(Elliptic(thing=thing), judged) == Doing(thing)
    plain = Whether(Happens(Event("brake", tense="past")))
    assert asked(Elliptic(thing=HIM), plain) == Whether(Happens(Event("brake", HIM, tense="past")))
    assert asked(Elliptic(thing=HIM), Summarise()) == Doing(HIM)


def test_and_the_closest_one_asks_who_that_is() -> None:
    closest = Described(extreme="nearest")
    which = Which(Wanted(), Related("behind", Wanted()))
    for question in (Listing("vehicles"), which):
        assert asked(Elliptic(thing=closest), question) == Identify(closest)
    bus = Described(kind="bus")
    assert asked(Elliptic(thing=bus), Listing("vehicles")) != Identify(bus)


def test_for_us_is_whether_it_was_done_for_us() -> None:
    waits = Event("wait", HIM, object=Wanted(), tense="present")
    found = asked(Elliptic(thing=Ego()), Which(Wanted(), Happens(waits)))
    assert found == Whether(Happens(replace(waits, object=Ego())))


def test_and_he_after_what_we_did_is_the_reason_or_did_it_too() -> None:
    why = Why(Happens(Event("brake", tense="past")))
    assert asked(Elliptic(thing=HIM), why) == replace(why, suspect=HIM)
    # He braked as well, so that it is asked why he did.
    assert asked(Elliptic(thing=Vehicle(3)), why) == Why(
        Happens(Event("brake", Vehicle(3), tense="past"))
    )


def test_and_he_after_whom_we_waited_for_is_whether_we_did_for_him() -> None:
    why = Why(Happens(Event("wait", object=Vehicle(2), tense="past")))
    assert asked(Elliptic(thing=HIM), why) == Why(Happens(Event("wait", object=HIM, tense="past")))
    assert asked(Elliptic(thing=Vehicle(3)), why) == Doing(Vehicle(3))


@pytest.mark.parametrize(
    ("place", "found"),
    [
        (Exit(rank=1), Exit(rank=2)),
        (Junction("roundabout"), Junction("roundabout", rank=2)),
        (HIM, Described(rank=2)),
    ],
)
def test_the_second_one_is_an_exit_or_a_junction_where_that_was_spoken_of(
    place: Any, found: Any
) -> None:
    assert asked(Elliptic(thing=Described(rank=2)), Where(place)) == Where(found)
    # More than a number is the description of a vehicle.
    bus = Described(colour="red", rank=2)
    assert asked(Elliptic(thing=bus), Where(place)) != Where(found)


def test_why_not_because_of_him_asks_the_suspicion_again() -> None:
    suspicion = Why(SLOWED, suspect=HIM)
    assert asked(Elliptic(form="why", negated=True), suspicion) == suspicion
    assert asked(Elliptic(form="why", negated=True), Why(SLOWED)) == Why(Not(SLOWED))
    assert asked(Elliptic(form="why-not"), Whether(Not(SLOWED))) == Why(Not(SLOWED))


def test_why_again_of_the_same_costs_a_little() -> None:
    again, other = grounder(Why(SLOWED)), grounder(Whether(SLOWED))
    assert complete(Elliptic(form="why"), again) == Ask(Why(SLOWED))
    assert complete(Elliptic(form="why"), other) == Ask(Why(SLOWED))
    assert again.notes.cost > other.notes.cost


def test_a_supposition_keeps_its_frame() -> None:
    gone = WhatIf(Not(Exists(Vehicle(2))))
    assert asked(Elliptic(thing=HIM), gone) == WhatIf(Not(Exists(HIM)))
    near = Whether(Is("close", Vehicle(2)))
    assert asked(Elliptic(thing=HIM), near) == Whether(Is("close", HIM))
