"""What an answer leaves behind: what it says is so, when that was, and whether it says anything."""

import pytest
from msgspec.structs import replace

from tests.dialogue.state.test_chain import BELIEF, BRAKED, CONTRAST, LEADER, TURNED, turn
from xavi_dialogue.dialogue.soundness import is_told_within, says_something
from xavi_dialogue.dialogue.state.discourse import after, discourse_of
from xavi_dialogue.domain.answers import (
    Activity,
    Answer,
    Beliefs,
    Bound,
    ChoiceReason,
    Declined,
    DidNotHappen,
    Grounds,
    Happenings,
    Helpful,
    Identified,
    Measures,
    MotionReason,
    OtherReason,
    PeakMoment,
    PlanAhead,
    Priority,
    PullingUp,
    Sociable,
    SupposedOfOther,
    SupposedOfUs,
    Verdict,
)
from xavi_dialogue.domain.discourse import Discourse, GroundedAct, Span
from xavi_dialogue.domain.facts import Episode, Look, Measure
from xavi_dialogue.domain.meaning import Ask, Claim, Request, Social, Whether, Why
from xavi_dialogue.domain.terms import (
    At,
    Compares,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Happens,
    Is,
    Measured,
    Nobody,
    Not,
    Proposition,
    Related,
    Unknown,
    Vehicle,
    Wanted,
)

STOPS = Happens(Event("stop", Vehicle(3)))
DID_BRAKE = Happens(Event("slow-down", time=At(5.0), tense="past"))
DID_TURN = Happens(Event("exit-right", Vehicle(3), time=At(6.0), tense="past"))
WILL_TURN = Happens(Event("exit-right", Vehicle(3), tense="future", modal="will"))
LOOK = Look(3, 5.0, "car", "blue", 4.5, "left", 8.0, 0.0, 8.0, 9.0)


@pytest.mark.parametrize(
    ("result", "said"),
    [
        (Verdict(STOPS, holds=True), (STOPS,)),
        (Verdict(STOPS, holds=False), (Not(STOPS),)),
        (Verdict(Not(STOPS), holds=False), (STOPS,)),
        (Verdict(STOPS, holds=None), ()),
        (ChoiceReason("why", BRAKED, CONTRAST), (DID_BRAKE,)),
        (ChoiceReason("why", None, CONTRAST), ()),
        (MotionReason(BRAKED, (LEADER,)), (DID_BRAKE,)),
        (OtherReason(3, TURNED), (DID_TURN,)),
        (Bound(Vehicle(3), went=TURNED), (DID_TURN,)),
        (Bound(Vehicle(3), BELIEF), (WILL_TURN,)),
        (Happenings("list", (BRAKED, TURNED)), (DID_TURN,)),
        (Identified((LOOK,), facts=(BRAKED, TURNED)), (DID_TURN,)),
        (Identified((LOOK,)), ()),
        (PeakMoment("danger", 5.0, (BRAKED, TURNED)), (DID_BRAKE,)),
        (
            DidNotHappen(Event("stop"), (TURNED, BRAKED)),
            (DID_BRAKE, Not(Happens(Event("stop")))),
        ),
        (
            SupposedOfUs(CONTRAST),
            (Happens(Event("continue", time=At(4.0), modal="would")),),
        ),
        (
            SupposedOfOther(3, None, None, ("stop",), ("exit-left", "continue"), False),
            (Happens(Event("exit-left", tense="past", modal="would")),),
        ),
        (
            SupposedOfOther(3, None, None, ("stop",), ("continue",), False, past=False),
            (Happens(Event("continue", tense="future", modal="would")),),
        ),
        (Grounds(3, ("continue", "exit-right"), True, ()), (WILL_TURN,)),
        (
            PlanAhead((("stop", 11.0), ("continue", 12.0))),
            (Happens(Event("stop", tense="future", modal="will")),),
        ),
        (Activity(Ego(), 9.0, (TURNED, BRAKED), 3.0, None), (DID_BRAKE,)),
        (Activity(Vehicle(3), 9.0, (), 3.0, None, belief=BELIEF), (WILL_TURN,)),
        (Beliefs(3, None, (replace(BELIEF, vehicle=4), BELIEF)), (WILL_TURN,)),
        (Beliefs(3, None, ()), ()),
        (Helpful(), ()),
    ],
)
def test_what_we_said_to_be_so(result: Answer, said: tuple[Proposition, ...]) -> None:
    assert discourse_of([turn(result)]).propositions == said


