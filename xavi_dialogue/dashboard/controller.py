"""The board of a dashboard: what browsers are told, and what becomes of what they ask.

Everything here runs on the event loop. What takes long, or waits for the bus, runs on threads.
"""

import asyncio
import logging
import time
from collections.abc import Callable, Coroutine
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial

from xavi_dialogue import __version__
from xavi_dialogue.bus.health import Alive
from xavi_dialogue.bus.interface import Bus, Keys
from xavi_dialogue.bus.messages import MAX_TURNS
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.chat.client import Client, ServiceLost
from xavi_dialogue.dashboard.bus_client import Asking, Unanswered
from xavi_dialogue.dashboard.conversation import GLANCE, Conversation
from xavi_dialogue.dashboard.document_cache import Archive
from xavi_dialogue.dashboard.ride_state import Record
from xavi_dialogue.dashboard.subscriber import Ear
from xavi_dialogue.dashboard.suggestions import suggestions
from xavi_dialogue.dashboard.web.client_session import Viewer
from xavi_dialogue.dashboard.web.interfaces import Audience
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
from xavi_dialogue.security.client_token import Passenger
from xavi_dialogue.service.reorder_buffer import Heard

_LOG = logging.getLogger(__name__)
LOOK = 1.0  # [s] between looks at whether others have asked, and at what is amiss
COUNTERS = ("scenes", "questions", "dropped", "rejected")
ALONE = "There is no dialogue service to ask yet."


