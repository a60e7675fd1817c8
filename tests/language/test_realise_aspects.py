"""Answers to what is asked beyond the type, and wording that goes with the conversation."""

import pytest
from msgspec.structs import replace

from tests.language.realise_cases import CUT_AND_TURN, cause, effect, explanation
from xavi_dialogue.explain.details import Choices, Contrary, Need, Option, Sight, Staying
from xavi_dialogue.explain.explanation import (
    Activity,
    Destination,
    Evidence,
    Explanation,
    Mechanism,
    NoExplanation,
)
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.context import SpeechContext, VehicleWords, told
from xavi_dialogue.language.quantities import Quantity, Span, quantity, span
from xavi_dialogue.language.realise import realise

HELD = Mechanism("leader", 11.7, 3.6, 4.0, 0.9)
CAUSE = cause(1, CUT_AND_TURN, 0.9, HELD, decision_changes=True)
SLOWER = explanation(("continue",), effects=(effect("time", 5.0),), causes=(CAUSE,))
ASKED = Query(type="why", factual=("change-left",))
AHEAD = SpeechContext(vehicles={1: VehicleWords(description="the car ahead")})
SEEN = Query(type="out_of_scope", reason="perception", tense="present")


def say(found: Explanation | NoExplanation, query: Query = ASKED, **context) -> str:
    return realise(query, found, SpeechContext(vehicles=AHEAD.vehicles, **context)).text


def bare(**details) -> Explanation:
    evidence = Evidence("tree", 0, 0, ("0123456789abcdef",))
    plain = Explanation(
        factual=(), counterfactual=(), outcome=None, effects=(), causes=(), evidence=evidence
    )
    return replace(plain, **details)


# What is seen --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("sight", "text"),
    [
        (Sight("speed", 0, speed=10.0, trend="slowing"), "I am driving at 36 km/h, slowing down."),
        (Sight("speed", 0, speed=0.0, trend="standing"), "I am standing still."),
        (Sight("speed", 0, speed=0.1, trend="slowing"), "I am standing still."),
        (
            Sight("speed", 1, speed=10.0, trend="steady"),
            "The car ahead (vehicle 1) is driving at 36 km/h.",
        ),
        (
            Sight("distance", 1, place="ahead", oncoming=True, distance=23.0),
            "Vehicle 1 is about 25 metres away, ahead of us and coming towards us.",
        ),
        (
            Sight("place", 1, place="behind-left", distance=7.2),
            "Vehicle 1 is behind us on the left, about 7 metres away.",
        ),
        (Sight("colour", 1, colour="blue"), "The car ahead (vehicle 1) is blue."),
        (Sight("count", 0), "I see no other vehicle now."),
        (
            Sight("nobody", 0, place="front"),
            "I see nobody driving ahead of us and no other vehicle either.",
        ),
        (Sight("count", 0, others=(1,)), "I see one other vehicle now: vehicle 1."),
        (
            Sight("count", 0, others=(1, 2, 3)),
            "I see 3 other vehicles now: vehicle 1, vehicle 2 and vehicle 3.",
        ),
        (Sight("count", 0, others=tuple(range(1, 13))), "I see 12 other vehicles now."),
    ],
)
def test_what_is_seen(sight: Sight, text: str) -> None:
    assert say(bare(sight=sight), SEEN) == text


def test_who_is_out_of_view_is_spoken_of_in_the_past() -> None:
    found = bare(sight=Sight("place", 1, place="behind", distance=62.0), seen=16.0)
    assert say(found, SEEN) == (
        "I last saw the car ahead (vehicle 1) at 0:16. It was behind us, about 60 metres away."
    )


def test_where_a_vehicle_is_goes_with_where_it_is_going() -> None:
    found = bare(
        sight=Sight("place", 1, place="ahead", distance=30.0),
        activity=Activity(1, ("exit-right",), 0.9, 8.0, "slowing"),
        destination=Destination(1, "out", "exit-right", "the road to the right", 0.9),
    )
    assert say(found, replace(SEEN, type="where_goal")) == (
        "Vehicle 1 is ahead of us, about 30 metres away. I expect it to turn right."
    )


# What else, and whether we had to --------------------------------------------------------------

OPTIONS = (
    Option("continue", "done", 1.0, 5.2),
    Option("stop", "done", 0.8, -2.0),
    Option("exit-right", "dead", 1.0, None),
    Option("change-right", "collision", 0.5, None, 2),
)


