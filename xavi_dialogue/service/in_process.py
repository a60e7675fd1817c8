"""A conversation about a ride within one process, without a bus."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TypeAlias

import msgspec

from planner.counterfactuals.whatif import WhatIfError, replan
from planner.record.trace import PlanTrace, WhatIf
from sim.roads.network import Network
from xavi_dialogue.dialogue.manager import advance
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.dialogue.recollection import Recollection
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.events import (
    Answered,
    Asked,
    EventRecorded,
    Input,
    Output,
    RideEnded,
    RolloutsArrived,
    RolloutsFailed,
    RolloutsWanted,
    SceneSeen,
    TraceRecorded,
)
from xavi_dialogue.dialogue.state.state import Dialogue
from xavi_dialogue.domain.answers import NeedRollout, Reason
from xavi_dialogue.errors import XaviError
from xavi_dialogue.nlg.context import Style
from xavi_dialogue.nlg.say import say
from xavi_dialogue.nlu.interpret import interpret
from xavi_dialogue.vehicle.episode import Moment, clock, halts

SESSION = "passenger"

#: May raise WhatIfError or NoPlan.
Replan: TypeAlias = Callable[[PlanTrace, NeedRollout], PlanTrace]


class NoPlan(XaviError):
    """A plan is not available; the reason is the one that the passenger gets."""

    def __init__(self, reason: Reason, *, roadless: bool = False) -> None:
        super().__init__(reason)
        self.reason = reason
        self.roadless = roadless  # the record holds no roads on which anything could be planned


def make_pipeline() -> Pipeline:
    """Return the pipeline of parser, explanations and wording."""
    known = Recollection()
    return Pipeline(
        read=interpret, ground=known.ground, explain=known.explain, say=say, see=known.see
    )


def planner_for(network: Network) -> Replan:
    """Return a function that plans again on a network; it can be pickled."""
    return partial(_again, network)


def _again(network: Network, trace: PlanTrace, need: NeedRollout) -> PlanTrace:
    return replan(trace, network, msgspec.convert(msgspec.to_builtins(need), WhatIf))


def inputs_of_moment(moment: Moment) -> tuple[Input, ...]:
    """Convert one moment of a ride to inputs of the dialogue."""
    time = clock(moment)
    trace = () if moment.trace is None else (TraceRecorded(moment.trace),)
    seen = SceneSeen(replace(moment.scene, time=time))
    over = () if moment.ending is None else (RideEnded(time),)
    return (*trace, *map(EventRecorded, moment.events), seen, *over)


@dataclass
class Conversation:
    """One passenger's conversation about a ride, recorded up to the time of each question."""

    pipeline: Pipeline
    again: Replan
    dialogue: Dialogue = field(default_factory=Dialogue)
    asked: int = 0

    def record(self, moment: Moment) -> None:
        """Take down one moment of the ride."""
        for event in inputs_of_moment(moment):
            self._tell(event)

    def ask(self, text: str, at: float, style: Style = "passenger") -> Reply:
        """Return the reply to a question asked at a moment [s] of the ride."""
        self.asked += 1
        request = str(self.asked)
        output = self._tell(Asked(request, SESSION, text, at, style))
        while isinstance(output, RolloutsWanted):
            output = self._tell(self._plan_again(request, output.need))
        assert isinstance(output, Answered)
        return output.reply

    def _plan_again(self, request: str, need: NeedRollout) -> RolloutsArrived | RolloutsFailed:
        known = (trace for trace in self.dialogue.traces if trace.trace_id == need.trace_id)
        try:
            return RolloutsArrived(request, SESSION, self.again(next(known), need))
        except (StopIteration, WhatIfError):
            return RolloutsFailed(request, SESSION, "planner-failed")
        except NoPlan as none:
            return RolloutsFailed(request, SESSION, none.reason, none.roadless)

    def _tell(self, event: Input) -> Output | None:
        self.dialogue, outputs = advance(self.pipeline, self.dialogue, event)
        return outputs[0] if outputs else None


def drive_to(ride: Iterable[Moment], conversation: Conversation, until: float | None) -> float:
    """Drive and record up to a moment.

    Args:
        ride: the moments still to come.
        conversation: records them.
        until: [s]; None stands for the end of the first lane change or turn.

    Returns:
        The time [s] reached: `until`, or that of the last moment if `until` is None or the ride
        ended before.
    """
    time = 0.0
    for moment in ride:
        conversation.record(moment)
        time = clock(moment)
        if halts(until, time, conversation.dialogue.events):
            return time if until is None else until
    return time
