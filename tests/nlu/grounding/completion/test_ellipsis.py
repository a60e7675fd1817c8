"""Fragments and repairs: what they take from the turns before."""

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, act, did, question_of, road, talk
from xavi_dialogue.domain.answers import NotUnderstood
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Doing,
    Elliptic,
    HowDecide,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Question,
    Repair,
    WhatIf,
    When,
    Where,
    Whether,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    SOMEBODY_ELSE,
    Back,
    Between,
    Caused,
    Described,
    Ego,
    Event,
    Exists,
    Exit,
    Happens,
    Measured,
    Not,
    Now,
    Pronoun,
    Proposition,
    That,
    Thing,
    Vehicle,
)

WORLD = FakeWorld(
    {
        1: Car(20.0, kind="bus", colour="yellow"),
        2: Car(-10.0, colour="blue"),
        3: Car(30.0, 3.5, colour="red"),
    },
    (
        did("slow-down", 5.0, 7.0),
        did("give-way", 5.0, 8.0, whom=1),
        did("brake", 12.0, 13.0, who=3),
        did("slow-down", 14.0, 16.0),
        did("change-right", 15.0, 17.0, who=2, side="right"),
    ),
    facts=road("roundabout"),
)
SLOWED = Happens(Event("slow-down", time=Between(14.0, 16.0)))
MOVED = Happens(Event("change-right", Vehicle(2), side="right", time=Between(15.0, 17.0)))


def after(question: Question | None, *said: Proposition, **fields: object) -> Discourse:
    return talk(question=question, propositions=said, episode=(14.0, 16.0), **fields)


def completed(spoken: Act, discourse: Discourse) -> Question:
    found = act(spoken, WORLD, discourse)
    assert found.acts[0].leaned
    return question_of(found)


BUS = Described(kind="bus")


@pytest.mark.parametrize(
    ("before", "fragment", "meant"),
    [
        (
            HowMuch(Measured("speed", Vehicle(2), time=Now())),
            Elliptic(thing=BUS),
            HowMuch(Measured("speed", Vehicle(1), time=Now())),
        ),
        (
            HowMuch(Measured("speed", time=Now())),
            Elliptic(thing=BUS),
            HowMuch(Measured("speed", Vehicle(1), time=Now())),
        ),
        (Doing(Vehicle(2), Now()), Elliptic(thing=BUS), Doing(Vehicle(1), Now())),
        (Whither(Vehicle(2)), Elliptic(thing=Described(colour="red")), Whither(Vehicle(3))),
        (Identify(Vehicle(2)), Elliptic(thing=BUS), Identify(Vehicle(1))),
        (
            Why(Happens(Event("brake", Vehicle(2), time=Between(1.0, 2.0)))),
            Elliptic(thing=Described(colour="red")),
            Why(Happens(Event("brake", Vehicle(3), time=Between(1.0, 2.0)))),
        ),
        (
            HowMuch(Measured("speed", Vehicle(2), time=Now())),
            Elliptic(thing=Ego()),
            HowMuch(Measured("speed", Ego(), time=Now())),
        ),
        (Why(SLOWED), Elliptic(thing=BUS), Why(SLOWED, suspect=Vehicle(1))),
        (Why(SLOWED), Elliptic(SOMEBODY_ELSE), Why(SLOWED, suspect=SOMEBODY_ELSE)),
        (
            Why(SLOWED, suspect=Vehicle(1), alone=True),
            Elliptic(SOMEBODY_ELSE),
            Why(SLOWED, suspect=SOMEBODY_ELSE),
        ),
        (Doing(Ego(), Now()), Elliptic(SOMEBODY_ELSE), Listing("vehicles")),
        (
            Why(Happens(Event("leave", object=Exit(2)))),
            Elliptic(thing=Described(rank=1), form="why-not"),
            Why(Not(Happens(Event("leave", object=Exit(1))))),
        ),
        (
            HowMuch(Measured("exit-number", time=Now())),
            Elliptic(thing=Described(rank=1), form="why-not"),
            Why(Not(Happens(Event("leave", object=Exit(1))))),
        ),
        (
            Whether(Happens(Event("overtake", object=Vehicle(1), tense="future"))),
            Elliptic(form="why-not"),
            Why(Not(Happens(Event("overtake", object=Vehicle(1), tense="future")))),
        ),
        (Why(SLOWED), Elliptic(form="what-if", negated=True), WhatIf(Not(SLOWED))),
        (Why(SLOWED), Elliptic(form="when"), When(SLOWED)),
        (Why(SLOWED), Elliptic(form="where"), Where(SLOWED.event)),
        (Why(SLOWED), Elliptic(form="how"), HowDecide(SLOWED)),
        (Why(SLOWED), Elliptic(besides=True), Listing("reasons")),
        (
            WhatIf(Not(Exists(Vehicle(1)))),
            Elliptic(thing=Described(colour="red")),
            WhatIf(Not(Exists(Vehicle(3)))),
        ),
    ],
)
def test_a_fragment_is_completed(before: Question, fragment: Elliptic, meant: Question) -> None:
    found = completed(fragment, after(before))
    assert _timeless(found) == _timeless(meant)


