"""What is said of every kind of causal answer and refusal, and what holds of all of it."""

import re
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.record.trace import COMPONENTS
from tests.nlg import causal_cases, light_cases, rare_cases, supposed_cases
from tests.nlg.causal_cases import AHEAD, CHANGED, LATER, RISKY, effect
from tests.nlg.scenery import CONTEXT
from xavi_dialogue.domain.answers import (
    Cause,
    ChoiceReason,
    Contrast,
    Evidence,
    Mechanism,
    NotUnderstood,
    OutcomeEstimate,
    Share,
    SupposedOfUs,
)
from xavi_dialogue.domain.vocabulary import MACRO_ACTIONS
from xavi_dialogue.explain.causes.plans.terms import Difference, told
from xavi_dialogue.nlg.content.causal_tables import CAUSES, REFUSALS
from xavi_dialogue.nlg.content.reasons.contrasts import told_cause
from xavi_dialogue.nlg.say import say
from xavi_dialogue.nlg.surface.orthography import count_sentences

GOLDEN = Path(__file__).parent / "golden"
DETAILS = ("usual", "more", "simpler")
UNTIDY = re.compile(r"[,;:]\s*[,.;:]|\s[,.;:?]|  |\(\s|\s\)|[{}_<>|ε]|\bNone\b|\.\.")
DOUBLED = re.compile(r"\b(\w+) \1\b", re.IGNORECASE)
FIGURE = re.compile(r"\d+ (%|km/h|seconds?|metres?)")


def spoken(detail):
    texts = (GOLDEN / f"causal_{detail}.txt").read_text(encoding="utf-8").splitlines()
    pairs = zip(causal_cases.CASES, texts, strict=True)
    return [pytest.param(detail, case, text, id=f"{detail}: {text[:60]}") for case, text in pairs]


@pytest.mark.parametrize(("detail", "answer", "text"), [p for d in DETAILS for p in spoken(d)])
def test_an_answer_is_said(detail, answer, text):
    said = say(answer, replace(CONTEXT, detail=detail)).text
    assert said == text
    assert not UNTIDY.search(said)
    assert not DOUBLED.search(said)


@pytest.mark.parametrize("answer", causal_cases.CASES)
def test_an_answer_is_short_unless_more_is_wanted(answer):
    usual = say(answer, CONTEXT).text
    assert count_sentences(usual) <= 4
    assert count_sentences(say(answer, replace(CONTEXT, detail="less")).text) <= 3


@pytest.mark.parametrize("answer", causal_cases.CASES)
def test_simpler_words_have_no_figures(answer):
    assert not FIGURE.search(say(answer, replace(CONTEXT, detail="simpler")).text)


def test_every_kind_has_a_case():
    every = (
        *causal_cases.CASES, *rare_cases.CASES, *supposed_cases.CASES, *light_cases.CASES,
    )  # fmt: skip
    cases = {type(case) for case in every}
    assert set(CAUSES) | set(REFUSALS) <= cases


# --- The truth of words ---------------------------------------------------------------------------

actions = st.lists(st.sampled_from(MACRO_ACTIONS), min_size=1, max_size=3).map(tuple)
shares = st.floats(0.0, 1.0)
mechanisms = st.none() | st.builds(
    Mechanism,
    st.sampled_from(("leader", "right-of-way", "cut-in", "blocked", "collision")),
    st.none() | st.floats(0.0, 30.0),
    st.none() | st.floats(0.0, 30.0),
    st.none() | st.floats(0.0, 9.0),
    shares,
    st.booleans(),
)
causes = st.lists(
    st.builds(Cause, st.integers(1, 4), actions | st.just(()), shares, mechanisms),
    max_size=3,
    unique_by=lambda c: c.vehicle,
).map(tuple)
outcomes = st.builds(
    OutcomeEstimate,
    st.sampled_from(("done", "collision", "dead", "termination")),
    shares,
    st.none() | st.integers(1, 4),
)
terms = st.dictionaries(
    st.sampled_from((*COMPONENTS, "collision", "dead", "late", "effort")),
    st.floats(-30.0, 30.0).filter(lambda cost: abs(cost) > 1e-6),
    max_size=5,
)


def contrast_of(terms, error, risks, aim, **more):
    """Make a contrast of terms, with what is told of them."""
    chances = {"collision": risks, "dead": (0.1, 0.0), "late": (0.3, 0.1)}
    difference = Difference(terms, error, chances)
    return Contrast(
        **more,
        effects=tuple(
            effect(name, 0.5 * cost) for name, cost in terms.items() if name in COMPONENTS
        ),
        collision=risks[0] if risks[0] >= 0.01 else 0.0,
        fact_collision=risks[1],
        aim=aim,
        verdict=difference.verdict,
        terms=difference.shares,
        told=told(difference),
        error=error,
    )


