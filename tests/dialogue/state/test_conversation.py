"""Turns of several acts, repairs, clarifications and whys, with a fake pipeline."""

import msgspec
import pytest

from tests.dialogue.faked import NAME, Faked, Talk
from tests.traces import s1_ride
from xavi_dialogue.dialogue.state.events import Answered, RolloutsArrived, RolloutsFailed
from xavi_dialogue.dialogue.state.states import Phase
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.domain.answers import (
    Acknowledged,
    Again,
    CannotSay,
    Cause,
    ChoiceReason,
    Comforting,
    Contrast,
    Evidence,
    Grounds,
    Measures,
    NeedRollout,
    NoSuchVehicle,
    NotApplicable,
    NotUnderstood,
    Sociable,
    Unavailable,
    Unfamiliar,
    WhichOne,
)
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.meaning import (
    Ask,
    Beyond,
    Elliptic,
    Feel,
    HowKnow,
    HowMuch,
    HowSure,
    Repair,
    Social,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Described,
    Ego,
    Event,
    Happens,
    Measured,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.result import Grounding

CHANGED = Episode(Ego(), "change-left", 4.0, 7.0)
TRACE = s1_ride().traces[1].trace_id
CONTRAST = Contrast(
    fact=("change-left",),
    foil=("continue",),
    outcome=None,
    effects=(),
    causes=(Cause(1, ("change-right", "exit-right"), 0.8),),
    evidence=Evidence("tree", 60, 12, (TRACE,)),
    decided=4.0,
)
REASON = ChoiceReason("why", CHANGED, CONTRAST)
SPEED = Measures((Measure("speed", Ego(), 7.0, 12.0),))
WHY = Ask(Why(Happens(Event("change-left"))))
FAST = Ask(HowMuch(Measured("speed")))
TURNS = Event("exit-right", Vehicle(1), time=At(4.0), modal="will")
BELIEF = Ask(Why(Believed(Happens(TURNS), time=At(4.0))))
EVIDENCE = Ask(HowKnow(Happens(TURNS)))
GROUNDS = Grounds(1, ("exit-right",), False, ())
NEED = NeedRollout(TRACE, removed=1)
TEXTS = {
    "why": (WHY,),
    "speed": (FAST,),
    "both": (WHY, FAST),
    "hello": (Social("greeting"),),
    "thanks, speed": (Social("thanks"), FAST),
    "scared": (Feel("afraid"),),
    "scared, speed": (Feel("afraid"), FAST),
    "why?": (Elliptic(form="why"),),
    "how do you know": (Ask(HowKnow()),),
    "sure?": (Ask(HowSure()),),
    "more": (Repair("longer"),),
    "what": (Repair("repeat"),),
    "say that simpler": (Repair("repeat"), Repair("simpler")),
    "never mind": (Repair("cancel"),),
    "fog": (Beyond("capability", "fog"),),
    "second": (Repair("pick", pick=2),),
    "it": (Ask(HowMuch(Measured("speed", Described(kind="car")))),),
}
ANSWERS = {
    WHY: REASON,
    FAST: SPEED,
    BELIEF: GROUNDS,
    EVIDENCE: GROUNDS,
    Feel("afraid"): CannotSay("x"),
}


def talk(**changes: object) -> Talk:
    return Talk(Faked(**{"texts": TEXTS, "answers": ANSWERS, **changes}))  # type: ignore[arg-type]


def results(turn: Turn) -> list[type]:
    return [type(result) for result in turn.results]


def test_an_answer_carries_meaning_answer_evidence_and_the_object_of_the_contract() -> None:
    reply = talk().say("why").reply
    assert reply.kind == "answer"
    assert reply.trace_id == TRACE
    assert reply.query is not None
    assert (reply.query.type, reply.query.factual) == ("why", ("change-left",))
    assert reply.explanation is not None
    assert reply.explanation["kind"] == "choice-reason"
    assert reply.explanation["counterfactual"] == ["continue"]
    assert [answer["is"] for answer in reply.answers] == ["ChoiceReason"]
    assert [act["is"] for act in reply.acts] == ["GroundedAct"]


def test_facts_are_told_by_kind_and_what_they_hold() -> None:
    explanation = talk().say("speed").reply.explanation
    assert explanation is not None
    assert explanation["kind"] == "measures"
    assert len(explanation["measures"]) == 1  # type: ignore[arg-type]


def test_several_questions_are_answered_in_order() -> None:
    turn = talk().say("both")
    assert results(turn) == [ChoiceReason, Measures]
    assert turn.reply.text == "ChoiceReason. Measures."


def test_a_sentence_is_not_said_twice() -> None:
    turn = talk(answers={WHY: SPEED, FAST: SPEED}).say("both")
    assert turn.reply.text == "Measures."


def test_the_first_answer_is_not_lost_because_the_second_fails() -> None:
    refused = NotApplicable(("change-left",), "no lane")
    turn = talk(answers={WHY: REASON, FAST: refused}).say("both")
    assert turn.reply.kind == "answer"
    assert turn.reply.text == "ChoiceReason. NotApplicable."


def test_courtesies_beside_a_question_need_no_reply() -> None:
    assert results(talk().say("thanks, speed")) == [Measures]
    assert results(talk().say("hello")) == [Sociable]


def test_a_feeling_and_a_question_get_one_reply() -> None:
    turn = talk().say("scared, speed")
    assert turn.results == (Comforting(Feel("afraid")), SPEED)
    assert talk().say("scared").results == (Comforting(Feel("afraid")),)


def test_words_that_are_not_known_are_owned_up_to_first() -> None:
    turn = talk(doubts={FAST: ("flurb",)}).say("speed")
    assert turn.results == (Unfamiliar(("flurb",)), SPEED)


def test_what_is_not_read_at_all_is_not_understood() -> None:
    reply = talk().say("asdf").reply
    assert (reply.kind, reply.reason, reply.query) == ("refusal", "not-understood", None)


def test_topics_beyond_the_drive_are_declined() -> None:
    reply = talk().say("fog").reply
    assert (reply.kind, reply.reason) == ("refusal", "out-of-scope")


def test_rollouts_are_asked_for_and_the_rest_is_answered_after_them() -> None:
    def planned(record):  # type: ignore[no-untyped-def]
        return REASON if record.extra else NEED

    one = talk(answers={WHY: planned, FAST: SPEED})
    trace = _planned_again()
    assert one.wants("both") == NEED
    assert one.session.phase is Phase.PLANNING
    done = one.put(RolloutsArrived("1", NAME, trace))
    assert isinstance(done, Answered)
    assert done.reply.text == "ChoiceReason. Measures."


def test_without_the_rollouts_the_rest_is_answered_all_the_same() -> None:
    one = talk(answers={WHY: NEED, FAST: SPEED})
    one.wants("both")
    done = one.put(RolloutsFailed("1", NAME, "planner-unavailable"))
    assert isinstance(done, Answered)
    assert done.turn is not None
    assert done.turn.results == (Unavailable("planner-unavailable"), SPEED)
    one.wants("why")
    alone = one.put(RolloutsFailed("2", NAME, "timed-out"))
    assert isinstance(alone, Answered)
    assert (alone.reply.kind, alone.reply.reason) == ("refusal", "timed-out")


def _planned_again():  # type: ignore[no-untyped-def]
    from msgspec.structs import replace

    from planner.record.trace import WhatIf

    return replace(s1_ride().traces[1], what_if=WhatIf(removed=1))


def test_whys_go_from_the_decision_to_the_belief_to_the_evidence_and_end() -> None:
    one = talk()
    one.say("why")
    assert one.say("why?").acts[0].act == BELIEF
    assert one.say("why?").results == (CannotSay("deeper"),)
    assert one.say("why?").results == (CannotSay("deeper"),)


def test_how_do_you_know_asks_for_the_evidence_of_what_was_expected() -> None:
    one = talk()
    one.say("why")
    assert one.say("how do you know").acts[0].act == EVIDENCE


def test_a_bare_why_at_first_is_left_to_its_words() -> None:
    assert talk().say("why?").results == (NotUnderstood(),)


def test_more_is_the_last_answer_at_length_and_again_it_stays_so() -> None:
    one = talk()
    assert one.say("more").results == (Acknowledged("nothing-open"),)
    one.say("why")
    assert one.say("more").results == (Again("longer", REASON),)
    assert one.say("more").results == (Again("longer", REASON),)
    one.say("speed")
    assert one.faked.contexts[-1].detail == "more"


def test_a_repeat_says_the_same_words() -> None:
    one = talk()
    first = one.say("why").reply
    again = one.say("what").reply
    assert msgspec.structs.replace(again, sim_time=first.sim_time) == first


def test_what_is_wanted_in_other_words_is_not_said_as_it_was_too() -> None:
    one = talk()
    one.say("why")
    assert one.say("say that simpler").results == (Again("simpler", REASON),)


def test_a_repeat_is_no_further_wish_for_more() -> None:
    one = talk()
    one.say("why")
    one.say("more")
    one.say("what")
    one.say("speed")
    assert one.faked.contexts[-1].detail == "usual"


def test_never_mind_closes_the_matter() -> None:
    assert talk().say("never mind").results == (Acknowledged("cancelled"),)


@pytest.fixture
def clarified() -> Talk:
    first = Ask(HowMuch(Measured("speed", Vehicle(1))))
    second = Ask(HowMuch(Measured("speed", Vehicle(2))))
    asked = Grounding(
        clarify=WhichOne((Vehicle(1), Vehicle(2))),
        offers=(first, second),
        offered_things=(Vehicle(1), Vehicle(2)),
        pending=TEXTS["it"][0],
    )
    one = talk(groundings={TEXTS["it"][0]: asked}, answers={**ANSWERS, second: SPEED})
    one.say("it")
    return one


@pytest.mark.parametrize("text", ["2", "(2)", "that one", "That one"])
def test_a_clarification_is_answered_by_what_it_says(clarified: Talk, text: str) -> None:
    assert clarified.say(text).results == (SPEED,)


def test_a_clarification_is_answered_by_number(clarified: Talk) -> None:
    reply = clarified.session.turns[-1].reply
    assert (reply.kind, reply.reason, len(reply.choices)) == ("clarification", "ambiguous", 2)
    assert clarified.session.phase is Phase.CHOOSING
    assert clarified.say("second").results == (SPEED,)
    assert clarified.session.phase is Phase.LISTENING


def test_what_was_offered_stays_open_where_it_is_to_be_said_again(clarified: Talk) -> None:
    first = clarified.session.turns[-1].reply.text
    assert clarified.say("more").reply.text == first
    assert clarified.session.phase is Phase.CHOOSING
    assert clarified.say("second").results == (SPEED,)


def test_what_a_clarification_offers_is_known_to_the_next_turn(clarified: Talk) -> None:
    clarified.say("speed")
    discourse = clarified.faked.discourses[-1]
    assert discourse.offered_things == (Vehicle(1), Vehicle(2))
    clarified.say("speed")
    assert clarified.faked.discourses[-1].offered_things == ()


def test_a_vehicle_described_wrongly_is_put_right_before_the_answer() -> None:
    from tests.dialogue.state.test_discourse import LOOK

    wrong = NoSuchVehicle(Described(colour="red"), 7.0, misdescribed=LOOK)
    found = Grounding(acts=_grounded(FAST), refusal=wrong)
    turn = talk(groundings={FAST: found}).say("speed")
    assert turn.results == (wrong, SPEED)


def _grounded(act):  # type: ignore[no-untyped-def]
    from xavi_dialogue.domain.discourse import GroundedAct

    return (GroundedAct(act),)


def test_a_turn_survives_storage_and_the_conversation_goes_on() -> None:
    one = talk()
    one.say("why")
    turns = msgspec.json.decode(msgspec.json.encode(one.session.turns), type=tuple[Turn, ...])
    assert turns == one.session.turns
    other = talk()
    other.resume(turns)
    assert other.say("why?").acts[0].act == one.say("why?").acts[0].act
