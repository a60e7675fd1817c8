"""What happened on a ride: what belongs together is told as one."""

import math
from collections.abc import Sequence

from planner.record.events import SETTLED, Event, RestraintKind
from planner.record.places import RoadFacts, RoadPlace
from tests.explain.causes.decisions import Driven
from tests.explain.facts.scenes import Actor, straight
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Ask, Doing
from xavi_dialogue.domain.terms import Ego, Vehicle, Vehicles
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.ride.condensing import condensed
from xavi_dialogue.explain.facts.world import World

LIMIT = RoadFacts({0: RoadPlace("a", 0, 1, 14.0, False, False)})


def own(action: ActionName, begin: float, end: float, whom: int | None = None) -> Episode:
    return Episode(Ego(), action, begin, end, object=None if whom is None else Vehicle(whom))


def kept(time: float, by: RestraintKind, whom: int | None = None) -> Event:
    return Event("restrained", time + SETTLED, vehicle=whom, by=by)


def told(
    episodes: Sequence[Episode], *events: Event, speed: float = 5.0
) -> list[tuple[str, float, float | None, object]]:
    driven = Driven(
        {0: Actor(straight(0.0, 0.0, speed)), 1: Actor(straight(20.0, 0.0, speed))},
        30.0,
        roads=lambda _: LIMIT,
        events=events,
    )
    ride = driven.ride()
    asked = Asked(ride, World(ride), None, GroundedAct(Ask(Doing()), None))
    return [(e.action, e.begin, e.end, e.object) for e in condensed(asked, episodes)]


def test_those_let_go_first_one_after_the_other_are_one_episode() -> None:
    one, soon, late = (
        own("give-way", 2, 4, 1),
        own("give-way", 9, 10, 2),
        own("give-way", 17, 18, 1),
    )
    assert told([one, soon, late]) == [
        ("give-way", 2, 10, Vehicles((1, 2))),
        ("give-way", 17, 18, Vehicle(1)),
    ]


def test_who_was_let_go_first_at_speed_counts_too() -> None:
    events = (kept(3.0, "right-of-way", 1), kept(5.0, "nothing"))
    assert told([], *events) == [("give-way", 3.0, 5.0, Vehicle(1))]
    assert told([own("give-way", 4, 5, 1)], *events) == [("give-way", 4, 5, Vehicle(1))]
    short = (kept(3.0, "right-of-way", 1), kept(3.5, "nothing"))
    assert told([], *short) == []


def test_driving_slowly_behind_somebody_for_long_is_an_episode() -> None:
    behind = (kept(3.0, "leader", 1), kept(8.0, "nothing"), kept(9.0, "leader", 1))
    over = (*behind, kept(15.0, "limit"))
    assert told([], *over) == [("follow", 3.0, 15.0, Vehicle(1))]
    assert told([], *behind) == [("follow", 3.0, None, Vehicle(1))]
    assert told([], *over, speed=12.0) == []
    assert told([], kept(3.0, "leader", 1), kept(8.0, "limit")) == []


def test_braking_is_told_by_what_it_was_for() -> None:
    braking, turn = own("brake", 2, 5), own("exit-left", 6, 9)
    assert told([braking, turn]) == [("exit-left", 6, 9, None)]
    assert told([braking]) == [("brake", 2, 5, None)]
    hard = Episode(Ego(), "brake", 2, 5, peak=math.inf)
    assert [action for action, *_ in told([hard, turn])] == ["brake", "exit-left"]
