import random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.traces import Aim, End, Way, World, random_world, s1_world, s2_world, trace_of
from xavi_dialogue.causal.influence import divergence, holm, influence
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.causal.paper import PaperNetwork


def contrast(world, fact, foil, **settings):
    model = CausalModel(trace_of(world, **settings))
    return {i.vehicle: i for i in influence(model, [model.intervene(fact), model.intervene(foil)])}


def test_the_vehicle_that_matters_is_told_from_the_one_that_does_not():
    for seed in range(20):
        found = contrast(s1_world(), ("change-left",), ("continue",), draws=40, seed=seed)
        assert found[1].significant
        assert not found[2].significant
        assert found[2].bits == pytest.approx(0.0, abs=1e-9)


def test_swapping_two_vehicles_swaps_their_influence():
    world = s1_world()
    swapped = World(
        {1: world.aims[2], 2: world.aims[1]},
        world.plans,
        lambda plan, chosen: world.simulate(plan, {1: chosen[2], 2: chosen[1]}),
    )
    found = contrast(swapped, ("change-left",), ("continue",), draws=40)
    assert not found[1].significant
    assert found[2].significant


def test_least_divergent_choice_is_the_one_that_explains():
    found = contrast(s2_world(), ("exit-right",), ("stop",), draws=60)
    assert found[1].significant
    best = found[1].choices[0]
    assert best.choice == (0, 0)
    assert best.probability == pytest.approx(0.85)
    assert best.options[0] > found[1].options[0]
    assert not found[2].significant


def test_an_impossible_foil_is_nobodys_doing():
    found = contrast(s2_world(), ("exit-right",), ("exit-straight",), draws=60)
    assert not any(i.significant for i in found.values())


def test_bits_agree_with_enumeration_for_one_vehicle():
    found = contrast(s1_world(), ("change-left",), ("continue",), draws=60)[1]
    p_turn, p_on = (1 / (1 + np.exp(-x)) for x in (4.2, -0.3))
    pooled = 0.8 * p_turn + 0.2 * p_on
    expected = sum(
        w * (p * np.log2(p / pooled) + (1 - p) * np.log2((1 - p) / (1 - pooled)))
        for w, p in ((0.8, p_turn), (0.2, p_on))
    )
    assert found.bits == pytest.approx(expected)
    assert found.options[0] == pytest.approx(pooled)


@given(st.integers(0, 10_000))
def test_influence_is_bounded_and_repeatable(seed):
    trace = trace_of(random_world(random.Random(seed)), draws=12)
    once, again = (influence(CausalModel(trace)) for _ in range(2))
    assert once == again
    for found in once:
        assert 0.0 <= found.bits <= np.log2(max(len(found.options), 2)) + 1e-9
        assert sum(found.options) == pytest.approx(1.0)
        assert sum(c.probability for c in found.choices) == pytest.approx(1.0)
        assert [round(c.divergence, 6) for c in found.choices] == sorted(
            round(c.divergence, 6) for c in found.choices
        )


def test_false_alarms_are_rare_even_where_others_interact():
    # Vehicles 1 and 2 matter jointly and not additively; 3 to 6 never matter.
    coin = (Aim("stop", 0.5, (Way(("stop",)),)), Aim("continue", 0.5, (Way(("continue",)),)))

    def simulate(plan, chosen):
        both = chosen[1][0] == chosen[2][0]
        return End(time=16.0 if plan == ("continue",) and both else 12.0), 1

    world = World(dict.fromkeys(range(1, 7), coin), (("change-left",), ("continue",)), simulate)
    alarms = [
        vehicle
        for seed in range(25)
        for vehicle, found in contrast(
            world, ("change-left",), ("continue",), draws=40, seed=seed
        ).items()
        if vehicle > 2 and found.significant
    ]
    assert len(alarms) <= 10  # 5 % of 100 in the long run; 10 is exceeded in 1 % of such counts


KINDS = ("stop", "continue", "exit-left", "exit-right")
NULLS = 150  # records of one number of draws


def one_that_never_matters(seed, nulls, draws):
    """Whether any of some vehicles is told to matter that never do, in a record of chance."""
    dice = random.Random(f"null/{seed}/{nulls}")

    def aims(count):
        cuts = [dice.randint(2, 9) for _ in range(count)]
        return tuple(
            Aim(KINDS[k], cut / sum(cuts), (Way((KINDS[k],)),)) for k, cut in enumerate(cuts)
        )

    def simulate(plan, chosen):  # 1 and 2 matter, each in the light of the other
        state = random.Random(f"{seed}/{plan}/{chosen[1]}/{chosen[2]}")
        return End(time=round(max(16.0 + state.gauss(0.0, 2.0), 1.0), 3)), 1

    everybody = {v: aims(4 if v < 3 else dice.randint(2, 3)) for v in range(1, nulls + 3)}
    world = World(everybody, (("change-left",), ("continue",)), simulate)
    found = contrast(world, ("change-left",), ("continue",), draws=draws, seed=seed)
    return any(one.significant for vehicle, one in found.items() if vehicle > 2)


@pytest.mark.parametrize("draws", [8, 12, 20])
def test_false_alarms_in_the_family_are_five_percent_at_most_from_eight_draws_on(draws):
    alarms = sum(one_that_never_matters(seed, 2 + seed % 3, draws) for seed in range(NULLS))
    assert alarms <= 13  # at 5 % of 150 more than 13 come in 2.3 % of such counts


def test_p_values_are_adjusted_step_by_step_as_by_holm():
    # Holm 1979: 0.01 of 4 is 0.04; 0.03 of 3 is 0.09; 0.04 of 2 is 0.08, below the one before.
    assert holm([0.04, 0.01, 0.03, 0.5]) == pytest.approx((0.09, 0.04, 0.09, 0.5))
    assert holm([]) == ()
    assert holm([0.6, 0.7]) == (1.0, 1.0)


def test_divergence_is_zero_only_for_equal_distributions():
    p, q = np.array([0.7, 0.3]), np.array([1.0, 0.0])
    assert divergence(p, p) == 0.0
    assert 0.0 < divergence(p, q) < 10.0


def test_papers_factorisation_multiplies_what_is_not_independent():
    coin = (Aim("stop", 0.5, (Way(("stop",)),)), Aim("continue", 0.5, (Way(("continue",)),)))

    def simulate(plan, chosen):
        if chosen[1][0] == "stop":
            return End("collision", collided_with=1), 1
        return End(time=10.0), 1

    trace = trace_of(World({1: coin}, (("continue",),), simulate))
    paper = PaperNetwork(trace).outcomes(("continue",))
    ours = CausalModel(trace).intervene(("continue",))
    assert paper["done"] == pytest.approx(0.5**4)
    assert paper["collision"] == pytest.approx(0.5)
    assert ours.outcomes["done"] == pytest.approx(0.5)
    assert ours.outcomes["collision"] == pytest.approx(0.5)


def test_papers_sign_is_the_opposite_of_ours():
    trace = trace_of(s1_world())
    printed = PaperNetwork(trace).difference(("change-left",), ("continue",), "time")
    assert printed is not None
    assert printed < 0.0
    # Unweighted: the mean over whatever was drawn, 13.75 s instead of 15.1 s.
    assert printed == pytest.approx(12.0 - 13.75)


def test_visit_counts_do_not_show_influence():
    network = PaperNetwork(trace_of(s1_world()))
    assert network.divergence(1, (0, 0)) == pytest.approx(0.0)
    assert network.divergence(2, (0, 0)) == pytest.approx(0.0)
