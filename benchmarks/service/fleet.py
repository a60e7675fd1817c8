"""What a fleet costs: measured on one service in this process, computed for ten thousand cars.

    python -m benchmarks.service.fleet [--cars 10000] [--shards 20] [--asked 0.5]

Figures are of processor time, so that other programs on the machine change them little. Cars report
recorded rides over a bus in memory; what Zenoh itself takes is not in them.
"""

import argparse
import gc
import random
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from benchmarks.figures import in_columns, quantile
from sim.scene import Scene
from xavi_dialogue.bus.health import resident_bytes
from xavi_dialogue.bus.interface import Keys
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import AskRequest, pack
from xavi_dialogue.dialogue.manager import MAX_TRACES
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.service.server import Service
from xavi_dialogue.transcripts.replay import recording
from xavi_dialogue.vehicle.episode import Moment
from xavi_dialogue.vehicle.telemetry import Reporter

RIDE = Path(__file__).parents[2] / "transcripts" / "rides" / "s2-2.ride.jsonl.gz"
QUESTIONS = ("What are you doing?", "Where are we going?", "How fast are we going?", "Hello!")
SCENES = 200  # that are timed
ROUNDS = 60  # of all questions
SCENE_RATE = 10.0  # scenes a second of a car; see vehicle.node
TRACE_RATE = 1.0  # decisions a second
SPAN = 600.0  # [s] that are simulated


@dataclass(frozen=True)
class Costs:
    """What one service takes, each in seconds of a processor or in bytes."""

    scene: float
    trace: float
    question: tuple[float, ...]
    decision_bytes: float  # of memory, for each decision that is remembered
    base_bytes: float  # of memory, without cars


@dataclass(frozen=True)
class Fleet:
    """A fleet on paper."""

    cars: int
    shards: int
    asked: float  # questions a minute about each car

    @property
    def each(self) -> float:
        """Cars of a shard."""
        return self.cars / self.shards


def measure(cars: int) -> Costs:
    """Let cars report a ride to a service, and ask about it."""
    ride = recording(RIDE)
    hub = MemoryHub()
    service = Service(hub.connect(), make_pipeline())
    service.open()
    warm(service, hub)
    before = resident_bytes()
    taken_trace = taken_scene = 0.0
    for number in range(cars):
        keys, bus = Keys(f"car-{number}"), hub.connect()
        bus.appear(keys.of("alive/car"))
        reporter = Reporter(bus, keys, "s2", 2)
        service.work()
        for trace in ride.traces:
            scene = Scene(trace.sim_time, dict(trace.scene))
            moment = Moment(scene, (), trace, ())
            reporter.record(moment)
            taken_trace += worked(service)
        reporter.show(moment, "driving", 0.0)
        service.work()
        if number == 0:
            for _ in range(SCENES):
                reporter.show(moment, "driving", 0.0)
                taken_scene += worked(service)
    gc.collect()
    grown = resident_bytes() - before
    return Costs(
        taken_scene / SCENES,
        taken_trace / cars / len(ride.traces),
        tuple(_asked(service, hub, ride.traces[-1].sim_time)),
        grown / cars / len(ride.traces),
        before,
    )


def worked(service: Service) -> float:
    """Return how long [s] a service works on what has come."""
    began = time.process_time()
    service.work()
    return time.process_time() - began


def warm(service: Service, hub: MemoryHub) -> None:
    """Load the grammars."""
    asked = AskRequest(request="warm", session="warm", text="Hello!")
    hub.connect().request(Keys("nowhere").of("@rpc/ask"), pack(asked), 1.0, lambda _: None)
    service.work()


def _asked(service: Service, hub: MemoryHub, at: float) -> Iterator[float]:
    """Yield how long [s] answers take."""
    bus = hub.connect()
    for number in range(ROUNDS * len(QUESTIONS)):
        asked = AskRequest(
            request=f"q{number}",
            session=f"s{number}",
            text=QUESTIONS[number % len(QUESTIONS)],
            at=at,
        )
        bus.request(Keys("car-0").of("@rpc/ask"), pack(asked), 1.0, lambda _: None)
        taken = worked(service)
        if number >= len(QUESTIONS):  # the first ones load what all need
            yield taken


def busy(costs: Costs, fleet: Fleet) -> float:
    """Return the share of one processor that a shard's reports take."""
    return fleet.each * (SCENE_RATE * costs.scene + TRACE_RATE * costs.trace)


def memory(costs: Costs, fleet: Fleet) -> float:
    """Return the bytes of a shard whose cars have driven for longer than is remembered."""
    return costs.base_bytes + fleet.each * MAX_TRACES * costs.decision_bytes


def waits(costs: Costs, fleet: Fleet, seed: int = 0) -> list[float]:
    """Simulate the one thread of a shard; return the time [s] from each question to its answer.

    Reports come evenly, and take their share of each moment; questions come at random.
    """
    share = busy(costs, fleet)
    rate = fleet.each * fleet.asked / 60.0
    if share >= 1.0 or rate <= 0.0:
        return []
    dice = random.Random(seed)
    now = free = 0.0
    found = []
    while now < SPAN:
        now += dice.expovariate(rate)
        begins = max(now, free)
        free = begins + dice.choice(costs.question) / (1.0 - share)
        found.append(free - now)
    return found


def table(costs: Costs, fleets: list[Fleet]) -> str:
    """Return the fleets as a table for people."""
    rows = [("cars", "shards", "cars each", "asked/s", "reports", "questions", "GB each", "p99 ms")]
    for fleet in fleets:
        reports = busy(costs, fleet)
        rate = fleet.each * fleet.asked / 60.0
        asked = rate * sum(costs.question) / len(costs.question)
        took = waits(costs, fleet) if reports + asked < 1.0 else []
        tail = f"{1000.0 * quantile(took, 99):.0f}" if took else "too much"
        rows.append(
            (
                *(str(fleet.cars), str(fleet.shards), f"{fleet.each:.0f}"),
                f"{fleet.cars * fleet.asked / 60.0:.0f}",
                *(f"{100.0 * reports:.0f} %", f"{100.0 * asked:.0f} %"),
                *(f"{memory(costs, fleet) / 1e9:.1f}", tail),
            )
        )
    return in_columns(rows)


def main() -> None:
    """Measure, and print what follows."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cars", type=int, default=10_000, help="of the fleet")
    parser.add_argument("--shards", type=int, nargs="*", default=[10, 20, 40, 80])
    parser.add_argument("--asked", type=float, default=0.5, help="questions a minute about a car")
    parser.add_argument("--measured", type=int, default=40, help="cars that are measured with")
    asked = parser.parse_args()
    costs = measure(asked.measured)
    mean = sum(costs.question) / len(costs.question)
    lines = [
        f"a scene {1e6 * costs.scene:.0f} us, a decision {1e3 * costs.trace:.2f} ms,"
        f" a question {1e3 * mean:.2f} ms (p99 {1e3 * quantile(list(costs.question), 99):.1f})",
        f"memory: {costs.base_bytes / 1e6:.0f} MB, and {costs.decision_bytes / 1e3:.1f} kB for each"
        f" decision of the latest {MAX_TRACES}",
        table(costs, [Fleet(asked.cars, shards, asked.asked) for shards in asked.shards]),
    ]
    sys.stdout.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
