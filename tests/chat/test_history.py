"""What was said: asked why, listed, saved and erased, over a bus within one process."""

import asyncio
import resource
import signal
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import partial
from pathlib import Path

import msgspec
import pytest

from planner.record.events import Event
from sim.scene import VehicleState
from tests.fakes import EGO
from xavi_dialogue.bus.interface import Call, Keys
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import (
    AskReply,
    AskRequest,
    CancelReply,
    CancelRequest,
    CarState,
    EventReport,
    Failure,
    ForgetReply,
    ForgetRequest,
    HistoryReply,
    PastTurn,
    SceneReport,
    pack,
    unpack,
)
from xavi_dialogue.chat.backend import Backend
from xavi_dialogue.chat.batch import BatchChat
from xavi_dialogue.chat.client import Client
from xavi_dialogue.chat.controller import LOST, ChatController
from xavi_dialogue.chat.history import NOTHING, SessionHistory
from xavi_dialogue.chat.local_backend import LocalBackend
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.process import child_commands
from xavi_dialogue.process.exit_status import ExitStatus, status_of
from xavi_dialogue.service.request_handler import FOREIGN
from xavi_dialogue.terminal import slash_commands
from xavi_dialogue.terminal.slash_commands import CommandError
from xavi_dialogue.transcripts import transcript

KEYS = Keys()
NOW = datetime(2026, 5, 4, 3, 2, 1, tzinfo=UTC)
HEADER = (("scenario", "s1"), ("seed", "0"))


def reply(text: str, at: float) -> Reply:
    return Reply(text=text, kind="answer", sim_time=at)


@dataclass
class FakeService:
    """Answers every question, and remembers it; or says nothing at all."""

    hub: MemoryHub = field(default_factory=MemoryHub)
    turns: list[PastTurn] = field(default_factory=list)
    all_gone: bool = True
    refuses: bool = False

    def appear(self) -> None:
        handlers = {"ask": self.ask, "history": self.history, "forget": self.forget}
        for name, handler in handlers.items():
            self.instead(name, partial(self.handle, handler))

    def instead(self, name: str, handler: Callable[[Call], None]) -> None:
        """Let nobody else answer such requests any more."""
        key = KEYS.of(f"@rpc/{name}")
        self.hub.servers.pop(key, None)
        self.hub.connect().serve(key, handler)

    def hang(self) -> None:
        for name in ("ask", "history", "forget"):
            self.instead(name, lambda call: call.drop())

    def vanish(self) -> None:
        self.hub.servers.clear()

    def handle(self, handler: Callable[[bytes], bytes], call: Call) -> None:
        if self.refuses:
            call.refuse(pack(Failure(reason="busy", detail="not\x1b[2J now")))
        else:
            call.reply(handler(call.payload))

    def ask(self, payload: bytes) -> bytes:
        asked = unpack(payload, AskRequest)
        said = reply(f"Answer to {asked.text}", asked.at or 0.0)
        self.turns.append(PastTurn(asked.text, said))
        fields = msgspec.structs.asdict(said)
        return pack(AskReply(**fields, request=asked.request, seq=0, wall_time=0.0))

    def history(self, _: bytes) -> bytes:
        turns = tuple(self.turns)
        told = HistoryReply(session="ada", seq=0, sim_time=0.0, wall_time=0.0, turns=turns)
        return pack(told)

    def forget(self, payload: bytes) -> bytes:
        asked = unpack(payload, ForgetRequest)
        count = len(self.turns)
        self.turns.clear()
        told = ForgetReply(
            request=asked.request, session=asked.session, turns=count, forgotten=self.all_gone
        )
        return pack(told)


@pytest.fixture
def service() -> FakeService:
    made = FakeService()
    made.appear()
    return made


@pytest.fixture
def client(service: FakeService) -> Client:
    return Client(service.hub.connect(), KEYS, "ada", lambda _: None)


@pytest.fixture
def session_history(client: Client) -> SessionHistory:
    return SessionHistory(client, "ada", HEADER)


def scene(at: float, state: CarState = "driving", ride: str = "r1") -> SceneReport:
    vehicles: dict[int, VehicleState] = {0: EGO}
    return SceneReport(
        ride=ride,
        seq=0,
        sim_time=at,
        wall_time=0.0,
        vehicles=vehicles,
        state=state,
        speed_factor=1.0,
        plan=("continue",),
        traces=0,
        events=0,
    )


