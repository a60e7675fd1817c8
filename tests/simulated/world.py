"""One run of the simulated world: everybody starts, things go wrong, and all heals again."""

import gc
import hashlib
import logging
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import cache, partial
from typing import Any, TypeVar

import msgspec

from tests.simulated import invariants, parts
from tests.simulated.disk import SimulatedDisk
from tests.simulated.network import Bus, Network
from tests.simulated.parts import SECRET, STORE, Person
from tests.simulated.plan import HEALED, STORIES, Fault, Plan
from tests.simulated.reading import read_once
from tests.simulated.scheduler import OutOfHand, Process, Scheduler
from xavi_dialogue.dashboard.controller import Controller
from xavi_dialogue.runtime.system import behind_the_door
from xavi_dialogue.service.reorder_buffer import RideReports
from xavi_dialogue.service.ride_tracker import RideTracker
from xavi_dialogue.service.server import Service
from xavi_dialogue.storage.conversations import Store
from xavi_dialogue.storage.database import on_disk
from xavi_dialogue.storage.turn_log import PURGED_EVERY, TurnLog

LIMIT = 150.0  # [s] by which everybody must have got what was asked for
REST = 2.0  # [s] that everything has to come to rest in the end
RESTARTED = (0.1, 1.5)  # [s] until a dead process is started again
FLUSHED = 1.5  # [s] after which what was shown is on the disk, if the service had no other work
FAULTLESS = 20261128  # seed of the runs without faults, which tell what is right

