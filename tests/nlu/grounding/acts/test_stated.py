"""Propositions, claims, feelings and measures grounded."""

from typing import Any

import pytest

from tests.nlu.grounding.acts.test_asked import (
    BRAKE,
    BRAKED,
    BUS,
    FOCUS,
    RED,
    SPAN,
    Grounded,
    asked,
    whether,
)
from tests.nlu.grounding.fakes import did, talk
from xavi_dialogue.domain.discourse import Discourse, Span
from xavi_dialogue.domain.meaning import (
    Ask,
    Claim,
    Feel,
    HowLong,
    HowMuch,
    Request,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Ago,
    At,
    Believed,
    Between,
    Both,
    Caused,
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Measured,
    Nobody,
    Not,
    Now,
    Pronoun,
    Quantity,
    Related,
    That,
    Vehicle,
    Vehicles,
    Wanted,
    WholeRide,
)


@pytest.mark.parametrize(
    ("spoken", "found"),
    [
        (Not(Happens(BRAKE)), Not(BRAKED)),
        (Exists(BUS), Exists(Vehicle(1), Now())),
        (Exists(Described("bus", definite=False)), Exists(Vehicle(1), Now())),
        (Is("fast", BUS), Is("fast", Vehicle(1), time=Now())),
        (Is("fast", BUS, time=At(6.0), tense="past"),
         Is("fast", Vehicle(1), time=At(6.0), tense="past")),
        (Has("colour", "yellow", BUS), Has("colour", "yellow", Vehicle(1), Now())),
        (Related("behind", RED, Ego()), Related("behind", Vehicle(2), Ego(), Now())),
        (Related("can-see", Ego(), Described("bus", definite=False)), Exists(Vehicle(1), Now())),
        (Compares(Measured("speed", BUS), "more", Measured("speed", RED)),
         Compares(Measured("speed", Vehicle(1), time=Now()), "more",
                  Measured("speed", Vehicle(2), time=Now()))),
        (Compares(Measured("speed"), "more", Quantity(72.0)),
         Compares(Measured("speed", time=Now()), "more", Quantity(20.0, "m/s"))),
        (Compares(Measured("distance", BUS, Ego()), "less", Quantity(5.0)),
         Compares(Measured("distance", Vehicle(1), Ego(), time=Now()), "less", Quantity(5.0))),
        (Compares(Measured("distance", BUS, Ego(), tense="past"), "less", Quantity(5.0)),
         Compares(Measured("distance", Vehicle(1), Ego(), time=WholeRide(), tense="past"),
                  "less", Quantity(5.0))),
        (Compares(Measured("count", event=Event("brake")), "more", Quantity(2.0)),
         Compares(Measured("count", event=Event("brake", time=WholeRide())), "more",
                  Quantity(2.0))),
    ],
)  # fmt: skip
def test_propositions(spoken: Any, found: Any) -> None:
    assert whether(spoken) == found


def test_what_was_believed_is_only_supposed() -> None:
    found = whether(Believed(Happens(Event("stop", BUS, tense="future")), At(6.0)))
    assert (found.content.event.actor, found.time) == (Vehicle(1), At(6.0))


def test_what_is_counted_is_told_by_what_was_said() -> None:
    spoken = Measured("count", Described("car", plural=True))
    found = whether(Compares(spoken, "more", Quantity(2.0))).left
    assert (found.thing, found.about) == (Vehicle(2), Exists(spoken.thing))


def test_of_several_propositions_each_may_speak_of_those_before() -> None:
    it = Is("fast", Pronoun("it"))
    found = whether(Both((Exists(RED), it), "or"))
    assert [one.thing for one in found.contents] == [Vehicle(2), Vehicle(2)]


def test_that_is_what_was_said_or_nothing() -> None:
    told = Grounded(Ask(Whether(That())), talk(propositions=(BRAKED,)))
    assert told.act == Ask(Whether(BRAKED))
    assert (told.notes.leaned, told.notes.span) == (True, SPAN)
    nothing = Grounded(Ask(Whether(That())), None, did("see", 3.0))
    assert (nothing.act, nothing.notes.cost) == (Ask(Whether(That())), 0.5)


