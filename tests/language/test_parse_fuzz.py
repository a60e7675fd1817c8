"""Any input: no exception, caps hold, one text one meaning on any hash seed."""

import os
import subprocess
import sys

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.language.annotated import lines, parse, parser
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.normalise import MAX_WORDS, normalise
from xavi_dialogue.language.parse import NotUnderstood, Parser
from xavi_dialogue.language.wordlists import vocabulary

WORDS = sorted(vocabulary().words)
KNOWN = st.lists(st.sampled_from(WORDS), max_size=30).map(" ".join)
MIXED = st.lists(
    st.one_of(st.sampled_from(WORDS), st.text(max_size=6), st.sampled_from([",", "?", "1", "42"])),
    max_size=40,
).map(" ".join)


@settings(max_examples=150, deadline=None)
@given(st.one_of(st.text(max_size=400), KNOWN, MIXED))
def test_every_text_has_a_result(text: str) -> None:
    assert isinstance(parse(text), Query | NotUnderstood)


@settings(max_examples=60, deadline=None)
@given(MIXED, st.lists(KNOWN, max_size=3))
def test_every_conversation_has_a_result(text: str, turns: list[str]) -> None:
    first = parse(text, *turns)
    assert first == Parser().parse(text, context=tuple(turns))


@settings(max_examples=60, deadline=None)
@given(st.text(max_size=2000))
def test_no_more_than_the_caps_is_read(text: str) -> None:
    assert len(normalise(text).words) <= MAX_WORDS


@settings(max_examples=100, deadline=None)
@given(st.sampled_from([line["text"] for line in lines("learn/dev.jsonl")]), st.data())
def test_mutated_questions_have_a_result(text: str, data: st.DataObject) -> None:
    cut = data.draw(st.integers(0, len(text)))
    paste = data.draw(st.text(max_size=3))
    assert isinstance(parse(text[:cut] + paste + text[cut + 1 :]), Query | NotUnderstood)


def test_rules_do_not_grow_with_repetition() -> None:
    for word in ("why", "if", "not", "and stop", "turn left and", "why not", ",", "vehicle 1"):
        report = parser().explain(f"{word} " * 48)
        assert len(report.readings) <= 60


PROGRAM = """
import sys
from xavi_dialogue.language.parse import Parser
for line in sys.stdin:
    print(Parser().explain(line.rstrip("\\n"), context=("Why did vehicle 1 stop?",)))
"""


def test_the_hash_seed_changes_nothing() -> None:
    asked = "\n".join(line["text"] for line in lines("learn/dev.jsonl"))

    def run(seed: str) -> str:
        return subprocess.run(
            [sys.executable, "-c", PROGRAM],
            input=asked,
            capture_output=True,
            text=True,
            check=True,
            env={**os.environ, "PYTHONHASHSEED": seed, "PYTHONIOENCODING": "utf-8"},
        ).stdout

    first = run("1")
    assert first.count("ParseReport") == len(lines("learn/dev.jsonl"))
    assert first == run("2")
