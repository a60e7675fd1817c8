"""Questions whose words leave open what is asked: taken by what goes on and what was said."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.fakes import Car, FakeWorld, did, talk
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Compare,
    Doing,
    HowDecide,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    When,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    Ago,
    Back,
    Between,
    Both,
    Compares,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Is,
    Measured,
    Next,
    Nobody,
    Not,
    Now,
    Pronoun,
    Rank,
    Related,
    Road,
    Start,
    That,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.acts.others import asked_who, of_others
from xavi_dialogue.nlu.grounding.acts.recasting import (
    halting,
    of_nobody,
    recast,
    something_wrong,
    within_limit,
)
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

CARS = {1: Car(20.0, colour="red")}
QUIET = FakeWorld(CARS, (did("slow-down", 10.0, 14.0), did("change-left", 16.0, 18.0)), now=40.0)
BEGUN = FakeWorld(CARS, (did("brake", 38.0, going_on=True),), now=40.0)
HALTED = FakeWorld(CARS, (did("stop", 30.0, going_on=True),), now=40.0)
NEAR = Is("close", Vehicle(1))
IT, THAT = Pronoun("it"), Pronoun("that")
SPEED = Measured("speed")
OUR_WAY = Related("on", Ego(), Road("fitting"))
NOBODY = Discourse()


def grounder(world: FakeWorld = QUIET, discourse: Discourse = NOBODY) -> TermGrounder:
    return TermGrounder(Context(world, discourse))


def after(question: Any, **more: Any) -> Discourse:
    return talk(question=question, **more)


ABOUT_SPEED = after(HowMuch(SPEED))
ABOUT_WAY = after(HowMuch(Measured("turn")))
ABOUT_ARRIVAL = after(HowMuch(Measured("time-to-go")))
ABOUT_LANES = after(HowMuch(Measured("lane")))
BELIEF = HowSure(Happens(Event("exit-right", Vehicle(1), tense="future")))
ABOUT_BELIEF = after(BELIEF)
FASTER = Compares(SPEED, "more", Measured("speed", Vehicle(1)))
SPEEDING = Compares(SPEED, "more", Measured("limit"))
SUCH = Described(plural=True, definite=False)


@pytest.mark.parametrize(
    ("spoken", "said", "meant"),
    [
        # What we did.
        (Doing(None, tense="past"), NOBODY, Doing(None, Between(16.0, 18.0), "past")),
        (Doing(None, Back("before"), "past"), NOBODY, None),
        (Doing(Ego(), Back("after"), "future"), NOBODY, Doing(Ego(), Next(), "future")),
        (Doing(Ego(), Back("after"), "present"), NOBODY, None),
        (Doing(Ego(), Rank(1), "past"), NOBODY, Doing(Ego(), Start(), "past")),
        (Doing(Ego(), Rank(2), "past"), NOBODY, None),
        # "And what is it now?"
        (
            Identify(IT),
            after(HowMuch(replace(SPEED, time=WholeRide(), tense="past"))),
            HowMuch(replace(SPEED, tense="present")),
        ),
        (Identify(IT), NOBODY, None),
        (Identify(IT), after(HowMuch(SPEED, "highest")), None),
        (Identify(IT), after(HowMuch(Measured("speed", Vehicle(1)))), None),
        # "Is that the one on the right?"
        (
            Whether(Related("right-of", THAT, Ego())),
            ABOUT_WAY,
            Whether(Happens(Event("exit-right", tense="present"))),
        ),
        (
            Whether(Related("left-of", IT, Ego())),
            ABOUT_WAY,
            Whether(Happens(Event("exit-left", tense="present"))),
        ),
        (Whether(Related("right-of", THAT, Ego())), ABOUT_SPEED, None),
        # "How many are there?"
        (HowMany(SUCH), ABOUT_LANES, HowMuch(Measured("lane-count"))),
        (HowMany(SUCH), ABOUT_SPEED, None),
        (HowMany(replace(SUCH, colour="red")), ABOUT_LANES, None),
        # Which way, and how far.
        (Whether(Is("lost", Ego())), NOBODY, Whether(Not(OUR_WAY, lexical=True))),
        (Whether(Not(Is("astray", Ego()))), NOBODY, Whether(OUR_WAY)),
        (
            Whether(Happens(Event("head", object=Road("wrong"))), tag=True),
            NOBODY,
            Whether(Not(OUR_WAY, lexical=True), tag=True),
        ),
        (Whether(Is("lost", Vehicle(1))), NOBODY, None),
        (Whether(Related("same-as", Ego(), Road())), NOBODY, Whether(OUR_WAY)),
        (
            HowDecide(Happens(Event("leave", tense="future"))),
            NOBODY,
            HowMuch(Measured("exit-number")),
        ),
        (HowDecide(Happens(Event("turn", tense="present"))), NOBODY, Whither()),
        (HowDecide(Happens(Event("turn", tense="past"))), NOBODY, None),
        (HowDecide(Happens(Event("brake", tense="present"))), NOBODY, None),
        (
            Whether(Compares(Measured("distance", IT), "much")),
            NOBODY,
            HowMuch(Measured("distance-to-go")),
        ),
        (Whether(Compares(Measured("distance", Vehicle(1)), "much")), NOBODY, None),
        (
            Whether(Is("right", THAT, Event("turn", tense="past"))),
            NOBODY,
            Whether(Happens(Event("turn", tense="present"))),
        ),
        (Whether(Is("right", THAT, Event("brake"))), NOBODY, None),
        (
            Whether(Happens(Event("arrive", manner=("late",)))),
            NOBODY,
            Whether(Is("late", Ego(), tense="future")),
        ),
        (Whether(Happens(Event("arrive"))), NOBODY, None),
        (HowMuch(Measured("distance", IT)), ABOUT_ARRIVAL, HowMuch(Measured("distance-to-go"))),
        (HowMuch(Measured("distance", IT)), ABOUT_SPEED, None),
        # How long.
        (
            HowMuch(Measured("duration", IT, time=WholeRide())),
            NOBODY,
            HowLong(Event("move", tense="perfect")),
        ),
        (HowMuch(Measured("duration", IT)), NOBODY, HowMuch(Measured("time-to-go"))),
        (HowLong(Event("do", IT, tense="present")), NOBODY, HowMuch(Measured("time-to-go"))),
        (HowLong(That()), NOBODY, HowMuch(Measured("time-to-go"))),
        (HowLong(That()), after(Whether(NEAR)), HowLong(NEAR)),
        (
            HowLong(That()),
            after(Whether(Not(NEAR))),
            HowLong(NEAR),
        ),
        (HowMuch(Measured("duration", Vehicle(1))), NOBODY, None),
    ],
)  # fmt: skip
def test_a_question_is_put_as_it_is_meant(spoken: Any, said: Discourse, meant: Any) -> None:
    assert recast(spoken, grounder(discourse=said)) == (spoken if meant is None else meant)


def test_what_leans_on_the_talk_is_noted() -> None:
    for spoken, said, leans in (
        (HowMany(SUCH), ABOUT_LANES, True),
        (HowMany(SUCH), ABOUT_SPEED, False),
        (Identify(IT), ABOUT_SPEED, True),
        (Whither(), ABOUT_SPEED, False),
    ):
        g = grounder(discourse=said)
        recast(spoken, g)
        assert g.notes.leaned is leans


def test_that_is_what_we_just_began_to_do() -> None:
    why = recast(Why(That()), grounder(BEGUN))
    assert isinstance(why, Why)
    assert isinstance(why.of, Happens)
    assert (why.of.event.action, why.of.event.actor) == ("brake", Ego())
    assert recast(Why(That()), grounder(QUIET)) == Why(That())
    spoken = talk(asked_at=39.0)
    assert recast(Why(That()), grounder(BEGUN, spoken)) == Why(That())
    needed = recast(Whether(Is("necessary", THAT)), grounder(BEGUN))
    assert needed.that.thing is None  # type: ignore[union-attr]
    assert needed.that.event.action == "brake"  # type: ignore[union-attr]
    of_car = Whether(Is("necessary", Vehicle(1)))
    assert recast(of_car, grounder(BEGUN)) == of_car


def test_how_long_it_takes_is_when_we_go_where_we_stand() -> None:
    spoken = HowMuch(Measured("duration", IT))
    go = When(Happens(Event("go", tense="future")))
    assert recast(spoken, grounder(HALTED)) == go
    assert recast(spoken, grounder(BEGUN)) == HowMuch(Measured("time-to-go"))
    assert halting(grounder(HALTED).context)
    assert not halting(grounder(BEGUN).context)
    over = FakeWorld(CARS, (did("stop", 30.0, 39.9),), now=40.0)
    assert not halting(grounder(over).context)


def test_that_among_what_is_compared_is_what_was_said() -> None:
    said = after(Whether(Not(FASTER)))
    found = recast(Compare((That(), SPEEDING), "safety"), grounder(discourse=said))
    assert found == Compare((FASTER, SPEEDING), "safety")
    unheard = grounder(FakeWorld(CARS, now=40.0))
    alone = Compare((That(), SPEEDING), "safety")
    assert recast(alone, unheard) == alone


WAY = Feature("way")
ON_IT = Related("on", Described("pedestrian"), IT)
GIVE = Event("give-way", Ego(), tense="present", modal="must")
PASSED = Event("pass", Ego(), Wanted(), tense="past")


@pytest.mark.parametrize(
    ("spoken", "said", "meant"),
    [
        (Whether(Happens(Event("go", Ego(), WAY))), NOBODY, Whither()),
        (
            Whether(Happens(Event("go", Vehicle(1), WAY))),
            NOBODY,
            Whether(Related("with", Vehicle(1), Ego(), Unsaid())),
        ),
        (Whether(Happens(Event("change-plan", IT))), ABOUT_BELIEF, HowSure(changed=True)),
        (Why(Happens(Event("change-plan", THAT))), ABOUT_BELIEF, HowSure(changed=True)),
        (
            Whether(Happens(Event("change-plan", IT))),
            after(Listing("beliefs")),
            HowSure(changed=True),
        ),
        (Whether(Happens(Event("change-plan", IT))), after(Listing("events")), None),
        (Whether(Happens(Event("change-plan", Ego()))), ABOUT_BELIEF, None),
        (Whether(Happens(Event("brake", IT))), ABOUT_BELIEF, None),
        (
            Which(Wanted(), Happens(Event("speed-up", Wanted(), IT))),
            ABOUT_BELIEF,
            HowSure(BELIEF.of, changed=True),
        ),
        (Which(Wanted(), Happens(Event("speed-up", Wanted(), IT))), ABOUT_SPEED, None),
        (
            Whether(Related("behind", Described(definite=False), Ego())),
            NOBODY,
            Whether(Exists(Described(definite=False, bearing="behind"), Unsaid())),
        ),
        (Whether(Related("behind", Described(), Ego())), NOBODY, None),
        (Whether(Related("faster-than", Described(definite=False), Ego())), NOBODY, None),
        (
            Identify(Described("vehicle", doing=Event("do", Vehicle(1), Wanted()))),
            NOBODY,
            Doing(Vehicle(1), tense="past"),
        ),
        (
            Whether(Happens(Event("keep-distance", Ego(), Vehicle(1), tense="present"))),
            NOBODY,
            Whether(Not(Is("close", Vehicle(1)), lexical=True)),
        ),
        (Whether(Happens(Event("keep-distance", Ego(), Vehicle(1), tense="past"))), NOBODY, None),
        (
            HowLong(Event("stand", Vehicle(1), where=Related("beside", Vehicle(1), Ego()))),
            NOBODY,
            HowLong(Related("beside", Vehicle(1), Ego(), Unsaid(), "past")),
        ),
        (HowLong(Event("stand", Vehicle(1))), NOBODY, None),
        (
            Which(Described(plural=True), Happens(PASSED)),
            NOBODY,
            Which(Everyone("vehicle"), Happens(replace(PASSED, time=WholeRide()))),
        ),
        (
            Which(Described(plural=True, colour="red"), Happens(PASSED)),
            NOBODY,
            Which(Described(plural=True, colour="red"), Happens(replace(PASSED, time=WholeRide()))),
        ),
        (Which(Described(), Happens(PASSED)), NOBODY, None),
        (
            Which(Described(plural=True), Happens(replace(PASSED, modal="could"))),
            NOBODY,
            None,
        ),
        (
            Whether(Exists(Described("pedestrian", such=ON_IT))),
            NOBODY,
            HowMuch(Measured("occupant", IT)),
        ),
        (Whether(Exists(Described("car", such=ON_IT))), NOBODY, None),
        (
            Whether(Related("on", Described("vehicle", definite=False), Vehicle(1))),
            NOBODY,
            HowMuch(Measured("occupant", Vehicle(1))),
        ),
        (
            Listing("events", event=GIVE),
            NOBODY,
            Which(Wanted(), Happens(replace(GIVE, object=Wanted()))),
        ),
        (Listing("events", event=replace(GIVE, modal=None)), NOBODY, None),
    ],
)
def test_a_question_about_others_is_put_as_it_is_meant(
    spoken: Any, said: Discourse, meant: Any
) -> None:
    assert of_others(spoken, grounder(discourse=said)) == meant


NEARS = Happens(Event("approach", Vehicle(1), Ego(), tense="present"))


@pytest.mark.parametrize(
    ("other", "meant"),
    [
        (Happens(Event("leave", Vehicle(1), tense="present")), True),
        (Is("far", Vehicle(1)), True),
        (Happens(Event("leave", Vehicle(1), tense="past")), False),
        (Happens(Event("brake", Vehicle(1), tense="present")), False),
        (Is("close", Vehicle(1)), False),
    ],
)
def test_nearer_or_farther_is_asked_as_a_distance_that_changes(other: Any, meant: bool) -> None:
    for contents in ((NEARS, other), (other, NEARS)):
        found = of_others(Whether(Both(contents, "or")), grounder())
        if not meant:
            assert found is None
            continue
        now = Measured("distance", Vehicle(1), Ego())
        then = replace(now, time=Ago(3.0), tense="past")
        both = Both((Compares(now, "less", then), Compares(now, "more", then)), "or")
        assert found == Whether(both)


def test_the_speed_that_is_allowed_is_the_limit() -> None:
    fast = Is("allowed", event=Event("go", manner=("fast",), tense="present"))
    found = within_limit(fast, grounder())
    speed = Measured("speed", time=fast.time, tense=fast.tense)
    assert found == Compares(speed, "at-most", replace(speed, attribute="limit"))
    assert within_limit(replace(fast, state="safe"), grounder()) is None
    slowly = replace(fast, event=Event("go", manner=("slow",)))
    assert within_limit(slowly, grounder()) is None
    asked = after(HowMuch(Measured("speed", Vehicle(1))))
    for thing in (None, IT):
        told = within_limit(Is("allowed", thing), grounder(discourse=asked))
        assert isinstance(told, Compares)
        assert (told.left.thing, told.comparator) == (Vehicle(1), "at-most")
    assert within_limit(Is("allowed", Vehicle(1)), grounder(discourse=asked)) is None
    assert within_limit(Is("allowed", IT), grounder(discourse=ABOUT_WAY)) is None


def test_something_wrong_is_what_hinders_us_and_was_dangerous() -> None:
    anything = Described(definite=False)
    found = something_wrong(Is("wrong", anything, tense="present"), grounder())
    assert found == Is("wrong", None, time=Now(), tense="present")
    past = something_wrong(Is("wrong", anything, tense="past"), grounder())
    assert past is not None
    assert (past.state, past.thing) == ("dangerous", None)
    assert something_wrong(Is("wrong", Vehicle(1)), grounder()) is None
    assert something_wrong(Is("close", anything), grounder()) is None


def test_nobody_does_is_the_denial_that_anybody_does() -> None:
    event = Event("brake", Nobody())
    anybody = Happens(replace(event, actor=Described(definite=False)))
    assert of_nobody(Happens(event)) == Not(anybody)
    certain = Happens(replace(event, actor=Nobody(Described("car"))))
    assert of_nobody(certain) == certain
    ours = Happens(Event("brake"))
    assert of_nobody(ours) == ours


@pytest.mark.parametrize(
    ("question", "who"),
    [
        (Identify(Vehicle(1)), True),
        (Doing(Ego()), True),
        (Whither(), True),
        (Which(Wanted(), Related("behind", Wanted(), Ego())), True),
        (Whether(Exists(Vehicle(1))), True),
        (Which(Wanted(), Happens(Event("brake", Wanted()))), False),
        (Why(Happens(Event("brake"))), False),
        (None, False),
    ],
)
def test_who_or_where_somebody_is_was_asked(question: Any, who: bool) -> None:
    assert asked_who(grounder(discourse=after(question)).context) is who
