"""Help with what is no question: what it lacks, and what it may have been meant to be."""

import pytest

from tests.language.annotated import parse
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.lattice import build
from xavi_dialogue.language.malformed import lacking
from xavi_dialogue.language.normalise import normalise
from xavi_dialogue.language.parse import NotUnderstood
from xavi_dialogue.language.refusals import realise_not_understood
from xavi_dialogue.language.wordlists import load
from xavi_dialogue.language.words import hear


def lacks(text: str) -> str | None:
    return lacking(build(hear(normalise(text), frozenset(range(6))).words))


@pytest.mark.parametrize(
    ("text", "lack"),
    [
        ("why did the truck", "no-action"),
        ("when will the blue car", "no-action"),
        ("what if the car behind us", "no-condition"),
        ("was changing left better than", "no-alternative"),
        ("vehicle 3", "no-question"),
    ],
)
def test_unseen_texts_lack_what_examples_lack(text: str, lack: str) -> None:
    assert all(text not in texts for texts in load("malformed.toml").values())
    assert lacks(text) == lack


def test_every_example_lacks_what_it_is_filed_under() -> None:
    for lack, texts in load("malformed.toml").items():
        for text in texts:
            assert lacks(text) is not None, (lack, text)


@pytest.mark.parametrize("lack", sorted(load("malformed.toml")))
def test_every_lack_has_words_of_its_own(lack: str) -> None:
    said = realise_not_understood(lack, SpeechContext()).text
    assert said != realise_not_understood("anything", SpeechContext()).text


@pytest.mark.parametrize("text", ["what if", "the left lane", "qwrt zxcv", "blah", "vehicle"])
def test_what_is_no_question_is_never_guessed_at(text: str) -> None:
    found = parse(text)
    assert isinstance(found, NotUnderstood) or found.type in ("ambiguous", "out_of_scope")