def test_why_is_asked_of_what_was_said_last_else_of_what_was_done(
    session_history: SessionHistory, client: Client
) -> None:
    assert session_history.why() == slash_commands.WHY_DONE
    client.ask("What are you doing?")
    assert session_history.why() == slash_commands.WHY


def test_what_was_said_is_told_with_its_moments(
    session_history: SessionHistory, client: Client
) -> None:
    assert session_history.told() == NOTHING
    for text, at in (("One?", 1.0), ("Two?", 1.0), ("Three?", 2.5)):
        client.ask(text, at)
    assert session_history.told() == (
        "@ 1.0s\n\n> One?\nAnswer to One?\n\n> Two?\nAnswer to Two?\n\n"
        "@ 2.5s\n\n> Three?\nAnswer to Three?"
    )


def test_what_is_saved_is_a_transcript(
    session_history: SessionHistory, client: Client, tmp_path: Path
) -> None:
    client.ask("One?", 1.0)
    file = tmp_path / "said.txt"
    assert session_history.save(str(file), NOW) == f"Saved one question and its answer to {file}."
    read = transcript.read(file.read_text())
    assert dict(read.header) == dict(HEADER)
    assert "> One?\nAnswer to One?\n" in file.read_text()


def test_what_is_saved_as_json_lines_can_be_read_back(
    session_history: SessionHistory, client: Client, tmp_path: Path
) -> None:
    client.ask("One?", 1.0)
    client.ask("Two?", 2.0)
    file = tmp_path / "said.jsonl"
    assert session_history.save(str(file), NOW) == f"Saved 2 questions and their answers to {file}."
    read = [msgspec.json.decode(line, type=PastTurn) for line in file.read_text().splitlines()]
    assert read == list(client.history())


def test_a_file_without_a_name_is_named_after_session_and_time(
    session_history: SessionHistory, client: Client, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    client.ask("One?")
    session_history.save("", NOW)
    assert [file.name for file in tmp_path.iterdir()] == ["ada-20260504-030201.txt"]


def test_no_file_is_written_over_and_none_without_anything_said(
    session_history: SessionHistory, client: Client, tmp_path: Path
) -> None:
    file = tmp_path / "said.txt"
    with pytest.raises(CommandError, match="nothing to save"):
        session_history.save(str(file), NOW)
    assert not file.exists()
    client.ask("One?")
    file.write_text("mine")
    with pytest.raises(CommandError, match=r"said\.txt already; it stays as it is"):
        session_history.save(str(file), NOW)
    assert file.read_text() == "mine"
    with pytest.raises(CommandError, match="cannot be written: No such file"):
        session_history.save(str(tmp_path / "nowhere" / "said.txt"), NOW)


def test_what_is_saved_is_for_its_owner_alone(
    session_history: SessionHistory, client: Client, tmp_path: Path
) -> None:
    client.ask("One?")
    for name in ("said.txt", "said.jsonl"):
        session_history.save(str(tmp_path / name), NOW)
        assert (tmp_path / name).stat().st_mode & 0o777 == 0o600


def test_what_cannot_be_saved_whole_leaves_nothing_in_its_way(
    session_history: SessionHistory, client: Client, tmp_path: Path
) -> None:
    for k in range(20):
        client.ask(f"{k} " + "long " * 200)
    file = tmp_path / "said.txt"
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, limits[1]))
        with pytest.raises(CommandError, match="cannot be written: File too large"):
            session_history.save(str(file), NOW)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, before)
    assert not file.exists()
    assert session_history.save(str(file), NOW).startswith("Saved 20")


def test_a_place_that_nobody_has_is_no_place_to_save(
    session_history: SessionHistory, client: Client
) -> None:
    client.ask("One?")
    with pytest.raises(CommandError, match="There is no place ~nobody-of-this-name/x"):
        session_history.save("~nobody-of-this-name/x", NOW)


def test_forgetting_needs_no_history(client: Client, service: FakeService) -> None:
    client.ask("One?")
    service.instead("history", lambda call: call.refuse(b""))
    assert SessionHistory(client, "ada", HEADER).forget() == "Erased one question and its answer."


