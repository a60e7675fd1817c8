"""The annotated questions: floors at what the parser reaches."""

import pytest

from tests.language.annotated import BLIND, LEARN, figures, lines, names

# Files that were scored before the parser saw them; the first score stands in docs/language.md.
FLOORS = {  # file: (exact, false_confident)
    "learn/dev.jsonl": (99.0, 0.0),
}


@pytest.mark.parametrize("name", names(LEARN) + names(BLIND))
def test_agreement_does_not_fall(name: str) -> None:
    reached = figures(name)
    exact, false_confident = FLOORS.get(name, (85.0, 5.0))
    assert reached["exact"] >= exact
    assert reached["false_confident"] <= false_confident


def test_every_question_names_its_source_and_has_a_name_of_its_own() -> None:
    known: set[str] = set()
    for name in names(LEARN) + names(BLIND):
        found = [line["id"] for line in lines(name)]
        assert all(line["source"] for line in lines(name))
        assert len(set(found)) == len(found)
        assert known.isdisjoint(found)
        known.update(found)


def test_no_blind_question_is_learnt_from() -> None:
    learnt = {line["text"].casefold() for name in names(LEARN) for line in lines(name)}
    blind = [line for name in names(BLIND) for line in lines(name) if not line.get("context")]
    assert sum(line["text"].casefold() in learnt for line in blind) <= 0.02 * len(blind)
