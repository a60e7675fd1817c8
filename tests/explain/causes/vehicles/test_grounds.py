"""How a belief of another vehicle grew, and what speaks for it."""

from collections.abc import Sequence
from dataclasses import replace as changed
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.trace import PlanTrace, Track
from sim.scene import VehicleState
from tests.explain.causes.decisions import decided, ride
from tests.explain.facts.scenes import Actor, made, shifted, speeds, straight
from tests.traces import Aim, End, Way, straight_track
from xavi_dialogue.domain.answers import NotRecorded
from xavi_dialogue.domain.knowing import Grounds
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.vehicles.grounds import grounds, to_macro
from xavi_dialogue.explain.history.ride import Ride, Unanswered

approx: Any = pytest.approx  # that compares within tuples, too


def believing(*aims: Aim, time: float = 4.0, **fields: object) -> PlanTrace:
    return decided({"continue": End()}, {1: aims}, [("continue",)], time=time, **fields)  # type: ignore[arg-type]


def growing(*chances: float, speeds: Sequence[float] = (10.0,), **fields: object) -> Ride:
    """Decisions each second from 4 s on, with how probable a turn to the left was held."""
    traces = []
    for k, chance in enumerate(chances):
        aims = (
            Aim("exit-left", chance, (Way(("exit-left",)),)),
            Aim("continue", 1.0 - chance, (Way(("continue",)),)),
        )
        trace = believing(*aims, time=4.0 + k, **fields)
        pace = speeds[min(k, len(speeds) - 1)]
        track = straight_track(4.0 + k, 1, [float(pace)] * 6)
        traces.append(replace(trace, history={**trace.history, 1: track}))
    return ride(*traces)


def told(whole: Ride, *names: ActionName, held: bool = True, moment: float = 99.0) -> Grounds:
    return grounds(whole, 1, names, min(moment, whole.now), held=held)


def test_where_the_odds_rose_most() -> None:
    found = told(growing(0.1, 0.5, 0.6, 0.95), "exit-left")
    assert (found.start, found.end) == (6.0, 7.0)  # from 1.5 to 19; before, from 0.11 to 1
    assert (found.before, found.after) == (approx(0.6), approx(0.95))
    assert (found.vehicle, found.actions, found.seen) == (1, ("exit-left",), False)
    assert found.since == 5.0
    assert found.history == tuple((4.0 + k, approx(p)) for k, p in enumerate((0.1, 0.5, 0.6, 0.95)))
    first = told(growing(0.1, 0.5, 0.5, 0.8), "exit-left")
    assert (first.start, first.end) == (4.0, 5.0)


def test_what_was_believed_all_along_has_no_rise() -> None:
    found = told(growing(0.9, 0.9, 0.8), "exit-left")
    assert (found.start, found.end, found.since, found.deed) == (4.0, 4.0, 4.0, None)
    assert (found.before, found.after) == (approx(0.9), approx(0.9))
    assert [time for time, _ in found.history] == [4.0, 6.0]
    assert told(growing(0.9, 0.4), "exit-left", held=False).since is None
    assert [t for t, _ in told(growing(0.3, 0.34, 0.36, 0.37), "exit-left").history] == [
        4.0,
        6.0,
        7.0,
    ]


def test_why_it_was_held_at_all_is_asked_of_when_it_was_held_most() -> None:
    whole = growing(0.2, 0.7, 0.8, 0.3)
    assert [t for t, _ in told(whole, "exit-left").history] == [4.0, 5.0, 6.0]
    assert [t for t, _ in told(whole, "exit-left", held=False).history] == [4.0, 5.0, 6.0, 7.0]
    assert [t for t, _ in told(growing(0.2, 0.4, 0.3), "exit-left").history] == [4.0, 5.0, 6.0]
    assert [t for t, _ in told(whole, "exit-left", moment=5.5).history] == [4.0, 5.0]


