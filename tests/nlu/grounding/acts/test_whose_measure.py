"""Whose a measure is, to whom, and at which moment."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.fakes import Car, FakeWorld, did
from xavi_dialogue.domain.discourse import Discourse, Mention
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import HowMuch, Why
from xavi_dialogue.domain.terms import (
    Ago,
    At,
    Back,
    Between,
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Is,
    Measured,
    Now,
    Pronoun,
    Quantity,
    Relative,
    Thing,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.acts.measuring import (
    just_named,
    measured,
    of_anybody,
    of_ride,
    spoken_of,
    tally,
    whichever,
)
from xavi_dialogue.nlu.grounding.acts.propositions import timed
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

HIM, IT = Vehicle(1), Pronoun("it")
BRAKED = did("brake", 30.0, 32.0)
CARS = {
    1: Car(20.0, colour="red"), 2: Car(-10.0, kind="bus"), 3: Car(9.0, 4.0, kind="bicycle"),
}  # fmt: skip
SPEED = Measured("speed")


def of(*said: tuple[Thing, float], **more: Any) -> Discourse:
    """A discourse in which things were spoken of, as clearly as is said."""
    mentions = tuple(Mention(thing, 1, False, salience) for thing, salience in said)
    return replace(Discourse(turn=2, mentions=mentions), **more)


def grounder(said: Discourse | None = None, *happened: Episode) -> TermGrounder:
    world = FakeWorld(CARS, happened or (BRAKED,), now=40.0)
    return TermGrounder(Context(world, said or Discourse()))


def ground(spoken: Measured, said: Discourse | None = None, **more: Any) -> Measured:
    return measured(spoken, grounder(said), timed, **more)


WHY_HE_BRAKED = Why(Happens(Event("brake", HIM)))
ABOUT_US = of(question=HowMuch(SPEED))


@pytest.mark.parametrize("form", ["it", "he", "she", "that", "this", "one"])
@pytest.mark.parametrize("attribute", ["speed", "acceleration", "deceleration"])
def test_how_fast_it_goes_is_of_us_where_we_were_spoken_of(form: Any, attribute: Any) -> None:
    spoken = Measured(attribute, Pronoun(form))
    assert ground(spoken, ABOUT_US).thing == Ego()
    told = of(propositions=(Happens(Event("brake", Ego())), Happens(Event("brake", HIM))))
    assert ground(spoken, told).thing == Ego()


@pytest.mark.parametrize(
    ("spoken", "said"),
    [
        (Measured("speed", IT), of((HIM, 0.9), question=HowMuch(SPEED))),
        (Measured("size", IT), of((HIM, 0.3), question=HowMuch(SPEED))),
        (Measured("speed", IT), of((HIM, 0.4))),
        (Measured("speed", Pronoun("one")), of((HIM, 0.9), question=WHY_HE_BRAKED)),
    ],
)
def test_how_it_is_is_else_of_whom_was_spoken_of(spoken: Measured, said: Discourse) -> None:
    assert ground(spoken, said).thing == HIM


def test_how_far_it_is_is_how_far_we_have_to_go_where_nobody_was_spoken_of() -> None:
    far = Measured("distance", IT, tense="present")
    found = ground(far)
    assert (found.attribute, found.thing) == ("distance-to-go", Ego())
    named = ground(far, of((HIM, 0.5)))
    assert (named.attribute, named.thing) == ("distance", HIM)
    faint = ground(far, of((HIM, 0.49)))
    assert faint.attribute == "distance-to-go"
    for other in (replace(far, tense="past"), replace(far, to=HIM), replace(far, thing=HIM)):
        assert ground(other).attribute == "distance"


def test_how_far_we_are_is_from_whom_was_spoken_of() -> None:
    ours = Measured("distance", Ego())
    assert ground(ours, of((HIM, 0.5))).to == HIM
    assert ground(ours, of((HIM, 0.9), (Vehicle(2), 0.6))).to == HIM
    assert ground(ours, of((HIM, 0.49))).to is None
    assert ground(replace(ours, to=Vehicle(2)), of((HIM, 0.9))).to == Vehicle(2)
    assert ground(Measured("speed", Ego()), of((HIM, 0.9))).to is None
    g = grounder(of((HIM, 0.9)))
    measured(ours, g, timed)
    assert g.notes.leaned


ANYBODY = Described(definite=False)


@pytest.mark.parametrize(
    ("thing", "to"),
    [
        (ANYBODY, None),
        (Described(kind="car", definite=False), None),
        (Described(kind="bicycle"), Everyone("bicycle")),
        (Described(kind="bicycle", definite=False), Everyone("bicycle")),
    ],
)
def test_how_close_anybody_came_is_asked_of_all(thing: Thing, to: Thing | None) -> None:
    spoken = Measured("distance", thing, tense="past")
    found = ground(spoken, extreme=True)
    assert (found.thing, found.to) == (Ego(), to)
    ours = ground(Measured("distance", Ego(), to=thing, tense="past"), extreme=True)
    assert (ours.thing, ours.to) == (Ego(), to)


def test_how_close_a_particular_one_came_is_asked_of_that_one() -> None:
    for thing, who in ((Described(kind="bus"), 2), (Described(colour="red"), 1)):
        spoken = Measured("distance", thing, tense="present")
        assert ground(spoken, extreme=True).thing == Vehicle(who)
    red = Described(colour="red", definite=False)
    found = ground(Measured("distance", red, tense="past"), extreme=True)
    assert found.thing != Ego()
    # The cyclist who was just spoken of is that one.
    cyclist = Measured("distance", Described(kind="bicycle"), tense="past")
    assert ground(cyclist, of((Vehicle(3), 0.6)), extreme=True).thing == Vehicle(3)
    assert ground(cyclist, of((HIM, 0.6)), extreme=True).thing == Ego()
    assert ground(cyclist, of((Vehicle(3), 0.4)), extreme=True).thing == Ego()


def test_over_the_whole_ride_anybody_is_all_of_that_kind() -> None:
    spoken = Measured("distance", Ego(), to=ANYBODY, time=WholeRide(), tense="past")
    found = ground(spoken)
    assert (found.thing, found.to) == (Ego(), Everyone("vehicle"))
    now = ground(replace(spoken, tense="present", time=Now()))
    assert now.to != Everyone("vehicle")


@pytest.mark.parametrize(
    ("time", "at"),
    [
        (Ago(), 39.0),
        (At(12.0), 12.0),
        (Relative("before", Event("brake", tense="past")), 29.8),
        (Relative("after", Event("brake", tense="past")), 32.0),
        (Relative("during", Event("brake", tense="past")), 30.0),
        (Back("after"), 32.0),
    ],
)
def test_a_value_at_a_deed_is_that_of_a_moment(time: Any, at: float) -> None:
    spoken = Measured("speed", Ego(), time=time, tense="past")
    g = grounder(Discourse(turn=2, episode=(30.0, 32.0)))
    found = measured(spoken, g, timed)
    assert isinstance(found.time, At)
    assert found.time.at == pytest.approx(at)
    over = ground(spoken, Discourse(turn=2, episode=(30.0, 32.0)), extreme=True)
    assert isinstance(over.time, Between if not isinstance(time, At) else At)


def test_what_has_no_moment_keeps_its_time() -> None:
    just = Measured("waiting-time", Ego(), time=Ago(), tense="past")
    assert ground(just).time == Between(35.0, 40.0)
    never = Relative("before", Event("overtake", tense="past"))
    found = ground(Measured("speed", Ego(), time=never, tense="past"))
    assert isinstance(found.time, Relative)  # the explainer says that it did not take place
    coming = Relative("before", Event("overtake", tense="future"))
    assert not isinstance(ground(Measured("speed", time=coming, tense="future")).time, Relative)


def test_which_came_near_is_asked_of_all_ever_seen() -> None:
    near = Compares(Measured("distance", time=WholeRide()), "less", Quantity(2.0, "m"))
    assert whichever(ANYBODY, near) == Wanted("vehicle")
    assert whichever(Described(kind="car"), near) == Wanted("car")
    assert whichever(Described(kind="bicycle"), near) == Wanted("bicycle")
    assert whichever(Described(colour="red"), near) in (Described(colour="red"), Wanted("vehicle"))
    now = replace(near, left=Measured("distance", time=Now()))
    assert whichever(ANYBODY, now) == ANYBODY
    than_us = replace(near, right=Measured("distance"))
    assert whichever(ANYBODY, than_us) == ANYBODY


def test_whether_anybody_was_faster_is_asked_of_all() -> None:
    theirs = Measured("speed", ANYBODY, tense="past")
    ours = Measured("speed", Ego())
    assert of_anybody(theirs, ours) == replace(theirs, thing=Everyone("vehicle"), time=WholeRide())
    present = replace(theirs, tense="present")
    assert of_anybody(present, ours) == replace(present, thing=Everyone("vehicle"))
    timed_ = replace(theirs, time=At(3.0))
    assert of_anybody(timed_, ours).time == At(3.0)
    for spoken, other in (
        (theirs, Measured("speed", HIM)), (theirs, Quantity(9.0, "m/s")),
        (replace(theirs, attribute="size"), ours), (replace(theirs, thing=HIM), ours),
        (replace(theirs, thing=Described()), ours),
    ):  # fmt: skip
        assert of_anybody(spoken, other) == spoken


def test_how_many_are_counted_where_they_were_and_how_often_over_all() -> None:
    braking = Measured("count", event=Event("brake", tense="past"))
    found = tally(braking, grounder())
    assert found.event is not None
    assert found.event.time == WholeRide()
    late = replace(braking, event=Event("brake", time=At(31.0), tense="past"))
    assert tally(late, grounder()).event.time != WholeRide()  # type: ignore[union-attr]
    buses = Described(kind="bus", plural=True)
    counted = tally(Measured("count", buses), grounder())
    assert counted.about == Exists(buses)


def test_whom_the_same_breath_named() -> None:
    assert just_named(grounder(of((HIM, 1.1)))) == HIM
    assert just_named(grounder(of((HIM, 1.0)))) is None
    assert spoken_of(grounder(of((HIM, 0.5))))
    assert not spoken_of(grounder(of((HIM, 0.4))))
    assert not spoken_of(grounder())


@pytest.mark.parametrize(
    ("spoken", "thing"),
    [
        (Is("far", IT), Destination()),
        (Is("far", HIM), HIM),
        (Is("fast", Pronoun("this")), Ego()),
        (Is("slow", Pronoun("that")), Ego()),
        (Is("fast", IT), IT),
        (Is("close", Pronoun("this")), Pronoun("this")),
        (Is("free", IT), Feature("way")),
    ],
)
def test_what_is_far_or_fast_where_nobody_was_named(spoken: Is, thing: Thing) -> None:
    assert of_ride(spoken, grounder()).thing == thing


def test_what_is_clear_is_our_way_whoever_was_named() -> None:
    named = grounder(of((HIM, 0.9)))
    assert of_ride(Is("free", IT), named).thing == Feature("way")
    assert of_ride(Is("far", IT), named).thing == IT


def test_how_fast_this_is_is_asked_of_our_car_unless_somebody_in_view_was_spoken_of() -> None:
    this = Measured("speed", Pronoun("this"))
    gone = of((Vehicle(7), 0.9))
    assert ground(this, gone).thing == Ego()
    assert ground(this, of((HIM, 0.9))).thing == HIM
    assert ground(Measured("speed", Pronoun("this"), tense="past"), gone).thing != Ego()
