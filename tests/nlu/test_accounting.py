"""Every word is accounted for, whatever the text; what has no part in a reading is unknown."""

import random
import string
import tomllib
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from xavi_dialogue.domain.meaning import Ask, Beyond, Reading, Why
from xavi_dialogue.domain.terms import Event, Happens, Unknown
from xavi_dialogue.nlu.grammar.lexicon import lexicon
from xavi_dialogue.nlu.parse import Parser
from xavi_dialogue.nlu.text.tokens import MAX_TOKENS, tokenise

PARSER = Parser()
TABLE = Path(__file__).with_name("readings.toml")
TEXTS = [case["text"] for case in tomllib.loads(TABLE.read_text(encoding="utf-8"))["readings"]]
STRANGE = ("frobnicate", "zorblax", "vlorped", "blorping", "Xylograph")
HOSTILE = (
    "", " ", "?", "?!?", "\x00\x1b[31m", "a" * 5000, "why " * 200, "if " * 60, "what if " * 24,
    "vehicle 1 " * 48, "and " * 48, "don't " * 40, "'s 's 's", "-- -- --", "0:99 99999999999999999",
    "why did the car that the car that the car behind us followed overtook cut in front of stop",
    "in front of " * 16, "who who which where", "is " * 48, "left right " * 24, "because " * 40,
    "%%%% 5% %", "1 2 3 4 5 6", "second " * 40, "\u202ewhy", "wh\u0301y", "\U0001f697\U0001f697",
    "why\ndid\tyou\rstop", "WHY DID YOU STOP", "vehicle1turned", "3rd exit 2nd 1st", "((((",
)  # fmt: skip


def covers(text: str, reading: Reading) -> bool:
    typed = [token.text for token in tokenise(text).tokens]
    return [share.text for share in reading.shares] == typed


@pytest.mark.parametrize("text", TEXTS)
def test_shares_cover_the_words_of_each_reading(text: str) -> None:
    for reading in PARSER.read(text):
        assert covers(text, reading)


@pytest.mark.parametrize("text", HOSTILE, ids=lambda text: ascii(text[:30]))
def test_any_text_has_a_reading(text: str) -> None:
    readings = PARSER.read(text)
    assert readings
    assert all(covers(text, reading) for reading in readings)
    assert len(readings[0].shares) <= MAX_TOKENS


@settings(max_examples=150, deadline=None, derandomize=True)
@given(st.text(max_size=120))
def test_any_characters_have_a_reading(text: str) -> None:
    assert all(covers(text, reading) for reading in PARSER.read(text))


@settings(max_examples=150, deadline=None, derandomize=True)
@given(st.lists(st.sampled_from(sorted(lexicon().vocabulary.words)), max_size=12))
def test_any_row_of_known_words_has_a_reading(words: list[str]) -> None:
    text = " ".join(words)
    assert all(covers(text, reading) for reading in PARSER.read(text))


def test_a_word_that_is_none_is_never_swallowed() -> None:
    chance = random.Random(7)
    for text in TEXTS:
        words = text.split()
        strange = chance.choice(STRANGE)
        words.insert(chance.randrange(len(words) + 1), strange)
        best = PARSER.read(" ".join(words))[0]
        assert strange.lower() in best.unknown, " ".join(words)


def test_a_strange_verb_is_no_verb_that_is_known() -> None:
    best = PARSER.read("Why did you frobnicate left?")[0]
    event = Event("do", object=Unknown("frobnicate"), side="left")
    assert best.acts == (Ask(Why(Happens(event))),)
    assert best.unknown == ("frobnicate",)


def test_other_languages_are_told() -> None:
    for text in ("pourquoi tu as freiné ?", "warum hast du gebremst", "为什么停下来了?"):
        act = PARSER.read(text)[0].acts[0]
        assert isinstance(act, Beyond)
        assert act.topic == "non-english"


def test_the_same_text_is_read_the_same_way() -> None:
    assert Parser().read(TEXTS[0]) == Parser().read(TEXTS[0])


def test_every_letter_alone_has_a_reading() -> None:
    assert all(PARSER.read(letter) for letter in string.printable)
