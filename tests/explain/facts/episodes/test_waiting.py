"""For whom somebody stands, and who holds somebody up in most of its drives imagined."""

import math
from dataclasses import dataclass
from dataclasses import replace as changed

import pytest
from msgspec.structs import replace

from planner.record.events import Event
from planner.record.places import PriorityFact, RoadFacts
from planner.record.trace import HeldUp, HoldUp, PlannedAction, PlanTrace
from tests.explain.facts.scenes import Actor, made, speeds, straight
from tests.traces import Aim, End, Way, trace_of
from tests.traces import World as Plain
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Feature, Vehicle
from xavi_dialogue.explain.facts.episodes import waiting
from xavi_dialogue.explain.facts.episodes.waiting import top_holders, waits
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.ride import Ride

STOPPING = ((0.0, 8.0), (2.0, 8.0), (6.0, 0.0))  # it stands from 6 s on


def held(by: int, since: float = 4.0, how: HoldUp = "leader") -> HeldUp:
    return HeldUp(by, since, since + 5.0, how, 5.0, 2.0)


def weighed(*drives: tuple[str, float | None, tuple[HeldUp, ...]]) -> PlanTrace:
    """A decision at 4 s to go on, of these drives: first action, weight, who is in the way."""
    plain = Plain({1: (Aim("continue", 1.0, (Way(("continue",)),)),)}, (("continue",),), done)
    trace = trace_of(plain)
    (row,) = trace.rollouts
    rows = tuple(
        replace(
            row,
            index=k,
            actions=(replace(row.actions[0], action=action),),
            weight=weight,
            held_up=by,
        )
        for k, (action, weight, by) in enumerate(drives)
    )
    return replace(trace, rollouts=rows)


def done(plan: object, chosen: object) -> tuple[End, int]:
    return End(), 1


def holders(trace: PlanTrace, vehicle: int = 0) -> tuple[tuple[int, str], ...]:
    return top_holders(States(made({0: Actor(straight(0.0, 0.0, 5.0))}, 1.0)), trace, vehicle)


@pytest.mark.parametrize(
    ("drives", "who"),
    [
        ((("continue", None, (held(1),)), ("continue", None, ())), ((1, "leader"),)),
        ((("continue", None, (held(1),)), *[("continue", None, ())] * 2), ()),
        ((("continue", None, (held(1),)), *[("stop", None, ())] * 2), ((1, "leader"),)),
        ((("continue", None, (held(1, 4.6),)),), ((1, "leader"),)),
        ((("continue", None, (held(1, 4.7),)),), ()),
        ((("continue", 0.6, (held(1),)), ("continue", 0.4, (held(2),))), ((1, "leader"),)),
        ((("continue", 0.3, (held(1),)), ("continue", None, ())), ((1, "leader"),)),
        (
            (("continue", None, (held(2), held(1))), ("continue", None, (held(2), held(2, 4.4)))),
            ((2, "leader"), (1, "leader")),
        ),
        (
            (("continue", None, (held(1), held(1, how="cut-in"))),),
            ((1, "cut-in"), (1, "leader")),
        ),
    ],
)
def test_who_holds_us_up_from_a_decision_on(
    drives: tuple[tuple[str, float | None, tuple[HeldUp, ...]], ...],
    who: tuple[tuple[int, str], ...],
) -> None:
    assert holders(weighed(*drives)) == who


def test_without_a_plan_nobody_is_in_its_way() -> None:
    trace = weighed(("continue", None, (held(1),)))
    assert holders(replace(trace, plan=())) == ()
    stop = (PlannedAction("stop", 0.0, 1),)
    assert holders(replace(trace, plan=stop)) == ()


def test_who_holds_another_one_up_is_predicted() -> None:
    """In two of its three ways it is held up by us: 0.4 + 0.6 * 0.5, later only in the last."""
    ways = (Way(("continue",), 0.5, held_up=(held(0),)), Way(("stop",), 0.5))
    aims = {
        1: (
            Aim("exit-left", 0.4, (Way(("exit-left",), held_up=(held(0), held(2, 4.7))),)),
            Aim("continue", 0.6, ways),
        )
    }
    trace = trace_of(Plain(aims, (("continue",),), done))
    assert holders(trace, 1) == ((0, "leader"),)
    assert holders(trace, 3) == ()
    less = trace_of(
        Plain(
            {1: (changed(aims[1][0], probability=0.1), changed(aims[1][1], probability=0.7))},
            (("continue",),),
            done,
        )
    )
    assert holders(less, 1) == ()


