"""The comparisons with the oracle notice what is broken on purpose."""

import random
from dataclasses import replace

import numpy as np
import pytest

from tests.causal import checks
from tests.traces import ragged_trace
from xavi_dialogue.causal import effects, holdups, influence, model, seeing

TRACES = [ragged_trace(seed) for seed in range(30)]
SUPPOSED = [checks.some_choices(trace, random.Random(k)) for k, trace in enumerate(TRACES)]


def each_plan(check):
    def check_all():
        for trace in TRACES:
            for plan in checks.plans(trace):
                check(trace, plan)

    return check_all


def interventions():
    for trace, supposed in zip(TRACES, SUPPOSED, strict=True):
        for do in ({}, {1: "continue"}, {2: "exit-right"}, {1: "change-left", 2: "continue"}):
            checks.intervention(trace, do)
            checks.intervention(trace, do, supposed)


def seen():
    for trace, supposed in zip(TRACES, SUPPOSED, strict=True):
        for outcome in (None, "done", "collision"):
            checks.seen(trace, {1: "continue"}, supposed, outcome)
        checks.policy(trace)


def influences():
    for trace in TRACES[:12]:
        checks.influence(trace)


mixtures = each_plan(checks.mixture)
held_up = each_plan(lambda trace, plan: checks.hold_ups(trace, plan, (5.0, 7.0)))
effect_sizes = each_plan(lambda trace, plan: checks.effects(trace, plan, checks.plans(trace)[0]))
EVERY = (interventions, mixtures, effect_sizes, held_up, seen, influences)


def wrap(owner, name, change):
    """Replace a function or method by a changed one; `change` gets the original."""
    return lambda patch: patch.setattr(owner, name, change(getattr(owner, name)))


def value(owner, name, new):
    return lambda patch: patch.setattr(owner, name, new)


def unshuffled(_, rest):
    return np.repeat(rest[:, None], influence.PERMUTATIONS, axis=1)


def swapped(found):
    """What was found of each vehicle, laid at the door of the next."""
    names = list(found)
    return dict(sorted(zip(names[1:] + names[:1], found.values(), strict=True)))


def scaled_weights(original):
    def follow(self, plan):
        found = original(self, plan)
        return found and replace(found, weights=tuple(0.5 * w for w in found.weights))

    return follow


def by_draws(original):
    def follow(self, plan):
        found = original(self, plan)
        if found is None:
            return None
        return replace(found, weights=tuple(r.draws / found.draws for r in found.results))

    return follow


def zero_where_absent(_):
    def present(self, component):
        return [
            (r.joint, w, r.rollout.components.get(component) or 0.0)
            for r, w in zip(self.results, self.weights, strict=True)
        ]

    return present


def negated(original):
    return lambda *sides: tuple(replace(e, delta=-e.delta) for e in original(*sides))


def one_rollout_each(original):
    return lambda *sides: tuple(replace(e, n=e.n_distinct) for e in original(*sides))


def unweighted(original):
    return lambda values, weights, share: original(values, np.ones_like(weights), share)


def of_the_next(original):
    def measure(network, vehicle, draws):
        names = network.vehicles
        other = names[(names.index(vehicle) + 1) % len(names)]
        return replace(original(network, other, draws), vehicle=vehicle)

    return measure


def unadjusted(original):
    def fit(self, vehicle):
        every = self.columns
        self.columns = {vehicle: every[vehicle]}
        found = original(self, vehicle)
        self.columns = every
        return found

    return fit


