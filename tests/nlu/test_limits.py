"""Limits: digit-like signs are no numbers, and hostile texts take a bounded number of steps."""

import pytest

from xavi_dialogue.nlu import parse
from xavi_dialogue.nlu.grammar.chart import Budget
from xavi_dialogue.nlu.parse import MAX_STEPS, Parser
from xavi_dialogue.nlu.text.tokens import MAX_CHARACTERS

PARSER = Parser()
SIGNS = ("6\u2776", "\u136b", "vehicle \u136b", "2's", "vehicle 2's speed", "\u0663 cars", "\u00bd")
REPEATED = (
    "turn left and ", "go on or give way or ", "why did you brake and ", "i think you think ",
    "do you know why ", "left then right then ", "stop ", "if you ", "zqx ",
)  # fmt: skip


@pytest.mark.parametrize("text", SIGNS)
def test_signs_that_look_like_digits_are_read(text: str) -> None:
    assert PARSER.read(text)


@pytest.mark.parametrize("piece", REPEATED)
def test_steps_are_bounded(piece: str, monkeypatch: pytest.MonkeyPatch) -> None:
    budgets: list[Budget] = []

    def counted(steps: int) -> Budget:
        budgets.append(Budget(steps))
        return budgets[-1]

    monkeypatch.setattr(parse, "Budget", counted)
    text = (piece * 60)[:MAX_CHARACTERS]
    parse._read.cache_clear()
    first = PARSER.read(text)
    assert len(budgets) == 1
    assert budgets[0].steps > -100  # the step that ends it may cost more than was left
    assert MAX_STEPS - budgets[0].steps > 0
    parse._read.cache_clear()
    assert PARSER.read(text) == first


@pytest.mark.parametrize("text", [
    "Decision 3: continue and change-left came out within half a point of each other.",
    "and now its on agian??",
])  # fmt: skip
def test_what_is_made_of_leftovers_is_not_understood(text: str) -> None:
    reading = PARSER.read(text)[0]
    assert reading.unknown
    assert not any(type(act).__name__ in ("Ask", "Claim", "Request") for act in reading.acts)


@pytest.mark.parametrize("text", ["Minimum gap to 2 over the whole manoeuvre, in metres?",
                                  "overtaking?", "hw long til we r there",
                                  "and the bus?"])  # fmt: skip
def test_what_is_plain_stays_understood(text: str) -> None:
    assert PARSER.read(text)[0].acts


@pytest.mark.parametrize("word", ["lets", "cars", "the car of", "who said that"])
def test_nesting_without_end_is_read_without_a_fault(word: str) -> None:
    assert PARSER.read(" ".join([word] * 48)[:MAX_CHARACTERS])
