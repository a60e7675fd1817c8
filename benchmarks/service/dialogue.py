"""`xavi bench dialogue`: how long answers take, to one passenger and to a thousand at once."""

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.figures import (
    Aimed,
    Figure,
    Target,
    Watch,
    aimed,
    at_most,
    figures_table,
    in_columns,
    targets_table,
)
from benchmarks.language.questions import FOLDER, LEARN, read_folder
from benchmarks.service.passengers import Load, Question, ask_all
from sim.roads.network import Network
from sim.setup.scenario import load
from xavi_dialogue.bus.interface import Keys, call
from xavi_dialogue.bus.messages import AliveReport, unpack
from xavi_dialogue.chat.client import Client
from xavi_dialogue.chat.local_backend import LocalBackend, first_scene, start_local
from xavi_dialogue.process.child_commands import Until
from xavi_dialogue.service.in_process import Conversation, drive_to, make_pipeline, planner_for
from xavi_dialogue.storage.turn_log import Retention
from xavi_dialogue.vehicle.episode import network_of, start

SCENARIOS = ("s1", "s2")
SEED = 0
ROUNDS = 5  # of every question
QUESTIONS = (
    "Why did you do that?",
    "What are you doing?",
    "What would have happened if you had kept going straight?",
    "Why did you not turn right?",
    "What if vehicle 1 weren't there?",
    "What is vehicle 1 doing?",
    "Where are we going?",
    "Why did you not fly?",
    "Are you sure?",
    "Hello!",
)
STORIES = ("s1", "s2", "s3", "s4")
SEEDS = range(4)  # of each story, for questions that may need planning again
DEEPER = (
    "Why did you do that?",
    "What if vehicle 1 weren't there?",
    "What will you do if vehicle 1 stops?",
    "What would you have done without vehicle 2?",
)
MOMENTS = tuple(round(2.0 + 0.1 * k, 1) for k in range(40))  # [s] times of questions
RATES = (20, 50, 100, 200)  # questions per second, of all passengers together
UNLIKE_RATES = (10, 20, 40)  # the same where no text was asked before
UNLIKE = " of new texts"
OVER_THE_BUS = "over the bus"
TAILS = {"from the record": 15.0, "planned again": 150.0}  # targets [ms] of p99, over the bus
LOADS = {"all at once": 2500.0, "200 a second": 50.0}  # targets [ms] of p99, many passengers


class Report(Aimed, frozen=True):
    """The results of the benchmark; times in ms."""

    bench: str
    figures: tuple[Figure, ...]  # one passenger, one question after the other
    loads: tuple[Load, ...]  # many passengers at once
    session_bytes: float  # of the service's memory, for each session with one turn
    service_bytes: float  # of the service's memory at the end

    def table(self) -> str:
        """Return the report for people."""
        rows = [
            ("", "asked", "a second", "answered", "busy", "timed out", "lost", "p50 ms", "p99 ms"),
            *(_row(load) for load in self.loads),
        ]
        memory = (
            f"memory: {self.session_bytes / 1000.0:.1f} kB a session,"
            f" {self.service_bytes / 1e6:.0f} MB the service"
        )
        parts = [figures_table(self.figures), in_columns(rows), memory]
        return "\n\n".join([*parts, targets_table(self.targets)])


def _row(load: Load) -> tuple[str, ...]:
    numbers = (load.answered, load.busy, load.timed_out, load.lost)
    spread = ("-" if one is None else f"{one:.1f}" for one in (load.p50_ms, load.p99_ms))
    rate = f"{load.answered_per_s:.1f}"
    return (load.name, str(load.asked), rate, *map(str, numbers), *spread)


def measure(sessions: int, seconds: float, note: Callable[[str], None]) -> Report:
    """Time answers within one process, over the bus, and to many passengers at once.

    Args:
        sessions: number of passengers.
        seconds: [s] for which they ask at each rate.
        note: is called with notes on progress.
    """
    watch = Watch()
    note("within one process")
    for name in SCENARIOS:
        _alone(watch, name)
    with TemporaryDirectory() as folder:
        keeping = Retention(Path(folder) / "dialogue.sqlite3", days=1)
        with start_local(SCENARIOS[0], SEED, 0.0, keeping) as backend:
            client = Client(backend.bus, Keys(), "bench")
            first_scene(backend, client)
            at = backend.drive(client, Until(None), halt=True).sim_time
            note("one passenger over the bus")
            for moment in (one for one in MOMENTS if one <= at):
                _over_the_bus(watch, backend, client, moment, QUESTIONS)
            loads, memory = _crowded(backend, sessions, seconds, at, note)
    for story in STORIES:
        note(f"one passenger over the bus in {story}, seeds {SEEDS[0]} to {SEEDS[-1]}")
        for seed in SEEDS:
            with start_local(story, seed, 0.0) as backend:
                client = Client(backend.bus, Keys(), "bench")
                first_scene(backend, client)
                at = backend.drive(client, Until(None), halt=True).sim_time
                _over_the_bus(watch, backend, client, at, DEEPER)
    figures = watch.figures()
    return aimed(Report("dialogue", figures, loads, *memory), *_targets(figures, loads))


