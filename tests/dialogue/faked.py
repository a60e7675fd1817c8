"""A mind made by hand: what each text means and what each question is answered is laid down."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from tests.traces import s1_ride
from xavi_dialogue.dialogue.manager import advance, fold
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.dialogue.state.events import (
    Answered,
    Asked,
    EventRecorded,
    Input,
    Output,
    Resumed,
    RolloutsWanted,
    TraceRecorded,
)
from xavi_dialogue.dialogue.state.state import Dialogue, Session
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.domain.answers import Answer, NeedRollout, Refusal, WhichOne
from xavi_dialogue.domain.discourse import Discourse, GroundedAct
from xavi_dialogue.domain.meaning import Act, Reading, Repair
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.nlg.context import SpeechContext, Utterance
from xavi_dialogue.nlu.grounding.result import Grounding

NAME = "ada"
Explained = Answer | Refusal | NeedRollout


@dataclass
class Faked:
    """What texts mean and questions are answered; notes what it was told beside."""

    texts: Mapping[str, tuple[Act, ...]]
    answers: Mapping[Act, Explained | Callable[[Record], Explained]]
    groundings: Mapping[Act, Grounding] = field(default_factory=dict)
    doubts: Mapping[Act, tuple[str, ...]] = field(default_factory=dict)
    discourses: list[Discourse] = field(default_factory=list)
    contexts: list[SpeechContext] = field(default_factory=list)

    def pipeline(self) -> Pipeline:
        return Pipeline(self.read, self.ground, self.explain, self.say, lambda record: {})

    def read(self, text: str) -> tuple[Reading, ...]:
        return (Reading(acts=self.texts.get(text, ()), shares=()),)

    def ground(
        self, readings: tuple[Reading, ...], record: Record, discourse: Discourse
    ) -> Grounding:
        self.discourses.append(discourse)
        acts = tuple(_chosen(act, discourse) for act in readings[0].acts)
        for act in acts:
            if act in self.groundings:
                return self.groundings[act]
        words = self.doubts.get
        grounded = tuple(
            GroundedAct(act, doubts=words(act, ()), strange=words(act, ())) for act in acts
        )
        return Grounding(acts=grounded, reading=readings[0])

    def explain(self, act: GroundedAct, record: Record) -> Explained:
        found = self.answers[act.act]
        return found(record) if callable(found) else found

    def say(self, answer: Answer | Refusal, context: SpeechContext) -> Utterance:
        self.contexts.append(context)
        choices = ("this one", "that one") if isinstance(answer, WhichOne) else ()
        return Utterance(f"{type(answer).__name__}.", choices=choices)


class Talk:
    """A conversation with a mind made by hand, about the first story."""

    def __init__(self, faked: Faked) -> None:
        self.faked, self.pipeline = faked, faked.pipeline()
        ride = s1_ride()
        record: list[Input] = [
            *map(TraceRecorded, ride.traces),
            *map(EventRecorded, ride.events),
        ]
        self.dialogue: Dialogue = fold(self.pipeline, record)
        self.at = ride.now
        self.asked = 0

    def put(self, event: Input) -> Output | None:
        self.dialogue, outputs = advance(self.pipeline, self.dialogue, event)
        return outputs[0] if outputs else None

    def begin(self, text: str) -> Output | None:
        self.asked += 1
        return self.put(Asked(str(self.asked), NAME, text, self.at))

    def say(self, text: str) -> Turn:
        output = self.begin(text)
        assert isinstance(output, Answered), output
        assert output.turn is not None
        return output.turn

    def wants(self, text: str) -> NeedRollout:
        output = self.begin(text)
        assert isinstance(output, RolloutsWanted)
        return output.need

    def resume(self, turns: tuple[Turn, ...]) -> None:
        self.put(Resumed(NAME, turns))

    @property
    def session(self) -> Session:
        return self.dialogue.session(NAME)


def _chosen(act: Act, discourse: Discourse) -> Act:
    picks = isinstance(act, Repair) and act.pick is not None
    return discourse.offered[act.pick - 1] if picks and discourse.offered else act
