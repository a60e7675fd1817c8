"""Recordings played on the in-memory bus: the same ride, the same answers, at any moment."""

import gzip
import queue
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from pathlib import Path

import msgspec
import pytest

from planner.record.trace import PlanTrace
from sim.roads.netfile import read_network
from sim.roads.network import Network
from sim.scene import Scene
from sim.setup.scenario import load as load_scenario
from tests.fakes import s1_moments
from tests.recording.test_recorder import FakeCar
from xavi_dialogue.bus.interface import Bus, Keys
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import (
    EventReport,
    Failure,
    SceneReport,
    TraceReport,
    unpack,
)
from xavi_dialogue.chat.client import Client
from xavi_dialogue.dialogue.reply import Reply, encode
from xavi_dialogue.process import child_commands
from xavi_dialogue.recording import player
from xavi_dialogue.recording.player import Player, load
from xavi_dialogue.recording.recorder import Recorder
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.service.server import Service
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.mcap_file import McapWriter, read
from xavi_dialogue.storage.recording_format import NotARecording, RecordedMessages, read_ride
from xavi_dialogue.vehicle import replan_worker
from xavi_dialogue.vehicle.episode import Moment
from xavi_dialogue.vehicle.map_server import serve_roads
from xavi_dialogue.vehicle.node import Pace
from xavi_dialogue.vehicle.replanning import Replanner
from xavi_dialogue.vehicle.worker_pool import Job

KEYS = Keys()
REPORTS = (SceneReport, TraceReport, EventReport)


class Listeners:
    """Hears a car."""

    def __init__(self, bus: Bus, keys: Keys = KEYS) -> None:
        self.scenes: list[SceneReport] = []
        self.traces: list[TraceReport] = []
        self.events: list[EventReport] = []
        bus.subscribe(keys.of("scene"), lambda _, p: self.scenes.append(unpack(p, SceneReport)))
        bus.subscribe(keys.of("trace"), lambda _, p: self.traces.append(unpack(p, TraceReport)))
        bus.subscribe(keys.of("event"), lambda _, p: self.events.append(unpack(p, EventReport)))


def recorded_in(
    path: Path, moments: Iterator[Moment], network: Path | None = None
) -> RecordedMessages:
    """The tape of a ride that was recorded."""
    hub = MemoryHub()
    with McapWriter(path, "1") as file:
        recorder = Recorder(hub.connect(), KEYS, file, lambda _: None)
        recorder.open()
        car = hub.connect()
        if network is not None:
            serve_roads(car, KEYS, network)
        driven = FakeCar(car)
        for moment in moments:
            driven.drive(moment)
        recorder.work()
    return read_ride(read(path))[0]


@pytest.fixture
def recorded(tmp_path: Path) -> RecordedMessages:
    return recorded_in(tmp_path / "ride.mcap", s1_moments())


def played(
    recorded: RecordedMessages, *orders: child_commands.Order, running: bool = False
) -> tuple[Listeners, Player]:
    """What is heard of a player that gets these orders, one after the other."""
    hub = MemoryHub()
    listeners = Listeners(hub.connect())
    told: child_commands.Orders = queue.SimpleQueue()
    for order in (*orders, child_commands.Quit()):
        told.put(order)
    one = Player(recorded, hub.connect(), KEYS, Pace(0.0, running=running))
    one.play(told, stays=True)
    return listeners, one


def through(recorded: RecordedMessages) -> Listeners:
    hub = MemoryHub()
    listeners = Listeners(hub.connect())
    one = Player(recorded, hub.connect(), KEYS, Pace(0.0, running=True))
    one.play(queue.SimpleQueue(), stays=False)
    return listeners


def test_it_reports_the_ride_as_a_car_would(recorded: RecordedMessages) -> None:
    listeners = through(recorded)
    moments = list(s1_moments())
    traces = [moment.trace for moment in moments if moment.trace is not None]
    events = [event for moment in moments for event in moment.events]
    assert [report.trace for report in listeners.traces] == traces
    assert [report.event for report in listeners.events] == events
    for reports in (listeners.scenes, listeners.traces, listeners.events):
        assert [report.seq for report in reports] == list(range(len(reports)))  # type: ignore[attr-defined]
    rides = {report.ride for report in (*listeners.scenes, *listeners.traces, *listeners.events)}
    assert len(rides) == 1
    assert rides != {recorded.ride}
    first, last = listeners.scenes[0], listeners.scenes[-1]
    assert (first.sim_time, first.state, first.scenario, first.seed) == (0.0, "driving", "s1", 4)
    assert (last.sim_time, last.state) == (moments[-1].scene.time, "ended")
    assert (last.traces, last.events) == (len(traces), len(events))