def choices(about: str, count: int) -> str:
    found = bare(choices=Choices(about, "change-left", OPTIONS[:count]))
    return say(found, Query(type="compare", event=about))


def test_options_are_told_with_what_would_have_come_of_them() -> None:
    assert choices("options", 0) == "There was nothing else I could have done."
    assert choices("options", 1) == (
        "The only other option was staying in my lane: "
        "that would have got us there about 5 seconds later."
    )
    assert choices("options", 4) == (
        "Instead of moving to the left lane, I could have stayed in my lane (about 5 seconds "
        "later), stopped (about 2 seconds sooner) or turned right (not to our destination). "
        "There is one more."
    )
    assert choices("second", 3).startswith("The next best option was staying in my lane: ")
    assert choices("worst", 4) == (
        "The worst option was moving to the right lane: in my simulations, "
        "that would probably have ended in a collision with vehicle 2."
    )


@pytest.mark.parametrize(
    ("asked", "kind", "start"),
    [
        ("necessary", "worse", "No, but staying in my lane would have got us there about 5"),
        ("other-way", "worse", "Yes, but staying in my lane would"),
        ("better-way", "worse", "No: staying in my lane would"),
        ("necessary", "bad", "Yes: staying in my lane would"),
        ("other-way", "bad", "No: staying in my lane would"),
        ("necessary", "equal", "No: staying in my lane would have made no difference"),
        ("other-way", "equal", "Yes: staying in my lane would have made no difference"),
        ("necessary", "only", "Yes: there was nothing else I could have done."),
        ("other-way", "only", "No: there was nothing else I could have done."),
    ],
)
def test_yes_or_no_comes_first(asked: str, kind: str, start: str) -> None:
    found = SLOWER if kind in ("worse", "bad") else replace(SLOWER, counterfactual=())
    found = replace(found, need=Need(asked, kind, None if kind == "only" else "continue"))
    assert say(found, Query(type="compare", event=asked)).startswith(start)


def test_who_was_in_the_way_made_us_drive_so() -> None:
    wait = replace(CAUSE, mechanism=replace(HELD, how="right-of-way"))
    found = replace(SLOWER, counterfactual=(), causes=(wait,), need=Need("necessary", "driving"))
    asked = Query(type="what", factual=("give-way",), event="necessary")
    assert say(found, asked).startswith("Yes: I had to give way to the car ahead (vehicle 1)")
    other = replace(found, need=Need("other-way", "driving"))
    assert say(other, asked).startswith("No: I had to give way to the car ahead (vehicle 1)")
    turn = replace(found, causes=(), factual=("exit-right",))
    assert say(turn, asked) == "Yes, for the turn. No other vehicle was in my way then."


# The lane, and what others did not do ----------------------------------------------------------


@pytest.mark.parametrize(
    ("staying", "text"),
    [
        (
            Staying("change-left", 3.0),
            "I moved to the left lane at 0:03 to get us there sooner, and have been there since. "
            "Staying in my lane would have got us there about 5 seconds later, because I expected "
            "the car ahead (vehicle 1) to slow down and turn right.",
        ),
        (Staying(only=True), None),
    ],
)
def test_a_lane_and_why(staying: Staying, text: str | None) -> None:
    found = replace(SLOWER, staying=staying) if text else bare(staying=staying)
    expected = text or (
        "We have been in this lane from the start, and there is no other for our direction here."
    )
    assert say(found, Query(type="why", tense="present", event="lane")) == expected


def test_a_lane_that_cannot_be_left_now() -> None:
    stay = Staying("exit-right", 18.0, only=True, reason="the lane ends too soon to change")
    assert say(bare(staying=stay), Query(type="why", event="lane")) == (
        "We have been in this lane since I turned right at 0:18, and cannot leave it now: "
        "the lane ends too soon to change."
    )


