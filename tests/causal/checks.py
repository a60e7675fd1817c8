"""The comparisons of the causal room with the oracle, one for each kind of query."""

import numpy as np
import pytest

from planner.record.trace import COMPONENTS
from tests.causal import oracle
from xavi_dialogue.causal import effects as effect_module
from xavi_dialogue.causal import holdups, seeing
from xavi_dialogue.causal import influence as influence_module
from xavi_dialogue.causal.model import CausalModel


def close(found):
    return pytest.approx(found, abs=1e-9)


def plans(trace, *, every=False):
    """The complete plans of a record that there is a mixture for; with `every`, all."""
    known = dict.fromkeys(row[0] for row in oracle.rows_of(trace))
    return [plan for plan in known if every or oracle.mixture(trace, plan) is not None]


def some_choices(trace, rng):
    """What some of the others are confined to."""
    found = {}
    for known in trace.predictions:
        ways = [len(goal.trajectories) for goal in known.goals]
        every = [(g, t) for g, count in enumerate(ways) for t in range(count)]
        if rng.random() < 0.5:
            found[known.vehicle] = frozenset(rng.sample(every, rng.randint(1, len(every))))
    return found


def same_rows(mixture, rows):
    assert [r.rollout.index for r in mixture.results] == [row[2].index for _, row in rows]
    assert [r.draws for r in mixture.results] == [row[3] for _, row in rows]
    assert list(mixture.weights) == close([w for w, _ in rows])


def intervention(trace, do, given=None):
    found, expected = CausalModel(trace, given).intervene(do), oracle.intervene(trace, do, given)
    assert (found is None) == (expected is None)
    if found is not None:
        assert found.plan == expected[0]
        same_rows(found, expected[1])
        prior = oracle.prior_of(trace, given)
        assert found.coverage == close(sum(prior[row[1]] for _, row in expected[1]))
        assert found.value == close(sum(w * row[2].reward for w, row in expected[1]))


def exactly(trace, plan):
    """A plan as the room and as the oracle have it, with nothing left open."""
    model, rows = CausalModel(trace), oracle.mixture(trace, plan)
    found = model.intervene(plan)
    return (found, rows) if found is not None and found.plan == plan else (None, rows)


def mixture(trace, plan):
    found, rows = exactly(trace, plan)
    if found is None:
        return
    assert found.outcomes == close(oracle.outcomes(rows))
    assert sum(found.outcomes.values()) == close(1.0)
    assert found.collisions() == close(oracle.collisions(rows))
    for name in COMPONENTS:
        there = oracle.values_of(rows, name)
        assert found.presence(name) == close(sum(w for w, _, _ in there))
        expected = oracle.expectation(rows, name)
        assert found.expectation(name) == (None if expected is None else close(expected))
    for vehicle in {row[2].collided_with for _, row in rows} - {None}:
        hit = [(w, row) for w, row in rows if row[2].collided_with == vehicle]
        choices = oracle.marginal(hit, lambda row, v=vehicle: choice_in(row[1], v))
        likeliest = holdups.colliding_choice(found, vehicle)
        assert choices[likeliest] == close(max(choices.values()))


def choice_in(joint, vehicle):
    return next((g, t) for v, g, t in joint if v == vehicle)


def effects(trace, foil, fact):
    (there, foil_rows), (here, fact_rows) = exactly(trace, foil), exactly(trace, fact)
    if there is None or here is None:
        return
    found = {e.component: e for e in effect_module.effects(there, here)}
    for name in COMPONENTS:
        expected = oracle.effect(foil_rows, fact_rows, name)
        assert (name in found) == (expected is not None)
        if expected is not None:
            e = found[name]
            assert (e.delta, e.low, e.high) == close(expected[:3])
            assert (e.n, e.n_distinct) == expected[3:]
    sizes = [abs(e.delta) / effect_module.SCALES[e.component] for e in found.values()]
    assert sizes == sorted(sizes, reverse=True)


def hold_ups(trace, plan, window):
    found, rows = exactly(trace, plan)
    if found is None:
        return
    expected = oracle.hold_ups(rows, window)
    held = holdups.hold_ups(found, window)
    assert list(held) == list(expected)
    for vehicle, (how, share, duration, start, lowest, choice) in expected.items():
        one = held[vehicle]
        assert (one.how, one.choice) == (how, choice)
        assert (one.share, one.duration) == close((share, duration))
        assert (one.speed_from, one.speed_to) == close((start, lowest))
        assert one.expected == close(share * duration)


