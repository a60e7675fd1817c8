"""The service, which hosts the hub, is killed in the middle of a ride and a conversation."""

import threading
import time
from pathlib import Path

from tests.drills.bus_clients import Listener, Passenger, on_bus
from tests.drills.processes import Crew, free_endpoint, until
from tests.drills.stage import WHERE
from xavi_dialogue.storage.conversations import Store

QUESTIONS = ("Hello!", WHERE, "What are you doing?", "Why?", WHERE)
SPEED = 0.5  # simulated seconds per second


def kept(store: Path, session: str) -> list[tuple[str, str]]:
    """Questions and answers on disk, in order."""
    with Store(store) as file:
        return [(turn.text, turn.reply.text) for turn in file.turns(session, 200)]


def test_a_service_that_is_killed_and_comes_back_knows_ride_and_conversation(
    crew: Crew, tmp_path: Path
) -> None:
    endpoint, store = free_endpoint(), tmp_path / "dialogue.sqlite3"
    serve = ("--store", str(store))
    service = crew.serve(endpoint, *serve)
    car = crew.drive(endpoint, "--scenario", "s1", "--control")  # so that it stays at the end
    car.order(f"speed {SPEED}", "resume")
    chat = crew.xavi("chat", "--connect", endpoint, "--session", "ada")
    with on_bus(endpoint) as bus:
        listener = Listener(bus)
        assert until(lambda: len(listener.traces) >= 2)
        chat.order(*QUESTIONS[:2])
        chat.hear(2)
        before, seen = time.monotonic(), listener.now
        ride = listener.scenes[-1].ride
        service.kill()
        chat.order(QUESTIONS[2])  # nobody is there to answer it
        assert car.says("service lost; driving on")
        time.sleep(1.0)  # without a hub
        crew.serve(endpoint, *serve)
        chat.order(*QUESTIONS[3:])
        answers = chat.hear(len(QUESTIONS))
        chat.popen.stdin.close()  # type: ignore[union-attr]
        assert chat.popen.wait(30.0) == 0, chat.said
    with on_bus(endpoint) as bus:
        late = Listener(bus)
        assert until(lambda: bool(late.scenes) and late.whole())
        assert {scene.ride for scene in late.scenes} == {ride}
        driven, passed = late.now - seen, time.monotonic() - before
        assert late.state == "ended" or driven > 0.4 * SPEED * passed  # it was not held up
        again = Passenger(bus, "ben").ask("Why are you doing that?")
        assert again.kind in ("answer", "refusal", "clarification")
        assert again.reason not in ("planner-unavailable", "timed-out", "trace-gap")
    said = list(zip(QUESTIONS, answers, strict=True))
    assert kept(store, "ada") == said


def test_what_is_asked_while_nobody_is_there_is_refused_with_a_reason(crew: Crew) -> None:
    endpoint = free_endpoint()
    service = crew.serve(endpoint, "--keep-days", "0")
    with on_bus(endpoint) as bus:
        ada = Passenger(bus, "ada")
        assert ada.ask("Hello!").reason == "planner-unavailable"  # there is no car
        service.kill()
        assert ada.ask("Hello!").reason in ("NobodyThere", "TooLate")
        crew.serve(endpoint, "--keep-days", "0")
        assert until(lambda: ada.ask("Hello!").reason == "planner-unavailable")


def test_who_comes_late_gets_all_that_is_kept(crew: Crew, tmp_path: Path) -> None:
    endpoint = free_endpoint()
    crew.serve(endpoint, "--store", str(tmp_path / "dialogue.sqlite3"))
    car = crew.drive(endpoint, "--scenario", "s2", "--vehicle", "taxi", "--control")
    with on_bus(endpoint) as bus:
        listener = Listener(bus, "taxi")
        assert until(lambda: bool(listener.scenes)), car.said
        car.order("until 9.0")
        assert listener.halted(9.0)
        said = tuple(f"What do you see at {number} s?" for number in range(5))
        for text in said:
            assert Passenger(bus, "ada", "taxi").ask(text).reply is not None
    with on_bus(endpoint) as bus:
        late = Listener(bus, "taxi")
        assert late.halted(9.0)
        assert late.traces == listener.traces
        assert late.events == listener.events
        assert len(late.traces) >= 9
        there = {f"xavi/v1/taxi/alive/{component}" for component in ("car", "service")}
        assert until(lambda: late.alive >= there)
        assert Passenger(bus, "ada", "taxi").history() == said


def test_a_chat_that_is_killed_while_it_waits_leaves_nobody_behind(crew: Crew) -> None:
    chat = crew.xavi("chat", "--scenario", "s1")
    chat.order("@ 8.0s", "Hello!")
    chat.hear(1)
    assert until(lambda: bool(crew.pids("vehicle.replan_worker")))
    chat.order("What if you had stopped?", "Why?", "@ 60s", "Why?")
    threading.Event().wait(0.2)
    chat.kill()
    assert until(lambda: not crew.there(), 10.0), crew.there()
