"""What is understood of texts as people type and say them."""

import tomllib
from pathlib import Path

import pytest

from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Described, Measured
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


@pytest.mark.parametrize("text", ["is something holding us up ahead", "what holds us here"])
def test_who_holds_us_up_may_only_delay_us(text: str) -> None:
    """Who drives slowly ahead of us holds us up, and does not block our way."""
    best, other = PARSER.read(text)[:2]
    assert other.cost == best.cost
    measures = [first(reading.acts, Measured) for reading in (best, other)]
    assert "delay" in [measure.attribute for measure in measures if measure is not None]


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("What's your time gap to the lead vehicle?", "vehicle"),
        ("How fast is the lead car?", "car"),
        ("How far away is the lead car?", "car"),
        ("Why is the lead truck braking?", "truck"),
    ],
)
def test_the_lead_vehicle_is_ahead(text: str, kind: str) -> None:
    named = first(PARSER.read(text)[0].acts, Described)
    assert named == Described(kind, bearing="ahead")


@pytest.mark.parametrize("text", ["What's our lead over the red car?", "How big is our lead?"])
def test_a_lead_alone_is_a_distance(text: str) -> None:
    of = first(PARSER.read(text)[0].acts, Measured)
    assert of is not None
    assert of.attribute == "distance"
