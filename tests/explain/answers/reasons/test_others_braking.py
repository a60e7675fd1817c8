"""Why another vehicle brakes, stands, waits or does not go; asked at 20 s."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.stated import aim, decision, driven, look, result, scene, they
from tests.traces import Way
from xavi_dialogue.domain.answers import (
    DidNotHappen,
    MotionCause,
    NeedRollout,
    NoSuchVehicle,
    OtherReason,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import At, Ego, Event, Vehicle
from xavi_dialogue.explain.answers.reasons import others as room
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.causes.driving.hindrance import Hindrance

IT, OTHER, US = Vehicle(1), Vehicle(2), Ego()
SEEN = {1: look(1), 2: look(2)}
SAID = Span(4.0, 6.0, said=True)
LEADER = MotionCause("leader", vehicle=2)
NOBODY = Hindrance()
STOPS, BRAKES = they(1, "stop", 8.0, 12.0), they(1, "brake", 4.0, 7.0)
STANDS, SLOWS = they(1, "stop", 15.0), they(1, "brake", 18.0)


class Ways:
    """Who is in the way: as it stood, slowed, or at present; what was asked is kept."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.stood = self.slowed = self.present = NOBODY
        self.rule: tuple[float, str] | None = None
        self.asked: list[Any] = []
        patch.setattr(room, "stood", lambda _, *args: self._tell("stood", *args))
        patch.setattr(room, "slowed", lambda _, *args: self._tell("slowed", *args))
        patch.setattr(room, "at_present", lambda _, *args: self._tell("present", *args))
        patch.setattr(room, "rule_between", self._rule)

    def _tell(self, name: str, *args: Any) -> Any:
        self.asked.append((name, *args))
        return getattr(self, name)

    def _rule(self, _: Any, vehicle: int, about: Any) -> Any:
        self.asked.append(("rule", vehicle, about.begin, about.end))
        return self.rule


@pytest.fixture
def ways(monkeypatch: pytest.MonkeyPatch) -> Ways:
    return Ways(monkeypatch)


def why(event: Event, *episodes: Episode, span: Span | None = None, no: bool = False, **more: Any) -> Any:  # fmt: skip  # noqa: E501
    asked = scene(span, **({"looks": SEEN, "episodes": episodes} | more))
    return result(lambda: room.why(event, asked, negated=no))


def does(action: Any, **more: Any) -> Event:
    return Event(action, IT, **more)


BY = Hindrance((LEADER,))
ROWS = ("stop", "stand", "wait", "give-way", "let-go", "block")


@pytest.mark.parametrize("action", [*ROWS, "brake", "slow-down"])
def test_who_stops_or_slows_has_somebody_in_its_way(ways: Ways, action: Any) -> None:
    ways.stood = ways.slowed = BY
    found = why(does(action), STOPS, BRAKES)
    deed = STOPS if action in ROWS else BRAKES
    assert found == OtherReason(1, deed, None, (LEADER,), evidence=BY.evidence)
    asked = ("stood", 1, 8.0) if deed is STOPS else ("slowed", 1, 4.0, 7.0)
    assert ways.asked == [asked]


@pytest.mark.parametrize(
    ("event", "episode", "speed", "asked"),
    [
        (does("stop"), BRAKES, 9.0, True),
        (does("stop"), BRAKES, 1.5, True),
        (does("stop"), BRAKES, 1.4, False),
        (does("stop"), BRAKES, (9.0,) * 20 + (1.4,), False),
        (does("brake"), STOPS, 9.0, True),
        (does("brake"), STOPS, 0.0, False),
        (does("brake"), STOPS, None, True),
    ],
)
def test_what_it_did_instead_is_told_with_what_was_asked(
    ways: Ways, event: Event, episode: Episode, speed: Any, asked: bool
) -> None:
    ways.stood = ways.slowed = BY
    motions = {} if speed is None else {1: driven((0.0,) * 21, speed=speed)}
    found = why(event, episode, motions=motions)
    assert (found.deed, found.asked) == (episode, event if asked else None)


