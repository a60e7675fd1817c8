"""Hidden parts of the road: who might come from there, and what that costs."""

import math
from collections.abc import Mapping
from dataclasses import replace

import msgspec
import pytest

from planner.counterfactuals.whatif import NotInView, WhatIf, replan
from planner.errors import TraceError
from planner.hidden_areas.caution import CAUTION, CREEPING, cautious, name_of
from planner.hidden_areas.phantoms import (
    LEAST,
    PRIOR_RATE,
    Counts,
    View,
    around,
    imagined,
    meeting,
    time_across,
    ways_ahead,
)
from planner.kernels.limits import READY
from planner.manoeuvres.actions import Situation
from planner.record.hidden_record import HeldByHidden, Phantom, PhantomSample
from planner.record.trace import EgoGoal, PlanTrace, Settings, Track, encode
from planner.record.trace_reading import decode
from planner.roads.trajectory import Roads
from planner.search.comparison import likeliest
from planner.search.decide import decide
from planner.search.inputs import Frame, Moment, Root
from sim.roads.network import Location
from sim.scene import EGO, Unseen, VehicleState
from tests.planner.nets import drawn, lane, link

# The ego comes along y = 0 from the west; the road that goes first comes from the south.
ROADS = drawn(
    [
        lane("in_0", [(0.0, 0.0), (100.0, 0.0)], 14.0),
        lane(":J_0", [(100.0, 0.0), (112.0, 0.0)], 14.0, inside=True),
        lane("out_0", [(112.0, 0.0), (400.0, 0.0)], 14.0),
        lane("far_0", [(108.0, -206.0), (108.0, -46.0)], 14.0),
        lane("south_0", [(108.0, -46.0), (108.0, -6.0)], 14.0),
        lane(":J_1", [(108.0, -6.0), (108.0, 6.0)], 14.0, inside=True),
        lane("north_0", [(108.0, 6.0), (108.0, 200.0)], 14.0),
    ],
    [
        link("in_0", "out_0", "straight", (":J_0",), index=0, yields_to=(1,), foes=(1,)),
        link("south_0", "north_0", "straight", (":J_1",), index=1, foes=(0,)),
        replace(link("far_0", "south_0", "straight", (), index=0), junction="K"),
    ],
)
MINE = ROADS.network.junction_links("J")[0]
THEIRS = ROADS.network.junction_links("J")[1]
SETTINGS = Settings(rollouts=60, min_rollouts=4)


def car(x: float, y: float = 0.0, speed: float = 10.0, **more: object) -> VehicleState:
    known = VehicleState((x, y), 0.0, speed, 0.0, 4.8, 1.8)
    return replace(known, **more)  # type: ignore[arg-type]


def seeing(
    *unseen: Unseen, others: Mapping[int, VehicleState] | None = None, rate: float = PRIOR_RATE
) -> View:
    return View(ROADS, {EGO: car(70.0), **(others or {})}, unseen, lambda _: rate)


def one(*unseen: Unseen, **more: object) -> Phantom:
    found = imagined(seeing(*unseen, **more), (MINE,))  # type: ignore[arg-type]
    assert len(found) == 1
    return found[0]


NEAR = Unseen("south_0", 0.0, 30.0)  # its end is 10 m before the line


def test_somebody_is_imagined_at_the_nearest_hidden_place() -> None:
    found = one(NEAR)
    assert found.position == pytest.approx((108.0, -16.0))
    assert found.heading == pytest.approx(math.pi / 2.0, abs=1e-3)
    assert (found.speed, found.distance) == (14.0, 10.0)
    assert (found.junction, found.link, found.yields) == ("J", 1, (0,))
    assert found.lanes == ("south_0", ":J_1", "north_0")
    assert found.behind is None


