"""What is said of a plan is true of it: what comes next, and what it is set against."""

import pytest

from tests.dialogue.talking import MIND, Talk, ride
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record

STRAIGHT = "Why are you going straight on?"


@pytest.mark.parametrize(("name", "at"), [("s2-0", 3.0), ("s2-2", 5.0), ("s4-0", 5.0)])
def test_who_drives_up_to_a_turn_goes_straight_on_only_until_then(name: str, at: float) -> None:
    talk = Talk(name, at=at)
    reply = talk.say(STRAIGHT).reply
    assert reply.reason == "did-not-happen"
    assert reply.text.startswith("I only go straight on until I turn right.")
    assert "turning right" in talk.hear("why?")


@pytest.mark.parametrize("name", ["town-0", "s4-0"])
def test_driving_on_is_not_set_against_what_the_plan_has_next(name: str) -> None:
    known = ride(name)
    compared = 0
    for trace in known.traces[::3]:
        plan = [step.action for step in trace.plan]
        later = next((action for action in plan if action != "continue"), None)
        if plan[:1] != ["continue"] or later is None:
            continue
        traces = tuple(one for one in known.traces if one.sim_time <= trace.sim_time)
        events = tuple(one for one in known.events if one.sim_time <= trace.sim_time)
        record = Record(trace.sim_time, traces, events)
        found = MIND.explain(Query(type="why", tense="present"), record)
        foil = getattr(found, "counterfactual", ())
        compared += bool(foil)
        assert foil[:1] != (later,)
    assert compared


@pytest.mark.parametrize(
    "text",
    [
        "What's the speed limit here?",
        "Are we over the limit?",
        "Did you break the speed limit?",
        "is 50 the speed limit",
    ],
)
def test_speed_limits_are_not_recorded_and_no_question_of_law(text: str) -> None:
    reply = Talk(at=12.0).say(text).reply
    assert reply.reason == "out-of-scope"
    assert reply.text.startswith("I can say nothing about speed limits: they are not in my record")


def test_a_question_of_law_is_still_one() -> None:
    assert Talk(at=12.0).hear("Is that legal?").startswith("I cannot give advice on the law")