@dataclass(frozen=True)
class Standing:
    """We come to stand at 6 s; who is in our way as the decisions from some time on have it."""

    who: tuple[tuple[float, int], ...] = ()  # [s] from then on, by whom
    others: tuple[Actor, ...] = ()
    events: tuple[Event, ...] = ()
    until: float = 12.0

    def ride(self) -> Ride:
        """The ride, whose decisions know who is in the way."""
        ours = Actor(speeds(0.0, 0.0, STOPPING))
        plain = made(dict(enumerate((ours, *self.others))), self.until, events=self.events)
        traces = tuple(self._told(t) for t in plain.record.traces)
        return Ride(changed(plain.record, traces=traces))

    def _told(self, trace: PlanTrace) -> PlanTrace:
        now = [v for since, v in self.who if since <= trace.sim_time]
        by = (held(now[-1], trace.sim_time, "right-of-way"),) if now and now[-1] else ()
        return replace(trace, rollouts=tuple(replace(r, held_up=by) for r in trace.rollouts))

    def waits(self, vehicle: int = 0) -> list[tuple[object, ...]]:
        """What was waited for whom, from when to when."""
        found = waits(States(self.ride()), vehicle)
        return [(e.action, e.object, e.begin, e.end, e.how) for e in found]


def test_for_whom_we_stand() -> None:
    assert Standing(((7.0, 1),)).waits() == [("wait", Vehicle(1), 6.0, None, "right-of-way")]
    assert Standing(((5.0, 1), (8.0, 2))).waits() == [
        ("wait", Vehicle(1), 6.0, 8.0, "right-of-way"),
        ("wait", Vehicle(2), 8.0, None, "right-of-way"),
    ]
    assert Standing(((7.0, 1), (9.0, 0), (10.0, 1))).waits() == [
        ("wait", Vehicle(1), 6.0, None, "right-of-way")
    ]
    assert Standing(((5.0, 1), (6.0, 0))).waits() == [
        ("wait", Vehicle(1), 6.0, None, "right-of-way")
    ]
    assert Standing(((4.0, 1), (5.0, 0))).waits() == []  # over before we came to stand
    assert Standing().waits() == []


@pytest.mark.parametrize(
    ("x", "y", "turn", "waited"),
    [
        (40.0, 0.0, 0.0, True),  # our front is at 32 m; a gap of 3.2 m
        (48.7, 0.0, 0.0, True),
        (48.9, 0.0, 0.0, False),
        (40.0, 1.4, 0.0, True),
        (40.0, 1.6, 0.0, False),
        (20.0, 0.0, 0.0, False),
        (40.0, 0.0, 180.0, False),
    ],
)
def test_who_stands_right_ahead_is_waited_for(
    x: float, y: float, turn: float, waited: bool
) -> None:
    ahead = Actor(straight(x, y, 0.0, math.radians(turn)))
    found = Standing(others=(ahead,)).waits()
    assert found == ([("wait", Vehicle(1), 6.0, None, "leader")] if waited else [])


def test_the_nearest_ahead_is_waited_for() -> None:
    others = (Actor(straight(43.0, 0.0, 0.0)), Actor(straight(38.0, 0.0, 0.0)))
    assert Standing(others=others).waits() == [("wait", Vehicle(2), 6.0, None, "leader")]


def given(*times: tuple[float, int], until: float = 12.0) -> list[Episode]:
    events = tuple(Event("gave-way", time, vehicle=v) for time, v in times)
    found = waits(States(Standing(events=events, until=until).ride()), 0)
    return [e for e in found if e.action == "give-way"]


def test_way_was_given_from_slowing_down_to_driving_on() -> None:
    (found,) = given((4.0, 1))
    assert found.object == Vehicle(1)
    assert found.begin == pytest.approx(2.1, abs=0.2)
    assert found.end is None
    assert (found.speed_from, found.speed_to, found.standing) == (8.0, 0.0, True)
    assert (found.peak, found.how) == (2.0, "right-of-way")


def test_way_given_twice_to_one_is_told_once() -> None:
    assert [e.object for e in given((4.0, 1), (5.0, 1), (5.0, 2))] == [Vehicle(1), Vehicle(2)]


def test_way_given_before_is_another_matter() -> None:
    """At 0.4 s we had not slowed down, though we stood within eight seconds."""
    (found,) = given((0.4, 1))
    assert (found.begin, found.speed_from, found.standing) == (0.4, None, False)
    assert (found.speed_to, found.end) == (None, 0.4)


def test_whoever_way_was_given_to_is_not_waited_for_beside() -> None:
    events = (Event("gave-way", 4.0, vehicle=1), Event("gave-way", 5.0))
    assert [w[:2] for w in Standing(((7.0, 1),), events=events).waits()] == [
        ("give-way", Vehicle(1))
    ]
    assert [w[:2] for w in Standing(((7.0, 2),), events=events).waits()] == [
        ("give-way", Vehicle(1)),
        ("wait", Vehicle(2)),
    ]


