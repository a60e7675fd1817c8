"""Talking with a car and a service that others have started: nothing is started or stopped."""

import threading
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field

from xavi_dialogue.bus.interface import EVERY_CAR, HubUnreachable, Keys, NobodyThere, vehicle_in
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import MAX_TEXT, SceneReport
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.bus.zenoh_bus import ZenohBus, join
from xavi_dialogue.chat.batch import Piped, Write
from xavi_dialogue.chat.client import Client, OnEvent, ServiceLost
from xavi_dialogue.chat.history import Minutes
from xavi_dialogue.chat.interactive import Typed, Unasked, talk
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.nlg.context import Style
from xavi_dialogue.process import child_commands
from xavi_dialogue.security.client_token import Passenger
from xavi_dialogue.terminal.slash_commands import CommandError

PATIENCE = 20.0  # [s] for a hub, a service and a car to talk with
BRIEFLY = 5.0  # [s] the same for one question
BACK = 15.0  # [s] for a service that was there to be there again
POLL = 0.1  # [s]
NAMED = 10  # cars that are named at most
DECLINED = "I only ride along here: whoever started the car sets its pace."
GONE = "the car is not on the bus"


class Missing(Exception):
    """Somebody who is needed is not there."""


@dataclass
class Cars:
    """The cars on a bus."""

    names: dict[str, None] = field(default_factory=dict)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def see(self, key: str, alive: bool) -> None:
        """Take down that a car has come or gone."""
        name = vehicle_in(key)
        with self.lock:
            if name is not None and alive:
                self.names[name] = None
            elif name is not None:
                self.names.pop(name, None)

    def told(self) -> str:
        """Who is there, in words."""
        with self.lock:
            names = sorted(self.names)
        if not names:
            return "there is no car at all; start one with: xavi drive --connect ENDPOINT"
        more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
        return f"there {'is' if len(names) == 1 else 'are'} {', '.join(names[:NAMED])}{more}"


@dataclass(frozen=True)
class Along:
    """Car and service of others; see Behind."""

    bus: ZenohBus
    vehicle: str
    cars: Cars
    over: threading.Event = field(default_factory=threading.Event)

    def check(self) -> None:
        """Nothing that is missing here ends the conversation: it may come back."""

    def recover(self, client: Client) -> bool:
        """See Behind."""
        give_up = time.monotonic() + BACK
        while time.monotonic() < give_up and not self.over.wait(POLL):
            with suppress(ServiceLost):
                client.probe()
                return True
        return False

    def order(self, order: child_commands.Order) -> None:
        """See Behind."""
        raise CommandError(DECLINED)

    def set_off(self) -> None:
        """The ride is under way, or not, whoever is told of it."""

    def drive(
        self, client: Client, order: child_commands.Order, *, halt: bool = False
    ) -> SceneReport:
        """See Behind."""
        raise CommandError(DECLINED)

    def now(self, client: Client) -> float | None:
        """See Behind."""
        return client.now()

    def trouble(self) -> str:
        """See Behind."""
        return "" if self.vehicle in self.cars.names else GONE


@dataclass(frozen=True)
class There:
    """Whom to talk with."""

    link: Link
    vehicle: str

    @property
    def header(self) -> tuple[tuple[str, str], ...]:
        """Of transcripts."""
        return (("vehicle", self.vehicle),)


@contextmanager
def meet(
    there: There, passenger: Passenger, patience: float, on_event: OnEvent | None = None
) -> Iterator[tuple[Along, Client]]:
    """Join car and service, waiting for them; they go on when this is over.

    Args:
        there: whom to talk with.
        passenger: as whom.
        patience: [s] to wait for each of hub, service and car.
        on_event: gets what happens, on a thread.

    Raises:
        HubUnreachable: there is no hub.
        BadLink: the link's configuration cannot be used.
        Missing: there is a hub, but no service, or no such car.
    """
    with join(there.link, patience) as bus:
        cars = Cars()
        bus.watch(EVERY_CAR.of("alive/car"), cars.see)
        services = Cars()
        bus.watch(EVERY_CAR.of("alive/service"), services.see)
        token, share = passenger.token, passenger.share
        keys = Keys(there.vehicle)
        client = Client(bus, keys, passenger.session, on_event, token=token, share=share)
        _wait_for_service(there, client, services, patience)
        _wait_for_car(there, client, cars, patience)
        yield Along(bus, there.vehicle, cars), client


