"""Why we drove as we did, by what our driving recorded as in the way."""

import math
from collections.abc import Sequence

import pytest

from planner.record.events import SETTLED, RestraintKind
from planner.record.events import Event as Told
from planner.record.trace import Action, HeldUp
from tests.explain.causes.decisions import Driven, in_the_way
from tests.explain.facts.scenes import Actor, speeds, straight
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.driving.driving import reasons_for
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.restraints import lasted, restraint_at, slowed

BRAKING = ((0.0, 10.0), (4.0, 2.0), (9.0, 2.0))
OURS = Actor(speeds(0.0, 0.0, BRAKING))
AHEAD = Actor(straight(40.0, 0.0, 2.0))
ASIDE = Actor(straight(60.0, 30.0, 5.0, -math.pi / 2.0))
TURN: tuple[Told, ...] = (
    Told("action-started", 0.0, "exit-right", 0),
    Told("action-committed", 3.0, "exit-right", 0),
)
GIVEN_UP: tuple[Told, ...] = (
    Told("action-started", 0.0, "exit-right", 0),
    Told("action-ended", 2.0, "exit-right", 0),
    Told("action-started", 2.0, "continue", 2),
)


def by(time: float, kind: RestraintKind, vehicle: int | None = None) -> Told:
    """Tell that something keeps us from driving faster from a time [s] on."""
    return Told("restrained", time + SETTLED, vehicle=vehicle, by=kind)


def told(
    *events: Told,
    action: ActionName = "brake",
    span: tuple[float, float | None] = (0.0, 4.0),
    held: Sequence[HeldUp] = (),
    plan: tuple[Action, ...] = ("continue",),
    at: float | None = None,
) -> list[tuple[str, int | None]]:
    driven = Driven(
        {0: OURS, 1: AHEAD, 2: ASIDE},
        8.0,
        held=lambda _: held,
        plan=lambda _: plan,
        events=events,
    )
    whole = driven.ride()
    deed = Episode(Ego(), action, *span, speed_from=10.0)
    return [(c.kind, c.vehicle) for c in reasons_for(whole, World(whole), deed, at).causes]


def test_what_took_most_of_the_speed_is_the_reason() -> None:
    both = (by(0.0, "right-of-way", 2), by(3.2, "leader", 1))
    assert told(*both) == [("right-of-way", 2)]
    assert told(by(0.0, "right-of-way", 2), by(2.0, "leader", 1)) == [
        ("right-of-way", 2),
        ("leader", 1),
    ]


def test_who_would_hold_us_up_in_the_plan_alone_is_no_reason() -> None:
    imagined = (in_the_way(1, 0.0, 7.0),)
    assert told(by(0.0, "right-of-way", 2), held=imagined) == [("right-of-way", 2)]
    assert told(held=imagined) == [("leader", 1)]


@pytest.mark.parametrize(
    ("events", "reason"),
    [(TURN, "turn"), (GIVEN_UP, "given-up"), ((), "bend")],
)
def test_a_bend_is_the_turn_that_was_driven_then(events: Sequence[Told], reason: str) -> None:
    assert told(*events, by(0.5, "bend"), by(2.5, "nothing")) == [(reason, None)]


def test_what_goes_on_is_explained_by_its_last_seconds() -> None:
    changing = (by(0.0, "right-of-way", 2), by(5.5, "blocked", 1))
    assert told(*changing, action="stand", span=(0.0, None), at=8.0) == [("blocked", 1)]
    assert told(*changing, action="stand", span=(0.0, 6.0)) == [("right-of-way", 2)]


def test_a_stop_that_the_plan_decided_is_explained_by_the_decision() -> None:
    assert told(by(0.0, "stop"), plan=("stop",)) == told(plan=("stop",))


def test_who_stands_with_priority_makes_us_ready_to_give_way() -> None:
    assert told(by(0.0, "stands-first", 2)) == [("give-way-line", 2)]
    assert told(by(0.0, "beside-crossing", 1)) == [("hidden", 1)]


def test_restraints_last_from_when_they_began() -> None:
    events = (by(0.0, "leader", 1), by(2.0, "nothing"), by(3.0, "leader", 1))
    ride = Driven({0: OURS, 1: AHEAD}, 4.0, events=events).ride()
    found = {(one.by, one.vehicle): span for one, span in lasted(ride, 0.0, 4.0).items()}
    assert found == {("leader", 1): pytest.approx(3.0), ("nothing", None): pytest.approx(1.0)}
    lost = {one.by: speed for one, speed in slowed(ride, 0.0, 4.0).items()}
    assert lost == {"leader": pytest.approx(6.0), "nothing": pytest.approx(2.0)}
    now = restraint_at(ride, 2.5)
    assert now is not None
    assert now.by == "nothing"
    assert restraint_at(ride, -1.0) is None


def test_without_such_events_nothing_is_known() -> None:
    ride = Driven({0: OURS}, 4.0, events=TURN).ride()
    assert lasted(ride, 0.0, 4.0) == {}


def test_who_has_passed_does_not_hold_us_any_longer() -> None:
    crossed = (by(0.0, "right-of-way", 2), by(6.8, "leader", 1))
    assert told(*crossed, action="stand", span=(6.0, None), at=8.0) == [("leader", 1)]
    assert told(*crossed, action="stand", span=(6.0, 7.5)) == [("right-of-way", 2), ("leader", 1)]
