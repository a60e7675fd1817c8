"""`xavi chat`: car, service and conversation in one go, at a terminal or through a pipe."""

from collections.abc import Iterable
from contextlib import AbstractContextManager, suppress
from dataclasses import dataclass
from pathlib import Path

from xavi_dialogue.bus.interface import Bus, Keys
from xavi_dialogue.chat.batch import BatchChat, Write, reached
from xavi_dialogue.chat.client import Client, OnEvent
from xavi_dialogue.chat.history import SessionHistory
from xavi_dialogue.chat.interactive import InputHistoryOptions, Notices, talk, warner
from xavi_dialogue.chat.local_backend import (
    LocalBackend,
    LocalOptions,
    first_scene,
    start_local,
    start_processes,
)
from xavi_dialogue.nlg.narration import clock
from xavi_dialogue.process import child_commands
from xavi_dialogue.security.client_token import Passenger
from xavi_dialogue.storage.turn_log import Retention
from xavi_dialogue.terminal.slash_commands import CommandError


@dataclass(frozen=True)
class ChatOptions:
    """The ride and the session of a chat."""

    scenario: str  # folder
    name: str  # name of the scenario, or of the recording
    seed: int
    passenger: Passenger
    keeping: Retention | None = None  # store of turns; None: none
    resume: float | None = None  # [s] time to drive to before the first question
    record: Path | None = None  # file that the ride is recorded in
    overwrite: bool = False  # replace an existing file
    duration: float | None = None  # [s] of the ride at the longest; None: the scenario's
    played: tuple[str, ...] = ()  # arguments of `xavi` that play a recording; (): drive

    @property
    def header(self) -> tuple[tuple[str, str], ...]:
        """The header of transcripts."""
        if self.played:
            return (("recording", self.name),)
        return (("scenario", self.name), ("seed", str(self.seed)))


def through_pipe(
    ride: ChatOptions,
    lines: Iterable[str],
    write: Write,
    note: Write,
    *,
    speed: float,
    as_json: bool,
) -> None:
    """Drive to the first moment worth asking about, then answer line by line.

    Args:
        ride: the ride and the session.
        lines: questions; "@ 8.0s" moves time, "/quit" ends, "/help" lists the other commands.
        write: takes answers.
        note: is called with notes.
        speed: simulated seconds per second; 0 is as fast as possible.
        as_json: write replies as JSON.

    Raises:
        ChildFailed: a process did not start, or ended too often.
        ServiceLost: a question was not answered.
    """
    note(_announced(ride))
    options = LocalOptions(ride.record, ride.overwrite, warner(note), note)
    with start_backend(ride, speed, options) as backend:
        client = client_of(ride.passenger, backend.bus, Keys())
        scene = first_scene(backend, client)
        with suppress(CommandError):  # the car has ended, which was reported
            scene = backend.drive(client, child_commands.Until(ride.resume), halt=True)
        at = scene.sim_time if ride.resume is None else ride.resume
        at = reached(scene, at) if backend.seeks else at
        note(f"asking at {at:.1f} s")
        session_history = SessionHistory(client, ride.passenger.session, ride.header)
        batch = BatchChat(backend, client, session_history, write, note, as_json, scene, at)
        batch.seeks = backend.seeks
        for raw in lines:
            if not batch.take(raw):
                return


def at_terminal(ride: ChatOptions, history: Path, note: Write, *, speed: float) -> None:
    """Talk at the process's terminal while the car drives.

    Args:
        ride: the ride and the session.
        history: file of typed lines.
        note: is called with notes before the conversation begins.
        speed: simulated seconds per second; 0 is as fast as possible.

    Raises:
        ChildFailed: a process did not start, or ended too often.
    """
    notices = Notices(note)
    options = LocalOptions(ride.record, ride.overwrite, notices.warn, notices.tell)
    first = speed if ride.resume is None else 0.0
    with start_backend(ride, first, options) as backend:
        client = client_of(ride.passenger, backend.bus, Keys(), notices.on_event)
        session_history = SessionHistory(client, ride.passenger.session, ride.header)
        typed = InputHistoryOptions(history, None if ride.keeping is None else ride.keeping.days)
        talk(
            backend,
            client,
            session_history,
            typed,
            notices,
            lambda: _begin(ride, backend, client, speed),
        )


def start_backend(
    ride: ChatOptions, speed: float, options: LocalOptions
) -> AbstractContextManager[LocalBackend]:
    """Return the processes behind a conversation about a ride.

    Args:
        ride: to drive, or to play.
        speed: the initial pace.
        options: recording and notes.

    Raises:
        ChildFailed: a process did not start.
    """
    if ride.played:
        played = [*ride.played, "--speed", repr(speed)]
        return start_processes(played, speed, ride.keeping, options, seeks=True)
    return start_local(ride.scenario, ride.seed, speed, ride.keeping, options, ride.duration)


def client_of(
    passenger: Passenger, bus: Bus, keys: Keys, on_event: OnEvent | None = None
) -> Client:
    """Return a passenger on the bus."""
    token, share = passenger.token, passenger.share
    return Client(bus, keys, passenger.session, on_event, token=token, share=share)


def _announced(ride: ChatOptions) -> str:
    """Describe what happens before the first answer."""
    if ride.played:
        return f"playing {ride.name}"
    until = "the end of the first lane change or turn, or of the ride"
    if ride.resume is not None:
        until = clock(ride.resume)
    return f"driving {ride.name}, seed {ride.seed}, up to {until}; answers follow"


def _begin(ride: ChatOptions, backend: LocalBackend, client: Client, speed: float) -> None:
    """Wait for the car, and drive to the time at which the conversation resumes."""
    first_scene(backend, client)
    if ride.resume is not None:
        with suppress(CommandError):  # the car has ended, which was reported
            backend.drive(client, child_commands.Until(ride.resume), halt=True)
            backend.order(child_commands.Speed(speed))