def test_how_likely_that_is_hangs_on_how_much_is_hidden_and_on_the_traffic() -> None:
    # From where it can just still stop, the ego needs 0.9 + 10 / 6 s and then 16.8 m at 2.3 m/s2.
    needed = 0.9 + 10.0 / 6.0 + (math.sqrt(100.0 + 4.6 * 16.8) - 10.0) / 2.3
    assert time_across(ROADS.network, MINE, car(70.0)) == pytest.approx(needed)
    assert one(NEAR).hidden == pytest.approx(30.0)  # of it, all: 14 m/s lasts for more
    assert one(NEAR).probability == pytest.approx(
        1.0 - math.exp(-PRIOR_RATE * 30.0 / 14.0), abs=1e-4
    )
    beyond = Unseen("far_0", 0.0, 160.0)
    assert one(NEAR, beyond).hidden == pytest.approx(14.0 * needed - 10.0, abs=0.01)
    assert one(NEAR, rate=0.02).probability == pytest.approx(1.0 - math.exp(-0.6 / 14.0), abs=1e-4)


@pytest.mark.parametrize(
    "unseen",
    [
        (),
        (Unseen("far_0", 0.0, 130.0),),  # 70 m away: nobody gets here before we are across
        (Unseen("south_0", 25.0, 30.0),),  # no more than a shadow
        (Unseen("north_0", 0.0, 60.0),),  # leads away
        (Unseen("in_0", 0.0, 60.0), Unseen("out_0", 0.0, 60.0)),  # our own road
    ],
)
def test_nobody_is_imagined_where_nobody_could_come_in_time(unseen: tuple[Unseen, ...]) -> None:
    assert imagined(seeing(*unseen), (MINE,)) == ()


def test_nobody_is_imagined_on_a_fast_road_where_one_merges_at_speed() -> None:
    lanes = {
        name: replace(known, speed_limit=25.0) if name == "south_0" else known
        for name, known in ROADS.network.lanes.items()
    }
    fast = replace(seeing(NEAR), roads=Roads(replace(ROADS.network, lanes=lanes)))
    assert imagined(fast, (MINE,)) == ()


def test_who_goes_first_himself_imagines_nobody() -> None:
    assert imagined(seeing(Unseen("in_0", 0.0, 100.0)), (THEIRS,)) == ()


def test_who_stands_ahead_lets_nobody_come_and_who_is_slow_slows() -> None:
    north = {"heading": math.pi / 2.0}
    waits = {1: car(108.0, -8.0, 0.0, **north)}
    assert imagined(seeing(NEAR, others=waits), (MINE,)) == ()
    crawls = {1: car(108.0, -8.0, 4.0, **north)}
    assert one(NEAR, others=crawls).speed == 4.0
    behind = {1: car(108.0, -60.0, 0.0, **north)}
    assert one(NEAR, others=behind).speed == 14.0


def test_the_lorry_in_the_line_of_sight_is_what_hides() -> None:
    lorry = car(95.0, -6.0, 0.0, length=12.0, width=2.5, kind="truck")
    assert one(NEAR, others={3: lorry}).behind == 3
    assert one(NEAR, others={3: replace(lorry, kind="car")}).behind is None
    assert one(NEAR, others={3: replace(lorry, position=(95.0, 30.0))}).behind is None


def test_what_hides_is_in_the_line_of_sight_to_the_place_that_was_looked_at() -> None:
    # Places are 5 m apart, and a stretch ends between two: its end itself may be in view.
    thin = car(104.0, -16.7, 0.0, length=3.0, width=0.8, kind="truck")
    assert one(NEAR, others={3: thin}).behind == 3
    assert one(Unseen("south_0", 0.0, 35.0), others={3: thin}).behind is None


def test_who_stands_before_the_line_reckons_with_what_is_hidden_behind_it() -> None:
    assert ways_ahead(ROADS, Location("in_0", 95.0, 0.0), 0.0) == (MINE,)
    assert ways_ahead(ROADS, Location("in_0", 60.0, 0.0), 0.0) == ()


def test_inside_a_junction_who_may_come_counts_until_their_way_is_reached() -> None:
    lane_inside = ":J_0"
    before, beyond = (Location(lane_inside, offset, 0.0) for offset in (4.0, 7.0))
    assert [x.link for x in around(seeing(NEAR), before)] == [THEIRS.index]
    assert around(seeing(NEAR), beyond) == ()


