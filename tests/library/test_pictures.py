"""What notebooks show: maps, curves and tables."""

import builtins
import dataclasses
import re
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest

import xavi_dialogue as xavi
from xavi_dialogue.library import tables
from xavi_dialogue.library.pictures import View, drawn

S1 = Path(__file__).parents[2] / "transcripts" / "rides" / "s1-0.ride.jsonl.gz"
WHY = "Why did you change left?"
SVG = "{http://www.w3.org/2000/svg}"


@cache
def s1() -> xavi.Ride:
    return xavi.open(S1)


def elements(picture: xavi.Picture, name: str) -> list[ET.Element]:
    return list(ET.fromstring(picture.svg).iter(f"{SVG}{name}"))


def titles(picture: xavi.Picture) -> list[str]:
    return [one.text or "" for one in elements(picture, "title")]


def test_a_map_shows_roads_and_everybody_in_the_scene() -> None:
    scene = next(one for one in s1().scenes if one.time == 8.0)
    picture = s1().map(8.0)
    assert len(elements(picture, "rect")) == len(scene.vehicles)
    assert [one.text for one in elements(picture, "text")] == ["us", "1", "2"][
        : len(scene.vehicles)
    ]
    network = s1().network
    assert network is not None
    assert len(elements(picture, "polyline")) > len(network.lanes)
    assert picture.caption.startswith("At 8.0 s; turquoise: the plan")


def test_the_map_of_an_answer_has_the_ghost_and_a_refusal_has_none() -> None:
    found = s1().ask(WHY)
    assert found.map is not None
    assert "what would have been driven otherwise" in found.map.caption
    dashed = [
        one for one in elements(found.map, "polyline") if one.get("stroke-dasharray") == "2 1.4"
    ]
    assert len(dashed) == 1
    assert found.ghost is not None
    assert len((dashed[0].get("points") or "").split()) == len(found.ghost.points)
    assert "<svg" in found._repr_html_()
    refusal = s1().ask("Why did you stop?")
    assert "<svg" not in refusal._repr_html_()


def test_beliefs_on_a_map_are_fainter_the_less_likely() -> None:
    picture = s1().decisions[3].map
    lines = [one for one in elements(picture, "polyline") if one.get("stroke-opacity")]
    by_title = {one[0].text: float(one.get("stroke-opacity") or 0) for one in lines}
    assert by_title["vehicle 1: the road to the right, 98%"] > 0.8
    assert min(by_title.values()) < 0.3


def test_what_is_recorded_is_escaped() -> None:
    decision = s1().decisions[3]
    evil = "<script>alert(1)</script>"
    car = dataclasses.replace(decision.trace.scene[1], kind=evil)
    scene = xavi.Scene(3.0, {**decision.trace.scene, 1: car})
    picture = drawn(View(scene))
    assert "<script" not in picture.svg
    assert any(evil in title for title in titles(picture))
    html = dataclasses.replace(picture, caption=evil)._repr_html_()
    assert "<script" not in html


def test_a_picture_is_saved(tmp_path: Path) -> None:
    picture = s1().map(8.0)
    saved = picture.save(tmp_path / "map.svg")
    assert saved.read_text(encoding="utf-8") == picture.svg
    with pytest.raises(xavi.XaviError, match="cannot write"):
        picture.save(tmp_path / "nowhere" / "map.svg")


def test_curves_hold_every_belief_of_every_decision() -> None:
    curves = s1().curves(1)
    assert curves.probabilities.shape == (len(curves.times), len(curves.goals))
    assert np.allclose(curves.probabilities.sum(axis=1), 1.0, atol=1e-3)
    at = list(curves.times).index(3.0)
    best = s1().decisions[3].beliefs[0]
    assert curves.probabilities[at, curves.goals.index(best.place)] == best.probability
    lines = elements(curves.picture, "polyline")
    assert len(lines) == 3 + len(curves.goals)  # three marks of the scale
    assert set(curves.goals) <= {one.text for one in elements(curves.picture, "text")}
    assert curves._repr_html_() == curves.picture._repr_html_()


def test_curves_of_nobody() -> None:
    with pytest.raises(xavi.XaviError, match=r"of vehicle 77; there are \[1, 2"):
        s1().curves(77)


def test_a_ride_shows_when_its_plan_changed() -> None:
    rows = re.findall(r"<tr><td>([\d.]+)</td><td>([^<]*)</td></tr>", s1()._repr_html_())
    assert rows[:2] == [("0", "continue"), ("3", "change-left, continue")]


@pytest.mark.parametrize("name", ["decisions", "options", "beliefs", "events"])
def test_tables_hold_what_the_values_hold(name: Any) -> None:
    ride = s1()
    table = ride.table(name)
    expected = {
        "decisions": len(ride.decisions),
        "options": sum(len(one.options) for one in ride.decisions),
        "beliefs": sum(len(one.beliefs) for one in ride.decisions),
        "events": len(ride.events),
    }
    assert len(table) == expected[name]
    assert table["time"].is_monotonic_increasing


def test_columns_of_tables() -> None:
    options = s1().table("options")
    chosen = options[options.chosen]
    assert list(chosen.action) == [one.plan[0] for one in s1().decisions if one.options]
    decisions = s1().table("decisions").set_index("decision")
    assert decisions.loc[3, "trace_id"] == s1().decisions[3].trace_id
    here = s1().decisions[3].options
    assert decisions.loc[3, "margin"] == pytest.approx(here[0].value - here[1].value)


def test_a_table_that_there_is_not() -> None:
    with pytest.raises(xavi.XaviError, match="no table 'wheels'; use one of"):
        s1().table("wheels")  # type: ignore[arg-type]


def test_without_pandas_it_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    load = builtins.__import__

    def refuse(name: str, *rest: Any) -> Any:
        if name == "pandas":
            raise ImportError(name)
        return load(name, *rest)

    monkeypatch.setattr(builtins, "__import__", refuse)
    with pytest.raises(xavi.XaviError, match="xavi-dialogue\\[tables\\]"):
        s1().table("events")
    assert tables.MISSING
