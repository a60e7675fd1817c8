"""How far estimates are from the truth, and that the bounds on that hold."""

import random

import pytest

from planner.record.trace import OUTCOMES
from tests.traces import Aim, End, Way, World, joints, prior, random_world, trace_of
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.explain.history.ride import MIN_COVERAGE, MIN_DISTINCT, enough


def wide_world(seed: int) -> World:
    """A vehicle that matters, and one with forty ways that do too: coverage stays low."""
    chance = random.Random(seed).uniform(0.1, 0.9)
    kinds = (("stop", chance), ("continue", 1.0 - chance))
    ways = tuple(Way(("continue",), 1.0 / 40.0) for _ in range(40))
    aims = {
        1: tuple(Aim(kind, p, (Way((kind,)),)) for kind, p in kinds),
        2: (Aim("continue", 1.0, ways),),
    }

    def simulate(plan, chosen):
        dice = random.Random(f"{seed}/{plan}/{chosen}")
        collides = dice.random() < (0.8 if chosen[1][0] == "stop" else 0.1)
        return End("collision" if collides else "done", collided_with=1 if collides else None), 1

    return World(aims, (("continue",),), simulate)


def truth(world, plan):
    found = dict.fromkeys(OUTCOMES, 0.0)
    for joint in joints(world.aims):
        chosen = {v: (world.aims[v][g].kind, way) for v, g, way in joint}
        found[world.simulate(plan, chosen)[0].outcome] += prior(world.aims, joint)
    return found


def errors(world, draws, records):
    """(largest error of an outcome's probability, estimate) over plans and records."""
    known = {plan: truth(world, plan) for plan in world.plans}
    for seed in range(records):
        model = CausalModel(trace_of(world, draws=draws, seed=seed))
        for plan in world.plans:
            found = model.intervene(plan)
            if found is not None and found.plan == plan:
                yield max(abs(found.outcomes[o] - known[plan][o]) for o in OUTCOMES), found


@pytest.mark.parametrize("draws", [2, 5, 11, 40])
def test_the_bound_holds_for_nearly_all_records(draws):
    made = [errors(random_world(random.Random(s)), draws, 4) for s in range(20)]
    made += [errors(wide_world(seed), draws, 12) for seed in range(20)]
    rows = [row for found in made for row in found]
    assert len(rows) > 300
    assert sum(error > found.error + 1e-9 for error, found in rows) <= 0.05 * len(rows)
    assert any(error > 0.5 * found.error > 0.0 for error, found in rows)


def test_the_thresholds_bound_the_error_by_a_half():
    rows = [row for seed in range(20) for row in errors(wide_world(seed), 12, 8)]
    rows += [
        row
        for seed in range(20)
        for n in (2, 4)
        for row in errors(random_world(random.Random(seed)), n, 4)
    ]
    kept = [(error, found) for error, found in rows if enough(found)]
    assert 100 < len(kept) < len(rows)
    assert max(error for error, _ in kept) <= 0.5 + 1e-9
    assert max(error for error, found in rows if not enough(found)) > 0.5
    covered = [found for _, found in kept if found.coverage >= MIN_COVERAGE]
    assert max(found.error for found in covered) <= 0.5
    alike = [f for _, f in kept if len(f.results) >= MIN_DISTINCT and f.effective >= MIN_DISTINCT]
    assert all(found.error <= 0.41 for found in alike)


def test_what_is_covered_in_full_is_exact():
    world = random_world(random.Random(4))
    for plan in world.plans:
        found = CausalModel(trace_of(world)).intervene(plan)
        assert found.error == pytest.approx(0.0, abs=1e-9)
