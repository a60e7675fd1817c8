"""Answers to common questions on a ride, checked statement by statement against what was seen."""

import pytest

from benchmarks.truth.checker import checked
from benchmarks.truth.ridden import Ridden, ridden
from sim.setup import scenario
from xavi_dialogue.service.in_process import Conversation, make_pipeline, planner_for
from xavi_dialogue.vehicle.episode import clock, network_of, start

QUESTIONS = (
    "Why are we braking?",
    "Why did you brake?",
    "Why are we so slow?",
    "What are you doing?",
    "What are you waiting for?",
    "Who goes first?",
    "How fast are we going?",
    "Who is behind us?",
    "Is it safe?",
    "Was that dangerous?",
    "How much time have we lost?",
    "What happened just now?",
    "What do you see?",
)
OF_ONE = (
    "What is vehicle {} doing?",
    "How fast is vehicle {} going?",
    "Where is vehicle {}?",
    "Who is vehicle {} waiting for?",
    "Where is vehicle {} going?",
    "Is vehicle {} faster than us?",
    "How close did we come to vehicle {}?",
    "Has vehicle {} stopped?",
)
MOMENTS = (4.3, 7.7, 10.4, 13.6)  # [s]
COVERED = 0.5  # share of the sentences that patterns cover, at least

Answers = list[tuple[float, str, str]]


@pytest.fixture(scope="module", params=["s1", "s3"])
def asked(request: pytest.FixtureRequest) -> tuple[Ridden, Answers]:
    """A ride, and what was answered on it: times, questions and answers."""
    world = scenario.load(request.param, seed=1)
    network = network_of(world)
    with start(world, network) as ride:
        moments = list(ride)
    conversation = Conversation(make_pipeline(), planner_for(network))
    answers: Answers = []
    told = 0
    for at in (time for time in MOMENTS if time < clock(moments[-1])):
        while told < len(moments) and clock(moments[told]) <= at + 1e-6:
            conversation.record(moments[told])
            told += 1
        fresh = conversation.dialogue
        seen = [vehicle for vehicle in moments[told - 1].scene.vehicles if vehicle][:2]
        for text in (*QUESTIONS, *(one.format(v) for v in seen for one in OF_ONE)):
            conversation.dialogue = fresh
            answers.append((at, text, conversation.ask(text, at).text))
        conversation.dialogue = fresh
    return ridden(moments), answers


def test_no_statement_is_false(asked: tuple[Ridden, Answers]) -> None:
    ride, answers = asked
    faults = [
        (at, question, answer, fault)
        for at, question, answer in answers
        for fault in checked(ride, at, question, answer)[0]
    ]
    assert faults == []


def test_most_sentences_are_checked(asked: tuple[Ridden, Answers]) -> None:
    ride, answers = asked
    met = [one.met for at, q, a in answers for one in checked(ride, at, q, a)[1]]
    assert sum(met) >= COVERED * len(met)


@pytest.mark.parametrize(
    "text",
    [
        "We are doing 199 km/h.",
        "Vehicle {} is doing 199 km/h.",
        "Vehicle {} is about 900 metres away from us.",
        "We came as close as 900 metres to vehicle {}, at 0:02.",
        "I am braking, because turning left carries a 77 % risk of a collision with vehicle {}.",
        "I expect vehicle {} to turn right (3.5 %), or else to turn left (47 %).",
        "I moved to the left lane at 9:59.",
    ],
)
def test_what_is_false_is_found(asked: tuple[Ridden, Answers], text: str) -> None:
    ride, answers = asked
    at = answers[-1][0]
    vehicle = next(v for v in ride.known(at) if v)
    assert checked(ride, at, "", text.format(vehicle))[0]
