"""Why we braked, stood or sped up: by who was in the way, and by the road."""

import math
from collections.abc import Sequence
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Told
from planner.record.places import PriorityFact, RoadFacts, RoadPlace, RouteStep
from planner.record.trace import HeldUp
from tests.explain.causes.decisions import Driven, in_the_way
from tests.explain.facts.scenes import Actor, speeds, straight
from tests.traces import Actions, Aim, Way
from xavi_dialogue.domain.answers import Cause, Mechanism, MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.driving.driving import as_of, beside, motion_cause, reasons_for
from xavi_dialogue.explain.causes.driving.slowness import Slowness, slowness
from xavi_dialogue.explain.causes.driving.yielding import close_leader
from xavi_dialogue.explain.causes.plans.contrast import factual
from xavi_dialogue.explain.facts.world import World

approx: Any = pytest.approx  # that compares within tuples, too

OURS = Actor(straight(0.0, 0.0, 10.0))


AHEAD = Actor(straight(30.0, 0.0, 10.0))


def road(limit: float = 14.0, *steps: RouteStep, first: Sequence[int] = ()) -> RoadFacts:
    rules = tuple(PriorityFact(v, "vehicle") for v in first)
    return RoadFacts({0: RoadPlace("a", 0, 1, limit, False, False)}, steps, priority=rules)


def step(distance: float, turn: str = "exit-straight", rule: str = "give-way") -> RouteStep:
    return RouteStep(distance, "junction", turn, None, None, 4, rule)  # type: ignore[arg-type]


def slow(
    ours: float,
    *others: Actor,
    limit: float | None = 14.0,
    held: Sequence[HeldUp] = (),
    plan: Actions = ("continue",),
    time: float = 4.0,
) -> Slowness:
    driven = Driven(
        dict(enumerate((Actor(straight(0.0, 0.0, ours)), *others))),
        6.0,
        held=lambda _: held,
        plan=lambda _: plan,
        roads=lambda _: None if limit is None else road(limit),
    )
    whole = driven.ride()
    return slowness(whole, World(whole), time)


def told(found: Slowness) -> list[tuple[object, ...]]:
    return [(c.kind, c.vehicle, c.value, c.speed) for c in found.reasons.causes]


def braked(
    held: Sequence[HeldUp] = (),
    *others: Actor,
    action: ActionName = "slow-down",
    end: float | None = 6.0,
    facts: RoadFacts | None = None,
    events: Sequence[Told] = (),
    plan: Actions = ("continue",),
) -> list[tuple[str, int | None]]:
    """Why we slowed down from 4 s on."""
    driven = Driven(
        dict(enumerate((OURS, *others))),
        8.0,
        held=lambda _: held,
        plan=lambda _: plan,
        roads=lambda _: facts,
        events=events,
    )
    whole = driven.ride()
    deed = Episode(Ego(), action, 4.0, end, speed_from=10.0)
    return [(c.kind, c.vehicle) for c in reasons_for(whole, World(whole), deed).causes]


def test_who_was_in_the_way_is_the_reason() -> None:
    by = (in_the_way(1, 4.0, 7.0),)
    assert braked(by, AHEAD) == [("leader", 1)]
    assert braked((in_the_way(1, 4.0, 7.0, "cut-in"),), AHEAD) == [("leader", 1)]
    assert braked((in_the_way(1, 6.9, 9.0),), AHEAD) == [("leader", 1)]
    assert braked((in_the_way(1, 7.1, 9.0),), AHEAD) == [("plan", None)]
    assert braked((in_the_way(1, 0.0, 2.9),), AHEAD) == [("plan", None)]
    assert braked((), AHEAD) == [("plan", None)]
    assert braked(by, AHEAD, action="speed-up") == [("plan", None)]


def test_beside_it_the_road_may_be_one() -> None:
    turn = road(14.0, step(30.0, "exit-left", "priority"))
    line = road(14.0, step(30.0, rule="equal"))
    by = (in_the_way(1, 4.0, 7.0),)
    assert braked(by, AHEAD, facts=turn) == [("leader", 1), ("turn", None)]
    assert braked(by, AHEAD, facts=turn, action="follow") == [("leader", 1)]
    assert braked(by, AHEAD, facts=line) == [("leader", 1)]
    assert braked((), AHEAD, facts=turn) == [("turn", None)]
    assert braked((), plan=("exit-left",)) == [("turn", None)]


