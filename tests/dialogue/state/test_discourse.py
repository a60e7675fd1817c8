"""What a conversation comes to: mentions, episode, question, propositions."""

from typing import Any

import pytest

from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.discourse import after, discourse_of
from xavi_dialogue.dialogue.state.turn import Part, Turn
from xavi_dialogue.domain.answers import Activity, Identified, MotionCause, MotionReason, Verdict
from xavi_dialogue.domain.discourse import Discourse, GroundedAct, Span
from xavi_dialogue.domain.facts import Belief, Episode, Expectation, Look
from xavi_dialogue.domain.meaning import Act, Ask, Claim, Doing, Identify, Social, Whether, Why
from xavi_dialogue.domain.terms import (
    At,
    Described,
    Ego,
    Event,
    Happens,
    Not,
    Vehicle,
    Vehicles,
)

LOOK = Look(3, 5.0, "car", "blue", 4.5, "left", 8.0, 0.0, 8.0, 9.0)
BRAKED = Episode(Ego(), "slow-down", 5.0, 8.0)


def turn(act: Act, result, mentioned: tuple[int, ...] = (), span: Span | None = None) -> Turn:  # type: ignore[no-untyped-def]
    reply = Reply(text="", kind="answer", sim_time=10.0)
    return Turn(
        text="", parts=(Part(GroundedAct(act, span), result),), reply=reply, mentioned=mentioned
    )


def brake() -> Turn:
    cause = MotionCause("leader", 3, ("stop",), 0.9, 4.0)
    return turn(Ask(Why(Happens(Event("brake")))), MotionReason(BRAKED, (cause,)), (3,))


def salience(discourse: Discourse, thing: object) -> float:
    return next((m.salience for m in discourse.mentions if m.thing == thing), 0.0)


def test_a_cause_is_spoken_of_and_the_deed_is_what_that_was() -> None:
    found = discourse_of([brake()])
    assert found.mentions[0].thing == Vehicle(3)
    assert found.mentions[0].by_car
    assert found.episode == (5.0, 8.0)
    assert found.question == Why(Happens(Event("brake")))
    assert found.propositions[0] == Happens(Event("slow-down", time=At(5.0)))
    assert found.asked_at == 10.0


def test_what_is_asked_about_counts_more_than_what_was_said_before() -> None:
    told = turn(Ask(Identify(Vehicle(4))), Identified((LOOK,)))
    found = discourse_of([brake(), told])
    assert salience(found, Vehicle(4)) > 0.0
    assert found.turn == 2
    assert max(found.mentions, key=lambda m: m.salience).turn == 1


def test_several_that_were_pointed_out_are_a_group() -> None:
    from msgspec.structs import replace

    looks = (LOOK, replace(LOOK, vehicle=4))
    found = discourse_of([turn(Ask(Identify(Described())), Identified(looks))])
    assert salience(found, Vehicles((3, 4))) > 0.0


def test_small_talk_leaves_what_was_spoken_of() -> None:
    from xavi_dialogue.domain.answers import Sociable

    before = discourse_of([brake()])
    found = after(before, turn(Social("thanks"), Sociable("thanks")))
    assert found.question == before.question
    assert found.episode == before.episode
    assert 0.0 < salience(found, Vehicle(3)) < salience(before, Vehicle(3))


def test_a_denial_asserts_the_contrary_and_a_claim_stands_behind_it() -> None:
    that = Happens(Event("stop", Vehicle(3)))
    found = discourse_of([turn(Claim(that), Verdict(that, holds=False))])
    assert found.propositions == (Not(that), that)


def test_a_time_that_was_named_is_the_episode_where_the_answer_has_none() -> None:
    asked = Ask(Whether(Happens(Event("stop"))))
    found = discourse_of(
        [turn(asked, Verdict(Not(Happens(Event("stop"))), None), span=Span(2.0, 4.0))]
    )
    assert found.episode == (2.0, 4.0)


@pytest.mark.parametrize(
    "actions", [("change-left",), ("slow-down", "change-left"), ("stop", "give-way", "change-left")]
)
def test_of_what_somebody_is_expected_to_do_the_last_is_what_that_is(actions: Any) -> None:
    belief = Belief(3, 10.0, (Expectation(actions, 0.9), Expectation(("stop",), 0.1)))
    told = Activity(Vehicle(3), 10.0, (), 9.0, None, LOOK, belief)
    found = discourse_of([turn(Ask(Doing(Vehicle(3))), told, (3,))])
    expected = Happens(Event("change-left", Vehicle(3), tense="future", modal="will"))
    assert [p for p in found.propositions if p == expected] == [expected]
    assert not [
        p for p in found.propositions if isinstance(p, Happens) and p.event.action == "stop"
    ]
