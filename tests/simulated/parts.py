"""The processes of the simulated world: each runs the product's own code."""

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from planner.record import trace as plan_trace
from planner.record import trace_reading
from tests.simulated.loop import run
from tests.simulated.plan import moments_of, ride_of
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import EVERY_CAR, Bus, Keys, call
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import (
    AskRequest,
    CancelRequest,
    Failure,
    ForgetRequest,
    HistoryRequest,
    pack,
)
from xavi_dialogue.chat.batch import BatchChat
from xavi_dialogue.chat.client import GRACE, Client, ServiceLost
from xavi_dialogue.chat.controller import ChatController
from xavi_dialogue.chat.history import SessionHistory
from xavi_dialogue.chat.remote_backend import (
    NamesOnBus,
    NotOnBus,
    RemoteBackend,
    RemoteCar,
    _wait_for_car,
    _wait_for_service,
)
from xavi_dialogue.dashboard.controller import Controller
from xavi_dialogue.dashboard.web.client_session import ClientSession
from xavi_dialogue.dashboard.web.client_session import pack as pack_for_browser
from xavi_dialogue.dashboard.web.websocket_messages import AnsweredHere, Ask, Outgoing
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.runtime import system
from xavi_dialogue.security.client_token import Passenger
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.service.responder import PASSING
from xavi_dialogue.service.server import Service
from xavi_dialogue.storage.ride_file import key
from xavi_dialogue.storage.turn_log import Retention, TurnLog
from xavi_dialogue.terminal.slash_commands import CommandError
from xavi_dialogue.vehicle.node import COUNTERS, Pace, VehicleNode, serve
from xavi_dialogue.vehicle.outbox import Outbox
from xavi_dialogue.vehicle.replan_worker import ReplanOrder
from xavi_dialogue.vehicle.replanning import Replanner
from xavi_dialogue.vehicle.telemetry import Reporter
from xavi_dialogue.vehicle.worker_pool import Job

if TYPE_CHECKING:
    from tests.simulated.world import World

KEYS = Keys()
STORE = Path("/hub/dialogue.sqlite3")
DAYS = 30
THOUGHT = (0.1, 1.8)  # [s] between questions of a passenger
COMPUTED = (0.0005, 0.02)  # [s] that a stage of an answer takes
PLANNED = (0.02, 0.3)  # [s] that planning again takes
PATIENCE = 5.0  # [s] for a service and a car to talk with
HASTE = 0.15  # chance that a stranger asks about a time that never comes
NEVER = 500.0  # [s]
HURRY = 0.7  # [s] deadline of such a question
SECRET = "xylophones"  # a word that only the diary holds


class Known:
    """What was seen before in any run: equal parts of records are made the same object.

    So the pipeline remembers its results beyond one run; they depend on nothing but the record.
    """

    def __init__(self) -> None:
        self._parts: dict[object, Any] = {}
        self._pipelines: dict[str, Pipeline] = {}

    def pipeline(self, ride: str) -> Pipeline:
        """Return the pipeline for a ride."""
        if ride not in self._pipelines:
            plain = make_pipeline()
            self._pipelines[ride] = replace(
                plain,
                read=cache(plain.read),
                ground=lambda readings, record, said: plain.ground(
                    readings, self.same(record), said
                ),
                explain=lambda act, record: plain.explain(act, self.same(record)),
                see=lambda record: plain.see(self.same(record)),
            )
        return self._pipelines[ride]

    def same(self, record: Record) -> Record:
        """Return the record, made of parts that are known."""
        scene = record.scene
        return replace(
            record,
            traces=tuple(self._same(one.trace_id, one) for one in record.traces),
            extra=tuple(self._same(one.trace_id, one) for one in record.extra),
            events=tuple(self._same(one, one) for one in record.events),
            scene=None if scene is None else self._same(repr(scene), scene),
        )

    def _same(self, name: object, one: Any) -> Any:
        return self._parts.setdefault(name, one)


KNOWN = Known()


def timed(ride: str, dice: Any) -> Pipeline:
    """Return the pipeline, taking time."""
    known = KNOWN.pipeline(ride)

    def taking(stage: Callable[..., Any]) -> Callable[..., Any]:
        def run_stage(*arguments: Any) -> Any:
            system.sleep(dice.uniform(*COMPUTED))
            return stage(*arguments)

        return run_stage

    return replace(known, read=taking(known.read), explain=taking(known.explain))


