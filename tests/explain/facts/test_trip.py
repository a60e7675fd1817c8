"""Measures of the trip: what is left of it, what was done, and what it cost."""

from dataclasses import replace as changed

import pytest
from msgspec.structs import replace

from planner.record.events import Event
from planner.record.places import RoadFacts, RoadPlace
from planner.record.trace import EgoGoal, PlanTrace
from tests.explain.facts.scenes import Actor, kept, made, speeds, straight
from tests.traces import Actions, Aim, Chosen, End, Way, trace_of
from tests.traces import World as Plain
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.terms import Destination, Ego, Thing, Vehicle
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.explain.facts.measures.measuring import measure
from xavi_dialogue.explain.facts.measures.trip import delay, standing_within
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

US, ONE, TWO = Ego(), Vehicle(1), Vehicle(2)


OURS = Actor(straight(0.0, 0.0, 10.0))


def of(
    found: States, attribute: Attribute, thing: Thing = US, at: float = 8.0, to: Thing | None = None
) -> Measure:
    return measure(found, attribute, thing, at, to)


def roads(time: float) -> RoadFacts:
    return RoadFacts({}, (), 300.0 - 10.0 * time, 30.0 - time)


def test_where_nobody_is_in_the_way_the_rest_is_driven_freely() -> None:
    """Without a plan that is known, the free time of the road is a bound."""
    ride = made({0: OURS}, 4.0, roads=roads)
    bare = tuple(replace(t, rollouts=()) for t in ride.record.traces)
    found = States(Ride(changed(ride.record, traces=bare, now=4.6)))
    left = of(found, "time-to-go", at=4.6)
    assert (left.value, left.at_least, left.low) == (25.4, True, None)
    arrival = of(found, "arrival-time", at=4.6)
    assert (arrival.value, arrival.at_least) == (30.0, True)
    nothing = States(Ride(changed(ride.record, traces=tuple(replace(t, road=None) for t in bare))))
    assert of(nothing, "time-to-go", at=4.0).gap == "not-recorded"
    assert of(nothing, "arrival-time", at=4.0).attribute == "arrival-time"
    assert of(nothing, "arrival-time", at=4.0).gap == "not-recorded"


def test_where_no_road_leads_to_the_destination_that_is_what_is_told() -> None:
    ride = made({0: OURS}, 4.0, roads=lambda _: RoadFacts({}))
    bare = tuple(replace(t, rollouts=()) for t in ride.record.traces)
    lost = States(Ride(changed(ride.record, traces=bare)))
    for attribute in ("time-to-go", "arrival-time", "distance-to-go"):
        assert of(lost, attribute, at=4.0, to=Destination()).gap == "no-way"


CHANCES = ((10.0, 0.04), (12.0, 0.46), (20.0, 0.46), (30.0, 0.04))  # [s] to the goal


def chancy(*chances: tuple[float | None, float]) -> Plain:
    """What comes of going on, as one other vehicle has it; None: a collision."""
    aims = {
        1: tuple(
            Aim("continue", p, (Way(("continue",)),), f"{k}") for k, (_, p) in enumerate(chances)
        )
    }
    ends = {k: time for k, (time, _) in enumerate(chances)}

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        raise AssertionError

    world = Plain(aims, (("continue",),), simulate)
    return changed(world, simulate=_ends(ends))


def _ends(ends: dict[int, float | None]):  # type: ignore[no-untyped-def]
    count = iter(range(10_000))

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        time = ends[next(count) % len(ends)]
        return (End("collision", collided_with=1) if time is None else End(time=time)), 1

    return simulate


def expecting(trace: PlanTrace, now: float = 4.0, **other: object) -> States:
    return States(Ride(Record(now, (trace,), **other)))  # type: ignore[arg-type]


def test_the_time_to_go_is_what_the_plan_expects() -> None:
    """The mean is 0.4 + 5.52 + 9.2 + 1.2 s; 5 % take less than 12 s, 5 % more than 20 s."""
    found = of(expecting(trace_of(chancy(*CHANCES))), "time-to-go", at=4.0)
    assert (found.value, found.low, found.high, found.at_least) == (16.3, 12.0, 20.0, False)
    later = of(expecting(trace_of(chancy(*CHANCES)), 5.5), "time-to-go", at=5.5)
    assert (later.value, later.low, later.high) == (14.8, 10.5, 18.5)
    assert later.time == 5.5
    arrival = of(expecting(trace_of(chancy(*CHANCES)), 5.5), "arrival-time", at=5.5)
    assert (arrival.value, arrival.low, arrival.high) == (20.3, 16.0, 24.0)
    late = of(expecting(trace_of(chancy((1.0, 1.0))), 6.0), "time-to-go", at=6.0)
    assert late.value == 0.0


