"""The disk is full, or nothing can be written at all: answers come, and what can be kept is."""

import resource
from pathlib import Path

from tests.drills.bus_clients import Passenger, on_bus
from tests.drills.processes import PATIENCE, Crew, Process, free_endpoint, until
from tests.drills.stage import HALT, staged
from xavi_dialogue.storage.conversations import Store
from xavi_dialogue.storage.mcap_file import read
from xavi_dialogue.storage.recording_format import Entry

FULL = "what is said is not kept until this is solved"
MENDED = "what is said is kept again, and what was missed as well"
NOTHING_MORE = 8 * 1024  # bytes; a log has room, and a database none
SOME = 16 * 1024  # bytes of a recording
NOWHERE = "/proc/xavi/dialogue.sqlite3"


def fill_disk(process: Process, size: int = resource.RLIM_INFINITY) -> None:
    """Let no file of a process grow beyond a size, as if there were no room; without: as before."""
    _, most = resource.prlimit(process.pid, resource.RLIMIT_FSIZE)
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (size, most))


def test_what_is_said_while_the_disk_is_full_is_kept_later(crew: Crew, tmp_path: Path) -> None:
    endpoint, store = free_endpoint(), tmp_path / "dialogue.sqlite3"
    service = crew.serve(endpoint, "--store", str(store))
    questions = [f"What happens at {number} s?" for number in range(6)]
    with on_bus(endpoint) as bus:
        ada = Passenger(bus, "ada")
        assert ada.ask(questions[0]).reply is not None
        fill_disk(service, NOTHING_MORE)
        for question in questions[1:5]:
            assert ada.ask(question).reply is not None
        assert service.says(FULL)
        with Store(store) as file:
            assert len(file.turns("ada", 100)) < 5
        fill_disk(service)
        assert ada.ask(questions[5]).reply is not None
        assert service.says(MENDED)
    assert service.said.count(FULL) == service.said.count(MENDED) == 1
    assert service.end() == 0
    with Store(store) as file:
        assert [turn.text for turn in file.turns("ada", 100)] == questions


def test_where_nothing_can_be_written_answers_come_and_it_is_said_once(crew: Crew) -> None:
    endpoint = free_endpoint()
    service = crew.serve(endpoint, "--store", NOWHERE)
    with on_bus(endpoint) as bus:
        ada = Passenger(bus, "ada")
        for _ in range(4):
            assert ada.ask("Hello!").reply is not None
        assert len(ada.history()) == 4
    assert service.end() == 0
    assert service.said.count(FULL) == 1
    assert service.said.count("warning") == 1


def test_a_recording_on_a_full_disk_ends_with_one_line_and_can_be_read(
    crew: Crew, tmp_path: Path
) -> None:
    file = tmp_path / "ride.mcap"
    with staged(crew, at=2.0) as stage:
        recorder = crew.xavi("record", str(file), "--connect", stage.endpoint)
        assert recorder.says("recording into")
        assert until(lambda: file.stat().st_size >= SOME)
        fill_disk(recorder, file.stat().st_size)
        full = file.stat().st_size  # it may have grown meanwhile, and does not from now on
        stage.car.order(f"until {HALT}")
        assert recorder.popen.wait(PATIENCE) == 1
        assert stage.listener.halted(HALT)
        [line] = [line for line in recorder.said.splitlines() if "recording into" not in line]
        assert str(file) in line
        assert sum(isinstance(piece, Entry) for piece in read(file)) >= 3
        assert file.stat().st_size <= full
