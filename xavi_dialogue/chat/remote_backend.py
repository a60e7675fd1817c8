"""A chat with a car and a service that others started; it starts and stops no process."""

import threading
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field

from xavi_dialogue.bus.interface import EVERY_CAR, HubUnreachable, Keys, NobodyThere, vehicle_in
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import MAX_TEXT, SceneReport
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.bus.zenoh_bus import ZenohBus, join
from xavi_dialogue.chat.batch import BatchChat, Write
from xavi_dialogue.chat.client import Client, OnEvent, ServiceLost
from xavi_dialogue.chat.history import SessionHistory
from xavi_dialogue.chat.interactive import InputHistoryOptions, Notices, talk
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.errors import XaviError
from xavi_dialogue.nlg.context import Style
from xavi_dialogue.process import child_commands
from xavi_dialogue.runtime import system
from xavi_dialogue.security.client_token import Passenger
from xavi_dialogue.terminal.slash_commands import CommandError

PATIENCE = 20.0  # [s] for a hub, a service and a car to talk with
BRIEFLY = 5.0  # [s] the same for one question
BACK = 30.0  # [s] for a service to come back; a busy machine takes 15 s to start one
POLL = 0.1  # [s]
NAMED = 10  # greatest number of cars that are listed
DECLINED = "Only the program that started the car sets its pace."
GONE = "the car is not on the bus"


class NotOnBus(XaviError):
    """A hub, service or car that is needed is not on the bus."""


@dataclass
class NamesOnBus:
    """The cars on a bus."""

    names: dict[str, None] = field(default_factory=dict)
    lock: threading.Lock = field(default_factory=threading.Lock)

    def see(self, key: str, alive: bool) -> None:
        """Record that a car has come or gone."""
        name = vehicle_in(key)
        with self.lock:
            if name is not None and alive:
                self.names[name] = None
            elif name is not None:
                self.names.pop(name, None)

    def told(self) -> str:
        """List the cars in words."""
        with self.lock:
            names = sorted(self.names)
        if not names:
            return "there is no car at all; start one with: xavi drive --connect ENDPOINT"
        more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
        return f"there {'is' if len(names) == 1 else 'are'} {', '.join(names[:NAMED])}{more}"


@dataclass(frozen=True)
class RemoteBackend:
    """A vehicle and a service that others started; see Backend."""

    bus: ZenohBus
    vehicle: str
    cars: NamesOnBus
    over: system.Event = field(default_factory=system.event)
    paced: bool = False  # see Backend

    def check(self) -> None:
        """Do nothing: a missing car or service may come back, so the conversation continues."""

    def recover(self, client: Client) -> bool:
        """See Backend."""
        give_up = system.monotonic() + BACK
        while system.monotonic() < give_up and not self.over.wait(POLL):
            with suppress(ServiceLost):
                client.probe()
                return True
        return False

    def order(self, order: child_commands.Order) -> None:
        """See Backend."""
        raise CommandError(DECLINED)

    def set_off(self) -> None:
        """Do nothing: the ride does not wait for this passenger."""

    def drive(
        self, client: Client, order: child_commands.Order, *, halt: bool = False
    ) -> SceneReport:
        """See Backend."""
        raise CommandError(DECLINED)

    def now(self, client: Client) -> float | None:
        """See Backend."""
        return client.now()

    def trouble(self) -> str:
        """See Backend."""
        return "" if self.vehicle in self.cars.names else GONE


@dataclass(frozen=True)
class RemoteCar:
    """A car on a bus."""

    link: Link
    vehicle: str

    @property
    def header(self) -> tuple[tuple[str, str], ...]:
        """The header of transcripts."""
        return (("vehicle", self.vehicle),)


@contextmanager
def meet(
    there: RemoteCar, passenger: Passenger, patience: float, on_event: OnEvent | None = None
) -> Iterator[tuple[RemoteBackend, Client]]:
    """Join a car and a service, and wait for both; they continue when the context ends.

    Args:
        there: the car.
        passenger: whose session it is.
        patience: [s] to wait for each of hub, service and car.
        on_event: gets events, on a thread.

    Raises:
        HubUnreachable: there is no hub.
        BadLink: the link's configuration cannot be used.
        NotOnBus: there is a hub, but no service, or no such car.
    """
    with join(there.link, patience) as bus:
        cars = NamesOnBus()
        bus.watch(EVERY_CAR.of("alive/car"), cars.see)
        services = NamesOnBus()
        bus.watch(EVERY_CAR.of("alive/service"), services.see)
        token, share = passenger.token, passenger.share
        keys = Keys(there.vehicle)
        client = Client(bus, keys, passenger.session, on_event, token=token, share=share)
        _wait_for_service(there, client, services, patience)
        _wait_for_car(there, client, cars, patience)
        yield RemoteBackend(bus, there.vehicle, cars), client