def influence(trace):
    model = CausalModel(trace)
    options = [found for action in model.options() if (found := model.intervene((action,)))]
    if len(options) < 2:
        assert influence_module.influence(model) == ()
        return
    sides = [oracle.intervene(trace, dict(enumerate(option.plan, 1)))[1] for option in options]
    shuffles = []
    for side in sides:
        keys = [_keys(trace, row) for _, row in side]
        shuffles.append(np.argsort(np.vstack(keys), axis=0))
    found = influence_module.influence(model)
    assert [f.bits for f in found] == sorted((f.bits for f in found), reverse=True)
    ranked = sorted(one.chance for one in found)
    steps = [min((len(ranked) - k) * p, 1.0) for k, p in enumerate(ranked)]
    for one in found:
        assert one.adjusted == close(max(steps[: ranked.index(one.chance) + 1]))
    for one in found:
        bits = oracle.influence(trace, one.vehicle, sides)
        assert one.bits == pytest.approx(max(bits, 0.0), abs=1e-6)
        if bits < influence_module.MIN_BITS + 1e-6:
            continue
        here, null = oracle.chance_information(trace, one.vehicle, sides, shuffles)
        clear = [x for x in null if abs(x - here) > 1e-7]
        least = 1 + sum(x > here for x in clear)
        total = influence_module.PERMUTATIONS + 1
        assert least / total <= one.chance + 1e-9
        assert one.chance <= (least + len(null) - len(clear)) / total + 1e-9
        assert sum(c.probability for c in one.choices) == close(1.0)


def _keys(trace, row):
    """The random numbers that belong to a sample, by which draws are shuffled."""
    flat = [number for choice in sorted(row[1]) for number in choice]
    rng = np.random.default_rng((trace.seed, trace.decision, *flat))
    return rng.random((row[3], influence_module.PERMUTATIONS))


def seen(trace, actions, choices, outcome):
    search = seeing.Search(CausalModel(trace))
    found = search.see(seeing.Evidence(actions, choices, outcome))
    chance, rows = oracle.seen(trace, actions, choices, outcome)
    assert (found is None) == (chance == 0.0)
    if found is None:
        return
    assert found.probability == close(chance)
    assert {r.rollout.index: w for r, w in zip(found.results, found.weights, strict=True)} == close(
        {row[2].index: w for w, row in rows}
    )
    assert found.outcomes == close(oracle.outcomes(rows))
    assert found.plans() == close(oracle.marginal(rows, lambda row: row[0]))
    for depth in (1, 2, 3):
        expected = oracle.marginal(rows, lambda r, d=depth: r[0][d - 1] if d <= len(r[0]) else None)
        assert found.actions(depth) == close(expected)
    for known in trace.predictions:
        v = known.vehicle
        expected = oracle.marginal(rows, lambda row, v=v: choice_in(row[1], v))
        assert found.choices(v) == close(expected)
        expected = oracle.marginal(rows, lambda row, v=v: choice_in(row[1], v)[0])
        assert found.goals(v) == close(expected)


def policy(trace):
    search = seeing.Search(CausalModel(trace))
    prior = oracle.prior_of(trace)
    drawn = {row[1] for row in oracle.rows_of(trace) if row[4] > 0}
    assert search.coverage == close(sum(prior[joint] for joint in drawn))
    for joint in prior:
        only = {v: frozenset({(g, t)}) for v, g, t in joint}
        _, rows = oracle.seen(trace, choices=only)
        assert search.policy(joint) == close(oracle.marginal(rows, lambda row: row[0]))


def total(trace):
    """p(O) from p(O | w) and p(w), and p(G) from p(G | O) and p(O)."""
    search = seeing.Search(CausalModel(trace))
    every = search.see()
    if every is None:
        return
    outcomes = dict.fromkeys(every.outcomes, 0.0)
    for action, chance in every.actions(1).items():
        part = search.see(seeing.Evidence({1: action}))
        assert part.probability == close(chance)
        for name, p in part.outcomes.items():
            outcomes[name] += chance * p
    assert outcomes == close(every.outcomes)
    vehicle, goals = trace.predictions[0].vehicle, {}
    for name, chance in every.outcomes.items():
        part = search.see(seeing.Evidence(outcome=name))
        assert (part is None) == (chance == 0.0)
        for goal, p in part.goals(vehicle).items() if part is not None else ():
            goals[goal] = goals.get(goal, 0.0) + chance * p
    assert goals == close(every.goals(vehicle))
