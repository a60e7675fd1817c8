"""Of several readings one is chosen, or it is asked back; what is told of the acts of one turn."""

from typing import Any

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, did, reading
from xavi_dialogue.domain.answers import NoSuchVehicle, NotUnderstood
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Elliptic,
    Feel,
    HowMuch,
    Identify,
    Reading,
    Request,
    Social,
    TokenShare,
    Unread,
    When,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    Between,
    Described,
    Ego,
    Event,
    Happens,
    Has,
    Is,
    Measured,
    Related,
    Unknown,
    Vehicle,
)
from xavi_dialogue.nlu.grounding import Grounding, ground
from xavi_dialogue.nlu.grounding.clarify import (
    apart,
    between_meanings,
    between_vehicles,
    essence,
    gist,
)
from xavi_dialogue.nlu.grounding.context import Context, Unclear

WORLD = FakeWorld(
    {1: Car(20.0, kind="bus", colour="yellow"), 2: Car(30.0, 3.5), 3: Car(30.0, -3.5)},
    (did("brake", 5.0, 7.0), did("turn", 10.0, 12.0), did("brake", 6.0, 7.0, who=2)),
)
BRAKED = Happens(Event("brake", time=Between(5.0, 7.0)))
TURNED = Happens(Event("turn", time=Between(10.0, 12.0)))
WHY_BRAKE, WHY_TURN = Ask(Why(Happens(Event("brake")))), Ask(Why(Happens(Event("turn"))))
SPEED = Ask(HowMuch(Measured("speed")))


def grounded(*readings: Reading, discourse: Discourse | None = None) -> Grounding:
    return ground(readings, WORLD, discourse or Discourse())


def costing(cost: float, *acts: Act) -> Reading:
    return reading(*acts, cost=cost)


@pytest.mark.parametrize(
    ("cost", "asked_back"), [(0.0, True), (0.05, True), (0.07, False), (0.2, False)]
)
def test_two_readings_as_good_are_asked_between(cost: float, asked_back: bool) -> None:
    found = grounded(costing(0.0, WHY_BRAKE), costing(cost, WHY_TURN))
    assert (found.clarify is not None) is asked_back
    if found.clarify is not None:
        assert found.clarify.readings == (BRAKED, TURNED)
        assert found.clarify.between == "meanings"
        assert found.offers == (Ask(Why(BRAKED)), Ask(Why(TURNED)))
        assert (found.pending, found.acts) == (found.offers[0], ())
    else:
        assert [act.act for act in found.acts] == [Ask(Why(BRAKED))]


def test_a_reading_that_costs_clearly_more_by_its_words_is_not_even_tried() -> None:
    never = Ask(Why(Happens(Event("collide"))))  # costs 0.5 in the world
    for cost, kept in ((0.6, never), (0.4, WHY_BRAKE)):
        found = grounded(costing(0.0, never), costing(cost, WHY_BRAKE))
        assert found.reading is not None
        assert found.reading.acts == (kept,)
    assert grounded().refusal == NotUnderstood()
    many = [costing(0.0, never)] * 8
    assert grounded(*many, costing(0.0, WHY_BRAKE)).acts[0].act != Ask(Why(BRAKED))
    assert grounded(*many[:7], costing(0.0, WHY_BRAKE)).acts[0].act == Ask(Why(BRAKED))


def test_what_stays_open_is_asked_with_the_question_for_each() -> None:
    white = Described("car", colour="white")
    found = grounded(reading(SPEED, Ask(Identify(white))))
    assert found.clarify is not None
    assert found.clarify.between == "vehicles"
    assert found.clarify.readings == found.offered_things == (Vehicle(2), Vehicle(3))
    assert [look.vehicle for look in found.clarify.looks] == [2, 3]
    assert found.offers == (Ask(Identify(Vehicle(2))), Ask(Identify(Vehicle(3))))
    assert found.pending == Ask(Identify(white))
    assert [type(act.act.question) for act in found.acts] == [HowMuch]  # type: ignore[union-attr]


def share(word: str, kind: Any = "meaning", act: int | None = 0) -> TokenShare:
    strange = kind == "strange"
    return TokenShare(word, word, "unknown" if strange else kind, "", act, strange)


NOBODY = Ask(Identify(Described("motorcycle")))


