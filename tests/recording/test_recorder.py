"""The recorder on the in-memory bus: what is published is what is in the file."""

import gzip
import json
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest
from mcap.reader import make_reader

from planner.record.events import Event
from sim.scene import VehicleState
from tests.fakes import s1_moments
from xavi_dialogue.bus.interface import EVERY_CAR, Bus, Keys, call
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import (
    AliveReport,
    EventReport,
    PastTurn,
    SceneReport,
    TraceReport,
    TurnReport,
    pack,
    unpack,
)
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.recording import recorder
from xavi_dialogue.recording.recorder import Recorder, SeenNumbers
from xavi_dialogue.storage.mcap_file import McapWriter, read
from xavi_dialogue.storage.recording_format import OVERHEAD, AttachedFile, Entry, read_ride
from xavi_dialogue.vehicle.episode import Moment
from xavi_dialogue.vehicle.map_server import NETWORK, serve_roads
from xavi_dialogue.vehicle.telemetry import KEPT_EVENTS, KEPT_TRACES

EGO = VehicleState((0.0, 0.0), 0.0, 10.0, 0.0, 4.5, 1.8)


class FakeCar:
    """Publishes moments as a car does, and knows what it published."""

    def __init__(self, bus: Bus, vehicle: str = "car", ride: str = "r1") -> None:
        keys, self.ride, self.said = Keys(vehicle), ride, list[tuple[str, bytes]]()
        self.keys, self.counts = keys, {"scene": 0, "trace": 0, "event": 0}
        self.publishers = {
            "scene": bus.publisher(keys.of("scene")),
            "trace": bus.publisher(keys.of("trace"), keep=KEPT_TRACES),
            "event": bus.publisher(keys.of("event"), keep=KEPT_EVENTS),
        }

    def drive(self, moment: Moment) -> None:
        common = {"ride": self.ride, "sim_time": moment.scene.time, "wall_time": 1.8e9}
        if moment.trace is not None:
            seq = self.counts["trace"]
            self.put("trace", pack(TraceReport(seq=seq, trace=moment.trace, **common)))
        for event in moment.events:
            self.put("event", pack(EventReport(seq=self.counts["event"], event=event, **common)))
        scene = SceneReport(
            seq=self.counts["scene"],
            vehicles=dict(moment.scene.vehicles),
            state="ended" if moment.ending else "driving",
            speed_factor=1.0,
            plan=moment.plan,
            traces=self.counts["trace"],
            events=self.counts["event"],
            scenario="s1",
            seed=4,
            **common,
        )
        self.put("scene", pack(scene))

    def put(self, tail: str, payload: bytes) -> None:
        self.counts[tail] += 1
        self.said.append((self.keys.of(tail), payload))
        self.publishers[tail].put(payload)


class Studio:
    """A hub, and a recorder on it."""

    def __init__(self, path: Path, keys: Keys) -> None:
        self.path, self.hub = path, MemoryHub()
        self.notes: list[str] = []
        self.file = McapWriter(path, "1")
        self.recorder = Recorder(self.hub.connect(), keys, self.file, self.notes.append)

    def entries(self) -> list[Entry]:
        self.recorder.work()
        self.file.close()
        return [one for one in read(self.path) if isinstance(one, Entry)]


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[Studio]:
    studio = Studio(tmp_path / "ride.mcap", Keys())
    yield studio
    studio.file.close()


def test_what_is_recorded_is_what_was_published(studio: Studio) -> None:
    studio.recorder.open()
    car = FakeCar(studio.hub.connect())
    for moment in s1_moments():
        car.drive(moment)
    written = studio.entries()
    assert [(one.key, one.payload) for one in written] == car.said
    assert {one.published for one in written} == {1_800_000_000 * 10**9}
    logged = [one.logged for one in written]
    assert logged == sorted(logged)
    assert [one.seq for one in written if one.key.endswith("trace")] == list(
        range(car.counts["trace"])
    )


