"""The annotated questions: floors at what the parser reaches."""

import pytest

from tests.language.questions import figures, lines

FLOORS = [  # (file, exact, false_confident)
    ("dev.jsonl", 100.0, 0.0),
    ("paraphrases.jsonl", 100.0, 0.0),
    ("paraphrases2.jsonl", 99.0, 0.0),
    ("paraphrases3.jsonl", 99.0, 0.0),
]


@pytest.mark.parametrize(("name", "exact", "false_confident"), FLOORS)
def test_agreement_does_not_fall(name: str, exact: float, false_confident: float) -> None:
    reached = figures(name)
    assert reached["exact"] >= exact
    assert reached["false_confident"] <= false_confident


@pytest.mark.parametrize("name", [name for name, _, _ in FLOORS])
def test_every_question_names_its_source(name: str) -> None:
    assert all(line["source"] for line in lines(name))
    assert len({line["id"] for line in lines(name)}) == len(lines(name))
