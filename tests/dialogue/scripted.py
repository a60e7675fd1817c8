"""A scripted mind: it understands the names of what it shall do."""

from planner.record.trace import PlanTrace
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.domain.answers import (
    Activity,
    Answer,
    Contrast,
    Evidence,
    NeedRollout,
    NotUnderstood,
    Refusal,
    SupposedOfUs,
    TooLittle,
    WhichOne,
)
from xavi_dialogue.domain.discourse import Discourse, GroundedAct
from xavi_dialogue.domain.meaning import Act, Ask, Identify, Quizzing, Reading, Repair
from xavi_dialogue.domain.terms import Ego, Unknown
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.nlg.context import SpeechContext, Utterance
from xavi_dialogue.nlu.grounding.result import Grounding

_LACKING = {"lack": 1, "lack, break": 1, "lack more": 2, "lack forever": 99}


def order(text: str) -> Act:
    """The act of a text that names what the mind shall do."""
    return Ask(Identify(Unknown(text)))


def scripted_pipeline() -> Pipeline:
    """Understands "answer", "lack", "lack more", "suppose", "refuse", "huh", "either" and more.

    The others are "quiz me", "the second", "break" and "lack, break"; any other text is answered.
    """

    def read(text: str) -> tuple[Reading, ...]:
        acts: dict[str, tuple[Act, ...]] = {
            "huh": (),
            "quiz me": (Quizzing(),),
            "the second": (Repair("pick", pick=2),),
        }
        return (Reading(acts=acts.get(text, (order(text),)), shares=()),)

    return Pipeline(read, _ground, _explain, _say, lambda record: {})


def _ground(readings: tuple[Reading, ...], record: Record, discourse: Discourse) -> Grounding:
    reading = readings[0]
    if not reading.acts:
        return Grounding(reading=reading, refusal=NotUnderstood(("huh",)))
    act = reading.acts[0]
    if act == order("either"):
        offers = (order("answer"), order("refuse"))
        which = WhichOne((Unknown("answer"), Unknown("refuse")), between="meanings")
        return Grounding(clarify=which, reading=reading, offers=offers, pending=offers[0])
    if isinstance(act, Repair) and act.pick is not None and discourse.offered:
        act = discourse.offered[act.pick - 1]
    return Grounding(acts=(GroundedAct(act),), reading=reading)


def _explain(act: GroundedAct, record: Record) -> Answer | Refusal | NeedRollout:
    text = _text(act)
    first = record.traces[0].trace_id if record.traces else "none"
    if text == "break" or (text == "lack, break" and record.extra):
        raise ZeroDivisionError
    if text is None or text == "refuse":
        return TooLittle("too-little-evidence")
    if text == "suppose" and not record.extra:
        return NeedRollout(first, vehicle=1, goal="exit-right", vehicle_actions=("stop",))
    if len(record.extra) < _LACKING.get(text, 0):
        return NeedRollout(first, rollouts=len(record.extra) + 1)
    if text == "foil":
        return foil(record.traces[-1])
    return activity(record)


def activity(record: Record) -> Activity:
    """What the car is doing at the end of a record."""
    return Activity(Ego(), record.now, (), 10.0, "steady")


def foil(trace: PlanTrace) -> SupposedOfUs:
    """What would have come of another action at a decision."""
    evidence = Evidence("tree", 1, 1, (trace.trace_id,))
    contrast = Contrast(("continue",), ("stop",), None, (), (), evidence, trace.sim_time)
    return SupposedOfUs(contrast)


def _text(act: GroundedAct) -> str | None:
    match act.act:
        case Ask(question=Identify(thing=Unknown(words=words))):
            return words
    return None


def _say(result: Answer | Refusal, context: SpeechContext) -> Utterance:
    choices = ("answer", "refuse") if isinstance(result, WhichOne) else ()
    return Utterance(f"{type(result).__name__} at {context.now:g} s.", choices=choices)