def test_what_was_seen_of_a_road_changes_what_is_expected_of_it() -> None:
    counts = Counts()
    assert counts.rate("south", 10.0) == pytest.approx(PRIOR_RATE)
    counts.note({4: "south", 5: "other"})
    counts.note({4: "south"})  # the same one
    assert counts.rate("south", 13.0) == pytest.approx(2.0 / 15.0)
    assert counts.rate("south", 34.0) == pytest.approx(2.0 / 36.0)  # nobody else came
    assert counts.rate("other", 34.0) == pytest.approx(PRIOR_RATE)  # was not watched before


def test_the_car_is_slow_where_their_way_begins() -> None:
    # Their lane's middle is 8 m behind the line; with a metre between them, two cars are 2.8 m
    # apart.
    assert meeting(ROADS, MINE, THEIRS) == pytest.approx(8.0 - 2.8, abs=0.5)
    assert cautious([one(NEAR)]) == {("J", 0): pytest.approx(5.5)}
    unlikely = msgspec.structs.replace(one(NEAR), probability=CAUTION / 2.0)
    assert cautious([unlikely]) == {}
    assert list(cautious([unlikely, unlikely, unlikely])) == [("J", 0)]  # one of them may come
    assert CREEPING > 0.0  # it never waits for somebody whom it does not see
    assert LEAST < CAUTION


def moment(*phantoms: Phantom, x: float = 60.0, speed: float = 12.0) -> Moment:
    ego = car(x, speed=speed)
    here = Situation(5.0, ego.position, 0.0, speed, 0.0, Location("in_0", x, 0.0))
    track = Track(5.0, (ego.position,), (0.0,), (speed,))
    return Moment(3, 5.0, {EGO: ego}, {EGO: track}, Root(here), phantoms=phantoms)


def decided(*phantoms: Phantom, roads: Roads = ROADS, **more: float) -> PlanTrace:
    frame = Frame(roads, EgoGoal("out", 150.0, None), SETTINGS, 7, "car")
    return decide(frame, moment(*phantoms, **more)).trace


LIKELY = msgspec.structs.replace(one(NEAR), probability=0.4)


def speeds(trace: PlanTrace, *, comes: bool) -> list[tuple[float, ...]]:
    wanted = (PhantomSample(0, comes),)
    own = [
        r if r.same_as is None else trace.rollouts[r.same_as]
        for r in trace.rollouts
        if r.phantoms == wanted and all(taken.action != "stop" for taken in r.actions)
    ]
    return [r.speed for r in own if r.speed is not None]


def test_rollouts_come_slowly_to_what_is_hidden_and_give_way_to_who_comes() -> None:
    trace = decided(LIKELY)
    assert trace.phantoms == (LIKELY,)
    drawn_ = [r.phantoms for r in trace.rollouts if not r.forced]
    share = sum(drew == (PhantomSample(0, True),) for drew in drawn_) / len(drawn_)
    assert share == pytest.approx(0.4, abs=0.2)
    alone = max(r.reward for r in decided().rollouts)
    best = {
        c: max(r.reward for r in trace.rollouts if r.phantoms[0].comes == c) for c in (True, False)
    }
    assert best[False] < alone - 1.0
    assert min(map(min, speeds(trace, comes=False))) == pytest.approx(READY, abs=1.0)
    held = {h for r in trace.rollouts for h in r.held_by_hidden}
    assert {one.comes for one in held} >= {False}
    assert all(one.phantom == 0 and one.since < one.until for one in held)
    assert all(r.collided_with is None or r.collided_with >= 0 for r in trace.rollouts)
    assert all(h.vehicle >= 0 for r in trace.rollouts for h in r.held_up)