def test_every_play_is_a_ride_of_its_own(recorded: RecordedMessages) -> None:
    assert through(recorded).scenes[0].ride != through(recorded).scenes[0].ride


def test_it_halts_where_a_car_would(recorded: RecordedMessages) -> None:
    listeners, _ = played(recorded, child_commands.Until(3.2))
    scene = listeners.scenes[-1]
    assert scene.state == "driving"  # it had just been told
    told: child_commands.Orders = queue.SimpleQueue()
    hub = MemoryHub()
    listeners = Listeners(hub.connect())
    one = Player(recorded, hub.connect(), KEYS, Pace(0.0, running=True, until=3.2, stops=True))
    one.bus.subscribe(KEYS.of("scene"), lambda *_: _quit_when_halted(one, told))
    one.play(told, stays=True)
    assert (listeners.scenes[-1].sim_time, listeners.scenes[-1].state) == (3.5, "paused")
    assert max(report.sim_time for report in listeners.traces) <= 3.5


def _quit_when_halted(one: Player, orders: child_commands.Orders) -> None:
    if not one.pace.running:
        orders.put(child_commands.Quit())


def test_it_goes_to_any_moment_also_back(recorded: RecordedMessages) -> None:
    listeners, _ = played(recorded, *(child_commands.Seek(t) for t in (4.0, 1.0, 6.0, 2.2)))
    sought = listeners.scenes[1:5]
    assert [scene.sim_time for scene in sought] == [4.0, 1.0, 6.0, 2.5]
    assert [scene.orders for scene in sought] == [1, 2, 3, 4]
    assert {scene.state for scene in sought} == {"paused"}
    seqs = [scene.seq for scene in listeners.scenes]
    assert seqs == sorted(set(seqs))
    assert [report.seq for report in listeners.traces] == list(range(len(listeners.traces)))
    assert [r.sim_time for r in listeners.traces] == sorted({r.sim_time for r in listeners.traces})
    assert sought[1].traces == sought[0].traces  # what is known is not unlearnt
    assert sought[2].traces > sought[1].traces


def test_beyond_the_end_is_the_end(recorded: RecordedMessages) -> None:
    listeners, one = played(
        recorded, child_commands.Seek(1000.0), child_commands.Resume(), child_commands.Seek(0.0)
    )
    assert [scene.state for scene in listeners.scenes[1:4]] == ["ended", "ended", "driving"]
    assert one.pace.obeyed == 4


def test_a_ride_whose_end_was_not_recorded_is_not_said_to_be_over(tmp_path: Path) -> None:
    moments = list(s1_moments())[:5]
    recorded = recorded_in(tmp_path / "ride.mcap", iter(moments))
    assert through(recorded).scenes[-1].state == "paused"


def test_the_pace_is_kept(recorded: RecordedMessages, monkeypatch: pytest.MonkeyPatch) -> None:
    now = 100.0
    monkeypatch.setattr("time.monotonic", lambda: now)
    one = Player(recorded, MemoryHub().connect(), KEYS, Pace(2.0, running=True))
    one.go_to(0)
    assert one._delay() == pytest.approx(0.25)  # 0.5 s at twice the speed
    now += 0.2
    assert one._delay() == pytest.approx(0.05)
    now += 0.3  # late: the next one comes the sooner
    one._advance()
    assert one._delay() == pytest.approx(0.0)
    one.pace.running = False
    assert one._delay() == player.SHOWN_EVERY


class Inline:
    """Plans again as a worker does, in this process."""

    def __init__(self, network: Network) -> None:
        self.network = network

    def submit(self, job: Job) -> None:
        result = replan_worker.obey(
            msgspec.json.decode(job.order, type=replan_worker.ReplanOrder), self.network
        )
        message = bytes(result.message)
        job.done(message if result.planned else msgspec.json.decode(message, type=Failure))