def test_whether_a_service_answers_needs_no_history(client: Client, service: FakeService) -> None:
    class Serving:
        def check(self) -> None:
            pass

    bus = service.hub.connect()
    bus.serve(KEYS.of("@rpc/history"), lambda call: call.reply(b"x" * HistoryReply.LIMIT * 2))
    bus.serve(KEYS.of("@rpc/cancel"), lambda call: call.reply(cancelled(call.payload)))
    backend = LocalBackend(Serving(), Serving(), bus)  # type: ignore[arg-type]
    assert backend.recover(client)


def cancelled(payload: bytes) -> bytes:
    """That there was nothing to cancel."""
    wanted = unpack(payload, CancelRequest)
    return pack(CancelReply(request=wanted.request, cancelled=False))


def test_forgetting_tells_how_much_it_was_and_takes_what_was_typed_with_it(
    client: Client,
) -> None:
    typed = ["/save secret.txt"]  # also where nothing came of it
    session_history = SessionHistory(client, "ada", HEADER, typed.clear)
    assert session_history.forget() == "There was nothing to erase."
    assert typed == []
    client.ask("One?")
    assert session_history.forget() == "Erased one question and its answer."
    client.ask("One?")
    client.ask("Two?")
    assert session_history.forget() == "Erased 2 questions and their answers."
    assert session_history.told() == NOTHING


def test_what_could_not_be_erased_is_told(client: Client, service: FakeService) -> None:
    def fail() -> None:
        raise PermissionError(13, "Permission denied")

    with pytest.raises(CommandError, match="typed is not erased: Permission denied"):
        SessionHistory(client, "ada", HEADER, fail).forget()
    service.all_gone = False
    with pytest.raises(CommandError, match="Not all of it"):
        SessionHistory(client, "ada", HEADER).forget()
    service.refuses = True
    with pytest.raises(CommandError, match="the dialogue service refused: not now"):
        SessionHistory(client, "ada", HEADER).forget()


@pytest.mark.parametrize("lose", [FakeService.hang, FakeService.vanish])
def test_without_a_service_nothing_is_had_and_that_is_told(
    session_history: SessionHistory, service: FakeService, lose: Callable[[FakeService], None]
) -> None:
    lose(service)
    for wanted in (
        session_history.why,
        session_history.told,
        session_history.forget,
        partial(session_history.save, "", NOW),
    ):
        with pytest.raises(CommandError, match="the dialogue service does not answer"):
            wanted()


def test_a_service_that_says_nothing_has_timed_out(client: Client, service: FakeService) -> None:
    service.hang()
    late = client.ask("One?", 3.0)
    assert (late.kind, late.reason, late.sim_time) == ("refusal", "timed-out", 3.0)
    assert late.text


def test_tokens_go_with_all_that_is_asked_and_a_wrong_one_is_told_in_words(
    service: FakeService,
) -> None:
    bus, came = service.hub.connect(), []

    def refuse(call: Call) -> None:
        came.append(msgspec.json.decode(call.payload))
        call.refuse(pack(Failure(reason="out-of-scope", detail=FOREIGN)))

    for name in ("ask", "history", "forget", "cancel"):
        service.instead(name, refuse)
    client = Client(bus, KEYS, "ada", token="t" * 43, share=True)
    session_history = SessionHistory(client, "ada", HEADER)
    refused = client.ask("One?")
    client.cancel("r1")
    for wanted in (session_history.told, session_history.forget):
        with pytest.raises(CommandError, match=f": {FOREIGN}\\."):
            wanted()
    assert (refused.text, status_of(refused)) == (f"({FOREIGN})", ExitStatus.DECLINED)
    assert [one["token"] for one in came] == ["t" * 43] * 4
    assert came[0]["share"]


def test_now_is_what_the_passenger_has_been_told_of(client: Client, service: FakeService) -> None:
    car = service.hub.connect()

    def happens(at: float, ride: str = "r1") -> None:
        event = Event("arrived", at)
        report = EventReport(ride=ride, seq=0, sim_time=at, wall_time=0.0, event=event)
        car.publisher(KEYS.of("event")).put(pack(report))

    def shows(report: SceneReport) -> None:
        car.publisher(KEYS.of("scene")).put(pack(report))

    assert client.now() is None
    shows(scene(4.0))
    assert client.now() == 4.0
    happens(4.5)
    assert client.now() == 4.5  # the scene of it comes later
    shows(scene(4.2, "paused"))
    assert client.now() == 4.2
    shows(scene(5.0))
    assert client.now() == 5.0
    happens(9.0, ride="another")
    assert client.now() == 5.0