def _timeless(question: Question) -> Question:
    from msgspec.structs import replace

    from xavi_dialogue.domain.rewriting import rewrite
    from xavi_dialogue.domain.terms import Unsaid

    def change(part: object) -> object:
        if hasattr(part, "time") and part.time != Unsaid():
            return rewrite(replace(part, time=Unsaid()), change)  # type: ignore[type-var]
        return part

    return rewrite(question, change)


def test_before_that_is_before_what_was_spoken_of() -> None:
    found = completed(Elliptic(time=Back("before")), after(Why(SLOWED)))
    assert isinstance(found, Doing)
    assert found.time == Between(6.0, 13.8)


def test_a_bare_why_of_nothing_is_of_what_we_are_doing() -> None:
    plain = Why(Happens(Event("do", time=Now(), tense="present")))
    nothing = FakeWorld({}, ())
    assert question_of(act(Elliptic(form="why"), nothing, Discourse())) == plain
    for other in (Elliptic(form="why-not"), Elliptic(form="why", negated=True)):
        found = act(other, nothing, Discourse())
        assert not any(isinstance(one.act, Ask) for one in found.acts)


def test_a_bare_why_goes_to_what_was_said_last() -> None:
    assert completed(Elliptic(form="why"), after(Why(SLOWED), MOVED)) == Why(MOVED)


def test_had_he_not_is_about_what_he_did() -> None:
    hadnt = Elliptic(thing=Pronoun("he"), form="what-if", negated=True)
    discourse = after(Why(SLOWED), MOVED)
    found = act(hadnt, WORLD, _with(discourse, Vehicle(2)))
    assert question_of(found).supposed == Not(MOVED)  # type: ignore[union-attr]


def test_had_he_not_is_found_in_the_record_where_nobody_said() -> None:
    hadnt = Elliptic(thing=Pronoun("he"), form="what-if", negated=True)
    found = act(hadnt, WORLD, _with(after(Why(SLOWED)), Vehicle(3)))
    supposed = question_of(found).supposed  # type: ignore[union-attr]
    assert (supposed.content.event.action, supposed.content.event.actor) == ("brake", Vehicle(3))


def _with(discourse: Discourse, thing: Thing) -> Discourse:
    from msgspec.structs import replace

    return replace(discourse, mentions=talk(thing).mentions)


def test_how_sure_is_about_what_was_said_last() -> None:
    found = completed(Elliptic(form="sure"), after(Why(SLOWED), MOVED))
    assert found == HowSure(MOVED)
    assert question_of(act(Ask(HowSure()), WORLD, after(Why(SLOWED), MOVED))) == HowSure(MOVED)


def test_which_one_is_the_one_spoken_of() -> None:
    found = act(Elliptic(form="which"), WORLD, _with(after(Why(SLOWED)), Vehicle(3)))
    assert question_of(found) == Identify(Vehicle(3))


