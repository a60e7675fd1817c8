"""Episodes: read off made rides of which it is known what happens, and off recorded ones."""

import math

import pytest

from planner.record.events import Event
from planner.record.places import LightChange, RoadFacts, RoadPlace, RouteStep, Turn
from planner.record.trace import HeldUp
from tests.explain.facts.scenes import Actor, Pose, made, recorded, shifted, speeds, straight
from tests.traces import Aim, Way
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Junction, Vehicle, Wanted
from xavi_dialogue.domain.terms import Event as Doing
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.restraints import restraints

RIDES = ("s1-0", "s2-0", "s3-0", "s4-0", "town-0", "motorway-0", "bend-0")


def one(found: tuple[Episode, ...]) -> Episode:
    assert len(found) == 1, found
    return found[0]


def test_braking_stopping_and_setting_off() -> None:
    marks = ((0.0, 14.0), (4.0, 14.0), (8.0, 0.0), (12.0, 0.0), (16.0, 8.0))
    world = World(made({0: Actor(speeds(0.0, 0.0, marks))}, 18.0))
    brake = one(world.episodes(Ego(), "slow-down"))
    assert brake.action == "brake"
    assert brake.begin == pytest.approx(4.0, abs=0.5)
    assert brake.end == pytest.approx(8.0, abs=0.3)
    assert brake.peak == pytest.approx(3.5, abs=0.1)
    assert (brake.speed_from, brake.standing) == (14.0, True)
    stop = one(world.episodes(Ego(), "stand"))
    assert stop.action == "stop"
    assert world.duration(stop) == pytest.approx(4.0, abs=0.5)
    assert one(world.episodes(Ego(), "go")).begin == pytest.approx(12.0, abs=0.5)
    assert one(world.holds(Doing("brake", manner=("hard",)), 0.0, 18.0)) == brake
    cost = world.delay(brake).value
    assert cost == pytest.approx(18.0 - 4.0 - (28.0 + 16.0 + 16.0) / 14.0, abs=0.8)


def test_what_goes_on_has_no_end() -> None:
    world = World(made({0: Actor(speeds(0.0, 0.0, ((0.0, 8.0), (4.0, 0.0))))}, 7.0))
    stop = one(world.episodes(Ego(), "stop"))
    assert stop.end is None
    assert world.duration(stop) == pytest.approx(3.0, abs=0.3)
    assert world.measure("waiting-time", Ego(), 7.0).value == pytest.approx(3.0, abs=0.4)


def test_who_stands_at_first_sight_has_not_stopped() -> None:
    actors = {0: Actor(straight(0.0, 0.0, 8.0)), 1: Actor(straight(60.0, 3.5, 0.0))}
    world = World(made(actors, 6.0))
    assert one(world.episodes(1, "stand")).action == "stand"
    assert not world.episodes(1, "stop")


def test_a_lane_change_that_cuts_in() -> None:
    actors = {
        0: Actor(straight(0.0, 0.0, 12.0)),
        1: Actor(shifted(straight(14.0, 3.5, 13.0), 3.0, 6.0, -3.5)),
        2: Actor(shifted(straight(80.0, 3.5, 13.0), 3.0, 6.0, -3.5)),
    }
    world = World(made(actors, 10.0))
    change = one(world.episodes(1, "change-lane"))
    assert change.action == "change-right"
    assert change.begin == pytest.approx(3.2, abs=0.6)
    cut = one(world.episodes(actions="cut-in"))
    assert (cut.actor, cut.object) == (Vehicle(1), Ego())
    assert world.holds(Doing("cut-in", actor=Wanted()), 0.0, 10.0) == (cut,)
    assert world.holds(Doing("cut-in", actor=Vehicle(2)), 0.0, 10.0) == ()


