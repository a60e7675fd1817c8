"""`xavi bench`: how fast decisions and answers are, on this machine."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from statistics import quantiles

import msgspec

from planner.decide import Frame, Moment, predict, prepare, record, root_at
from planner.search import Root
from planner.trace import PlanTrace
from planner.trajectory import Roads
from sim.network import Network
from sim.scenario import load
from sim.scene import EGO
from xavi_dialogue.app.client import Client
from xavi_dialogue.app.control import Until
from xavi_dialogue.app.convoy import convoy, first_scene
from xavi_dialogue.app.local import Conversation, drive_to, make_mind, planner_for
from xavi_dialogue.app.ride import network_of, settings_of, start
from xavi_dialogue.transports.bus import Keys

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


class BenchError(ValueError):
    """There is no such benchmark."""


class Figure(msgspec.Struct, frozen=True):
    """One thing measured."""

    name: str
    unit: str
    n: int  # cases behind it
    p50: float
    p99: float
    most: float


class Figures(msgspec.Struct, frozen=True):
    """What a benchmark found."""

    bench: str
    figures: tuple[Figure, ...]

    def table(self) -> str:
        """The figures for people."""
        rows = [f"{'':28} {'unit':6} {'n':>5} {'p50':>9} {'p99':>9} {'most':>9}"]
        rows += [
            f"{f.name:28} {f.unit:6} {f.n:5} {f.p50:9.2f} {f.p99:9.2f} {f.most:9.2f}"
            for f in self.figures
        ]
        return "\n".join(rows)


class _Watch:
    """Collects durations [s] by name."""

    def __init__(self) -> None:
        self.taken: dict[str, list[float]] = {}

    @contextmanager
    def time(self, name: str) -> Iterator[None]:
        began = time.perf_counter()
        yield
        self.taken.setdefault(name, []).append(time.perf_counter() - began)

    def figures(self) -> tuple[Figure, ...]:
        return tuple(_figure(name, taken) for name, taken in self.taken.items())


def measure(name: str) -> Figures:
    """Run a benchmark.

    Raises:
        BenchError: there is none of this name.
    """
    bench = BENCHES.get(name)
    if bench is None:
        raise BenchError(f"there is no benchmark {name!r}; there are {', '.join(BENCHES)}")
    watch = _Watch()
    bench(watch)
    return Figures(name, watch.figures())


def _plan(watch: _Watch) -> None:
    """Every decision of a ride taken again, part by part."""
    for name in SCENARIOS:
        conversation, network = _ride(name)
        scenario = load(name)
        goal = conversation.dialogue.traces[0].goal
        frame = Frame(Roads(network), goal, settings_of(scenario), SEED, "car")
        for trace in conversation.dialogue.traces:
            if trace.under_way is None:
                _decide(watch, name, frame, trace)


def _decide(watch: _Watch, name: str, frame: Frame, trace: PlanTrace) -> None:
    here = root_at(frame.roads, trace.scene[EGO], trace.sim_time)
    if here is None:
        return
    moment = Moment(trace.decision, trace.sim_time, trace.scene, trace.history, Root(here))
    with watch.time(f"{name} decision"):
        with watch.time(f"{name} recognition"):
            beliefs = predict(frame, moment)
        with watch.time(f"{name} search"):
            search = prepare(frame, moment, beliefs)
            search.run()
        with watch.time(f"{name} record"):
            record(frame, moment, beliefs, search)


def _dialogue(watch: _Watch) -> None:
    """Answers within one process, from the record or with planning again, and over the bus."""
    for name in SCENARIOS:
        conversation, _ = _ride(name)
        at = conversation.dialogue.traces[-1].sim_time
        for question in QUESTIONS * ROUNDS:
            planned = len(conversation.dialogue.planned)
            began = time.perf_counter()
            conversation.ask(question, at)
            taken = time.perf_counter() - began
            again = len(conversation.dialogue.planned) > planned
            kind = "planned again" if again else "from the record"
            watch.taken.setdefault(f"{name} {kind}", []).append(taken)
    _over_the_bus(watch)


def _over_the_bus(watch: _Watch) -> None:
    """The same, from a passenger's process through the service's."""
    name = SCENARIOS[0]
    with convoy(name, SEED, 0.0) as behind:
        client = Client(behind.bus, Keys(), "bench")
        first_scene(behind, client)
        at = behind.drive(client, Until(None), halt=True).sim_time
        for question in QUESTIONS * ROUNDS:
            with watch.time(f"{name} over the bus"):
                client.ask(question, at)


def _ride(name: str) -> tuple[Conversation, Network]:
    scenario = load(name)
    network = network_of(scenario)
    conversation = Conversation(make_mind(), planner_for(network))
    with start(scenario, SEED, network) as ride:
        drive_to(ride, conversation, scenario.duration)
    return conversation, network


def _figure(name: str, taken: Sequence[float]) -> Figure:
    """Durations [s] in milliseconds."""
    cuts = quantiles(taken, n=100, method="inclusive") if len(taken) > 1 else list(taken) * 99
    low, high, most = (round(value * 1000.0, 3) for value in (cuts[49], cuts[98], max(taken)))
    return Figure(name, "ms", len(taken), low, high, most)


BENCHES: Mapping[str, Callable[[_Watch], None]] = {"plan": _plan, "dialogue": _dialogue}