T = TypeVar("T")
Turn = tuple[str, str]  # question, answer with all that it has


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a run."""

    problems: tuple[str, ...]
    digest: str  # of all that was said, shown and stored
    transcripts: dict[str, tuple[Turn, ...]]
    exempt: tuple[str, ...]  # sessions that lost something that may be lost
    figures: dict[str, float]


@dataclass
class Starter:
    """A program that is started again whenever it ends."""

    machine: str
    role: str
    run: Callable[["World", Bus], None]
    hosts: bool = False
    process: Process | None = None
    starts: int = 0
    ready: Callable[[], bool] = lambda: True  # whether there is anything left to do


class World:
    """All machines."""

    def __init__(self, plan: Plan) -> None:
        self.plan, self.story = plan, STORIES[plan.story]
        self.scheduler = Scheduler(plan.seed)
        self.network = Network(self.scheduler)
        self.disk = SimulatedDisk(self.scheduler)
        self.problems: list[str] = []
        self.warned: list[str] = []  # warnings of the service's store
        self.refused: list[str] = []  # what strangers got
        self.service: Service | None = None
        self.memory: TurnLog | None = None
        self.controller: Controller | None = None
        self.browsers: Any = None
        self.dashboards: list[Any] = []  # the browsers of all dashboards so far
        self.rides: Counter[tuple[int, str]] = Counter()  # that were begun by a service
        self.trackers: list[RideTracker] = []  # which are kept, so that each has a number
        self.gaps: list[tuple[float, float]] = []  # [s] from when until when reports were lost
        self.ride: Any = None
        self.driven = False
        self.slow: float | None = None  # [s] that planning again takes longer; 0: it dies
        self.failed_plans = 0
        self.exempt: dict[str, str] = {}  # sessions that may differ, and why
        self.erased: list[Person] = []
        self.people = self._people()
        self.starters = self._starters()
        self._log = hashlib.sha256()

    def _people(self) -> list[Person]:
        story = self.story
        tablet = tuple((None, text) for text in story.tablet)
        diary = ((5.0, f"Do you like {SECRET}?"), (5.0, "What are you doing?"), (None, "/forget"))
        return [
            Person("phone", "phone", "p" * 20, story.phone),
            Person("tablet", "tablet", "t" * 20, tablet),
            Person("desk", "desk", "d" * 20, story.desk),
            Person("diary", "diary-of-ada", "s" * 20, diary),
            Person("fresh", "fresh", "f" * 20, story.phone),
        ]

    def _starters(self) -> dict[str, Starter]:
        phone, tablet, desk, diary, fresh = self.people
        victims = [phone, tablet, desk]
        found = [
            Starter("hub", "service", parts.service, hosts=True),
            Starter("car", "car", parts.car),
            Starter("desk", "dashboard", partial(parts.dashboard, person=desk)),
            Starter("stranger", "passenger", partial(parts.stranger, victims=victims)),
        ]
        riders = [(one, parts.batch) for one in (phone, diary, fresh)]
        for person, run in (*riders, (tablet, parts.interactive)):
            starter = Starter(person.machine, "passenger", partial(run, person=person))
            starter.ready = lambda person=person: not person.done
            found.append(starter)
        return {one.machine: one for one in found}

    def note(self, *what: object) -> None:
        """Add to the digest of the run."""
        self._log.update(repr((round(self.scheduler.now, 6), *what)).encode())

    def begin(self, starter: Starter) -> None:
        """Start a program."""
        scheduler = self.scheduler
        starter.starts += 1
        name = f"{starter.machine} {starter.starts}"
        process = Process(name, starter.machine, scheduler.dice.uniform(10.0, 1e5))
        starter.process = process
        self.note("start", name)

        def main() -> None:
            bus = self.network.connect(process, starter.role, hosts=starter.hosts)
            try:
                starter.run(self, bus)
            finally:
                if process.alive:
                    bus.close()
            scheduler.after(0.0, lambda: self._ended(starter, process))

        process.ends.append(lambda: self._ended(starter, process))
        scheduler.spawn(process, "main", main)

    def _ended(self, starter: Starter, process: Process) -> None:
        if starter.process is not process:
            return
        self.note("end", process.name)
        process.alive = False
        starter.process = None
        if starter.hosts:
            self._lost_with_the_service()
            self.network.changed()
        self.scheduler.bury(process)
        delay = self.scheduler.dice.uniform(*RESTARTED)
        self.scheduler.after(delay, partial(self._again, starter))

    def _again(self, starter: Starter) -> None:
        if starter.process is None and starter.ready():
            self.begin(starter)

    def _lost_with_the_service(self) -> None:
        """Note whose turns were waiting for the disk, of which the operator was warned."""
        self.problems += invariants.faults_of(self)
        self._end_gap()
        memory, self.memory, self.service = self.memory, None, None
        for new in () if memory is None else memory._missed:
            session = getattr(new, "session", None)
            if session is None or not memory._failing:
                continue
            if not self.warned:
                self.problems.append(f"a turn of {session} was lost without a warning")
            self.exempt[session] = "turns waited for the disk when the service crashed"
        if memory is not None and memory._unforgotten:
            self.exempt["diary-of-ada"] = "erasing waited for the disk"

    def miss_reports(self) -> None:
        """Note that the service has given up reports."""
        self.gaps.append((self.scheduler.now, float("inf")))

    def _end_gap(self) -> None:
        """Note that a record begins anew."""
        self.gaps = [(since, min(until, self.scheduler.now)) for since, until in self.gaps]

    # What goes wrong.

    def strike(self, fault: Fault) -> None:
        """Let a fault happen."""
        self.note("fault", str(fault))
        network, weather, scheduler = self.network, self.network.weather, self.scheduler
        process = self.starters[fault.machine].process
        volume = self.disk.volume(STORE)
        heal: Callable[[], object] = lambda: None  # noqa: E731
        match fault.kind:
            case "crash":
                if process is not None:
                    process.crash_at = process.steps + int(fault.amount)
            case "power":
                self._cut_power(fault.machine)
            case "stored":
                volume.crashing = True
                heal = partial(setattr, volume, "crashing", False)
            case "stall":
                if process is not None:
                    process.stalled = scheduler.now + fault.lasts
                network._trouble(fault.machine)
            case "apart":
                network.cut(fault.machine, apart=True)
                heal = partial(network.cut, fault.machine, apart=False)
            case "loss" | "twice" | "delay" | "disorder":
                setattr(weather, fault.kind, fault.amount)
                heal = partial(setattr, weather, fault.kind, 0.0)
            case "full" | "failing":
                setattr(volume, fault.kind, True)
                heal = partial(setattr, volume, fault.kind, False)
            case "read" | "locked":
                volume.hold(writing=fault.kind == "locked")
                heal = volume.let_go
            case "clock":
                skew = scheduler.skew
                skew[fault.machine] = skew.get(fault.machine, 0.0) + fault.amount
            case "planner":
                self.slow = fault.amount
                heal = partial(setattr, self, "slow", None)
        scheduler.after(fault.lasts, lambda: heal())

    def _cut_power(self, machine: str) -> None:
        starter = self.starters[machine]
        if starter.process is not None:
            self.scheduler.kill(starter.process)
        if machine == "hub":
            volume = self.disk.volume(STORE)
            flushed = volume.flushed[-1] if volume.flushed else 0.0
            before = {one.session: self.stored(one.session) for one in self.people}
            self.disk.cut_power(STORE)
            for person in self.people:
                invariants.power_cut(self, person, before[person.session], flushed)

    def stored(self, session: str) -> list[Any]:
        """Return the turns of a session on the disk of the service."""
        return self._read(lambda store: [*store.turns(session, 1000)]) or []

    def owner(self, session: str) -> str | None:
        """Return the digest of the token that a stored session belongs to; None: open to all."""
        return self._read(lambda store: store.owner(session))

    def _read(self, read: Callable[[Store], T]) -> T | None:
        volume = self.disk.volume(STORE)
        if not volume.path.exists():
            return None
        copy = volume.folder / "look.sqlite3"
        copy.write_bytes(volume.path.read_bytes())
        copy.with_name("look.sqlite3-wal").write_bytes(volume.written())
        with on_disk(_PlainDisk()), behind_the_door(_SYSTEM), Store(copy) as store:
            found = read(store)
        copy.unlink()
        return found

    # What may not happen.

    def intruded(self, victim: Person, tail: str, got: bytes) -> None:
        """Check what a stranger got; called when a request of theirs was answered."""
        if tail == "cancel" and b'"cancelled":false' in got:
            return
        if victim.session in self.exempt:
            return  # nothing of it is stored, so that it may be begun anew
        said = [text for text, _, _ in victim.shown] + [reply for _, reply, _ in victim.shown]
        if tail != "history" or any(msgspec.json.encode(one) in got for one in said):
            self.problems.append(f"a stranger got {tail} of {victim.session}: {got[:300]!r}")

    def forgotten(self, person: Person) -> None:
        """Check that nothing is left of a session that was erased."""
        self.erased.append(person)
        self.problems += invariants.left_of(self, person)

    # The run.

    def run(self) -> Outcome:
        """Run the plan to its end."""
        with ExitStack() as stack:
            stack.callback(self.disk.close)
            stack.enter_context(behind_the_door(self.scheduler))
            stack.enter_context(on_disk(self.disk))
            stack.enter_context(self._listening())
            stack.enter_context(read_once())
            stack.enter_context(_uncollected())
            stack.enter_context(self._counting_rides())
            for starter in self.starters.values():
                if starter.machine == "fresh":
                    continue
                delay = self.scheduler.dice.random() * 0.3
                self.scheduler.after(delay, partial(self.begin, starter))
            for fault in self.plan.faults:
                self.scheduler.after(fault.at, partial(self.strike, fault))
            self._drive()
            for process in [one.process for one in self.starters.values() if one.process]:
                self.scheduler.kill(process)
        return self._outcome()

    @contextmanager
    def _listening(self) -> Iterator[None]:
        """Note internal errors that the programs log, and lost reports."""
        listener, logger = _Listener(self), logging.getLogger("xavi_dialogue")
        before = logger.propagate, logger.level
        logger.propagate = False
        logger.setLevel(logging.WARNING)
        logger.addHandler(listener)
        try:
            yield
        finally:
            logger.removeHandler(listener)
            logger.propagate = before[0]
            logger.setLevel(before[1])

    @contextmanager
    def _counting_rides(self) -> Iterator[None]:
        """Count how often a record of each ride is begun."""
        begin = RideTracker._begin

        def counted(tracker: RideTracker, reports: RideReports) -> None:
            self.rides[id(tracker), reports.ride] += 1
            self.trackers.append(tracker)
            if self.scheduler.process is not None and self.scheduler.process.machine == "hub":
                self._end_gap()
            begin(tracker, reports)

        RideTracker._begin = counted  # type: ignore[method-assign]
        try:
            yield
        finally:
            RideTracker._begin = begin  # type: ignore[method-assign]

    def _drive(self) -> None:
        scheduler = self.scheduler
        begin = HEALED if self.plan.faults else 1.0
        healed = lambda: scheduler.now >= begin and all(one.done for one in self.people[:-1])  # noqa: E731
        fresh = lambda: self.people[-1].done and self.service is not None  # noqa: E731
        try:
            in_time = scheduler.run(healed, LIMIT)
            self.begin(self.starters["fresh"])
            if not scheduler.run(fresh, LIMIT) or not in_time:
                waits = [one.session for one in self.people if not one.done]
                self.problems.append(f"after {LIMIT:g} s {', '.join(waits)} have no answer yet")
            scheduler.run(lambda: False, scheduler.now + REST)
            scheduler.run(self._is_quiet, scheduler.now + REST)  # strangers go on, and the car
            scheduler.run(self._is_purged, scheduler.now + PURGED_EVERY + REST)
        except OutOfHand as error:
            self.problems.append(str(error))
        self.problems += scheduler.failures
        self.problems += invariants.at_rest(self)

    def _is_quiet(self) -> bool:
        """Check whether nothing that came to the service waits, be it for the disk."""
        service, memory = self.service, self.memory
        if service is None or memory is None:
            return True
        waiting = service.handler.waiting() or memory._unsynced
        return service._inbox.empty() and not waiting

    def _is_purged(self) -> bool:
        """Check whether nothing that was erased is left in the files; it is tried now and then."""
        return self.memory is None or not self.memory._unpurged

    def _outcome(self) -> Outcome:
        figures = {
            "seconds": self.scheduler.now,
            "events": float(self.scheduler.events),
            "requests": float(len(self.network.asked)),
            "starts": float(sum(one.starts for one in self.starters.values())),
        }
        for person in self.people:
            self.note(person.session, person.shown, self.transcripts.get(person.session))
        return Outcome(
            tuple(dict.fromkeys(self.problems)),
            self._log.hexdigest()[:16],
            self.transcripts,
            tuple(self.exempt),
            figures,
        )

    transcripts: dict[str, tuple[Turn, ...]]


from xavi_dialogue.runtime.system import System as _RealSystem  # noqa: E402
from xavi_dialogue.storage.database import Disk as _PlainDisk  # noqa: E402

_SYSTEM = _RealSystem()


class _Listener(logging.Handler):
    """Hears of internal errors of a world's programs, and of lost reports."""

    def __init__(self, world: World) -> None:
        super().__init__(logging.WARNING)
        self._world = world

    def emit(self, record: logging.LogRecord) -> None:
        alive = self._world.scheduler.process is not None and self._world.scheduler.process.alive
        if record.msg == "reports were lost":
            self._world.miss_reports()
        if record.exc_info and alive:
            told = logging.Formatter().formatException(record.exc_info)
            self._world.problems.append(f"internal error, {record.name}:\n{told[-1500:]}")


@contextmanager
def _uncollected() -> Iterator[None]:
    """Leave garbage where it is within: no run depends on when it is collected."""
    collecting = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collecting:
            gc.enable()


def run(plan: Plan) -> Outcome:
    """Run a plan."""
    return World(plan).run()


@cache
def right(story: int) -> dict[str, tuple[Turn, ...]]:
    """Return the transcripts of a story in which nothing goes wrong."""
    outcome = run(Plan(FAULTLESS, story, ()))
    if outcome.problems:
        raise AssertionError("\n".join(outcome.problems))
    return outcome.transcripts
