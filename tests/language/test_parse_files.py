"""The parser's data: every file loads, and a broken one says where."""

from importlib import resources

import pytest

from xavi_dialogue.explain.query import QueryType
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.grammar import GRAMMAR_FILES, STARTS, grammar
from xavi_dialogue.language.phrases import Automaton, PhraseError, Sense
from xavi_dialogue.language.tokens import AUXILIARIES
from xavi_dialogue.language.wordlists import WORD_FILES, inflections, load, vocabulary

BUILTIN = {"BREAK", "NUMBER", "UNKNOWN"}


def automaton(*phrases: str) -> Automaton:
    built = Automaton(lambda verb: frozenset(inflections(verb)))
    for phrase in phrases:
        built.add(phrase, Sense("X", phrase))
    return built


def matches(phrase: str, text: str) -> bool:
    words = tuple(text.split())
    found = automaton(phrase).all_from(words, 0)
    return any(end == len(words) for end, _ in found)


def test_every_file_of_the_parser_loads() -> None:
    shipped = {f.name for f in resources.files("grammars").iterdir()}
    assert set(GRAMMAR_FILES) | set(WORD_FILES) | {"parse.toml"} <= shipped
    assert {name for name in shipped if name.startswith("words_")} == set(WORD_FILES)
    assert all(load(name) for name in WORD_FILES)
    assert grammar().rules


def test_start_rules_are_named_after_query_types() -> None:
    types = set(QueryType.__args__) - {"out_of_scope", "ambiguous"}
    assert types <= set(STARTS)


def test_the_grammar_uses_no_terminal_without_words() -> None:
    used = {s.name for r in grammar().rules for s in r.expansion if s.is_term}
    assert used <= vocabulary().terminals | BUILTIN


def test_cost_tables_speak_of_terminals_and_rules_that_exist() -> None:
    known = vocabulary().terminals | BUILTIN
    table = costs()
    assert set(table.skip) <= known
    assert table.boundary.begin_after | table.boundary.begin_at <= known
    assert table.boundary.end_before <= known
    assert set(table.base) <= set(STARTS)
    assert known >= AUXILIARIES


def test_what_carries_the_meaning_is_never_read_past() -> None:
    held = {"NOT", "NO", "IF", "WHY", "EGO", "CAR", "INSTEAD", "WITHOUT", "STOP", "TURN", "LEFT"}
    assert held.isdisjoint(costs().skip)


@pytest.mark.parametrize(
    ("phrase", "text", "fits"),
    [
        ("a|b c", "a c", True),
        ("a|b c", "b", False),
        ("(a b|c) d", "a b d", True),
        ("(a b|c) d", "c d", True),
        ("(a b|c) d", "a d", False),
        ("a b? c", "a c", True),
        ("(a|b)+ c", "a b a c", True),
        ("a (b (c|d e)? f)?", "a b d e f", True),
        ("a (b (c|d e)? f)?", "a", True),
        ("~give way", "gave way", True),
        ("~stop", "stopping", True),
        ("~stop", "stopped", True),
    ],
)
def test_the_notation_of_phrases(phrase: str, text: str, fits: bool) -> None:
    assert matches(phrase, text) is fits


@pytest.mark.parametrize("phrase", ["(a", "a)", "a?", "(a|b)?", "?", "a||b", "a|b c|d", ""])
def test_a_broken_phrase_is_refused(phrase: str) -> None:
    with pytest.raises(PhraseError):
        automaton(phrase)


def test_every_phrase_is_found_and_senses_keep_their_order() -> None:
    built = Automaton(lambda verb: frozenset({verb}))
    for phrase, terminal in (("a", "ONE"), ("a b", "TWO"), ("a", "THREE")):
        built.add(phrase, Sense(terminal, ""))
    one = (1, (Sense("ONE", ""), Sense("THREE", "")))
    assert built.all_from(("a", "b"), 0) == [one, (2, (Sense("TWO", ""),))]
    assert built.all_from(("a", "c"), 0) == [one]
    assert built.all_from(("c",), 0) == []


@pytest.mark.parametrize(
    ("verb", "forms"),
    [
        ("stop", {"stop", "stops", "stopping", "stopped"}),
        ("give", {"give", "gives", "giving", "gave", "given"}),
        ("hurry", {"hurry", "hurries", "hurrying", "hurried"}),
        ("cut", {"cut", "cuts", "cutting"}),
        ("pass", {"pass", "passes", "passing", "passed"}),
        ("overtake", {"overtake", "overtakes", "overtaking", "overtook", "overtaken"}),
    ],
)
def test_inflection(verb: str, forms: set[str]) -> None:
    assert set(inflections(verb)) == forms
