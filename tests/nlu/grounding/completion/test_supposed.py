"""Questions of another time, and suppositions, completed by what was spoken of."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.completion.test_completion import WHY, completed
from tests.nlu.grounding.completion.test_discussed import SLOWED, grounder
from tests.nlu.grounding.fakes import talk
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Changed,
    Doing,
    Elliptic,
    HowLong,
    HowMuch,
    HowSure,
    Peak,
    Question,
    Summarise,
    WhatIf,
    When,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Back,
    Between,
    Described,
    Ego,
    Event,
    Exists,
    Exit,
    Happens,
    Is,
    Junction,
    Measured,
    Next,
    Nobody,
    Not,
    Now,
    Pronoun,
    Related,
    Relative,
    That,
    Vehicle,
    Wanted,
    Within,
)
from xavi_dialogue.nlu.grounding.acts.follow_ups import followed
from xavi_dialogue.nlu.grounding.acts.questions import question as ground_question
from xavi_dialogue.nlu.grounding.completion.moving import at_another_time, counted_from
from xavi_dialogue.nlu.grounding.completion.supposing import (
    of_named,
    of_nobody,
    subordinate,
    through,
)

TURN = HowMuch(Measured("turn", to=Junction(rank=2), time=Next(), tense="future"))
AFTER, BEFORE = Back("after"), Back("before")


@pytest.mark.parametrize(
    ("time", "question", "found"),
    [
        (Now(), WHY, Doing(Ego())),
        (Now(), Peak("danger"), Doing(Ego())),
        (Now(), Doing(Vehicle(1)), None),
        (BEFORE, WHY, Doing(None, BEFORE, "past")),
        (BEFORE, Changed(), Doing(None, BEFORE, "past")),
        (BEFORE, Doing(), None),
        (Next(), HowMuch(Measured("turn")), TURN),
        (Next(), TURN, replace(TURN, of=replace(TURN.of, to=Junction(rank=3)))),
        (Next(), Whither(), TURN),
        (Next(), Whether(Happens(Event("turn", tense="future"))), TURN),
        (AFTER, Doing(tense="past"), Doing(None, AFTER, "past")),
        (AFTER, Summarise(), Doing(None, AFTER, "past")),
        (Next(), Summarise(), None),
        (Next(), Doing(Vehicle(1), tense="present"), None),
        (AFTER, WHY, Doing(None, AFTER, "past")),
        (AFTER, Whether(Happens(Event("turn", Vehicle(1), tense="present"))),
         Doing(Ego(), Next(), "future")),
        (Next(), Doing(Ego(), tense="present"), Doing(Ego(), Next(), "future")),
        (Next(), Why(Not(Happens(Event("turn", tense="present")))),
         Whether(Happens(Event("turn", tense="future", modal="will")))),
        (Within(5.0), Why(Not(Happens(Event("turn", tense="present")))),
         Whether(Happens(Event("turn", tense="future", modal="will")))),
        (Relative("after", Vehicle(1)), Why(Not(Happens(Event("turn", tense="present")))),
         Whether(Happens(Event("turn", tense="future", modal="will")))),
        (Relative("before", Vehicle(1)), Why(Not(Happens(Event("turn", tense="present")))), None),
        (Within(5.0), WHY, None),
        (At(3.0), WHY, None),
    ],
)  # fmt: skip
def test_another_time_may_ask_another_question(time: Any, question: Question, found: Any) -> None:
    assert at_another_time(time, question) == found


@pytest.mark.parametrize(
    ("time", "found"),
    [
        (BEFORE, Between(6.0, 13.95)),
        (AFTER, Between(16.05, 24.0)),
        (Back("during"), Between(14.0, 16.0)),
        (At(3.0), At(3.0)),
    ],
)
def test_before_that_is_counted_from_what_was_asked_about(time: Any, found: Any) -> None:
    assert counted_from(time, WHY) == found
    assert counted_from(time, Summarise()) == time
    early = Why(Happens(replace(SLOWED, time=Between(3.0, 4.0))))
    assert counted_from(BEFORE, early) == Between(0.0, 2.95)


SIDE = Event("change-right", tense="present")
HOLDS_UP = Which(Wanted(), Happens(Event("block", Wanted(), Ego(), modal="would")))
SUPPOSED = talk(question=WhatIf(Not(Happens(SLOWED))))


@pytest.mark.parametrize(
    ("spoken", "discourse", "supposed"),
    [
        (Whether(Happens(Event("collide", modal="would"))), SUPPOSED, Not(Happens(SLOWED))),
        (Whether(Not(Happens(Event("collide", modal="would")))), SUPPOSED, Not(Happens(SLOWED))),
        (When(Happens(Event("arrive", modal="would"))), SUPPOSED, Not(Happens(SLOWED))),
        (Whether(Happens(Event("stop", modal="could"))), SUPPOSED, Not(Happens(SLOWED))),
        (Whether(Happens(Event("brake", modal="can"))), SUPPOSED, Not(Happens(SLOWED))),
        (Whether(Happens(Event("turn", modal="could"))), SUPPOSED, None),
        (Whether(Happens(Event("collide"))), SUPPOSED, None),
        (Whether(Happens(replace(SLOWED, modal="would"))), SUPPOSED, None),  # it is the same
        (Whether(Happens(Event("collide", modal="would"))), Discourse(), None),
        (
            Whether(Happens(Event("collide", modal="would"))),
            talk(question=Whether(Happens(Event("turn", modal="could")))),
            Happens(Event("turn", tense="perfect")),
        ),
        (
            Whether(Happens(Event("collide", modal="would"))),
            talk(question=Why(Not(Happens(Event("turn", modal="should"))))),
            Happens(Event("turn", tense="perfect")),
        ),
        (Why(Happens(Event("collide", modal="would"))), SUPPOSED, None),
        (HOLDS_UP, Discourse(option=SIDE), Happens(SIDE)),  # "who would be in our way there?"
        (HOLDS_UP, Discourse(), None),
    ],
)
def test_what_would_have_come_is_of_what_was_supposed(
    spoken: Question, discourse: Discourse, supposed: Any
) -> None:
    g = grounder(discourse)
    assert subordinate(spoken, g) == (spoken if supposed is None else WhatIf(supposed, spoken))
    assert g.notes.leaned is (supposed is not None)


UNREAL = HowMuch(Measured("delay", event=Event("do", modal="would")))
COST = HowMuch(Measured("delay", Pronoun("that")))
NO_CAR = Not(Exists(Vehicle(1)))


@pytest.mark.parametrize(
    ("spoken", "discourse", "supposed"),
    [
        (UNREAL, Discourse(option=SIDE), Happens(SIDE)),  # "how much time would that cost?"
        (HowLong(That()), Discourse(option=SIDE, decided=Event("continue")), Happens(SIDE)),
        (HowLong(That()), Discourse(option=SIDE), None),  # nothing was weighed
        (COST, talk(question=WhatIf(Not(Exists(Vehicle(1), time=Now())))), NO_CAR),
        (COST, talk(question=WhatIf(Not(Happens(SLOWED)))), None),
        (COST, talk(question=WHY), None),
    ],
)
def test_what_time_it_takes_is_of_the_option_or_absence_spoken_of(
    spoken: Question, discourse: Discourse, supposed: Any
) -> None:
    found = subordinate(spoken, grounder(discourse))
    delay = HowMuch(Measured("delay"))
    assert found == (spoken if supposed is None else WhatIf(supposed, delay))


def test_what_time_it_would_take_is_at_no_time_of_the_ride() -> None:
    g = grounder(Discourse())
    asked = WhatIf(Happens(SIDE), HowMuch(Measured("delay")))
    grounded = ground_question(asked, g)
    assert isinstance(grounded, WhatIf)
    assert (grounded.then, g.notes.span) == (asked.then, None)


COLLIDES = HowSure(Happens(Event("collide", modal="would")))


@pytest.mark.parametrize(
    "spoken",
    [
        COLLIDES,
        HowSure(Happens(Event("collide", tense="present"))),
        HowSure(Is("wrong", Pronoun("that"))),
        Why(Is("dangerous", Pronoun("that"))),
    ],
)
def test_a_risk_is_that_of_the_option_spoken_of(spoken: Question) -> None:
    option = Event("change-left", tense="present")
    weighed = Discourse(option=option, decided=Event("continue", tense="present"))
    assert subordinate(spoken, grounder(discourse=weighed)) == WhatIf(Happens(option), COLLIDES)
    assert subordinate(spoken, grounder(discourse=Discourse())) == spoken


@pytest.mark.parametrize(
    "spoken",
    [
        Which(Wanted(), Is("dangerous", Wanted())),
        Which(Wanted(), Related("with", Pronoun("that"), Wanted())),
    ],
)
def test_who_is_the_danger_is_asked_of_the_option_spoken_of(spoken: Question) -> None:
    option = Event("change-left", tense="present")
    whom = Which(
        Wanted(), Happens(Event("collide", object=Wanted(), tense="present", modal="might"))
    )
    weighed = Discourse(option=option)
    assert subordinate(spoken, grounder(discourse=weighed)) == WhatIf(Happens(option), whom)
    assert subordinate(spoken, grounder(discourse=Discourse())) == whom


def test_how_likely_that_is_is_asked_of_what_was_supposed() -> None:
    option = Event("change-left", tense="present")
    supposed = Discourse(option=option, question=WhatIf(Happens(option)))
    asked = subordinate(HowSure(), grounder(discourse=supposed))
    assert asked == WhatIf(Happens(option), HowSure())
    assert ground_question(asked, grounder(discourse=supposed)).then == HowSure()
    chosen = Discourse(option=option, question=Why(Not(Happens(option))))
    assert subordinate(HowSure(), grounder(discourse=chosen)) == HowSure()


def test_that_for_which_we_do_not_is_what_was_told_of_us() -> None:
    option = Event("stop", time=At(4.0), modal="would")
    told = HowMuch(Measured("delay"))
    spoken = Why(That(), suspect=Pronoun("that"))
    reason = Why(Not(Happens(Event("stop", time=At(4.0)))))
    weighed = Discourse(option=option, question=told)
    assert followed(spoken, grounder(discourse=weighed)) == reason
    done = Why(Not(Happens(Event("do"))), suspect=Pronoun("that"))
    assert followed(done, grounder(discourse=weighed)) == reason
    of_car = Discourse(option=option, question=HowMuch(Measured("speed", Vehicle(1))))
    found = followed(spoken, grounder(discourse=of_car))
    assert isinstance(found, Why)
    assert found.suspect == Pronoun("that")


def test_through_a_place() -> None:
    left = Happens(Event("leave", Vehicle(1), object=Exit(1), time=At(3.0)))
    assert through(Exit(2), left) == Happens(Event("leave", object=Exit(2), time=At(3.0)))
    assert through(Exit(2), Happens(SLOWED)) == Happens(Event("leave", object=Exit(2)))
    ring = Junction("roundabout")
    assert through(ring, None) == Happens(Event("enter", object=ring))


@pytest.mark.parametrize(
    ("fragment", "question", "supposed"),
    [
        (Elliptic(form="what-if", event=Event("stop")), WHY, Happens(Event("stop"))),
        (Elliptic(form="what-if", event=Event("stop"), negated=True), WHY,
         Not(Happens(Event("stop")))),
        (Elliptic(form="what-if", event=Event("stop"), thing=Vehicle(1)), WHY,
         Happens(Event("stop", Vehicle(1)))),
        (Elliptic(form="what-if"), WHY, Not(Happens(SLOWED))),
        (Elliptic(form="what-if"), WhatIf(Happens(SLOWED)), Happens(SLOWED)),
        (Elliptic(form="what-if", thing=Vehicle(3)), WHY,
         Happens(Event("brake", Vehicle(3), time=Between(12.0, 13.0)))),
        (Elliptic(form="what-if", thing=Vehicle(3), negated=True), WHY,
         Not(Happens(Event("brake", Vehicle(3), time=Between(12.0, 13.0))))),
        (Elliptic(form="what-if", thing=Vehicle(2)), WHY, Not(Exists(Vehicle(2)))),
        (Elliptic(form="what-if", thing=Exit(2)), WHY, Happens(Event("leave", object=Exit(2)))),
    ],
)  # fmt: skip
def test_a_fragment_may_suppose_something(
    fragment: Elliptic, question: Question, supposed: Any
) -> None:
    assert completed(fragment, question).supposed == supposed


def test_a_further_supposition_is_asked_of_what_was_asked_before() -> None:
    then = Whether(Happens(Event("collide", modal="would")))
    asked = WhatIf(Not(Happens(SLOWED)), then)
    found = completed(Elliptic(form="what-if", thing=Vehicle(2)), asked)
    assert found == WhatIf(Not(Exists(Vehicle(2))), then)


def test_what_would_have_happened_is_at_no_time_of_the_ride() -> None:
    then = Doing(None, tense="past")
    g = grounder(Discourse())
    asked = WhatIf(Happens(Event("keep-lane", tense="perfect")), then)
    grounded = ground_question(asked, g)
    assert isinstance(grounded, WhatIf)
    assert grounded.then == then
    assert g.notes.span is None or not g.notes.span.said


VAN = Described("van")


def hits(actor: Any, thing: Any) -> Whether:
    return Whether(Happens(Event("collide", actor, thing, modal="would")))


def goes_on(actor: Any) -> Happens:
    return Happens(Event("continue", actor, tense="perfect"))


@pytest.mark.parametrize("then", [hits(Ego(), VAN), hits(VAN, Ego())])
def test_it_is_the_vehicle_of_the_main_clause(then: Whether) -> None:
    for form in ("it", "he", "she"):
        found = of_named(WhatIf(goes_on(Pronoun(form)), then))  # type: ignore[arg-type]
        assert found == WhatIf(goes_on(VAN), then)
    denied = of_named(WhatIf(Not(goes_on(Pronoun("it"))), then))
    assert denied == WhatIf(Not(goes_on(VAN)), then)


@pytest.mark.parametrize(
    ("actor", "then"),
    [
        (Pronoun("it"), None),
        (Pronoun("it"), Doing()),
        (Pronoun("it"), hits(Pronoun("it"), VAN)),
        (Pronoun("it"), hits(Ego(), Vehicle(2))),
        (Pronoun("it"), hits(Ego(), Described("van", definite=False))),
        (Pronoun("they"), hits(Ego(), VAN)),
        (Ego(), hits(Ego(), VAN)),
    ],
)
def test_elsewhere_a_pronoun_stays(actor: Any, then: Any) -> None:
    asked = WhatIf(goes_on(actor), then)
    assert of_named(asked) == asked


CARS = Described("car", plural=True, definite=False)


@pytest.mark.parametrize(
    ("supposed", "those"),
    [
        (Happens(Event("cross", Nobody(), tense="past")), Described("pedestrian", plural=True)),
        (
            Happens(Event("come", Nobody(CARS), tense="past")),
            replace(CARS, doing=Event("come", Wanted("car"), tense="past")),
        ),
        (
            Happens(Event("cross", Nobody(CARS), tense="past")),
            replace(CARS, doing=Event("cross", Wanted("car"), tense="past")),
        ),
        (
            Related("behind", Nobody(), tense="past"),
            Described(such=Related("behind", Wanted()), plural=True, definite=False),
        ),
    ],
)
def test_that_nobody_does_something_is_the_absence_of_those_who_do(
    supposed: Any, those: Described
) -> None:
    assert of_nobody(supposed) == Not(Exists(those, tense="past"))


@pytest.mark.parametrize(
    "supposed",
    [
        Happens(Event("give-way", Nobody(), tense="past")),
        Happens(Event("cross", Vehicle(1), tense="past")),
        Related("in-the-way-of", Nobody(), tense="past"),
        Exists(Nobody()),
    ],
)
def test_other_suppositions_stay(supposed: Any) -> None:
    assert of_nobody(supposed) == supposed
