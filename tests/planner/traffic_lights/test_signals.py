"""Lights: who stops, who goes, and how lights are expected to go on."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.kernels.limits import (
    AMBER,
    BEYOND,
    EMERGENCY,
    FOLLOWING,
    HALT,
    OPEN,
    RIGHT_OF_WAY,
    SHUT,
)
from planner.manoeuvres.layout import BEFORE_LINE
from planner.motion.forward import DT, Drive, Motion, drive
from planner.motion.obstacles import Obstacle, Traffic
from planner.record.light_record import Showing
from planner.record.trace import Action, EgoGoal
from planner.rollouts.rollout import Task, summarise, take
from planner.traffic_lights.cycles import foresee, supposed
from planner.traffic_lights.greens import LONG, SHORT, residual
from planner.traffic_lights.observations import Watched
from planner.traffic_lights.signals import Lights, Outlook
from sim.roads.network import Direction
from sim.scene import Signal
from tests.planner.crossroads import (
    CONTROLLER,
    EAST_WEST,
    NORTH_SOUTH,
    before,
    crossroads,
    driving,
    place,
    plan,
    shown,
    watched,
)
from tests.planner.nets import shipped
from tests.planner.zebra import zebra

SIZE = (4.8, 1.8)
HORIZON = 150
ALL_RED = "r" * 12
AMBERS = NORTH_SOUTH.replace("G", "y").replace("g", "y")
ACTIONS: dict[Direction, Action] = {
    "right": "exit-right",
    "straight": "continue",
    "left": "exit-left",
}


def go(
    lights: Lights,
    turn: Direction = "straight",
    away: float = 60.0,
    speed: float = 10.0,
    others: tuple[Obstacle, ...] = (),
) -> tuple[Drive, float]:
    """Drive from the south under lights; the arc [m] of the line too."""
    task = plan(before(away, speed), ACTIONS[turn])
    found = drive(task, Motion(0.0, speed, 0.0), 0, Traffic.of(others, lights), SIZE, HORIZON)
    return found, task.obey_lights[0].stop + BEFORE_LINE


def crossed(found: Drive, line: float) -> int | None:
    """The step in which the front passes the line."""
    over = np.flatnonzero(found.motion[:, 0] > line)
    return int(over[0]) - 1 if len(over) else None


def test_red_is_stopped_at_before_the_line_and_left_at_green() -> None:
    found, line = go(shown([(0.0, EAST_WEST), (15.0, NORTH_SOUTH)]))
    step = crossed(found, line)
    assert step is not None
    assert 15.0 <= step * DT <= 18.0
    standing = found.motion[found.motion[:, 1] < 0.05]
    assert np.all(line - standing[:, 0] > 0.0)
    assert np.all(line - standing[:, 0] < 3.0)


def test_who_stops_at_red_is_held_up_by_that_light() -> None:
    found, _ = go(shown([(0.0, EAST_WEST), (15.0, NORTH_SOUTH)]))
    assert len(found.hindrances.step) == 0
    assert set(found.stops.which.tolist()) == {0}
    assert found.stops.signals == (Signal(CONTROLLER, place("south", "straight")),)
    assert 14.0 <= found.stops.step[-1] * DT <= 16.5


def test_a_queue_at_red_is_held_up_by_the_light_and_by_who_stands_ahead() -> None:
    ahead = driving("south", "straight", [140.0] * HORIZON)
    found, _ = go(shown([(0.0, EAST_WEST)]), others=(ahead,))
    assert set(found.hindrances.vehicle.tolist()) == {1}
    assert len(found.stops.step) > 0


def test_a_leader_on_the_move_is_no_light() -> None:
    ahead = driving("south", "straight", [110.0 + 1.0 * k for k in range(HORIZON)])
    found, _ = go(shown([(0.0, NORTH_SOUTH)]), others=(ahead,))
    assert len(found.hindrances.step) > 0
    assert len(found.stops.step) == 0


def test_green_is_driven_through_at_speed() -> None:
    found, line = go(shown([(0.0, NORTH_SOUTH)]), speed=13.0)
    step = crossed(found, line)
    assert step is not None
    assert float(np.min(found.motion[:, 1])) > 12.0


@settings(deadline=None)
@given(
    st.floats(5.0, 95.0),
    st.floats(0.0, 13.8),
    st.integers(0, 40),
    st.sampled_from(["right", "straight", "left"]),
)
def test_no_line_is_crossed_while_closed_unless_amber_came_too_late(
    away: float, speed: float, change: int, turn: Direction
) -> None:
    """Whatever the distance, the speed and the moment of the change, with amber of 3 s."""
    begin = change * DT
    lights = shown([(0.0, NORTH_SOUTH), (begin, AMBERS), (begin + 3.0, EAST_WEST)])
    found, line = go(lights, turn, away, speed)
    step = crossed(found, line)
    if step is None or step < change:
        return
    arc, pace, _ = found.motion[min(change, len(found.motion) - 1)].tolist()
    assert step * DT < begin + 3.0, "it passed at red"
    assert pace**2 > 2.0 * FOLLOWING * (line - arc) * 0.98, "it could have stopped"


@settings(deadline=None)
@given(st.floats(1.0, 95.0), st.floats(0.0, 13.8))
def test_red_is_passed_only_by_who_cannot_stop(away: float, speed: float) -> None:
    found, line = go(shown([(0.0, EAST_WEST)]), "straight", away, speed)
    if crossed(found, line) is not None:
        reach = speed**2 / (2.0 * EMERGENCY)
        assert line < reach + 0.35 * speed + BEYOND


def test_a_turn_on_red_is_made_after_a_full_stop() -> None:
    found, line = go(shown([(0.0, "s" + EAST_WEST[1:])]), "right")
    step = crossed(found, line)
    assert step is not None
    near = (found.motion[:, 0] > line - 3.0) & (found.motion[:, 0] <= line)
    assert float(np.min(found.motion[near, 1])) < 0.25


def test_a_turn_on_red_gives_way() -> None:
    """Who has green from the west passes first."""
    lights = shown([(0.0, "s" + EAST_WEST[1:])])
    coming = driving("west", "straight", [60.0 + 2.2 * k for k in range(HORIZON)])
    alone, line = go(lights, "right", away=20.0, speed=5.0)
    among, _ = go(lights, "right", away=20.0, speed=5.0, others=(coming,))
    first, second = crossed(alone, line), crossed(among, line)
    assert first is not None
    assert second is not None
    assert second >= first


ONCOMING = [110.0 + 2.4 * k for k in range(HORIZON)]  # [m] at 12 m/s, 40 m before the line


def test_a_permissive_left_turn_gives_way_and_a_protected_one_does_not() -> None:
    coming = driving("north", "straight", ONCOMING)
    late = {}
    for letter in "gG":
        states = NORTH_SOUTH[:2] + letter + NORTH_SOUTH[3:]
        found, _ = go(shown([(0.0, states)]), "left", away=25.0, speed=7.0, others=(coming,))
        late[letter] = int(np.sum(found.hindrances.how == RIGHT_OF_WAY))
    assert late["g"] > 3
    assert late["G"] == 0


def test_nobody_waits_for_who_stands_at_red() -> None:
    """A left turn at a green of its own, with a car standing at red on the other side."""
    standing = driving("north", "straight", [149.0] * HORIZON)
    for letter in "gG":
        states = "rr" + letter + "rrr" * 3
        found, line = go(shown([(0.0, states)]), "left", away=25.0, speed=7.0, others=(standing,))
        assert len(found.hindrances.step) == 0
        assert crossed(found, line) is not None


def test_who_is_still_inside_at_green_is_let_out() -> None:
    """A car from the east that stands in the middle of the junction for 4 s."""
    arcs = [160.0] * 20 + [160.0 + 1.0 * k for k in range(HORIZON - 20)]
    crossing = driving("east", "straight", arcs)
    found, _ = go(shown([(0.0, NORTH_SOUTH)]), away=15.0, speed=0.0, others=(crossing,))
    assert set(found.hindrances.vehicle.tolist()) == {1}


def test_signs_hold_where_lights_are_out_of_order() -> None:
    coming = driving("north", "straight", ONCOMING)
    for letter in "oO?":
        lights = shown([(0.0, letter * 12)])
        found, line = go(lights, "left", away=25.0, speed=7.0, others=(coming,))
        assert len(found.hindrances.step) > 3
        assert crossed(found, line) is not None


@pytest.mark.parametrize(("begun", "spent"), [(True, 0.0), (True, 12.0), (False, 5.0)])
def test_what_a_green_has_left_grows_with_its_quantile(begun: bool, spent: float) -> None:
    left = [residual(q, spent, begun=begun) for q in (0.1, 0.3, 0.5, 0.7, 0.9)]
    assert all(a < b for a, b in itertools.pairwise(left))
    assert left[0] > 0.0


def test_greens_last_as_the_prior_says() -> None:
    assert residual(0.05, 0.0, begun=True) == pytest.approx(SHORT, rel=0.01)
    assert residual(0.95, 0.0, begun=True) == pytest.approx(LONG, rel=0.01)


def test_a_green_met_at_random_has_left_what_a_simulation_says() -> None:
    """Greens in a row, looked at again and again: what is left of them, and half of that."""
    rng = np.random.default_rng(0)
    sigma = math.log(LONG / SHORT) / (2.0 * 1.645)
    greens = rng.lognormal(math.log(math.sqrt(SHORT * LONG)), sigma, 200_000)
    ends = np.cumsum(greens)
    looks = rng.uniform(0.0, ends[-1] * 0.99, 100_000)
    left = ends[np.searchsorted(ends, looks)] - looks
    for quantile in (0.15, 0.5, 0.85):
        expected = float(np.quantile(left, quantile))
        assert residual(quantile, 0.0, begun=False) == pytest.approx(expected, rel=0.03)


def test_what_was_seen_of_a_cycle_comes_again() -> None:
    seen = watched(
        (0.0, ALL_RED), (5.0, NORTH_SOUTH), (25.0, AMBERS), (28.0, ALL_RED), (30.0, EAST_WEST),
        (50.0, ALL_RED), (52.0, NORTH_SOUTH),
    )  # fmt: skip
    known = foresee(crossroads(), seen, 60.0, 60.0, closely=True)
    again = known.courses[known.likeliest]
    assert again.probability > 0.5
    assert [(x.time, x.states) for x in again.showings[:5]] == [
        (60.0, NORTH_SOUTH),
        (72.0, AMBERS),
        (75.0, ALL_RED),
        (77.0, EAST_WEST),
        (97.0, ALL_RED),
    ]
    assert sum(course.probability for course in known.courses) == pytest.approx(1.0)


def test_what_takes_longer_than_before_is_not_expected_to_end_at_once() -> None:
    seen = watched(
        (0.0, ALL_RED), (5.0, NORTH_SOUTH), (25.0, AMBERS), (28.0, EAST_WEST), (50.0, NORTH_SOUTH)
    )
    known = foresee(crossroads(), seen, 80.0, 60.0, closely=True)
    assert len(known.courses) == 3


def test_those_opposite_go_together_and_the_held_come_next() -> None:
    known = foresee(crossroads(), watched((0.0, NORTH_SOUTH)), 10.0, 60.0, closely=True)
    for course in known.courses:
        states = [showing.states for showing in course.showings]
        assert states[:4] == [NORTH_SOUTH, AMBERS, ALL_RED, EAST_WEST][: len(states)]


PEOPLE = range(20, 24)  # places of the crossings at the junction
ARMS = {"north and south": 12, "west and east": 7}  # a straight way of each


def test_cars_go_after_those_that_cross_though_people_have_lights_of_their_own() -> None:
    """Crossings at a junction do not go while it is cleared, nor over a straight way that goes."""
    before = (Showing(0.0, "ggGggrrrrrggGggrrrrrrGrG"), Showing(5.0, "ggGggrrrrrggGggrrrrrrrrr"))
    seen = Watched("J", tuple(range(24)), before)
    known = foresee(shipped("junction"), seen, 12.0, 150.0, closely=True)
    for course in known.courses:
        states = [showing.states for showing in course.showings]
        first, ambers, cleared, other, *_ = states
        assert first[ARMS["north and south"]] == "G"
        assert ambers[ARMS["north and south"]] == "y"
        assert set(cleared) == {"r"}
        assert other[ARMS["west and east"]] == "G"
        assert sorted(other[k] for k in PEOPLE) == ["G", "G", "r", "r"]


def test_people_at_a_crossing_by_itself_have_their_turn() -> None:
    roads = zebra(control=Signal("J", 0), of_crossing=Signal("J", 1))
    seen = Watched("J", (0, 1), (Showing(0.0, "Gr"),))
    known = foresee(roads, seen, 5.0, 150.0, closely=False)
    (course,) = known.courses
    states = [showing.states for showing in course.showings]
    assert states[:7] == ["Gr", "yr", "rr", "rG", "ry", "rr", "Gr"]


def test_who_is_held_may_go_sooner_or_later() -> None:
    known = foresee(crossroads(), watched((0.0, NORTH_SOUTH)), 10.0, 200.0, closely=True)
    starts = [
        next(x.time for x in course.showings if x.states == EAST_WEST) for course in known.courses
    ]
    assert starts == sorted(starts)
    assert starts[-1] - starts[0] > 10.0


@given(
    st.integers(0, 3).map(lambda k: [NORTH_SOUTH, EAST_WEST, AMBERS, ALL_RED][k]),
    st.floats(0.0, 80.0),
)
def test_no_course_lets_cross_what_meets(state: str, time: float) -> None:
    """Two links that cross are green at once only where one of them gives way."""
    network = crossroads().network
    known = foresee(crossroads(), watched((0.0, state)), time, 150.0, closely=True)
    for course in known.courses:
        for showing in course.showings:
            for link in network.links:
                if showing.states[link.index] == "G":
                    crossing = [showing.states[k] for k in link.foes]
                    assert "G" not in crossing
        times = [showing.time for showing in course.showings]
        assert times == sorted(set(times))


def test_lights_that_are_off_stay_so() -> None:
    known = foresee(crossroads(), watched((0.0, "o" * 12)), 10.0, 60.0, closely=True)
    assert [course.showings for course in known.courses] == [(Showing(10.0, "o" * 12),)]


def test_a_light_supposed_green_holds_those_that_it_crosses() -> None:
    known = foresee(crossroads(), watched((0.0, EAST_WEST)), 10.0, 60.0, closely=True)
    wanted = place("south", "straight")
    (course,) = supposed(crossroads(), known, wanted, "G", 10.0).courses
    (showing,) = course.showings
    assert showing.states[wanted] == "G"
    link = next(x for x in crossroads().network.links if x.index == wanted)
    assert all(showing.states[k] != "G" for k in link.foes)


def test_the_past_of_a_light_is_sampled_with_its_future() -> None:
    known = foresee(
        crossroads(), watched((0.0, EAST_WEST), (6.0, NORTH_SOUTH)), 10.0, 60.0, closely=False
    )
    lights = Outlook(10.0, (known,)).before(50, 100)
    codes = lights.shows(Signal(CONTROLLER, place("south", "left")), 151)
    assert codes[:29].tolist() == [SHUT] * 29
    assert codes[31] == OPEN
    assert len(codes) >= 151


def test_every_letter_has_its_meaning() -> None:
    codes = {
        letter: int(shown([(0.0, letter * 12)]).shows(Signal(CONTROLLER, 0), 1)[0])
        for letter in "rugGysoO?"
    }
    assert {x for x, code in codes.items() if code == SHUT} == {"r", "u"}
    assert {x for x, code in codes.items() if code == AMBER} == {"y"}
    assert {x for x, code in codes.items() if code == HALT} == {"s"}
    assert {x for x, code in codes.items() if code <= OPEN} == set("gGoO?")


def test_waiting_at_a_light_is_no_turning() -> None:
    """A turn costs as much comfort after a long red as after a short one."""
    task = Task(crossroads(), EgoGoal("east_out", 20.0, None), SIZE, 0.0, HORIZON, 100.0)
    turned = []
    for green in (8.0, 22.0):
        lights = shown([(0.0, EAST_WEST), (green, NORTH_SOUTH)])
        here = plan(before(20.0, 6.0), "exit-right")
        leg = take(task, here, Motion(0.0, 6.0, 0.0), 0, Traffic.of((), lights))
        parts = summarise(task, (leg,))
        turned.append(parts["curvature"] * len(leg.speed))
    assert turned[1] == pytest.approx(turned[0], rel=0.05)