def _wait_for_service(
    there: RemoteCar, client: Client, services: NamesOnBus, patience: float
) -> None:
    give_up = system.monotonic() + patience
    while True:
        try:
            client.probe()
            return
        except ServiceLost as error:
            if system.monotonic() > give_up:
                raise NotOnBus(_silent(there, error, services.names)) from None
        system.sleep(POLL)


def _silent(there: RemoteCar, error: ServiceLost, served: Collection[str]) -> str:
    """Explain why no service answers; a denied request looks like an absent service.

    Args:
        there: the car.
        error: what came of a request.
        served: the cars about which some service says that it answers.
    """
    if not served:
        return (
            "there is a hub, but no dialogue service that answers; start one with:"
            " xavi serve --connect ENDPOINT"
        )
    if there.link.config is not None and isinstance(error.__cause__, NobodyThere):
        return "the dialogue service is there, but this key may not ask it; a passenger's may"
    if there.vehicle in served:
        return "the dialogue service is there, but does not answer"
    return (
        f"there are dialogue services, but none answers about the car {there.vehicle!r};"
        " xavi doctor tells which is missing"
    )


def _wait_for_car(there: RemoteCar, client: Client, cars: NamesOnBus, patience: float) -> None:
    give_up = system.monotonic() + patience
    while there.vehicle not in cars.names:
        if system.monotonic() > give_up:
            raise NotOnBus(f"there is no car {there.vehicle!r}; {cars.told()}")
        system.sleep(POLL)
    if client.wait_for(lambda _: True, lambda: None, patience) is None:
        raise NotOnBus(f"the car {there.vehicle!r} is there, but says nothing")


def through_pipe(
    there: RemoteCar,
    passenger: Passenger,
    lines: Iterable[str],
    write: Write,
    note: Write,
    *,
    as_json: bool,
) -> None:
    """Answer line by line; a line such as "@ 8.0s" sets the time that questions are about.

    Args:
        there: the car.
        passenger: whose session it is.
        lines: questions and commands.
        write: takes answers.
        note: is called with notes.
        as_json: write replies as JSON.

    Raises:
        TransportError: see `meet`.
        NotOnBus: see `meet`.
        ServiceLost: a question was not answered.
    """
    with meet(there, passenger, PATIENCE) as (backend, client):
        scene = client.scene
        assert scene is not None  # it was waited for
        note(f"riding along with {there.vehicle}")
        session_history = SessionHistory(client, passenger.session, there.header)
        batch = BatchChat(
            backend, client, session_history, write, note, as_json, scene, None, live=True
        )
        for raw in lines:
            if not batch.take(raw):
                return


def at_terminal(
    there: RemoteCar, passenger: Passenger, typed: InputHistoryOptions, note: Write
) -> None:
    """Talk at the process's terminal while the car drives.

    Args:
        there: the car.
        passenger: whose session it is.
        typed: whether and how long typed lines are stored.
        note: is called with notes before the conversation begins.

    Raises:
        TransportError: see `meet`.
        NotOnBus: see `meet`.
    """
    notices = Notices(note)
    with meet(there, passenger, PATIENCE, notices.on_event) as (backend, client):
        note(f"riding along with {there.vehicle}")
        session_history = SessionHistory(client, passenger.session, there.header)
        talk(backend, client, session_history, typed, notices, lambda: None)


def ask_there(
    there: RemoteCar, passenger: Passenger, text: str, at: float | None, style: Style
) -> Reply:
    """Reply to one question; if there is no answer, refuse: the planner is not available.

    Args:
        there: the car.
        passenger: whose session it is.
        text: the question.
        at: [s] the time it is about; None: now.
        style: of the answer.

    Raises:
        BadLink: the link's configuration cannot be used.
    """
    try:
        with meet(there, passenger, BRIEFLY) as (_, client):
            return client.ask(one_line(text)[:MAX_TEXT], at, style)
    except (HubUnreachable, NotOnBus, ServiceLost) as error:
        return Reply(
            text=f"({error})",
            kind="refusal",
            reason="planner-unavailable",
            sim_time=at or 0.0,
        )
