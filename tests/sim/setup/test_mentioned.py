"""Vehicles that files mention, by their ids."""

import gzip
from pathlib import Path

import pytest

from sim.setup.mentioned import mentioned

ROUTES = """<routes>
    <vehicle id="a&amp;b" depart="0"/><trip id='late' depart="5"/>
    <flow id="stream" begin="0"/><person id="ann" depart="0"/>
</routes>"""


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("a&b", True),
        ("late", True),
        ("stream.12", True),
        ("ann_0", True),
        ("lat", False),
        ("later", False),
        ("river.1", False),
        ("stream.x", False),
    ],
)
@pytest.mark.parametrize("packed", [False, True])
def test_an_id_that_is_stated_or_made_of_one(
    tmp_path: Path, name: str, told: bool, packed: bool
) -> None:
    file = tmp_path / ("a.rou.xml.gz" if packed else "a.rou.xml")
    file.write_bytes(gzip.compress(ROUTES.encode(), mtime=0) if packed else ROUTES.encode())
    assert mentioned(name, [file]) == told


def test_what_cannot_be_known_is_let_pass(tmp_path: Path) -> None:
    file = tmp_path / "a.rou.xml"
    assert mentioned("late", [file])
    file.write_text('<routes><include href="b.rou.xml"/></routes>')
    assert mentioned("late", [file])
