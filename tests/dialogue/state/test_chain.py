"""What a bare "why?", "how do you know?" and "are you sure?" ask, by the answer before it."""

from typing import Any

import pytest
from msgspec.structs import replace

from xavi_dialogue.dialogue.chain import BOTTOM, MORE, deeper, recast
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.turn import Part, Turn
from xavi_dialogue.domain.answers import (
    Activity,
    Again,
    Altered,
    Avoidance,
    Beliefs,
    Bound,
    CannotSay,
    Cause,
    Certainty,
    ChoiceReason,
    Closeness,
    Comforting,
    Contrast,
    Decided,
    Declined,
    DidNotHappen,
    Evidence,
    Grounds,
    Happenings,
    Helpful,
    Measures,
    Method,
    MotionCause,
    MotionReason,
    NotApplicable,
    Options,
    OtherReason,
    PeakMoment,
    PlanAhead,
    Sociable,
    SupposedOfOther,
    SupposedOfUs,
    TooLittle,
    Verdict,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.evidence import Mechanism
from xavi_dialogue.domain.facts import Belief, Episode, Expectation, Measure, OptionValue
from xavi_dialogue.domain.meaning import (
    Ask,
    Elliptic,
    Feel,
    HowKnow,
    HowMuch,
    HowSure,
    Listing,
    Reading,
    Repair,
    Request,
    Social,
    WhatIf,
    WhatWouldChange,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Measured,
    Not,
    Now,
    That,
    Vehicle,
)

ASKED = Ask(Why(Happens(Event("slow-down"))))
BRAKED = Episode(Ego(), "slow-down", 5.0, 8.0)
TURNED = Episode(Vehicle(3), "exit-right", 6.0, 9.0)
STANDS = Episode(Vehicle(3), "stand", 4.0)
BELIEF = Belief(3, 4.0, (Expectation(("continue", "exit-right"), 0.7), Expectation(("stop",), 0.3)))
TURNS = Event("exit-right", Vehicle(3), time=At(4.0), modal="will")
CONTRAST = Contrast(
    fact=("change-left",),
    foil=("continue",),
    outcome=None,
    effects=(),
    causes=(Cause(0, ("stop",), 1.0), Cause(3, ("continue", "exit-right"), 0.7)),
    evidence=Evidence(),
    decided=4.0,
)
PRESENT = replace(
    CONTRAST, causes=(Cause(3, ("stop",), 0.7, Mechanism("leader", 5.0, 0.0, 2.0, 0.5, True)),)
)
LEADER = MotionCause("leader", 3, ("exit-right",), 0.7, 4.0)
SILENT = MotionCause("leader", 3, (), 0.7, 4.0)


def turn(*results: Any, act: Any = ASKED) -> Turn:
    reply = Reply(text="", kind="answer", sim_time=10.0)
    parts = tuple(Part(GroundedAct(act), result) for result in results)
    return Turn(text="", parts=parts, reply=reply)


def why(event: Event) -> Ask:
    return Ask(Why(Happens(event)))


@pytest.mark.parametrize(
    ("result", "asks"),
    [
        # Beneath what we did lies the belief, beneath the belief its evidence, then nothing.
        (ChoiceReason("why", BRAKED, CONTRAST), Ask(Why(Believed(Happens(TURNS), time=At(4.0))))),
        (SupposedOfUs(CONTRAST), Ask(Why(Believed(Happens(TURNS), time=At(4.0))))),
        (ChoiceReason("why", BRAKED, PRESENT), MORE),
        (
            MotionReason(BRAKED, (LEADER,)),
            Ask(Why(Believed(Happens(replace(TURNS, time=At(5.0))), time=At(5.0)))),
        ),
        (OtherReason(3, TURNED, goal=BELIEF), Ask(HowKnow(Happens(TURNS)))),
        (Bound(Vehicle(3), BELIEF), Ask(HowKnow(Happens(TURNS)))),
        (Beliefs(3, None, (replace(BELIEF, time=1.0), BELIEF)), Ask(HowKnow(Happens(TURNS)))),
        (Activity(Vehicle(3), 5.0, (), 9.0, None, belief=BELIEF), Ask(HowKnow(Happens(TURNS)))),
        (Bound(Vehicle(3), replace(BELIEF, expectations=())), "bottom"),
        (OtherReason(3, TURNED), "bottom"),
        # What a vehicle did before our eyes is asked about as such.
        (
            MotionReason(BRAKED, (replace(SILENT, did=TURNED),)),
            why(Event("exit-right", Vehicle(3), time=At(6.0), tense="past")),
        ),
        (
            MotionReason(BRAKED, (replace(SILENT, speed=0.3),)),
            why(Event("stand", Vehicle(3), time=At(5.0))),
        ),
        (
            MotionReason(BRAKED, (replace(SILENT, speed=0.5),)),
            why(Event("move", Vehicle(3), time=At(5.0))),
        ),
        (MotionReason(BRAKED, (MotionCause("limit"),)), MORE),
        (MotionReason(BRAKED, ()), MORE),
        # A yes is asked about as it is, a no as its contrary.
        (Verdict(Happens(TURNS), holds=True), Ask(Why(Happens(TURNS)))),
        (Verdict(Happens(TURNS), holds=False), Ask(Why(Not(Happens(TURNS))))),
        (Verdict(Not(Happens(TURNS)), holds=False), Ask(Why(Happens(TURNS)))),
        (Verdict(Happens(TURNS), holds=None), "leave"),
        # Deeds: the last of a list, the most telling of what goes on, the first of a peak.
        (
            Happenings("list", (BRAKED, TURNED)),
            why(Event("exit-right", Vehicle(3), time=At(6.0), tense="past")),
        ),
        (
            Activity(Vehicle(3), 9.0, (STANDS, Episode(Vehicle(3), "follow", 5.0)), 0.0, None),
            why(Event("stand", Vehicle(3), time=At(4.0), tense="present")),
        ),
        (
            Activity(
                Ego(), 9.0,
                (Episode(Ego(), "signal", 6.0), Episode(Ego(), "slow-down", 5.0)),
                3.0, "slowing",
            ),
            why(Event("slow-down", time=At(5.0), tense="present")),
        ),
        (
            PeakMoment("danger", 5.0, (BRAKED, TURNED)),
            why(Event("slow-down", time=At(5.0), tense="past")),
        ),
        (Decided(4.0, ("stop", "continue")), why(Event("stop", time=At(4.0)))),
        (
            Altered(Decided(2.0, ("continue",)), Decided(4.0, ("exit-left",))),
            why(Event("exit-left", time=At(4.0))),
        ),
        (Altered(Decided(2.0, ("continue",)), Decided(4.0, ())), "leave"),
        (
            PlanAhead((("change-left", 11.0), ("continue", 14.0))),
            why(Event("change-left", tense="future", modal="will")),
        ),
        (
            SupposedOfOther(3, None, None, ("stop",), ("continue",), False),
            why(Event("stop", tense="past")),
        ),
        (
            SupposedOfOther(3, None, None, ("stop",), ("continue",), False, past=False),
            why(Event("stop", tense="present")),
        ),
        (
            Measures((Measure("speed", Vehicle(3), 7.0, 9.0),)),
            why(Event("move", Vehicle(3), time=At(7.0), tense="present")),
        ),
        (Measures((Measure("speed", Vehicle(3), 7.0, gap="out-of-view"),)), "leave"),
        (Measures((Measure("distance", Vehicle(3), 7.0, 9.0),)), "leave"),
        (
            Options(
                (
                    OptionValue("continue", False, "done", 1.0, 9.0, 1.0, -9.0),
                    OptionValue("stop", True, "done", 1.0, 8.0, 0.0, -8.0),
                ),
                4.0,
                Evidence(),
            ),
            why(Event("stop", time=At(4.0))),
        ),
        (Options((), 4.0, Evidence()), "bottom"),
        # What did not happen is asked about by what did.
        (
            DidNotHappen(Event("stop"), (TURNED, BRAKED)),
            why(Event("slow-down", time=At(5.0), tense="past")),
        ),
        (DidNotHappen(Event("stop")), "leave"),
        (DidNotHappen(Event("stop"), (BRAKED,), answer=Helpful()), "bottom"),
        (
            Declined(Request(Event("overtake", Vehicle(9), tense="future"))),
            Ask(Why(Not(Happens(Event("overtake", Ego(), tense="present"))))),
        ),
        # Here it ends.
        (Grounds(3, ("exit-right",), True, ()), "bottom"),
        (Certainty("plan", 0.9, 0.8, 9, 10, 4.0, Evidence()), "bottom"),
        (Method(4.0), "bottom"),
        (Avoidance("collide", True, False, 0.1, 0.0, 3, 4), "bottom"),
        (CannotSay("weather"), "bottom"),
        (TooLittle("too-little-evidence"), "bottom"),
        (Helpful(), "leave"),
    ],
)  # fmt: skip
def test_why_asks_what_lies_beneath(result: Any, asks: Any) -> None:
    assert deeper(turn(result)) == asks


def test_once_more_was_told_it_ends() -> None:
    told = MotionReason(BRAKED, ())
    assert deeper(turn(told, Again("simpler", told))) == MORE
    assert deeper(turn(Again("longer", told))) == "bottom"


def test_the_answer_within_comfort_and_repeats_is_meant() -> None:
    verdict = Verdict(Happens(TURNS), holds=True)
    assert deeper(turn(Comforting(Feel("nervous"), verdict))) == Ask(Why(Happens(TURNS)))
    assert deeper(turn(verdict, Again("repeat", None))) == Ask(Why(Happens(TURNS)))


def asked(act: Any, *turns: Turn) -> Any:
    return recast(Reading(acts=(act,), shares=()), turns).acts[0]


REASON = turn(ChoiceReason("why", BRAKED, CONTRAST))


def test_how_we_know_and_how_sure_we_are_is_of_what_was_expected() -> None:
    for of in (None, That()):
        assert asked(Ask(HowKnow(of)), REASON) == Ask(HowKnow(Happens(TURNS)))
        deed = Event("slow-down", time=At(5.0), tense="past")
        assert asked(Ask(HowSure(of)), REASON) == Ask(HowSure(Happens(deed)))
    motion = turn(MotionReason(BRAKED, (LEADER,)))
    assert asked(Ask(HowSure()), motion) == Ask(HowSure(Happens(replace(TURNS, time=At(5.0)))))
    ahead = turn(PlanAhead((("stop", 11.0),)))
    to_come = Event("stop", tense="future", modal="will")
    assert asked(Ask(HowSure()), ahead) == Ask(HowSure(Happens(to_come)))


CRASH = Event("collide", Ego(), time=Now(), tense="present")
WAS = Closeness(3, None, risk=0.01, asked="dangerous", time=9.0)
SAID = Event("collide")


@pytest.mark.parametrize(
    ("result", "of"),
    [
        (WAS, Believed(Happens(replace(CRASH, time=At(9.0))), time=At(9.0))),
        (
            replace(WAS, planned=7.0),
            Believed(Happens(replace(CRASH, time=At(7.0))), time=At(7.0)),
        ),
        (replace(WAS, past=False), Happens(CRASH)),
        (replace(WAS, risk=None), None),
        (
            Verdict(Happens(SAID), None, probability=0.01),
            Happens(replace(SAID, time=Now(), tense="present")),
        ),
        (
            Verdict(Happens(replace(SAID, time=At(4.0))), None, probability=0.01),
            Believed(Happens(replace(SAID, time=At(4.0))), time=At(4.0)),
        ),
        (Verdict(Happens(SAID), None), None),
    ],
)
def test_how_we_know_a_risk_is_of_what_it_rests_on(result: Any, of: Any) -> None:
    assert asked(Ask(HowKnow()), turn(result)) == Ask(HowKnow(of))


def test_how_we_know_the_risk_with_somebody_is_of_that_one() -> None:
    told = turn(WAS, act=Ask(Whether(Is("dangerous", Vehicle(3)))))
    crash = replace(CRASH, object=Vehicle(3), time=At(9.0))
    known = Believed(Happens(crash), time=At(9.0))
    assert asked(Ask(HowKnow(That())), told) == Ask(HowKnow(known))


@pytest.mark.parametrize(
    "act",
    [
        Ask(HowSure(changed=True)),
        Ask(HowKnow(Happens(TURNS))),
        Ask(HowMuch(Measured("speed"))),
        Social("thanks"),
    ],
)
def test_what_says_itself_what_it_is_of_is_left_alone(act: Any) -> None:
    assert asked(act, REASON) == act


def test_a_bare_why_is_recast_or_ends() -> None:
    assert asked(Elliptic(form="why"), REASON) == deeper(REASON)
    assert asked(Elliptic(form="why-not"), REASON) == deeper(REASON)
    assert asked(Repair(kind="why"), turn(Method(4.0))) == Repair(kind="why")
    assert asked(Elliptic(form="why"), turn(Helpful())) == Elliptic(form="why")
    assert asked(Elliptic(form="why")) == Elliptic(form="why")


def test_talk_is_passed_over_but_not_that_it_has_ended() -> None:
    thanks = turn(Sociable("thanks"), act=Social("thanks"))
    assert asked(Elliptic(form="why"), REASON, thanks) == deeper(REASON)
    ended = turn(BOTTOM, act=Repair(kind="why"))
    assert asked(Elliptic(form="why"), REASON, ended) == Repair(kind="why")


def test_a_why_after_a_question_of_the_same_text_is_of_that() -> None:
    speed = Ask(HowMuch(Measured("speed")))
    reading = Reading(acts=(speed, Repair(kind="why")), shares=())
    assert recast(reading, (REASON,)).acts == (speed, Elliptic(form="why"))


def test_an_option_that_did_not_apply_is_the_end() -> None:
    refused = NotApplicable(("change-left",), "there is no lane to the left", 4.0)
    assert deeper(turn(refused)) == "bottom"


GONE = Not(Exists(Vehicle(3)))
WITHOUT = SupposedOfOther(3, None, None, ("stop",), ("continue",), False, past=False)
WOULD = Event("continue", tense="present", modal="would")
SUPPOSED = turn(WITHOUT, act=Ask(WhatIf(GONE)))


@pytest.mark.parametrize(
    "act",
    [
        Elliptic(form="why"),
        Ask(Why(That())),
        Ask(Why(Happens(WOULD))),
        Ask(WhatWouldChange()),
        Ask(HowSure(Happens(Event("do", modal="would")))),
        Ask(Listing("rivals", event=Event("do", modal="would"))),
    ],
)
def test_what_follows_a_supposition_stays_in_it_by_its_words(act: Any) -> None:
    assert asked(act, SUPPOSED) == Ask(WhatIf(GONE, Why(Happens(WOULD))))


@pytest.mark.parametrize("act", [Ask(HowSure(Happens(Event("do")))), Ask(Listing("rivals"))])
def test_what_was_really_decided_is_left_to_the_record(act: Any) -> None:
    assert asked(act, SUPPOSED) == act


def test_once_told_why_it_would_be_it_is_asked_why_it_is() -> None:
    told = turn(replace(WITHOUT, within=CONTRAST), act=Ask(WhatIf(GONE, Why(Happens(WOULD)))))
    assert deeper(told) == why(Event("stop", tense="present"))
