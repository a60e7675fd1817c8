"""What if: of us and of others; how sure; what would change; what could have been avoided."""

import pytest

from tests.explain.causes.rides import recorded, single, story, told
from tests.stories import squeezed
from xavi_dialogue.domain.answers import (
    Avoidance,
    Beliefs,
    Certainty,
    Compared,
    DecisiveFactor,
    Grounds,
    Method,
    MotionReason,
    NotRecorded,
    Options,
    SupposedOfOther,
    SupposedOfUs,
    TooLittle,
)
from xavi_dialogue.domain.meaning import (
    Compare,
    HowAvoid,
    HowDecide,
    HowKnow,
    HowSure,
    Listing,
    WhatIf,
    WhatWouldChange,
    Whether,
)
from xavi_dialogue.domain.terms import Event, Exists, Happens, Not, Vehicle

LEFT = Event("change-lane", side="left", tense="present")


def test_the_foil_of_ours_is_compared_with_the_plan() -> None:
    found = told(single(squeezed(10.0), (2,)), WhatIf(Happens(LEFT)), 10.0)
    assert isinstance(found, SupposedOfUs)
    assert found.contrast.foil == ("change-left",)
    assert found.contrast.collision > 0.5


def test_what_was_done_is_told_as_done() -> None:
    changed = Event("change-lane", side="left", tense="perfect")
    found = told(recorded("s1-0"), WhatIf(Happens(changed)), 8.0)
    assert isinstance(found, SupposedOfUs)
    assert found.done is not None
    assert (found.done.action, found.done.when) == ("change-left", "did")


def test_without_another_it_is_planned_again() -> None:
    found = told(story("waiting"), WhatIf(Not(Exists(Vehicle(1)))), 10.0)
    assert isinstance(found, SupposedOfOther)
    assert found.supposed is None
    assert found.prior is None


def test_would_we_still_have_done_it() -> None:
    then = Whether(Happens(Event("brake", modal="would", tense="past")))
    found = told(story("waiting"), WhatIf(Not(Exists(Vehicle(1))), then), 10.0)
    # The decision that explains it, at 6.0 s, cannot be planned again; that of 4.0 s would clear
    # the vehicle that is told as the reason.
    assert found == TooLittle("too-little-evidence")


def test_what_another_does_is_supposed_with_its_prior() -> None:
    ride = single(squeezed(10.0), (2,))
    event = Event("exit-right", actor=Vehicle(1), tense="present")
    found = told(ride, WhatIf(Happens(event)), 10.0)
    assert isinstance(found, SupposedOfOther)
    assert found.prior == pytest.approx(0.6)
    denied = told(ride, WhatIf(Not(Happens(event))), 10.0)
    assert isinstance(denied, SupposedOfOther)
    assert denied.negated
    assert denied.prior == pytest.approx(0.4)


def test_where_we_never_slowed_down_it_is_told_why_we_drove_no_faster() -> None:
    ride = recorded("s1-0")
    fast = WhatIf(Happens(Event("enter", manner=("fast",))))
    found = told(ride, fast, 8.0)
    assert isinstance(found, MotionReason)
    assert found.manner == "slowly"


def test_options_are_listed_best_first_with_the_chosen_one() -> None:
    found = told(single(squeezed(10.0)), Listing("options"), 10.0)
    assert isinstance(found, Options)
    values = [option.value for option in found.options]
    assert values == sorted(values, key=lambda value: -(value or 0.0))
    assert sum(option.chosen for option in found.options) == 1


def test_the_safer_of_two_options_is_the_one_without_the_risk() -> None:
    named = (Happens(LEFT), Happens(Event("keep-lane", tense="present")))
    found = told(single(squeezed(10.0), (2,)), Compare(named, "safety"), 10.0)
    assert isinstance(found, Compared)
    assert found.better == "second"


def test_how_sure_is_of_us_a_certainty_and_of_another_a_belief() -> None:
    ride = single(squeezed(10.0))
    assert isinstance(told(ride, HowSure(), 10.0), Certainty)
    found = told(ride, HowSure(Happens(Event("exit-right", actor=Vehicle(1)))), 10.0)
    assert isinstance(found, Beliefs)
    assert found.probability == pytest.approx(0.6)


def test_how_we_know_is_how_the_belief_grew() -> None:
    found = told(story("braking"), HowKnow(Happens(Event("exit-right", actor=Vehicle(1)))), 10.0)
    assert isinstance(found, Grounds)
    assert found.vehicle == 1
    assert found.history


def test_a_change_of_speed_that_no_prediction_holds_is_told_by_its_name() -> None:
    ride = recorded("motorway-0")
    slows = HowKnow(Happens(Event("slow-down", actor=Vehicle(1), tense="future")))
    found = told(ride, slows, ride.traces[0].sim_time)
    assert isinstance(found, Grounds)
    assert found.actions == ("slow-down",)
    assert found.history[-1][1] == 0.0


def test_what_no_prediction_can_hold_is_no_belief() -> None:
    ride = story("braking")
    found = told(ride, HowKnow(Happens(Event("honk", actor=Vehicle(1), tense="future"))), 10.0)
    assert found == NotRecorded("not-recorded", Vehicle(1), about="doing")


def test_how_we_know_what_it_will_do_is_of_what_is_most_probable() -> None:
    ride = story("braking")
    found = told(ride, HowKnow(Happens(Event("do", actor=Vehicle(1), tense="future"))), 10.0)
    assert isinstance(found, Grounds)
    assert found.actions == told(ride, HowKnow(Exists(Vehicle(1))), 10.0).actions


def test_how_we_decide_tells_the_options_and_the_samples() -> None:
    found = told(single(squeezed(10.0)), HowDecide(), 10.0)
    assert isinstance(found, Method)
    assert found.evidence.rollouts > 0
    assert found.vehicles == 2


def test_what_would_change_it_is_a_vehicles_conduct() -> None:
    found = told(single(squeezed(10.0), (2,)), WhatWouldChange(Not(Happens(LEFT))), 10.0)
    assert isinstance(found, DecisiveFactor)
    assert found.kind == "conduct"
    assert found.vehicle == 2


def test_a_collision_is_asked_for_what_would_have_avoided_it() -> None:
    ride = story("crash")
    found = told(ride, HowAvoid(), 10.0)
    assert isinstance(found, Avoidance)
    assert found.mishap == "collide"
    assert found.impact is not None
