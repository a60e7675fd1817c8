"""What is replied to acts of every kind, with a fake pipeline."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.dialogue.faked import Faked, Talk
from tests.dialogue.state.test_conversation import ANSWERS, FAST, REASON, SPEED, TEXTS, WHY
from xavi_dialogue.dialogue.acts import pertinent
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.domain.answers import (
    Acknowledged,
    Again,
    CannotSay,
    Comforting,
    Helpful,
    NoSuchVehicle,
    NotUnderstood,
    Sociable,
    Unfamiliar,
    Verdict,
    WhichOne,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import (
    Act,
    AskHelp,
    Beyond,
    Claim,
    Elliptic,
    Feel,
    Quizzing,
    Reading,
    Repair,
    Request,
    Social,
    TokenShare,
)
from xavi_dialogue.domain.terms import Ego, Event, Happens, Unknown, Vehicle
from xavi_dialogue.nlu.grounding.result import Grounding

BRAKED = Episode(Ego(), "slow-down", 4.0, 7.0)


def act(one: Act, **more: Any) -> GroundedAct:
    return GroundedAct(one, **more)


GREETING, THANKS, AGREE = (act(Social(kind)) for kind in ("greeting", "thanks", "agree"))
ASKED, AFRAID, JOKE = act(WHY), act(Feel("afraid")), act(Social("joke"))
INSULT, WHAT = act(Social("insult")), act(Repair("repeat"))
SIMPLER, MEANT, DISAGREE = act(Repair("simpler")), act(Repair("meant")), act(Social("disagree"))
YES, HURRY = act(Repair("yes")), act(Request(Event("speed-up")))


@pytest.mark.parametrize(
    ("acts", "replied"),
    [
        ((GREETING, ASKED), (ASKED,)),
        ((YES, ASKED), (ASKED,)),
        ((JOKE, ASKED), (JOKE, ASKED)),
        ((AFRAID, ASKED), (AFRAID, ASKED)),
        ((GREETING, THANKS), (GREETING,)),
        ((AGREE, THANKS), (THANKS,)),
        ((AGREE,), (AGREE,)),
        ((YES,), (YES,)),
        ((), ()),
        # Beside a question or request, surprise and abuse are passed over.
        ((INSULT, ASKED), (ASKED,)),
        ((WHAT, HURRY), (HURRY,)),
        ((INSULT, AFRAID), (INSULT, AFRAID)),
        ((WHAT, AFRAID), (WHAT, AFRAID)),
        # Once more in other words is not once more as it was.
        ((WHAT, SIMPLER), (SIMPLER,)),
        ((WHAT, MEANT), (WHAT, MEANT)),
        # "No, I meant": that is no disagreement.
        ((DISAGREE, MEANT), (MEANT,)),
        ((DISAGREE, AFRAID), (AFRAID,)),
        ((DISAGREE, act(WHY, leaned=True)), (act(WHY, leaned=True),)),
        ((DISAGREE,), (DISAGREE,)),
    ],
)
def test_courtesies_are_replied_to_where_there_is_nothing_else(
    acts: tuple[GroundedAct, ...], replied: tuple[GroundedAct, ...]
) -> None:
    assert pertinent(acts) == replied


def talk(texts: dict[str, tuple[Act, ...]], **changes: Any) -> Talk:
    known: dict[str, Any] = {"texts": {**TEXTS, **texts}, "answers": ANSWERS}
    return Talk(Faked(**{**known, **changes}))


def said(*acts: Act, before: tuple[str, ...] = (), **changes: Any) -> Turn:
    """The turn that comes of these acts after others."""
    one = talk({"it": acts}, **changes)
    for text in before:
        one.say(text)
    return one.say("it")


@pytest.mark.parametrize(
    ("one", "result"),
    [
        (Social("joke"), Sociable("joke")),
        (AskHelp(), Helpful()),
        (Quizzing(stop=True), Acknowledged("cancelled")),
        (Beyond("advice", "shares"), CannotSay("advice", "shares")),
        (Elliptic(event=Event("stop")), NotUnderstood()),
        (Repair("cancel"), Acknowledged("cancelled")),
        (Repair("yes"), Acknowledged("yes")),
        (Repair("no"), Acknowledged("no")),
        (Repair("correct"), Acknowledged("nothing-open")),
        (Repair("meant"), Acknowledged("nothing-open")),
        (Repair("pick", pick=2), Acknowledged("nothing-open")),
        (Repair("longer"), Acknowledged("nothing-open")),
        (Repair("continue"), Acknowledged("nothing-open")),
        (Repair("why"), NotUnderstood()),
    ],
)
def test_acts_that_are_about_no_drive(one: Act, result: Any) -> None:
    assert said(one).results == (result,)


@pytest.mark.parametrize(
    ("kind", "how"),
    [("longer", "longer"), ("continue", "longer"), ("shorter", "shorter"), ("simpler", "simpler")],
)
def test_the_last_answer_is_told_otherwise(kind: Any, how: Any) -> None:
    assert said(Repair(kind), before=("why",)).results == (Again(how, REASON),)
    assert said(Repair(kind), before=("why", "hello")).results == (Again(how, REASON),)
    assert said(Repair(kind), before=("why", "speed")).results == (Again(how, SPEED),)
    assert said(Repair(kind), before=("why", "more")).results == (Again(how, REASON),)
    assert said(Repair(kind), before=("why", "more", "hello")).results == (Again(how, REASON),)


def test_every_answer_of_the_last_turn_is_told_otherwise_but_not_words_not_known() -> None:
    found = said(Repair("simpler"), before=("both",), doubts={WHY: ("flurb",)})
    assert found.results == (Again("simpler", REASON), Again("simpler", SPEED))


def test_the_same_words_are_said_again_whatever_came_of_the_turn() -> None:
    one = talk({})
    first = one.say("hello")
    again = one.say("what")
    assert again.reply.text == first.reply.text
    assert again.parts == first.parts
    one.say("why")
    more = one.say("more")
    again = one.say("what")
    assert again.results == more.results
    assert [part.act for part in more.parts] == [act(Repair("longer"))]
    assert [part.act for part in again.parts] == [None]
    one.at += 5.0
    assert one.say("what").reply.sim_time == one.at


def test_a_question_of_ours_is_put_again_however_it_is_to_be_told() -> None:
    it = TEXTS["it"][0]
    asks = Grounding(clarify=WhichOne((Vehicle(1), Vehicle(2))), offers=(FAST, FAST))
    one = talk({}, groundings={it: asks})
    first = one.say("it")
    for text in ("more", "what"):
        again = one.say(text)
        assert again.reply.text == first.reply.text
        assert again.offer == first.offer
        assert again.offer is not None


def test_a_feeling_alone_gets_the_fact_that_bears_on_it() -> None:
    afraid = Feel("afraid")
    assert said(afraid).results == (Comforting(afraid),)
    fact = Comforting(afraid, SPEED)
    answers = {**ANSWERS, afraid: fact}
    assert said(afraid, answers=answers).results == (fact,)
    beside = said(afraid, FAST, answers=answers)
    assert set(beside.results) == {Comforting(afraid), SPEED}


def test_what_was_not_understood_of_a_turn_is_owned_up_to() -> None:
    flurb, zig = ("flurb",), ("zig", "flurb")
    found = said(WHY, FAST, doubts={WHY: flurb, FAST: zig})
    assert found.results == (Unfamiliar(("flurb", "zig")), REASON, SPEED)
    # Nothing was made of it at all: then it says so itself.
    lost = Elliptic(event=Event("stop"))
    assert said(lost, doubts={lost: flurb}).results == (NotUnderstood(),)
    # A cry for help beside a question is not answered, and doubts about it do not matter.
    assert said(AskHelp(), FAST, doubts={AskHelp(): flurb}).results == (SPEED,)
    assert said(AskHelp(), doubts={AskHelp(): flurb}).results == (Unfamiliar(flurb), Helpful())


def test_a_word_that_is_known_but_had_no_part_is_told_after_the_answer() -> None:
    doubtful = act(FAST, doubts=("green", "flurb"), strange=("flurb",))
    found = said(FAST, groundings={FAST: Grounding(acts=(doubtful,), reading=READING)})
    assert found.results == (Unfamiliar(("flurb",)), SPEED, Unfamiliar(("green",), known=True))


READING = Reading(acts=(FAST,), shares=())
OPEN = Verdict(Happens(Event("stop", Unknown("x"))), holds=True)


def test_a_question_whose_answer_says_nothing_was_not_understood() -> None:
    one = Grounding(acts=(act(WHY), act(FAST)), quotes=("why", "how fast"))
    found = said(FAST, groundings={FAST: one}, answers={**ANSWERS, FAST: OPEN})
    assert found.results == (REASON, NotUnderstood(quote="how fast", rest=True))
    alone = Grounding(acts=(act(FAST),), quotes=("how fast",))
    found = said(FAST, groundings={FAST: alone}, answers={**ANSWERS, FAST: OPEN})
    assert found.results == (NotUnderstood(quote="how fast"),)
    claim = Claim(Happens(Event("stop", Unknown("x"))))
    assert said(claim, FAST, answers={**ANSWERS, claim: OPEN}).results == (SPEED,)
    behind = Grounding(acts=(act(FAST),), refusal=NoSuchVehicle(Vehicle(9), 7.0))
    found = said(FAST, groundings={FAST: behind}, answers={**ANSWERS, FAST: OPEN})
    assert found.results == (NoSuchVehicle(Vehicle(9), 7.0),)


def test_who_was_named_is_kept_with_what_was_not_understood() -> None:
    one = Grounding(acts=(act(FAST),), refusal=NotUnderstood(rest=True), named=Vehicle(3))
    found = said(FAST, groundings={FAST: one})
    assert found.results == (SPEED, NotUnderstood(rest=True))
    assert found.parts[1].act == act(Elliptic(Vehicle(3)))
    other = replace(one, refusal=NoSuchVehicle(Vehicle(9), 7.0))
    assert said(FAST, groundings={FAST: other}).parts[1].act is None


def test_words_of_which_nothing_was_made_are_named() -> None:
    shares = (TokenShare("flurb", "flurb", "unknown", strange=True),)
    nothing = Grounding(reading=Reading(acts=(), shares=shares))
    assert said(FAST, groundings={FAST: nothing}).results == (NotUnderstood(words=("flurb",)),)


def test_an_unclear_question_is_told_as_what_it_was_taken_for() -> None:
    reading = Reading(acts=(FAST,), shares=(), paraphrase="How fast are we?")
    one = Grounding(acts=(act(FAST),), reading=reading)
    found = said(FAST, groundings={FAST: one})
    assert found.reply.text == "TakenAs. Measures."
    assert [answer["is"] for answer in found.reply.answers] == ["TakenAs", "Measures"]
    refused = said(FAST, groundings={FAST: one}, answers={**ANSWERS, FAST: CannotSay("x")})
    assert refused.reply.text == "CannotSay."
