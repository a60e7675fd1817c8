"""What is understood of the texts of a corpus, told in the notation of readings."""

import json
from pathlib import Path

import pytest

from xavi_dialogue.nlu.notation import acts_line
from xavi_dialogue.nlu.parse import Parser

FILES = sorted(Path(__file__).with_name("corpus").glob("*.jsonl"))
PARSER = Parser()


def lines(file: Path) -> list[dict[str, str]]:
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines() if line]


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_each_text_of_the_corpus_is_read_as_it_is_noted(file: Path) -> None:
    differing = [
        (line["text"], line["reading"], found)
        for line in lines(file)
        if (found := acts_line(PARSER.read(line["text"])[0].acts)) != line["reading"]
    ]
    assert differing == []


def test_no_text_is_noted_with_two_readings() -> None:
    readings: dict[str, str] = {}
    for line in (line for file in FILES for line in lines(file)):
        assert readings.setdefault(line["text"], line["reading"]) == line["reading"], line["text"]
