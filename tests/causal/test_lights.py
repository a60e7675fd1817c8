"""Rollouts under other courses of the traffic lights are other samples, each with its chance."""

import pytest
from msgspec.structs import replace

from benchmarks.truth.reckoning import Reckoning, joint
from planner.record.light_record import LightCourse, LightPrediction, LightSample, Showing
from tests.traces import s1_ride
from xavi_dialogue.causal.influence import influence
from xavi_dialogue.causal.model import CausalModel

SOON, LATE = 0.3, 0.7


def trace():
    """A decision whose plan takes 10 s where the light turns soon, and 30 s where it does not."""
    known = s1_ride().traces[0]
    seen = (Showing(0.0, "r"),)
    courses = tuple(LightCourse(p, seen) for p in (SOON, LATE))
    drive = known.rollouts[0]
    plan = tuple(step.action for step in drive.actions)
    drives = []
    for k, time in enumerate((10.0, 30.0)):
        parts = {**drive.components, "time": time}
        lights = (LightSample("J", k),)
        drives.append(
            replace(
                drive, index=k, outcome="done", components=parts, reward=-time, lights=lights,
                samples=(), collided_with=None, forced=False, terms={"time": time}, weight=None,
            )
        )  # fmt: skip
    light = LightPrediction("J", (0,), seen, courses)
    return replace(known, predictions=(), rollouts=tuple(drives), lights=(light,)), plan


def test_each_course_counts_by_its_probability():
    decision, plan = trace()
    found = CausalModel(decision).intervene(plan)
    assert found is not None
    assert len(found.results) == 2
    assert found.expectation("time") == pytest.approx(SOON * 10.0 + LATE * 30.0, abs=0.5)


def test_a_light_takes_part_in_the_prior_of_a_sample():
    decision, plan = trace()
    model = CausalModel(decision)
    found = model.intervene(plan)
    soon, late = (model.prior(result.joint) for result in found.results)
    assert soon / late == pytest.approx(SOON / LATE)


def test_lights_are_no_vehicles_of_a_model():
    known = s1_ride().traces[1]
    light = trace()[0].lights[0]
    drives = [replace(r, lights=(LightSample("J", k % 2),)) for k, r in enumerate(known.rollouts)]
    model = CausalModel(replace(known, rollouts=tuple(drives), lights=(light,)))
    assert model.vehicles == CausalModel(known).vehicles
    assert tuple(one.vehicle for one in influence(model)) == model.vehicles


def test_the_reader_of_answers_tells_courses_apart_as_well():
    decision, plan = trace()
    assert len({joint(drive) for drive in decision.rollouts}) == 2
    side = Reckoning(decision)._follow(plan, "prior")
    assert side is not None
    weights = [weight for _, weight in side.drives]
    assert weights[0] / weights[1] == pytest.approx(SOON / LATE)
