"""Which episodes are what was asked about, and which are worth telling of a ride."""

import pytest

from planner.record.events import Event as Told
from tests.explain.facts.scenes import Actor, made, speeds, straight
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Exit,
    Junction,
    Lane,
    Thing,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.explain.facts.episodes.happening import account, actors_of, happening, such
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.facts.world import World, world_of
from xavi_dialogue.explain.history.record import Record

US, ONE, TWO = Ego(), Vehicle(1), Vehicle(2)


def states() -> States:
    """We stop at 7 s behind one who stands, and another one passes."""
    actors = {
        0: Actor(speeds(0.0, 0.0, ((0.0, 10.0), (3.0, 10.0), (7.0, 0.0)))),
        1: Actor(straight(60.0, 0.0, 0.0)),
        2: Actor(straight(-11.0, 3.5, 14.0)),
    }
    return States(made(actors, 9.0, events=(Told("collided", 9.0, vehicle=1),)))


def told(*wanted: str, who: frozenset[int] | None = None) -> set[tuple[object, str]]:
    names = frozenset(wanted) if wanted else None
    return {(e.actor, e.action) for e in happening(states(), who, names)}  # type: ignore[arg-type]


def test_episodes_are_those_of_some_actors_and_actions() -> None:
    assert told("stop") == {(US, "stop")}
    assert told("stop", "stand") == {(US, "stop"), (ONE, "stand")}
    assert told("stop", "stand", who=frozenset((1, 2))) == {(ONE, "stand")}
    assert told("move", who=frozenset((2,))) == {(TWO, "move")}
    assert told("collide") == {(US, "collide"), (ONE, "collide")}
    assert told("collide", who=frozenset((1,))) == {(ONE, "collide")}
    assert told("collide", who=frozenset((2,))) == set()
    assert told("overtake", "pass") == {(TWO, "overtake")}
    assert told("overtake", who=frozenset((0,))) == set()
    assert told("overtake", who=frozenset((2,))) == {(TWO, "overtake")}
    assert told("overtake", who=frozenset((1,))) == set()


def test_some_episodes_are_told_on_request_only() -> None:
    everything = {action for _, action in told()}
    assert {"stop", "brake", "collide", "overtake"} <= everything
    assert not everything & {"move", "nearly-collide", "continue"}


def test_episodes_are_in_order_of_their_beginnings() -> None:
    found = happening(states(), None, None)
    assert [e.begin for e in found] == sorted(e.begin for e in found)
    assert found[0].begin == 0.0
    assert found[-1].begin == 9.0


@pytest.mark.parametrize(
    ("actor", "who"),
    [
        (US, {0}),
        (TWO, {2}),
        (Vehicles((1, 2)), {1, 2}),
        (Wanted(), None),
        (Lane(), {1, 2}),  # nobody in particular: the others
    ],
)
def test_who_may_have_done_it(actor: Thing, who: set[int] | None) -> None:
    assert actors_of(states(), Event("stop", actor)) == who


BRAKED = Episode(US, "brake", 4.0, 7.0, ONE, peak=3.0)
LEFT = Episode(US, "change-left", 4.0, 7.0)
TURN = Episode(US, "exit-right", 4.0, 7.0, place=Junction("junction"))
RING = Episode(US, "leave", 4.0, 4.0, Junction("roundabout"), "left", exit=2)
WENT = Episode(US, "go", 4.0, 7.0)
FOLLOWED = Episode(ONE, "follow", 4.0, 7.0, US)


@pytest.mark.parametrize(
    ("episode", "event", "is_it"),
    [
        (LEFT, Event("change-lane", side="left"), True),
        (LEFT, Event("change-lane", side="right"), False),
        (LEFT, Event("change-lane"), True),
        (RING, Event("leave", side="left"), True),
        (RING, Event("leave", side="right"), False),
        (BRAKED, Event("brake", side="left"), False),
        (BRAKED, Event("brake", manner=("hard",)), True),
        (Episode(US, "brake", 4.0, 7.0, peak=2.9), Event("brake", manner=("hard",)), False),
        (Episode(US, "brake", 4.0, 7.0), Event("brake", manner=("hard",)), False),
        (Episode(US, "brake", 4.0, 7.0), Event("brake", manner=("gently",)), True),
        (BRAKED, Event("brake", object=ONE), True),
        (BRAKED, Event("brake", object=TWO), False),
        (BRAKED, Event("brake", object=Vehicles((1, 2))), True),
        (BRAKED, Event("brake", object=Wanted()), True),
        (LEFT, Event("change-lane", object=ONE), False),
        (FOLLOWED, Event("follow", ONE, US), True),
        (TURN, Event("turn", object=Junction("junction")), True),
        (TURN, Event("turn", object=Junction("roundabout")), False),
        (LEFT, Event("change-lane", object=Junction("roundabout")), True),
        (RING, Event("leave", object=Exit(2)), True),
        (RING, Event("leave", object=Exit(3)), False),
        (RING, Event("leave", object=Exit()), True),
        (LEFT, Event("change-lane", object=Lane("left")), True),
        (BRAKED, Event("brake", object=Lane("left")), True),
    ],
)
def test_which_episode_is_the_event(episode: Episode, event: Event, is_it: bool) -> None:
    assert such((episode,), event, 0.0) == ((episode,) if is_it else ())


