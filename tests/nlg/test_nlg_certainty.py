"""What samples alone show is never said to be certain, nor said as if it were."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from msgspec.structs import replace as replace_struct

from tests.nlg.causal_cases import ALONE, CHANGED, LATER, MANY, ends
from tests.nlg.scenery import CONTEXT
from xavi_dialogue.domain.answers import Certainty, ChoiceReason, SupposedOfUs
from xavi_dialogue.domain.evidence import Share, calibrated
from xavi_dialogue.domain.facts import OptionValue
from xavi_dialogue.nlg.content.clauses.facts import option_message
from xavi_dialogue.nlg.content.reasons.terms import foil_verbs, parted
from xavi_dialogue.nlg.say import say
from xavi_dialogue.nlg.surface.chances import chance
from xavi_dialogue.nlg.surface.realiser import realised
from xavi_dialogue.nlg.surface.referring import ReferringContext
from xavi_dialogue.nlg.surface.tables import table

GRAMMARS = Path(__file__).parents[2] / "grammars"
#: Words of certainty; "almost certainly" and "more certain" are none.
SURE = re.compile(
    r"(?<!almost )\bcertainly\b|(?<!more )\bcertain to\b|\bfor (certain|sure)\b"
    r"|\bdefinitely\b|\bbound to\b|\bguaranteed\b|\b100 %",
    re.IGNORECASE,
)


@pytest.mark.parametrize("detail", ["usual", "more", "simpler"])
@pytest.mark.parametrize("name", ["collision", "termination"])
@pytest.mark.parametrize("past", [True, False])
def test_what_came_of_every_sample_is_said_to_be_almost_certain(name, detail, past):
    context = replace(CONTEXT, detail=detail)
    struck = 2 if name == "collision" else None
    why = ChoiceReason("why", CHANGED, ends(name, 1.0, struck))
    for answer in (why, SupposedOfUs(ends(name, 1.0, struck), past=past)):
        assert "almost certainly" in say(answer, context).text


@pytest.mark.parametrize("name", ["collision", "termination"])
def test_what_came_of_every_sample_is_as_likely_as_the_model_is_right(name):
    """Of an error of 0.2 each outcome has a quarter: 0.8 + 0.05 is "very likely"."""
    ending = ends(name, calibrated(1.0, 0.2), 2 if name == "collision" else None)
    for answer in (ChoiceReason("why", CHANGED, ending), SupposedOfUs(ending)):
        assert "very likely" in say(answer, CONTEXT).text
    option = OptionValue("continue", False, name, calibrated(1.0, 0.4), None, None, -5.0)
    assert "probably" in realised(option_message(option), CONTEXT, ReferringContext(CONTEXT))


@pytest.mark.parametrize("name", ["collision", "termination"])
def test_an_option_that_failed_in_every_sample_would_almost_certainly_have(name):
    option = OptionValue("continue", False, name, 1.0, None, None, -5.0)
    assert "almost certainly" in realised(
        option_message(option), CONTEXT, ReferringContext(CONTEXT)
    )


@pytest.mark.parametrize("name", ["termination", "dead", "done"])
def test_the_risk_of_a_collision_is_told_of_an_option_whatever_else_came_of_it(name):
    option = OptionValue("exit-right", False, name, 0.9, None, None, -5.0, 0.07)
    assert "7 %" in realised(option_message(option), CONTEXT, ReferringContext(CONTEXT))


@pytest.mark.parametrize("form", ["adverb", "modal", "would", "verdict", "clause", "percent"])
def test_no_probability_has_a_word_of_certainty(form):
    for percent in range(101):
        said = chance(percent / 100.0, form)
        assert said
        assert not SURE.search(said)
        assert said not in ("0 %", "will", "would", "yes", "no")


def test_no_rule_of_an_answer_has_a_word_of_certainty():
    # The style of the paper is its published grammar, whose adverb for 1 is "certainly".
    rules = sorted(set(GRAMMARS.glob("answer_*.rules")) - {GRAMMARS / "answer_paper.rules"})
    assert rules
    for path in rules:
        lines = path.read_text(encoding="utf-8").splitlines()
        found = [x for x in lines if not x.startswith("#") and SURE.search(x)]
        assert found == [], path.name
    assert table("chances")["band"][0]["adverb"] == "almost certainly"


@pytest.mark.parametrize(
    ("good", "covered", "proven", "said"),
    [
        (8, 0.9, 0.8, "those were the likelier ones"),
        (28, 0.9, 0.3, "those were the less likely ones"),
        (32, 0.6, 0.6, "which make up 60 % of what I thought possible"),
    ],
)
def test_a_count_of_situations_is_told_with_its_weight(good, covered, proven, said):
    held = Certainty("choice", 0.87, 0.8, good, 32, 10.0, MANY, LATER, 1, covered, proven)
    more = replace(CONTEXT, detail="more")
    assert said in say(held, more).text
    plain = replace_struct(held, proven=covered * good / 32, covered=covered)
    assert ("likel" in say(plain, more).text.split(". ", 1)[1]) is False


@pytest.mark.parametrize("contrast", [LATER, ALONE])
@pytest.mark.parametrize("share", [0.97, 0.87, 0.3])
def test_how_sure_is_one_number_and_how_far_it_holds_is_told_when_asked(contrast, share):
    about = "choice" if contrast.foil else "plan"
    held = Certainty(about, share, 0.2, 32, 32, 10.0, MANY, contrast, 1, 0.8, 0.8)
    assert say(held, CONTEXT).text.count(" %") == 1
    more = say(held, replace(CONTEXT, detail="more")).text
    assert "that chance is hardly below 20 %" in more
    assert "in all 32 situations" in more


@pytest.mark.parametrize(
    ("contrast", "said"),
    [
        (replace_struct(ALONE, fact_collision=0.09), "what I did at 9 %. My plan will"),
        (replace_struct(LATER, fact_collision=0.09), "at 9 % for what I did, and at "),
        (replace_struct(LATER, collision=0.21), "at under 1 % for what I did, and at 21 % for"),
    ],
)
def test_how_sure_tells_the_risk_of_a_collision_first(contrast, said):
    about = "choice" if contrast.foil else "plan"
    held = Certainty(about, 0.9, 0.8, 30, 32, 10.0, MANY, contrast, 1, 0.8, 0.8)
    for detail in ("usual", "more"):
        told = say(held, replace(CONTEXT, detail=detail)).text
        assert told.startswith("At 0:05, I put the risk of a collision")
        assert said in told


def test_what_both_plans_begin_with_is_left_out_of_the_foil() -> None:
    fact, foil = ("continue", "exit-left"), ("continue", "exit-right")
    contrast = replace_struct(LATER, fact=fact, foil=foil)
    assert [str(one.verb) for one in foil_verbs(contrast)] == ["turn right"]
    longer = replace_struct(contrast, foil=("continue",))
    assert parted(longer) == longer


def test_whether_a_foil_is_better_tells_its_risk() -> None:
    risky = (Share("collision", 20.0, 0.2),)
    contrast = replace_struct(LATER, collision=0.2, told=risky, verdict="better", causes=())
    told = say(SupposedOfUs(contrast, form="better"), CONTEXT).text
    assert told.startswith("No: there would have been a 20 % risk of a collision")