def ride_moments(ride: ride_file.RecordedRide) -> Iterator[Moment]:
    """A recorded ride with a scene at every decision, event and the halt."""
    times = {trace.sim_time for trace in ride.traces} | {event.sim_time for event in ride.events}
    last = max(times | {ride.halt})
    seen: PlanTrace = ride.traces[0]
    for time in sorted(times | {ride.halt}):
        trace = next((one for one in ride.traces if one.sim_time == time), None)
        seen = trace or seen
        events = tuple(event for event in ride.events if event.sim_time == time)
        ending = "arrived" if time == last and ride.ended is not None else None
        scene = Scene(time, dict(seen.scene))
        yield Moment(scene, tuple(p.action for p in seen.plan), trace, events, ending)


QUESTIONS = (
    "Why did you change lanes?",
    "What if you had stayed in your lane?",
    "What are you doing?",
    "What is the other car doing?",
    "Why didn't you stop?",
)


class Talk:
    """A service, and one who asks it."""

    def __init__(self) -> None:
        self.hub = MemoryHub()
        self.service = Service(self.hub.connect(), real_mind())
        self.service.open()
        self.client = Client(self.hub.connect(), KEYS, "ada")

    def ask(self, text: str, at: float) -> Reply:
        came: list[object] = []
        self.client.send(text, came.append, at=at)
        for _ in range(8):  # the question, and what the car replied to the service
            self.service.work()
        [reply] = came
        assert isinstance(reply, Reply)
        return msgspec.structs.replace(reply, timing_ms=None)


@cache
def real_mind():  # type: ignore[no-untyped-def]
    return make_pipeline()


def test_replayed_the_answers_are_those_of_the_ride_byte_for_byte(
    tmp_path: Path, root: Path
) -> None:
    ride = ride_file.load((root / "transcripts/rides/s1-0.ride.jsonl.gz").read_bytes())
    network = load_scenario("s1").network
    live = Talk()
    planning = Replanner(Inline(read_network(network)))
    car = live.hub.connect()
    car.serve(KEYS.of("@rpc/whatif"), planning)
    car.appear(KEYS.of("alive/car"))
    driven = FakeCar(car)
    for moment in ride_moments(ride):
        planning.record(moment)
        driven.drive(moment)
    live.service.work()
    asked = [(text, at) for at in (ride.halt, 2.0) for text in QUESTIONS]
    said = [encode(live.ask(*one)) for one in asked]

    recorded = recorded_in(tmp_path / "ride.mcap", ride_moments(ride), network)
    assert [gzip.decompress(one) for one in recorded.networks] == [network.read_bytes()]
    roads = tmp_path / "roads.net.xml"
    assert player.find_network(recorded, roads)
    again = Talk()
    planning = Replanner(Inline(read_network(roads)))
    bus = again.hub.connect()
    bus.serve(KEYS.of("@rpc/whatif"), planning)
    bus.appear(KEYS.of("alive/car"))
    one = Player(recorded, bus, KEYS, Pace(0.0, running=False), planning.record)
    for time in (0.0, ride.halt, 2.0):  # there, and back
        one.go_to(recorded.index_at(time))
    again.service.work()
    assert [encode(again.ask(*one)) for one in asked] == said
    assert sum('"kind":"answer"' in line for line in said) >= 6


def test_without_roads_the_car_says_that_it_cannot_plan(recorded: RecordedMessages) -> None:
    hub = MemoryHub()
    notes: list[str] = []
    alive = player.HealthReporter("car")
    with player.planning_for(recorded, hub.connect(), KEYS, alive, notes.append) as (planning, _):
        hub.connect().serve(KEYS.of("@rpc/whatif"), planning)
        came: list[object] = []
        hub.connect().request(KEYS.of("@rpc/whatif"), b"", 1.0, came.append)
    failure = unpack(came[0].payload, Failure)  # type: ignore[attr-defined]
    assert failure.reason == "planner-unavailable"
    assert notes == ["warning: " + player.NO_ROADS + "; what would have been cannot be asked"]