def test_so_it_was_the_bus_is_about_what_was_asked() -> None:
    found = act(Claim(Caused(BUS)), WORLD, after(Why(SLOWED)))
    assert found.acts[0].act == Claim(Caused(Vehicle(1), SLOWED))
    assert found.acts[0].leaned


def test_do_that_is_what_was_spoken_of() -> None:
    done = Why(Happens(Event("do", Pronoun("it"), object=Pronoun("that"))))
    found = act(Ask(done), WORLD, _with(after(Identify(Vehicle(2)), MOVED), Vehicle(2)))
    assert question_of(found).of.event.action == "change-right"  # type: ignore[union-attr]


def test_that_is_what_was_said() -> None:
    found = act(Ask(Whether(That())), WORLD, after(None, MOVED))
    assert question_of(found) == Whether(MOVED)


def test_a_fragment_alone_asks_what_it_is_or_is_not_understood() -> None:
    assert question_of(act(Elliptic(thing=BUS), WORLD)) == Identify(Vehicle(1))
    world = FakeWorld()
    assert isinstance(act(Elliptic(form="when"), world).refusal, NotUnderstood)


# --- repairs ------------------------------------------------------------------------------------

OFFERS: tuple[Act, ...] = (
    Ask(HowMuch(Measured("speed", Vehicle(2), time=Now()))),
    Ask(HowMuch(Measured("speed", Vehicle(3), time=Now()))),
)
OPEN = talk(
    offered=OFFERS,
    offered_things=(Vehicle(2), Vehicle(3)),
    pending=Ask(HowMuch(Measured("speed", Described(kind="car")))),
)


@pytest.mark.parametrize(
    ("reply", "chosen"),
    [
        (Repair("pick", pick=2), 1),
        (Repair("pick", pick=-1), 1),
        (Elliptic(thing=Described(rank=1)), 0),
        (Elliptic(thing=Described(colour="red")), 1),
        (Elliptic(thing=Described(bearing="behind")), 0),
        (Elliptic(thing=Vehicle(3)), 1),
        (Repair("meant", thing=Described(colour="blue")), 0),
        (Repair("pick", thing=Described(colour="red")), 1),
        (Elliptic(thing=Described(extreme="nearest")), 0),
    ],
)
def test_a_reply_chooses_what_was_offered(reply: Act, chosen: int) -> None:
    found = act(reply, WORLD, OPEN)
    assert found.acts[0].act == OFFERS[chosen]
    assert found.acts[0].leaned


def test_a_chosen_vehicle_completes_the_act_that_waits() -> None:
    waiting = talk(offered_things=(Vehicle(2), Vehicle(3)), pending=OPEN.pending)
    found = act(Elliptic(thing=Described(rank=2)), WORLD, waiting)
    assert question_of(found) == HowMuch(Measured("speed", Vehicle(3), time=Now()))


def test_yes_takes_the_only_offer() -> None:
    one = talk(offered=OFFERS[:1])
    assert act(Repair("yes"), WORLD, one).acts[0].act == OFFERS[0]


def test_a_yes_to_nothing_stays_what_it_is() -> None:
    found = act(Repair("yes"), WORLD)
    assert found.acts[0].act == Repair("yes")
    assert not found.acts[0].leaned


def test_a_correction_asks_again_of_the_other_one() -> None:
    speed = HowMuch(Measured("speed", Vehicle(2), time=Now()))
    found = act(Repair("correct", thing=Described(colour="red")), WORLD, after(speed))
    assert question_of(found) == HowMuch(Measured("speed", Vehicle(3), time=Now()))
    car = act(
        Repair("correct", thing=Described(kind="car")), WORLD, _with(after(speed), Vehicle(2))
    )
    assert question_of(car) == HowMuch(Measured("speed", Vehicle(3), time=Now()))


def test_a_question_that_was_meant_is_asked() -> None:
    meant = Repair("meant", question=Whither(BUS))
    assert question_of(act(meant, WORLD, after(Why(SLOWED)))) == Whither(Vehicle(1))