@pytest.mark.parametrize(
    ("acts", "told", "refused"),
    [
        ((SPEED,), [HowMuch], None),
        ((NOBODY,), [], NoSuchVehicle),
        ((SPEED, NOBODY), [HowMuch], NoSuchVehicle),
        # Beside a question that is lost, neither claims nor courtesies are replied to.
        ((Claim(BRAKED), NOBODY), [], NoSuchVehicle),
        ((Social("joke"), NOBODY), [], NoSuchVehicle),
        ((Feel("afraid"), NOBODY), [Feel], NoSuchVehicle),
        ((Social("joke"), SPEED), [Social, HowMuch], None),
        # Beside one that is answered, nothing is owned up to of a claim.
        ((Claim(Is("fast", Described("motorcycle"))), SPEED), [HowMuch], None),
        ((Claim(Is("fast", Described("motorcycle"))),), [], NoSuchVehicle),
        ((Request(Event("overtake", object=Described("motorcycle"))),), [], NoSuchVehicle),
    ],
)
def test_what_is_told_and_refused(acts: tuple[Act, ...], told: Any, refused: Any) -> None:
    found = grounded(reading(*acts))
    kinds = [type(a.act.question) if isinstance(a.act, Ask) else type(a.act) for a in found.acts]
    assert kinds == told
    assert (None if found.refusal is None else type(found.refusal)) is refused


def test_who_is_described_wrongly_is_put_right_and_answered() -> None:
    found = grounded(reading(Ask(Identify(Described("bus", colour="green"))), Claim(BRAKED)))
    assert isinstance(found.refusal, NoSuchVehicle)
    assert [act.act for act in found.acts] == [Ask(Identify(Vehicle(1))), Claim(BRAKED)]


def test_a_question_with_a_word_without_a_sense_is_not_understood() -> None:
    shares = (share("why"), share("flurb", "strange"), share("thanks", act=1))
    one = Reading((WHY_BRAKE, Social("thanks")), shares)
    found = grounded(one)
    assert found.refusal == NotUnderstood(("flurb",), "flurb")
    assert found.acts == ()
    senseless = grounded(reading(Ask(Identify(Unknown("flurb")))))
    assert isinstance(senseless.refusal, NotUnderstood)
    unsound = grounded(reading(Ask(Whether(Related("behind", Vehicle(1), Vehicle(1))))))
    assert isinstance(unsound.refusal, NotUnderstood)
    # The costs of both decide for another reading.
    best = grounded(one, costing(1.1, WHY_BRAKE))
    assert best.refusal is not None
    other = grounded(one, costing(0.9, WHY_BRAKE))
    assert [act.act for act in other.acts] == [Ask(Why(BRAKED))]


def test_words_in_no_vocabulary_are_quoted() -> None:
    shares = (
        share("why"), share("brake"), share("flurbly", "strange"), share("greenly", "unknown")
    )  # fmt: skip
    found = grounded(Reading((WHY_BRAKE,), shares))
    assert found.acts[0].doubts == ("flurbly",)
    assert found.acts[0].strange == ("flurbly",)
    plain = grounded(Reading((WHY_BRAKE,), shares[:2]))
    assert (plain.acts[0].doubts, plain.acts[0].strange) == ((), ())


@pytest.mark.parametrize(("asks", "refused"), [(True, True), (False, False)])
def test_a_stretch_without_a_sense_is_owned_up_to_where_it_asks(asks: bool, refused: bool) -> None:
    words = ("oh", "flurb")
    rest = Reading((Claim(BRAKED),), (share("x"),), unread=(Unread(words, asks=asks),))
    found = grounded(rest)
    assert (found.refusal is not None) is refused
    assert [type(act.act) for act in found.acts] == ([] if refused else [Claim])


def test_who_was_named_in_what_was_not_understood() -> None:
    lost = Ask(Whether(Related("behind", Vehicle(1), Vehicle(1))))
    assert grounded(reading(lost)).named == Vehicle(1)
    assert grounded(reading(NOBODY)).named is None
    assert grounded(reading(SPEED)).named is None


def test_the_acts_of_a_turn_lead_on() -> None:
    bus = Ask(Identify(Described("bus")))
    found = grounded(reading(bus, Elliptic(thing=Described("car", bearing="left"))))
    assert found.acts[1].act == Ask(Identify(Vehicle(2)))
    assert found.acts[1].leaned
    why = grounded(reading(Ask(When(Happens(Event("brake")))), Elliptic(form="why")))
    assert why.acts[1].act == Ask(Why(BRAKED))


