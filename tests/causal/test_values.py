"""Small causal queries whose answers are worked out by hand."""

import math
from typing import Any

import numpy as np
import pytest
from msgspec.structs import replace

from planner.record.trace import HeldUp, HoldUp, PlanTrace
from planner.rollouts.reward import WEIGHTS
from tests.traces import Aim, End, Way, World, trace_of
from xavi_dialogue.causal.effects import SCALES, effects
from xavi_dialogue.causal.holdups import colliding_choice, hold_ups
from xavi_dialogue.causal.influence import Influence, divergence, holm, influence
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.causal.paper import PaperNetwork

approx: Any = pytest.approx  # that compares within tuples, too

CHANCES = (0.25, 0.75)
AIMS = {1: tuple(Aim("continue", p, (Way(("continue",)),), str(k)) for k, p in enumerate(CHANCES))}


def held(by: int, since: float, until: float, how: HoldUp = "leader", speed: float = 5.0) -> HeldUp:
    return HeldUp(by, since, until, how, speed, speed / 2.0)


def recorded(*ends: End) -> tuple[PlanTrace, Intervention]:
    """Going on, where the other vehicle does the one thing (25 %) or the other (75 %)."""
    world = World(AIMS, (("continue",),), lambda plan, chosen: (End(), 1))
    plain = trace_of(world)
    rows = tuple(
        replace(
            row,
            outcome=end.outcome,
            components=end.components,
            reward=end.reward,
            collided_with=end.collided_with,
            held_up=end.held_up,
        )
        for row, end in zip(plain.rollouts, ends, strict=True)
    )
    trace = replace(plain, rollouts=rows)
    found = CausalModel(trace).intervene(("continue",))
    assert found is not None
    return trace, found


def test_how_a_vehicle_holds_us_up() -> None:
    """For 4 s from 4 s on in a quarter, for 2 and 1 s from 5 s on in the rest."""
    _, plan = recorded(
        End(held_up=(held(1, 4.0, 8.0, speed=8.0),)),
        End(held_up=(held(1, 5.0, 7.0), held(1, 9.0, 10.0, "cut-in"))),
    )
    (one,) = hold_ups(plan).values()
    assert (one.vehicle, one.how, one.choice) == (1, "leader", (1, 0))
    assert one.share == approx(1.0)
    assert one.duration == approx(0.25 * 4.0 + 0.75 * 3.0)
    assert one.expected == approx(3.25)
    assert (one.speed_from, one.speed_to) == (5.0, 2.5)  # of the median, not a mean that is none
    assert (one.began, one.at_once) == (4.0, approx(0.25))


def test_of_several_stretches_of_one_kind_the_longest_counts() -> None:
    _, plan = recorded(
        End(held_up=(held(1, 7.0, 8.0, speed=9.0), held(1, 4.0, 6.0, speed=6.0))),
        End(),
    )
    (one,) = hold_ups(plan).values()
    assert (one.speed_from, one.began, one.at_once) == (6.0, 4.0, approx(1.0))
    assert (one.share, one.duration) == (approx(0.25), approx(3.0))


@pytest.mark.parametrize(
    ("window", "known"),
    [
        ((8.0, 9.0), True),
        ((8.1, 9.0), False),
        ((3.0, 4.0), True),
        ((3.0, 3.9), False),
        (None, True),
    ],
)
def test_hold_ups_within_a_window(window: tuple[float, float] | None, known: bool) -> None:
    _, plan = recorded(End(held_up=(held(1, 4.0, 8.0),)), End())
    assert bool(hold_ups(plan, window)) is known


def test_the_choice_that_is_collided_with_most() -> None:
    crash = End("collision", collided_with=1)
    assert colliding_choice(recorded(crash, crash)[1], 1) == (1, 0)
    assert colliding_choice(recorded(crash, End())[1], 1) == (0, 0)
    assert colliding_choice(recorded(End(), End())[1], 1) is None
    assert colliding_choice(recorded(crash, crash)[1], 2) is None