@pytest.mark.parametrize(
    ("episode", "event", "begin", "is_it"),
    [
        (WENT, Event("go"), 5.0, True),
        (WENT, Event("go"), 5.1, False),
        (RING, Event("leave"), 5.1, False),
        (BRAKED, Event("brake"), 6.0, True),  # it lasts
    ],
)
def test_what_takes_a_moment_must_begin_then(
    episode: Episode, event: Event, begin: float, is_it: bool
) -> None:
    assert such((episode,), event, begin) == ((episode,) if is_it else ())


@pytest.mark.parametrize(
    ("episode", "worth"),
    [
        (LEFT, True),
        (Episode(US, "stop", 4.0, 7.0), True),
        (BRAKED, True),
        (Episode(US, "brake", 4.0, 7.0, peak=1.5), True),
        (Episode(US, "brake", 4.0, 7.0, peak=1.4), False),
        (Episode(US, "brake", 4.0, 7.0), False),
        (Episode(US, "slow-down", 4.0, 7.0, peak=2.0), False),
        (WENT, False),
        (Episode(ONE, "overtake", 4.0, 7.0, US), True),
        (Episode(ONE, "overtake", 4.0, 7.0, TWO), False),
        (Episode(ONE, "stop", 4.0, 7.0, US), False),
        (FOLLOWED, False),
    ],
)
def test_what_is_worth_telling(episode: Episode, worth: bool) -> None:
    assert account((episode,)) == ((episode,) if worth else ())


@pytest.mark.parametrize(
    ("finer", "coarser", "told"),
    [
        (Episode(US, "stop", 4.0, 9.0), Episode(US, "give-way", 2.0, 10.0), False),
        (Episode(US, "stop", 4.0, 9.0), Episode(US, "give-way", 2.0, 3.0), False),
        (Episode(US, "stop", 4.0, 9.0), Episode(US, "give-way", 2.0, 2.9), True),
        (Episode(US, "stop", 4.0, 9.0), Episode(US, "give-way", 2.0), False),
        (Episode(US, "stop", 4.0, 9.0), Episode(US, "give-way", 10.0, 11.0), False),
        (Episode(US, "stop", 4.0, 9.0), Episode(US, "give-way", 10.1, 11.0), True),
        (Episode(US, "stop", 4.0), Episode(US, "give-way", 20.1, 21.0), False),
        (Episode(US, "stop", 4.0, 9.0), Episode(ONE, "give-way", 4.0, 9.0, US), True),
        (Episode(US, "stop", 4.0, 9.0), Episode(US, "overtake", 4.0, 9.0, ONE), True),
        (Episode(ONE, "overtake", 4.0, 9.0, US), Episode(ONE, "cut-in", 4.0, 9.0, US), True),
    ],
)
def test_what_another_episode_tells_is_not_told_again(
    finer: Episode, coarser: Episode, told: bool
) -> None:
    assert (finer in account((finer, coarser))) is told
    assert (finer in account((coarser, finer))) is told
    assert coarser in account((finer, coarser))


def test_the_world_asks_for_parts_of_the_ride() -> None:
    world = World(states().ride)
    assert (world.now, world.begin, world.vehicles) == (9.0, 0.0, (1, 2))
    (stop,) = world.episodes(US, "stop")
    assert world.episodes(0, ("stop",)) == world.episodes((0,), "stop") == (stop,)
    assert world.episodes(US, "stop", begin=8.0) == (stop,)  # it goes on
    assert world.episodes(US, "stop", end=6.9) == ()
    assert world.episodes(US, "stop", end=7.0) == (stop,)
    assert world.duration(stop) == 2.0
    assert world.duration(Episode(US, "stop", 7.0, 8.5)) == 1.5
    (past,) = world.episodes(actions="overtake")
    assert past.end is not None
    assert world.episodes(actions="overtake", begin=past.end) == (past,)
    assert world.episodes(actions="overtake", begin=past.end + 0.1) == ()
    assert world.episodes(actions="overtake", object=0) == (past,)
    assert world.episodes(actions="overtake", object=1) == ()
    assert world.episodes(actions="stop", object=US) == ()
    assert world.holds(Event("overtake", Wanted()), 0.0, 9.0) == (past,)
    assert past in world.account(0.0, 9.0)
    assert world.account(0.0, 1.0) == ()
    assert (world.decided(3), world.decided(77)) == (3.0, None)
    assert (world.plan(3.0), world.plan(-1.0)) == (("continue",), ())
    assert world.road(3.0) is None
    look = world.look(1, 9.0)
    assert look is not None
    assert look.vehicle == 1
    assert world.in_view(9.0) == (1, 2)
    assert world.relation("ahead-of", ONE, US, 9.0) is True
    assert [b.time for b in world.beliefs(1, 3.0, 4.0)] == [3.0, 4.0]
    belief = world.belief(1, 3.5)
    assert belief is not None
    assert belief.time == 3.0
    assert world.probability(Event("continue", ONE), 3.0) == 1.0
    assert world.beginnings() == {"continue": pytest.approx(9.0)}


def test_two_worlds_are_kept() -> None:
    records = [Record(float(t)) for t in (1, 2, 3)]
    first, second = world_of(records[0]), world_of(records[1])
    assert world_of(records[0]) is first
    assert world_of(records[1]) is second
    world_of(records[2])
    assert world_of(records[1]) is second
    assert world_of(records[0]) is not first