@pytest.mark.parametrize(
    ("event", "episodes", "span", "deed"),
    [
        (does("stop"), (STOPS, STANDS), None, STANDS),
        (does("stop"), (STOPS, STANDS), SAID, None),
        (does("stop"), (BRAKES, STANDS), SAID, BRAKES),
        (does("stop", tense="present"), (STOPS,), None, None),
        (does("stop", tense="present"), (STOPS, STANDS), None, STANDS),
        (does("brake", tense="present"), (they(1, "brake", 15.0, 18.0),), None, 0),
        (does("brake", tense="present"), (they(1, "brake", 15.0, 17.9),), None, None),
        (does("stop"), (they(2, "stop", 8.0),), None, None),
    ],
)
def test_the_last_of_its_time_is_meant(
    ways: Ways, event: Event, episodes: Any, span: Any, deed: Any
) -> None:
    ways.stood = ways.slowed = BY
    found = why(event, *episodes, span=span)
    if deed is None:
        assert isinstance(found, DidNotHappen)
        assert found.asked == event
    else:
        assert found.deed == (episodes[0] if deed == 0 else deed)


@pytest.mark.parametrize(
    ("event", "episode", "span", "asked"),
    [
        (does("stop"), STANDS, None, [("stood", 1, 15.0), ("present", 1, 20.0, 0.3)]),
        (does("stop"), STOPS, SAID, [("stood", 1, 6.0), ("present", 1, 5.0, 0.3)]),
        (does("stop"), STOPS, None, [("stood", 1, 8.0)]),
        (does("brake"), SLOWS, None, [("slowed", 1, 18.0, 20.0), ("present", 1, 20.0, 0.3)]),
        (does("brake"), BRAKES, SAID, [("slowed", 1, 4.0, 7.0), ("present", 1, 5.0, 0.3)]),
        (does("brake"), BRAKES, None, [("slowed", 1, 4.0, 7.0)]),
    ],
)
def test_who_is_in_the_way_now_counts_where_nobody_was(
    ways: Ways, event: Event, episode: Episode, span: Any, asked: Any
) -> None:
    ways.present = BY
    if span is not None and episode is STOPS:
        episode = they(1, "stop", 6.0, 12.0)
    found = why(event, episode, span=span)
    met = len(asked) == 2
    assert found.causes == ((LEADER,) if met else ())
    rule = ("rule", 1, episode.begin, episode.end)
    assert ways.asked == (asked if met else [*asked, rule])


def test_who_is_known_to_be_in_the_way_is_not_looked_for(ways: Ways) -> None:
    ways.stood = ways.slowed = BY
    why(does("stop"), STANDS)
    why(does("brake"), SLOWS)
    assert [one[0] for one in ways.asked] == ["stood", "slowed"]


@pytest.mark.parametrize(
    ("rule", "owes"),
    [
        ((10.0, "priority"), True),
        ((5.0, "priority"), True),
        ((4.9, "priority"), False),
        ((15.0, "priority"), True),
        ((15.1, "priority"), False),
        ((10.0, "give-way"), False),
        (None, False),
    ],
)
def test_who_has_to_let_us_go_waits_for_us(ways: Ways, rule: Any, owes: bool) -> None:
    ways.rule = rule
    found = why(does("stop"), STOPS)
    assert found.causes == ((MotionCause("right-of-way", 0),) if owes else ())
    assert ways.asked[-1] == ("rule", 1, 8.0, 12.0)
    ongoing = why(does("stop"), STANDS)
    assert ways.asked[-1] == ("rule", 1, 15.0, 20.0)
    assert ongoing.deed == STANDS


# Giving way -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("event", "episodes", "whom"),
    [
        (does("give-way"), (they(1, "give-way", 8.0, 9.0, object=OTHER),), 2),
        (does("stop"), (they(1, "wait", 8.0, 9.0, object=US), STOPS), 0),
        (does("let-go"), (they(1, "wait", 8.0, 9.0, object=OTHER),), 2),
        (does("brake"), (they(1, "give-way", 8.0, 9.0, object=OTHER), BRAKES), None),
        (does("stop"), (they(1, "wait", 8.0, 9.0), STOPS), None),
        (does("stop", time=At(5.0)), (they(1, "wait", 8.0, 9.0, object=OTHER), STOPS), 2),
    ],
)
def test_whom_it_let_go_first_is_why(
    ways: Ways, event: Event, episodes: Any, whom: int | None
) -> None:
    found = why(event, *episodes)
    told = (MotionCause("right-of-way", whom),) if whom is not None else ()
    assert found.causes == told
    assert found.deed == (episodes[0] if whom is not None else episodes[1])
    assert found.asked is None


