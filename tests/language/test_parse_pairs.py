"""Pairs of texts that differ in little and mean different things."""

import pytest

from tests.language.annotated import query
from xavi_dialogue.explain.query import Query


def after(before: str | None, text: str) -> Query:
    """The query that a text means after an earlier one, if any."""
    return query(text, *([] if before is None else [before]))


@pytest.mark.parametrize(
    ("text", "actor", "time"),
    [
        ("What did the lorry do ten seconds ago?", "vehicle:truck", "10 seconds ago"),
        ("What did vehicle 10 do seconds ago?", "vehicle:10", "seconds ago"),
        ("What was vehicle 1 doing 5 s ago?", "vehicle:1", "5 s ago"),
        ("What have you done in the last ten seconds?", "ego", "in the last 10 seconds"),
        ("What will you do in 10 seconds?", "ego", "in 10 seconds"),
        ("What did you do between second 5 and 12?", "ego", "between second 5 and 12"),
        ("What happened between 5 and 12 seconds?", "ego", "between 5 and 12 seconds"),
        ("What were you doing at second 7?", "ego", "at second 7"),
    ],
)
def test_a_number_of_seconds_is_no_vehicle(text: str, actor: str, time: str) -> None:
    found = query(text)
    assert (found.type, found.actor, found.time) == ("what", actor, time)


@pytest.mark.parametrize("text", ["20 seconds ago", "And ten seconds ago?", "What about 5 s ago?"])
@pytest.mark.parametrize("before", ["What did you do?", "What was vehicle 2 doing?"])
def test_a_time_alone_is_put_into_the_question_before(before: str, text: str) -> None:
    found, spoken_of = after(before, text), query(before)
    assert (found.type, found.actor, found.tense) == ("what", spoken_of.actor, "past")
    assert found.time is not None


@pytest.mark.parametrize("text", ["And vehicle 20?", "What about 2?"])
def test_a_number_alone_is_a_vehicle(text: str) -> None:
    assert after("What did you do?", text).actor == f"vehicle:{text.strip('?').split()[-1]}"
