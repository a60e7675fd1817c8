"""Route files: who departs, when and where."""

import gzip
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from sim.setup.routes import (
    RoutesError,
    coloured_types,
    departures,
    mentioned_edges,
    parse,
    seconds,
)

MIXED = ET.fromstring("""<routes>
  <vType id="cab" color="yellow"/>
  <route id="r" edges="a b"/>
  <vehicle id="v" route="r" depart="0.00" departPos="7"/>
  <trip id="t" from="a" via="b c" to="d" depart="4" color="red" type="cab"/>
  <flow id="f" from="e" to="a" period="5"/>
</routes>""")


def test_departures_of_vehicles_and_trips() -> None:
    vehicle, trip = departures(MIXED)
    assert (vehicle.id, vehicle.at_start, vehicle.edges) == ("v", True, ("a", "b"))
    assert (vehicle.position, vehicle.coloured) == (7.0, False)
    assert (trip.id, trip.at_start, trip.edges) == ("t", False, ("a", "b", "c", "d"))
    assert (trip.position, trip.coloured) == (None, True)
    assert coloured_types(MIXED) == {"cab"}


def test_edges_and_who_names_them_first() -> None:
    assert mentioned_edges(MIXED) == {"a": "r", "b": "r", "c": "t", "d": "t", "e": "f"}


@pytest.mark.parametrize(
    ("text", "time"),
    [("4", 4.0), ("0:00:00", 0.0), ("15:01:02", 54062.0), ("1:00:00:00", 86400.0)],
)
def test_times_may_be_written_as_clocks_do(text: str, time: float) -> None:
    assert seconds(text) == time


@pytest.mark.parametrize("text", [None, "", "triggered", "1:2", "a:0:0"])
def test_what_is_no_time(text: str | None) -> None:
    assert seconds(text) is None


def test_a_gzipped_route_file(tmp_path: Path) -> None:
    path = tmp_path / "a.rou.xml.gz"
    path.write_bytes(gzip.compress(ET.tostring(MIXED), mtime=0))
    assert departures(parse(path)) == departures(MIXED)
    path.write_bytes(path.read_bytes()[:30])
    with pytest.raises(RoutesError, match="damaged gzip"):
        parse(path)