@pytest.mark.parametrize(("crash", "known"), [(0.4, True), (0.6, False)])
def test_a_time_that_half_of_the_drives_never_have_is_not_told(crash: float, known: bool) -> None:
    trace = trace_of(chancy((10.0, 1.0 - crash), (None, crash)))
    found = of(expecting(trace), "time-to-go", at=4.0)
    assert found.value == (10.0 if known else None)


@pytest.mark.parametrize("aim", [None, EgoGoal("on", 5.0, None)])
def test_who_is_under_way_at_the_horizon_needs_longer(aim: EgoGoal | None) -> None:
    """As at a red light: 25 s at the limits say nothing of when one arrives."""
    trace = trace_of(chancy((10.0, 0.4), (20.0, 0.6)))
    rows = tuple(
        replace(row, outcome="termination", components={**row.components, "time": None})
        if row.components["time"] == 20.0
        else row
        for row in trace.rollouts
    )
    road = RoadFacts({}, (), 120.0, 25.0)
    held = replace(trace, rollouts=rows, road=road, waypoint=aim)
    left = of(expecting(held, 5.0), "time-to-go", at=5.0)
    assert (left.value, left.low, left.high) == (trace.settings.horizon - 1.0,) * 2 + (None,)
    assert left.at_least
    arrival = of(expecting(held, 5.0), "arrival-time", at=5.0)
    assert (arrival.low, arrival.high) == (5.0 + trace.settings.horizon - 1.0, None)


def test_from_a_place_on_the_way_on_the_rest_is_driven_freely() -> None:
    """The drive imagined is 30 of 120 m long: of 40 s of free driving 30 s are left after it."""
    trace = trace_of(chancy((8.0, 1.0)))
    row = replace(trace.rollouts[0], path=((0.0, 0.0), (30.0, 0.0)))
    other = replace(row, index=1, path=None, same_as=0)
    there = replace(
        trace,
        rollouts=(row, other),
        waypoint=EgoGoal("on", 5.0, None),
        road=RoadFacts({}, (), 120.0, 40.0),
    )
    found = of(expecting(there, 5.0), "time-to-go", at=5.0)
    assert (found.value, found.at_least) == (37.0, True)
    bare = replace(there, road=None)
    assert of(expecting(bare), "time-to-go", at=4.0).gap == "not-recorded"
    unknown = replace(there, road=RoadFacts({}, (), 120.0, None))
    assert of(expecting(unknown), "time-to-go", at=4.0).gap == "not-recorded"
    pathless = replace(there, rollouts=(replace(row, path=None),))
    assert of(expecting(pathless), "time-to-go", at=4.0).value == 40.0
    near = replace(there, road=RoadFacts({}, (), 20.0, 5.0))
    assert of(expecting(near), "time-to-go", at=4.0).value == 8.0


def test_after_arriving_nothing_is_left() -> None:
    events = (Event("arrived", 5.0),)
    found = States(made({0: OURS}, 8.0, roads=roads, events=events, ended=True))
    assert of(found, "time-to-go", at=6.0).value == 0.0
    assert of(found, "distance-to-go", at=6.0).value == 0.0
    assert of(found, "distance-to-go", at=5.0).value == 0.0
    assert of(found, "distance-to-go", at=4.0).value == 260.0
    arrival = of(found, "arrival-time", at=8.0)
    assert (arrival.value, arrival.time) == (5.0, 5.0)
    broken = States(made({0: OURS}, 8.0, roads=roads, ended=True))
    assert of(broken, "time-to-go").gap == "not-applicable"


def test_what_was_driven() -> None:
    found = States(made({0: OURS, 1: Actor(straight(0.0, 5.0, 7.0), since=3.0)}, 8.0))
    assert of(found, "distance-driven", at=6.5).value == 65.0
    assert of(found, "distance-driven", ONE).value == 35.0
    clock = of(found, "time", at=3.3)
    assert (clock.value, clock.time) == (3.3, 3.3)


STOPS = ((0.0, 8.0), (2.0, 0.0), (4.0, 0.0), (5.0, 8.0), (6.0, 8.0), (8.0, 0.0), (12.0, 0.0))