contrasts = st.builds(
    contrast_of,
    terms=terms,
    error=st.floats(0.0, 3.0),
    risks=st.tuples(shares, shares) | st.just((0.0, 0.0)),
    aim=st.none() | st.just(AHEAD) | st.just(msgspec.structs.replace(AHEAD, destination=True)),
    fact=actions,
    foil=actions,
    outcome=outcomes,
    causes=causes,
    evidence=st.just(Evidence("tree", 9, 9)),
    decided=st.floats(0.0, 20.0),
    collided_with=st.none() | st.integers(1, 4),
    continued=actions | st.just(()),
)
forms = st.sampled_from(("why", "why-not", "necessary", "worth-it"))
details = st.sampled_from(("less", "usual", "more", "simpler"))


@given(contrasts, forms, st.booleans(), details)
def test_any_contrast_can_be_said(contrast, form, past, detail):
    context = replace(CONTEXT, detail=detail)
    for answer in (ChoiceReason(form, CHANGED, contrast, past=past), SupposedOfUs(contrast)):
        text = say(answer, context).text
        assert not UNTIDY.search(text), text


@given(contrasts, forms, st.booleans())
def test_the_risk_of_a_collision_is_always_told(contrast, form, past):
    if max(contrast.collision, contrast.fact_collision) < 0.01:
        return
    text = say(ChoiceReason(form, CHANGED, contrast, past=past), CONTEXT).text
    assert "collision" in text


@given(contrasts)
def test_what_reaches_only_a_waypoint_does_not_get_us_there(contrast):
    contrast = msgspec.structs.replace(contrast, aim=AHEAD)
    for answer in (ChoiceReason("why", CHANGED, contrast), SupposedOfUs(contrast)):
        text = say(answer, CONTEXT).text
        assert "us there" not in text
        assert "got there" not in text
        assert "destination" not in text


@given(contrasts)
def test_a_gain_is_not_given_as_the_reason_against_it(contrast):
    """Where the foil is quicker, that is told as against the reason, as close or as better."""
    text = say(ChoiceReason("why", CHANGED, contrast), CONTEXT).text
    if re.search(r"\bsaved\b|\bsooner\b|\bquicker\b", text):
        words = r"\bthough\b|\bclose\b|\bnot enough\b|\btoo little\b|\bbetter\b"
        assert re.search(words, text), text


@given(contrasts, st.sampled_from(("why", "why-not")))
def test_each_verdict_has_its_words(contrast, form):
    if not contrast.foil or contrast.outcome is None:
        return
    text = say(ChoiceReason(form, CHANGED, contrast), CONTEXT).text
    assert ("t was a close decision: " in text) == (contrast.verdict == "close")
    assert ("I now think that" in text) == (contrast.verdict == "worse")


def test_reasons_that_speak_for_the_foil_cannot_be_given():
    with pytest.raises(ValueError, match="told terms weigh"):
        msgspec.structs.replace(LATER, told=(Share("time", 1.0), Share("jerk", -1.5)))
    with pytest.raises(ValueError, match="told terms weigh"):
        msgspec.structs.replace(LATER, verdict="worse")


def test_the_risk_that_decided_is_the_reason():
    text = say(ChoiceReason("why", CHANGED, RISKY), CONTEXT).text
    assert text.index("46 %") < text.index("saved")
    assert "because going straight on carried a 46 % risk of a collision" in text


def test_suggestions_are_not_made_again():
    first = say(NotUnderstood(), CONTEXT)
    assert first.suggestions
    again = say(NotUnderstood(), replace(CONTEXT, suggested=frozenset(first.suggestions)))
    assert not set(first.suggestions) & set(again.suggestions)
    assert (
        "What if vehicle 1 had not been there?"
        in say(ChoiceReason("why", CHANGED, LATER), CONTEXT).suggestions
    )


@pytest.mark.parametrize(
    ("share", "outcome", "named"),
    [
        (0.1, "done", True),
        (0.09, "done", False),
        (0.45, "termination", True),
        (0.4, "termination", False),  # it is late in nine of ten
    ],
)
def test_who_is_rarely_in_the_way_is_no_reason_for_what_comes_anyway(share, outcome, named):
    rare = msgspec.structs.replace(
        causal_cases.TURNS_OFF, mechanism=Mechanism("leader", 9.0, 3.6, 4.0, share)
    )
    chance = 0.9 if outcome == "termination" else 1.0
    contrast = causal_cases.ends(outcome, chance, causes=(rare,))
    assert (told_cause(contrast) is not None) == named
