"""What a turn leaves in the discourse: mentions, times, propositions, and how many are kept."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.dialogue.state.test_chain import (
    BELIEF,
    BRAKED,
    CONTRAST,
    LEADER,
    STANDS,
    TURNED,
    turn,
    why,
)
from xavi_dialogue.dialogue.chain import deeper
from xavi_dialogue.dialogue.state.assertions import event_of
from xavi_dialogue.dialogue.state.discourse import after, causes_of, discourse_of
from xavi_dialogue.dialogue.state.turn import Offer, Part, Turn
from xavi_dialogue.domain.answers import (
    Activity,
    Beliefs,
    ChoiceReason,
    Grounds,
    Happenings,
    Helpful,
    Identified,
    Measures,
    MotionCause,
    MotionReason,
    PeakMoment,
    PlanAhead,
    Verdict,
)
from xavi_dialogue.domain.discourse import Discourse, GroundedAct, Span
from xavi_dialogue.domain.facts import Episode, Expectation, Look, Measure
from xavi_dialogue.domain.meaning import Ask, Claim, Feel, HowKnow, Identify, Social, Whether, Why
from xavi_dialogue.domain.terms import At, Ego, Event, Happens, Vehicle, Vehicles

STOPS = Happens(Event("stop", Vehicle(9)))
LAST = Episode(Vehicle(5), "stand", 7.0, 8.0)
THREE = (BRAKED, LAST, TURNED)


def spoken(result: Any, **fields: Any) -> Turn:
    """A turn of talk with this result, so that only the result counts."""
    return replace(turn(result, act=Social("joke")), **fields)


def weights(one: Turn) -> dict[Any, float]:
    """How salient each thing is after a turn, by its part there (said by us: 0.97 of it)."""
    return {m.thing: round(m.salience / 0.97, 6) for m in discourse_of([one]).mentions}


CAUSE, SUBJECT, OTHER = 0.95, 1.0, 0.7
LOOK = Look(3, 5.0, "car", "blue", 4.5, "left", 8.0, 0.0, 8.0, 9.0)


@pytest.mark.parametrize(
    ("result", "found"),
    [
        (ChoiceReason("why", None, CONTRAST), {Vehicle(3): CAUSE}),  # we are no vehicle
        (MotionReason(BRAKED, (LEADER,)), {Vehicle(3): CAUSE}),
        (MotionReason(BRAKED, (MotionCause("limit"),)), {}),
        (Identified((LOOK,)), {Vehicle(3): SUBJECT}),
        (Identified((LOOK, replace(LOOK, vehicle=4))), {Vehicles((3, 4)): SUBJECT}),
        (Happenings("list", (BRAKED, TURNED)), {Vehicle(3): OTHER}),
        (Happenings("list", (replace(BRAKED, object=Vehicle(6)),)), {Vehicle(6): OTHER}),
        (Measures((Measure("gap", Vehicle(3), 5.0, 9.0, to=Vehicle(4)),)),
         {Vehicle(3): OTHER, Vehicle(4): OTHER}),
        (Measures((Measure("speed", Ego(), 5.0, 9.0),)), {}),
    ],
)  # fmt: skip
def test_who_has_which_part_in_an_answer(result: Any, found: dict[Any, float]) -> None:
    assert weights(spoken(result)) == found


def test_whom_the_words_name_is_spoken_of() -> None:
    assert weights(spoken(Helpful(), mentioned=(4, 2))) == {Vehicle(4): OTHER, Vehicle(2): OTHER}
    asked = turn(Helpful(), act=Ask(Identify(Vehicle(8))))
    (mention,) = discourse_of([asked]).mentions
    assert (mention.thing, mention.by_car, mention.salience) == (Vehicle(8), False, 1.0)


def test_causes_with_what_was_expected() -> None:
    assert list(causes_of(ChoiceReason("why", None, CONTRAST))) == [
        (0, ("stop",)), (3, ("continue", "exit-right"))
    ]  # fmt: skip
    reason = MotionReason(BRAKED, (MotionCause("limit"), LEADER))
    assert list(causes_of(reason)) == [(3, ("exit-right",))]


def test_no_more_than_twenty_turns_count() -> None:
    turns = [spoken(Helpful(), mentioned=(k,)) for k in range(1, 31)]
    found = discourse_of(turns)
    assert found.turn == 30
    named = turn(Verdict(STOPS, holds=True), act=Ask(Whether(STOPS)))
    talk = spoken(Helpful())
    assert discourse_of([named, *[talk] * 19]).propositions == (STOPS,)
    assert discourse_of([named, *[talk] * 20]).propositions == ()


def test_no_more_than_six_propositions_and_four_times_are_kept() -> None:
    claims = [Happens(Event("stop", Vehicle(k))) for k in range(8)]
    turns = [turn(Helpful(), act=Claim(that)) for that in claims]
    assert discourse_of(turns).propositions == tuple(reversed(claims[2:]))

    def asked(*ends: float, **more: Any) -> Turn:
        acts = [GroundedAct(Ask(Why(STOPS)), Span(0.0, end, said=True)) for end in ends]
        acts = [replace(act, span=replace(act.span, **more)) for act in acts]  # type: ignore[type-var]
        one = turn(Helpful())
        return replace(one, parts=tuple(Part(act, Helpful()) for act in acts))

    found = discourse_of([asked(1.0), asked(2.0, 3.0), asked(2.0), asked(5.0), asked(6.0)])
    assert found.times == (6.0, 5.0, 2.0, 3.0)
    assert discourse_of([asked(1.0, said=False), asked(2.0, ahead=True)]).times == ()


def test_what_was_offered_lasts_for_one_turn() -> None:
    offer = Offer(acts=(Ask(Why(STOPS)),), things=(Vehicle(1),), pending=Feel("afraid"))
    found = discourse_of([spoken(Helpful(), offer=offer)])
    assert (found.offered, found.offered_things) == (offer.acts, offer.things)
    assert found.pending == Feel("afraid")
    later = after(found, spoken(Helpful()))
    assert (later.offered, later.offered_things, later.pending) == ((), (), None)
    assert after(Discourse(), spoken(Helpful())).question is None


@pytest.mark.parametrize(
    ("deed", "event"),
    [
        (BRAKED, Event("slow-down", time=At(5.0), tense="past")),
        (STANDS, Event("stand", Vehicle(3), time=At(4.0), tense="present")),
        (replace(BRAKED, object=Vehicle(2), side="left"),
         Event("slow-down", object=Vehicle(2), side="left", time=At(5.0), tense="past")),
    ],
)  # fmt: skip
def test_an_episode_is_an_event(deed: Episode, event: Event) -> None:
    assert event_of(deed) == event


TURN_EVENT = Event("exit-right", Vehicle(3), time=At(6.0), tense="past")
OTHERS = replace(BELIEF, vehicle=7, expectations=(Expectation(("stop",), 0.9),))


@pytest.mark.parametrize("deeds", [(TURNED,), THREE])
def test_the_last_of_several_deeds_is_what_that_was(deeds: tuple[Episode, ...]) -> None:
    for result in (Happenings("when", deeds), Activity(Vehicle(3), 9.0, deeds, 3.0, None),
                   Identified((LOOK,), STOPS, deeds)):  # fmt: skip
        found = discourse_of([turn(result)])
        assert found.propositions == (Happens(TURN_EVENT),)
        assert found.episode == (6.0, 9.0)
    assert deeper(turn(Happenings("list", deeds))) == why(TURN_EVENT)


def test_who_somebody_is_is_no_topic_though_it_tells_what_he_does() -> None:
    assert discourse_of([turn(Identified((LOOK,), facts=THREE))]).episode is None


@pytest.mark.parametrize(("later", "episode"), [(20.0, (6.0, 9.0)), (30.0, None)])
def test_what_was_spoken_of_is_over_after_a_while(later: float, episode: Any) -> None:
    before = discourse_of([turn(Happenings("when", (TURNED,)))])
    asked = spoken(Helpful())
    reply = replace(asked.reply, sim_time=later)
    assert after(before, replace(asked, reply=reply)).episode == episode


@pytest.mark.parametrize("history", [(BELIEF,), (OTHERS, OTHERS, BELIEF)])
def test_the_last_of_several_beliefs_is_what_was_expected(history: Any) -> None:
    will = Event("exit-right", Vehicle(3), tense="future", modal="will")
    assert discourse_of([turn(Beliefs(3, None, history))]).propositions == (Happens(will),)
    expected = replace(will, time=At(4.0), tense="past")
    assert deeper(turn(Beliefs(3, None, history))) == Ask(HowKnow(Happens(expected)))


def test_the_first_of_a_peak_or_plan_and_the_last_of_what_is_shown() -> None:
    assert deeper(turn(PeakMoment("danger", 5.0, THREE))) == why(event_of(BRAKED))
    plan = PlanAhead((("stop", 11.0), ("continue", 12.0), ("exit-left", 13.0)))
    will = Event("stop", tense="future", modal="will")
    assert discourse_of([turn(plan)]).propositions == (Happens(will),)
    shown = Grounds(3, ("continue", "stop", "exit-right"), True, ())
    turns = Event("exit-right", Vehicle(3), tense="future", modal="will")
    assert discourse_of([turn(shown)]).propositions == (Happens(turns),)


@pytest.mark.parametrize(("end", "kept"), [(65.0, True), (65.1, False)])
def test_a_long_stretch_is_no_episode(end: float, kept: bool) -> None:
    long = replace(BRAKED, end=end)
    assert discourse_of([turn(MotionReason(long, ()))]).episode == ((5.0, end) if kept else None)
