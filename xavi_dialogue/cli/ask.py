"""`xavi ask`: drive up to a moment and answer one question, all in one process."""

import time

import msgspec

from sim.setup.scenario import Scenario
from xavi_dialogue.bus.messages import MAX_TEXT
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.nlg.context import Style
from xavi_dialogue.service.in_process import Conversation, drive_to, make_pipeline, planner_for
from xavi_dialogue.vehicle.episode import network_of, start


def ask_once(
    scenario: Scenario, text: str, until: float | None, style: Style = "passenger"
) -> Reply:
    """Return the reply to a question asked at a moment of the ride.

    Args:
        scenario: to drive, with the seed of the ride.
        text: the question.
        until: [s] time of the question; None stands for the end of the first lane change or turn.
        style: of the answer.

    Raises:
        SimulationError: SUMO is not installed or fails.
        DriverError: the car cannot be driven on.
    """
    network = network_of(scenario)
    conversation = Conversation(make_pipeline(), planner_for(network))
    with start(scenario, network) as ride:
        at = drive_to(ride, conversation, until)
    began = time.perf_counter()
    reply = conversation.ask(one_line(text)[:MAX_TEXT], at, style)
    taken = round((time.perf_counter() - began) * 1000.0, 3)
    return msgspec.structs.replace(reply, timing_ms=taken)
