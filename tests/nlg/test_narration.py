from types import SimpleNamespace
from typing import Any

import pytest

from planner.record.events import Event
from planner.record.trace import ACTIONS
from sim.scene import VehicleState
from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.chat.controller import ChatController
from xavi_dialogue.nlg.narration import RideNarrator, clock, narrate, plan_in_words, story


@pytest.mark.parametrize(
    ("event", "line"),
    [
        (Event("action-committed", 4.2, "change-left", 3), "0:04 I change to the left lane."),
        (Event("action-ended", 67.0, "exit-right", 3), "1:07 I have turned right."),
        (Event("gave-way", 5.0, "exit-right", 3, 2), "0:05 I give way to vehicle 2."),
        (Event("arrived", 19.3), "0:19 We have arrived."),
        (Event("collided", 3.0, vehicle=1), "0:03 We have collided with vehicle 1."),
        (Event("action-started", 4.0, "change-left", 3), None),
        (Event("action-committed", 4.0, "continue", 3), None),
        (Event("action-ended", 4.0, "continue", 3), None),
    ],
)
def test_what_the_car_says_unasked(event: Event, line: str | None) -> None:
    assert narrate(event) == line


def test_a_ride_is_told_line_by_line() -> None:
    events = (Event("action-started", 0.0, "stop", 0), Event("ended", 60.0))
    assert story(events) == "1:00 The ride ends here."


def test_a_turn_that_was_given_up_has_not_been_done() -> None:
    given_up = (
        Event("action-started", 0.0, "exit-left", 0),
        Event("action-ended", 2.0, "exit-left"),
    )
    done = (Event("action-committed", 4.0, "exit-left", 4), Event("action-ended", 6.0, "exit-left"))
    assert story(given_up) == ""
    assert story((*given_up, *done)) == "0:04 I turn left.\n0:06 I have turned left."
    assert story((*done, *given_up)) == "0:04 I turn left.\n0:06 I have turned left."


@pytest.mark.parametrize("action", ACTIONS)
def test_every_action_has_words(action: str) -> None:
    assert plan_in_words((action,)).strip()  # type: ignore[arg-type]
    assert narrate(Event("action-committed", 0.0, action, 0)) or action == "continue"  # type: ignore[arg-type]


def test_a_plan_is_a_row_of_actions() -> None:
    assert plan_in_words(("change-left", "continue")) == "change left, then go on"
    assert plan_in_words(()) == ""


def cabin(state: Any) -> ChatController:
    report = SceneReport(
        ride="r1",
        seq=0,
        sim_time=32.0,
        wall_time=0.0,
        vehicles={0: VehicleState((0.0, 0.0), 0.0, 50.0 / 3.6, 0.0, 4.5, 1.8)},
        state=state,
        speed_factor=1.0,
        plan=("continue",),
        traces=0,
        events=0,
    )
    known: Any = SimpleNamespace(scene=report, trouble=lambda: None)
    return ChatController(known, known, known)


def test_a_ride_that_is_over_has_neither_speed_nor_plan() -> None:
    assert cabin("driving").status() == "0:32  ·  50 km/h  ·  go on"
    assert cabin("driving").plan() == "I plan to go on."
    assert cabin("ended").status() == "0:32  ·  the ride is over; ask on"
    assert cabin("ended").plan() == "The ride is over."


def test_clocks() -> None:
    assert [clock(0.0), clock(59.99), clock(600.0)] == ["0:00", "0:59", "10:00"]


def test_a_ride_that_is_driven_again_is_not_told_again_and_another_one_is() -> None:
    first = (Event("action-committed", 4.0, "exit-left", 4), Event("gave-way", 5.0, None, 3, 2))
    then = Event("action-ended", 6.0, "exit-left")
    teller = RideNarrator()

    def told(events: tuple[Event, ...]) -> list[str | None]:
        return [teller.tell(number, event) for number, event in enumerate(events)]

    assert told(first) == ["0:04 I turn left.", "0:05 I give way to vehicle 2."]
    assert told((*first, then)) == [None, None, "0:06 I have turned left."]
    other = (Event("action-committed", 2.0, "exit-right", 4), first[1])
    assert told(other) == ["0:02 I turn right.", "0:05 I give way to vehicle 2."]
    assert teller.tell(2, then) is None  # that turn was none of this ride
