"""What is understood of texts as people type and say them."""

import tomllib
from pathlib import Path

import pytest

from xavi_dialogue.nlu.notation import acts_line
from xavi_dialogue.nlu.parse import Parser

TABLE = Path(__file__).with_name("readings.toml")
CASES = tomllib.loads(TABLE.read_text(encoding="utf-8"))["readings"]
PARSER = Parser()


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["text"])
def test_the_likeliest_reading_is_what_is_meant(case: dict[str, str]) -> None:
    best = PARSER.read(case["text"])[0]
    assert acts_line(best.acts) == case["acts"]
    assert " ".join(best.unknown) == case.get("unknown", "")


def test_the_table_is_broad_and_names_no_text_twice() -> None:
    texts = [case["text"] for case in CASES]
    assert len(texts) > 150
    assert len(set(texts)) == len(texts)


def test_readings_come_best_first_and_are_few() -> None:
    for case in CASES:
        costs = [reading.cost for reading in PARSER.read(case["text"])]
        assert costs == sorted(costs)
        assert 1 <= len(costs) <= 6
