"""`xavi transcripts`: golden conversations, replayed from recordings and from SUMO.

Conversations about the same scenario and seed share one recording of the ride:
`transcripts/rides/s1-0.ride.jsonl.gz` holds it once, with all that was planned again for any.
A conversation may also be about what a file in `transcripts/traces` holds, with the header
`trace:`: one decision, or a recorded ride. There is no road behind it: nothing can be driven or
planned again, and what was planned from a single decision lies beside it (see `BESIDE`).
"""

import gzip
import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from planner.counterfactuals.whatif import WhatIfError
from planner.errors import TraceError
from planner.record.trace import PlanTrace
from planner.record.trace_reading import decode
from sim.setup.scenario import load as load_scenario
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.dialogue.state.events import EventRecorded, Input, RideEnded, TraceRecorded
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.service.in_process import (
    Conversation,
    Replan,
    drive_to,
    make_pipeline,
    planner_for,
)
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import ENDING, RecordedRide, RideFileError, key
from xavi_dialogue.transcripts.runner import Played, latest, play
from xavi_dialogue.transcripts.transcript import Transcript, TranscriptError, read, write
from xavi_dialogue.vehicle.episode import clock, network_of, start

RIDES = "rides"  # the folder of the recordings, inside that of the transcripts
TRACES = "traces"  # the folder of transcripts that are not driven
BESIDE = "whatif-{}.json.gz"  # a plan made from a decision, by the key of the request

Note = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Written:
    """A transcript as stored."""

    path: Path
    text: str
    transcript: Transcript

    @property
    def driven(self) -> bool:
        """Whether SUMO can drive its ride."""
        return self.transcript.get("trace") is None

    @property
    def ride(self) -> Path:
        """The path of the recording of its ride."""
        if not self.driven:
            return self.path.parent / _header(self, "trace")
        name = f"{Path(self.scenario).name}-{self.seed}{ENDING}"
        return self.path.parent / RIDES / name

    @property
    def scenario(self) -> str:
        """The scenario, as a name or a folder."""
        return _header(self, "scenario")

    @property
    def seed(self) -> int:
        """The seed of the ride."""
        seed = _header(self, "seed")
        if not seed.isdecimal():
            raise TranscriptError(f"{self.path}: {seed!r} is no seed")
        return int(seed)


@dataclass(frozen=True, slots=True)
class Replayed:
    """Transcripts about one ride as they are now, and the ride behind them."""

    texts: tuple[str, ...]
    ride: RecordedRide


def transcripts_in(folder: Path) -> tuple[Written, ...]:
    """Return the transcripts of a folder, by name.

    Raises:
        TranscriptError: there are none, or one cannot be read.
    """
    paths = sorted(folder.glob("*.txt"))
    if not paths:
        raise TranscriptError(f"there are no transcripts (*.txt) in {folder}")
    return tuple(map(_open, paths))


def by_ride(written: Sequence[Written]) -> Mapping[Path, tuple[Written, ...]]:
    """Group transcripts by the recording of their ride."""
    rides = sorted({one.ride for one in written})
    return {ride: tuple(one for one in written if one.ride == ride) for ride in rides}


def recording(path: Path) -> RecordedRide:
    """Return a recorded ride; of a single decision, a ride that consists of it.

    Raises:
        RideFileError: there is none.
    """
    if not path.name.endswith(ENDING):
        return _alone(path)
    try:
        return ride_file.load(path.read_bytes())
    except OSError as error:
        raise RideFileError(f"cannot read {path}: {error.strerror}") from error


def replay_recorded(transcript: Transcript, ride: RecordedRide, pipeline: Pipeline) -> Played:
    """Replay a transcript from a recorded ride, without SUMO and planner.

    Raises:
        RideFileError: a plan is wanted that the recording does not hold.
    """

    def missing(_: PlanTrace, need: NeedRollout) -> PlanTrace:
        raise RideFileError(_missing(need))

    return play(transcript, pipeline, inputs_of(ride), ride.halt, keeping(missing, ride))