def service(world: "World", bus: Bus) -> None:
    """Run the dialogue service."""
    memory = TurnLog(Retention(STORE, DAYS), world.warned.append)
    world.memory = memory
    world.service = Service(bus, timed(world.story.ride, world.scheduler.dice), memory)
    world.service.open()
    world.service.run(lambda: False)


@dataclass
class RecordedPlanners:
    """Planners that know what was planned again when the ride was recorded."""

    world: "World"

    def submit(self, job: Job) -> None:
        world = self.world
        scheduler, process = world.scheduler, world.scheduler.process
        order = msgspec.json.decode(job.order, type=ReplanOrder)
        trace = trace_reading.decode(bytes(order.trace))
        wanted = msgspec.convert(
            {**msgspec.to_builtins(order.what_if), "trace_id": trace.trace_id}, NeedRollout
        )
        ride = ride_of(world.story.ride)
        name = key(wanted)
        outcome: bytes | Failure = Failure(
            reason=ride.failures.get(name, "planner-failed"), detail="as it was recorded"
        )
        if name in ride.whatifs:
            outcome = plan_trace.encode(ride.whatifs[name])
        delay = scheduler.dice.uniform(*PLANNED)
        if world.slow is not None:
            delay += world.slow
            if world.slow == 0.0:
                outcome = Failure(reason="planner-failed", detail="the process has died")
        left = job.deadline - system.monotonic()
        if delay >= left:
            outcome, delay = Failure(reason="timed-out", detail="too slow"), left
        if isinstance(outcome, Failure) and world.slow is not None:
            world.failed_plans += 1
        scheduler.after(delay, lambda: job.done(outcome), process)


def car(world: "World", bus: Bus) -> None:
    """Drive the recorded ride, and halt; started again, it drives at once to where it was."""
    story, first = world.story, not world.driven
    world.driven = True
    alive = HealthReporter("car", COUNTERS)
    outbox = Outbox(bus, alive)
    scenario, _, seed = story.ride.partition("-")
    reporter = Reporter(outbox, KEYS, scenario, int(seed), alive)
    world.ride = reporter
    planning = Replanner(RecordedPlanners(world), alive=alive)
    serve(bus, KEYS, planning, alive)
    pace = Pace(2.0 if first else 0.0, running=True, until=story.halt, stops=True)
    VehicleNode(
        iter(moments_of(story.ride, story.halt)),
        0.5,
        (planning.record,),
        reporter,
        system.new_queue(),
        pace,
        stays=True,
    ).run()


@dataclass
class Person:
    """Somebody with questions, who repeats one until it is answered."""

    machine: str
    session: str
    token: str
    script: tuple[tuple[float | None, str], ...]
    next: int = 0  # question
    known: int = 0  # turns that the history had when it was last looked at, or that were shown
    asks: dict[int, int] = field(default_factory=dict)  # how often each was asked
    shown: list[tuple[str, str, float]] = field(default_factory=list)  # question, answer, when [s]
    unsure: bool = False  # whether one was asked again that may have been answered
    forgotten: float | None = None  # [s] when what was said was erased
    notes: list[str] = field(default_factory=list)

    @property
    def done(self) -> bool:
        return self.next >= len(self.script)

    def show(self, text: str, reply: str, now: float) -> None:
        """Take note of an answer."""
        self.shown.append((text, reply, now))
        self.next += 1

    def catch_up(self, client: Client, now: float) -> None:
        """See in the history whether the question was answered after all."""
        turns = [turn for turn in client.history() if turn.reply.reason not in PASSING]
        known, self.known = self.known, len(turns)
        self.unsure |= len(turns) < known  # some were lost
        for turn in turns[known:]:
            if self.done or turn.text != self.script[self.next][1]:
                self.unsure = True
                return
            self.show(turn.text, turn.reply.text, now)


def _meet(world: "World", bus: Bus, person: Person) -> tuple[RemoteBackend, Client]:
    cars, services = NamesOnBus(), NamesOnBus()
    bus.watch(EVERY_CAR.of("alive/car"), cars.see)
    bus.watch(EVERY_CAR.of("alive/service"), services.see)
    client = Client(bus, KEYS, person.session, lambda _: None, token=person.token)
    there = RemoteCar(Link(), "car")
    _wait_for_service(there, client, services, PATIENCE)
    _wait_for_car(there, client, cars, PATIENCE)
    return RemoteBackend(bus, "car", cars), client  # type: ignore[arg-type]