def test_who_comes_in_time_is_given_way_to() -> None:
    # Some 50 m away, it gets here just when the ego would.
    late = msgspec.structs.replace(
        LIKELY, lanes=("far_0", *LIKELY.lanes), begin=0.0, end=150.0, position=(108.0, -56.0),
        probability=0.07,
    )  # fmt: skip
    trace = decided(late)
    came = [r for r in trace.rollouts if r.phantoms == (PhantomSample(0, True),)]
    assert any(h.comes for r in came for h in r.held_by_hidden)
    gone = [r for r in trace.rollouts if r.phantoms == (PhantomSample(0, False),)]
    assert all(r.held_by_hidden == () for r in gone)  # so unlikely, nothing is slower for it
    assert max(r.reward for r in came) < max(r.reward for r in gone)


def test_a_decision_with_nobody_imagined_is_what_it_was() -> None:
    trace = decided()
    assert b"phantom" not in encode(trace)
    assert b"hidden" not in encode(trace)


def test_planned_again_as_if_one_could_see_past() -> None:
    trace = decided(LIKELY)
    again = replan(trace, ROADS.network, WhatIf(seen_past=(0,)))
    assert again.phantoms == ()
    assert again.plan[0].value > trace.plan[0].value + 1.0
    assert again.rollouts == decided().rollouts
    with pytest.raises(NotInView):
        replan(trace, ROADS.network, WhatIf(seen_past=(1,)))


def test_planned_again_from_the_record_nothing_else_changes() -> None:
    trace = decided(LIKELY)
    more = replan(trace, ROADS.network, WhatIf(actions=("stop",), rollouts=5))
    assert more.rollouts[: len(trace.rollouts)] == trace.rollouts
    assert all(r.phantoms for r in more.rollouts[len(trace.rollouts) :])


def test_traces_with_phantoms_are_read_and_checked() -> None:
    trace = decided(LIKELY)
    assert decode(encode(trace)) == trace
    wrong = msgspec.structs.replace(trace.rollouts[0], phantoms=(PhantomSample(1, True),))
    with pytest.raises(TraceError, match="not imagined"):
        decode(encode(msgspec.structs.replace(trace, rollouts=(wrong,))))
    held = msgspec.structs.replace(
        trace.rollouts[0], held_by_hidden=(HeldByHidden(2, False, 1.0, 2.0),)
    )
    with pytest.raises(TraceError, match="not imagined"):
        decode(encode(msgspec.structs.replace(trace, rollouts=(held,))))


def test_joint_samples_reckon_with_who_is_imagined() -> None:
    both = (LIKELY, msgspec.structs.replace(LIKELY, probability=0.7))
    found = dict(likeliest({}, phantoms=both))
    assert sum(found.values()) == pytest.approx(1.0)
    assert found[PhantomSample(0, True), PhantomSample(1, False)] == pytest.approx(0.4 * 0.3)
    assert name_of(0) < 0  # no vehicle has such a name


def test_the_nearest_hider_comes_first_and_a_building_behind_it_is_recorded() -> None:
    lorry = car(95.0, -6.0, 0.0, length=12.0, width=2.5, kind="truck")
    bus = car(100.0, -12.0, 0.0, length=12.0, width=2.5, kind="bus")
    found = one(replace(NEAR, walled=True), others={2: bus, 3: lorry})
    assert (found.behind, found.beyond, found.walled) == (3, (2,), True)
    assert not one(replace(NEAR, walled=True)).walled  # there is no vehicle before the building


def test_without_a_lorry_one_sees_past_it_but_not_past_the_building() -> None:
    lorry = car(95.0, -6.0, 0.0, length=12.0, width=2.5, kind="truck")
    fast = Frame(ROADS, EgoGoal("out", 150.0, None), Settings(rollouts=8, min_rollouts=1), 7, "car")
    behind = msgspec.structs.replace(LIKELY, behind=3)
    walled = msgspec.structs.replace(behind, walled=True)
    others = {EGO: car(60.0, speed=12.0), 3: lorry}
    tracks = {v: Track(5.0, (x.position,), (0.0,), (x.speed,)) for v, x in others.items()}
    here = replace(moment(LIKELY, behind, walled), scene=others, history=tracks)
    again = replan(decide(fast, here).trace, ROADS.network, WhatIf(removed=3))
    assert again.phantoms == (LIKELY, walled)
