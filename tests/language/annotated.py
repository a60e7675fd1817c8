"""Annotated questions, and how well the parser agrees with them."""

import json
from functools import cache
from pathlib import Path
from typing import Any

import msgspec

from xavi_dialogue.app.bench.questions import read
from xavi_dialogue.app.bench.scoring import agreement, verdict
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.parse import NotUnderstood, Parser, as_query

HERE = Path(__file__).parent / "questions"
LEARN = "learn"  # what the judge is learnt from
BLIND = "blind"  # scored once before anything was changed for it, and never learnt from


def names(folder: str) -> list[str]:
    """The files of a folder, such as "learn/dev.jsonl"."""
    return sorted(f"{folder}/{file.name}" for file in (HERE / folder).glob("*.jsonl"))


@cache
def parser() -> Parser:
    return Parser()


def parse(text: str, *context: str) -> Query | NotUnderstood:
    return parser().parse(text, context=context)


def query(text: str, *context: str) -> Query:
    result = parse(text, *context)
    assert isinstance(result, Query), f"{text!r}: {result}"
    return result


def lines(name: str) -> list[dict[str, Any]]:
    text = (HERE / name).read_text(encoding="utf-8")
    return [json.loads(line) for line in text.splitlines()]


def figures(name: str) -> dict[str, float]:
    """The shares of the verdicts on all questions of a file [percent]."""
    verdicts = [verdict(q, as_query(parse(q.text, *q.context))) for q in read(HERE / name)]
    found = msgspec.structs.asdict(agreement(name, verdicts))
    return {key: value for key, value in found.items() if isinstance(value, float)}