MUTANTS = {
    "the sign of effects": (wrap(effects, "effects", negated), effect_sizes),
    "foil and fact change places": (
        wrap(effects, "effects", lambda original: lambda foil, fact: original(fact, foil)),
        effect_sizes,
    ),
    "repeats do not count": (wrap(effects, "effects", one_rollout_each), effect_sizes),
    "ranges are not weighted": (wrap(effects, "quantile", unweighted), effect_sizes),
    "ranges are never paired": (value(effects, "PAIRED", 2.0), effect_sizes),
    "effects are ordered the other way": (
        wrap(effects, "effects", lambda original: lambda *s: original(*s)[::-1]),
        effect_sizes,
    ),
    "what is absent is zero": (wrap(model.Mixture, "present", zero_where_absent), mixtures),
    "presence is not weighed": (
        value(model.Mixture, "presence", lambda self, c: len(self.present(c)) / len(self.results)),
        mixtures,
    ),
    "two vehicles are swapped where they collide": (
        wrap(model.Mixture, "collisions", lambda original: lambda self: swapped(original(self))),
        mixtures,
    ),
    "two vehicles are swapped where they hold up": (
        wrap(holdups, "hold_ups", lambda original: lambda *a: swapped(original(*a))),
        held_up,
    ),
    "the window of hold-ups is ignored": (
        wrap(holdups, "hold_ups", lambda original: lambda found, _: original(found)),
        held_up,
    ),
    "the prior is dropped": (
        value(model.CausalModel, "_probability", lambda self, joint, index: 0.1),
        interventions,
    ),
    "weights are not normalised": (
        wrap(model.CausalModel, "_follow", scaled_weights),
        interventions,
    ),
    "draws weigh instead of the prior": (
        wrap(model.CausalModel, "_follow", by_draws),
        interventions,
    ),
    "undrawn samples are forgotten": (
        value(model, "shared_out", lambda priors, draws, mass=1.0: priors),
        interventions,
    ),
    "undrawn samples are shared out evenly": (
        value(model, "_undrawn", lambda prior, draws: 1.0),
        interventions,
    ),
    "the continuation seen once may be the best": (value(model, "SUPPORT", 0.0), interventions),
    "only the continuation seen most may be": (value(model, "SUPPORT", 1.0), interventions),
    "what is fixed deeper down is ignored": (
        wrap(
            model,
            "_agrees",
            lambda original: lambda plan, do: original(plan, {k: do[k] for k in do if k == 1}),
        ),
        interventions,
    ),
    "evidence does not renormalise": (
        wrap(
            model,
            "_choices",
            lambda original: (
                lambda trace, given: {
                    v: {c: p for c, p in known.items() if c in original(trace, given)[v]}
                    for v, known in original(trace, {}).items()
                }
            ),
        ),
        interventions,
    ),
    "forced rollouts count as the search's": (
        wrap(
            model,
            "Result",
            lambda original: lambda joint, first, draws, _: original(joint, first, draws, draws),
        ),
        seen,
    ),
    "evidence on the outcome is ignored": (
        wrap(
            seeing.Evidence,
            "allows",
            lambda original: lambda self, r: original(replace(self, outcome=None), r),
        ),
        seen,
    ),
    "evidence on the others is ignored": (
        wrap(
            seeing.Evidence,
            "allows",
            lambda original: lambda self, r: original(replace(self, choices={}), r),
        ),
        seen,
    ),
    "actions are counted from 0": (
        wrap(seeing, "_at", lambda original: lambda plan, depth: original(plan, depth + 1)),
        seen,
    ),
    "the softmax is sharper": (value(influence, "RATIONALITY", 2.0), influences),
    "two vehicles are swapped where they decide": (
        wrap(influence, "_measure", of_the_next),
        influences,
    ),
    "the others are not adjusted for": (wrap(influence._Draws, "fit", unadjusted), influences),
    "many tests are taken for one": (value(influence, "holm", tuple), influences),
    "draws are not shuffled": (value(influence._Draws, "permuted", unshuffled), influences),
}


@pytest.mark.parametrize("check", EVERY, ids=lambda check: getattr(check, "__name__", ""))
def test_nothing_is_found_where_nothing_is_broken(check):
    check()


@pytest.mark.parametrize("name", MUTANTS)
def test_what_is_broken_is_noticed(name, monkeypatch):
    mutate, check = MUTANTS[name]
    mutate(monkeypatch)
    with pytest.raises(AssertionError):
        check()