def test_who_joins_late_records_what_is_kept_first_and_nothing_twice(studio: Studio) -> None:
    car = FakeCar(studio.hub.connect())
    moments = list(s1_moments())
    for moment in moments[:8]:
        car.drive(moment)
    missed = [one for one in car.said if not one[0].endswith("scene")]
    begun = len(car.said)
    studio.recorder.open()
    for moment in moments[8:]:
        car.drive(moment)
    for key, payload in missed:  # the bus says it again
        studio.hub.connect().publisher(key).put(payload)
    written = [(one.key, one.payload) for one in studio.entries()]
    kept = len(missed)
    assert sorted(written[:kept]) == sorted(missed)
    assert written[kept:] == car.said[begun:]


def test_numbers_are_remembered_in_little_room(monkeypatch: pytest.MonkeyPatch) -> None:
    numbers = SeenNumbers()
    assert [numbers.new(n) for n in (0, 1, 1, 5, 0, 5, 3)] == [
        *(True, True, False, True, False, False, True)
    ]
    assert (numbers.below, numbers.apart) == (2, {3, 5})
    monkeypatch.setattr(recorder, "MAX_APART", 3)
    assert [numbers.new(n) for n in (9, 11, 4, 2)] == [True, True, True, False]
    assert (numbers.below, numbers.apart) == (6, {9, 11})


def turn(seq: int) -> bytes:
    said = PastTurn("Why?", Reply(text="Because.", kind="answer", sim_time=1.0))
    return pack(TurnReport(session="ada", seq=seq, sim_time=1.0, wall_time=1.8e9, turn=said))


def test_shared_turns_are_recorded_also_of_a_service_that_began_anew(studio: Studio) -> None:
    studio.recorder.open()
    publisher = studio.hub.connect().publisher(Keys().of("dialogue/ada/turn"))
    for seq in (0, 1, 0):
        publisher.put(turn(seq))
    assert [one.payload for one in studio.entries()] == [turn(0), turn(1), turn(0)]


def test_a_ride_is_described_and_its_roads_are_kept(studio: Studio, tmp_path: Path) -> None:
    network = tmp_path / "s1.net.xml"
    network.write_text("<net/>")
    bus = studio.hub.connect()
    serve_roads(bus, Keys(), network)
    studio.recorder.open()
    for ride in ("r1", "r2"):
        car = FakeCar(bus, ride=ride)
        for moment in list(s1_moments())[:3]:
            car.drive(moment)
    studio.recorder.work()
    studio.file.close()
    packed = gzip.compress(b"<net/>", mtime=0)
    attached = [one for one in read(studio.path) if isinstance(one, AttachedFile)]
    assert attached == [AttachedFile(f"car/{ride}.net.xml.gz", packed) for ride in ("r1", "r2")]
    with studio.path.open("rb") as file:
        facts = [dict(one.metadata) for one in make_reader(file).iter_metadata()]
    versions = {one.pop("version") for one in facts}
    common = {"vehicle": "car", "scenario": "s1", "seed": "4"}
    assert facts == [{**common, "ride": "r1"}, {**common, "ride": "r2"}]
    assert len(versions) == 1
    assert studio.notes == []


@pytest.mark.parametrize("roads", [b"", b"<net/>", gzip.compress(b"x", mtime=0)[:-9]])
def test_roads_that_cannot_be_used_are_not_kept(studio: Studio, roads: bytes) -> None:
    bus = studio.hub.connect()
    bus.serve(Keys().of(NETWORK), lambda asked: asked.reply(roads))
    studio.recorder.open()
    FakeCar(bus).drive(next(s1_moments()))
    studio.recorder.work()
    studio.file.close()
    assert not [one for one in read(studio.path) if isinstance(one, AttachedFile)]
    assert studio.notes == ["warning: car does not tell its roads; replayed, it cannot plan"]


def test_roads_that_are_too_large_are_not_told(tmp_path: Path) -> None:
    hub = MemoryHub()
    network = tmp_path / "big.net.xml"
    network.write_bytes(bytes(range(256)) * 10)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("xavi_dialogue.vehicle.map_server.MAX_PACKED", 50)
        serve_roads(hub.connect(), Keys(), network)
    came: list[object] = []
    hub.connect().request(Keys().of(NETWORK), b"", 1.0, came.append)
    assert type(came[0]).__name__ == "Refused"