def think(world: "World") -> None:
    """Wait as a passenger does."""
    system.sleep(world.scheduler.dice.uniform(*THOUGHT))


def batch(world: "World", bus: Bus, person: Person) -> None:
    """Ask line by line; the process ends when all is answered, or when nobody is there."""
    try:
        backend, client = _meet(world, bus, person)
    except NotOnBus:
        return
    told: list[str] = []
    scene = client.scene
    assert scene is not None
    history = SessionHistory(client, person.session, ())
    chat = BatchChat(
        backend, client, history, told.append, person.notes.append, True, scene, None, live=True
    )
    try:
        person.catch_up(client, world.scheduler.now)
        while not person.done:
            think(world)
            at, text = person.script[person.next]
            if text == "/forget":
                chat.take(text)
                if person.notes[-1].startswith(("Erased", "There was nothing")):
                    person.forgotten = world.scheduler.now
                    world.forgotten(person)
                    person.next += 1
                continue
            chat.take(f"@ {at}s")
            person.asks[person.next] = person.asks.get(person.next, 0) + 1
            chat.take(text)
            reply = msgspec.json.decode(told[-1])
            if reply["reason"] not in PASSING:
                person.known += 1
                person.show(text, reply["text"], world.scheduler.now)
            else:
                think(world)
                person.catch_up(client, world.scheduler.now)
    except (ServiceLost, CommandError):
        think(world)


def interactive(world: "World", bus: Bus, person: Person) -> None:
    """Talk at a terminal, about the time at which the car has halted."""

    async def talk() -> None:
        backend, client = await asyncio.to_thread(_meet, world, bus, person)
        controller = ChatController(backend, client, SessionHistory(client, person.session, ()))
        await asyncio.to_thread(person.catch_up, client, world.scheduler.now)
        while not person.done:
            await asyncio.sleep(world.scheduler.dice.uniform(*THOUGHT))
            controller.status()
            controller.vehicles()
            if client.scene is None or client.scene.state != "paused":
                continue
            if client.now() != world.story.halt:
                continue
            _, text = person.script[person.next]
            person.asks[person.next] = person.asks.get(person.next, 0) + 1
            before = person.next
            await controller.ask(text, controller.new_request())
            await asyncio.to_thread(person.catch_up, client, world.scheduler.now)
            if person.next > before + 1:
                person.unsure = True

    try:
        run(world.scheduler, talk())
    except (ServiceLost, NotOnBus):
        system.sleep(0.5)


@dataclass
class Browsers:
    """The browsers of a dashboard; see dashboard.web.interfaces."""

    loop: asyncio.AbstractEventLoop
    problems: list[str]
    sessions: list[ClientSession] = field(default_factory=list)
    answers: dict[str, list[AnsweredHere]] = field(default_factory=dict)
    begun_anew: int = 0  # times that the page was told to show the conversation from the start

    @property
    def browsers(self) -> int:
        return len(self.sessions)

    def tell(self, message: Outgoing) -> None:
        packed = pack_for_browser(message)
        for one in self.sessions:
            one.put(packed)

    def soon(self, function: Callable[..., None], *arguments: Any) -> None:
        self.loop.call_soon_threadsafe(function, *arguments)

    def draw(self, viewer: ClientSession) -> None:
        """Take what waits for a browser, as its page does."""
        while (text := viewer.take(system.monotonic())) is not None:
            told = msgspec.json.decode(text)
            if told["type"] == "scene":
                viewer.hear(_seen(told["seq"]), system.monotonic())
            self.begun_anew += told["type"] == "turns" and told["reset"]
            if told["type"] == "answered":
                found = msgspec.json.decode(text, type=AnsweredHere)
                self.answers.setdefault(found.request, []).append(found)


def _seen(seq: int) -> str:
    return msgspec.json.encode({"type": "seen", "seq": seq}).decode()


