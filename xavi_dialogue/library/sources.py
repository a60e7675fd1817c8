"""The sources of rides: driven here, saved, recorded, or plan traces of any planner."""

import hashlib
import tempfile
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec

from planner.record.trace import PlanTrace
from sim.errors import SimError
from sim.roads.netfile import read_network
from sim.roads.network import Network
from sim.scene import Scene
from sim.setup.scenario import load as load_scenario
from xavi_dialogue.bus.messages import EventReport, SceneReport, TraceReport, unpack
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.dialogue.state.events import (
    EventRecorded,
    Input,
    RideEnded,
    SceneSeen,
    TraceRecorded,
)
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.inspection import trace_files
from xavi_dialogue.inspection.trace_files import TraceFileError
from xavi_dialogue.library.arguments import path_of, real, whole
from xavi_dialogue.library.deeds import events_of
from xavi_dialogue.library.errors import LibraryError, translated
from xavi_dialogue.library.ride import Known, Ride
from xavi_dialogue.recording import player
from xavi_dialogue.service.in_process import NoPlan, Replan, inputs_of_moment, planner_for
from xavi_dialogue.service.reorder_buffer import PATIENCE, RideReports
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.recording_format import RecordedMessages
from xavi_dialogue.storage.ride_file import MAX_BYTES, MAX_SEED, RecordedRide, RideFileError
from xavi_dialogue.transcripts.replay import inputs_of
from xavi_dialogue.vehicle.episode import clock, network_of, start

RECORDING = ".mcap"
COMPRESSED = ".gz"  # most likely a saved ride
OPENED = "give a file that `xavi drive --save`, `Ride.save` or `xavi record` wrote, or plan traces"

SEEDS = f"a whole number from 0 to {MAX_SEED}"
DURATIONS = "seconds greater than 0"


def drive(
    scenario: str | Path = "s1", seed: int | None = None, duration: float | None = None
) -> Ride:
    """Drive a scenario to its end in SUMO, in this process, and return the ride.

    Args:
        scenario: a name, a folder, or a SUMO configuration.
        seed: of the ride. Default: the scenario's.
        duration: [s] after which the ride ends at the latest.

    Raises:
        XaviError: the scenario cannot be used, or SUMO or the car fails.
    """
    place = _scenario(scenario)
    if seed is not None and not 0 <= whole(seed, "seed", SEEDS) <= MAX_SEED:
        raise LibraryError(f"seed is {seed}; give {SEEDS}")
    if duration is not None and real(duration, "duration", DURATIONS) <= 0.0:
        raise LibraryError(f"duration is {duration}; give {DURATIONS}")
    with translated():
        loaded = load_scenario(place, None if seed is None else int(seed))
        for warning in loaded.warnings:
            warnings.warn(warning, stacklevel=2)
        network = network_of(loaded)
        with start(loaded, network, duration=duration) as moments:
            known = [(clock(m), one) for m in moments for one in inputs_of_moment(m)]
    return _ride(place, loaded.seed, known, network)


def open_ride(path: str | Path, scenario: str | Path | None = None, car: str | None = None) -> Ride:
    """Open a ride that was saved or recorded, or the plan traces that any planner wrote.

    Args:
        path: of the file; a saved ride needs no ending, a recording ends in `.mcap`; plan traces
            are JSON, one in a line.
        scenario: of a saved ride, where it lies elsewhere, or of traces: without its roads nothing
            can be planned again. Default: as the file says.
        car: of a recording with several cars, which one.

    Raises:
        XaviError: the file cannot be read, or the scenario or car is not that of the ride.
    """
    given = path_of(path)
    file = _file(given, ride_file.named(given))
    with translated():
        if file.suffix == RECORDING:
            return _recorded(file, player.load(file, car, _warn))
        ride = _saved(file, None if scenario is None else _scenario(scenario))
        own = ride.record.traces[0].vehicle
        if car not in (None, own):
            raise LibraryError(f"{file} is a ride of {own!r}, not of {car!r}")
        return ride


def _file(given: Path, saved: Path) -> Path:
    """Return the file that is there, as it is given or with the ending of saved rides."""
    try:
        return given if given.is_file() or (given.exists() and not saved.is_file()) else saved
    except OSError as error:
        raise LibraryError(f"cannot read {given}: {error.strerror}; {OPENED}") from error


def _scenario(given: object) -> str:
    """Return the name of a scenario, or its path."""
    return str(path_of(given, "scenario", "the name of one, or the path of its folder or file"))


def _ride(
    scenario: str,
    seed: int,
    known: list[Known],
    network: Network | None,
    digest: str | None = None,
) -> Ride:
    """Return the ride that is told by inputs of the dialogue."""
    inputs = [one for _, one in known]
    record = RecordedRide(
        scenario=scenario,
        seed=seed,
        halt=known[-1][0],
        traces=[one.trace for one in inputs if isinstance(one, TraceRecorded)],
        events=[one.event for one in inputs if isinstance(one, EventRecorded)],
        ended=next((one.at for one in inputs if isinstance(one, RideEnded)), None),
    )
    scenes = tuple(one.scene for one in inputs if isinstance(one, SceneSeen))
    return Ride(record, scenes, tuple(known), _plans_on(network), network, digest)


