"""Playing of a transcript, whose questions are asked in a conversation one after the other.

Incidents reach the conversation as they do on the road: as a failed plan, as a record without
traces, or as stored turns. No reply is made here.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import get_args

from planner.record.trace import PlanTrace
from xavi_dialogue.dialogue.manager import fold
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.events import Input, Resumed
from xavi_dialogue.domain.answers import NeedRollout, Reason
from xavi_dialogue.nlg.context import Style
from xavi_dialogue.service.in_process import SESSION, Conversation, NoPlan, Replan
from xavi_dialogue.transcripts.transcript import (
    At,
    Befallen,
    Exchange,
    Incident,
    Step,
    Transcript,
    TranscriptError,
)

#: Why there is no plan, by incident.
FAILING: dict[Befallen, Reason] = {
    "planner fails": "planner-failed",
    "planner late": "timed-out",
    "planner gone": "planner-unavailable",
}


@dataclass(frozen=True, slots=True)
class Played:
    """A transcript with its present replies."""

    transcript: Transcript
    replies: tuple[Reply, ...]  # in the order of its questions


def play(
    transcript: Transcript, pipeline: Pipeline, record: Sequence[Input], halt: float, again: Replan
) -> Played:
    """Ask all questions of a transcript again.

    Args:
        transcript: the questions; its replies are not looked at.
        pipeline: answers them.
        record: of the ride, in order.
        halt: [s] the moment of questions before which none is written.
        again: plans again.

    Raises:
        TranscriptError: a question is to be asked while the planner works, but it does not work.
    """
    player = _Player(pipeline, record, again, halt, _style(transcript))
    return player.play(transcript)


def latest(transcript: Transcript) -> float:
    """Return the latest time [s] in a transcript, 0 if there is none."""
    return max((step.time for step in transcript.steps if isinstance(step, At)), default=0.0)


@dataclass
class _Player:
    pipeline: Pipeline
    record: Sequence[Input]
    again: Replan
    at: float  # [s]
    style: Style
    failing: Reason | None = None  # why plans fail now
    interruption: str | None = None  # a question to ask as soon as the planner works
    interrupted: Reply | None = None  # the reply to it
    conversation: Conversation = field(init=False)

    def __post_init__(self) -> None:
        self.conversation = Conversation(
            self.pipeline, self._plan, fold(self.pipeline, self.record)
        )

    def play(self, transcript: Transcript) -> Played:
        steps: list[Step] = []
        replies: list[Reply] = []
        for index, step in enumerate(transcript.steps):
            match step:
                case At(time):
                    self.at = time
                case Incident(what):
                    self._befall(what)
                case Exchange(question):
                    self.interruption = _meanwhile(transcript.steps[index + 1 :])
                    replies.append(self._ask(question))
                    step = replace(step, reply=replies[-1].text)
            steps.append(step)
        return Played(replace(transcript, steps=tuple(steps)), tuple(replies))

    def _ask(self, question: str) -> Reply:
        if self.interrupted is not None:
            reply, self.interrupted = self.interrupted, None
            return reply
        reply = self.conversation.ask(question, self.at, self.style)
        if self.interruption is not None:
            raise TranscriptError(f"the planner is not needed for {question!r}")
        return reply

    def _plan(self, trace: PlanTrace, need: NeedRollout) -> PlanTrace:
        if self.interruption is not None:
            question, self.interruption = self.interruption, None
            self.interrupted = self.conversation.ask(question, self.at, self.style)
        if self.failing is not None:
            raise NoPlan(self.failing)
        return self.again(trace, need)

    def _befall(self, what: Befallen) -> None:
        match what:
            case "planner answers" | "planner fails" | "planner late" | "planner gone":
                self.failing = FAILING.get(what)
            case "no record":
                self.conversation.dialogue = replace(self.conversation.dialogue, traces=())
            case "record":
                traces = fold(self.pipeline, self.record).traces
                self.conversation.dialogue = replace(self.conversation.dialogue, traces=traces)
            case "restart":
                turns = self.conversation.dialogue.session(SESSION).turns
                inputs = (*self.record, Resumed(SESSION, turns))
                self.conversation.dialogue = fold(self.pipeline, inputs)
            case "meanwhile":  # has been looked up for the question before
                pass


def _meanwhile(steps: Sequence[Step]) -> str | None:
    """Return the question to ask before the previous one is answered."""
    following = iter(steps)
    for step in following:
        if isinstance(step, Exchange):
            return None
        if step == Incident("meanwhile"):
            return next((s.question for s in following if isinstance(s, Exchange)), None)
    return None


def _style(transcript: Transcript) -> Style:
    style = transcript.get("style", "passenger")
    for known in get_args(Style):
        if style == known:
            return known  # type: ignore[no-any-return]
    raise TranscriptError(f"there is no style {style!r}")
