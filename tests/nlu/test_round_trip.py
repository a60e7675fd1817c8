"""Readings are plain data: what is stored or sent reads back the same."""

from pathlib import Path

import msgspec
import pytest

from benchmarks.language.questions import read
from xavi_dialogue.domain.meaning import Reading
from xavi_dialogue.nlu.parse import Parser
from xavi_dialogue.nlu.projection import QueryFields, project

FILES = sorted((Path(__file__).parent / "questions").rglob("*.jsonl"))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_readings_and_fields_read_back_the_same(file: Path) -> None:
    parser = Parser()
    for question in read(file):
        readings = parser.read(question.text)
        for one in readings:
            stored = msgspec.json.encode(one)
            assert msgspec.json.decode(stored, type=Reading) == one, question.text
        fields = project(readings[0].acts)
        stored = msgspec.json.encode(fields)
        assert msgspec.json.decode(stored, type=QueryFields) == fields, question.text