# Others ------------------------------------------------------------------------------------


def other(how: HoldUp, path: Actor, until: float = 12.0) -> list[Episode]:
    """One who stands at the side from 6 s on, predicted to be held up by us; we drive past."""
    waiting = Way(("exit-left",), held_up=(HeldUp(0, 0.0, 30.0, how, 5.0, 2.0),))
    still = Actor(
        lambda t: (50.0, -10.0 - max(6.0 - t, 0.0) ** 2, math.pi / 2.0, 2.0 * max(6.0 - t, 0.0)),
        aims=(Aim("exit-left", 1.0, (waiting,)),),
    )
    return waits(States(made({0: path, 1: still}, until)), 1)


def test_who_is_predicted_to_wait_for_us() -> None:
    slow = Actor(straight(0.0, 0.0, 2.0))
    (found,) = other("right-of-way", slow)
    assert (found.action, found.object, found.sure) == ("give-way", Ego(), False)
    assert (found.begin, found.end, found.speed_to, found.standing) == (6.0, None, 0.0, True)
    (found,) = other("leader", slow)
    assert (found.action, found.how) == ("wait", "leader")


def test_waiting_is_over_once_the_one_waited_for_is_past() -> None:
    """We pass in front of it, and drive away with our back to it."""
    (found,) = other("right-of-way", Actor(straight(-10.0, 0.0, 7.0)), 14.0)
    assert found.end is not None
    assert 8.0 <= found.end <= 12.0


def test_who_stands_long_after_stood_for_something_else() -> None:
    assert other("right-of-way", Actor(straight(-10.0, 0.0, 7.0)), 20.0) == []


def test_who_was_past_before_was_not_waited_for() -> None:
    assert other("right-of-way", Actor(straight(80.0, 0.0, 7.0))) == []


@pytest.mark.parametrize(
    ("how", "lit", "left"),
    [
        ("right-of-way", (6.0, None), []),  # the light holds it all the time
        ("right-of-way", (6.0, 7.0), [(7.0, None)]),
        ("right-of-way", (6.0, 11.0), []),
        ("right-of-way", (10.5, None), [(6.0, 10.5)]),
        ("leader", (6.0, None), [(6.0, None)]),  # in a row at the light
    ],
)
def test_who_is_held_by_a_light_lets_nobody_go_first(
    monkeypatch: pytest.MonkeyPatch,
    how: HoldUp,
    lit: tuple[float, float | None],
    left: list[tuple[float, float | None]],
) -> None:
    red = Episode(Vehicle(1), "wait", *lit, Feature("light"), standing=True)
    monkeypatch.setattr(waiting, "waits_at_lights", lambda *_: iter((red,)))
    held_up = Way(("exit-left",), held_up=(HeldUp(2, 0.0, 30.0, how, 5.0, 2.0),))
    still = Actor(
        lambda t: (50.0, -10.0 - max(6.0 - t, 0.0) ** 2, math.pi / 2.0, 2.0 * max(6.0 - t, 0.0)),
        aims=(Aim("exit-left", 1.0, (held_up,)),),
    )
    crossing = Actor(straight(50.0, 0.0, 0.0))
    ride = made({0: Actor(straight(0.0, 0.0, 2.0)), 1: still, 2: crossing}, 12.0)
    found = [e for e in waits(States(ride), 1) if e.object == Vehicle(2)]
    assert [(e.begin, e.end) for e in found] == left


@pytest.mark.parametrize(
    ("since", "until", "begin"), [(0.0, 99.0, 6.0), (8.0, 99.0, 8.0), (0.0, 10.0, None)]
)
def test_who_stands_while_we_go_first_lets_us_go(
    since: float, until: float, begin: float | None
) -> None:
    """By the rules we go first from some time to another [s]; only up to the end counts."""

    def roads(time: float) -> RoadFacts:
        rules = (PriorityFact(1, "ego"),) if since <= time <= until else (PriorityFact(2, "ego"),)
        return RoadFacts({}, priority=rules)

    still = Actor(
        lambda t: (90.0, -10.0 - max(6.0 - t, 0.0) ** 2, math.pi / 2.0, 2.0 * max(6.0 - t, 0.0))
    )
    ride = made({0: Actor(straight(0.0, 0.0, 3.0)), 1: still}, 12.0, roads=roads)
    found = [e for e in waits(States(ride), 1) if e.action == "give-way"]
    assert [(e.object, e.begin, e.end, e.sure, e.how) for e in found] == (
        [] if begin is None else [(Ego(), begin, None, False, "right-of-way")]
    )
