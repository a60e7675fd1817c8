"""What browsers read, in the car's own words."""

import pytest

from planner.record.events import Event
from planner.record.trace import ACTIONS, GoalPrediction, HoldUp
from xavi_dialogue.dashboard.views import labels
from xavi_dialogue.domain.answers import Cause, Mechanism

KINDS = ("action-started", "action-committed", "action-ended", "gave-way", "arrived", "collided")


def cause(how: HoldUp | str | None, **others: bool | None) -> Cause:
    mechanism = None if how is None else Mechanism(how, 12.0, 3.0, 4.0, 0.5)  # type: ignore[arg-type]
    changes, necessary = others.get("changes"), others.get("necessary")
    return Cause(1, ("exit-right",), 0.8, mechanism, None, changes, necessary)


def test_a_plan_is_told_as_the_car_tells_it() -> None:
    assert labels.plan_words(("change-left", "exit-left", "continue")) == (
        "move to the left lane, then turn left"
    )
    assert labels.plan_words(("continue", "exit-straight")) == "go straight on"
    assert labels.plan_words(()) == "stop"


def test_who_does_not_change_lanes_stays_in_the_lane() -> None:
    assert labels.deed("continue", in_lane=labels.has_lane_change(("change-left",))) == (
        "stay in my lane"
    )
    assert (
        labels.deed("continue", in_lane=labels.has_lane_change(("exit-left",))) == "go straight on"
    )


def test_others_do_things_in_the_third_person() -> None:
    assert labels.does(("change-right", "exit-right", "continue")) == (
        "changes to the right lane and turns right"
    )
    assert labels.does(("continue",)) == "goes straight on"


@pytest.mark.parametrize(
    ("kind", "place", "said"),
    [
        ("exit-left", "the road to the left", "turns left"),
        ("stop", "where it comes to a stop", "stops"),
        (
            "exit-right",
            "the second exit of the roundabout",
            "heads for the second exit of the roundabout",
        ),
    ],
)
def test_a_goal_that_its_action_does_not_tell_is_told_by_its_place(
    kind: str, place: str, said: str
) -> None:
    assert labels.goal_words(GoalPrediction(kind, place, None, 0.5, 1.0, 0.5, ())) == said  # type: ignore[arg-type]


def test_a_cause_says_what_was_expected_and_how_it_was_in_the_way() -> None:
    leader = cause("leader", changes=True, necessary=True)
    assert labels.cause_words(leader) == "will probably slow from 43 to 11 km/h and turn right"
    assert labels.way_words(leader) == "slowing ahead of me, from 43 to 11 km/h"
    assert labels.checked_words(leader) == "Without vehicle 1, I would have decided otherwise."


def test_a_cause_that_was_not_tried_or_made_no_difference() -> None:
    assert labels.checked_words(cause("leader")) is None
    assert labels.way_words(cause(None)) is None
    doubted = labels.checked_words(cause("leader", changes=False, necessary=False))
    assert doubted is not None
    assert doubted.startswith("Without vehicle 1, I would have done the same")
    motion = labels.checked_words(cause("leader", necessary=False))
    assert motion is not None
    assert "no difference" in motion


@pytest.mark.parametrize("how", ["leader", "right-of-way", "cut-in", "blocked", "collision"])
def test_every_way_to_be_in_the_way_has_words(how: HoldUp) -> None:
    assert labels.way_words(cause(how))
    assert labels.hold_up_words(how)
    assert labels.cause_words(cause(how)).startswith("will probably ")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("action", ACTIONS)
def test_every_event_is_a_sentence(kind: str, action: str) -> None:
    for vehicle in (None, 2):
        said = labels.event_words(Event(kind, 75.0, action, 3, vehicle))  # type: ignore[arg-type]
        assert said[0].isupper()
        assert said.endswith(".")
        assert "None" not in said
        assert not {"{", "}", ":"} & set(said)


def test_events_are_told_as_the_car_tells_them() -> None:
    said = [
        labels.event_words(Event("action-started", 1.0, "exit-right", 3)),
        labels.event_words(Event("action-committed", 75.0, "change-left", 3)),
        labels.event_words(Event("gave-way", 5.0, "exit-right", 3, 2)),
        labels.event_words(Event("collided", 5.0)),
        labels.event_words(Event("ended", 5.0)),
    ]
    assert said == [
        "I mean to turn right.",
        "I change to the left lane.",
        "I give way to vehicle 2.",
        "We have collided.",
        "The ride ends here.",
    ]


def test_the_end_of_what_may_have_been_given_up_is_not_told_as_done() -> None:
    ended = Event("action-ended", 6.0, "exit-right", 3)
    assert labels.event_words(ended) == "Turning right is over."
