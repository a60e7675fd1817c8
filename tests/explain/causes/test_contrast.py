"""What speaks for a choice, taken from the planner's own reckoning."""

import pytest

from tests.explain.causes.rides import recorded, single, told
from tests.stories import even, squeezed
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.domain.answers import ChoiceReason
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import Event, Happens, Not
from xavi_dialogue.explain.causes.terms import costs, decisive, is_close


def test_the_terms_of_a_plan_sum_to_its_reward() -> None:
    for trace in recorded("s1-4").traces[:6]:
        model = CausalModel(trace)
        for action in model.options():
            plan = model.intervene((action,))
            assert plan is not None
            assert sum(costs(plan).values()) == pytest.approx(-plan.value, abs=0.02)


def test_equal_options_are_close_and_nothing_is_invented() -> None:
    ride = single(even(10.0))
    why_not = Why(Not(Happens(Event("change-lane", side="left", tense="present"))))
    found = told(ride, why_not, 10.0)
    assert isinstance(found, ChoiceReason)
    assert found.contrast.close
    assert found.contrast.causes == ()
    assert found.contrast.decisive in (None, "effort")


def test_the_risk_of_the_foil_is_kept_and_decides() -> None:
    ride = single(squeezed(10.0), (2,))
    why_not = Why(Not(Happens(Event("change-lane", side="left", tense="present"))))
    found = told(ride, why_not, 10.0)
    assert isinstance(found, ChoiceReason)
    assert found.contrast.collision == pytest.approx(0.7, abs=0.05)
    assert found.contrast.collided_with == 2
    assert found.contrast.decisive == "collision"
    assert not found.contrast.close


def test_a_foil_that_is_better_in_all_that_can_be_told_is_close() -> None:
    assert is_close({"time": -2.4, "angular-acceleration": 1.4, "effort": 1.0})
    assert decisive({"time": -2.4, "angular-acceleration": 1.4, "effort": 1.0}) == "effort"
    assert decisive({"time": -2.4, "effort": 0.0}) is None
    assert decisive({"time": 4.0, "collision": 5.0, "effort": -1.0}) == "collision"
