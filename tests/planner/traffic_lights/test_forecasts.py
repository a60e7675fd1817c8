"""Forecasts of traffic lights whose cycle was not seen yet."""

import pytest

from planner.record.light_record import GREENS, LightPrediction, Showing
from planner.traffic_lights.cycles import foresee
from planner.traffic_lights.observations import Watched, phases
from tests.planner.crossroads import EAST_WEST, NORTH_SOUTH, crossroads, place, watched
from tests.planner.nets import shipped

ALL_RED = "r" * 12
AMBERS = NORTH_SOUTH.replace("G", "y").replace("g", "y")
EAST = place("east", "straight")


def greens(known: LightPrediction, at: int, time: float) -> list[float]:
    """Return in how many seconds a place turns green, by course."""
    return [
        next(x.time for x in course.showings if x.states[at] in GREENS) - time
        for course in known.courses
    ]


@pytest.mark.parametrize("time", [22.0, 24.2])
def test_how_long_all_are_red_is_not_known(time: float) -> None:
    changes = [(0.0, NORTH_SOUTH), (21.0, AMBERS), (24.0, ALL_RED)]
    seen = watched(*(change for change in changes if change[0] <= time))
    left = greens(foresee(crossroads(), seen, time, 60.0, closely=True), EAST, time)
    assert max(left) - min(left) > 1.0
    assert max(left) < 8.0


def test_places_that_come_into_view_are_no_change() -> None:
    """The first sight shows the side that is held; what the others show comes into view later."""
    hidden = "???rrr???rrr"
    seen = [(4.0, hidden), (5.0, NORTH_SOUTH), (21.0, AMBERS), (24.0, ALL_RED)]
    told = phases(tuple(Showing(time, states) for time, states in seen))
    assert [x.time for x in told] == [4.0, 21.0, 24.0]
    assert told[0].states == NORTH_SOUTH
    left = greens(foresee(crossroads(), watched(*seen), 24.5, 60.0, closely=True), EAST, 24.5)
    assert max(left) < 4.0  # they were seen to end, so nobody out of view has green


def test_a_place_out_of_view_shows_what_it_did() -> None:
    told = phases((Showing(0.0, "Gr"), Showing(4.0, "?r"), Showing(9.0, "?G")))
    assert [(x.time, x.states) for x in told] == [(0.0, "Gr"), (9.0, "?G")]


def test_a_green_that_goes_on_when_another_ends_has_lasted_since_its_own_begin() -> None:
    """South ends 20 s into a green, north goes on: it ends sooner than a green that begins now."""
    south = AMBERS[:3] + "rrr" + NORTH_SOUTH[6:]
    early = watched((0.0, EAST_WEST), (5.0, NORTH_SOUTH), (25.0, south))
    late = watched((0.0, EAST_WEST), (5.0, ALL_RED), (25.0, south))
    soon, later = (
        greens(foresee(crossroads(), seen, 26.0, 90.0, closely=False), EAST, 26.0)[0]
        for seen in (early, late)
    )
    assert soon != later


def test_people_whose_green_goes_on_do_not_hold_up_the_next_cars() -> None:
    """The crossings that share the green of the cars keep it while these are amber and red."""
    states = [2 * (cars + "rrrrr") + "rGrG" for cars in ("ggGgg", "yyyyy", "rrrrr")]
    times = (0.0, 16.0, 19.0)
    seen = Watched("J", tuple(range(24)), tuple(map(Showing, times, states)))
    left = greens(foresee(shipped("junction"), seen, 20.0, 60.0, closely=True), 7, 20.0)
    assert max(left) < 6.0


def test_people_who_go_by_themselves_hold_up_the_cars() -> None:
    red, people = "r" * 24, "r" * 20 + "GGGG"
    cars = "ggGggrrrrrggGggrrrrrrrrr"
    changes = ((0.0, cars), (16.0, cars.replace("g", "y").replace("G", "y")), (19.0, red))
    seen = tuple(Showing(*x) for x in (*changes, (21.0, people)))
    known = foresee(
        shipped("junction"), Watched("J", tuple(range(24)), seen), 22.0, 90.0, closely=True
    )
    assert min(greens(known, 7, 22.0)) > 6.0


def test_of_arms_held_equally_long_any_may_be_next() -> None:
    """All are red at first sight: north and south may be next, or east and west."""
    seen = watched((0.0, ALL_RED))
    known = foresee(crossroads(), seen, 3.0, 120.0, closely=True)
    first = {
        next(x.states for x in course.showings if any(c in GREENS for c in x.states))
        for course in known.courses
    }
    assert first == {NORTH_SOUTH, EAST_WEST}


def test_an_arm_may_go_out_of_turn() -> None:
    """South has just ended, north is held longest, east and west less long: they may be next."""
    south = NORTH_SOUTH[:3] + "r" * 9
    ending = [(20.0, EAST_WEST.replace("G", "y").replace("g", "y")), (23.0, ALL_RED)]
    over = [(25.0, south), (45.0, south.replace("G", "y").replace("g", "y")), (48.0, ALL_RED)]
    seen = watched((0.0, EAST_WEST), *ending, *over)
    known = foresee(crossroads(), seen, 48.5, 60.0, closely=True)
    soon = [course.showings[1].states for course in known.courses]
    north = place("north", "straight")
    assert [states[north] in GREENS for states in soon] == [True, True, False]
    assert soon[2] == EAST_WEST


def test_all_red_after_another_green_is_no_repetition() -> None:
    """All were red before north and south went; after them, east and west come."""
    ending = [(20.0, EAST_WEST.replace("G", "y").replace("g", "y")), (23.0, ALL_RED)]
    seen = watched((0.0, EAST_WEST), *ending, (25.0, NORTH_SOUTH), (45.0, AMBERS), (48.0, ALL_RED))
    left = greens(foresee(crossroads(), seen, 48.5, 60.0, closely=True), EAST, 48.5)
    assert max(left) < 4.0
