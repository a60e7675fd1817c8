"""One ride of a story: the answers about its foils, their evidence, and what happens in SUMO."""

from collections.abc import Sequence
from contextlib import suppress

import msgspec
from msgspec.structs import replace

from benchmarks.fidelity.forking import ChildFailed
from benchmarks.fidelity.resimulate import Aim, Happened, drive_foil
from benchmarks.reproduce.claims import Claim, claim_of
from benchmarks.reproduce.rows import FOILS, Foil, rows_of
from benchmarks.reproduce.weighing import Weighed, weigh
from planner.driving.driver import Driver
from planner.record.trace import Action, EgoGoal, PlanTrace
from sim.roads.network import Network
from sim.setup.scenario import Scenario, load
from sim.sumo import Simulation
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.state import EPSILON
from xavi_dialogue.domain.answers import Answer, Contrast, Reason, Refusal
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.paper import contrast_of
from xavi_dialogue.nlg.say import say
from xavi_dialogue.service.in_process import Conversation, drive_to, make_pipeline, planner_for
from xavi_dialogue.vehicle.episode import network_of, settings_of, start


class Wording(msgspec.Struct, frozen=True):
    """A sentence with limited numbers of effects and causes."""

    effects: int
    causes: int
    text: str
    claim: Claim


class Told(msgspec.Struct, frozen=True):
    """The result of asking about one foil."""

    foil: Foil
    seed: int
    answer: str = ""  # text of the answer or refusal
    declined: Reason | None = None
    decided: float | None = None  # [s] when the decision explained was taken
    wordings: tuple[Wording, ...] = ()  # one for each size that a row of the foil has
    weighed: Weighed | None = None
    happened: Happened | None = None  # in SUMO; None: could not be driven
    error: str | None = None  # of a ride that failed


def tell(task: tuple[str, int]) -> tuple[Told, ...]:
    """Drive a scenario with a seed, and ask about its foils; errors are part of the result."""
    name, seed = task
    foils = tuple(foil for foil in FOILS if foil.scenario == name)
    try:
        return _tell(load(name, seed), foils)
    except Exception as error:
        return broken(task, f"{type(error).__name__}: {error}")


def broken(task: tuple[str, int], error: str) -> tuple[Told, ...]:
    """Describe a ride that failed."""
    name, seed = task
    return tuple(Told(foil, seed, error=error) for foil in FOILS if foil.scenario == name)


def _tell(scenario: Scenario, foils: tuple[Foil, ...]) -> tuple[Told, ...]:
    network = network_of(scenario)
    conversation = Conversation(make_pipeline(), planner_for(network))
    with start(scenario, network) as ride:
        at = drive_to(ride, conversation, None)
    told = tuple(_ask(conversation, foil, scenario.seed, at, network) for foil in foils)
    happened = _drive(scenario, network, told)
    return tuple(replace(one, happened=happened.get(one.foil.action)) for one in told)


def _ask(conversation: Conversation, foil: Foil, seed: int, at: float, network: Network) -> Told:
    reply = conversation.ask(foil.question, at, "paper")
    answer = _contrastive(reply)
    if answer is None:
        return Told(foil, seed, reply.text, reply.reason or "no-influence")
    contrast = contrast_of(answer)
    assert contrast is not None
    dialogue = conversation.dialogue
    known = (*dialogue.traces, *dialogue.planned.values())
    trace = next(one for one in known if one.trace_id == reply.trace_id)
    return Told(
        foil,
        seed,
        reply.text,
        decided=contrast.decided,
        wordings=_wordings(answer, contrast, foil),
        weighed=_weighed(contrast, trace, dialogue.traces, foil, network),
    )


def _contrastive(reply: Reply) -> Answer | Refusal | None:
    """Return the first answer of a reply for which the paper has a sentence; None if none."""
    answers = msgspec.convert(reply.answers, tuple[Answer | Refusal, ...])
    return next((one for one in answers if contrast_of(one) is not None), None)


def _wordings(answer: Answer | Refusal, contrast: Contrast, foil: Foil) -> tuple[Wording, ...]:
    """Return the wordings of the answer in each size that the rows of its foil have."""
    found = []
    for effects, causes in dict.fromkeys((row.effects, row.causes) for row in rows_of(foil)):
        context = SpeechContext(style="paper", max_effects=effects, max_causes=causes)
        text = say(answer, context).text
        claim = claim_of(contrast, effects, causes)
        found.append(Wording(effects, causes, text, claim))
    return tuple(found)


def _weighed(
    found: Contrast,
    trace: PlanTrace,
    traces: Sequence[PlanTrace],
    foil: Foil,
    network: Network,
) -> Weighed | None:
    before = [one for one in traces if one.sim_time < trace.sim_time]
    return weigh(trace, before, found.fact, foil.action, rows_of(foil), network)


def _drive(scenario: Scenario, network: Network, told: Sequence[Told]) -> dict[Action, Happened]:
    """Return what happens in SUMO after the foils, from the decisions that were explained.

    One that cannot be driven is left out.
    """
    asked = [one for one in told if one.decided is not None]
    goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
    driver = Driver(network, goal, settings_of(scenario), scenario.seed)
    found: dict[Action, Happened] = {}
    with Simulation(scenario) as world:
        scene = world.scene()
        last = max((one.decided for one in asked if one.decided is not None), default=-1.0)
        while scene.time <= last + EPSILON:
            driven = driver.step(scene, scenario.step)
            for one in asked if driven.trace is not None else ():
                if driven.trace is not None and driven.trace.sim_time == one.decided:
                    aim, foil = Aim.of(network, driven.trace), one.foil.action
                    with suppress(ChildFailed):
                        found[foil] = drive_foil(world, driver, aim, (foil,), scene, scenario.step)
            scene = world.step(driven.command)
    return found
