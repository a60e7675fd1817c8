"""`xavi transcripts`: golden conversations, replayed from recordings and from SUMO."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import get_args

from planner.trace import PlanTrace
from sim.scenario import load as load_scenario
from xavi_dialogue.app.local import Conversation, Replan, drive_to, make_mind, planner_for
from xavi_dialogue.app.ride import clock, network_of, start
from xavi_dialogue.dialogue.events import EventRecorded, RideEnded, TraceRecorded
from xavi_dialogue.dialogue.manager import advance
from xavi_dialogue.explain.explanation import NeedRollout
from xavi_dialogue.language.context import Style
from xavi_dialogue.transports import ride_file
from xavi_dialogue.transports.ride_file import RecordedRide, RideFileError
from xavi_dialogue.transports.transcript import (
    At,
    Exchange,
    Transcript,
    TranscriptError,
    read,
    write,
)

Note = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Replayed:
    """A transcript as it is now, and the ride behind it."""

    text: str
    ride: RecordedRide


def replay_recorded(transcript: Transcript, ride: RecordedRide) -> str:
    """The transcript as it comes out of a recorded ride, without SUMO and planner."""

    def again(_: PlanTrace, need: NeedRollout) -> PlanTrace:
        try:
            return ride.whatifs[ride_file.key(need)]
        except KeyError:
            wanted = f"{need.actions or need.removed} at {need.trace_id}"
            raise RideFileError(
                f"the recording holds no plan for {wanted}; accept it anew"
            ) from None

    conversation = Conversation(make_mind(), again)
    for event in _inputs(ride):
        conversation.dialogue, _ = advance(conversation.mind, conversation.dialogue, event)
    return write(_converse(transcript, conversation, ride.halt))


def replay_driven(transcript: Transcript) -> Replayed:
    """The transcript as it comes out of driving the scenario again."""
    scenario = load_scenario(_header(transcript, "scenario"))
    seed = int(_header(transcript, "seed"))
    network = network_of(scenario)
    planned: dict[str, PlanTrace] = {}
    conversation = Conversation(make_mind(), _keeping(planner_for(network), planned))
    with start(scenario, seed, network) as ride:
        halt = drive_to(ride, conversation, None)
        latest = max((s.time for s in transcript.steps if isinstance(s, At)), default=halt)
        for moment in ride if latest > halt else ():
            conversation.record(moment)
            if clock(moment) >= latest:
                break
    text = write(_converse(transcript, conversation, halt))
    known = conversation.dialogue
    recorded = RecordedRide(
        scenario=_header(transcript, "scenario"),
        seed=seed,
        halt=halt,
        traces=list(known.traces),
        events=list(known.events),
        ended=known.ended_at,
        whatifs=planned,
    )
    return Replayed(text, recorded)


def replay_all(folder: Path, *, accept: bool, note: Note) -> int:
    """Replay every transcript of a folder in SUMO; how many differ from what is written there.

    Raises:
        TranscriptError: the folder holds none, or one cannot be read.
    """
    paths = transcripts_in(folder)
    differing = 0
    for path in paths:
        text = path.read_text(encoding="utf-8")
        now = replay_driven(read(text))
        same = now.text == text and recorded_ride(path) == now.ride
        differing += not same
        if accept and not same:
            path.write_text(now.text, encoding="utf-8")
            ride_path(path).write_bytes(ride_file.dump(now.ride))
        note(f"{path}: {'as before' if same else 'accepted' if accept else 'differs'}")
    return differing


def transcripts_in(folder: Path) -> list[Path]:
    """The transcripts of a folder, sorted.

    Raises:
        TranscriptError: there are none.
    """
    paths = sorted(folder.glob("*.txt"))
    if not paths:
        raise TranscriptError(f"there are no transcripts (*.txt) in {folder}")
    return paths


def ride_path(path: Path) -> Path:
    """Where the recording of a transcript lies: beside it."""
    return path.with_suffix(".ride.jsonl.gz")


def recorded_ride(path: Path) -> RecordedRide | None:
    """The recording beside a transcript, None where there is none that can be read."""
    try:
        return ride_file.load(ride_path(path).read_bytes())
    except (OSError, RideFileError):
        return None


def _converse(transcript: Transcript, conversation: Conversation, halt: float) -> Transcript:
    """The same questions, with the replies given now."""
    style = _style(transcript)
    at = halt
    steps = []
    for step in transcript.steps:
        if isinstance(step, At):
            at = step.time
        if isinstance(step, Exchange):
            reply = conversation.ask(step.question, at, style)
            step = replace(step, reply=reply.text)
        steps.append(step)
    return replace(transcript, steps=tuple(steps))


def _inputs(ride: RecordedRide) -> Iterable[TraceRecorded | EventRecorded | RideEnded]:
    yield from map(TraceRecorded, ride.traces)
    yield from map(EventRecorded, ride.events)
    if ride.ended is not None:
        yield RideEnded(ride.ended)


def _keeping(again: Replan, kept: dict[str, PlanTrace]) -> Replan:
    """Plan again, and keep what comes of it."""

    def planned(trace: PlanTrace, need: NeedRollout) -> PlanTrace:
        found = kept[ride_file.key(need)] = again(trace, need)
        return found

    return planned


def _header(transcript: Transcript, key: str) -> str:
    value = transcript.get(key)
    if value is None:
        raise TranscriptError(f"the header lacks {key!r}")
    return value


def _style(transcript: Transcript) -> Style:
    style = transcript.get("style", "passenger")
    for known in get_args(Style):
        if style == known:
            return known  # type: ignore[no-any-return]
    raise TranscriptError(f"there is no style {style!r}")
