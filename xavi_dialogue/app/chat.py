"""`xavi chat`: car, service and conversation in one go, at a terminal or through a pipe."""

import asyncio
import signal
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from xavi_dialogue.app import control
from xavi_dialogue.app.cabin import RemoteCabin
from xavi_dialogue.app.client import Client
from xavi_dialogue.app.convoy import Convoy, convoy, first_scene
from xavi_dialogue.app.narration import Narrator
from xavi_dialogue.dialogue.reply import Reply, encode
from xavi_dialogue.transports.bus import Keys
from xavi_dialogue.transports.messages import MAX_TEXT, EventReport
from xavi_dialogue.transports.text import one_line
from xavi_dialogue.transports.transcript import moment

Write = Callable[[str], None]


@dataclass(frozen=True)
class Ride:
    """What to drive, and as whom to talk."""

    scenario: str  # folder
    name: str  # of the scenario
    seed: int
    session: str


def through_pipe(
    ride: Ride, lines: Iterable[str], write: Write, note: Write, *, speed: float, as_json: bool
) -> None:
    """Drive to the first moment worth asking about, then answer line by line.

    Args:
        ride: what to drive.
        lines: questions; "@ 8.0s" moves time, "/quit" ends.
        write: takes answers.
        note: takes notes on what goes on.
        speed: simulated seconds per second; 0 is as fast as possible.
        as_json: write replies as JSON.

    Raises:
        ChildFailed: car or service ended, or did not start.
        ServiceLost: a question was not answered.
    """
    note(f"driving {ride.name}, seed {ride.seed}")
    with convoy(ride.scenario, ride.seed, speed) as behind:
        client = Client(behind.bus, Keys(), ride.session)
        first_scene(behind, client)
        scene = behind.drive(client, control.Until(None), halt=True)
        at = scene.sim_time
        note(f"asking at {at:.1f} s")
        for raw in lines:
            line = one_line(raw[:MAX_TEXT])
            moved = moment(line)
            if line == "/quit":
                return
            if moved is not None:
                at = moved
                if scene.sim_time < at and scene.state != "ended":
                    scene = behind.drive(client, control.Until(at), halt=True)
            elif line.startswith("/"):
                note(f"there is no command {line.split()[0]} without a terminal")
            elif line:
                write(_shown(client.ask(line, at), as_json))


def at_terminal(ride: Ride, history: Path, *, speed: float) -> None:
    """Talk at the process's terminal while the car drives.

    Raises:
        ChildFailed: car or service ended, or did not start.
    """
    with convoy(ride.scenario, ride.seed, speed) as behind:
        asyncio.run(_talk(ride, behind, history))


async def _talk(ride: Ride, behind: Convoy, history: Path) -> None:
    # Deferred: a quarter of a second that only a terminal needs.
    from prompt_toolkit.history import FileHistory

    from xavi_dialogue.transports.terminal import TerminalChat

    told: list[Write] = []
    narrator = Narrator()

    def on_event(report: EventReport) -> None:
        line = narrator.tell(report.event)
        if line is not None:
            for tell in told:
                tell(line)

    client = Client(behind.bus, Keys(), ride.session, on_event)
    await asyncio.to_thread(first_scene, behind, client)
    history.parent.mkdir(parents=True, exist_ok=True)
    chat = TerminalChat(RemoteCabin(behind, client), FileHistory(str(history)))
    told.append(chat.tell)
    loop = asyncio.get_running_loop()
    for number in (signal.SIGTERM, signal.SIGHUP):
        loop.add_signal_handler(number, chat.end)
    behind.car.order(control.Resume())
    await chat.run()


def _shown(reply: Reply, as_json: bool) -> str:
    return encode(reply) if as_json else reply.text
