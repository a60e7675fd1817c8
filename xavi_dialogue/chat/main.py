"""`xavi chat`: car, service and conversation in one go, at a terminal or through a pipe."""

from collections.abc import Iterable
from contextlib import AbstractContextManager, suppress
from dataclasses import dataclass
from pathlib import Path

from xavi_dialogue.bus.interface import Bus, Keys
from xavi_dialogue.chat.batch import Piped, Write, reached
from xavi_dialogue.chat.client import Client, OnEvent
from xavi_dialogue.chat.history import Minutes
from xavi_dialogue.chat.interactive import Typed, Unasked, talk, warner
from xavi_dialogue.chat.local_backend import Company, Convoy, convoy, convoy_of, first_scene
from xavi_dialogue.process import child_commands
from xavi_dialogue.security.client_token import Passenger
from xavi_dialogue.storage.turn_log import Keeping
from xavi_dialogue.terminal.slash_commands import CommandError


@dataclass(frozen=True)
class Ride:
    """What to drive, and as whom to talk."""

    scenario: str  # folder
    name: str  # of the scenario
    seed: int
    passenger: Passenger
    keeping: Keeping | None = None  # of what is said; None: it is not kept
    resume: float | None = None  # [s] how far to drive before anything is asked
    record: Path | None = None  # file that the ride is recorded in
    overwrite: bool = False  # where that is there already
    played: tuple[str, ...] = ()  # arguments of `xavi` that play a recording of it

    @property
    def header(self) -> tuple[tuple[str, str], ...]:
        """Of transcripts."""
        if self.played:
            return (("recording", self.name),)
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
        ChildFailed: a process did not start, or ended too often.
        ServiceLost: a question was not answered.
    """
    note(f"playing {ride.name}" if ride.played else f"driving {ride.name}, seed {ride.seed}")
    company = Company(ride.record, ride.overwrite, warner(note), note)
    with behind_of(ride, speed, company) as behind:
        client = client_of(ride.passenger, behind.bus, Keys())
        scene = first_scene(behind, client)
        with suppress(CommandError):  # there is no car any more, which has been told
            scene = behind.drive(client, child_commands.Until(ride.resume), halt=True)
        at = scene.sim_time if ride.resume is None else ride.resume
        at = reached(scene, at) if behind.seeks else at
        note(f"asking at {at:.1f} s")
        minutes = Minutes(client, ride.passenger.session, ride.header)
        piped = Piped(behind, client, minutes, write, note, as_json, scene, at)
        piped.seeks = behind.seeks
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
        ChildFailed: a process did not start, or ended too often.
    """
    unasked = Unasked(note)
    company = Company(ride.record, ride.overwrite, unasked.warn, unasked.tell)
    first = speed if ride.resume is None else 0.0
    with behind_of(ride, first, company) as behind:
        client = client_of(ride.passenger, behind.bus, Keys(), unasked.on_event)
        minutes = Minutes(client, ride.passenger.session, ride.header)
        typed = Typed(history, None if ride.keeping is None else ride.keeping.days)
        talk(behind, client, minutes, typed, unasked, lambda: _begin(ride, behind, client, speed))


def behind_of(ride: Ride, speed: float, company: Company) -> AbstractContextManager[Convoy]:
    """The processes behind a conversation about a ride.

    Args:
        ride: to drive, or to play.
        speed: at which it begins.
        company: what else there is.

    Raises:
        ChildFailed: one does not come up.
    """
    if ride.played:
        played = [*ride.played, "--speed", repr(speed)]
        return convoy_of(played, speed, ride.keeping, company, seeks=True)
    return convoy(ride.scenario, ride.seed, speed, ride.keeping, company)


def client_of(
    passenger: Passenger, bus: Bus, keys: Keys, on_event: OnEvent | None = None
) -> Client:
    """A passenger on the bus."""
    token, share = passenger.token, passenger.share
    return Client(bus, keys, passenger.session, on_event, token=token, share=share)


def _begin(ride: Ride, behind: Convoy, client: Client, speed: float) -> None:
    """Wait for the car, and have it drive to where the conversation goes on."""
    first_scene(behind, client)
    if ride.resume is not None:
        with suppress(CommandError):  # there is no car any more, which has been told
            behind.drive(client, child_commands.Until(ride.resume), halt=True)
            behind.order(child_commands.Speed(speed))
