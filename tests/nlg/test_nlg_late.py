"""A foil that does not arrive within the time looked ahead is told so, whatever is asked of it."""

from dataclasses import replace as changed

import pytest
from msgspec.structs import replace

from tests.nlg.causal_cases import CHANGED
from tests.nlg.rare_cases import LONG, LONG_BOTH, QUICK
from tests.nlg.scenery import CONTEXT
from xavi_dialogue.domain.answers import ChoiceReason, Closeness, Contrast, SupposedOfUs
from xavi_dialogue.nlg.say import say

FORMS = ("why", "why-not", "necessary", "worth-it")
ASKED = ("what-if", "better", "quicker", "arrival", "could")
BEYOND = "would almost certainly have taken us more than 30 seconds to our destination"


def texts(against: Contrast, detail: str = "usual") -> list[str]:
    context = changed(CONTEXT, detail=detail)  # type: ignore[arg-type]
    own = [ChoiceReason(form, CHANGED, against) for form in FORMS]  # type: ignore[arg-type]
    asked = [SupposedOfUs(against, form=form) for form in ASKED]  # type: ignore[arg-type]
    return [say(answer, context).text for answer in (*own, *asked)]


def test_all_forms_tell_that_it_does_not_arrive() -> None:
    for text in texts(LONG):
        assert "would almost certainly have taken us more than 9 seconds longer" in text  # 9.6 s
        assert "about" not in text


def test_where_the_record_does_not_bound_it_no_seconds_are_told() -> None:
    for text in texts(replace(LONG, exceeds=None)):
        assert BEYOND in text
        assert "longer than my choice" not in text


def test_of_two_that_do_not_arrive_none_is_told_to_take_less_long() -> None:
    for text in texts(LONG_BOTH):
        assert "less long" not in text
        assert "still longer" not in text
        assert "more of the way to go after 30 seconds" in text or "and so would" in text


def test_a_foil_that_arrives_where_the_fact_does_not_is_told_so() -> None:
    for text in texts(QUICK):
        assert "would have been more than 9 seconds quicker than my choice" in text
    assert texts(QUICK)[FORMS.index("worth-it") + 1 + ASKED.index("quicker")].startswith("Yes")


@pytest.mark.parametrize("against", [LONG, LONG_BOTH, QUICK])
def test_simple_words_have_no_seconds(against: Contrast) -> None:
    for text in texts(against, "simpler"):
        assert "second" not in text
        assert "that I looked ahead" in text


@pytest.mark.parametrize(
    ("chance", "told"),
    [(0.99, "almost certainly"), (0.85, "very likely"), (0.7, "probably")],
)
def test_leaving_the_way_is_told_as_likely_as_it_is(chance: float, told: str) -> None:
    share = replace(LONG.told[0], chance=chance)
    outcome = replace(LONG.outcome, probability=chance)
    against = replace(
        LONG, foil=("exit-left",), way=True, outcome=outcome, terms=(share,), told=(share,)
    )
    text = say(SupposedOfUs(against, form="what-if"), CONTEXT).text
    assert f"we would {told} have left our way to the destination" in text


@pytest.mark.parametrize(
    ("risk", "begins"), [(0.94, "No: "), (0.2, "It is tight: "), (0.03, "I put the risk")]
)
def test_nothing_is_called_safe_or_careful_at_a_risk(risk: float, begins: str) -> None:
    text = say(Closeness(None, None, risk=risk, asked="safe", past=False), CONTEXT).text
    assert text.startswith(begins)
    assert "care" not in text
