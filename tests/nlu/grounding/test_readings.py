"""Choosing among readings; acts of one turn; words that have no sense."""

import time

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, asked, did, reading, road
from xavi_dialogue.domain.answers import NoSuchVehicle, NotUnderstood
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Ask,
    Claim,
    HowMuch,
    Identify,
    Reading,
    Repair,
    Social,
    TokenShare,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Described,
    Event,
    Happens,
    Is,
    Junction,
    Lane,
    Measured,
    Pronoun,
    Related,
    Thing,
    Unknown,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import Relation
from xavi_dialogue.nlu.grounding import Grounding, ground

RING = Junction("roundabout", time=12.0)
WORLD = FakeWorld(
    {1: Car(20.0, kind="bus", colour="yellow"), 2: Car(-10.0, colour="blue")},
    (did("enter", 12.0, 12.0, place=RING), did("leave", 15.0, 15.0, place=RING),
     did("slow-down", 10.0, 12.0)),
)  # fmt: skip
MOTORWAY = FakeWorld({}, (did("change-left", 12.0, 14.0, side="left"),), facts=road())
ROUNDABOUT = Ask(Why(Happens(Event("leave", object=Junction("roundabout")))))
LANE = Ask(Why(Happens(Event("change-lane"))))


def grounded(*readings: Reading, world: FakeWorld = WORLD) -> Grounding:
    return ground(readings, world, Discourse())


def test_leaving_is_the_roundabout_or_the_lane_by_what_there_was() -> None:
    both = (reading(LANE), reading(ROUNDABOUT, cost=0.1))
    assert grounded(*both).reading == both[1]
    assert grounded(*both, world=MOTORWAY).reading == both[0]


def test_what_happened_beats_what_did_not() -> None:
    left = reading(Ask(Why(Happens(Event("change-left")))))
    slowed = reading(Ask(Why(Happens(Event("slow-down")))), cost=1.0)
    assert grounded(left, slowed).reading == left  # words that are so much likelier decide
    near = reading(slowed.acts[0], cost=0.1)
    assert grounded(left, near).reading == near


class InLine(FakeWorld):
    """A world in which every car is ahead of us or behind us."""

    def relation(self, relation: Relation, thing: Thing, to: Thing, at: float) -> bool | None:
        assert isinstance(thing, Vehicle)
        return (self.cars[thing.number].place(at)[0] > 0.0) == (relation == "ahead-of")


@pytest.mark.parametrize(("relation", "he"), [("ahead-of", 1), ("behind", 2)])
def test_he_is_who_was_asked_for_by_his_place(relation: Relation, he: int) -> None:
    cars = {1: Car(20.0), 2: Car(-10.0), 3: Car(-30.0), 4: Car(9.0, 3.5), 5: Car(-9.0, 3.5)}
    world = InLine(cars)
    who = Ask(Which(Wanted(), Related(relation, Wanted())))
    fast = Ask(HowMuch(Measured("speed", Pronoun("he"))))
    found = grounded(reading(who, fast), world=world).acts[-1].act
    assert isinstance(found, Ask)
    assert isinstance(found.question, HowMuch)
    assert found.question.of.thing == Vehicle(he)


def test_two_that_are_as_good_are_asked_about() -> None:
    slowed = reading(Ask(Why(Happens(Event("slow-down")))))
    entered = reading(Ask(Why(Happens(Event("enter")))))
    found = grounded(slowed, entered)
    assert found.clarify is not None
    assert found.clarify.between == "meanings"
    assert len(found.clarify.readings) == len(found.offers) == 2
    assert found.acts == ()


def test_two_that_come_to_the_same_are_one() -> None:
    said = Is("safe", Vehicle(1))
    found = grounded(reading(Ask(Whether(said))), reading(Claim(said)))
    assert found.clarify is None
    one = reading(Ask(Identify(Described(kind="bus"))))
    other = reading(Ask(Identify(Described(colour="yellow"))))
    assert grounded(one, other).clarify is None


def test_no_reading_is_not_understood() -> None:
    assert grounded().refusal == NotUnderstood()


def test_of_several_acts_each_is_grounded() -> None:
    why = Ask(Why(Happens(Event("slow-down"))))
    needed = Ask(Whether(Is("necessary", Pronoun("it"), tense="past")))
    found = grounded(reading(why, needed))
    assert len(found.acts) == 2
    assert found.acts[1].act.question.that.event.action == "slow-down"  # type: ignore[union-attr]


