"""What is said of suppositions, sudden acts and requests; see golden/supposed.txt."""

from pathlib import Path

import pytest
from msgspec.structs import replace

from tests.nlg import supposed_cases
from tests.nlg.causal_cases import LATER, effect
from tests.nlg.scenery import CONTEXT
from tests.nlg.test_nlg_properties import check
from xavi_dialogue.domain.answers import Share, SupposedOfUs
from xavi_dialogue.nlg.say import say

GOLDEN = Path(__file__).parent / "golden" / "supposed.txt"
TEXTS = GOLDEN.read_text(encoding="utf-8").splitlines()


@pytest.mark.parametrize(
    ("answer", "text"), list(zip(supposed_cases.CASES, TEXTS, strict=True)), ids=TEXTS
)
def test_a_supposition_is_answered(answer, text):
    said = say(answer, CONTEXT).text
    assert said == text
    check(said)


def test_what_decided_against_a_gain_is_told_with_it():
    """A lane change that was too much for the gain is not kept quiet where it is asked what if."""
    gain = replace(
        LATER,
        fact=("continue",),
        foil=("change-left",),
        causes=(),
        effects=(effect("time", -0.8),),
        told=(Share("effort", 2.0), Share("time", -0.8)),
    )
    text = say(SupposedOfUs(gain), CONTEXT).text
    assert text.endswith("sooner, but it would have taken one more lane change.")
    free = replace(gain, told=(Share("jerk", 2.0),))
    assert "lane change" not in say(SupposedOfUs(free), CONTEXT).text