def test_who_moves_in_far_ahead_cuts_in_if_that_slows_us() -> None:
    actors = {
        0: Actor(straight(0.0, 0.0, 12.0)),
        1: Actor(shifted(straight(60.0, 3.5, 11.0), 3.0, 6.0, -3.5)),
    }
    slowed = Event("restrained", 5.0, vehicle=1, by="cut-in")
    assert one(World(made(actors, 10.0, events=(slowed,))).episodes(actions="cut-in")).object
    assert not World(made(actors, 10.0)).episodes(actions="cut-in")
    other = Event("restrained", 5.0, vehicle=1, by="leader")
    assert not World(made(actors, 10.0, events=(other,))).episodes(actions="cut-in")


def test_who_walked_over_our_way_before_we_turned_into_it_crossed_it() -> None:
    ahead = straight(0.0, 0.0, 10.0)

    def turns(t: float) -> Pose:
        return ahead(t) if t <= 5.0 else (50.0, -10.0 * (t - 5.0), -math.pi / 2.0, 10.0)

    actors = {
        0: Actor(turns),
        1: Actor(straight(44.0, -30.0, 2.0), kind="pedestrian", length=0.3),  # on it at 3 s
        2: Actor(straight(53.0, -40.0, 0.0), kind="pedestrian", length=0.3),
    }
    world = World(made(actors, 12.0))
    crossed = one(world.episodes(actions="cross"))
    assert (crossed.actor, crossed.object) == (Vehicle(1), Ego())
    assert crossed.begin <= 3.0 <= (crossed.end or math.inf)


def test_overtaking_and_passing() -> None:
    actors = {
        0: Actor(straight(0.0, 0.0, 12.0)),
        1: Actor(straight(-30.0, 3.5, 18.0)),
        2: Actor(straight(30.0, -3.5, 8.0)),
        3: Actor(straight(150.0, 7.0, 12.0, math.pi)),
        4: Actor(straight(60.0, -3.5, 0.0)),
    }
    world = World(made(actors, 12.0))
    found = {(e.actor, e.action, e.object, e.side) for e in world.episodes(actions="pass")}
    assert found == {
        (Vehicle(1), "overtake", Ego(), "left"),
        (Ego(), "overtake", Vehicle(2), "left"),
        (Vehicle(3), "pass", Ego(), "left"),
        (Ego(), "pass", Vehicle(4), "left"),
    }
    abreast = one(world.episodes(Vehicle(1), "overtake"))
    assert abreast.begin == pytest.approx((30.0 - 4.8) / 6.0, abs=0.3)


def turning(angle: float) -> "Actor":
    """Drives north to a junction, and turns within 2 s; positive: to the left."""

    def pose(t: float) -> Pose:
        if t <= 4.0:
            return 0.0, 6.0 * t, math.pi / 2.0, 6.0
        share = min((t - 4.0) / 2.0, 1.0)
        turned = angle * share
        radius = 6.0 * 2.0 / abs(angle)
        sign = math.copysign(1.0, angle)
        x = -sign * radius * (1.0 - math.cos(turned))
        y = 24.0 + radius * math.sin(abs(turned))
        heading = math.pi / 2.0 + turned
        rest = max(t - 6.0, 0.0) * 6.0
        return x + rest * math.cos(heading), y + rest * math.sin(heading), heading, 6.0

    return Actor(pose)


@pytest.mark.parametrize(
    ("angle", "action"), [(math.pi / 2, "exit-left"), (-math.pi / 2, "exit-right")]
)
def test_turns_have_a_side_and_begin_with_the_turn(angle: float, action: str) -> None:
    actors = {0: Actor(straight(-200.0, -50.0, 1.0)), 1: turning(angle)}
    world = World(made(actors, 10.0))
    turn = one(world.episodes(1, "turn"))
    assert turn.action == action
    assert turn.begin == pytest.approx(4.2, abs=0.3)
    assert turn.end == pytest.approx(6.0, abs=0.3)


