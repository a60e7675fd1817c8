"""Conversations in tests: on a recorded ride, with our parser and our explanations."""

from functools import cache
from pathlib import Path

from planner.record.trace import PlanTrace
from xavi_dialogue.dialogue.manager import advance, fold
from xavi_dialogue.dialogue.state.events import (
    Answered,
    Asked,
    EventRecorded,
    Input,
    Output,
    Resumed,
    RideEnded,
    RolloutsArrived,
    RolloutsFailed,
    RolloutsWanted,
    TraceRecorded,
)
from xavi_dialogue.dialogue.state.state import Dialogue, Session
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.storage import ride_file

RIDES = Path(__file__).parents[2] / "transcripts" / "rides"
PIPELINE = make_pipeline()
NAME = "ada"


@cache
def ride(name: str) -> ride_file.RecordedRide:
    """A recorded ride, as in "s1-0"."""
    return ride_file.load((RIDES / f"{name}.ride.jsonl.gz").read_bytes())


@cache
def driven(name: str) -> Dialogue:
    """The state after all that was recorded of a ride, before anything was asked."""
    known = ride(name)
    inputs: list[Input] = [*map(TraceRecorded, known.traces), *map(EventRecorded, known.events)]
    return fold(PIPELINE, [*inputs, *([] if known.ended is None else [RideEnded(known.ended)])])


class Talk:
    """One passenger's conversation; plans that the recording lacks are not to be had."""

    def __init__(self, name: str = "s1-0", at: float | None = None, *, planner: bool = True):
        self.ride = ride(name)
        self.at = self.ride.halt if at is None else at  # [s]
        self.planner = planner
        self.dialogue = driven(name)
        self.asked = 0

    def say(self, text: str, at: float | None = None) -> Turn:
        """Say something, now or from a moment [s] on; the turn that comes of it."""
        self.at = self.at if at is None else at
        self.asked += 1
        output = self._put(Asked(str(self.asked), NAME, text, self.at))
        while isinstance(output, RolloutsWanted):
            output = self._put(self._planned(output))
        assert output.turn is not None
        return output.turn

    def hear(self, *texts: str) -> str:
        """Say these one after another; the reply to the last."""
        return [self.say(text).reply.text for text in texts][-1]

    def resume(self, turns: tuple[Turn, ...]) -> None:
        """Go on with a conversation of before."""
        self.dialogue, _ = advance(PIPELINE, self.dialogue, Resumed(NAME, turns))

    @property
    def session(self) -> Session:
        """The conversation so far."""
        return self.dialogue.session(NAME)

    def _planned(self, wanted: RolloutsWanted) -> RolloutsArrived | RolloutsFailed:
        found: PlanTrace | None = self.ride.whatifs.get(ride_file.key(wanted.need))
        if found is None or not self.planner:
            return RolloutsFailed(wanted.request, NAME, "planner-unavailable")
        return RolloutsArrived(wanted.request, NAME, found)

    def _put(self, event: Input) -> Output:
        self.dialogue, [output] = advance(PIPELINE, self.dialogue, event)
        assert isinstance(output, Answered | RolloutsWanted)
        return output
