"""The controller of a dashboard: sends updates to browsers and handles their requests.

Everything here runs on the event loop. Slow work and waiting for the bus run on threads.
"""

import asyncio
import logging
from collections.abc import Callable, Coroutine
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial

from xavi_dialogue import __version__
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Bus, Keys
from xavi_dialogue.bus.messages import MAX_TURNS
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.chat.client import Client, ServiceLost
from xavi_dialogue.dashboard.bus_client import BusClient, Unanswered
from xavi_dialogue.dashboard.conversation import GLANCE, Conversation
from xavi_dialogue.dashboard.document_cache import DocumentCache
from xavi_dialogue.dashboard.ride_state import RideState
from xavi_dialogue.dashboard.subscriber import Subscriber
from xavi_dialogue.dashboard.suggestions import suggestions
from xavi_dialogue.dashboard.web.client_session import ClientSession
from xavi_dialogue.dashboard.web.interfaces import Browsers
from xavi_dialogue.dashboard.web.websocket_messages import (
    AnsweredHere,
    Ask,
    Cancel,
    Outgoing,
    Presence,
    SceneShown,
    Status,
    Suggest,
    Suggestions,
    Thinking,
    Welcome,
)
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.runtime import system
from xavi_dialogue.security.client_token import Passenger
from xavi_dialogue.service.reorder_buffer import ReportOfRide

_LOG = logging.getLogger(__name__)
LOOK = 1.0  # [s] between checks for turns of others, and for problems
COUNTERS = ("scenes", "questions", "dropped", "rejected")
ALONE = "There is no dialogue service to ask yet."


