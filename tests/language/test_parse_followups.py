"""What a text means after an earlier one: whose deed it is about, which part of it is taken over."""

import pytest

from tests.language.annotated import query
from xavi_dialogue.explain.query import Query

SLOWED = "Why did you slow down?"
LAID = [  # (question before, text, actor, factual, hypothesised cause)
    (SLOWED, "Did vehicle 2 have anything to do with it?", "ego", ("slow-down",), "vehicle:2"),
    (SLOWED, "Was that because of vehicle 2?", "ego", ("slow-down",), "vehicle:2"),
    (SLOWED, "Was it because of vehicle 2?", "ego", ("slow-down",), "vehicle:2"),
    (SLOWED, "And why did vehicle 2 slow down?", "vehicle:2", ("slow-down",), None),
    (
        "Why did vehicle 1 stop?",
        "Did vehicle 2 have anything to do with it?",
        "vehicle:1",
        ("stop",),
        "vehicle:2",
    ),
]


def after(before: str | None, text: str) -> Query:
    """The query that a text means after an earlier one, if any."""
    return query(text, *([] if before is None else [before]))


@pytest.mark.parametrize(("before", "text", "actor", "factual", "cause"), LAID)
def test_what_a_vehicle_had_to_do_with_it(
    before: str, text: str, actor: str, factual: tuple[str, ...], cause: str | None
) -> None:
    found = after(before, text)
    assert (found.type, found.actor, found.factual) == ("why", actor, factual)
    assert found.hypothesised_cause == cause


@pytest.mark.parametrize("spoken_of", ["Why did vehicle 1 slow down?", "Where is vehicle 1 going?"])
@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("Why did it stop?", "why"),
        ("Why didn't it stop?", "why_not"),
        ("What if it stops?", "what_if"),
    ],
)
def test_it_is_the_vehicle_that_was_spoken_of(spoken_of: str, text: str, kind: str) -> None:
    found = after(spoken_of, text)
    assert (found.type, found.actor) == (kind, "vehicle:1")
    assert "stop" in (found.factual or ()) + (found.counterfactual or ())


@pytest.mark.parametrize(
    ("text", "kind", "actor", "factual"),
    [
        ("What happened at 0:05?", "what", "ego", None),
        ("What did you do between 0:02 and 0:08?", "what", "ego", None),
        ("What was vehicle 1 doing at 0:05?", "what", "vehicle:1", None),
        ("Why did you brake at 0:05?", "why", "ego", ("stop",)),
        ("Why did vehicle 1 stop at 0:12", "why", "vehicle:1", ("stop",)),
    ],
)
@pytest.mark.parametrize("before", [None, "Why did vehicle 2 turn left?"])
def test_a_time_of_the_ride_is_no_vehicle(
    before: str | None, text: str, kind: str, actor: str, factual: tuple[str, ...] | None
) -> None:
    found = after(before, text)
    assert (found.type, found.actor, found.factual) == (kind, actor, factual)
    assert found.tense == "past"
    assert found.time is not None
