"""Everybody who is told to end does so within three seconds, whatever they are at."""

import os
import signal
from pathlib import Path

import pytest

from tests.drills.bus_clients import Listener, on_bus
from tests.drills.processes import ENDED, Crew, Process, free_endpoint, until
from tests.drills.stage import HALT, WHERE, WHY, staged
from xavi_dialogue.storage.mcap_file import read
from xavi_dialogue.storage.recording_format import Entry

TERM, INT = signal.SIGTERM, signal.SIGINT
CROWD = 300  # questions; none of them is answered before the signal comes


def statuses(number: int) -> tuple[int, ...]:
    """Of a command that is ended by a signal: what shells say of it, or what it did."""
    return (128 + number, -number)


@pytest.mark.parametrize(
    ("state", "number"), [("idle", TERM), ("planning", INT), ("full", TERM), ("answering", INT)]
)
def test_a_service_ends_in_every_state(
    crew: Crew, tmp_path: Path, state: str, number: signal.Signals
) -> None:
    serve = ("--store", str(tmp_path / "dialogue.sqlite3"))
    with staged(crew, at=2.0 if state == "idle" else HALT, serve=serve) as stage:
        if state == "planning":
            assert stage.ready()
            for planner in stage.planners():
                os.kill(planner, signal.SIGSTOP)
            stage.passenger("ada").begin(WHY, HALT)
            assert until(lambda: stage.listener.fares()["workers_idle"] == 0.0)
        elif state in ("full", "answering"):
            count = CROWD if state == "full" else 1
            for asker in range(count):
                stage.passenger(f"p{asker}").begin(WHERE, HALT)
        assert stage.service.end(number) == 0
        for planner in stage.planners():
            os.kill(planner, signal.SIGCONT)


@pytest.mark.parametrize(("state", "number"), [("starting", TERM), ("thinking", INT)])
def test_a_chat_ends_in_every_state(crew: Crew, state: str, number: signal.Signals) -> None:
    chat = crew.xavi("chat", "--scenario", "s1")
    if state == "thinking":
        chat.order(f"@ {HALT}s", WHERE)
        chat.hear(1)
        chat.order(WHY, WHY, WHY)
    else:
        assert until(lambda: bool(crew.pids("xavi_dialogue serve")))
    assert chat.end(number) in statuses(number), chat.said
    assert until(lambda: not crew.there(), ENDED), crew.there()


@pytest.mark.parametrize(("number", "harm"), [(TERM, signal.SIGSTOP), (INT, signal.SIGKILL)])
def test_a_dashboard_that_starts_ends_without_its_service(
    crew: Crew, number: signal.Signals, harm: signal.Signals
) -> None:
    options = ("--listen", "127.0.0.1:0", "--no-open", "--keep-days", "0", "--scenario", "s1")
    dashboard = crew.xavi("dashboard", *options)
    assert dashboard.says("to talk at a terminal"), dashboard.said
    [service] = crew.pids("xavi_dialogue serve")
    os.kill(service, harm)
    assert dashboard.end(number) == 0, dashboard.said
    assert until(lambda: not crew.there(), ENDED), crew.there()


def test_one_who_rides_along_ends_and_leaves_the_others_alone(crew: Crew) -> None:
    with staged(crew) as stage:
        chat = crew.xavi("chat", "--connect", stage.endpoint)
        chat.order(WHERE)
        chat.hear(1)
        assert chat.end(TERM) in statuses(TERM), chat.said
        assert stage.passenger("ada").ask(WHERE, HALT).kind == "answer"


@pytest.mark.parametrize("number", [TERM, INT])
def test_recorder_and_player_end_with_all_in_the_file(
    crew: Crew, tmp_path: Path, number: signal.Signals
) -> None:
    file = tmp_path / "ride.mcap"
    with staged(crew, at=4.0) as stage:
        recorder = crew.xavi("record", str(file), "--connect", stage.endpoint)
        assert until(lambda: "xavi/v1/car/alive/recorder" in stage.listener.alive), recorder.said
        assert until(
            lambda: stage.listener.fares("recorder")["messages"] >= len(stage.listener.traces) + 3
        )
        assert until(lambda: told(file) == len(stage.listener.traces) + len(stage.listener.events))
        assert recorder.end(number) == 0, recorder.said
        decisions = [report.trace.trace_id for report in stage.listener.traces]
        assert stage.car.end(number) == 128 + number
    endpoint = free_endpoint()
    crew.serve(endpoint, "--keep-days", "0")
    player = play(crew, file, endpoint)
    with on_bus(endpoint) as bus:
        listener = Listener(bus)
        assert until(lambda: listener.now >= 3.9 and listener.whole()), player.said
        assert [report.trace.trace_id for report in listener.traces] == decisions
        assert player.end(number) in (0, *statuses(number)), player.said
    nobody = free_endpoint()  # hosts a bus there
    for early in (
        play(crew, file, nobody),
        crew.xavi("record", str(tmp_path / "nothing.mcap"), "--connect", nobody),
    ):
        maps = Path(f"/proc/{early.pid}/maps")
        assert until(lambda maps=maps: "zenoh" in maps.read_text())
        assert early.end(number) in (0, *statuses(number)), early.said


def told(file: Path) -> int:
    """How many decisions and events are in a recording."""
    keys = [piece.key for piece in read(file) if isinstance(piece, Entry)]
    return sum(key.endswith(("/trace", "/event")) for key in keys)


def play(crew: Crew, file: Path, endpoint: str) -> Process:
    return crew.xavi("replay", str(file), "--connect", endpoint, "--speed", "10")