def test_every_car_is_recorded_where_that_is_wanted(tmp_path: Path) -> None:
    studio = Studio(tmp_path / "all.mcap", EVERY_CAR)
    studio.recorder.open()
    for name in ("a", "b"):
        car = FakeCar(studio.hub.connect(), name)
        for moment in list(s1_moments())[:4]:
            car.drive(moment)
    studio.recorder.work()
    watched: list[str] = []
    studio.hub.connect().watch(EVERY_CAR.of("alive/recorder"), lambda key, _: watched.append(key))
    assert watched == [Keys(name).of("alive/recorder") for name in ("car", "a", "b")]
    entries = studio.entries()
    assert {one.key.split("/")[2] for one in entries} == {"a", "b"}
    assert read_ride(entries, "b")[0].vehicle == "b"


def test_another_car_is_not_recorded(studio: Studio) -> None:
    studio.recorder.open()
    FakeCar(studio.hub.connect(), "other").drive(next(s1_moments()))
    assert studio.entries() == []


def test_nonsense_is_left_out_and_counted(studio: Studio) -> None:
    studio.recorder.open()
    bus = studio.hub.connect()
    scene = SceneReport(
        ride="r", seq=0, sim_time=0.0, wall_time=-1e300, vehicles={0: EGO}, state="driving",
        speed_factor=1.0, plan=(), traces=0, events=0,
    )  # fmt: skip
    event = EventReport(ride="r", seq=0, sim_time=0.0, wall_time=0.0, event=Event("arrived", 0.0))
    later = json.loads(pack(event)) | {"schema": "xavi.event_report/2"}
    for tail, payload in (
        ("scene", b""),
        ("scene", b"x" * (SceneReport.LIMIT + 1)),
        ("event", msgspec.json.encode(later)),
        ("trace", pack(event)),
        ("scene", pack(scene)),
    ):
        bus.publisher(Keys().of(tail)).put(payload)
    [written] = studio.entries()
    assert (written.payload, written.published) == (pack(scene), 0)
    alive = unpack(call(bus, Keys().of("alive/recorder"), b"", 1.0), AliveReport)
    counters = {name: alive.counters[name] for name in recorder.COUNTERS}
    assert counters == {"messages": 1, "bytes": len(pack(scene)), "dropped": 0, "rejected": 4}


def test_a_flood_is_not_held_in_memory(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    studio.recorder.open()
    monkeypatch.setattr(recorder, "MAX_WAITING", 3 * (len(turn(0)) + OVERHEAD))
    publisher = studio.hub.connect().publisher(Keys().of("dialogue/ada/turn"))
    for seq in range(5):
        publisher.put(turn(seq))
    studio.recorder.work()
    publisher.put(turn(5))
    assert [one.seq for one in studio.entries()] == [0, 1, 2, 5]
    assert studio.recorder.alive.counted("dropped") == 2


def test_a_flood_keeps_nobody_from_stopping(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recorder, "AT_ONCE", 10)
    studio.recorder.open()
    publisher = studio.hub.connect().publisher(Keys().of("dialogue/ada/turn"))
    add, numbers = studio.file.add, iter(range(1, 1000))

    def add_and_hear_more(entry: Entry) -> bool:
        """For every message that is written another one comes."""
        publisher.put(turn(next(numbers)))
        return add(entry)

    monkeypatch.setattr(studio.file, "add", add_and_hear_more)
    publisher.put(turn(0))
    studio.recorder.work()
    assert studio.recorder.alive.counted("messages") == 10
    studio.recorder.work()
    assert studio.recorder.alive.counted("messages") == 20
    studio.recorder.finish()
    assert [one.seq for one in studio.entries()] == list(range(21))


def test_messages_without_content_wait_in_no_greater_number(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recorder, "MAX_WAITING", 3 * OVERHEAD)
    studio.recorder.open()
    publisher = studio.hub.connect().publisher(Keys().of("scene"))
    for _ in range(5):
        publisher.put(b"")
    studio.recorder.finish()
    counted = studio.recorder.alive.counted
    assert (counted("dropped"), counted("rejected")) == (2, 3)
