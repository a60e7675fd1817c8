"""That every answer can be said, and that no rule of the answer grammars is idle."""

import contextlib
import re
from dataclasses import replace
from pathlib import Path
from typing import get_args, get_type_hints

import pytest
from msgspec import Struct, structs

from tests.nlg import (
    answer_cases,
    causal_cases,
    danger_cases,
    dialogue_cases,
    journey_cases,
    light_cases,
    measure_cases,
    rare_cases,
    supposed_cases,
    turn_cases,
)
from tests.nlg.scenery import CONTEXT
from tests.nlg.test_nlg_properties import check
from xavi_dialogue.domain.answers import Again, Answer, Measures, Refusal
from xavi_dialogue.nlg import paper
from xavi_dialogue.nlg.say import PLANNERS, say
from xavi_dialogue.nlg.surface import generator
from xavi_dialogue.nlg.surface.realiser import grammar
from xavi_dialogue.nlg.surface.rules import load_grammar

GOLDEN = Path(__file__).parent / "golden" / "rare.txt"
DETAILS = ("usual", "more", "simpler", "less")
CASES = (
    *answer_cases.CASES,
    *causal_cases.CASES,
    *dialogue_cases.CASES,
    *danger_cases.CASES,
    *turn_cases.CASES,
    *journey_cases.CASES,
    *light_cases.CASES,
    *rare_cases.CASES,
    *supposed_cases.CASES,
    *(Measures(measures) for measures in measure_cases.CASES),
)
RARE = [
    pytest.param(case, text, id=text[:60])
    for case, text in zip(
        rare_cases.CASES, GOLDEN.read_text(encoding="utf-8").splitlines(), strict=True
    )
]


@pytest.fixture
def used(monkeypatch):
    """The names of the rules that are expanded."""
    names = set()
    whole = generator.expand

    def expand(rules, start, *values):
        names.add(start)
        return whole(rules, start, *values)

    monkeypatch.setattr(generator, "expand", expand)
    monkeypatch.setattr(paper, "expand", expand)
    return names


@pytest.mark.parametrize(("case", "text"), RARE)
def test_a_rare_answer_is_said(case, text):
    said = say(case, CONTEXT).text
    assert said == text
    check(said)


def test_every_answer_and_refusal_has_a_planner():
    assert set(PLANNERS) == {*get_args(Answer), *get_args(Refusal)}


def test_every_rule_is_needed_by_a_case(used):
    for case in CASES:
        for detail in DETAILS:
            say(case, replace(CONTEXT, detail=detail))
        say(case, replace(CONTEXT, repeated=True))
        for how in ("simpler", "shorter", "longer"):
            say(Again(how, case), CONTEXT)
    say(object(), CONTEXT)  # what has no planner
    assert not set(grammar()) - used


def test_every_rule_of_the_paper_is_needed_by_a_case(used):
    context = replace(CONTEXT, style="paper", max_causes=2, max_effects=2)
    for case in causal_cases.CASES:
        say(case, context)
    assert not set(load_grammar("answer_paper")) - used


@pytest.mark.parametrize("how", ["simpler", "shorter", "longer"])
def test_an_answer_is_never_merely_repeated_where_another_form_is_wanted(how):
    for case in causal_cases.CHOICES:
        before = say(case, CONTEXT).text
        after = say(Again(how, case), CONTEXT).text
        assert after != before
        check(after)


def test_shorter_is_no_longer_and_longer_is_no_shorter():
    lead = re.compile(r"^(I cannot put it more briefly|That is all I can tell you): ")
    for case in causal_cases.CHOICES:
        usual = len(say(case, CONTEXT).text)
        shorter = lead.sub("", say(Again("shorter", case), CONTEXT).text)
        longer = lead.sub("", say(Again("longer", case), CONTEXT).text)
        assert len(shorter) <= usual <= len(longer)


def lacking(value):
    """Yield an answer with one value after the other left out, also within its parts.

    An answer that cannot be built so is none.
    """
    for name, one in _left_out(value):
        with contextlib.suppress(ValueError):
            yield structs.replace(value, **{name: one})


def _left_out(value):
    hints = get_type_hints(type(value))
    for name in value.__struct_fields__:
        inner, hint = getattr(value, name), str(hints[name])
        if inner is not None and "None" in hint:
            yield name, None
        if isinstance(inner, tuple) and inner and "..." in hint:
            yield name, ()
        if isinstance(inner, bool):
            yield name, not inner
        if isinstance(inner, Struct):
            yield from ((name, one) for one in lacking(inner))
        if isinstance(inner, tuple) and inner and isinstance(inner[0], Struct):
            yield from ((name, (one, *inner[1:])) for one in lacking(inner[0]))


@pytest.mark.parametrize("detail", DETAILS)
def test_an_answer_that_lacks_a_value_can_be_said(detail):
    for case in CASES:
        for one in lacking(case):
            assert say(one, replace(CONTEXT, detail=detail)).text
