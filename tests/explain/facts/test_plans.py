"""What was meant to be done, what that is worth, and when its actions begin."""

from collections.abc import Sequence
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.places import RoadFacts, RouteStep
from planner.record.trace import PlanTrace
from tests.explain.facts.scenes import Actor, made, straight
from tests.traces import Actions, Aim, Chosen, End, Way, trace_of
from tests.traces import World as Plain
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Thing, Vehicle
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.explain.facts.measures.measuring import measure
from xavi_dialogue.explain.facts.plans import beginnings, plan_of
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

approx: Any = pytest.approx  # that compares within tuples, too

US, ONE, TWO = Ego(), Vehicle(1), Vehicle(2)


OURS = Actor(straight(0.0, 0.0, 10.0))


def of(
    found: States, attribute: Attribute, thing: Thing = US, at: float = 8.0, to: Thing | None = None
) -> Measure:
    return measure(found, attribute, thing, at, to)


def weighing(plan: Actions = ("continue",), draws: Sequence[float] = (0.7, 0.3)) -> PlanTrace:
    """Going on takes 12 s or crashes into 1; moving left takes 11 s; stopping never gets there."""
    aims = {
        1: (
            Aim("continue", draws[0], (Way(("continue",)),)),
            Aim("stop", draws[1], (Way(("stop",)),)),
        )
    }

    def simulate(plan: Actions, chosen: Chosen) -> tuple[End, int]:
        match plan[0]:
            case "continue" if chosen[1][0] == "stop":
                return End("collision", collided_with=1), 1
            case "continue":
                return End(time=12.0, jerk=0.0), 1
            case "change-left":
                return End(time=11.0, jerk=0.0), 2
        return End("termination"), 2

    plans: tuple[Actions, ...] = (
        ("continue",),
        ("change-left", "continue"),
        ("stop", "continue"),
    )
    return trace_of(Plain(aims, plans, simulate, plan=plan))


def test_a_value_is_that_of_the_last_decision_with_a_choice() -> None:
    first = replace(weighing(), sim_time=2.0)
    then = replace(weighing(("stop", "continue")), sim_time=4.0)
    ride = Ride(Record(6.0, (first, then)))
    assert of(States(ride), "value", at=4.0).value == approx(-100.0)
    assert of(States(Ride(Record(6.0, (replace(first, plan=()),)))), "value", at=4.0).gap == (
        "not-recorded"
    )


def test_a_plan_is_known_as_far_as_there_is_evidence() -> None:
    trace = weighing(("change-left", "stop"))
    found = plan_of(Ride(Record(4.0, (trace,))))
    assert found is not None
    assert found[1].plan == ("change-left", "continue")
    assert found[0].trace is trace
    assert plan_of(Ride(Record(4.0))) is None
    assert plan_of(Ride(Record(4.0, (weighing(("exit-left",)),)))) is None
    assert beginnings(Ride(Record(4.0))) == {}
    assert beginnings(Ride(Record(4.0, (trace,)))) == {
        "change-left": approx(4.0),
        "continue": approx(6.0),
    }


def test_beginnings_are_means_of_the_drives_imagined() -> None:
    trace = weighing()
    rows = list(trace.rollouts)
    for k, since in ((0, 5.0), (1, 9.0)):
        rows[k] = replace(rows[k], actions=(replace(rows[k].actions[0], start=since),))
    found = beginnings(Ride(Record(4.0, (replace(trace, rollouts=tuple(rows)),))))
    assert found == {"continue": approx(0.7 * 5.0 + 0.3 * 9.0)}


def test_steps_of_a_route_are_counted() -> None:
    step = RouteStep(9.0, "roundabout", "exit-left", None, None, 4, "equal")
    found = States(made({0: OURS}, 2.0, roads=lambda _: RoadFacts({}, (step,))))
    assert of(found, "exit-number", at=2.0).gap == "not-applicable"
    assert of(found, "route", at=2.0).value == 1.0