def test_what_another_vehicle_did_instead() -> None:
    known = bare(
        activity=Activity(1, ("slow-down", "exit-right"), 0.9, 4.0, "slowing"),
        destination=Destination(1, "out", "exit-right", "the road to the right", 0.9),
    )
    asked = Query(type="why_not", actor="vehicle:1", counterfactual=("speed-up",))
    found = replace(known, contrary=Contrary(("speed-up",), 1.0, "slow-down"))
    assert say(found, asked) == (
        "The car ahead (vehicle 1) did so at 0:01, but not after that. "
        "It most likely slowed down in order to turn right."
    )
    could = replace(known, contrary=Contrary(("speed-up",), None, "slow-down"))
    assert say(could, replace(asked, event="could")) == (
        "I cannot say what vehicle 1 could have done, only what it did. "
        "It most likely slowed down in order to turn right."
    )
    never = replace(known, contrary=Contrary(("stop",)))
    assert say(never, asked) == (
        "The car ahead (vehicle 1) did not stop: I believed it was going to slow down "
        "and turn right."
    )


def test_a_comparison_of_anothers_ways_is_declined_with_what_may_be_asked() -> None:
    offered = Query(type="what_if", actor="vehicle:1", counterfactual=("exit-left",))
    refused = NoExplanation(
        reason="out-of-scope", facts={"what": "compare"}, suggestions=(offered,)
    )
    asked = Query(type="compare", actor="vehicle:1", counterfactual=("exit-left",))
    assert say(refused, asked) == (
        "I cannot tell what would have been better for vehicle 1, only what it would have meant "
        "for us. You could ask: What if vehicle 1 had turned left?"
    )


# Wording that goes with the conversation -------------------------------------------------------

HINDERED = replace(SLOWER, counterfactual=(), effects=())
WORDED = [
    (SLOWER, ASKED),
    (SLOWER, Query(type="what_if", counterfactual=("continue",))),
    (HINDERED, Query(type="why", factual=("slow-down",))),
    (SLOWER, Query(type="what_if", actor="vehicle:1", intervention="remove")),
]


@pytest.mark.parametrize(("found", "query"), WORDED)
def test_three_answers_in_a_row_do_not_start_alike(found: Explanation, query: Query) -> None:
    texts = [say(found, query, turn=turn) for turn in range(3)]
    assert len({text.split()[0] for text in texts}) == len(texts)
    assert say(found, query, turn=3) == texts[0] == say(found, query)


def test_a_cause_once_told_is_named_without_its_particulars() -> None:
    told_of = told(SLOWER)
    assert told_of == {(1, CUT_AND_TURN)}
    text = say(SLOWER, told=told_of, named=frozenset({1}))
    assert text == (
        "I moved to the left lane to get us there sooner. Staying in my lane would have got us "
        "there about 5 seconds later, because I expected vehicle 1 to slow down."
    )
    assert "from 42 to 13 km/h" in say(SLOWER, replace(ASKED, detail="more"), told=told_of)


def test_the_same_again_is_brief_and_says_so() -> None:
    text = say(SLOWER, repeated=True, named=frozenset({1}))
    assert text.startswith("As I said, I moved to the left lane")
    assert "km/h" not in text
    assert say(SLOWER, repeated=True, turn=2).startswith("As I said, staying in my lane")


# Numbers that nobody wants to hear ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (3600.0, "s", "60 minutes"),
        (1e9, "s", "more than an hour"),
        (0.4, "m", "less than a metre"),
        (1.2, "m", "1 metre"),
        (18.7, "m", "19 metres"),
        (63.0, "m", "65 metres"),
        (994.0, "m", "990 metres"),
        (1e6, "m", "more than a kilometre"),
        (1e300, "km/h", "over 300 km/h"),
        (1e300, "count", "over 10000"),
        (5000.0, "clock", "1:23:20"),
        (1e300, "clock", "over 100 hours"),
    ],
)
def test_what_is_too_large_is_only_said_to_be(value: float, unit, text: str) -> None:
    assert quantity(Quantity(value, unit)) == text


@pytest.mark.parametrize(
    ("low", "high", "text"),
    [
        (0.5, 2.5, "0.5 to 2.5 seconds"),
        (30.0, 150.0, "30 seconds to 3 minutes"),
        (130.0, 300.0, "2 to 5 minutes"),
        (30.0, 1e6, "30 seconds to more than an hour"),
    ],
)
def test_the_ends_of_a_range_share_a_unit_they_have_in_common(
    low: float, high: float, text: str
) -> None:
    assert span(Span(Quantity(low, "s"), Quantity(high, "s")), "to") == text


def test_a_hostile_delay_is_spoken_of_in_words() -> None:
    endless = replace(SLOWER, effects=(effect("time", 1e12),))
    assert "got us there more than an hour later" in say(endless)