def test_what_was_asked_stands_where_it_was_not_answered() -> None:
    asked = Ask(Whether(STOPS))
    assert discourse_of([turn(Verdict(STOPS, holds=None), act=asked)]).propositions == (STOPS,)
    assert discourse_of([turn(Verdict(STOPS, holds=True), act=asked)]).propositions == (STOPS,)
    denied = discourse_of([turn(Verdict(STOPS, holds=False), act=asked)])
    assert denied.propositions == (Not(STOPS),)
    claimed = discourse_of([turn(Helpful(), act=Claim(STOPS))])
    assert claimed.propositions == (STOPS,)


def episode(result: Answer, span: Span | None = None) -> tuple[float, float] | None:
    one = turn(result)
    part = replace(one.parts[0], act=GroundedAct(Ask(Why(STOPS)), span))
    return discourse_of([replace(one, parts=(part,))]).episode


@pytest.mark.parametrize(
    ("result", "stretch"),
    [
        (MotionReason(BRAKED, ()), (5.0, 8.0)),
        (MotionReason(replace(BRAKED, end=None), ()), (5.0, 10.0)),
        (OtherReason(3, TURNED), (6.0, 9.0)),
        (Bound(Vehicle(3), went=TURNED), (6.0, 9.0)),
        (ChoiceReason("why", BRAKED, CONTRAST), (5.0, 8.0)),
        (ChoiceReason("why", None, CONTRAST), (4.0, 4.0)),
        (SupposedOfUs(CONTRAST), (4.0, 4.0)),
        (Happenings("when", (BRAKED, TURNED)), (6.0, 9.0)),
        (Happenings("list", (BRAKED, TURNED)), None),
        (Happenings("summary", (BRAKED, TURNED)), None),
        (Priority(7.0, "give-way"), (7.0, 7.0)),
        (Beliefs(3, None, (BELIEF,), time=6.5), (6.5, 6.5)),
        (Measures((Measure("speed", Ego(), 3.0, 9.0),)), (3.0, 3.0)),
        (Measures((Measure("speed", Ego(), 3.0, 9.0, until=4.5),)), (3.0, 4.5)),
        (Measures((Measure("speed", Ego(), 10.0, 9.0),)), None),  # that is now
        (Measures((Measure("speed", Ego(), 3.0, gap="out-of-view"),)), None),
        (Helpful(), None),
    ],
)
def test_when_that_was(result: Answer, stretch: tuple[float, float] | None) -> None:
    assert episode(result) == stretch


def test_the_time_asked_about_is_meant_where_the_answer_has_none() -> None:
    assert episode(Helpful(), Span(2.0, 3.0)) == (2.0, 3.0)
    assert episode(MotionReason(BRAKED, ()), Span(2.0, 3.0)) == (5.0, 8.0)
    assert episode(Helpful(), Span(12.0, 13.0, ahead=True)) is None


def test_talk_leaves_the_acts_and_the_time_of_asking() -> None:
    before = discourse_of([turn(MotionReason(BRAKED, ()))])
    later = turn(Sociable("thanks"), act=Social("thanks"))
    later = replace(later, reply=replace(later.reply, sim_time=20.0))
    found = after(before, later)
    assert (found.last_acts, found.asked_at) == (before.last_acts, 10.0)
    assert found.episode == (5.0, 8.0)
    asked = Ask(Whether(STOPS))
    again = replace(turn(Verdict(STOPS, holds=True), act=asked), reply=later.reply)
    found = after(before, again)
    assert (found.last_acts, found.asked_at) == ((asked,), 20.0)
    assert found.propositions[0] == STOPS


