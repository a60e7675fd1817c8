"""Reasons, kinds and the object of the contract, for every type of result."""

from typing import get_args

import pytest

from xavi_dialogue.dialogue.explanation import contrastive, explanation_of, kind_of
from xavi_dialogue.dialogue.standing import failed, reason_of, standing_of
from xavi_dialogue.domain.answers import (
    Again,
    CannotSay,
    Cause,
    Contrast,
    Declined,
    DidNotHappen,
    Evidence,
    Helpful,
    Measures,
    MotionCause,
    MotionReason,
    NoSuchVehicle,
    NotApplicable,
    NotRecorded,
    NotUnderstood,
    Reason,
    Refusal,
    SupposedOfOther,
    SupposedOfUs,
    TooLittle,
    Unavailable,
    Verdict,
    WhichOne,
)
from xavi_dialogue.domain.facts import Episode, Gap, Measure
from xavi_dialogue.domain.meaning import Request
from xavi_dialogue.domain.terms import Ego, Event, Happens, Vehicle

STOPPED = Happens(Event("stop"))
REFUSALS = {
    NotUnderstood: (NotUnderstood(), "not-understood"),
    WhichOne: (WhichOne((Vehicle(1),)), "ambiguous"),
    NoSuchVehicle: (NoSuchVehicle(Vehicle(9), 1.0), "unknown-vehicle"),
    DidNotHappen: (DidNotHappen(Event("stop")), "did-not-happen"),
    NotApplicable: (NotApplicable(("stop",), ""), "not-applicable"),
    TooLittle: (TooLittle("effect-too-small"), "effect-too-small"),
    NotRecorded: (NotRecorded("gap-in-record"), "trace-gap"),
    CannotSay: (CannotSay("advice"), "out-of-scope"),
    Unavailable: (Unavailable("busy"), "busy"),
}


@pytest.mark.parametrize("kind", get_args(Refusal))
def test_every_refusal_has_its_reason(kind: type) -> None:
    result, reason = REFUSALS[kind]
    assert reason_of(result) == reason


@pytest.mark.parametrize("gap", get_args(Gap))
def test_every_gap_has_a_reason_of_the_contract(gap: Gap) -> None:
    assert reason_of(NotRecorded(gap)) in get_args(Reason)


def measured(gap: Gap | None) -> Measures:
    return Measures((Measure("speed", Ego(), 1.0, None if gap else 3.0, gap=gap),))


def test_an_answer_without_any_value_declines() -> None:
    assert reason_of(measured(None)) is None
    assert reason_of(measured("out-of-view")) == "outside-record"
    assert reason_of(measured("not-applicable")) is None
    assert reason_of(Verdict(STOPPED, None, gap="hidden")) == "outside-record"
    assert reason_of(Verdict(STOPPED, None, gap="in-future", probability=0.3)) is None


def test_requests_are_declined_unless_they_are_being_done() -> None:
    request = Request(Event("slow-down"))
    assert reason_of(Declined(request)) == "out-of-scope"
    assert reason_of(Declined(request, able=False)) == "not-an-action"
    assert reason_of(Declined(request, already=True)) is None
    assert reason_of(Again("longer", Declined(request))) == "out-of-scope"


def test_a_reply_answers_where_any_part_of_it_does() -> None:
    assert standing_of([measured(None), CannotSay("x")]) == ("answer", None)
    assert standing_of([CannotSay("x"), NotUnderstood()]) == ("refusal", "out-of-scope")
    which = WhichOne((Vehicle(1),))
    assert standing_of([measured(None), which]) == ("clarification", "ambiguous")


@pytest.mark.parametrize("reason", get_args(Reason))
def test_failures_of_the_machinery_become_refusals(reason: Reason) -> None:
    assert reason_of(failed(reason)) in (reason, "planner-failed")


CONTRAST = Contrast(
    fact=("continue",),
    foil=("stop",),
    outcome=None,
    effects=(),
    causes=(Cause(1, ("stop",), 0.7),),
    evidence=Evidence("tree", 10, 3, ("a",)),
    decided=1.0,
)
KEYS = [
    *("kind", "factual", "counterfactual", "outcome", "effects", "causes", "evidence"),
    *("continued", "aim", "verdict", "terms", "told", "error"),
]


def test_causal_answers_have_all_keys_of_the_contract() -> None:
    found = explanation_of([SupposedOfUs(CONTRAST)])
    assert found is not None
    assert list(found) == KEYS
    assert found["evidence"] == {
        "method": "tree",
        "rollouts": 10,
        "distinct_samples": 3,
        "traces": ["a"],
    }
    assert list(found["causes"][0]) == list(Cause.__struct_fields__)  # type: ignore[index]


def test_who_was_in_our_way_is_a_cause() -> None:
    slowed = Episode(Ego(), "stop", 1.0, 3.0)
    reason = MotionReason(slowed, (MotionCause("leader", 4, speed=2.0), MotionCause("turn")))
    found = contrastive(reason)
    assert found is not None
    assert found.factual == ("stop",)
    (cause,) = found.causes
    assert (cause.vehicle, cause.probability) == (4, 1.0)
    assert cause.mechanism is not None
    assert cause.mechanism.how == "leader"


def test_a_supposition_blames_the_vehicle_supposed_of() -> None:
    supposed = SupposedOfOther(2, None, 0.4, ("continue",), ("stop",), same=False)
    found = contrastive(supposed)
    assert found is not None
    assert (found.factual, found.counterfactual) == (("continue",), ("stop",))
    assert (found.causes[0].probability, found.causes[0].decision_changes) == (0.4, True)


def test_talk_explains_nothing() -> None:
    assert explanation_of([Helpful()]) is None
    assert explanation_of([CannotSay("x")]) is None


def test_kinds_are_spelt_with_hyphens() -> None:
    assert kind_of(SupposedOfUs(CONTRAST)) == "supposed-of-us"


@pytest.mark.parametrize(
    ("reason", "refusal"),
    [
        ("busy", Unavailable("busy")),
        ("timed-out", Unavailable("timed-out")),
        ("planner-unavailable", Unavailable("planner-unavailable")),
        ("planner-failed", Unavailable("planner-failed")),
        ("too-little-evidence", TooLittle("too-little-evidence")),
        ("outside-record", NotRecorded("not-recorded")),
        ("trace-gap", NotRecorded("gap-in-record")),
    ],
)
def test_a_failure_is_told_as_what_it_is(reason: Reason, refusal: Refusal) -> None:
    assert failed(reason) == refusal
    # The lack of roads is the reason only where the planner is not available.
    told = failed(reason, roadless=True)
    without = reason in ("busy", "timed-out", "planner-unavailable")
    assert told == (Unavailable(reason, True) if without else refusal)  # type: ignore[arg-type]