def dashboard(world: "World", bus: Bus, person: Person) -> None:
    """Show the ride and the conversation, and ask."""

    async def show() -> None:
        loop = asyncio.get_running_loop()
        process = world.scheduler.process
        assert process is not None

        def trouble(_: object, known: dict[str, Any]) -> None:
            if process.alive:
                world.problems.append(f"dashboard: {known}")

        loop.set_exception_handler(trouble)
        controller = Controller(KEYS, Passenger(person.session, person.token))
        browsers = Browsers(loop, world.problems)
        world.dashboards.append(browsers)
        world.controller, world.browsers = controller, browsers
        controller.attach(browsers)  # type: ignore[arg-type]
        controller.join(bus)
        watching = loop.create_task(controller.watch())
        viewer = ClientSession(1, system.monotonic(), lambda: browsers.browsers)
        browsers.sessions.append(viewer)
        viewer.greet(controller.greet(viewer))
        try:
            await _use(world, controller, browsers, viewer, person)
        finally:
            watching.cancel()

    run(world.scheduler, show())


async def _use(
    world: "World",
    controller: Controller,
    browsers: Browsers,
    viewer: ClientSession,
    person: Person,
) -> None:
    dice = world.scheduler.dice
    while True:
        await asyncio.sleep(dice.uniform(*THOUGHT))
        browsers.draw(viewer)
        controller.past()
        looks = dice.random() < 0.1
        for one in controller.record.decisions[-1:] if looks else ():
            controller.decision(one.id)
        if controller.conversation.turns and looks:
            await controller.evidence(len(controller.conversation.turns) - 1)
        if person.done or viewer.leave is not None:
            continue
        turns = [t for t in controller.conversation.turns if t.reply.reason not in PASSING]
        if len(turns) > person.known:
            turn = turns[person.known]
            person.known += 1
            if turn.text == person.script[person.next][1]:
                person.show(turn.text, turn.reply.text, world.scheduler.now)
                continue
            person.unsure = True
            continue
        at, text = person.script[person.next]
        request = system.token(4)
        person.asks[person.next] = person.asks.get(person.next, 0) + 1
        said = msgspec.json.encode({"type": "ask", "request": request, "text": text, "at": at})
        wanted = viewer.hear(said.decode(), system.monotonic())
        if isinstance(wanted, Ask):
            controller.ask(viewer, wanted)
            await _answered(world, browsers, viewer, request)


async def _answered(
    world: "World", browsers: Browsers, viewer: ClientSession, request: str
) -> None:
    for _ in range(400):
        await asyncio.sleep(0.05)
        browsers.draw(viewer)
        if request in browsers.answers:
            return
    world.problems.append(f"the browser's question {request} got no answer within 20 s")


def hurry(world: "World", bus: Bus) -> None:
    """Ask about a time that never comes, and have no patience."""
    name = system.token(4)
    wanted = AskRequest(
        request=name,
        session="stranger",
        text="What are you doing?",
        at=NEVER,
        deadline_ms=1000.0 * HURRY,
    )
    try:
        got = call(bus, KEYS.of("@rpc/ask"), pack(wanted), HURRY + GRACE)
    except Exception as error:  # too much, late or gone
        world.refused.append(type(error).__name__)
        return
    if msgspec.json.decode(got)["reason"] not in PASSING:
        world.problems.append(f"an answer about {NEVER} s: {got[:300]!r}")


def stranger(world: "World", bus: Bus, victims: list[Person]) -> None:
    """Try to read, take over and erase what belongs to others; now and then be in a hurry."""
    dice = world.scheduler.dice
    while True:
        system.sleep(dice.uniform(0.3, 1.5))
        if dice.random() < HASTE and not all(one.done for one in world.people):
            hurry(world, bus)
        victim = dice.choice(victims)
        if not victim.shown or victim.forgotten is not None:
            continue
        token = dice.choice((None, "w" * 20))
        name = system.token(4)
        tail, wanted = dice.choice(
            (
                ("history", HistoryRequest(session=victim.session, token=token)),
                ("forget", ForgetRequest(request=name, session=victim.session, token=token)),
                ("cancel", CancelRequest(request=name, session=victim.session, token=token)),
                ("ask", AskRequest(request=name, session=victim.session, text="why?", token=token)),
            )
        )
        try:
            got = call(bus, KEYS.of(f"@rpc/{tail}"), pack(wanted), 3.0)
        except Exception as error:  # refused, late or gone: as it should be
            world.refused.append(type(error).__name__)
            continue
        world.intruded(victim, tail, got)