def test_what_was_turned_away_only_counts_as_a_turn() -> None:
    before = discourse_of([turn(MotionReason(BRAKED, ()))])
    away = replace(turn(Verdict(STOPS, holds=True)), turned_away=True)
    assert after(before, away) == replace(before, turn=before.turn + 1)
    assert after(Discourse(), away) == Discourse(turn=1)


@pytest.mark.parametrize(
    ("that", "says"),
    [
        (STOPS, True),
        (Happens(Event("stop", Wanted())), False),
        (Is("fast", Unknown("x")), False),
        (Exists(Described(doing=Event("stop", Wanted()))), True),
        (Happens(Event("follow", Everyone(), object=Nobody())), False),
        (Happens(Event("follow", Everyone(), object=Ego())), True),
        (Happens(Event("follow", Ego(), object=Everyone())), True),
        (Related("behind", Everyone(), Everyone()), False),
        (Related("behind", Everyone(), Ego()), True),
        (Related("behind", Vehicle(1), Nobody()), True),
    ],
)
def test_a_verdict_on_what_was_left_open_says_nothing(that: Proposition, says: bool) -> None:
    assert says_something(Verdict(that, holds=True)) is says


@pytest.mark.parametrize(
    ("verdict", "says"),
    [
        (Verdict(Happens(Event("stop", Nobody())), holds=None), False),
        (Verdict(Happens(Event("stop", Nobody())), holds=False), True),
        (Verdict(Happens(Event("stop", Nobody())), holds=None, gap="not-sensed"), True),
        (Verdict(Happens(Event("stop", Nobody())), holds=None, gap="others-thoughts"), True),
        (Verdict(Exists(Nobody()), holds=None), True),
        (Verdict(Is("fast", Ego()), holds=None, gap="not-recorded"), False),
        (Verdict(Is("fast", Ego()), holds=None, gap="out-of-view"), True),
        (Verdict(Is("fast", Vehicle(1)), holds=None, gap="not-recorded"), True),
        (Verdict(Is("fast", Ego()), holds=True, gap="not-recorded"), True),
    ],
)
def test_an_open_verdict_on_nobody_or_ourselves_says_nothing(verdict: Verdict, says: bool) -> None:
    assert says_something(verdict) is says


def test_nobody_and_already_say_something_only_of_something() -> None:
    faster = Compares(Measured("speed", Wanted()), "more", Measured("speed", Ego()))
    assert says_something(Identified((), faster, none=True))
    assert not says_something(Identified((), replace(faster, right=None), none=True))
    assert says_something(Identified((LOOK,), replace(faster, right=None)))
    assert not says_something(Identified((), Related("near", Wanted(), Everyone()), none=True))
    assert says_something(Identified((), Related("near", Wanted(), Ego()), none=True))
    for action, says in (("do", False), ("happen", False), ("stop", True)):
        request = Request(Event(action, Ego()))  # type: ignore[arg-type]
        assert says_something(Declined(request, already=True)) is says
        assert says_something(Declined(request))


def test_a_yes_is_told_by_an_answer_that_rests_on_the_same_episode() -> None:
    braking = Episode(Vehicle(1), "brake", 4.0, None)
    yes = Verdict(Happens(Event("brake", Vehicle(1))), True, (braking,))
    pulling_up = PullingUp(1, "brakes", braking=braking)
    assert is_told_within(yes, (yes, pulling_up))
    assert not is_told_within(yes, (yes,))
    assert not is_told_within(yes, (replace(pulling_up, braking=None),))
    assert not is_told_within(replace(yes, holds=False), (pulling_up,))
    assert not is_told_within(pulling_up, (pulling_up,))
