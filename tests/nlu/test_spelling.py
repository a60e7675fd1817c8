"""What was typed or heard wrongly is read as what was meant; what was typed rightly is kept."""

import pytest

from xavi_dialogue.nlu.grammar.lexicon import lexicon
from xavi_dialogue.nlu.interpret import interpret
from xavi_dialogue.nlu.text.spelling import corrections


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("sofar", ("so", "far")),
        ("isit", ("is", "it")),
        ("forus", ("for", "us")),
        ("dowe", ("do", "we")),
        ("wjy", ("why",)),
        ("anf", ("and",)),
        ("ment", ("meant",)),
    ],
)
def test_a_word_that_is_none_is_taken_for_a_common_one(typed: str, meant: tuple[str, ...]) -> None:
    assert meant in [words for words, _ in corrections(typed, lexicon().vocabulary)]


@pytest.mark.parametrize("name", ["xj", "digger", "smiley"])
def test_a_word_is_not_taken_for_one_with_other_consonants(name: str) -> None:
    found = corrections(name, lexicon().vocabulary)
    assert not {("danger",), ("dinner",), ("silly",)} & {words for words, _ in found}


@pytest.mark.parametrize(
    ("wrong", "right"),
    [
        ("how many turns hav we made sofar", "how many turns have we made so far"),
        ("how long isit till we turn", "how long is it till we turn"),
        ("what is the car in front ofus doing", "what is the car in front of us doing"),
        ("r we too close two the lorry", "are we too close to the lorry"),
        (
            "has the gap too the lorry got bigger since you changed lanes",
            "has the gap to the lorry got bigger since you changed lanes",
        ),
        ("why dont you over take the bike", "why don't you overtake the bike"),
        ("would you also have st opped here", "would you also have stopped here"),
        (
            "are those people going to walk ac ross the road",
            "are those people going to walk across the road",
        ),
        ("why are we braking forno reason", "why are we braking for no reason"),
        ("who has to give way hree, us or them?", "who has to give way here, us or them?"),
        ("Is that becuase of us?", "Is that because of us?"),
    ],
)
def test_a_text_written_wrongly_is_read_as_the_one_that_was_meant(wrong: str, right: str) -> None:
    assert interpret(wrong)[0].acts == interpret(right)[0].acts


def test_both_halves_of_a_word_typed_as_two_are_accounted_for() -> None:
    shares = interpret("why are we st anding")[0].shares
    assert [(s.text, s.read) for s in shares[3:]] == [("st", "standing"), ("anding", "standing")]


@pytest.mark.parametrize(
    "text", ["did you see two lorries there", "is that a cat on the road", "were you braking then"]
)
def test_a_text_written_rightly_is_not_read_by_ear(text: str) -> None:
    assert [share.read.split()[0] for share in interpret(text)[0].shares[:2]] == text.split()[:2]