@pytest.mark.parametrize(
    ("speeds", "action"),
    [((10.0, 9.2), "slow-down"), ((10.0, 9.3), None), ((9.0, 9.8), "speed-up")],
)
def test_what_it_did_meanwhile(speeds: tuple[float, ...], action: str | None) -> None:
    found = told(growing(0.2, 0.8, speeds=speeds), "exit-left").deed
    assert (None if found is None else (found.action, found.begin, found.end)) == (
        action and (action, 4.0, 5.0)
    )
    if found is not None:
        assert (found.speed_from, found.speed_to) == speeds


def moving(track: Track) -> Ride:
    traces = []
    for time, chance in ((4.0, 0.2), (8.0, 0.8)):
        trace = believing(
            Aim("exit-left", chance, (Way(("exit-left",)),)),
            Aim("continue", 1.0 - chance, (Way(("continue",)),)),
            time=time,
        )
        traces.append(replace(trace, history={**trace.history, 1: part(track, time)}))
    return ride(*traces)


def part(track: Track, time: float) -> Track:
    count = round((time - track.start) / 0.2) + 1
    return Track(track.start, track.position[:count], track.heading[:count], track.speed[:count])


def test_a_lane_change_meanwhile_tells_more_than_a_speed() -> None:
    whole = made(
        {0: Actor(straight(0, 9, 5.0)), 1: Actor(shifted(straight(0.0, 0.0, 10.0), 4.5, 7.0, 3.5))},
        8.0,
    )
    track = whole.traces[-1].history[1]
    found = told(moving(track), "exit-left").deed
    assert found is not None
    assert (found.actor, found.action) == (Vehicle(1), "change-left")
    stopped = Track(0.0, track.position, (0.0,) * 41, (9.0,) * 25 + (4.0,) + (0.0,) * 15)
    found = told(moving(stopped), "exit-left").deed
    assert found is not None
    assert (found.action, found.standing) == ("stop", True)
    assert found.begin == approx(5.2)


def test_what_it_has_done_is_known_as_of_then() -> None:
    """It changed lanes by 7 s; what was believed later is no ground."""
    whole = made(
        {0: Actor(straight(0, 9, 5.0)), 1: Actor(shifted(straight(0.0, 0.0, 10.0), 3.0, 5.0, 3.5))},
        9.0,
    )
    late = told(whole, "change-left")
    assert late.seen
    assert [t for t, _ in late.history][-1] <= 6.0
    assert not told(whole, "change-right").seen


def test_somebody_who_stands_and_stays() -> None:
    aims = (Aim("stop", 0.6, (Way(("stop",)),)), Aim("continue", 0.4, (Way(("continue",)),)))
    trace = believing(*aims)
    still = replace(trace, history={**trace.history, 1: straight_track(4.0, 1, (0.0,) * 6)})
    found = told(ride(still), "wait")
    assert (found.seen, found.after) == (False, approx(0.6))
    assert found.actions == ("stop",)


def test_what_is_asked_openly_is_what_is_expected() -> None:
    assert told(growing(0.2, 0.8), "do").actions == ("exit-left",)
    assert told(growing(0.2, 0.3), "do").actions == ("continue",)


def test_what_cannot_be_told() -> None:
    with pytest.raises(Unanswered) as refused:
        grounds(growing(0.5), 7, ("exit-left",), 4.0)
    assert refused.value.result == NotRecorded("out-of-view", thing=Vehicle(7), since=4.0)
    with pytest.raises(Unanswered) as refused:
        told(growing(0.5), "follow")
    assert refused.value.result == NotRecorded("not-recorded", Vehicle(1), about="doing")


def fitting(
    mine: float, other: float, lights: tuple[float, float], shown: tuple[str, ...] = ()
) -> Grounds:
    """Likelihoods of turning left and going on, and how well the lights fit either."""
    whole = growing(0.2, 0.8)
    traces = []
    for trace in whole.traces:
        (known,) = trace.predictions
        goals = tuple(
            replace(g, likelihood=fit, indicators=i)
            for g, fit, i in zip(known.goals, (mine, other), lights, strict=True)
        )
        scene = {**trace.scene, 1: _lit(trace, shown)}
        traces.append(replace(trace, predictions=(replace(known, goals=goals),), scene=scene))
    return told(ride(*traces), "exit-left")


