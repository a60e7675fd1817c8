"""The answer grammars as data: they load, hold together, and say where they are at fault."""

from dataclasses import dataclass
from importlib.resources import files

import pytest

from planner.trace import ACTIONS, COMPONENTS
from xavi_dialogue.language.generator import ExpansionError, Slot, expand
from xavi_dialogue.language.rules import (
    Call,
    Grammar,
    GrammarError,
    Word,
    load_grammar,
    read_grammar,
)
from xavi_dialogue.language.wording import PAPER_ADVERBS, lexicon, rewrite, rewrites

STARTS = {
    "answer_paper": {"S"},
    "answer_passenger": {
        "AGAIN",
        "SIGHT",
        "OPTIONS",
        "NEED",
        "LANE",
        "WHY",
        "BRIEF",
        "WHAT_IF",
        "CONSTRAINT",
        "WHEN",
        "SUPPOSE",
        "MOTIVE",
        "WHAT",
        "WHERE",
        "CONFIDENCE",
        "GROUNDS",
        "PLAN",
        "METHOD",
        "SURENESS",
        "EVASION",
        "IMPACT",
        "FACTOR",
        "UNMOVED",
        "COMPARISON",
        "AT_TIME",
    },
    "answer_refusals": {"REFUSAL", "CHOOSE"},
    "answer_questions": {"QUESTION"},
    "answer_quiz": {"AGAIN", "VERDICT", "NOTHING"},
}


@dataclass(frozen=True)
class Thing:
    name: str | None
    size: float
    parts: tuple[str, ...] = ()


def called(grammar: Grammar) -> set[str]:
    return {
        item.rule
        for rule in grammar.values()
        for alternative in rule.alternatives
        for item in alternative.items
        if isinstance(item, Call)
    }


def test_every_grammar_file_is_known() -> None:
    shipped = {p.name for p in files("grammars").iterdir() if p.name.endswith(".rules")}
    assert shipped == {f"{name}.rules" for name in STARTS}


@pytest.mark.parametrize("name", STARTS)
def test_every_rule_can_be_reached(name: str) -> None:
    grammar = load_grammar(name)
    assert set(grammar) - called(grammar) == STARTS[name]


@pytest.mark.parametrize("name", STARTS)
def test_no_alternative_is_shadowed(name: str) -> None:
    """Only the last alternative of a rule may do without a guard."""
    for rule in load_grammar(name).values():
        assert all(a.guard for a in rule.alternatives[:-1]), rule.name


def test_the_papers_adverbs_are_those_of_its_grammar() -> None:
    alternatives = load_grammar("answer_paper")["ADV"].alternatives
    said = tuple(i.text for a in alternatives for i in a.items if isinstance(i, Word))
    assert said == PAPER_ADVERBS


def test_the_lexicon_has_words_for_every_action_and_component() -> None:
    words = lexicon()
    for action in ACTIONS:
        for variants in ((), ("ego",), ("in-lane",), ("paper",)):
            assert words.action(action, *variants)
        for form in ("base", "past", "participle", "gerund"):
            assert words.inflect(words.action(action), form)
    assert set(words.components) == set(words.negligible) == set(COMPONENTS)


def test_rewrites_reach_a_fixed_point() -> None:
    for style in ("paper", "passenger", "own"):
        assert rewrites(style)
    raw = "If ego had changed left then it would have certainly reached its goal because ."
    once = rewrite(raw, "paper")
    assert once == "If ego had changed left then it would have reached the goal."
    assert rewrite(once, "paper") == once


SMALL = read_grammar(
    """
    # a comment
    SAY[x]   -> <x.size = 1> one PART[x.parts]
              | <x.size <= 2 and not x.name> nameless
              | <x.size < 3> {x.name:full} FEW["twice"]
              | ε
    PART[p]  -> <p.size = 0> ε
              | {p.first} PART[p.rest]
    FEW[n]   -> <n = "twice"> two
    """
)


@pytest.mark.parametrize(
    ("thing", "tokens"),
    [
        (Thing("a", 1, ("x", "y")), (Word("one"), Slot("x", "plain"), Slot("y", "plain"))),
        (Thing("a", 1 - 1e-12), (Word("one"),)),
        (Thing(None, 2), (Word("nameless"),)),
        (Thing("a", 2.5), (Slot("a", "full"), Word("two"))),
        (Thing("a", 3 - 1e-12), ()),
    ],
)
def test_expansion(thing: Thing, tokens: tuple[Word | Slot, ...]) -> None:
    assert expand(SMALL, "SAY", thing) == tokens


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("A[x] -> B[x]", "A calls B: no such rule"),
        ("A[x] -> B[x, x]\nB[y] -> b", "gives B 2 arguments; it takes 1"),
        ("A[x] -> {y}", "y is not a parameter of A"),
        ("A[x] -> a\nA[x] -> b", "A is defined twice"),
        ("A[x] -> {x", "grammar:"),
    ],
)
def test_faults_are_named(text: str, complaint: str) -> None:
    with pytest.raises(GrammarError, match=complaint.replace("[", r"\[")):
        read_grammar(text)


def test_a_value_without_alternative_is_an_error() -> None:
    grammar = read_grammar('A[x] -> <x = "a"> a')
    with pytest.raises(ExpansionError, match="rule A has no alternative"):
        expand(grammar, "A", "b")


def test_a_slot_without_value_is_an_error() -> None:
    with pytest.raises(ExpansionError, match=r"no value at x\.name"):
        expand(read_grammar("A[x] -> {x.name}"), "A", Thing(None, 1))
