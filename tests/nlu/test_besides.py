"""What stands beside a question in the same breath."""

import pytest

from xavi_dialogue.domain.meaning import Ask, Claim, Elliptic, Request
from xavi_dialogue.domain.terms import Exists, Happens
from xavi_dialogue.nlu.parse import Parser


def acts(text: str) -> list[str]:
    return [type(act).__name__ for act in Parser().read(text)[0].acts]


@pytest.mark.parametrize(
    "text",
    [
        "Decision 4, change-left. Why did you do that?",
        "And vehicle 2? I see it standing at the side road. How sure were you?",
    ],
)
def test_what_leads_up_to_a_question_is_a_claim(text: str) -> None:
    found = Parser().read(text)[0].acts
    assert isinstance(found[0], Claim)
    assert isinstance(found[0].that, Happens | Exists)
    assert isinstance(found[-1], Ask)
    assert not any(isinstance(act, Request | Elliptic) for act in found)


def test_do_you_know_behind_a_question_asks_nothing_more() -> None:
    assert acts("Where's it off to, do you know?") == ["Ask"]


def test_when_behind_the_closest_is_told_with_it() -> None:
    assert acts("What was the smallest distance to it, and at what time?") == ["Ask"]


def test_a_fragment_that_asks_is_kept() -> None:
    assert acts("and the bus? And the lorry?") == ["Elliptic", "Elliptic"]


def test_an_order_with_a_question_mark_asks() -> None:
    assert acts("Sit behind this lorry all morning?") == ["Ask"]
    assert acts("Slow down, please?") == ["Request"]
