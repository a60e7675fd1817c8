"""What a decision could choose from, and what was expected of each option."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.facts.test_plans import weighing
from tests.explain.trust import trusted
from xavi_dialogue.explain.causes.plans.options import of_trace, options_at
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

approx: Any = pytest.approx  # that compares within tuples, too


def test_what_a_decision_could_choose_from() -> None:
    trace = weighing()
    going, left, stop = of_trace(Ride(Record(4.0, (trace,))), trace)
    assert (going.action, going.chosen, going.outcome) == ("continue", True, "done")
    assert going.probability == approx(trusted(0.7, "done"))
    assert (going.time, going.delta) == (approx(12.0), None)
    assert going.value == approx(-0.7 * 12.0 - 0.3 * 200.0)
    assert (going.collision, going.collided_with) == (approx(trusted(0.3)), 1)
    assert (left.action, left.chosen, left.probability) == (
        "change-left",
        False,
        approx(trusted(1.0, "done")),
    )
    assert (left.time, left.delta) == (approx(11.0), approx(-1.0))
    assert (left.collision, left.collided_with) == (trusted(0.0), None)
    assert (left.close, stop.close) == (False, False)
    assert (stop.action, stop.outcome, stop.time, stop.delta) == ("stop", "termination", None, None)


def test_options_are_those_of_the_last_decision_with_a_choice() -> None:
    first = replace(weighing(), sim_time=2.0)
    then = replace(weighing(("stop", "continue")), sim_time=4.0)
    busy = replace(weighing(), sim_time=5.0, under_way=weighing().rollouts[0].actions[0])
    ride = Ride(Record(6.0, (first, then, busy)))
    assert [options_at(ride, t)[0].action for t in (2.0, 4.0, 6.0)] == ["continue", "stop", "stop"]
    assert options_at(ride, 1.0) == ()
    alone = Ride(Record(6.0, (busy,)))
    assert [o.action for o in options_at(alone, 6.0)] == ["continue", "change-left", "stop"]
