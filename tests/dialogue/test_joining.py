"""One reply of several answers: nothing twice, and no more than is asked."""

import pytest

from xavi_dialogue.dialogue.joining import joined, sentences
from xavi_dialogue.nlg.context import Utterance


def reply(*texts: str) -> str:
    return joined([Utterance(text) for text in texts]).text


@pytest.mark.parametrize(
    ("first", "second", "text"),
    [
        (
            "I braked, because the bus was standing ahead of us.",
            "Yes: I was braking, because the bus stood ahead of us at 0:12.",
            "I braked, because the bus was standing ahead of us."
            " Yes: I was braking, because the bus stood ahead of us at 0:12.",
        ),
        (
            "I am braking, because I have to let the bus go first.",
            "No, the lorry made no difference: I braked, because I have to let the bus go first.",
            "I am braking, because I have to let the bus go first."
            " No, the lorry made no difference.",
        ),
        (
            "I expect the blue car (vehicle 1) to turn right (92 %).",
            "Probably: I put the chance that the blue car will turn right at 92 %.",
            "I expect the blue car (vehicle 1) to turn right (92 %).",
        ),
        (
            "The bus is standing still.",
            "No, the bus is not standing still.",
            "The bus is standing still. No, the bus is not standing still.",
        ),
        (
            "Our road has three lanes in our direction.",
            "We are in the right lane of three.",
            "Our road has three lanes in our direction. We are in the right lane of three.",
        ),
        (
            "We have right of way.",
            "Yes, that is right: we have right of way.",
            "We have right of way.",
        ),
    ],
)
def test_what_was_told_is_not_told_again(first: str, second: str, text: str) -> None:
    assert reply(first, second) == text


def test_a_clause_is_not_told_twice_in_one_sentence() -> None:
    assert reply("Yes, the bus is still standing still: it is standing still.") == (
        "Yes, the bus is still standing still."
    )
    fast = "No, we are doing 50 km/h: the limit here is 60 km/h."
    assert reply(fast) == fast


def test_choices_are_told_whole_even_where_they_were_named() -> None:
    which = Utterance("Do you mean (1) the bus or (2) the lorry?", choices=("the bus", "the lorry"))
    told = joined([Utterance("I see the bus and the lorry."), which])
    assert told.text.endswith(which.text)


def test_sentences_are_cut_behind_their_marks() -> None:
    assert sentences('One at 1.5 m. "Two"? Three') == ("One at 1.5 m.", '"Two"?', "Three")