def _targets(figures: Sequence[Figure], loads: Sequence[Load]) -> Iterator[Target]:
    """Yield the targets with the measured values."""
    taken = {one.name: one.p99 for one in figures}
    for kind, bound in TAILS.items():
        name = f"{OVER_THE_BUS} {kind}"
        yield at_most(f"{name}, p99", "ms", taken.get(name), bound)
    crowds = {one.name: one.p99_ms for one in loads}
    for name, bound in LOADS.items():
        yield at_most(f"{name}, p99", "ms", crowds.get(name), bound)


def ride(name: str) -> tuple[Conversation, Network]:
    """Return a scenario, driven to its end and recorded."""
    scenario = load(name, SEED)
    network = network_of(scenario)
    conversation = Conversation(make_pipeline(), planner_for(network))
    with start(scenario, network) as moments:
        drive_to(moments, conversation, scenario.duration)
    return conversation, network


def _alone(watch: Watch, name: str) -> None:
    conversation, _ = ride(name)
    at = conversation.dialogue.traces[-1].sim_time
    for question in QUESTIONS * ROUNDS:
        planned = len(conversation.dialogue.planned)
        began = time.perf_counter()
        conversation.ask(question, at)
        taken = time.perf_counter() - began
        again = len(conversation.dialogue.planned) > planned
        kind = "planned again" if again else "from the record"
        watch.taken.setdefault(f"{name} {kind}", []).append(taken)


def _over_the_bus(
    watch: Watch, backend: LocalBackend, client: Client, at: float, questions: Sequence[str]
) -> None:
    """Time answers from a passenger's process through the service, about a time [s]."""
    for question in questions:
        before = _counters(backend)["what_ifs"]
        began = time.perf_counter()
        client.ask(question, at)
        taken = time.perf_counter() - began
        again = _counters(backend)["what_ifs"] > before
        kind = "planned again" if again else "from the record"
        watch.taken.setdefault(f"{OVER_THE_BUS} {kind}", []).append(taken)


def _crowded(
    backend: LocalBackend, sessions: int, seconds: float, until: float, note: Callable[[str], None]
) -> tuple[tuple[Load, ...], tuple[float, float]]:
    """Measure many passengers, all at once and at given rates, and the memory that they take."""
    bus, keys, loads = backend.bus, Keys(), []
    moments = [moment for moment in MOMENTS if moment <= until]

    def asked(count: int, rate: float) -> Iterator[Question]:
        for k in range(count):
            due = k / rate if rate else 0.0
            text = QUESTIONS[(k + k // len(QUESTIONS)) % len(QUESTIONS)]
            yield Question(due, f"passenger-{k % sessions}", text, moments[7 * k % len(moments)])

    before = _counters(backend)["resident_bytes"]
    note(f"{sessions} passengers, all at once")
    loads.append(ask_all(bus, keys, "all at once", asked(sessions, 0.0)))
    grown = (_counters(backend)["resident_bytes"] - before) / sessions
    for rate in RATES:
        note(f"{sessions} passengers, {rate} questions a second")
        count = round(rate * seconds)
        loads.append(ask_all(bus, keys, f"{rate} a second", asked(count, rate)))
    texts = iter(dict.fromkeys(one.text for one in read_folder(FOLDER / LEARN)))
    for rate in UNLIKE_RATES:
        name = f"{rate} a second{UNLIKE}"
        note(f"{sessions} passengers, {name}")
        each = [
            replace(one, text=text)
            for one, text in zip(asked(round(rate * seconds), rate), texts, strict=False)
        ]
        loads.append(ask_all(bus, keys, name, each))
    return tuple(loads), (round(grown), _counters(backend)["resident_bytes"])


def _counters(backend: LocalBackend) -> dict[str, float]:
    """Return the counters of the service."""
    payload = call(backend.bus, Keys().of("alive/service"), b"", 10.0)
    return unpack(payload, AliveReport).counters
