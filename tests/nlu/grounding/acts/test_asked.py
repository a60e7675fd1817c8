"""Questions and propositions grounded: things, times, and what is noted beside them."""

from typing import Any

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, did, talk
from xavi_dialogue.domain.discourse import Discourse, Span
from xavi_dialogue.domain.meaning import (
    Ask,
    Claim,
    Compare,
    Doing,
    Fault,
    HowAvoid,
    HowDecide,
    HowKnow,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Peak,
    Question,
    Summarise,
    WhatIf,
    WhatWouldChange,
    When,
    Where,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Described,
    Event,
    Exists,
    Happens,
    Is,
    Measured,
    Nobody,
    Not,
    Now,
    Pronoun,
    That,
    Vehicle,
    Vehicles,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.acts.acts import act as ground_act
from xavi_dialogue.nlu.grounding.context import Context, Notes
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

CARS = {
    1: Car(20.0, kind="bus", colour="yellow"),
    2: Car(-15.0, colour="red"),
    3: Car(40.0, 3.5, kind="truck", colour="white"),
}
DEEDS = (
    did("brake", 5.0, 7.0),
    did("give-way", 12.0, 15.0, whom=1),
    did("brake", 12.0, 14.0),
    did("brake", 30.0, 31.0, who=2),
)
BUS, RED = Described("bus"), Described(colour="red")
BRAKED = Happens(Event("brake", time=Between(12.0, 14.0)))
SPAN = Span(12.0, 14.0)
FOCUS = talk(question=Why(BRAKED), episode=(12.0, 14.0), asked_at=39.0)


class Grounded:
    """An act grounded at 40 s, and what was noted."""

    def __init__(self, spoken: Any, discourse: Discourse | None = None, *happened: Any) -> None:
        world = FakeWorld(CARS, happened or DEEDS, now=40.0)
        g = TermGrounder(Context(world, discourse or Discourse()))
        self.act: Any = ground_act(spoken, g)
        self.notes: Notes = g.notes


def asked(question: Question, discourse: Discourse | None = None, *happened: Any) -> Any:
    found = Grounded(Ask(question), discourse, *happened)
    assert isinstance(found.act, Ask)
    return found.act.question


def whether(that: Any, discourse: Discourse | None = None) -> Any:
    return asked(Whether(that), discourse).that


BRAKE = Event("brake")


def test_who_is_suspected_has_to_do_with_the_event() -> None:
    found = asked(Why(Happens(BRAKE), suspect=BUS, rival=RED))
    assert found == Why(BRAKED, suspect=Vehicle(1), rival=Vehicle(2))
    assert asked(Why(Happens(BRAKE), suspect=Nobody())) == Why(BRAKED)
    instead = asked(Why(Happens(BRAKE), instead=Happens(Event("overtake", object=BUS))))
    assert instead.instead == Happens(Event("overtake", object=Vehicle(1)))
    vague = asked(Why(Happens(BRAKE), suspect=Described()))
    assert vague.suspect == Vehicle(1)


def test_taking_somebody_for_the_cause_of_nothing_costs() -> None:
    blamed = Ask(Why(That(), suspect=BUS))
    told = talk(question=Identify(Vehicle(2)), propositions=(BRAKED,))
    assert Grounded(blamed, told).notes.cost == pytest.approx(0.2)
    assert Grounded(blamed, talk(question=Why(BRAKED), propositions=(BRAKED,))).notes.cost == 0.0


@pytest.mark.parametrize(
    ("then", "grounded"),
    [
        (Whether(Happens(Event("overtake", object=BUS))),
         Whether(Happens(Event("overtake", object=Vehicle(1))))),
        (When(Happens(Event("arrive"))), When(Happens(Event("arrive")))),
        (Why(Happens(Event("overtake", object=BUS))),
         Why(Happens(Event("overtake", object=Vehicle(1))))),
        (HowMuch(Measured("speed", BUS)), HowMuch(Measured("speed", Vehicle(1), time=Now()))),
    ],
)  # fmt: skip
def test_what_is_asked_of_a_supposition_is_supposed_too(then: Any, grounded: Any) -> None:
    found = asked(WhatIf(Not(Happens(Event("stop"))), then))
    assert found == WhatIf(Not(Happens(Event("stop"))), grounded)


def test_a_supposition_is_about_what_was_spoken_of() -> None:
    stopped = Ask(WhatIf(Not(Happens(Event("stop")))))
    assert Grounded(stopped, FOCUS).notes.span == SPAN
    assert Grounded(stopped).notes.span is None
    assert asked(WhatIf(Not(Exists(BUS)))).supposed.content.thing == Vehicle(1)


@pytest.mark.parametrize(
    ("question", "found"),
    [
        (Identify(BUS), Identify(Vehicle(1))),
        (HowMany(Event("brake")), HowMany(Event("brake", time=WholeRide()))),
        (HowMany(Event("brake", tense="perfect")),
         HowMany(Event("brake", time=WholeRide(), tense="perfect"))),
        (Compare((Vehicles((1, 2)), RED), by="speed"),
         Compare((Vehicle(1), Vehicle(2), Vehicle(2)), by="speed")),
        (Compare((Happens(Event("overtake", object=BUS)), Happens(Event("stop"))), by="time"),
         Compare((Happens(Event("overtake", object=Vehicle(1))), Happens(Event("stop"))),
                 by="time")),
        (HowLong(Is("stationary", BUS)), HowLong(Is("stationary", Vehicle(1), time=Now()))),
        (HowLong(Event("brake")), HowLong(BRAKED.event)),
        (HowDecide(Happens(BRAKE)), HowDecide(BRAKED)),
        (HowDecide(), HowDecide()),
        (HowKnow(Happens(BRAKE)), HowKnow(BRAKED)),
        (HowKnow(), HowKnow()),
        (WhatWouldChange(Happens(BRAKE)), WhatWouldChange(BRAKED)),
        (WhatWouldChange(), WhatWouldChange()),
        (WhatWouldChange(most=True), WhatWouldChange(BRAKED, most=True)),
        (Where(Event("brake")), Where(BRAKED.event)),
        (Where(Event("brake"), At(6.0)), Where(Event("brake", time=Between(5.0, 7.0)))),
        (Where(BUS), Where(Vehicle(1), Now())),
        (Where(BUS, At(6.0)), Where(Vehicle(1), At(6.0))),
        (Whither(BUS), Whither(Vehicle(1))),
        (Whither(BUS, At(6.0)), Whither(Vehicle(1), At(6.0))),
        (Peak("danger"), Peak("danger", WholeRide())),
        (Summarise(Event("give-way")),
         Summarise(Event("give-way", time=Between(12.0, 15.0)), time=Between(12.0, 15.0))),
        (Summarise(BUS), Summarise(Vehicle(1), time=WholeRide())),
        (Listing("events"), Listing("events", time=WholeRide())),
        (Listing("beliefs", BUS), Listing("beliefs", Vehicle(1), time=WholeRide())),
        (Doing(BUS, tense="present"), Doing(Vehicle(1), Now(), "present")),
        (Doing(besides=Happens(BRAKE)), Doing(besides=BRAKED, time=Now(), tense="present")),
    ],
)  # fmt: skip
def test_questions(question: Question, found: Question) -> None:
    assert asked(question) == found


def test_unless_it_is_asked_of_the_present_an_extreme_is_of_the_whole_ride() -> None:
    fastest = Measured("speed", tense="past")
    assert asked(HowMuch(fastest, extreme="highest")).of.time == WholeRide()
    now = asked(HowMuch(Measured("speed"), extreme="highest")).of
    assert now.time == Now()


def test_how_many_vehicles() -> None:
    found = asked(HowMany(Described("car")))
    assert found.of == Vehicle(2)
    assert found.such == Described("car", plural=True, definite=False)
    gave = Described(plural=True, doing=Event("give-way", object=Wanted(), tense="past"))
    assert asked(HowMany(gave)).of == Vehicle(1)
    assert asked(HowMany(Pronoun("it")), talk(Vehicle(2))).of == Vehicle(2)


def test_when_that_was_is_when_it_came_about() -> None:
    told = talk(propositions=(Happens(Event("stop", modal="would")), BRAKED))
    found = Grounded(Ask(When(That())), told)
    assert found.act == Ask(When(BRAKED))
    assert found.notes.leaned


def test_what_is_asked_bare_is_of_what_was_asked_before() -> None:
    for question in (WhatWouldChange(), HowAvoid()):
        found = Grounded(Ask(question), FOCUS)
        assert found.act.question.of == BRAKED
        assert (found.notes.leaned, found.notes.span) == (True, SPAN)
    denied = talk(question=Why(Not(BRAKED)))
    assert asked(WhatWouldChange(), denied).of == BRAKED
    known = Grounded(Ask(HowKnow()), FOCUS)
    assert known.act == Ask(HowKnow(BRAKED))
    assert (known.notes.leaned, known.notes.span) == (True, SPAN)
    sure = Grounded(Ask(HowSure(time=At(6.0))), FOCUS)
    assert sure.act == Ask(HowSure(BRAKED, time=At(6.0)))
    nothing = Grounded(Ask(HowKnow()))
    assert (nothing.act, nothing.notes.leaned) == (Ask(HowKnow()), False)


def test_where_somebody_goes_at_a_time_is_of_that_time() -> None:
    assert Grounded(Ask(Whither(BUS, At(6.0)))).notes.span == Span(6.0, 6.0, said=True)
    assert Grounded(Ask(Whither(BUS))).notes.span is None


def test_nobody_need_have_set_off_to_be_asked_where_he_goes() -> None:
    away = Grounded(Ask(Where(Event("go", BUS, tense="past"))))
    assert away.notes.presupposed
    stopped = Grounded(Ask(Where(Event("stop", BUS, tense="past"))))
    assert not stopped.notes.presupposed


def test_whose_fault_it_was() -> None:
    gave = Happens(Event("give-way", object=Vehicle(1), time=Between(12.0, 15.0)))
    assert asked(Fault(Happens(BRAKE), suspect=BUS)) == Fault(BRAKED, suspect=Vehicle(1))
    braked = Grounded(Ask(Fault()), FOCUS)
    assert braked.act.question.of == BRAKED
    assert (braked.notes.leaned, braked.notes.span) == (True, SPAN)
    hindered = Grounded(Ask(Fault()), talk(episode=(14.5, 15.0)))
    assert hindered.act.question.of == gave
    assert hindered.notes.span == Span(12.0, 15.0)
    assert asked(Fault()).of is None
    would = talk(question=Whether(Happens(Event("stop", time=At(5.0), modal="would"))))
    found = Grounded(Ask(Fault()), would)
    assert found.act.question.of is None
    assert not found.notes.leaned
    blamed = Grounded(Claim(Is("at-fault", BUS)))
    assert blamed.act == Ask(Fault(suspect=Vehicle(1)))


def test_which_of_them() -> None:
    found = asked(Which(Described("bus"), Happens(Event("brake", Wanted())), among=(BUS, RED)))
    assert found.among == (Vehicle(1), Vehicle(2))
    assert found.thing == Vehicle(1)
    plain = asked(Which(Described("bus")))
    assert plain.thing == Vehicle(1)
