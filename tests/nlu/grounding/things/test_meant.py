"""What is meant where the words leave it open: by presuppositions, by what goes on and was said."""

import pytest

from tests.nlu.grounding.fakes import Car, FakeWorld, act, asked, did, question_of, reading, talk
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Compare,
    Doing,
    Elliptic,
    Fault,
    HowMuch,
    Question,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.meaning import When as WhenAsked
from xavi_dialogue.domain.terms import (
    At,
    Back,
    Believed,
    Between,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Exit,
    Happens,
    Is,
    Measured,
    Nobody,
    Not,
    Pronoun,
    Related,
    Relative,
    That,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.grounding import Grounding, ground

CARS = {1: Car(20.0, kind="truck", colour="blue"), 2: Car(-10.0, colour="black")}
STANDING = FakeWorld(CARS, (did("slow-down", 15.0, 18.0), did("stop", 18.0, going_on=True)))
WORLD = FakeWorld(
    CARS,
    (
        did("give-way", 5.0, 7.0, whom=1),
        did("slow-down", 5.0, 7.0),
        did("exit-right", 7.5, 9.0),
        did("brake", 12.0, 19.5, who=1),
        did("overtake", 14.0, 16.0, who=2, whom=0),
        did("pass", 14.2, 15.8, who=2, whom=0),
    ),
)
BRAKED = Ask(Why(Happens(Event("slow-down"))))


def chosen(world: FakeWorld, *readings: tuple[Act, float], said: Discourse | None = None):  # type: ignore[no-untyped-def]
    found: Grounding = ground(
        tuple(reading(one, cost=cost) for one, cost in readings), world, said or Discourse()
    )
    assert found.clarify is None, found.clarify
    return found.acts[0].act


OVER_LIMIT = Compares(Measured("speed", Vehicle(1)), "more", Measured("limit", Vehicle(1)))
SAME = [
    # another question about the same is no reason to ask back
    (Ask(Doing(Described(colour="blue"))), Ask(Which(Wanted(), OVER_LIMIT))),
    # nor another word for the same event
    (
        Ask(Why(Happens(Event("overtake", Vehicle(2))))),
        Ask(Why(Happens(Event("pass", Vehicle(2))))),
    ),
    # nor what did not happen
    (BRAKED, Ask(Why(Happens(Event("collide"))))),
    # nor what no record could tell
    (BRAKED, Ask(Why(Is("faulty", Ego())))),
    # nor the same deed at another time
    (BRAKED, Ask(Why(Happens(Event("slow-down", time=At(6.0)))))),
]


@pytest.mark.parametrize(("one", "other"), SAME)
def test_it_is_not_asked_back_where_one_reading_is_the_sensible_one(one: Act, other: Act) -> None:
    assert type(chosen(WORLD, (one, 0.2), (other, 0.2)).question) is type(one.question)  # type: ignore[union-attr]


def test_what_no_record_tells_is_not_taken_for_granted() -> None:
    faulty = Ask(Why(Is("faulty", Ego())))
    assert chosen(WORLD, (faulty, 0.2), (BRAKED, 0.2)).question.of.event.action == "slow-down"


def test_a_description_that_says_nothing_has_missed_a_word() -> None:
    blank = Ask(Doing(Described()))
    told = Ask(Doing(Described(colour="blue")))
    assert chosen(WORLD, (blank, 0.2), (told, 0.4)).question.actor == Vehicle(1)


def one(question: Question, world: FakeWorld = WORLD, said: Discourse | None = None) -> Question:
    return question_of(asked(question, world, said))


def test_how_long_this_takes_is_until_we_go_on_where_we_stand() -> None:
    this = HowMuch(Measured("duration", Pronoun("this"), tense="future"))
    found = one(this, STANDING)
    assert isinstance(found, WhenAsked)
    assert found.of.event.action == "go"  # type: ignore[union-attr]
    moving = one(this)
    assert isinstance(moving, HowMuch)
    assert moving.of.attribute == "time-to-go"


def test_what_that_cost_is_what_we_did_because_we_were_hindered() -> None:
    why_not = Why(Not(Happens(Event("enter"))))
    cost = HowMuch(Measured("delay", Pronoun("that"), tense="past"))
    found = one(cost, said=talk(Vehicle(1), question=why_not))
    assert isinstance(found, HowMuch)
    assert found.of.event is not None
    assert found.of.event.action in ("slow-down", "give-way")
    assert found.of.thing == Ego()


def test_allowed_of_a_speed_is_the_limit() -> None:
    speed = HowMuch(Measured("speed"))
    that = Whether(Is("allowed", Pronoun("that")))
    for found in (
        one(that, said=talk(question=speed)),
        one(Whether(Is("allowed", event=Event("go", manner=("fast",), tense="present")))),
    ):
        assert isinstance(found, Whether)
        assert isinstance(found.that, Compares)
        assert found.that.right.attribute == "limit"  # type: ignore[union-attr]
    other = one(Whether(Is("allowed", event=Event("exit-right"))))
    assert isinstance(other.that, Is)  # type: ignore[union-attr]


def test_something_wrong_is_no_vehicle() -> None:
    wrong = Whether(Is("wrong", Described(definite=False), tense="past"))
    found = one(wrong, said=talk(question=Why(Happens(Event("slow-down", time=Between(5.0, 7.0))))))
    assert isinstance(found, Whether)
    assert isinstance(found.that, Is)
    assert (found.that.state, found.that.thing) == ("dangerous", None)


def test_fault_is_of_what_hindered_us() -> None:
    why_not = Why(Not(Happens(Event("overtake", object=Vehicle(1)))))
    found = one(Fault(suspect=Pronoun("it")), said=talk(Vehicle(1), question=why_not))
    assert isinstance(found, Fault)
    assert found.suspect == Vehicle(1)
    assert found.of.event.action in ("slow-down", "give-way")  # type: ignore[union-attr]


def test_nobody_does_is_that_none_does() -> None:
    found = act(Claim(Happens(Event("come", Nobody(), tense="present"))), WORLD).acts[0].act
    assert isinstance(found, Claim)
    assert isinstance(found.that, Not)
    denied = found.that.content
    assert isinstance(denied, Exists)
    assert isinstance(denied.thing, Nobody)
    assert denied.thing.described is not None
    assert denied.thing.described.doing == Event("come", Wanted(), tense="present")


def test_what_could_not_be_known_is_what_came_true() -> None:
    turned = Claim(Not(Happens(Event("exit-right", Vehicle(1)))))
    known = Claim(Not(Believed(That())))
    found = ground((reading(turned, known),), WORLD, Discourse())
    content = found.acts[1].act.that.content.content  # type: ignore[union-attr]
    assert isinstance(content, Happens)
    assert found.acts[1].leaned


def test_what_happened_is_the_latest_of_note_in_which_we_had_a_part() -> None:
    quiet = FakeWorld(CARS, WORLD.happened[:4])
    for time in (Doing(None, tense="past"), Doing(None, time=Back(), tense="past")):
        assert one(time, quiet).time == Between(5.0, 9.0)  # type: ignore[union-attr]
    assert one(Doing(None, tense="past")).time == Between(14.0, 16.0)  # type: ignore[union-attr]


def test_back_there_is_no_longer_what_was_spoken_of_long_ago() -> None:
    stale = talk(episode=(1.0, 2.0), asked_at=3.0)
    fresh = talk(episode=(1.0, 2.0), asked_at=19.0)
    slowed = Happens(Event("slow-down", time=Back()))
    assert one(Why(slowed), FakeWorld(CARS, WORLD.happened[:4]), stale).of.event.time == Between(  # type: ignore[union-attr]
        5.0, 7.0
    )
    assert one(Whether(slowed), said=fresh).that.event.time != Between(5.0, 7.0)  # type: ignore[union-attr]


def test_and_after_that_asks_whether_it_is_done_then() -> None:
    why_not = Why(Not(Happens(Event("overtake", object=Vehicle(1), tense="present"))))
    passed = Relative("after", Event("pass", Vehicle(2), tense="perfect"))
    found = act(Elliptic(time=passed), WORLD, talk(Vehicle(1), question=why_not)).acts[0].act
    assert isinstance(found, Ask)
    assert isinstance(found.question, Whether)
    event = found.question.that.event  # type: ignore[union-attr]
    assert event is not None
    assert (event.action, event.tense) == ("overtake", "future")


def test_why_not_after_a_suspicion_asks_of_the_suspect() -> None:
    suspected = Why(Happens(Event("slow-down", time=Between(5.0, 7.0))), suspect=Vehicle(2))
    found = act(Elliptic(form="why-not", negated=True), WORLD, talk(Vehicle(2), question=suspected))
    assert question_of(found).suspect == Vehicle(2)  # type: ignore[union-attr]


def test_where_of_an_extreme_is_told_with_it() -> None:
    highest = HowMuch(Measured("speed"), extreme="highest")
    found = act(Elliptic(form="where"), WORLD, talk(Vehicle(1), question=highest))
    assert question_of(found).extreme == "highest"  # type: ignore[union-attr]


def test_that_among_what_is_compared_is_what_was_asked_about() -> None:
    first_exit = Happens(Event("leave", object=Exit(1)))
    said = talk(question=Why(Not(first_exit)), propositions=(Happens(Event("continue")),))
    found = one(Compare((That(),), by="time"), said=said)
    assert found.options[0].event.object == Exit(1)  # type: ignore[union-attr]


def test_it_is_the_vehicle_of_the_turn_before_and_no_nearer_one() -> None:
    moved = Whether(Happens(Event("go", Pronoun("it"), tense="present")))
    found = one(moved, said=talk(Vehicle(2), Vehicle(1)))
    assert found.that.event.actor == Vehicle(2)  # type: ignore[union-attr]


def test_who_acts_beside_us_is_the_same_all_through() -> None:
    that = Pronoun("that")
    event = Event("overtake", that, Ego(), where=Related("left-of", that), tense="present")
    found = one(Whether(Happens(event)), said=talk(Vehicle(2), Vehicle(1)))
    grounded = found.that.event  # type: ignore[union-attr]
    assert grounded is not None
    assert grounded.where is not None
    assert grounded.where.thing == grounded.actor == Vehicle(2)