# --- what makes a difference ---------------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "other", "alike"),
    [
        (Claim(BRAKED), Ask(Whether(BRAKED)), True),
        (Ask(Whether(BRAKED, tag=True)), Ask(Whether(BRAKED)), True),
        (Ask(Whether(Happens(Event("brake", tense="present")))),
         Ask(Whether(Happens(Event("brake")))), True),
        (Ask(Whether(Happens(Event("brake", manner=("hard",), modal="must")))),
         Ask(Whether(Happens(Event("brake")))), True),
        (Ask(HowMuch(Measured("speed", tense="past"))), SPEED, True),
        (Ask(Whether(Is("fast", Ego(), tense="past"))), Ask(Whether(Is("fast", Ego()))), True),
        (Ask(Whether(Related("behind", Ego(), Vehicle(1), tense="past"))),
         Ask(Whether(Related("behind", Ego(), Vehicle(1)))), True),
        (Ask(Whether(Has("colour", "red", Vehicle(1), tense="past"))),
         Ask(Whether(Has("colour", "red", Vehicle(1)))), True),
        (WHY_BRAKE, WHY_TURN, False),
        (Ask(Whether(BRAKED)), Ask(Why(BRAKED)), False),
    ],
)  # fmt: skip
def test_tense_manner_and_tags_make_no_difference(one: Act, other: Act, alike: bool) -> None:
    assert (essence([one]) == essence([other])) is alike


@pytest.mark.parametrize(
    ("act", "found"),
    [
        (Ask(Why(BRAKED)), BRAKED),
        (Ask(Identify(Vehicle(1))), Vehicle(1)),
        (Ask(HowMuch(Measured("delay", event=BRAKED.event))), BRAKED),
        (Ask(HowMuch(Measured("speed", Vehicle(1)))), Vehicle(1)),
        (Claim(BRAKED), BRAKED),
        (Request(Event("stop")), Happens(Event("stop"))),
        (Feel("afraid", Vehicle(1)), Vehicle(1)),
        (Feel("afraid"), None),
        (Social("joke"), None),
    ],
)
def test_what_an_act_is_about(act: Act, found: Any) -> None:
    assert gist(act) == found


def test_the_first_acts_that_differ_are_offered() -> None:
    one, two = Ask(Why(BRAKED)), Ask(Why(TURNED))
    found = between_meanings((SPEED, one), (SPEED, two))
    assert found is not None
    assert found.which.readings == (BRAKED, TURNED)
    assert found.which.acts == found.offers == (one, two)
    assert between_meanings((one,), (one, two)) is None
    assert between_meanings((one,), (one,)) is None
    assert between_meanings((one,), (Social("joke"),)) is None
    assert between_meanings((Social("joke"),), (one,)) is None
    assert between_meanings((one,), (Ask(When(BRAKED)),)) is None  # both are about the same


def why(action: Any, begin: float, end: float) -> Ask:
    return Ask(Why(Happens(Event(action, time=Between(begin, end)))))


@pytest.mark.parametrize(
    ("one", "other", "found"),
    [
        (why("brake", 5.0, 7.0), why("turn", 10.0, 12.0), True),
        (why("turn", 10.0, 12.0), why("brake", 5.0, 7.0), True),
        (why("brake", 5.0, 7.0), why("turn", 7.0, 12.0), True),
        (why("brake", 5.0, 7.0), why("turn", 6.9, 12.0), False),
        (why("brake", 5.0, 7.0), why("brake", 10.0, 12.0), False),
        (why("brake", 5.0, 7.0), Ask(Why(Happens(Event("turn")))), False),
        (Ask(Why(Happens(Event("turn")))), why("brake", 5.0, 7.0), False),
        (why("brake", 5.0, 7.0), Ask(When(TURNED)), False),
        (why("brake", 5.0, 7.0), Ask(Why(Is("fast", Ego()))), False),
        (why("brake", 5.0, 7.0), Claim(TURNED), False),
    ],
)
def test_events_at_different_times_are_asked_between(one: Act, other: Act, found: bool) -> None:
    assert apart((one,), (other,)) is found
    assert apart((SPEED, one), (SPEED, other)) is found
    assert not apart((one, one), (other, other))
    assert not apart((one,), (other, other))


def test_vehicles_are_offered_with_their_looks_where_they_have_any() -> None:
    unclear = Unclear(Described("car"), (2, 9), 5.0)
    found = between_vehicles(unclear, (SPEED, WHY_BRAKE), Context(WORLD, Discourse()))
    assert found.which.readings == found.things == (Vehicle(2), Vehicle(9))
    assert [(look.vehicle, look.time) for look in found.which.looks] == [(2, 5.0)]
    assert found.offers == (SPEED, WHY_BRAKE)