def test_what_no_record_tells_is_not_taken_for_granted() -> None:
    for state, cost in (("faulty", 0.4), ("dirty", 0.4), ("awake", 0.4), ("slow", 0.0)):
        found = Grounded(Ask(Why(Is(state, BUS))))  # type: ignore[arg-type]
        assert found.notes.cost == pytest.approx(cost)
        assert found.notes.presupposed is (cost == 0.0)
        assert Grounded(Ask(Whether(Is(state, BUS)))).notes.cost == 0.0  # type: ignore[arg-type]


def test_who_caused_what_was_asked_about() -> None:
    found = Grounded(Ask(Whether(Caused(BUS))), FOCUS)
    assert found.act == Ask(Whether(Caused(Vehicle(1), BRAKED)))
    assert (found.notes.leaned, found.notes.span) == (True, SPAN)
    said = Grounded(Ask(Whether(Caused(BUS, Happens(BRAKE)))))
    assert said.act == Ask(Whether(Caused(Vehicle(1), BRAKED)))
    deed = Grounded(Ask(Whether(Caused(Happens(Event("brake", RED)), Happens(BRAKE)))))
    assert deed.act.question.that.cause == Happens(
        Event("brake", Vehicle(2), time=Between(30.0, 31.0))
    )
    that = Grounded(Ask(Whether(Caused(BUS, That()))), FOCUS)
    assert that.act == found.act


@pytest.mark.parametrize(
    ("spoken", "discourse", "thing", "event"),
    [
        (Is("necessary"), FOCUS, None, BRAKED.event),
        (Is("necessary", Pronoun("that")), FOCUS, None, BRAKED.event),
        (Is("close", Pronoun("it")), talk(Vehicle(2)), Vehicle(2), None),
        (Is("fast", Pronoun("it")), talk(Vehicle(2)), Vehicle(2), None),
        (Is("far", Pronoun("it")), Discourse(), Destination(), None),
        (Is("far", Pronoun("it")), talk(Vehicle(2)), Vehicle(2), None),
        (Is("wrong", time=WholeRide()), FOCUS, None, None),
        (Is("dangerous", BUS), FOCUS, Vehicle(1), None),
    ],
)
def test_what_a_state_is_of(spoken: Is, discourse: Discourse, thing: Any, event: Any) -> None:
    found = whether(spoken, discourse)
    assert (found.thing, found.event) == (thing, event)


def test_whether_what_was_expected_was_wrong_is_of_whom_it_was_expected() -> None:
    turns = Believed(Happens(Event("turn", Vehicle(2), tense="future")), At(6.0))
    found = whether(Is("wrong", tense="past"), talk(propositions=(turns,)))
    assert (found.thing, found.time) == (Vehicle(2), At(6.0))


def test_a_request_may_be_of_somebody_in_view() -> None:
    some = Request(Event("overtake", object=Described("bus", definite=False)), negated=True)
    found = Grounded(some)
    assert (found.act.event.object, found.act.negated) == (Vehicle(1), True)
    assert found.notes.cost == 0.0


def test_who_is_said_to_be_there_is_whom_the_noun_fits() -> None:
    red = Described(colour="red", definite=False, doing=Event("cut-in", Wanted(), Ego()))
    assert Grounded(Claim(Exists(red))).act.that.thing == Vehicle(2)
    green = Described(colour="green", definite=False, doing=Event("cut-in", Wanted(), Ego()))
    found = Grounded(Claim(Exists(green)))
    assert isinstance(found.act.that.thing, Nobody)
    assert found.notes.missing == []
    anybody = Described(definite=False, doing=Event("cut-in", Wanted(), Ego()))
    assert isinstance(Grounded(Claim(Exists(anybody))).act.that.thing, Nobody)


@pytest.mark.parametrize(
    ("feel", "discourse", "span", "about"),
    [
        (Feel("afraid"), Discourse(), Span(34.0, 40.0), None),
        (Feel("afraid"), FOCUS, SPAN, None),
        (Feel("afraid"), talk(episode=(12.0, 14.0), asked_at=33.9), Span(34.0, 40.0), None),
        (Feel("afraid", BUS), FOCUS, Span(34.0, 40.0), Vehicle(1)),
        (Feel("afraid", Happens(BRAKE)), Discourse(), SPAN, BRAKED),
    ],
)
def test_feelings_are_about_what_was_spoken_of_or_the_last_seconds(
    feel: Feel, discourse: Discourse, span: Span, about: Any
) -> None:
    found = Grounded(feel, discourse)
    assert (found.notes.span, found.act.about) == (span, about)


