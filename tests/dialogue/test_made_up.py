"""Answers about made-up rides: what rides seldom bring, and what was answered wrongly."""

from functools import cache

import pytest

from tests import oddities, stories
from tests.dialogue.talking import MIND
from xavi_dialogue.app.local import Conversation, NoPlan
from xavi_dialogue.dialogue.events import EventRecorded, TraceRecorded
from xavi_dialogue.dialogue.manager import fold
from xavi_dialogue.dialogue.state import Dialogue
from xavi_dialogue.transports.ride_file import RecordedRide, key


@cache
def made_up() -> dict[str, RecordedRide]:
    return stories.rides() | oddities.rides()


@cache
def driven(name: str) -> Dialogue:
    ride = made_up()[name]
    return fold(MIND, [*map(TraceRecorded, ride.traces), *map(EventRecorded, ride.events)])


def hear(name: str, *texts: str) -> str:
    """The reply to the last of some questions in one conversation about a ride."""
    ride = made_up()[name]

    def again(_, need):
        if key(need) not in ride.whatifs:
            raise NoPlan("planner-unavailable")
        return ride.whatifs[key(need)]

    talk = Conversation(MIND, again, driven(name))
    return [talk.ask(text, ride.halt).text for text in texts][-1]


# Collisions ----------------------------------------------------------------------------------

COLLIDED = "We collided with the car ahead on the left (vehicle 1) at 0:09."
REASON = (
    "At 0:07 I expected it to go straight on (70 %), and put the chance of hitting it at 30 %. "
    "Had I stopped then, that of any collision would have been under 5 %."
)


@pytest.mark.parametrize(
    "text",
    [
        *("When did we crash?", "Did we hit vehicle 1?", "Did we crash?", "Will we crash?"),
        *("Whom did we crash into?", "When did we hit vehicle 1?"),
    ],
)
def test_a_collision_is_told_with_whom_and_when(text: str) -> None:
    assert hear("crash", text) == COLLIDED


@pytest.mark.parametrize(
    "text", ["What happened?", "Who did we hit?", "Are we there yet?", "What happened at 0:09?"]
)
def test_a_collision_is_what_happened(text: str) -> None:
    told = "I went straight on, and at 0:09 we collided with the car ahead on the left (vehicle 1)."
    assert hear("crash", text) == told


@pytest.mark.parametrize(
    "text", ["Why did we crash?", "Why did you hit vehicle 1?", "What caused the crash?"]
)
def test_nobody_decides_to_collide(text: str) -> None:
    assert hear("crash", text) == f"We collided with vehicle 1 at 0:09. {REASON}"


@pytest.mark.parametrize("before", ["Did we crash?", "What happened?", "When did we crash?"])
def test_why_after_a_collision_asks_of_it(before: str) -> None:
    assert hear("crash", before, "Why?").endswith(REASON)
    beneath = "I put the chance that vehicle 1 would go straight on at 70 %."
    assert hear("crash", before, "Why?", "Why?").startswith(beneath)
    assert "at 0:09" in hear("crash", before, "When?")


@pytest.mark.parametrize(
    "text",
    [
        *("Why did you crash into vehicle 1?", "When did we crash?", "Why did we crash?"),
        *("Did we hit vehicle 1?", "Did we crash?"),
    ],
)
def test_where_there_was_no_collision_that_is_said(text: str) -> None:
    assert hear("hindered", text).startswith("We have not collided with anybody.")


# Standing for somebody -----------------------------------------------------------------------


def test_who_stands_for_another_is_still_giving_way() -> None:
    bus = "the bus from the right (vehicle 1)"
    answer = hear("waiting", "Why are you giving way?")
    assert answer == f"I am giving way to {bus}, which I expect to go straight on."
    assert "give way to vehicle 1" in hear(
        "waiting", "Why are you giving way?", "Why are we standing still?"
    )
    assert hear("hindered", "Why are you giving way?").startswith("I am not giving way.")


@pytest.mark.parametrize(
    "text", ["When will we go on?", "When are we going to move?", "When do we go on?"]
)
def test_to_go_on_is_to_wait_no_longer(text: str) -> None:
    answer = "I expect to move on in about 4 seconds. I am waiting for the bus from the right"
    assert hear("waiting", text).startswith(answer)


# Others --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ride", "text", "answer"),
    [
        (
            *("plenty", "Why will vehicle 2 turn left?"),
            "I cannot see its plans: I put the chance that the oncoming truck (vehicle 2) will "
            "turn left at 45 %.",
        ),
        (
            *("risky", "Why is vehicle 1 turning right?"),
            "I cannot see its plans: I put the chance that the car on our left (vehicle 1) will "
            "turn right at 40 %.",
        ),
        (
            *("plenty", "Why will vehicle 1 go straight on?"),
            "I think the bus ahead on the left (vehicle 1) may go straight on, but I cannot tell "
            "what for.",
        ),
        (
            *("braking", "Why will vehicle 1 stop?"),
            "I expect the truck ahead (vehicle 1) to stop, probably in order to turn right.",
        ),
    ],
)
def test_what_is_foreseen_has_the_aim_that_goes_with_it(ride: str, text: str, answer: str) -> None:
    assert hear(ride, text) == answer


# How sure -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        "How sure are you that we will make it?",
        "How sure are you that we will get there?",
        "How likely is it that we get there?",
    ],
)
def test_to_get_there_is_what_the_plan_is_for(text: str) -> None:
    assert hear("plenty", text).startswith("I am almost certain: my plan worked out in all 4")
    assert hear("plenty", "Why did you go straight on?", text).startswith("I am almost certain: my")
    assert hear("hopeless", text).startswith("I am not sure at all: my plan worked out in not one")


# Other ways ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text", ["How could we have been sooner?", "What could you have done to be faster?"]
)
def test_what_would_have_been_sooner_is_so_or_there_is_nothing(text: str) -> None:
    sooner = "By stopping: that would have got us there about 5 seconds sooner."
    assert hear("hindered", text) == sooner
    nothing = "I know of no way: nothing else that I tried would have got us there sooner."
    assert hear("waiting", text) == nothing


@pytest.mark.parametrize(
    "text", ["How could you have avoided stopping?", "How could you have avoided that?"]
)
def test_who_stops_does_not_avoid_it_so(text: str) -> None:
    assert hear("waiting", text) == "No option that I looked at would have spared us that."


def test_where_nothing_leads_to_our_destination_that_is_said() -> None:
    tried = "I simulated 2 drives in one situation: going straight on and stopping."
    assert hear("hopeless", "How did you decide?") == (
        f"{tried} I chose to go straight on, though nothing I tried would have taken us to our "
        "destination."
    )
    assert "nothing I tried would take us" in hear("hopeless", "How do you decide?")


@pytest.mark.parametrize("text", ["Why did you change lanes?", "Why did you move to the left?"])
def test_against_a_change_of_lane_stands_staying_in_it(text: str) -> None:
    answer = "To stay in my lane would have made no difference worth speaking of"
    assert hear("over", text).startswith(answer)