def test_a_question_that_is_refused_is_told_in_brackets(
    client: Client, service: FakeService
) -> None:
    service.refuses = True
    refused = "(the dialogue service refused: not now)"
    reply = client.ask("One?", 3.0)
    assert (reply.text, reply.reason, reply.sim_time) == (refused, "busy", 3.0)
    told = asyncio.run(controller(client, FakeBackend(service, able=False)).ask("One?", "r1"))
    assert told == refused


@pytest.mark.parametrize("answer", [lambda c: c.refuse(b"junk"), lambda c: c.reply(b"junk")])
def test_a_service_that_talks_nonsense_ends_no_conversation(
    pipe: "Pipe", service: FakeService, answer: Callable[[Call], None]
) -> None:
    service.instead("ask", answer)
    assert pipe.say("One?")
    service.appear()
    assert pipe.say("Two?")
    assert pipe.out[0].startswith("(the dialogue service ")
    assert pipe.out[1:] == ["Answer to Two?"]


class FakeBackend:
    """Starts the service anew, or in vain."""

    def __init__(self, service: FakeService, *, able: bool = True) -> None:
        self.service, self.able = service, able
        self.over, self.paced = threading.Event(), True
        self.halts_at: float | None = None  # [s]; None: it takes no orders

    def check(self) -> None:
        pass

    def recover(self, client: Client) -> bool:
        if self.able:
            self.service.appear()
        return self.able

    def order(self, order: child_commands.Order) -> None:
        raise CommandError("I take no orders.")

    def set_off(self) -> None:
        pass

    def drive(
        self, client: Client, order: child_commands.Order, *, halt: bool = False
    ) -> SceneReport:
        if self.halts_at is None:
            self.order(order)
            raise AssertionError
        return scene(self.halts_at, "paused")

    def now(self, client: Client) -> float | None:
        return client.now()

    def trouble(self) -> str:
        return "the car is away" if not self.able else ""


def controller(client: Client, backend: Backend) -> ChatController:
    return ChatController(backend, client, SessionHistory(client, "ada", HEADER))


def test_a_question_that_a_dead_service_missed_is_asked_again(
    client: Client, service: FakeService
) -> None:
    service.vanish()
    told = asyncio.run(controller(client, FakeBackend(service)).ask("One?", "r1"))
    assert told == "Answer to One?"


def test_when_no_service_comes_back_the_passenger_is_told(
    client: Client, service: FakeService
) -> None:
    service.vanish()
    told = asyncio.run(controller(client, FakeBackend(service, able=False)).ask("One?", "r1"))
    assert told == f"{LOST} the dialogue service does not answer."


@dataclass
class Pipe:
    """A conversation through a pipe, and what came out."""

    client: Client
    service: FakeService
    as_json: bool = False
    out: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def say(self, *lines: str) -> bool:
        session_history = SessionHistory(self.client, "ada", HEADER)
        backend = FakeBackend(self.service)
        write, note = self.out.append, self.notes.append
        batch = BatchChat(
            backend, self.client, session_history, write, note, self.as_json, scene(8.0), 8.0
        )
        return all(batch.take(line) for line in lines)


@pytest.fixture
def pipe(client: Client, service: FakeService) -> Pipe:
    return Pipe(client, service)


def test_commands_work_through_the_pipe(pipe: Pipe, tmp_path: Path) -> None:
    file = tmp_path / "said.txt"
    assert pipe.say("/why", "/more", f"/save {file}", "/vehicles", "/plan", "/history", "/forget")
    assert pipe.out[:2] == [
        f"Answer to {slash_commands.WHY_DONE}",
        f"Answer to {slash_commands.MORE}",
    ]
    assert pipe.out[2:4] == ["There is no other vehicle in view.", "I plan to go on."]
    assert pipe.out[4].startswith("@ 8.0s\n\n> Why did you do that?\n")
    assert pipe.notes == [
        f"Saved 2 questions and their answers to {file}.",
        "Erased 2 questions and their answers.",
    ]