def test_a_queue_is_followed_and_a_gap_in_between_is_not() -> None:
    actors = {
        0: Actor(straight(0.0, 0.0, 10.0)),
        1: Actor(straight(20.0, 0.0, 10.0)),
        2: Actor(straight(33.0, 0.0, 10.0)),
        3: Actor(straight(-18.0, 0.0, 10.0)),
    }
    found = World(made(actors, 8.0)).episodes(actions="follow")
    assert {(e.actor, e.object, e.end) for e in found} == {
        (Ego(), Vehicle(1), None),
        (Vehicle(3), Ego(), None),
    }


def test_signals_appearing_hiding_and_leaving() -> None:
    lights = (
        LightChange(0.0, ()),
        LightChange(2.4, ("left",)),
        LightChange(5.0, ("left", "brake")),
        LightChange(6.2, ()),
    )
    actors = {
        0: Actor(straight(0.0, 0.0, 10.0)),
        1: Actor(straight(30.0, 3.5, 10.0), lights=lights),
        2: Actor(straight(-40.0, 0.0, 10.0), since=3.0, until=6.0),
        3: Actor(straight(40.0, 0.0, 10.0), hidden=(4.0, 7.0)),
    }
    world = World(made(actors, 10.0))
    signal = one(world.episodes(1, "signal"))
    assert (signal.side, signal.begin, signal.end) == ("left", 2.4, 6.2)
    assert world.measure("indicator", Vehicle(1), 5.5).lights == ("left",)
    assert world.measure("brake-lights", Vehicle(1), 5.5).word == "on"
    assert [(e.action, e.begin) for e in world.episodes(2, ("appear", "disappear"))] == [
        ("appear", 3.0),
        ("disappear", 6.0),
    ]
    assert [(e.action, e.begin) for e in world.episodes(3, ("appear", "disappear"))] == [
        ("disappear", 4.0),
        ("appear", 7.0),
    ]
    assert world.measure("visibility", Vehicle(3), 6.0).word == "hidden"
    assert world.measure("visibility", Vehicle(3), 9.0).word == "in-view"
    assert world.measure("visibility", Vehicle(2), 9.0).word == "lost"
    assert world.measure("speed", Vehicle(3), 6.0).gap == "hidden"
    assert world.measure("speed", Vehicle(2), 9.5).gap == "out-of-view"


def test_to_whom_way_was_given() -> None:
    marks = ((0.0, 10.0), (3.0, 10.0), (7.0, 0.0), (10.0, 0.0), (13.0, 8.0))
    waits = (
        Aim(
            "exit-left",
            1.0,
            (Way(("exit-left",), held_up=(HeldUp(0, 0.0, 30.0, "right-of-way", 9.0, 9.0),)),),
        ),
    )
    actors = {
        0: Actor(speeds(0.0, 0.0, marks)),
        1: Actor(straight(80.0, -60.0, 8.0, math.pi / 2.0)),
        2: Actor(straight(90.0, 20.0, 0.0, -math.pi / 2.0), aims=waits),
    }
    events = (Event("gave-way", 5.0, vehicle=1), Event("gave-way", 6.0, vehicle=1))
    world = World(made(actors, 15.0, events=events))
    given = one(world.episodes(Ego(), "give-way"))
    assert given.object == Vehicle(1)
    assert given.begin == pytest.approx(3.2, abs=0.5)
    assert given.end == pytest.approx(10.2, abs=0.5)
    assert given.standing
    assert world.holds(Doing("let-go", object=Vehicle(1)), 0.0, 15.0) == (given,)
    assert world.holds(Doing("wait", object=Wanted()), 0.0, 15.0) == (given,)
    assert world.measure("waiting-time", Ego(), 15.0, Vehicle(1)).value == pytest.approx(
        3.0, abs=0.4
    )
    for_us = one(world.episodes(2, "wait"))
    assert (for_us.object, for_us.sure) == (Ego(), False)
    assert world.relation("waiting-for", Vehicle(2), Ego(), 5.0) is True
    assert world.holds(Doing("block", actor=Vehicle(1), object=Ego()), 0.0, 15.0) == (given,)