def test_a_measure_is_of_the_moment_that_is_meant() -> None:
    just = Grounded(Ask(HowMuch(Measured("speed", time=Ago(), tense="past"))))
    assert just.act.question.of.time == At(39.0)
    assert just.notes.span == Span(39.0, 39.0, said=True)
    stopped = Grounded(Ask(HowMuch(Measured("duration", event=Event("brake")))))
    assert stopped.act.question.of.event == BRAKED.event


@pytest.mark.parametrize(
    ("spoken", "discourse", "thing", "to"),
    [
        (Measured("speed", Pronoun("it")), Discourse(question=Why(BRAKED)), Ego(), None),
        (Measured("speed", Pronoun("it")), talk(Vehicle(2)), Vehicle(2), None),
        (Measured("speed", Pronoun("one")), Discourse(), Ego(), None),
        (Measured("distance"), talk(Vehicle(2)), Ego(), Vehicle(2)),
        (Measured("distance", BUS), talk(Vehicle(2)), Vehicle(1), None),
    ],
)
def test_whose_a_measure_is(spoken: Measured, discourse: Discourse, thing: Any, to: Any) -> None:
    found = asked(HowMuch(spoken), discourse).of
    assert (found.thing, found.to) == (thing, to)


def test_how_far_it_is_is_to_the_destination_unless_somebody_was_spoken_of() -> None:
    it = Measured("distance", Pronoun("it"))
    assert asked(HowMuch(it)).of.attribute == "distance-to-go"
    assert asked(HowMuch(it), talk(Vehicle(2))).of.attribute == "distance"


def test_somebody_indefinite_may_be_several() -> None:
    some = whether(Exists(Described("vehicle", bearing="around", definite=False)))
    assert some.thing == Vehicles((2, 1, 3))  # nearest first
    assert whether(Exists(Described("vehicle", bearing="around"))).thing == Vehicle(2)


def test_how_long_something_is_so_takes_nothing_for_granted() -> None:
    for action, granted in (("follow", True), ("see", True), ("overtake", False)):
        event = Event(action, object=BUS)  # type: ignore[arg-type]
        assert Grounded(Ask(HowLong(event))).notes.presupposed is granted


def test_whether_that_is_allowed_is_of_the_speed_just_asked_for() -> None:
    speed = talk(question=HowMuch(Measured("speed")))
    found = Grounded(Ask(Whether(Is("allowed", Pronoun("that")))), speed)
    limit = Measured("limit", time=Now())
    within = Compares(Measured("speed", time=Now()), "at-most", limit)
    assert found.act == Ask(Whether(within))
    assert found.notes.leaned


def test_whether_one_may_overtake_asks_what_keeps_us_from_it() -> None:
    for action in ("overtake", "change-left", "change-lane"):
        event = Event(action, tense="present")  # type: ignore[arg-type]
        found = Grounded(Ask(Whether(Is("allowed", event=event)))).act
        assert isinstance(found, Ask)
        assert isinstance(found.question, Why)
        denied = found.question.of
        assert isinstance(denied, Not)
        assert isinstance(denied.content, Happens)
        assert denied.content.event.action == action


def test_how_close_we_came_to_anybody_is_to_nobody_in_particular() -> None:
    for whom in (Described(definite=False), Described(other=True, definite=False)):
        for of in (Measured("distance", to=whom, tense="past"),
                   Measured("distance", whom, to=Ego(), tense="past")):  # fmt: skip
            found = Grounded(Ask(HowMuch(of, "lowest"))).act
            assert isinstance(found, Ask)
            assert isinstance(found.question, HowMuch)
            assert found.question.of.thing == Ego()
            assert found.question.of.to is None
    bus = Grounded(Ask(HowMuch(Measured("distance", to=BUS, tense="past"), "lowest"))).act
    assert isinstance(bus, Ask)
    assert isinstance(bus.question, HowMuch)
    assert bus.question.of.to is not None


def test_whether_anybody_was_hidden_asks_for_all_who_were() -> None:
    for whom in (Described(definite=False), Described(other=True, definite=False)):
        found = Grounded(Ask(Whether(Is("hidden", whom, tense="past")))).act
        assert isinstance(found, Ask)
        assert isinstance(found.question, Which)
    bus = Grounded(Ask(Whether(Is("hidden", BUS, tense="past")))).act
    assert isinstance(bus, Ask)
    assert isinstance(bus.question, Whether)