@dataclass
class Controller:
    """The controller for one car and one conversation; see dashboard.web.interfaces."""

    keys: Keys
    passenger: Passenger
    recording: bool = False  # whether a recorded ride is played
    alive: HealthReporter = field(default_factory=lambda: HealthReporter("dashboard", COUNTERS))
    record: RideState = field(default_factory=RideState)
    conversation: Conversation = field(default_factory=Conversation)
    first_seen: Callable[[], None] = lambda: None  # called when the first browser connects
    coming: Callable[[], bool] = lambda: False  # whether the car is starting or restarting
    moment: Callable[[Client], float | None] = Client.now  # [s] default time of a question
    _there: dict[str, Presence] = field(default_factory=dict)
    _suggested: Suggestions = field(default_factory=lambda: Suggestions(t=0.0, questions=()))
    _stale: bool = False  # whether something has happened since these were made
    _came: bool = False  # whether the car was starting at the last status
    _held: bool = False  # whether reports from the car's start are not sent yet
    _bus: Bus | None = None
    _bus_client: BusClient | None = None
    _client: Client | None = None
    _tasks: set[asyncio.Task[None]] = field(default_factory=set)

    def attach(self, clients: Browsers) -> None:
        """Set the receivers of updates; call this first."""
        self.clients = clients
        self._subscriber = Subscriber(clients, self.alive, self._hear)
        self.archive = DocumentCache(self.record, self.conversation, self._roads_known)
        self._refreshing = asyncio.Lock()

    def join(self, bus: Bus) -> None:
        """Subscribe and begin to send requests, once there is a bus."""
        self._bus = bus
        self._bus_client = BusClient(bus, self.keys, self.clients, self.passenger)
        token, share = self.passenger.token, self.passenger.share
        self._client = Client(bus, self.keys, self.passenger.session, token=token, share=share)
        self.archive.join(self._bus_client)
        self._subscriber.open(bus, self.keys, self._see)
        self.alive.gauge("browsers", lambda: self.clients.browsers)
        self.alive.serve(bus, self.keys)

    async def watch(self) -> None:
        """Check repeatedly for turns of others and for problems, until cancelled."""
        while True:
            await asyncio.sleep(LOOK)
            try:
                await self._look()
            except Exception:
                _LOG.exception("internal error", extra={"vehicle": self.keys.vehicle})

    async def _look(self) -> None:
        for message in self.record.wait(system.monotonic()):
            if not self._held:
                self.clients.tell(message)
        self._see("hub", self._bus is not None and self._bus.linked)
        if self.coming() != self._came:
            self._came = not self._came
            self._tell_status()
        self.archive.look()
        if self.clients.browsers:
            self._suggest_anew()
            await self.refresh()

    # Methods that the server calls:

    def greet(self, viewer: ClientSession) -> tuple[Outgoing, ...]:
        """Return all messages for a browser that has just connected."""
        self.first_seen()
        welcome = Welcome(
            version=__version__,
            vehicle=self.keys.vehicle,
            session=self.passenger.session,
            recording=self.recording,
        )
        self._spawn(self.refresh())
        record = () if self._held else self.record.all()
        shown = (*record, self.conversation.all(), self._suggested)
        return welcome, self.status(), *shown

    def status(self) -> Status:
        """Return the status; the server adds what differs between browsers."""
        return Status(
            hub=self._there.get("hub", "awaited"),
            car="coming" if self.coming() else self._there.get("car", "awaited"),
            service=self._there.get("service", "awaited"),
            dropped=0,
            browsers=self.clients.browsers,
        )

    def ask(self, viewer: ClientSession, message: Ask) -> None:
        """Send a question to the service; the browser gets the result."""
        self.alive.count("questions")
        client, request = self._client, message.request
        if client is None:
            nobody = Reply(text=ALONE, kind="refusal", reason="planner-unavailable", sim_time=0.0)
            viewer.tell(AnsweredHere(request=request, n=None, reply=nobody))
            return
        viewer.tell(Thinking(request=request))

        def done(came: Reply | ServiceLost) -> None:
            self.clients.soon(self._answered, viewer, message, came)

        at = self.moment(client) if message.at is None else message.at
        client.send(message.text, done, at=at, request=request)

    def cancel(self, viewer: ClientSession, message: Cancel) -> None:
        """Tell the service that an answer is no longer wanted."""
        if self._client is not None:
            self._client.cancel(message.request)

    def suggest(self, viewer: ClientSession, message: Suggest) -> None:
        """Send a browser suggestions for an earlier time."""
        viewer.tell(self._suggestions(message.at))

    def left(self, viewer: ClientSession) -> None:
        """Handle that a browser has disconnected."""
        self._tell_status()

    def roads(self, name: str) -> bytes | None:
        """See DocumentCache."""
        return self.archive.roads(name)

    def past(self) -> bytes:
        """Return all moments so far."""
        return self.record.past()

    def decision(self, name: str) -> bytes | None:
        """See DocumentCache."""
        return self.archive.decision(name)

    async def evidence(self, n: int) -> bytes | None:
        """See DocumentCache."""
        return await self.archive.evidence(n)

    # Internal methods:

    def _hear(self, report: ReportOfRide) -> None:
        begun, told = self.record.hear(report)
        if begun:
            self.archive.begin_anew()
            self._suggested = Suggestions(t=0.0, questions=())
        self._held = self._held or self.coming()
        if self._held and not self.coming():
            self._held = False
            self._tell_status()
            told = self.record.all()
        for message in () if self._held else told:
            self.clients.tell(message)
            if isinstance(message, SceneShown):
                self.alive.count("scenes")
                self.alive.at(message.t)
            else:
                self._stale = True

    def _see(self, component: str, there: bool) -> None:
        before = self._there.get(component, "awaited")
        now: Presence = "there" if there else "awaited" if before == "awaited" else "gone"
        if now != before:
            self._there[component] = now
            self._tell_status()

    def _tell_status(self) -> None:
        self.clients.tell(self.status())

    def _roads_known(self) -> None:
        ride = self.record.ride
        if ride is not None and not self._held:
            self.clients.tell(ride)

    def _suggestions(self, at: float) -> Suggestions:
        try:
            said = self.conversation.suggestions
            found = suggestions(self.record.up_to(at), self.record.events, at, said)
        except Exception:  # an internal error must not block questions
            _LOG.exception("nothing could be suggested", extra={"vehicle": self.keys.vehicle})
            found = ()
        return Suggestions(t=at, questions=found)

    def _suggest_anew(self) -> None:
        scene = self.record.scene
        if self._stale and scene is not None:
            self._stale = False
            fresh = self._suggestions(scene.sim_time)
            if fresh.questions != self._suggested.questions:
                self.clients.tell(fresh)
            self._suggested = fresh

    async def refresh(self) -> None:
        """Fetch the turns of the session, and send the new ones."""
        asking = self._bus_client
        if asking is None:
            return
        async with self._refreshing:
            with suppress(Unanswered):
                news = self.conversation.learn(await asking.history(GLANCE), whole=False)
                if news is None:
                    news = self.conversation.learn(await asking.history(MAX_TURNS), whole=True)
                if news is not None and (news.turns or news.reset):
                    self._stale = True
                    self.clients.tell(news)

    def _answered(self, viewer: ClientSession, asked: Ask, came: Reply | ServiceLost) -> None:
        self._spawn(self._tell_answer(viewer, asked, came))

    async def _tell_answer(
        self, viewer: ClientSession, asked: Ask, came: Reply | ServiceLost
    ) -> None:
        if isinstance(came, ServiceLost):
            text = f"({came})"
            came = Reply(text=text, kind="refusal", reason="planner-unavailable", sim_time=0.0)
        await self.refresh()
        n = self.conversation.find(one_line(asked.text), came)
        reply = came if n is None else None
        viewer.tell(AnsweredHere(request=asked.request, n=n, reply=reply))

    def _spawn(self, work: Coroutine[None, None, None]) -> None:
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(partial(_done, self._tasks))


def _done(tasks: set[asyncio.Task[None]], task: asyncio.Task[None]) -> None:
    tasks.discard(task)
    if not task.cancelled() and task.exception() is not None:
        _LOG.error("internal error", exc_info=task.exception())