def ring(time: float) -> RoadFacts:
    """A roundabout from 4 to 9 s, which is left by the second exit; before it the plan changes."""
    inside = 4.0 <= time < 9.0
    edge = "ring" if inside else "in" if time < 4.0 else "out"
    place = RoadPlace(edge, 0, 1, 8.0, inside and time < 5.0, inside)
    turn: Turn = "exit-left" if time < 2.0 else "exit-straight"
    step = RouteStep(
        40.0 - 10.0 * time, "roundabout", turn, 3 if time < 2.0 else 2, 4, 4, "give-way"
    )
    return RoadFacts({0: place, 1: place}, (step,) if time < 4.0 else ())


def test_roundabouts_are_entered_and_left_by_an_exit() -> None:
    actors = {0: Actor(straight(0.0, 0.0, 10.0)), 1: Actor(straight(30.0, 0.0, 10.0))}
    world = World(made(actors, 12.0, roads=ring))
    enter, leave = world.episodes(Ego(), ("enter", "leave"))
    assert (enter.begin, enter.exit) == (3.5, 2)
    assert (leave.begin, leave.exit) == (8.5, 2)
    assert world.holds(Doing("leave", object=Junction("roundabout")), 0.0, 12.0) == (leave,)
    assert len(world.episodes(1, ("enter", "leave"))) == 2
    assert one(world.episodes(Ego(), "change-plan")).begin == 2.0
    assert world.measure("exit-number", Ego(), 12.0).value == 2.0


def test_who_crosses_our_way() -> None:
    actors = {
        0: Actor(straight(0.0, 0.0, 5.0)),
        1: Actor(straight(60.0, -40.0, 8.0, math.pi / 2.0)),
        2: Actor(straight(-20.0, -40.0, 8.0, math.pi / 2.0)),
    }
    crossing = one(World(made(actors, 9.0)).episodes(actions="cross"))
    assert (crossing.actor, crossing.object, crossing.side) == (Vehicle(1), Ego(), "right")


@pytest.mark.parametrize("name", RIDES)
def test_episodes_of_recorded_rides_are_sound(name: str) -> None:
    ride = recorded(name)
    world = World(ride)
    found = world.episodes()
    assert list(found) == sorted(found, key=lambda e: e.begin)
    for episode in found:
        assert world.begin - 1e-6 <= episode.begin <= world.now + 1e-6
        assert episode.end is None or episode.end >= episode.begin
        assert episode.actor != episode.object
        if episode.action in ("stop", "stand") and isinstance(episode.actor, Vehicle):
            motion = ride.motion(episode.actor.number)
            end = world.now if episode.end is None else episode.end
            assert (
                max(
                    (motion.speed[k] for k in motion.within(episode.begin, end - 0.25)), default=0.0
                )
                < 1.0
            )
    told = {e.vehicle for e in ride.events if e.kind == "gave-way" and e.vehicle is not None}
    given = {
        e.object.number
        for e in world.episodes(0, "give-way")
        if isinstance(e.object, Vehicle) and e.action == "give-way"
    }
    slowed = {r.restraint.vehicle for r in restraints(ride) if r.restraint.by == "right-of-way"}
    assert told <= given <= told | slowed
    assert set(world.account(0.0, world.now)) <= set(found)


@pytest.mark.parametrize("name", RIDES)
def test_what_has_happened_stays_so_as_the_ride_goes_on(name: str) -> None:
    whole = World(recorded(name))
    early = World(recorded(name, now=whole.now / 2.0))
    over = [e for e in early.episodes() if e.end is not None and e.end < early.now - 12.0]
    known = {(e.actor, e.action, e.object, e.begin) for e in whole.episodes()}
    lasting = [e for e in over if e.sure]
    assert all((e.actor, e.action, e.object, e.begin) in known for e in lasting)
