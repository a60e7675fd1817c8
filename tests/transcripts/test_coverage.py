"""What the golden conversations exercise: counted by what was understood and said, no more."""

from pathlib import Path

import pytest
from typer.testing import CliRunner

from tests.traces import s1_ride
from xavi_dialogue.__main__ import app
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import RecordedRide
from xavi_dialogue.transcripts.coverage import Coverage, Item, _alternatives, measure
from xavi_dialogue.transcripts.replay import RIDES, transcripts_in

HEADER = "scenario: s1\nseed: 0\n\n! planner fails\n\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a ride, still without a transcript."""
    ride = s1_ride()
    recorded = RecordedRide("s1", 0, 7.0, list(ride.traces), list(ride.events), 9.0)
    (tmp_path / RIDES).mkdir()
    (tmp_path / RIDES / "s1-0.ride.jsonl.gz").write_bytes(ride_file.dump(recorded))
    return tmp_path


def covered(folder: Path, *questions: str) -> Coverage:
    text = HEADER + "".join(f"> {question}\n\n" for question in questions)
    (folder / "one.txt").write_text(text, encoding="utf-8")
    return measure(transcripts_in(folder))


def of(coverage: Coverage, group: str) -> dict[str, int]:
    return {i.name: n for i, n in coverage.counts.items() if i.group == group and n}


def test_types_and_reasons_are_those_of_the_turns(folder: Path) -> None:
    found = covered(folder, "Hello!", "How fast are we going?", "asdf qwer", "Hello!")
    assert of(found, "reasons") == {"not-understood": 1}
    assert of(found, "types of acts") == {"Social": 2, "Ask": 1}
    assert of(found, "questions") == {"HowMuch": 1}
    assert of(found, "answers") == {"Sociable": 2, "Measures": 1}
    assert of(found, "refusals") == {"NotUnderstood": 1}


def test_alternatives_are_named_with_their_place(folder: Path, root: Path) -> None:
    found = of(covered(folder, "Hello!"), "alternatives of answer_talk.rules")
    [name] = found
    place, rule, text = name.split(": ", 2)
    assert rule.startswith("SOCIAL ")
    path, line = place.split(":")
    assert text in (root / path).read_text(encoding="utf-8").splitlines()[int(line) - 1]


def test_every_alternative_has_its_line(root: Path) -> None:
    coverage = Coverage(dict.fromkeys(_alternatives().values(), 0))
    for item in coverage.unseen:
        place, _, text = item.name.split(": ", 2)
        path, line = place.split(":")
        assert text in (root / path).read_text(encoding="utf-8").splitlines()[int(line) - 1]


def test_rules_of_questions_are_those_of_the_chosen_reading(folder: Path) -> None:
    found = of(covered(folder, "How fast are we going?"), "rules of nlu_clauses.lark")
    names = {name.rpartition(" ")[2] for name in found}
    assert names & {"ask_inverted", "ask_measure"}
    assert not names & {"supposed", "imperative", "talk"}


def test_rules_that_are_named_by_what_they_make_count(folder: Path) -> None:
    found = of(covered(folder, "What is it?"), "rules of nlu_phrases.lark")
    assert any(name.endswith(": wh_what") for name in found)


def test_a_rule_counts_with_any_of_its_alternatives(folder: Path) -> None:
    coverage = covered(folder, "Hello!", "Thanks!")
    rules = of(coverage, "rules of answer_talk.rules")
    assert [name.split(": ")[1] for name in rules] == ["SOCIAL"]
    assert sum(rules.values()) == 2


def test_the_table_says_what_is_missing_and_then_what_is_merely_unseen() -> None:
    one, other = Item("reasons", "busy"), Item("reasons", "ambiguous")
    fine = Item("alternatives", "ASK 2", fine=True)
    table = Coverage({fine: 0, one: 0, other: 3}).table()
    assert "1 of    2" in table
    assert table.endswith("not exercised:\n  reasons: busy\n\nnot seen:\n  alternatives: ASK 2")
    assert Coverage({fine: 0, other: 3}).missing == ()


def test_the_command_fails_while_something_is_missing(folder: Path) -> None:
    covered(folder, "Hello!")
    done = CliRunner().invoke(app, ["transcripts", "--coverage", "--folder", str(folder)])
    assert done.exit_code == 1
    assert "  reasons: busy\n" in done.output
    assert "reasons: smalltalk" not in done.output
