import random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from tests.traces import Aim, End, Way, World, random_world, s1_world, s2_world, trace_of
from xavi_dialogue.causal.effects import SCALES, effects, quantile
from xavi_dialogue.causal.holdups import colliding_choice, hold_ups
from xavi_dialogue.causal.mixtures import Result
from xavi_dialogue.causal.model import CausalModel, Intervention

worlds = st.integers(0, 10_000).map(lambda seed: random_world(random.Random(seed)))


def both(world, foil, fact, **settings):
    model = CausalModel(trace_of(world, **settings))
    return model.intervene(foil), model.intervene(fact)


def test_time_lost_behind_a_slowing_leader_is_positive():
    foil, fact = both(s1_world(), ("continue",), ("change-left",))
    time = next(e for e in effects(foil, fact) if e.component == "time")
    assert time.delta == pytest.approx(0.8 * 16.0 + 0.2 * 11.5 - 12.0)
    assert time.unit == "s"
    assert (time.low, time.high) == (pytest.approx(-0.5), pytest.approx(4.0))
    assert time.n_distinct == 4


def test_effects_change_sign_when_the_sides_are_swapped():
    foil, fact = both(s1_world(), ("continue",), ("change-left",))
    there = {e.component: e for e in effects(foil, fact)}
    back = {e.component: e for e in effects(fact, foil)}
    for name, effect in there.items():
        assert back[name].delta == pytest.approx(-effect.delta)
        assert back[name].low == pytest.approx(-effect.high)


def test_an_absent_component_has_no_effect():
    foil, fact = both(s1_world(), ("exit-right",), ("change-left",))
    assert effects(foil, fact) == ()


def test_presence_is_not_averaged_into_the_expectation():
    aims = {1: (Aim("stop", 0.5, (Way(("stop",)),)), Aim("continue", 0.5, (Way(("continue",)),)))}

    def simulate(plan, chosen):
        if plan == ("continue",) and chosen[1][0] == "stop":
            return End("collision", collided_with=1), 1
        return End(time=10.0 if plan == ("change-left",) else 8.0), 1

    foil, fact = both(
        World(aims, (("change-left",), ("continue",)), simulate), ("continue",), ("change-left",)
    )
    assert foil.outcomes["collision"] == pytest.approx(0.5)
    time = next(e for e in effects(foil, fact) if e.component == "time")
    assert time.delta == pytest.approx(-2.0)


@given(worlds)
def test_effects_agree_with_enumeration_and_are_ordered(world):
    model = CausalModel(trace_of(world))
    foil, fact = (model.intervene((plan[0],)) for plan in (world.plans[-1], world.plans[0]))
    found = effects(foil, fact)
    assert [e.size for e in found] == sorted((e.size for e in found), reverse=True)
    for effect in found:
        assert effect.low <= effect.delta <= effect.high
        assert effect.size == pytest.approx(abs(effect.delta) / SCALES[effect.component])
        expected = foil.expectation(effect.component) - fact.expectation(effect.component)
        assert effect.delta == pytest.approx(expected)


def test_quantile_takes_weights_into_account():
    values, weights = np.array([3.0, 1.0, 2.0]), np.array([0.04, 0.9, 0.06])
    assert quantile(values, weights, 0.05) == 1.0
    assert quantile(values, weights, 0.95) == 2.0
    assert quantile(values, weights, 0.97) == 3.0


def test_hold_ups_name_who_how_and_how_long():
    foil, fact = both(s1_world(), ("continue",), ("change-left",))
    assert hold_ups(fact) == {}
    found = hold_ups(foil)
    assert set(found) == {1}
    assert found[1].how == "leader"
    assert found[1].share == pytest.approx(0.8)
    assert found[1].duration == pytest.approx(5.0)
    assert (found[1].speed_from, found[1].speed_to) == (pytest.approx(9.4), pytest.approx(4.2))
    assert found[1].choice == (0, 0)


def test_hold_ups_by_right_of_way():
    fact, _ = both(s2_world(), ("exit-right",), ("stop",))
    assert hold_ups(fact)[1].how == "right-of-way"
    assert hold_ups(fact)[1].share == pytest.approx(0.15)
    assert hold_ups(fact)[1].choice == (1, 0)


def test_collisions_name_the_vehicle_and_its_choice():
    foil, _ = both(s1_world(cut_in_collides=True), ("continue",), ("change-left",))
    assert foil.likeliest == "collision"
    assert foil.collisions() == {1: pytest.approx(0.8)}
    assert colliding_choice(foil, 1) == (0, 0)
    assert colliding_choice(foil, 2) is None


def timed(rows):
    """Results in the first choice, second choice, ... of vehicle 1: choice -> weight, time [s]."""
    drive = trace_of(s1_world()).rollouts[0]
    results = [
        Result(((1, goal, 0),), replace(drive, outcome="done", components={"time": time}), 1, 1)
        for goal, (_, time) in rows.items()
    ]
    return Intervention(tuple(results), tuple(w for w, _ in rows.values()), ("continue",), 1.0)


@pytest.mark.parametrize(
    ("there", "here", "low", "high"),
    [
        ({0: (0.5, 12.0), 1: (0.5, 30.0)}, {0: (0.5, 10.0), 1: (0.5, 28.0)}, 2.0, 2.0),
        ({0: (0.2, 12.0), 1: (0.8, 30.0)}, {0: (1.0, 10.0)}, 2.0, 20.0),  # most has no partner
        ({0: (1.0, 12.0)}, {0: (0.2, 10.0), 1: (0.8, 30.0)}, -18.0, 2.0),
        ({0: (0.5, 12.0), 1: (0.5, 30.0)}, {0: (1.0, 10.0)}, 2.0, 11.0),  # half of it has one
    ],
)
def test_differences_are_by_sample_where_half_of_either_side_has_a_partner(there, here, low, high):
    (found,) = effects(timed(there), timed(here))
    assert (found.low, found.high) == (pytest.approx(low), pytest.approx(high))