def _lit(trace: PlanTrace, shown: tuple[str, ...]) -> VehicleState:
    return changed(trace.scene[1], signals=shown)


@pytest.mark.parametrize(
    ("mine", "other", "lights", "fit"),
    [
        (0.8, 0.2, (1.0, 1.0), 4.0),
        (0.8, 0.2, (0.5, 1.0), 8.0),  # lights are a factor of the likelihood
        (0.8, 0.0005, (1.0, 1.0), None),
        (0.0, 0.2, (1.0, 1.0), None),
        (0.8, 0.2, (0.0, 1.0), None),
    ],
)
def test_how_much_better_its_path_fits(
    mine: float, other: float, lights: tuple[float, float], fit: float | None
) -> None:
    found = fitting(mine, other, lights)
    assert found.fit == (None if fit is None else approx(fit))
    assert found.rival == ("continue",)


def test_the_likeliest_goals_are_set_against_each_other() -> None:
    """Two by which it turns left, of which one may also go on, and two by which it does not."""
    known = (
        Aim("exit-left", 0.15, (Way(("exit-left",), 0.5), Way(("change-left", "continue"), 0.5))),
        Aim(
            "exit-left",
            0.35,
            (
                Way(
                    ("change-left", "exit-left"),
                ),
            ),
        ),
        Aim("stop", 0.1, (Way(("stop",)),)),
        Aim("continue", 0.4, (Way(("continue",)),)),
    )
    trace = believing(*known)
    (there,) = trace.predictions
    goals = tuple(
        replace(g, likelihood=fit) for g, fit in zip(there.goals, (0.1, 0.8, 0.9, 0.2), strict=True)
    )
    found = told(ride(replace(trace, predictions=(replace(there, goals=goals),))), "exit-left")
    assert (found.rival, found.fit) == (("continue",), approx(4.0))
    assert found.after == approx(0.425)
    only = told(ride(believing(known[1])), "exit-left")
    assert (only.rival, only.fit) == ((), None)


@pytest.mark.parametrize(
    ("lights", "shown", "light"),
    [
        ((0.9, 0.3), ("left",), "left"),
        ((0.9, 0.31), ("left",), None),
        ((0.9, 0.1), ("right", "brake"), "right"),
        ((0.9, 0.1), ("left", "right"), None),
        ((0.9, 0.1), (), None),
    ],
)
def test_an_indicator_that_speaks_for_it(
    lights: tuple[float, float], shown: tuple[str, ...], light: str | None
) -> None:
    assert fitting(0.5, 0.5, lights, shown).light == light


@pytest.mark.parametrize(
    ("names", "actions"),
    [
        (("turn", "exit-left"), ("exit-left",)),
        (("wait",), ("stop",)),
        (("speed-up",), ()),
        (("continue", "exit-straight"), ("exit-straight",)),
        (("stop", "stand"), ("stop",)),
    ],
)
def test_names_as_the_planners_actions(
    names: tuple[ActionName, ...], actions: tuple[ActionName, ...]
) -> None:
    assert to_macro(names) == actions


def test_of_equal_rises_the_first_counts() -> None:
    found = told(growing(0.2, 0.8, 0.2, 0.8), "exit-left")
    assert (found.start, found.end) == (4.0, 5.0)


def test_who_stopped_had_done_so_as_it_came_to_stand() -> None:
    """It stands from 6 s on; what was believed after that is no ground."""
    marks = ((0.0, 8.0), (2.0, 8.0), (6.0, 0.0))
    actors = {0: Actor(straight(0.0, 9.0, 5.0)), 1: Actor(speeds(0.0, 0.0, marks))}
    found = told(made(actors, 10.0), "give-way")
    assert (found.seen, found.history[-1][0]) == (False, 10.0)  # it stands still
    moving_on = ((0.0, 8.0), (2.0, 8.0), (6.0, 0.0), (8.0, 0.0), (12.0, 8.0))
    actors = {0: Actor(straight(0.0, 9.0, 5.0)), 1: Actor(speeds(0.0, 0.0, moving_on))}
    found = told(made(actors, 12.0), "stop")
    assert (found.seen, found.history[-1][0]) == (True, 6.0)