@pytest.mark.parametrize("roads", [b"<net", b"<net/>", b"not xml"])
def test_roads_of_another_ride_are_not_planned_on(
    tmp_path: Path, recorded: RecordedMessages, roads: bytes
) -> None:
    other = load_scenario("s2").network.read_bytes()
    for text in (roads, other):
        foreign = replace(recorded, networks=(gzip.compress(text, mtime=0),))
        assert not player.find_network(foreign, tmp_path / "roads.net.xml")


def test_a_file_that_is_cut_off_is_played_with_a_warning(tmp_path: Path) -> None:
    path = tmp_path / "ride.mcap"
    recorded_in(path, s1_moments())
    path.write_bytes(path.read_bytes()[:-30])
    notes: list[str] = []
    recorded = load(path, None, notes.append)
    assert len(recorded.scenes) == len(list(s1_moments()))
    [note] = notes
    assert note.startswith(f"warning: {path}: it was cut off")


def test_what_is_wrong_with_a_file_is_told_with_its_name(tmp_path: Path) -> None:
    path = tmp_path / "ride.mcap"
    path.write_bytes(b"hello")
    with pytest.raises(NotARecording) as caught:
        load(path, None, lambda _: None)
    assert str(caught.value) == f"{path} is not an MCAP file"


def test_the_record_of_a_late_recorder_is_played_from_where_it_begins(tmp_path: Path) -> None:
    hub = MemoryHub()
    bus = hub.connect()
    driven = FakeCar(bus)
    moments = list(s1_moments())
    path = tmp_path / "late.mcap"
    with McapWriter(path, "1") as file:
        for moment in moments[:6]:
            driven.drive(moment)
        hub.kept[KEYS.of("trace")].popleft()  # the oldest is not kept
        recorder = Recorder(hub.connect(), KEYS, file, lambda _: None)
        recorder.open()
        for moment in moments[6:]:
            driven.drive(moment)
        recorder.work()
    recorded, _ = read_ride(read(path))
    assert recorded.times[0] == moments[6].scene.time
    listeners = through(recorded)
    # What is not in it is missed, and not denied: numbers are those of the ride.
    assert [report.seq for report in listeners.traces] == list(range(1, driven.counts["trace"]))
    assert listeners.scenes[-1].traces == driven.counts["trace"]


NO_SUMO = """
import sys
from pathlib import Path
from xavi_dialogue.cli.commands import record
from xavi_dialogue.recording import player, recorder
from xavi_dialogue.vehicle import replan_worker
player.load(Path(sys.argv[1]), None, print)
print(sorted(name for name in sys.modules if name.startswith(("libsumo", "traci"))))
"""


def test_sumo_is_not_needed(tmp_path: Path, root: Path) -> None:
    path = tmp_path / "ride.mcap"
    recorded_in(path, s1_moments())
    command = [sys.executable, "-c", NO_SUMO, str(path)]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_orders_to_seek_are_written_and_read() -> None:
    assert child_commands.read(
        child_commands.write(child_commands.Seek(2.5))
    ) == child_commands.Seek(2.5)
    with pytest.raises(child_commands.ChildCommandError):
        child_commands.read("seek -1")


def test_a_passenger_who_is_taken_back_asks_about_that_moment(recorded: RecordedMessages) -> None:
    hub = MemoryHub()
    client = Client(hub.connect(), KEYS, "ada", lambda _: None)
    one = Player(recorded, hub.connect(), KEYS, Pace(1.0, running=True))
    one.go_to(recorded.index_at(6.0))
    assert client.now() == 6.0
    one.go_to(recorded.index_at(2.0))
    assert client.now() == 2.0


def test_where_a_recording_ends_is_told_to_who_wants_to_go_beyond(tmp_path: Path) -> None:
    recorded = recorded_in(tmp_path / "ride.mcap", iter(list(s1_moments())[:5]))
    hub, notes = MemoryHub(), list[str]()
    told: child_commands.Orders = queue.SimpleQueue()
    for order in (
        child_commands.Seek(1.0),
        child_commands.Seek(15.0),
        child_commands.Until(2.0),
        child_commands.Until(9.0),
    ):
        told.put(order)
    told.put(child_commands.Quit())
    pace = Pace(0.0, running=False)
    Player(recorded, hub.connect(), KEYS, pace, note=notes.append).play(told, stays=True)
    assert recorded.times[-1] == 2.0
    assert notes == ["the recording ends at 0:02"] * 2