def test_a_pronoun_reaches_into_the_same_turn() -> None:
    who = Ask(Identify(Described(colour="blue")))
    fast = Ask(HowMuch(Measured("speed", Pronoun("it"))))
    found = grounded(reading(who, fast))
    assert found.acts[1].act.question.of.thing == Vehicle(2)  # type: ignore[union-attr]


def test_of_several_acts_one_may_fail() -> None:
    found = grounded(reading(Ask(Identify(Vehicle(99))), Ask(Identify(Vehicle(2)))))
    assert [a.act for a in found.acts] == [Ask(Identify(Vehicle(2)))]
    assert isinstance(found.refusal, NoSuchVehicle)


def test_talk_stays_as_it_is() -> None:
    for spoken in (Social("thanks"), Repair("repeat")):
        assert grounded(reading(spoken)).acts[0].act == spoken


def words(text: str) -> tuple[TokenShare, ...]:
    """Shares of words: *unknown*, V:verb, N:noun, the others grammar."""
    found = []
    for word in text.split():
        mark, _, rest = word.rpartition(":")
        match mark:
            case "V":
                found.append(TokenShare(rest, rest, "meaning", "event brake", 0))
            case "N":
                found.append(TokenShare(rest, rest, "meaning", "thing bus", 0))
            case "?":
                found.append(TokenShare(rest, rest, "unknown", "", 0, strange=True))
            case _:
                found.append(TokenShare(rest, rest, "grammar", "", 0))
    return tuple(found)


@pytest.mark.parametrize(
    "text",
    [
        "why did you V:brake ?:zorgly",
        "why did you ?:zorgly V:brake",
        "why did the ?:zorg N:bus V:brake",
        "why did you V:brake with the ?:zorg",
    ],
)
def test_an_adverb_or_aside_is_a_doubt(text: str) -> None:
    why = Ask(Why(Happens(Event("slow-down"))))
    found = grounded(reading(why, shares=words(text)))
    assert found.refusal is None
    assert found.acts[0].doubts


@pytest.mark.parametrize(
    "text",
    [
        "why did you ?:zorg the N:bus",
        "did the N:bus ?:zorg",
        "are you ?:zorg",
        "how ?:zorg is the N:bus",
        "what ?:zorg is that",
        "is the ?:zorg V:braking",
    ],
)
def test_a_main_word_without_a_sense_is_not_answered(text: str) -> None:
    found = grounded(reading(Ask(Identify(Described(kind="bus"))), shares=words(text)))
    assert found.acts == ()
    assert isinstance(found.refusal, NotUnderstood)
    assert found.refusal.words


def test_a_thing_without_a_sense_is_not_answered() -> None:
    found = grounded(reading(Ask(HowMuch(Measured("speed", Unknown("zorg"))))))
    assert found.refusal == NotUnderstood()


def test_other_acts_survive_a_word_without_a_sense() -> None:
    shares = (
        TokenShare("did", "did", "grammar", act=0),
        TokenShare("you", "you", "grammar", act=0),
        TokenShare("zorg", "zorg", "unknown", act=0),
        TokenShare("fast", "fast", "meaning", "attribute speed", act=1),
    )
    fast = Ask(HowMuch(Measured("speed")))
    found = grounded(reading(Ask(Identify(Wanted())), fast, shares=shares))
    assert len(found.acts) == 1
    assert isinstance(found.refusal, NotUnderstood)


def test_grounding_is_quick_and_repeatable() -> None:
    crowd = FakeWorld({n: Car(10.0 * n, 3.5 * (n % 3)) for n in range(1, 30)}, WORLD.happened)
    why = Why(Happens(Event("brake", Described(kind="car", bearing="left"))))
    start = time.perf_counter()
    found = [asked(why, crowd) for _ in range(20)]
    assert (time.perf_counter() - start) / 20 < 0.05
    assert all(one == found[0] for one in found)


def test_a_lane_is_left_as_it_is() -> None:
    found = grounded(reading(Ask(Whether(Is("free", Lane("left"))))))
    assert found.acts[0].act.question.that.thing == Lane("left")  # type: ignore[union-attr]