def _wait_for_service(there: There, client: Client, services: Cars, patience: float) -> None:
    give_up = time.monotonic() + patience
    while True:
        try:
            client.probe()
            return
        except ServiceLost as error:
            if time.monotonic() > give_up:
                raise Missing(_silent(there, error, seen=bool(services.names))) from None
        time.sleep(POLL)


def _silent(there: There, error: ServiceLost, *, seen: bool) -> str:
    """Why no service answers, as far as can be told: what is denied looks like nobody there."""
    if not seen:
        return (
            "there is a hub, but no dialogue service that answers; start one with:"
            " xavi serve --connect ENDPOINT"
        )
    if there.link.config is not None and isinstance(error.__cause__, NobodyThere):
        return "the dialogue service is there, but this key may not ask it; a passenger's may"
    return "the dialogue service is there, but does not answer"


def _wait_for_car(there: There, client: Client, cars: Cars, patience: float) -> None:
    give_up = time.monotonic() + patience
    while there.vehicle not in cars.names:
        if time.monotonic() > give_up:
            raise Missing(f"there is no car {there.vehicle!r}; {cars.told()}")
        time.sleep(POLL)
    if client.wait_for(lambda _: True, lambda: None, patience) is None:
        raise Missing(f"the car {there.vehicle!r} is there, but says nothing")


def through_pipe(
    there: There,
    passenger: Passenger,
    lines: Iterable[str],
    write: Write,
    note: Write,
    *,
    as_json: bool,
) -> None:
    """Answer line by line; a line such as "@ 8.0s" says what moment questions are about.

    Args:
        there: whom to talk with.
        passenger: as whom.
        lines: questions and commands.
        write: takes answers.
        note: takes notes on what goes on.
        as_json: write replies as JSON.

    Raises:
        BusError: see `meet`.
        Missing: see `meet`.
        ServiceLost: a question was not answered.
    """
    with meet(there, passenger, PATIENCE) as (along, client):
        scene = client.scene
        assert scene is not None  # it was waited for
        note(f"riding along with {there.vehicle}")
        minutes = Minutes(client, passenger.session, there.header)
        piped = Piped(along, client, minutes, write, note, as_json, scene, None, live=True)
        for raw in lines:
            if not piped.take(raw):
                return


def at_terminal(there: There, passenger: Passenger, typed: Typed, note: Write) -> None:
    """Talk at the process's terminal while the car drives.

    Args:
        there: whom to talk with.
        passenger: as whom.
        typed: what is kept of what is typed.
        note: takes notes before the conversation begins.

    Raises:
        BusError: see `meet`.
        Missing: see `meet`.
    """
    unasked = Unasked(note)
    with meet(there, passenger, PATIENCE, unasked.on_event) as (along, client):
        note(f"riding along with {there.vehicle}")
        minutes = Minutes(client, passenger.session, there.header)
        talk(along, client, minutes, typed, unasked, lambda: None)


def ask_there(
    there: There, passenger: Passenger, text: str, at: float | None, style: Style
) -> Reply:
    """The reply to one question; where nobody can answer, that the planner is not available.

    Args:
        there: whom to ask.
        passenger: as whom.
        text: the question.
        at: [s] what moment it is about; None: now.
        style: of the answer.

    Raises:
        BadLink: the link's configuration cannot be used.
    """
    try:
        with meet(there, passenger, BRIEFLY) as (_, client):
            return client.ask(one_line(text)[:MAX_TEXT], at, style)
    except (HubUnreachable, Missing, ServiceLost) as error:
        return Reply(
            text=f"({error})",
            kind="refusal",
            reason="planner-unavailable",
            sim_time=at or 0.0,
        )