@pytest.mark.parametrize(
    ("time", "known"), [(1.1, True), (0.9, False), (6.0, True), (6.1, False), (5.0, True)]
)
def test_whom_we_gave_way_to_is_the_reason(time: float, known: bool) -> None:
    """Up to three seconds before it, or within it; as the events tell, whatever was imagined."""
    aside = Actor(straight(60.0, 30.0, 5.0, -math.pi / 2.0))
    found = braked((), aside, events=(Told("gave-way", time, vehicle=1),))
    assert found == ([("right-of-way", 1)] if known else [("plan", None)])
    faster = braked((), aside, action="speed-up", events=(Told("gave-way", time, vehicle=1),))
    assert faster == [("plan", None)]


def test_who_leads_us_already_was_given_way_to_before() -> None:
    events = (Told("gave-way", 3.0, vehicle=1),)
    assert braked((), AHEAD, events=events) == [("plan", None)]
    assert braked((), AHEAD, events=(Told("gave-way", 5.0, vehicle=1),)) == [("right-of-way", 1)]


def test_who_was_given_way_to_comes_first() -> None:
    aside = Actor(straight(60.0, 30.0, 5.0, -math.pi / 2.0))
    events = (Told("gave-way", 5.0, vehicle=2),)
    held = (in_the_way(1, 4.0, 9.0), in_the_way(2, 4.0, 5.0, "cut-in"))
    assert braked(held, AHEAD, aside, events=events) == [("right-of-way", 2), ("leader", 1)]


def test_a_line_to_give_way_at_names_whom_it_is_for() -> None:
    aside = Actor(straight(60.0, 30.0, 5.0, -math.pi / 2.0))
    line = road(14.0, step(30.0))
    assert braked((), aside, facts=line, end=None) == [("give-way-line", None)]
    one = road(14.0, step(30.0), first=(1,))
    assert braked((), aside, facts=one) == [("give-way-line", 1)]
    two = road(14.0, step(30.0), first=(1, 2))
    assert braked((), aside, aside, facts=two, end=None) == [("give-way-line", None)]
    some = (in_the_way(2, 4.0, 4.3, "right-of-way"),)
    assert braked(some, aside, aside, facts=two) == [("give-way-line", 2)]


def test_a_line_that_is_here_comes_after_the_way_behind_it() -> None:
    """With nobody to let go first, and nothing to say how far it is."""
    both = road(14.0, step(4.0, "exit-left"))
    assert braked((), facts=both, end=None) == [("turn", None), ("give-way-line", None)]
    far = road(14.0, step(30.0, "exit-left"))
    assert braked((), facts=far, end=None) == [("give-way-line", None), ("turn", None)]


def test_where_the_plan_is_not_known_the_road_is_told() -> None:
    assert braked((), plan=("change-right",)) == [("plan", None)]
    assert braked((in_the_way(1, 4.0, 7.0),), AHEAD, plan=("exit-right",)) == [("turn", None)]


def test_the_decision_that_was_held_up_most_tells() -> None:
    """At 5 s somebody is in the way; a second before and after nobody."""

    def held(time: float) -> Sequence[HeldUp]:
        return (in_the_way(1, time, time + 3.0),) if time == 5.0 else ()

    whole = Driven({0: OURS, 1: AHEAD}, 8.0, held=held).ride()
    deed = Episode(Ego(), "slow-down", 4.0, 6.0, speed_from=10.0)
    found = reasons_for(whole, World(whole), deed)
    assert (found.trace.sim_time, [c.vehicle for c in found.causes]) == (5.0, [1])
    longer = Driven(
        {0: OURS, 1: AHEAD},
        8.0,
        held=lambda t: (in_the_way(1, t, t + {4.0: 5.0, 5.0: 4.2, 6.0: 3.9}.get(t, 0.0)),),
    ).ride()
    assert reasons_for(longer, World(longer), deed).trace.sim_time == 5.0  # late, and as long
    free = Driven({0: OURS}, 8.0).ride()
    assert reasons_for(free, World(free), deed).trace.sim_time == 6.0


