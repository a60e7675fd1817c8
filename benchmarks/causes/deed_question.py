"""The question about an action of a ride, chosen by one rule for every ride, and its answer.

First choice is a lane change that the ego does not make when it drives the same way alone. Second
is the place where, after its speed had fallen, it is slowest relative to its drive alone: giving
way if it did so about then, stopping if it stood, else slowing down. If nothing of this happened,
the question is about the foil `continue`.
"""

from bisect import bisect_left
from collections import Counter
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from planner.counterfactuals.whatif import WhatIfError
from planner.record.events import Event
from planner.record.trace import PlanTrace
from sim.roads.network import Network
from sim.setup.scenario import Scenario
from xavi_dialogue.dialogue.explanation import evidence_of
from xavi_dialogue.dialogue.manoeuvres import carried_out
from xavi_dialogue.domain.answers import Answer, NeedRollout, Refusal, Unavailable
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Ask, Why
from xavi_dialogue.domain.terms import Event as Doing
from xavi_dialogue.domain.terms import Happens, Not
from xavi_dialogue.explain.answers.engine import explain
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.service.in_process import Replan
from xavi_dialogue.vehicle.episode import Ending, clock, start

Deed: TypeAlias = Literal[
    "change-left", "change-right", "give-way", "stop", "slow-down", "continue"
]

SLOWER = 2.0  # [m/s] least difference to the drive alone for a marked action
STANDING = 0.3  # [m/s] below which the ego stands
FALLEN = 1.5  # [m/s] least loss of speed ...
WITHIN = 10.0  # [s] ... within this time
ABOUT = (6.0, 2.0)  # [s] before and after the slowest moment, within which giving way counts
LATER = 2.0  # [s] from the slowest moment to the question
ROUNDS = 8  # greatest number of rounds of planning again for one question


@dataclass(frozen=True, slots=True)
class Ridden:
    """A complete ride by our planner."""

    ending: Ending
    traces: tuple[PlanTrace, ...]
    events: tuple[Event, ...]
    time: tuple[float, ...]  # [s] [N]
    gone: tuple[float, ...]  # [m] driven since the start [N]
    speed: tuple[float, ...]  # [m/s] of the ego [N]

    @property
    def manoeuvres(self) -> tuple[str | None, ...]:
        """The lane changes and turns carried out, in order."""
        return tuple(event.action for event in carried_out(self.events))

    def record(self, now: float) -> Record:
        """Return the record at a time [s]."""
        traces = tuple(trace for trace in self.traces if trace.sim_time <= now)
        events = tuple(event for event in self.events if event.sim_time <= now)
        return Record(now, traces, events, ended=now >= self.time[-1])


@dataclass(frozen=True, slots=True)
class Question:
    """An action, and the time of the question about it."""

    deed: Deed
    now: float  # [s]
    usual: bool = False  # whether the ego also does it when alone

    @property
    def moment(self) -> float:
        """The time [s] at which the action is most marked."""
        return self.now - LATER

    @property
    def act(self) -> GroundedAct:
        """The question as a grounded act."""
        done = Happens(Doing(self.deed))
        return GroundedAct(Ask(Why(Not(done) if self.deed == "continue" else done)))


def ride(scenario: Scenario, network: Network) -> Ridden:
    """Drive a scenario to its end by our planner.

    Raises:
        SimulationError: SUMO is not installed or fails.
        DriverError: the car cannot go on.
    """
    traces: list[PlanTrace] = []
    events: list[Event] = []
    samples: list[tuple[float, float]] = []
    ending: Ending = "duration"
    with start(scenario, network) as moments:
        for moment in moments:
            traces += [moment.trace] if moment.trace is not None else []
            events += moment.events
            samples.append((clock(moment), moment.scene.ego.speed))
            ending = moment.ending or ending
    time, speed = zip(*samples, strict=True)
    gone = np.concatenate(([0.0], np.cumsum(np.asarray(speed[1:]) * np.diff(time))))
    return Ridden(ending, tuple(traces), tuple(events), time, tuple(gone.tolist()), speed)


def question(ridden: Ridden, alone: Ridden) -> Question:
    """Return the question about the most marked action, by the rule above.

    Args:
        ridden: the ride.
        alone: the ride on the same roads without others.
    """
    usual = Counter(alone.manoeuvres)
    for event in carried_out(ridden.events):
        if event.action in ("change-left", "change-right") and not usual[event.action]:
            return Question(
                "change-left" if event.action == "change-left" else "change-right", event.sim_time
            )
    slowest = _slowest(ridden, alone)
    if slowest is None:
        return Question("continue", ridden.time[-1])
    moment = ridden.time[slowest]
    now = moment + LATER
    waits = (e.sim_time for e in ridden.events if e.kind == "gave-way")
    if any(moment - ABOUT[0] <= time <= moment + ABOUT[1] for time in waits):
        return Question("give-way", now)
    return Question("stop" if ridden.speed[slowest] < STANDING else "slow-down", now)


def slowing(ridden: Ridden, alone: Ridden) -> Question | None:
    """Return the question about where the ego slowed down most; None if it did not clearly."""
    fall = [_lately(ridden, k) - ridden.speed[k] for k in range(len(ridden.speed))]
    inside = bisect_left(ridden.gone, alone.gone[-1])
    most = max(range(1, inside), key=lambda k: round(fall[k], 1), default=0)
    if fall[most] < 2.0 * FALLEN:
        return None
    return Question("slow-down", ridden.time[most] + LATER, usual=True)


def ask(
    asked: Question, ridden: Ridden, again: Replan
) -> tuple[Answer | Refusal, tuple[PlanTrace, ...]]:
    """Return the answer, and the plans that were made again for it."""
    record = ridden.record(asked.now)
    extra: tuple[PlanTrace, ...] = ()
    for _ in range(ROUNDS):
        found = explain(
            asked.act, Record(record.now, record.traces, record.events, record.ended, extra)
        )
        if not isinstance(found, NeedRollout):
            return found, extra
        wanted = found.trace_id
        trace = next(trace for trace in record.traces if trace.trace_id == wanted)
        try:
            extra = (*extra, again(trace, found))
        except WhatIfError:
            break
    return Unavailable("planner-failed"), extra


def decision_of(ridden: Ridden, found: Answer | Refusal, now: float) -> PlanTrace:
    """Return the decision that an answer rests on; the last one if it names none."""
    evidence = evidence_of((found,))
    named = () if evidence is None else evidence.traces
    known = [trace for trace in ridden.traces if trace.sim_time <= now]
    return next((trace for trace in known if trace.trace_id in named), known[-1])


def _slowest(ridden: Ridden, alone: Ridden) -> int | None:
    """Return the sample at which a ride is slowest relative to the drive alone at that place.

    Only samples after a loss of speed count; of equally slow ones the first is taken.
    """
    free = np.interp(ridden.gone, alone.gone, alone.speed)
    loss = np.round(free - np.asarray(ridden.speed), 1)
    fallen = [
        k
        for k in range(bisect_left(ridden.gone, alone.gone[-1]))
        if loss[k] >= SLOWER and _lately(ridden, k) - ridden.speed[k] >= FALLEN
    ]
    return max(fallen, key=lambda k: (loss[k], -k), default=None)


def _lately(ridden: Ridden, sample: int) -> float:
    """Return the highest speed [m/s] in the last seconds before a sample."""
    first = bisect_left(ridden.time, ridden.time[sample] - WITHIN)
    return max(ridden.speed[first : sample + 1])