def replay_driven(written: Sequence[Written]) -> Replayed:
    """Replay the transcripts of one ride by driving it again."""
    scenario = load_scenario(written[0].scenario, written[0].seed)
    network = network_of(scenario)
    pipeline = make_pipeline()
    known = Conversation(pipeline, planner_for(network))
    last = max(latest(one.transcript) for one in written)
    with start(scenario, network) as ride:
        halt = drive_to(ride, known, None)
        for moment in ride if last > halt else ():
            known.record(moment)
            if clock(moment) >= last:
                break
    recorded = RecordedRide(
        scenario=written[0].scenario,
        seed=scenario.seed,
        halt=halt,
        traces=list(known.dialogue.traces),
        events=list(known.dialogue.events),
        ended=known.dialogue.ended_at,
    )
    again = keeping(known.again, recorded)
    inputs = inputs_of(recorded)
    played = (play(one.transcript, pipeline, inputs, halt, again) for one in written)
    return Replayed(tuple(write(one.transcript) for one in played), recorded)


def replay_all(folder: Path, *, accept: bool, note: Note) -> int:
    """Replay every transcript of a folder in SUMO; return how many differ from their files.

    A transcript differs where its text or its recording does. What is about a file of decisions
    is replayed from that file.

    Raises:
        TranscriptError: the folder holds none, or one cannot be read.
        RideFileError: a file of decisions is missing, or lacks a plan.
    """
    differing = 0
    for path, written in by_ride(transcripts_in(folder)).items():
        now = replay_driven(written) if written[0].driven else _replay_held(path, written)
        driven = _as_recorded(path, now.ride)
        if accept and not driven:
            path.parent.mkdir(exist_ok=True)
            path.write_bytes(ride_file.dump(now.ride))
        for one, text in zip(written, now.texts, strict=True):
            same = driven and one.text == text
            differing += not same
            if accept:
                one.path.write_text(text, encoding="utf-8")
            note(f"{one.path}: {'as before' if same else 'accepted' if accept else 'differs'}")
    return differing


def inputs_of(ride: RecordedRide) -> tuple[Input, ...]:
    """Convert a recorded ride to inputs of the dialogue."""
    over = () if ride.ended is None else (RideEnded(ride.ended),)
    return (*map(TraceRecorded, ride.traces), *map(EventRecorded, ride.events), *over)


def keeping(again: Replan, ride: RecordedRide) -> Replan:
    """Return what is planned again from a recorded ride, and store in it what it lacks."""
    return partial(_kept, again, ride)


def _kept(again: Replan, ride: RecordedRide, trace: PlanTrace, need: NeedRollout) -> PlanTrace:
    name = key(need)
    if name in ride.failures:
        raise WhatIfError(ride.failures[name])
    if name not in ride.whatifs:
        try:
            ride.whatifs[name] = again(trace, need)
        except WhatIfError as error:
            ride.failures[name] = str(error)
            raise
    return ride.whatifs[name]


def _as_recorded(path: Path, ride: RecordedRide) -> bool:
    """Check whether a recording holds exactly this ride."""
    try:
        return recording(path) == ride
    except RideFileError:
        return False


def _replay_held(path: Path, written: Sequence[Written]) -> Replayed:
    """Replay transcripts about the contents of a file."""
    ride, pipeline = recording(path), make_pipeline()
    played = (replay_recorded(one.transcript, ride, pipeline) for one in written)
    return Replayed(tuple(write(one.transcript) for one in played), ride)


def _alone(path: Path) -> RecordedRide:
    """Make a ride of one decision and the plans made from it."""
    trace = _trace(path)
    ride = RecordedRide("", trace.seed, trace.sim_time, [trace])
    start, _, end = BESIDE.partition("{}")
    for beside in sorted(path.parent.glob(BESIDE.format("*"))):
        ride.whatifs[beside.name.removeprefix(start).removesuffix(end)] = _trace(beside)
    return ride


def _trace(path: Path) -> PlanTrace:
    try:
        return decode(gzip.decompress(path.read_bytes()))
    except (OSError, EOFError, zlib.error, TraceError) as error:
        raise RideFileError(f"cannot read {path}: {error}") from error


def _missing(need: NeedRollout) -> str:
    """Raise an error for a plan that a recording lacks."""
    return (
        f"the recording holds no plan for {need}. "
        "Where a scenario was driven, accept it anew. Where a file of decisions is asked about, "
        f"there is no road to plan on: put the plan beside it as {BESIDE.format(key(need))}, "
        "or write ! planner gone before the question"
    )


def _open(path: Path) -> Written:
    text = path.read_text(encoding="utf-8")
    try:
        return Written(path, text, read(text))
    except TranscriptError as error:
        raise TranscriptError(f"{path}: {error}") from error


def _header(written: Written, name: str) -> str:
    value = written.transcript.get(name)
    if value is None:
        raise TranscriptError(f"{written.path}: the header lacks {name!r}")
    return value
