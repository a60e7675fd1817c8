"""Answers as JSON: the same for equal answers, wherever their parts come from."""

import msgspec
import pytest

from tests.dialogue.scripted import foil
from tests.traces import s1_ride
from xavi_dialogue.dialogue.explanation import as_json
from xavi_dialogue.domain.reasons import SupposedOfUs

ANSWER = foil(s1_ride().traces[0])
ASKED = "".join(("what", "-if"))  # equals the default, and is another object


@pytest.mark.parametrize("form", ["what-if", ASKED, "chance"])
def test_a_stored_answer_is_the_same_as_before(form: str) -> None:
    answer = msgspec.structs.replace(ANSWER, form=form)
    stored = msgspec.json.decode(msgspec.json.encode(answer), type=SupposedOfUs)
    assert as_json(stored) == as_json(answer)


def test_what_is_the_default_is_left_out_and_all_else_is_there() -> None:
    assert "form" not in as_json(msgspec.structs.replace(ANSWER, form=ASKED))
    assert as_json(msgspec.structs.replace(ANSWER, form="chance"))["form"] == "chance"


def test_an_answer_can_be_read_again() -> None:
    assert msgspec.convert(as_json(ANSWER), SupposedOfUs) == ANSWER
    assert as_json(ANSWER) == msgspec.json.decode(msgspec.json.encode(ANSWER))
