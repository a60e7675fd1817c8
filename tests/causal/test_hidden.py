"""Whether somebody comes out of what is hidden is a part of the sample, with its chance."""

import pytest
from msgspec.structs import replace

from planner.record.hidden_record import Phantom, PhantomSample
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