def test_how_long_somebody_stood() -> None:
    """It stands from 2 to 4.2 s, as samples have it, and from 8 s on."""
    found = States(made({0: OURS, 1: Actor(speeds(0.0, 5.0, STOPS))}, 11.0))
    told = [of(found, "waiting-time", ONE, at) for at in (1.0, 3.0, 6.0, 10.0)]
    assert [m.value for m in told] == pytest.approx([0.0, 1.0, 2.2, 4.2], abs=0.21)
    assert [m.count for m in told] == [0, 1, 1, 2]
    assert of(found, "waiting-time", ONE, 10.0, TWO).value == 0.0
    assert standing_within(found, 1, 2.4, 3.4) == pytest.approx(1.0)
    assert standing_within(found, 1, 9.0, 20.0) == pytest.approx(2.2)
    assert standing_within(found, 1, 4.4, 7.6) == 0.0
    broken = States(kept(made({0: Actor(straight(0, 0, 0.0))}, 24.0), lambda t: not 3 < t < 20))
    assert standing_within(broken, 0, 0.0, 24.0) == pytest.approx(3.5 + 14.0)


def slowed(*marks: tuple[float, float], until: float, limit: float | None = None) -> States:
    place = None if limit is None else RoadPlace("a", 0, 1, limit, False, False)
    facts = RoadFacts({} if place is None else {0: place})
    return States(made({0: Actor(speeds(0.0, 0.0, marks))}, until, roads=lambda _: facts))


@pytest.mark.parametrize(
    ("marks", "limit", "lost", "going_on"),
    [
        # 5 m/s less for 4 s, and half of that on the way down and up: 25 m of 10 m/s
        (((0, 10), (4, 10), (5, 5), (9, 5), (10, 10)), None, 2.5, False),
        (((0, 10), (4, 10), (5, 5), (9, 5), (10, 10)), 8.0, 1.7, False),  # 31.4 m in 5.6 s
        (((0, 10), (4, 10), (5, 5), (20, 5)), None, 3.8, True),  # 37.5 m of 10 m/s in 8 s
        (((0, 1), (4, 1), (5, 0), (20, 0)), None, None, False),
    ],
)
def test_what_slowing_down_cost(
    marks: tuple[tuple[float, float], ...], limit: float | None, lost: float | None, going_on: bool
) -> None:
    states = slowed(*marks, until=12.0, limit=limit)
    found = delay(states, Episode(US, "slow-down", 4.0, 5.0))
    assert found.value == (None if lost is None else pytest.approx(lost, abs=0.3))
    assert found.at_least is going_on
    assert found.gap == ("not-applicable" if lost is None else None)
    assert found.time == 4.0


def test_a_delay_of_who_stood_is_against_the_limit() -> None:
    """It stands for 8 s where 10 m/s are allowed, then speeds up by 2 m/s2 within 5 s: 2.5 s."""
    states = slowed((0, 0), (8, 0), (13, 10), until=16.0, limit=10.0)
    found = delay(states, Episode(US, "stand", 0.0, 8.2))
    assert found.value == pytest.approx(10.5, abs=0.4)
    assert (
        delay(slowed((0, 0), (8, 0), until=9.0), Episode(US, "stand", 0.0)).gap == "not-applicable"
    )
    assert delay(states, Episode(TWO, "stand", 0.0)).gap == "not-recorded"


def test_what_a_lower_limit_takes_is_no_delay() -> None:
    """From 4 s on 5 m/s are allowed, and driven; then it slows down to 2.5 m/s for a while."""

    def limits(time: float) -> RoadFacts:
        limit = 14.0 if time < 4.0 else 5.0
        return RoadFacts({0: RoadPlace("a", 0, 1, limit, False, False)})

    kept_to = speeds(0.0, 0.0, ((0.0, 10.0), (3.3, 10.0), (3.5, 5.0), (20.0, 5.0)))
    states = States(made({0: Actor(kept_to)}, 16.0, roads=limits))
    assert delay(states, Episode(US, "slow-down", 3.0, 3.6)).value == pytest.approx(0.0, abs=0.2)
    marks = ((0.0, 10.0), (3.3, 10.0), (3.5, 5.0), (6.0, 5.0), (6.2, 2.5), (10.2, 2.5), (10.4, 5.0))
    slower = States(made({0: Actor(speeds(0.0, 0.0, marks))}, 16.0, roads=limits))
    found = delay(slower, Episode(US, "slow-down", 3.0, 6.2))
    assert found.value == pytest.approx(2.1, abs=0.3)  # 10.5 m in 4.2 s, of 5 m/s
    assert found.until == pytest.approx(10.4, abs=0.21)
    assert not found.at_least
