"""Why we drove as we did: the episode that is meant, what it really was, and because of whom."""

import copy

import pytest

from tests.explain.causes.rides import recorded, single, story, told
from tests.stories import squeezed
from xavi_dialogue.domain.answers import (
    CannotSay,
    ChoiceReason,
    DidNotHappen,
    Method,
    MotionReason,
    NoSuchVehicle,
    NotApplicable,
    OtherReason,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import HowDecide, Whether, Why
from xavi_dialogue.domain.terms import (
    Caused,
    Described,
    Ego,
    Event,
    Everyone,
    Exit,
    Happens,
    Is,
    Not,
    Thing,
    Vehicle,
)


def why(action: str, **more: object) -> Why:
    return Why(Happens(Event(action, **more)))  # type: ignore[arg-type]


def test_a_stop_that_was_only_slowing_down_is_told_as_that() -> None:
    found = told(story("braking"), why("stop"), 8.0)
    assert isinstance(found, MotionReason)
    assert found.deed.action in ("slow-down", "brake")
    assert (found.premise, found.asked) == (False, "stop")


def test_slowing_down_keeps_its_premise() -> None:
    found = told(story("braking"), why("brake"), 8.0)
    assert isinstance(found, MotionReason)
    assert found.premise
    assert found.causes[0].vehicle == 1


def test_slow_is_a_state_and_not_slowing_down() -> None:
    ride = recorded("motorway-0")
    for now in (6.0, 10.0):
        found = told(ride, Why(Is("slow", tense="present")), now)
        assert isinstance(found, MotionReason)
        assert found.deed.action in ("move", "follow")
        assert found.manner == "slowly"


def test_standing_for_somebody_is_because_of_them() -> None:
    found = told(story("waiting"), why("stand", tense="present"), 10.0)
    assert isinstance(found, MotionReason)
    assert found.causes[0].vehicle == 1
    assert found.causes[0].kind == "right-of-way"


def test_not_going_is_told_as_waiting() -> None:
    found = told(story("waiting"), Why(Not(Happens(Event("go", tense="present")))), 10.0)
    assert isinstance(found, MotionReason)
    assert found.causes[0].vehicle == 1


def test_a_suspect_is_confirmed_or_cleared() -> None:
    claim = Whether(Caused(Vehicle(1), Happens(Event("stop"))))
    found = told(story("waiting"), claim, 10.0)
    assert isinstance(found, MotionReason)
    assert (found.suspect, found.suspected) == (1, "main")


def test_a_suspect_that_was_never_seen_is_refused() -> None:
    question = Why(Happens(Event("brake")), suspect=Vehicle(77))
    found = told(story("braking"), question, 8.0)
    assert isinstance(found, NoSuchVehicle)
    assert (found.thing, found.time) == (Vehicle(77), 8.0)
    assert [look.vehicle for look in found.known] == [1, 2]


def test_what_nobody_did_is_denied_with_what_was_done() -> None:
    found = told(recorded("s1-0"), why("turn", side="left"), 8.0)
    assert isinstance(found, DidNotHappen)
    assert found.asked.action == "turn"


def test_the_time_said_chooses_the_episode_or_denies_it() -> None:
    ride = story("braking")
    found = told(ride, why("brake"), 10.0, Span(0.5, 1.5, said=True))
    assert isinstance(found, DidNotHappen)
    assert found.elsewhen is not None


def test_an_option_that_did_not_apply_has_its_reason() -> None:
    question = Why(Not(Happens(Event("change-lane", side="right", tense="present"))))
    found = told(single(squeezed(10.0)), question, 10.0)
    assert isinstance(found, NotApplicable)
    assert found.reason == "there is no lane to the right"


def test_no_car_of_this_kind_honks() -> None:
    found = told(story("braking"), Why(Not(Happens(Event("honk")))), 8.0)
    assert found == CannotSay("capability", "honk", "not-an-action")


def test_why_we_change_lanes_is_a_choice() -> None:
    found = told(recorded("s1-0"), why("change-lane", side="left"), 8.0)
    assert isinstance(found, ChoiceReason)
    assert found.deed is not None
    assert found.deed.action == "change-left"
    assert found.contrast.foil == ("continue",)
    assert not found.contrast.close


def test_the_decision_is_the_one_of_the_episode_and_not_the_latest() -> None:
    found = told(recorded("s1-0"), why("change-lane", side="left"), 15.0)
    assert isinstance(found, ChoiceReason)
    assert found.contrast.decided <= 4.0


def test_another_stands_for_whom_it_waits() -> None:
    found = told(recorded("s1-0"), why("wait", actor=Vehicle(2), tense="present"), 8.0)
    assert isinstance(found, OtherReason | DidNotHappen)
    if isinstance(found, OtherReason):
        assert found.vehicle == 2
        assert found.deed is not None


def test_whoever_is_in_the_way_but_makes_no_difference_is_not_the_reason() -> None:
    ride = story("lorry")
    question = Why(Is("slow", tense="present"), suspect=Vehicle(1))
    found = told(ride, question, 6.0)
    assert isinstance(found, MotionReason)
    assert found.causes == ()
    assert found.cleared == (1,)
    assert found.suspected == "none"


def test_whoever_is_in_front_is_the_reason_for_driving_slowly() -> None:
    question = Why(Is("slow", tense="present"), suspect=Vehicle(1))
    ride = copy.copy(story("lorry"))
    ride.whatifs = {}  # nothing was planned without it, so that nothing clears it
    for time, action in ((9.0, "brake"), (11.0, "follow")):
        found = told(ride, question, time)
        assert isinstance(found, MotionReason)
        assert found.deed.action == action
        assert found.causes[0].kind == "leader"
        assert found.suspected == "main"


@pytest.mark.parametrize("doing", ["go", "continue", "keep-lane"])
def test_going_on_instead_of_stopping_is_answered_about_stopping(doing: str) -> None:
    driving = Happens(Event(doing, tense="present"))  # type: ignore[arg-type]
    question = Why(driving, instead=Happens(Event("stop", tense="present")))
    found = told(recorded("s1-0"), question, 1.0)
    assert isinstance(found, ChoiceReason)
    assert (found.form, found.contrast.foil) == ("why-not", ("stop",))


def test_going_on_to_the_next_exit_is_not_leaving_at_it() -> None:
    """Asked where it leaves a roundabout, past whose first exit it went before."""
    ride = recorded("s3-0")
    leaves = [t for t in ride.traces if [s.action for s in t.plan][:1] == ["exit-right"]]
    event = Event("continue-next-exit", object=Exit(1), tense="present")
    found = told(ride, Why(Not(Happens(event))), leaves[-1].sim_time)
    assert isinstance(found, ChoiceReason)
    assert found.contrast.foil == ("continue-next-exit",)
    assert found.contrast.fact[0] == "exit-right"


def test_every_option_that_was_simulated_is_counted() -> None:
    ride = recorded("s3-0")
    trace = next(t for t in ride.traces if t.under_way is None)
    tried = {r.actions[0].action for r in trace.rollouts if r.actions}
    found = told(ride, HowDecide(), trace.sim_time)
    assert isinstance(found, Method)
    assert found.tried == len(tried)


@pytest.mark.parametrize("actor", [Everyone(), Described(definite=False)])
def test_why_anybody_braked_is_told_of_us(actor: Thing) -> None:
    """Of nobody in particular only our own braking is known."""
    found = told(story("braking"), why("brake", actor=actor), 8.0)
    assert isinstance(found, MotionReason)
    assert found.deed.actor == Ego()