def test_who_waits_for_us_in_its_way_need_not_let_us_go_first(ways: Ways) -> None:
    blocked = they(1, "wait", 8.0, 9.0, object=US, how="blocked")
    assert why(does("stand"), blocked, STOPS).causes == (MotionCause("blocked", 0),)
    given = replace(blocked, action="give-way", how="right-of-way")
    assert why(does("stand"), given, STOPS).causes == (MotionCause("right-of-way", 0),)


# Not going --------------------------------------------------------------------------------------


@pytest.mark.parametrize("action", ["go", "move", "enter", "pull-out", "cross", "speed-up"])
def test_who_does_not_go_stands_for_somebody(ways: Ways, action: Any) -> None:
    ways.stood = BY
    event = does(action, tense="present")
    found = why(event, STANDS, no=True)
    assert (found.deed, found.asked, found.causes) == (STANDS, event, (LEADER,))
    plain = why(does("turn", tense="present"), STANDS, no=True)
    assert plain.asked == does("turn", tense="present")


def test_who_goes_after_all_is_told_so(ways: Ways) -> None:
    went = they(1, "go", 9.0, 11.0)
    assert why(does("go"), went, no=True) == DidNotHappen(does("go"), (went,))
    left = they(1, "change-left", 15.0, 16.0)
    found = why(does("speed-up"), left, no=True)
    assert (found.deed, found.asked, found.causes) == (None, does("speed-up"), ())


def test_rollouts_that_are_needed_are_asked_for(ways: Ways, monkeypatch: pytest.MonkeyPatch) -> None:  # fmt: skip  # noqa: E501
    def needs(*_: Any) -> Any:
        raise Unanswered(NeedRollout("t4"))

    monkeypatch.setattr(room, "stood", needs)
    assert why(does("go"), STANDS, no=True) == NeedRollout("t4")


# What goes with it ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("goal", "told"),
    [
        (("exit-left",), True),
        (("exit-right",), True),
        (("stop",), True),
        (("continue", "exit-left"), True),
        (("continue",), False),
    ],
)
def test_the_goal_is_told_of_who_turns_off(ways: Ways, goal: Any, told: bool) -> None:
    ways_ = (aim(goal[-1], 0.8, ways=(Way(goal),)), aim("change-left", 0.2))
    traces = (decision(6.0, aims={1: ways_}),)
    for episode in (STOPS, BRAKES):
        found = why(does(episode.action), episode, traces=traces).goal
        assert (None if found is None else found.expectations[0].actions) == (
            goal if told else None
        )


def test_the_speed_of_who_is_in_the_way_is_of_then_or_of_now(ways: Ways) -> None:
    ways.stood = BY
    motions = {2: driven((0.0,) * 21, speed=tuple(float(k) for k in range(21)))}
    assert why(does("stop"), STOPS, motions=motions).causes == (replace(LEADER, speed=8.0),)
    assert why(does("stop"), STANDS, motions=motions).causes == (replace(LEADER, speed=20.0),)
    assert isinstance(why(does("stop"), STOPS, looks={2: look(2)}), NoSuchVehicle)


@pytest.mark.parametrize(
    ("vehicle", "kind", "moved", "cut"),
    [
        (0, "leader", they(0, "change-left", 5.0, 6.0), True),
        (0, "leader", they(0, "change-left", 9.0, 10.0), True),
        (0, "leader", they(0, "change-left", 9.1, 10.0), False),
        (0, "leader", they(0, "pull-out", 4.0, 6.0), True),
        (0, "leader", they(0, "enter", 3.9, 6.0), False),
        (0, "leader", they(0, "brake", 5.0, 6.0), False),
        (0, "leader", they(2, "change-left", 5.0, 6.0), False),
        (2, "leader", they(0, "change-left", 5.0, 6.0), False),
        (0, "right-of-way", they(0, "change-left", 5.0, 6.0), False),
    ],
)
def test_who_moves_in_ahead_of_somebody_cuts_in(
    ways: Ways, vehicle: int, kind: Any, moved: Episode, cut: bool
) -> None:
    if moved.actor == Vehicle(0):
        moved = replace(moved, actor=US)
    ways.stood = Hindrance((MotionCause(kind, vehicle=vehicle),))
    (cause,) = why(does("stop"), STOPS, moved).causes
    assert cause == MotionCause("cut-in" if cut else kind, vehicle=vehicle)
