from types import SimpleNamespace

import numpy as np
import pytest

from planner.kernels.projection import SIDE_MARGIN
from planner.motion.forward import DT
from planner.motion.obstacles import Obstacle
from planner.motion.tracks import PASSING, aligned, berth_of, coast, lanes_at, links_of
from planner.search.decide import observed
from tests.planner.worlds import Seen, before_end, driven, link, roads, row, situation

STEPS = 40


def coasting(name: str, seen: Seen, *, past: bool = False) -> Obstacle:
    return coast(roads(name), observed(1, seen.track, seen.state), STEPS, past=past)


def test_a_vehicle_coasts_along_its_lane() -> None:
    line = roads("s1").line(row("s1", "main_in_0", "straight"))
    start = before_end("s1", "main_in_0", 30.0)
    motion = coasting("s1", driven(line, start, [8.0] * 10))
    assert len(motion.speed) == STEPS + 1
    assert np.allclose(motion.speed, 8.0)
    for step in (0, 10, 25):
        place, heading = line.pose(start + 8.0 * DT * step)
        assert motion.position[step] == pytest.approx(place, abs=0.05)
        assert motion.heading[step] == pytest.approx(heading, abs=0.01)
    assert motion.links == {("J", link("s1", "main_in_0", "straight").index)}


def test_a_vehicle_that_speeds_up_goes_on_to_the_limit() -> None:
    line = roads("s1").line(("main_in_0",))
    speeds = [5.0 + 0.3 * k for k in range(10)]
    motion = coasting("s1", driven(line, 60.0, speeds))
    limit = roads("s1").network.lanes["main_in_0"].speed_limit
    assert np.all(np.diff(motion.speed) >= 0.0)
    assert motion.speed[-1] == pytest.approx(limit)


def test_a_vehicle_waits_at_a_line_where_it_must_give_way() -> None:
    line = roads("s2").line(("south_in_0",))
    end = before_end("s2", "south_in_0", 0.0)
    motion = coasting("s2", driven(line, end - 20.0, [7.0] * 10))
    assert motion.speed[-1] == 0.0
    assert motion.position[-1] == pytest.approx(line.pose(end - 0.5)[0], abs=0.1)


def test_a_vehicle_that_cannot_stop_any_more_coasts_over_the_line() -> None:
    line = roads("s2").line(("south_in_0",))
    end = before_end("s2", "south_in_0", 0.0)
    motion = coasting("s2", driven(line, end - 2.0, [9.0] * 10))
    assert np.allclose(motion.speed, 9.0)


def test_a_vehicle_inside_the_junction_coasts_out_of_it() -> None:
    lanes = row("s2", "south_in_0", "straight")
    line = roads("s2").line(lanes)
    motion = coasting("s2", driven(line, before_end("s2", "south_in_0", -4.0), [5.0] * 4))
    assert np.allclose(motion.speed, 5.0)


def test_with_the_past_the_track_comes_first() -> None:
    line = roads("s1").line(("main_in_0",))
    seen = driven(line, 60.0, [8.0] * 10)
    motion = coasting("s1", seen, past=True)
    assert len(motion.speed) == 10 + STEPS
    assert motion.position[:10] == pytest.approx(np.array(seen.track.position))


def test_alignment_moves_a_track_in_time() -> None:
    line = roads("s1").line(("main_in_0",))
    motion = coasting("s1", driven(line, 60.0, [8.0] * 3))
    later = aligned(motion, 5, 20)
    assert len(later.speed) == 21
    assert np.all(np.isnan(later.position[:5]))
    assert later.position[5:] == pytest.approx(motion.position[:16])
    sooner = aligned(motion, -3, 20)
    assert sooner.position == pytest.approx(motion.position[3:24])


def test_a_vehicle_at_a_line_is_still_on_its_lane() -> None:
    end = situation("s2", "south_in_0", before_end("s2", "south_in_0", 0.2))
    found = lanes_at(roads("s2"), end.position, end.heading)
    assert [location.lane for location in found] == ["south_in_0"]


def test_inside_a_junction_all_ways_that_fit_are_possible() -> None:
    here = situation("s2", link("s2", "south_in_0", "straight").via[0], 1.0)
    found = {location.lane for location in lanes_at(roads("s2"), here.position, here.heading)}
    ways = {link("s2", "south_in_0", way).via[0] for way in ("left", "straight", "right")}
    assert found == ways


def test_off_the_road_there_is_no_lane() -> None:
    assert lanes_at(roads("s2"), (500.0, 500.0), 0.0) == ()
    assert links_of(roads("s2"), ("south_in_0",)) == frozenset()


def test_a_vehicle_that_comes_just_past_its_lane_has_the_way_on_as_its_own() -> None:
    line = roads("s1").line(row("s1", "main_in_0", "straight"))
    motion = coasting("s1", driven(line, before_end("s1", "main_in_0", 62.0), [8.0] * 10))
    assert motion.links == {("J", link("s1", "main_in_0", "straight").index)}


@pytest.mark.parametrize(("kind", "own", "kept"), [
    ("bicycle", False, PASSING), ("bicycle", True, SIDE_MARGIN), ("car", False, SIDE_MARGIN),
])  # fmt: skip
def test_a_bicycle_is_passed_with_more_room_where_it_has_no_lane_of_its_own(
    kind: str, own: bool, kept: float
) -> None:
    """The lane is that on which it was seen last."""
    lanes = {"road": frozenset(("passenger", "bicycle")), "cycle": frozenset(("bicycle",))}
    seen = ["road" if own else "cycle"] * 4 + ["cycle" if own else "road"]
    network = SimpleNamespace(lanes={n: SimpleNamespace(permits=p) for n, p in lanes.items()})
    places = [SimpleNamespace(location=SimpleNamespace(lane=name)) for name in seen]
    observed = SimpleNamespace(kind=kind, situation=lambda roads, k, aside: [places[k]])
    assert berth_of(SimpleNamespace(network=network), observed) == kept  # type: ignore[arg-type]