def test_a_stop_is_told_by_the_decision_for_it() -> None:
    ours = Actor(speeds(0.0, 0.0, ((0.0, 10.0), (3.0, 10.0), (7.0, 0.0))))
    events = (Told("action-started", 3.0, "stop", 3), Told("action-committed", 3.2, "stop", 3))

    def plan(time: float) -> Actions:
        return ("stop", "continue") if time >= 3.0 else ("continue",)

    def at(begin: float, end: float, also: Sequence[Told] = ()) -> float:
        whole = Driven({0: ours}, 10.0, plan=plan, events=(*events, *also)).ride()
        deed = Episode(Ego(), "slow-down", begin, end, speed_from=10.0)
        return reasons_for(whole, World(whole), deed).trace.sim_time

    assert at(3.0, 7.0) == 3.0
    assert at(0.0, 2.9) == 2.0  # it was over when the stop was begun
    ended = (Told("action-ended", 5.0, "stop", 3),)
    assert at(5.4, 5.6, ended) == 3.0
    assert at(5.6, 7.0, ended) == 7.0  # half a second after it was given up
    assert at(4.0, 12.0, ended) == 10.0  # asked of 8 s: that is long over


def test_speeds_are_those_of_then_or_of_now() -> None:
    """The leader slows by 0.5 m/s in each second, from 10 m/s: its lowest, or what it is now."""
    leader = Actor(speeds(30.0, 0.0, ((0.0, 10.0), (20.0, 0.0))))
    whole = Driven({0: OURS, 1: leader}, 8.0, held=lambda t: (in_the_way(1, t, t + 9.0),)).ride()
    for end, speed in ((6.0, 7.0), (7.5, 6.3), (None, 6.0)):
        episode = Episode(Ego(), "slow-down", 4.0, end, speed_from=10.0)
        found = reasons_for(whole, World(whole), episode)
        assert [c.speed for c in found.causes] == [approx(speed)]
        assert found.cleared == ()


def test_of_several_who_were_let_go_the_one_asked_about_counts() -> None:
    crossing = Actor(straight(60.0, 30.0, 5.0, -math.pi / 2.0))
    events = (Told("gave-way", 5.0, vehicle=1), Told("gave-way", 5.5, vehicle=2))
    whole = Driven({0: OURS, 1: crossing, 2: crossing}, 8.0, events=events).ride()
    for thing, vehicle in ((Vehicle(1), 1), (None, 2), (Vehicle(7), 2)):
        episode = Episode(Ego(), "slow-down", 4.0, 6.0, thing, speed_from=10.0)
        found = reasons_for(whole, World(whole), episode)
        assert [c.vehicle for c in found.causes] == [vehicle]


def test_what_was_thought_of_who_was_let_go_is_told() -> None:
    aims = (
        Aim("exit-left", 0.3, (Way(("exit-left",)),)),
        Aim("continue", 0.7, (Way(("continue",)),)),
    )
    crossing = Actor(straight(60.0, 30.0, 5.0, -math.pi / 2.0), aims=aims)
    events = (Told("gave-way", 5.0, vehicle=1),)
    whole = Driven({0: OURS, 1: crossing}, 8.0, events=events).ride()
    (cause,) = reasons_for(whole, World(whole), deed()).causes
    assert (cause.actions, cause.probability) == (("continue",), approx(0.7))
    leader = Actor(straight(30.0, 0.0, 9.0), aims=aims)
    slow_one = slow(9.0, leader)
    (cause,) = slow_one.reasons.causes
    assert (cause.actions, cause.probability) == (("continue",), approx(0.7))


def test_the_middle_of_speeding_up_tells() -> None:
    whole = Driven({0: OURS}, 9.0).ride()
    episode = Episode(Ego(), "speed-up", 4.0, 8.0, speed_from=10.0)
    assert reasons_for(whole, World(whole), episode).trace.sim_time == 6.0


