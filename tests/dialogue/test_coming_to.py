"""When we come to a light, a line or a junction on our way, and when we turn."""

import math
import re

import pytest

from sim.scene import EGO
from tests.dialogue.talking import Talk, ride

AHEAD = {"junction-0": "right", "city-0": "right", "town-0": "right"}


@pytest.mark.parametrize("name", ["junction-0", "city-0"])
@pytest.mark.parametrize(
    "question",
    [
        "How long till we're at the light?",
        "How long until we reach the light?",
        "When do we get to the light?",
        "When are we at the light?",
        "How long to the light?",
    ],
)
def test_the_time_to_a_light_is_about_what_it_takes(name: str, question: str) -> None:
    asked = 6.0
    told = Talk(name, asked).hear(question)
    found = re.fullmatch(r"We should reach the traffic light in about (\d+) seconds\.", told)
    assert found is not None, told
    assert float(found[1]) == pytest.approx(_at_light(name) - asked, rel=0.35, abs=2.0)


def _at_light(name: str) -> float:
    """When [s] our front was within 3 m of the first light, by the decisions."""
    for trace in ride(name).traces:
        lights = () if trace.road is None else trace.road.lights
        if lights and lights[0].distance <= 3.0:
            return trace.sim_time
    raise AssertionError(f"{name} comes to no light")


@pytest.mark.parametrize(
    "question", ["How long till we're at the light?", "When do we pass the light?"]
)
@pytest.mark.parametrize("name", ["town-0", "s3-0"])
def test_where_no_light_is_in_view_none_is_passed(name: str, question: str) -> None:
    told = Talk(name, 3.0).hear(question)
    assert told == "I see no traffic light on our way, and we have passed none."


@pytest.mark.parametrize(
    "question", ["When will we be at the stop line?", "How long till we're at the line?"]
)
def test_a_line_without_a_light_is_that_of_the_junction(question: str) -> None:
    line = Talk("town-0", 3.0).hear(question)
    junction = Talk("town-0", 3.0).hear("When do we get to the next junction?")
    assert line == junction.replace("the next junction", "the line")


@pytest.mark.parametrize("name", AHEAD)
@pytest.mark.parametrize("at", [2.0, 3.0, 5.0])
def test_a_turn_on_our_way_is_not_denied(name: str, at: float) -> None:
    told = Talk(name, at).hear(f"When do we turn {AHEAD[name]}?")
    assert re.match(rf"(We|I will) turn {AHEAD[name]} (in about|at the)", told), told


def test_the_time_of_a_turn_is_when_we_come_to_its_junction() -> None:
    told = Talk("town-0", 20.0).hear("When do we turn right?")
    found = re.fullmatch(r"I will turn right in about (\d+) seconds\.", told)
    assert found is not None, told
    near = [t for t in ride("town-0").traces if t.sim_time <= 20.0][-1]
    assert near.road is not None
    step = next(one for one in near.road.route if one.turn == "exit-right")
    way = 0.0
    for one, after in zip(ride("town-0").traces, ride("town-0").traces[1:], strict=False):
        if one.sim_time < near.sim_time:
            continue
        way += math.dist(one.scene[EGO].position, after.scene[EGO].position)
        if way >= step.distance:
            assert float(found[1]) == pytest.approx(after.sim_time - 20.0, abs=2.0)
            return
    raise AssertionError("we did not come there")


@pytest.mark.parametrize(
    "text", ["What's the next turn?", "which way now", "How many turns are left?", "Where next?"]
)
def test_after_arriving_there_is_no_way_ahead(text: str) -> None:
    assert Talk("bend-0").hear(text) == "We have arrived at our destination."