def test_a_mixture() -> None:
    _, plan = recorded(End("collision", collided_with=1), End(time=10.0, jerk=0.0))
    assert plan.outcomes["collision"] == approx(0.25)
    assert plan.likeliest == "done"
    assert plan.value == approx(-0.25 * 200.0 - 0.75 * 10.0)
    assert plan.presence("time") == approx(0.75)
    assert plan.expectation("time") == approx(10.0)
    assert plan.collisions() == {1: approx(0.25)}
    assert (plan.draws, plan.coverage) == (2, approx(1.0))
    assert plan.effective == approx(1.0 / (0.0625 + 0.5625))
    assert plan.error == 0.0
    _, never = recorded(End("dead"), End("dead"))
    assert never.expectation("time") is None


def test_the_bound_on_an_error() -> None:
    """Of twenty alike, covering half: sqrt(0.5 * ln 40 / 40); of two, all that is not covered."""
    _, plan = recorded(End(), End())
    many = Intervention(plan.results[:1] * 20, (0.05,) * 20, plan.plan, 0.5)
    assert many.effective == approx(20.0)
    assert many.error == approx(math.sqrt(0.5 * math.log(40.0) / 40.0))
    assert Intervention(plan.results, (0.5, 0.5), plan.plan, 0.9).error == approx(0.1)


@pytest.mark.parametrize(
    ("chances", "adjusted"),
    [
        ((0.01, 0.04, 0.03), (0.03, 0.06, 0.06)),  # the last one is no smaller than before it
        ((0.5, 0.6), (1.0, 1.0)),
        ((0.02,), (0.02,)),
        ((), ()),
    ],
)
def test_chances_are_adjusted_for_their_number(
    chances: tuple[float, ...], adjusted: tuple[float, ...]
) -> None:
    assert holm(chances) == approx(adjusted)


@pytest.mark.parametrize(("chance", "told"), [(0.05, True), (0.051, False)])
def test_what_exceeds_chance(chance: float, told: bool) -> None:
    assert Influence(1, 0.5, 0.01, (), (), chance).significant is told


def test_a_divergence_of_smoothed_distributions() -> None:
    """(1.001, 0.001) / 1.002 against halves: 0.99900 * log2(1.998) + 0.000998 * log2(0.001996)."""
    found = divergence(np.array([1.0, 0.0]), np.array([0.5, 0.5]))
    assert found == approx(0.9886, abs=2e-4)
    assert divergence(np.array([0.3, 0.7]), np.array([0.3, 0.7])) == approx(0.0)


def test_effects_are_ordered_by_what_the_planner_holds_them_worth() -> None:
    """A second of time is one; the others by what their weight makes of a ten-second drive."""
    assert SCALES["time"] == 1.0 / WEIGHTS["time"]
    for name in ("jerk", "angular-acceleration", "curvature"):
        assert SCALES[name] == approx(0.1 / WEIGHTS[name])
    _, fact = recorded(End(time=10.0, jerk=0.5), End(time=10.0, jerk=0.5))
    _, foil = recorded(End(time=11.0, jerk=0.5), End(time=12.0, jerk=0.5))
    time = next(e for e in effects(foil, fact) if e.component == "time")
    assert time.delta == approx(1.75)
    assert (time.low, time.high, time.n, time.n_distinct) == (1.0, 2.0, 4, 2)
    assert time.size == approx(1.75 * WEIGHTS["time"])


def test_one_option_leaves_nothing_to_bear_on() -> None:
    trace, plan = recorded(End(), End())
    assert influence(CausalModel(trace), (plan,)) == ()
    assert influence(CausalModel(trace)) == ()


def test_the_network_of_the_paper_multiplies_presences() -> None:
    """Half of the rollouts arrive; it takes each of four components to be there by itself."""
    trace, _ = recorded(End("collision", collided_with=1), End(time=10.0))
    paper = PaperNetwork(trace)
    found = paper.outcomes(("continue",))
    assert found["done"] == approx(0.5**4)
    assert (found["collision"], found["dead"]) == (0.5, 0.0)
    assert set(paper.outcomes(("stop",)).values()) == {0.0}
    assert paper.difference(("continue",), ("continue",), "time") == 0.0
    assert paper.difference(("continue",), ("stop",), "time") is None
    assert paper.divergence(1, (0, 0)) == approx(0.0)