def test_help_lists_what_works_through_the_pipe(pipe: Pipe) -> None:
    assert pipe.say("/help")
    [listed] = pipe.out
    assert all(f"/{form.name}" in listed for form in slash_commands.forms("pipe"))
    assert "/pause" not in listed


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("/hist", "The nearest is /history; /help lists all."),
        ("/pause", "/pause needs a terminal."),
        ("/plan b", "/plan takes nothing after it."),
        ("/save", "nothing to save"),
    ],
)
def test_errors_of_commands_are_notes_and_the_conversation_goes_on(
    pipe: Pipe, line: str, problem: str
) -> None:
    assert pipe.say(line, "One?")
    assert problem in pipe.notes[0]
    assert pipe.out == ["Answer to One?"]


def test_with_json_nothing_but_answers_comes_out(pipe: Pipe) -> None:
    pipe.as_json = True
    assert pipe.say("/help", "One?", "/history", "/vehicles", "/plan")
    [answer] = pipe.out
    assert msgspec.json.decode(answer)["text"] == "Answer to One?"
    assert len(pipe.notes) == 4


def test_the_latest_moment_is_told_as_such(pipe: Pipe) -> None:
    assert pipe.say("@ 2.0s", "/plan", "One?")
    assert pipe.notes == ["this is how it is at 8.0 s"]
    assert pipe.service.turns[0].reply.sim_time == 2.0


@pytest.mark.parametrize("line", ["@ 1e9s", "@ -5s", "@ nan s", "@", "@ 8 o'clock", "@" * 99])
def test_what_is_no_moment_is_no_question_either(pipe: Pipe, line: str) -> None:
    assert pipe.say(line, "One?")
    [note] = pipe.notes
    assert note == f"a moment is written @ 8.0s, not {line[:40]!r}"
    assert pipe.out == ["Answer to One?"]
    assert pipe.service.turns[0].reply.sim_time == 8.0


def test_a_refused_question_does_not_end_the_conversation(pipe: Pipe) -> None:
    pipe.service.refuses = True
    assert pipe.say("One?")
    pipe.service.refuses = False
    assert pipe.say("\U0001f600" * 5000, "Two?")
    assert pipe.out[0] == "(the dialogue service refused: not now)"
    assert pipe.out[2] == "Answer to Two?"


def test_quit_ends_and_a_question_is_not_too_long(pipe: Pipe) -> None:
    assert not pipe.say("/quit")
    assert pipe.say("long " * 1000)
    assert pipe.notes == ["only the first 4096 characters of a question are asked"]
    assert len(pipe.service.turns[0].text) <= 4096


def test_a_question_through_the_pipe_survives_the_service(pipe: Pipe) -> None:
    pipe.service.vanish()
    assert pipe.say("One?")
    assert pipe.out == ["Answer to One?"]


def test_a_moment_that_cannot_be_driven_to_is_told_and_can_still_be_asked_about(
    pipe: Pipe,
) -> None:
    assert pipe.say("@ 9.0s", "One?")
    assert pipe.notes == ["I take no orders."]
    assert pipe.out == ["Answer to One?"]


def test_of_a_ride_that_goes_on_by_itself_now_is_asked_until_a_moment_is_named(
    pipe: Pipe, client: Client
) -> None:
    client.scene = scene(3.0)
    session_history, backend = SessionHistory(client, "ada", HEADER), FakeBackend(pipe.service)
    write, note = pipe.out.append, pipe.notes.append
    batch = BatchChat(
        backend, client, session_history, write, note, False, scene(1.0), None, live=True
    )
    for line in ("One?", "/plan", "@ 2.0s", "Two?", "@ 9.0s", "Three?"):
        assert batch.take(line)
    assert [turn.reply.sim_time for turn in pipe.service.turns] == [3.0, 2.0, 9.0]
    assert pipe.notes == []
    assert "I plan to go on." in pipe.out


def test_what_ails_the_car_is_in_the_status_and_orders_are_declined(
    client: Client, service: FakeService
) -> None:
    sat = controller(client, FakeBackend(service, able=False))
    client.scene = scene(3.0, "paused")
    assert sat.status().endswith("the car is away")
    for order in (sat.pause, sat.resume, lambda: sat.speed(2.0)):
        with pytest.raises(CommandError, match="I take no orders"):
            order()
