"""The object of the contract, and several answers as one reply: worked out case by case."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.dialogue.state.test_chain import BRAKED, CONTRAST, LEADER, TURNED
from xavi_dialogue.dialogue.explanation import contrastive, evidence_of, explanation_of, kind_of
from xavi_dialogue.dialogue.joining import AT_MOST, joined, sentences
from xavi_dialogue.dialogue.standing import reason_of
from xavi_dialogue.domain.answers import (
    Again,
    CannotSay,
    Cause,
    ChoiceReason,
    Comforting,
    DidNotHappen,
    Effect,
    Evidence,
    Happenings,
    Helpful,
    Judged,
    Measures,
    MotionCause,
    MotionReason,
    OtherReason,
    OutcomeEstimate,
    Posed,
    Sociable,
    SupposedOfOther,
    SupposedOfUs,
    Verdict,
    WhichOne,
)
from xavi_dialogue.domain.evidence import Aim, Share
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.meaning import Feel, Why
from xavi_dialogue.domain.terms import Ego, Event, Happens, Vehicle
from xavi_dialogue.nlg.context import Utterance

WHOLE = replace(
    CONTRAST,
    continued=("stop",),
    aim=Aim("east", 100.0, True, 20.0),
    outcome=OutcomeEstimate("done", 0.9),
    effects=(Effect("time", "s", 4.0, 3.0, 5.0, 10, 5),),
    evidence=Evidence("tree", 10, 3, ("a", "b")),
    terms=(Share("time", 4.0),),
    told=(Share("time", 4.0),),
    verdict="better",
    error=0.25,
)
REASON = ChoiceReason("why", BRAKED, WHOLE)
SPEED = Measures((Measure("speed", Ego(), 7.0, 12.0),))


@pytest.mark.parametrize("result", [REASON, SupposedOfUs(WHOLE)])
def test_a_contrast_is_told_whole(result: Any) -> None:
    found = contrastive(result)
    assert found is not None
    for name in ("outcome", "effects", "causes", "evidence", "continued", "aim", "verdict",
                 "terms", "told", "error"):  # fmt: skip
        assert getattr(found, name) == getattr(WHOLE, name)
    assert (found.factual, found.counterfactual) == (WHOLE.fact, WHOLE.foil)
    assert found.kind == kind_of(result)


def test_what_slowed_us_or_another_is_a_cause_where_it_is_a_vehicle() -> None:
    cause = MotionCause("leader", 4, ("stop",), 0.7, 2.0, necessary=True)
    plain = (MotionCause("limit"), cause, MotionCause("parked", 5))
    evidence = Evidence("rollouts", traces=("a",))
    found = contrastive(MotionReason(BRAKED, plain, evidence=evidence))
    assert found is not None
    assert (found.factual, found.evidence) == ((), evidence)  # slowing is no macro action
    first, second = found.causes
    assert (first.vehicle, first.actions, first.probability) == (4, ("stop",), 0.7)
    assert first.necessary is True
    assert first.mechanism is not None
    assert (first.mechanism.how, first.mechanism.speed_from) == ("leader", 2.0)
    assert (first.mechanism.speed_to, first.mechanism.delay) == (None, None)
    assert first.mechanism.share == 1.0
    # What was in our way was there for certain; standing about is no way of holding up.
    assert (second.vehicle, second.probability, second.mechanism) == (5, 1.0, None)
    other = contrastive(OtherReason(3, TURNED, causes=(cause,)))
    assert other is not None
    assert other.factual == ("exit-right",)
    assert [one.vehicle for one in other.causes] == [4]
    nothing = contrastive(OtherReason(3, None))
    assert nothing is not None
    assert (nothing.factual, nothing.causes) == ((), ())


@pytest.mark.parametrize(
    ("supposed", "actions"),
    [
        (Event("exit-left", Vehicle(2)), ("exit-left",)),
        (Event("brake", Vehicle(2)), ()),
        (None, ()),
    ],
)
def test_a_supposition_about_another_has_it_as_its_cause(
    supposed: Event | None, actions: tuple[str, ...]
) -> None:
    found = contrastive(
        SupposedOfOther(2, supposed, None, ("continue",), ("stop",), True, contrast=WHOLE)
    )
    assert found is not None
    assert found.causes == (Cause(2, actions, 1.0, decision_changes=False),)  # type: ignore[arg-type]
    assert (found.factual, found.counterfactual) == (("continue",), ("stop",))
    assert (found.effects, found.kind) == (WHOLE.effects, "supposed-of-other")
    plain = SupposedOfOther(2, supposed, 0.0, ("continue",), ("stop",), False)
    alone = contrastive(plain)
    assert alone is not None
    assert (alone.effects, alone.causes[0].probability) == ((), 0.0)
    assert alone.causes[0].decision_changes is True


POSED = Posed("vehicle", Why(Happens(Event("stop"))))


@pytest.mark.parametrize(
    "frame",
    [
        lambda inner: Comforting(Feel("afraid"), inner),
        lambda inner: Again("longer", inner),
        lambda inner: Judged("right", POSED, inner),
    ],
)
def test_an_answer_within_another_is_explained_as_it_is(frame: Any) -> None:
    assert contrastive(frame(REASON)) == contrastive(REASON)
    assert explanation_of([frame(REASON)]) == explanation_of([REASON])
    assert explanation_of([frame(SPEED)]) == explanation_of([SPEED])
    assert contrastive(frame(SPEED)) is None


def test_without_an_answer_inside_a_frame_is_talk() -> None:
    assert contrastive(Again("longer", None)) is None
    assert contrastive(Comforting(Feel("afraid"))) is None
    assert explanation_of([Again("longer", None)]) is None
    assert explanation_of([Comforting(Feel("afraid"))]) is None


def test_the_first_result_that_explains_is_told_and_else_the_first_that_is_no_talk() -> None:
    verdict = Verdict(Happens(Event("stop")), holds=True)
    assert explanation_of([SPEED, REASON]) == explanation_of([REASON])
    other = SupposedOfUs(WHOLE)
    assert explanation_of([other, REASON]) == explanation_of([other])
    found = explanation_of([Helpful(), Sociable("joke"), SPEED, verdict])
    assert found is not None
    assert (found["kind"], "is" in found) == ("measures", False)
    assert explanation_of([CannotSay("x"), verdict])["kind"] == "verdict"  # type: ignore[index]
    assert explanation_of([DidNotHappen(Event("stop"))]) is None
    assert explanation_of([]) is None


def test_the_first_evidence_that_names_a_decision_counts() -> None:
    unnamed = MotionReason(BRAKED, (LEADER,), evidence=Evidence("rollouts", 5, 5))
    assert evidence_of([unnamed, REASON]) == WHOLE.evidence
    assert evidence_of([unnamed, SPEED]) is None


def test_kinds_are_names_of_types() -> None:
    assert kind_of(Happenings("list", ())) == "happenings"
    assert kind_of(SupposedOfOther(2, None, None, (), (), False)) == "supposed-of-other"
    deed = Episode(Ego(), "change-left", 1.0, 2.0)
    found = explanation_of([MotionReason(deed, ())])
    assert found is not None
    assert found["factual"] == ["change-left"]


def reply(*texts: str) -> str:
    return joined([Utterance(text) for text in texts]).text


@pytest.mark.parametrize(
    ("texts", "told"),
    [
        (("One. Two. One.",), "One. Two."),
        (("We turn here.", "We turned here."), "We turn here."),
        (("We stop.", "Yes."), "We stop."),  # it says nothing beside the other
        (("Yes.",), "Yes."),
                (("We stop.", "No, we stop."), "We stop."),
        (("The limit is 50.", "The limit is 60."), "The limit is 50. The limit is 60."),
        (("It is 1.5 m.", "It is 1.6 m."), "It is 1.5 m. It is 1.6 m."),
        # A clause at the end that was told is left out; one before it stays.
        (("The bus stands.", "I braked, because the bus stands."), "The bus stands. I braked."),
        (("The bus stands.", "The bus stands, so I braked."),
         "The bus stands. The bus stands, so I braked."),
        (("The bus stands. I braked.", "We turned: the bus stands; I brake."),
         "The bus stands. I braked. We turned."),
        # Numbers of vehicles tell nothing new.
        (("The bus (vehicle 1) stands.", "The bus (1) stands."), "The bus (vehicle 1) stands."),
    ],
)  # fmt: skip
def test_nothing_is_told_twice(texts: tuple[str, ...], told: str) -> None:
    assert reply(*texts) == told


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("We brake: the bus stands; the bus stands.", "We brake: the bus stands."),
        ("We brake: the bus stands: standing.", "We brake: the bus stands."),
        ("We brake, because the bus stands, because it stands.",
         "We brake, because the bus stands, because it stands."),
        ("It is not moving: it moves.", "It is not moving: it moves."),
        ("It is moving: it moves.", "It is moving."),
        ("It stands: it is.", "It stands: it is."),
    ],
)  # fmt: skip
def test_a_sentence_does_not_end_with_what_it_began_with(text: str, told: str) -> None:
    assert reply(text) == told


@pytest.mark.parametrize(
    ("texts", "told"),
    [
        (("A cat. B dog. C cow. D pig.",), "A cat. B dog. C cow. D pig."),
        (("A cat. B dog. C cow.", "D pig. E hen."), "A cat. B dog. D pig."),
        (("A cat.", "D pig. E hen. F fox."), "A cat. D pig. E hen."),
        (("A cat. B dog.", "D pig. E hen.", "F fox. G owl."), "A cat. D pig. F fox."),
        (("A cat.", "B dog.", "C cow.", "D pig."), "A cat. B dog. C cow. D pig."),
        (("A cat. B dog.", "", "F fox. G owl."), "A cat. B dog. F fox."),
    ],
)
def test_several_answers_share_three_sentences(texts: tuple[str, ...], told: str) -> None:
    assert AT_MOST == 3
    assert reply(*texts) == told


def test_choices_are_left_whole_and_take_their_room() -> None:
    which = Utterance("A cat. B dog. C cow.", choices=("x", "y"))
    assert joined([which, Utterance("D pig. E hen.")]).text == "A cat. B dog. C cow. D pig."
    assert joined([Utterance("D pig. E hen."), which]).text == "D pig. E hen. A cat. B dog. C cow."


def test_vehicles_choices_and_suggestions_are_put_together() -> None:
    one = Utterance("A.", mentioned=(3, 1), suggestions=("s", "t"))
    other = Utterance("B.", mentioned=(1, 2), choices=("x",), suggestions=("t", "u"))
    last = Utterance("C.", choices=("y",))
    whole = joined([one, other, last])
    assert whole.mentioned == (3, 1, 2)
    assert whole.choices == ("x",)
    assert whole.suggestions == ("s", "t", "u")


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("One. Two! Three?", ("One.", "Two!", "Three?")),
        ("At 1.5 m", ("At 1.5 m",)),
        (
            "Is it (1) the bus. or (2) the car? Yes.",
            ("Is it (1) the bus.", "or (2) the car?", "Yes."),
        ),
        ("The bus (is it? yes.) stands. So.", ("The bus (is it? yes.) stands.", "So.")),
        ("  ", ()),
        ("One.  Two", ("One.", "Two")),
    ],
)
def test_sentences(text: str, found: tuple[str, ...]) -> None:
    assert sentences(text) == found


def test_a_clarification_told_again_is_none() -> None:
    which = WhichOne((Vehicle(1), Vehicle(2)))
    assert reason_of(which) == "ambiguous"
    assert reason_of(Again("longer", which)) is None
    assert reason_of(Again("longer", None)) is None