@dataclass
class Board:
    """Shows one car, and one conversation about it; see dashboard.web.interfaces."""

    keys: Keys
    passenger: Passenger
    recording: bool = False  # a recorded ride is played
    alive: Alive = field(default_factory=lambda: Alive("dashboard", COUNTERS))
    record: Record = field(default_factory=Record)
    conversation: Conversation = field(default_factory=Conversation)
    first_seen: Callable[[], None] = lambda: None  # called when the first browser has come
    coming: Callable[[], bool] = lambda: False  # the car is started (again), and not yet there
    moment: Callable[[Client], float | None] = Client.now  # [s] that is meant where none is named
    _there: dict[str, Presence] = field(default_factory=dict)
    _suggested: Suggestions = field(default_factory=lambda: Suggestions(t=0.0, questions=()))
    _stale: bool = False  # something has happened since these were made
    _came: bool = False  # whether the car was coming when that was told last
    _held: bool = False  # what was heard while the car was coming has not been told
    _bus: Bus | None = None
    _asking: Asking | None = None
    _client: Client | None = None
    _tasks: set[asyncio.Task[None]] = field(default_factory=set)

    def attach(self, audience: Audience) -> None:
        """Know whom to tell; to be called first."""
        self.audience = audience
        self._ear = Ear(audience, self.alive, self._hear)
        self.archive = Archive(self.record, self.conversation, self._roads_known)
        self._refreshing = asyncio.Lock()

    def join(self, bus: Bus) -> None:
        """Begin to hear and to ask, now that there is a bus."""
        self._bus = bus
        self._asking = Asking(bus, self.keys, self.audience, self.passenger)
        token, share = self.passenger.token, self.passenger.share
        self._client = Client(bus, self.keys, self.passenger.session, token=token, share=share)
        self.archive.join(self._asking)
        self._ear.open(bus, self.keys, self._see)
        self.alive.gauge("browsers", lambda: self.audience.browsers)
        self.alive.serve(bus, self.keys)

    async def watch(self) -> None:
        """See again and again whether others have asked, and what is amiss; until cancelled."""
        while True:
            await asyncio.sleep(LOOK)
            try:
                await self._look()
            except Exception:
                _LOG.exception("a fault of ours", extra={"vehicle": self.keys.vehicle})

    async def _look(self) -> None:
        for message in self.record.wait(time.monotonic()):
            if not self._held:
                self.audience.tell(message)
        self._see("hub", self._bus is not None and self._bus.linked)
        if self.coming() != self._came:
            self._came = not self._came
            self._tell_status()
        self.archive.look()
        if self.audience.browsers:
            self._suggest_anew()
            await self.refresh()

    # What the server calls:

    def greet(self, viewer: Viewer) -> tuple[Outgoing, ...]:
        """All that a browser is told that has just come."""
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
        """Who is there; the server fills in what each browser is told besides."""
        return Status(
            hub=self._there.get("hub", "awaited"),
            car="coming" if self.coming() else self._there.get("car", "awaited"),
            service=self._there.get("service", "awaited"),
            dropped=0,
            browsers=self.audience.browsers,
        )

    def ask(self, viewer: Viewer, message: Ask) -> None:
        """Ask the service; the browser is told what comes of it."""
        self.alive.count("questions")
        client, request = self._client, message.request
        if client is None:
            nobody = Reply(text=ALONE, kind="refusal", reason="planner-unavailable", sim_time=0.0)
            viewer.tell(AnsweredHere(request=request, n=None, reply=nobody))
            return
        viewer.tell(Thinking(request=request))

        def done(came: Reply | ServiceLost) -> None:
            self.audience.soon(self._answered, viewer, message, came)

        at = self.moment(client) if message.at is None else message.at
        client.send(message.text, done, at=at, request=request)

    def cancel(self, viewer: Viewer, message: Cancel) -> None:
        """Tell the service that an answer is no longer wanted."""
        if self._client is not None:
            self._client.cancel(message.request)

    def suggest(self, viewer: Viewer, message: Suggest) -> None:
        """Tell a browser what could be asked at an earlier moment."""
        viewer.tell(self._suggestions(message.at))

    def left(self, viewer: Viewer) -> None:
        """A browser is gone."""
        self._tell_status()

    def roads(self, name: str) -> bytes | None:
        """See Archive."""
        return self.archive.roads(name)

    def past(self) -> bytes:
        """All moments so far."""
        return self.record.past()

    def decision(self, name: str) -> bytes | None:
        """See Archive."""
        return self.archive.decision(name)

    async def evidence(self, n: int) -> bytes | None:
        """See Archive."""
        return await self.archive.evidence(n)

    # Within:

    def _hear(self, report: Heard) -> None:
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
            self.audience.tell(message)
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
        self.audience.tell(self.status())

    def _roads_known(self) -> None:
        ride = self.record.ride
        if ride is not None and not self._held:
            self.audience.tell(ride)

    def _suggestions(self, at: float) -> Suggestions:
        try:
            said = self.conversation.suggestions
            found = suggestions(self.record.up_to(at), self.record.events, at, said)
        except Exception:  # a fault of ours must not keep anybody from asking
            _LOG.exception("nothing could be suggested", extra={"vehicle": self.keys.vehicle})
            found = ()
        return Suggestions(t=at, questions=found)

    def _suggest_anew(self) -> None:
        scene = self.record.scene
        if self._stale and scene is not None:
            self._stale = False
            fresh = self._suggestions(scene.sim_time)
            if fresh.questions != self._suggested.questions:
                self.audience.tell(fresh)
            self._suggested = fresh

    async def refresh(self) -> None:
        """Learn what was said, here and elsewhere, and tell what is new."""
        asking = self._asking
        if asking is None:
            return
        async with self._refreshing:
            with suppress(Unanswered):
                news = self.conversation.learn(await asking.history(GLANCE), whole=False)
                if news is None:
                    news = self.conversation.learn(await asking.history(MAX_TURNS), whole=True)
                if news is not None and (news.turns or news.reset):
                    self._stale = True
                    self.audience.tell(news)

    def _answered(self, viewer: Viewer, asked: Ask, came: Reply | ServiceLost) -> None:
        self._spawn(self._tell_answer(viewer, asked, came))

    async def _tell_answer(self, viewer: Viewer, asked: Ask, came: Reply | ServiceLost) -> None:
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
        _LOG.error("a fault of ours", exc_info=task.exception())
