"""Whether somebody comes out of what is hidden is a part of the sample, with its chance."""

import pytest
from msgspec.structs import replace

from planner.record.hidden_record import Phantom, PhantomSample
from planner.record.light_record import LightCourse, LightPrediction, LightSample, Showing
from tests.traces import End, World, recorded
from xavi_dialogue.causal.model import CausalModel

CHANCE = 0.1


def model():
    """One drive is slow where somebody comes, the other not: of nobody else is anything guessed."""
    world = World({}, (("continue",),), lambda plan, chosen: (End("done"), 1))
    known = recorded(world, [(("continue",), (), 1, False)])
    one = known.rollouts[0]
    drives = [
        replace(
            one,
            index=k,
            reward=-20.0 if comes else -10.0,
            phantoms=(PhantomSample(0, comes),),
        )
        for k, comes in enumerate((True, False))
    ]
    hidden = Phantom(
        ("a_0",), 0.0, 5.0, (0.0, 0.0), 0.0, 10.0, 5.0, 20.0, 0.1, CHANCE, "J", 0, (1,), (3.0,)
    )
    return CausalModel(replace(known, rollouts=tuple(drives), phantoms=(hidden,)))


def test_that_somebody_comes_weighs_its_chance():
    known = model().intervene(("continue",))
    assert len(known.results) == 2
    assert known.value == pytest.approx(-20.0 * CHANCE - 10.0 * (1.0 - CHANCE))
    assert known.coverage == pytest.approx(1.0)


def test_who_is_imagined_is_no_vehicle_of_the_model():
    assert model().vehicles == ()


def test_who_is_imagined_is_numbered_after_the_lights():
    assert {row.joint for row in model().intervene(("continue",)).results} == {
        ((-1, 0, 0),),
        ((-1, 1, 0),),
    }
    trace = model().trace
    seen = (Showing(0.0, "r"),)
    light = LightPrediction("J", (0,), seen, (LightCourse(0.3, seen), LightCourse(0.7, seen)))
    drives = tuple(replace(r, lights=(LightSample("J", 1),)) for r in trace.rollouts)
    lit = CausalModel(replace(trace, rollouts=drives, lights=(light,)))
    comes, stays = lit.intervene(("continue",)).results
    assert comes.joint == ((-2, 1, 0), (-1, 1, 0))
    assert lit.prior(comes.joint) == pytest.approx(0.7 * CHANCE)
    assert lit.prior(stays.joint) == pytest.approx(0.7 * (1.0 - CHANCE))