def test_leaders_who_drew_away_are_no_reason() -> None:
    fast, slow_one = Actor(straight(30.0, 0.0, 12.5)), Actor(straight(50.0, 0.0, 11.5))
    whole = Driven({0: OURS, 1: fast, 2: slow_one}, 6.0).ride()
    causes = tuple(MotionCause("leader", vehicle=v) for v in (1, 2))
    assert [(c.vehicle, c.speed) for c in as_of(whole, causes, 4.0)] == [(2, 11.5)]
    cut_in = (MotionCause("cut-in", vehicle=1),)
    assert as_of(whole, cut_in, 4.0) == (replace(cut_in[0], speed=12.5),)
    assert as_of(whole, (MotionCause("turn"),), 4.0) == (MotionCause("turn"),)


def test_a_plan_is_no_reason_beside_who_makes_no_difference() -> None:
    plan, turn = MotionCause("plan"), MotionCause("turn")
    assert beside((plan,), ()) == (plan,)
    assert beside((plan,), (1,)) == ()
    assert beside((plan, turn), (1,)) == (plan, turn)


@pytest.mark.parametrize(
    ("how", "actions", "x", "y", "first", "kind"),
    [
        ("leader", ("continue",), 30.0, 0.0, (), "leader"),
        ("collision", ("continue",), 30.0, 0.0, (), "no-room"),
        ("blocked", ("continue",), 30.0, 0.0, (), "blocked"),
        ("leader", ("continue",), 30.0, 9.0, (1,), "right-of-way"),
        ("leader", ("continue",), 30.0, 0.0, (1,), "leader"),
        ("leader", ("continue",), 30.0, 9.0, (), "leader"),
        ("leader", ("change-right",), 30.0, 9.0, (), "cut-in"),
        ("leader", ("change-right",), 30.0, 0.0, (), "leader"),
        ("cut-in", ("exit-left",), 30.0, 9.0, (1,), "right-of-way"),
        (None, ("continue",), 30.0, 0.0, (), "leader"),
    ],
)
def test_how_somebody_held_us_up(
    how: str | None, actions: Actions, x: float, y: float, first: Sequence[int], kind: str
) -> None:
    whole = Driven(
        {0: OURS, 1: Actor(straight(x, y, 10.0))}, 6.0, roads=lambda _: road(first=first)
    ).ride()
    mechanism = None if how is None else Mechanism(how, None, None, 2.0, 1.0)  # type: ignore[arg-type]
    cause = Cause(1, actions, 0.7, mechanism, necessary=True)
    found = motion_cause(whole, World(whole), cause, whole.traces[4], 4.0)
    assert (found.kind, found.vehicle, found.actions, found.probability) == (kind, 1, actions, 0.7)
    assert (found.did, found.necessary) == (None, True)


def test_what_it_did_since_is_told() -> None:
    stops = Actor(speeds(30.0, 0.0, ((0.0, 10.0), (3.0, 10.0), (5.0, 0.0))))
    whole = Driven({0: OURS, 1: stops}, 7.0).ride()
    cause = Cause(1, (), 1.0, Mechanism("leader", None, None, 2.0, 1.0))
    found = motion_cause(whole, World(whole), cause, whole.traces[4], 4.0)
    assert found.did is not None
    assert (found.did.action, found.did.begin) == ("stop", 5.0)
    assert motion_cause(whole, World(whole), cause, whole.traces[6], 6.0).did is None


@pytest.mark.parametrize(
    ("x", "share", "told"),
    [(34.7, True, True), (34.9, True, False), (30.0, False, False), (-20.0, True, False)],
)
def test_who_is_close_ahead_and_holds_us_up(x: float, share: bool, told: bool) -> None:
    """29.9 m are three seconds at 10 m/s."""
    held = (in_the_way(1, 4.0, 7.0),) if share else (in_the_way(1, 4.0, 7.0, "right-of-way"),)
    whole = Driven({0: OURS, 1: Actor(straight(x, 0.0, 10.0))}, 6.0, held=lambda _: held).ride()
    trace = whole.traces[4]
    model = whole.model(trace)
    found = close_leader(World(whole), model, factual(model, trace), 4.0, 10.0)
    assert (found is not None) is told
    slow_one = close_leader(World(whole), model, factual(model, trace), 4.0, None)
    assert slow_one is None  # farther than 12 m


def deed(begin: float = 4.0, end: float | None = 6.0) -> Episode:
    return Episode(Ego(), "slow-down", begin, end, speed_from=10.0)
