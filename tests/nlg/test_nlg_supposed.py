"""What is said of suppositions, sudden acts and requests; see golden/supposed.txt."""

from pathlib import Path

import pytest

from tests.nlg import supposed_cases
from tests.nlg.scenery import CONTEXT
from tests.nlg.test_nlg_properties import check
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