def _saved(file: Path, scenario: str | None) -> Ride:
    record = _read(file)
    if not record.traces:
        raise LibraryError(f"{file} holds no decision; drive the ride again, and longer")
    known = sorted(((_time(one), one) for one in inputs_of(record)), key=lambda pair: pair[0])
    scenes = tuple(Scene(trace.sim_time, trace.scene) for trace in record.traces)
    network = _roads(record, scenario)
    return Ride(record, scenes, tuple(known), _plans_on(network), network, _digest(file))


def _read(file: Path) -> RecordedRide:
    try:
        with file.open("rb") as source:
            data = source.read(MAX_BYTES + 1)
    except OSError as error:
        raise LibraryError(f"cannot read {file}: {error.strerror}; {OPENED}") from error
    if len(data) > MAX_BYTES:
        raise LibraryError(f"{file} is larger than {MAX_BYTES} bytes, the most that is read")
    try:
        return ride_file.load(data)
    except RideFileError as error:
        no_ride = error
    try:
        held = trace_files.read(data)
        if held.ride:  # not compressed
            return ride_file.parse(data)
        return _of_traces(file, held.traces)
    except TraceFileError as error:
        fault = no_ride if file.suffix == COMPRESSED else error
        raise LibraryError(f"{file}: {fault}; {OPENED}") from error


def _of_traces(file: Path, traces: Sequence[PlanTrace]) -> RecordedRide:
    """Return a ride of which decisions alone are known, and what these show of its events."""
    last, shown = traces[-1], events_of(traces)
    return RecordedRide(
        one_line(file.name), last.seed, last.sim_time, traces=list(traces), events=list(shown)
    )


def _time(known: Input) -> float:
    match known:
        case TraceRecorded(trace):
            return trace.sim_time
        case EventRecorded(event):
            return event.sim_time
        case RideEnded(at):
            return at
    raise AssertionError(known)


def _roads(record: RecordedRide, scenario: str | None) -> Network | None:
    """Return the roads of a saved ride, if they can be found.

    Raises:
        LibraryError: the scenario that is named has other roads.
    """
    try:
        network = network_of(load_scenario(scenario or record.scenario, record.seed))
    except SimError:
        if scenario is not None:
            raise
        return None
    if network.hash == record.traces[0].network:
        return network
    if scenario is not None:
        raise LibraryError(f"{scenario} has other roads than the ride; name its own scenario")
    return None


def _plans_on(network: Network | None) -> Replan:
    return _plans_nothing if network is None else planner_for(network)


def _plans_nothing(trace: PlanTrace, need: NeedRollout) -> PlanTrace:
    """Plan nothing, for want of roads."""
    raise NoPlan("planner-unavailable", roadless=True)


def _recorded(file: Path, recorded: RecordedMessages) -> Ride:
    first = recorded.scene(0)
    known = list(_inputs(recorded))
    network = _roads_in(recorded)
    name = first.scenario or one_line(str(file))
    return _ride(name, first.seed or 0, known, network, _digest(file))


def _digest(file: Path) -> str:
    """Return the SHA-256 of a file that could be read, in hexadecimal."""
    with file.open("rb") as content:
        return hashlib.file_digest(content, "sha256").hexdigest()


def _inputs(recorded: RecordedMessages) -> Iterator[Known]:
    """Yield what the dialogue service is told where the recording is played, with its time [s]."""
    reports = RideReports(recorded.ride)
    told = (0, 0)
    for index, packed in enumerate(recorded.scenes):
        scene = unpack(packed, SceneReport)
        until = recorded.known(scene)
        news: list[Input] = []
        for number in range(told[0], until[0]):
            news += reports.trace(unpack(recorded.traces[number], TraceReport))
        for number in range(told[1], until[1]):
            news += reports.event(_report(recorded, scene, number))
        news += reports.see(msgspec.structs.replace(scene, seq=index))
        for moment in (0.0, PATIENCE):  # what has not come by now is missing for good
            news += reports.wait(2.0 * PATIENCE * index + moment)
        told = max(told[0], until[0]), max(told[1], until[1])
        yield from ((scene.sim_time, one) for one in news)


def _report(recorded: RecordedMessages, scene: SceneReport, number: int) -> EventReport:
    event = recorded.events[number]
    return EventReport(
        ride=recorded.ride,
        seq=recorded.event_numbers[number],
        sim_time=event.sim_time,
        wall_time=scene.wall_time,
        event=event,
    )


def _roads_in(recorded: RecordedMessages) -> Network | None:
    """Return the roads that a recording holds, if it holds any."""
    with tempfile.TemporaryDirectory(prefix="xavi-") as folder:
        path = Path(folder) / "network.net.xml"
        if not player.find_network(recorded, path):
            return None
        return read_network(path)


def _warn(text: str) -> None:
    warnings.warn(text.removeprefix("warning: "), stacklevel=2)
