import pytest

from planner.trace import HeldUp
from tests.traces import Aim, End, Way, World, trace_of
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.explain.causes import contrastive_causes, holding_up

COIN = (Aim("stop", 0.5, (Way(("stop",)),)), Aim("continue", 0.5, (Way(("continue",)),)))


def causes(aims, simulate, **settings):
    world = World(aims, (("change-left",), ("continue",)), simulate)
    model = CausalModel(trace_of(world, **settings))
    fact, foil = model.intervene(("change-left",)), model.intervene(("continue",))
    return contrastive_causes(model, foil, fact, effects(foil, fact))


def test_a_vehicle_in_the_way_under_both_plans_explains_neither():
    def simulate(plan, chosen):
        always = HeldUp(1, 4.0, 8.0, "leader", 9.0, 5.0)
        if plan == ("continue",):
            return End(time=18.0, held_up=(always, HeldUp(2, 8.0, 12.0, "leader", 8.0, 3.0))), 1
        return End(time=13.0, held_up=(always,)), 1

    certain = (Aim("continue", 1.0, (Way(("continue",)),)),)
    found = causes({1: certain, 2: certain}, simulate)
    assert [cause.vehicle for cause in found] == [2]
    assert found[0].influence is None
    assert found[0].mechanism.delay == pytest.approx(4.0)


def test_a_hold_up_is_no_cause_where_the_foil_is_not_slower():
    def simulate(plan, chosen):
        if plan == ("continue",):
            return End(time=12.0, held_up=(HeldUp(1, 4.0, 8.0, "leader", 9.0, 5.0),)), 1
        return End(time=13.0, jerk=0.1), 1

    assert causes({1: (Aim("continue", 1.0, (Way(("continue",)),)),)}, simulate) == ()


def test_a_risk_of_collision_is_named_after_what_slows():
    def simulate(plan, chosen):
        if plan == ("change-left",):
            return End(time=12.0), 1
        if chosen[2] == ("stop", 0) and chosen[1] == ("stop", 0):
            return End("collision", collided_with=2), 1
        return End(time=17.0, held_up=(HeldUp(1, 4.0, 8.0, "leader", 9.0, 5.0),)), 1

    found = causes({1: COIN, 2: COIN}, simulate)
    assert [(cause.vehicle, cause.mechanism.how) for cause in found] == [
        (1, "leader"),
        (2, "collision"),
    ]
    assert found[1].mechanism.share == pytest.approx(0.25)
    assert found[1].actions == ("stop",)


def test_a_vehicle_without_influence_or_hold_up_is_not_named():
    def simulate(plan, chosen):
        blocked = plan == ("continue",) and chosen[1] == ("stop", 0)
        return End(time=16.0 if blocked else 12.0), 1

    idle = dict.fromkeys(range(2, 6), COIN)
    for seed in range(20):
        found = causes({1: COIN, **idle}, simulate, draws=40, seed=seed)
        assert [cause.vehicle for cause in found] == [1]
        assert found[0].actions == ("stop",)


def test_hold_ups_outside_the_window_do_not_explain_braking():
    def simulate(plan, chosen):
        return End(time=12.0, held_up=(HeldUp(1, 4.0, 8.0, "blocked", 9.0, 5.0),)), 1

    certain = (Aim("continue", 1.0, (Way(("continue",)),)),)
    model = CausalModel(trace_of(World({1: certain}, (("continue",),), simulate)))
    plan = model.intervene(("continue",))
    assert [c.vehicle for c in holding_up(model, plan, (6.0, 7.0))] == [1]
    assert holding_up(model, plan, (9.0, 12.0)) == ()
