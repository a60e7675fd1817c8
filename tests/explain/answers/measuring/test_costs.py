"""What a manoeuvre cost in time."""

from typing import Any

from tests.explain.answers.measuring.test_durations import ALL, LOOKS, ONE, TWO
from tests.explain.answers.stated import (
    did,
    result,
    scene,
)
from xavi_dialogue.domain.answers import DidNotHappen
from xavi_dialogue.domain.terms import At, Event
from xavi_dialogue.explain.answers.measuring.durations import (
    cost_of,
    held_for,
    lost,
)
from xavi_dialogue.explain.answers.reference.moments import Window

# --- costs --------------------------------------------------------------------------------------

COSTS = {"slow-down": 2.0, "stop": 6.0, "give-way": 4.0, "overtake": 1.0}


def cost(event: Any, *told: Any, about: Window = ALL, **more: Any) -> Any:
    found = result(cost_of, scene(episodes=told, looks=LOOKS, delays=COSTS, **more), event, about)
    return found if isinstance(found, DidNotHappen) else found.value


def test_a_deed_costs_what_the_slowing_around_it_did() -> None:
    slowed, stopped = did("slow-down", 2.0, 5.0), did("stop", 5.4, 8.0)
    assert cost(Event("slow-down"), slowed, did("stop", 5.6, 8.0)) == 2.0
    assert cost(Event("slow-down"), slowed, stopped) == 6.0
    assert cost(Event("overtake"), did("overtake", 8.1, 9.0), slowed) == 1.0
    assert cost(Event("overtake"), did("overtake", 7.9, 9.0), slowed) == 2.0
    missing = cost(Event("turn"), slowed)
    assert isinstance(missing, DidNotHappen)
    assert missing.asked == Event("turn")
    assert cost(Event("exit-left"), did("exit-left", 4.0, 5.0)) is None  # it has no cost


def test_slowing_down_again_and_again_is_one() -> None:
    first, second = did("slow-down", 1.0, 3.0), did("give-way", 4.0, 5.0)
    third = did("stop", 7.9, 9.0)
    assert cost(Event("stop"), first, second, third) == 6.0
    stopped_first = (did("stop", 1.0, 3.0), did("give-way", 4.0, 5.0), did("slow-down", 7.9, 9.0))
    assert cost(Event("slow-down", time=At(8.5)), *stopped_first) == 6.0
    with_pause = (did("stop", 1.0, 3.0), did("slow-down", 6.1, 9.0))
    assert cost(Event("slow-down", time=At(8.0)), *with_pause) == 2.0
    just = (did("stop", 1.0, 3.0), did("slow-down", 6.0, 9.0))
    assert cost(Event("slow-down", time=At(8.0)), *just) == 6.0


def test_without_an_event_the_longest_recent_slowing_counts() -> None:
    early, late, later = did("stop", 1.0, 4.5), did("slow-down", 8.0, 9.0), did("give-way", 13.0)
    assert cost(None, early, late) == 2.0  # what ended within 15 s
    assert cost(Event("block"), early, late) == 2.0
    assert cost(None, early, late, later) == 4.0
    assert cost(None, early) == 6.0
    assert cost(None, early, late, about=Window(2.0, 4.0)) == 6.0
    assert cost(None, early, late, about=Window(15.0, 16.0)) == 2.0
    missing = cost(None)
    assert isinstance(missing, DidNotHappen)
    assert missing.asked == Event("slow-down")


def test_the_cost_of_what_goes_on_reaches_up_to_now() -> None:
    going = did("slow-down", 12.0)
    found = lost(scene(episodes=(going, did("stop", 19.8)), delays=COSTS), going)
    assert found is not None
    assert found.value == 6.0
    assert lost(scene(delays={}), going) is None


def test_what_we_did_for_somebody() -> None:
    told = (did("give-way", 2.0, 4.0, object=ONE), did("brake", 6.0, 7.0, object=ONE),
            did("follow", 8.0, 12.0, object=ONE), did("follow", 8.0, 12.0, object=TWO))  # fmt: skip
    asked = scene(episodes=told, looks=LOOKS)
    assert held_for(asked, ONE) == Event("brake", object=ONE)
    assert held_for(asked, TWO) == Event("follow", object=TWO)
    assert held_for(scene(looks=LOOKS), ONE) == Event("give-way", object=ONE)
