"""`xavi chat`: car, service and conversation in one go, at a terminal or through a pipe."""

import asyncio
import os
import signal
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path

from xavi_dialogue.app import control
from xavi_dialogue.app.cabin import RemoteCabin
from xavi_dialogue.app.client import Client
from xavi_dialogue.app.convoy import Convoy, convoy, first_scene
from xavi_dialogue.app.memory import Keeping
from xavi_dialogue.app.minutes import Minutes
from xavi_dialogue.app.narration import Narrator
from xavi_dialogue.app.piped import Piped, Write
from xavi_dialogue.transports.bus import Keys
from xavi_dialogue.transports.messages import EventReport


@dataclass(frozen=True)
class Ride:
    """What to drive, and as whom to talk."""

    scenario: str  # folder
    name: str  # of the scenario
    seed: int
    session: str
    keeping: Keeping | None = None  # of what is said; None: it is not kept
    resume: float | None = None  # [s] how far to drive before anything is asked

    @property
    def header(self) -> tuple[tuple[str, str], ...]:
        """Of transcripts."""
        return (("scenario", self.name), ("seed", str(self.seed)))


def through_pipe(
    ride: Ride, lines: Iterable[str], write: Write, note: Write, *, speed: float, as_json: bool
) -> None:
    """Drive to the first moment worth asking about, then answer line by line.

    Args:
        ride: what to drive.
        lines: questions; "@ 8.0s" moves time, "/quit" ends, "/help" lists the other commands.
        write: takes answers.
        note: takes notes on what goes on.
        speed: simulated seconds per second; 0 is as fast as possible.
        as_json: write replies as JSON.

    Raises:
        ChildFailed: car or service ended, or did not start.
        ServiceLost: a question was not answered.
    """
    note(f"driving {ride.name}, seed {ride.seed}")
    warn = _warner(note)
    with convoy(ride.scenario, ride.seed, speed, ride.keeping, warn) as behind:
        client = Client(behind.bus, Keys(), ride.session)
        first_scene(behind, client)
        scene = behind.drive(client, control.Until(ride.resume), halt=True)
        at = scene.sim_time if ride.resume is None else ride.resume
        note(f"asking at {at:.1f} s")
        minutes = Minutes(client, ride.session, ride.header)
        piped = Piped(behind, client, minutes, write, note, as_json, scene, at)
        for raw in lines:
            if not piped.take(raw):
                return


def at_terminal(ride: Ride, history: Path, note: Write, *, speed: float) -> None:
    """Talk at the process's terminal while the car drives.

    Args:
        ride: what to drive.
        history: file of what was typed.
        note: takes notes before the conversation begins.
        speed: simulated seconds per second; 0 is as fast as possible.

    Raises:
        ChildFailed: car or service ended, or did not start.
    """
    told: list[Write] = []

    def warn(text: str) -> None:
        for tell in tuple(told) or (_warner(note),):
            tell(text)

    first = speed if ride.resume is None else 0.0
    with convoy(ride.scenario, ride.seed, first, ride.keeping, warn) as behind:
        asyncio.run(_talk(ride, behind, history, told, speed))


async def _talk(ride: Ride, behind: Convoy, history: Path, told: list[Write], speed: float) -> None:
    # Deferred: a quarter of a second that only a terminal needs.
    from prompt_toolkit.application import create_app_session

    from xavi_dialogue.transports.screen import Keyboard, silent_screen
    from xavi_dialogue.transports.terminal import TerminalChat
    from xavi_dialogue.transports.typed import TypedLines, UnkeptLines, erase

    narrator = Narrator()

    def on_event(report: EventReport) -> None:
        line = narrator.tell(report.event)
        if line is not None:
            for tell in told:
                tell(line)

    client = Client(behind.bus, Keys(), ride.session, on_event)
    await asyncio.to_thread(first_scene, behind, client)
    if ride.resume is not None:
        until = control.Until(ride.resume)
        await asyncio.to_thread(behind.drive, client, until, halt=True)
        behind.car.order(control.Speed(speed))
    typed: TypedLines | UnkeptLines = UnkeptLines()
    if ride.keeping is not None:
        history.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        erase(history, before=datetime.now() - timedelta(days=ride.keeping.days))
        typed = TypedLines(history, ride.session)
    minutes = Minutes(client, ride.session, ride.header, typed.forget)
    cabin = RemoteCabin(behind, client, minutes)
    with create_app_session(output=silent_screen(sys.stdout, os.environ.get("TERM"))):
        chat = TerminalChat(cabin, typed, keyboard=Keyboard(sys.stdin))
        told.append(chat.tell)
        loop = asyncio.get_running_loop()
        for number in (signal.SIGTERM, signal.SIGHUP):
            loop.add_signal_handler(number, chat.end)
        behind.car.order(control.Resume())
        try:
            await chat.run()
        finally:
            behind.over.set()


def _warner(note: Write) -> Write:
    return lambda text: note(f"warning: {text}")
