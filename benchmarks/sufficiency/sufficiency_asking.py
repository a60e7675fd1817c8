"""The questions of `xavi bench sufficiency`, about plan and foils at recorded decisions."""

from collections.abc import Sequence
from typing import Literal, TypeAlias

import msgspec

from benchmarks.drive.runs import warm
from planner.record.trace import Action, PlanTrace
from sim.roads.network import Network
from sim.setup.scenario import load
from xavi_dialogue.service.in_process import Conversation, make_pipeline, planner_for
from xavi_dialogue.vehicle.episode import Moment, clock, network_of, start

Kind: TypeAlias = Literal["why", "why-not", "instead", "what-if", "how"]
KINDS: tuple[Kind, ...] = ("why", "why-not", "instead", "what-if", "how")
#: The base form, participle, simple past and gerund of each action.
WORDS: dict[Action, tuple[str, str, str, str]] = {
    "continue": ("stay in your lane", "stayed in your lane", "stayed in your lane", "driving on"),
    "change-left": ("move to the left lane", "moved to the left lane", "moved to the left lane",
                    "moving to the left lane"),
    "change-right": ("move to the right lane", "moved to the right lane",
                     "moved to the right lane", "moving to the right lane"),
    "exit-left": ("turn left", "turned left", "turned left", "turning left"),
    "exit-right": ("turn right", "turned right", "turned right", "turning right"),
    "exit-straight": ("go straight on", "gone straight on", "went straight on",
                      "going straight on"),
    "continue-next-exit": ("continue to the next exit", "continued to the next exit",
                           "continued to the next exit", "continuing to the next exit"),
    "stop": ("stop", "stopped", "stopped", "stopping"),
}  # fmt: skip
#: The words for `continue` if the action that was chosen is no lane change.
AHEAD = ("go straight on", "gone straight on", "went straight on", "going straight on")
#: Questions with a foil: the kind, and the text with base, participle, past and gerund of the
#: foil, and base and gerund of the plan's first action.
OF_FOIL: tuple[tuple[Kind, str], ...] = (
    ("why-not", "Why don't you {base}?"),
    ("why-not", "Why did you not {base}?"),
    ("why-not", "Why aren't you {gerund}?"),
    ("instead", "Why are you {fact_gerund} instead of {gerund}?"),
    ("instead", "Why {fact_base} rather than {base}?"),
    ("what-if", "What if you had {participle}?"),
    ("what-if", "What would happen if you {past} now?"),
    ("what-if", "What would have happened if you had {participle} instead?"),
)
OF_PLAN: tuple[tuple[Kind, str], ...] = (
    ("why", "Why are you {fact_gerund}?"),
    ("why", "What is the reason for {fact_gerund}?"),
    ("why", "Why did you decide to {fact_base}?"),
    ("how", "How did you decide?"),
    ("how", "How did you decide to {fact_base}?"),
)


class Put(msgspec.Struct, frozen=True):
    """A question, with the foil that it names."""

    kind: Kind
    text: str
    foil: Action | None = None


class Answered(msgspec.Struct, frozen=True):
    """A question at a decision, and the text of its answer."""

    at: float  # [s]
    put: Put
    text: str
    kind: str  # answer, refusal or clarification
    trace_id: str | None  # of the decision that the answer names
    again: tuple[PlanTrace, ...] = ()  # plans made again so far


class Asked(msgspec.Struct, frozen=True):
    """A ride with all questions asked on it, and their answers."""

    scenario: str
    seed: int
    moments: tuple[Moment, ...]
    answers: tuple[Answered, ...]


def questions(trace: PlanTrace) -> list[Put]:
    """Return the questions about a decision: its plan, and each first action not chosen."""
    plan = trace.plan[0].action
    base, _, _, gerund = WORDS[plan]
    fact = {"fact_base": base, "fact_gerund": gerund}
    tried = dict.fromkeys(r.actions[0].action for r in trace.rollouts if r.actions)
    found = [Put(kind, form.format(**fact)) for kind, form in OF_PLAN]
    for foil in tried:
        if foil != plan:
            ahead = foil == "continue" and not plan.startswith("change")
            words = AHEAD if ahead else WORDS[foil]
            names = dict(zip(("base", "participle", "past", "gerund"), words, strict=True))
            found += [Put(kind, form.format(**names, **fact), foil) for kind, form in OF_FOIL]
    return found


def asked(scenario: str, seed: int, every: int) -> Asked:
    """Drive a scenario to its end, and ask at every n-th of its decisions (`every`).

    Raises:
        SimulationError: SUMO is not installed or fails.
    """
    warm()
    world = load(scenario, seed)
    network = network_of(world)
    with start(world, network) as ride:
        moments = tuple(ride)
    return Asked(scenario, seed, moments, tuple(answers(moments, network, every)))


def answers(moments: Sequence[Moment], network: Network, every: int) -> list[Answered]:
    """Answer the questions at every n-th decision of a ride, each as if it were the first."""
    conversation = Conversation(make_pipeline(), planner_for(network))
    found: list[Answered] = []
    decisions = 0
    for moment in moments:
        conversation.record(moment)
        if moment.trace is None or not moment.trace.plan:
            continue
        decisions += 1
        if (decisions - 1) % every:
            continue
        fresh = conversation.dialogue
        for put in questions(moment.trace):
            conversation.dialogue = fresh
            reply = conversation.ask(put.text, clock(moment))
            again = tuple(conversation.dialogue.planned.values())
            found.append(
                Answered(clock(moment), put, reply.text, reply.kind, reply.trace_id, again)
            )
        conversation.dialogue = fresh
    return found
