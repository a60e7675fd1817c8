"""Memory of a service over many turns, in this process.

    python -m benchmarks.service.memory [--turns 100000] [--each 10]

A car has reported a recorded ride over a bus in memory. Passengers come, ask some questions each
from its record, and come no more; every turn goes to a file on disk.
"""

import argparse
import gc
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.figures import in_columns
from benchmarks.service.fleet import RIDE, warm
from sim.scene import Scene
from xavi_dialogue.bus.health import resident_bytes
from xavi_dialogue.bus.interface import Bus, Keys
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import AskRequest, pack
from xavi_dialogue.process.garbage import Sweeper
from xavi_dialogue.service.in_process import make_pipeline
from xavi_dialogue.service.server import Service
from xavi_dialogue.storage.turn_log import Retention, TurnLog
from xavi_dialogue.transcripts.replay import recording
from xavi_dialogue.vehicle.episode import Moment
from xavi_dialogue.vehicle.telemetry import Reporter

QUESTIONS = (
    *("What are you doing?", "Why did you do that?", "Where are we going?", "Are you sure?"),
    *("What is vehicle 1 doing?", "How fast are we going?", "Hello!"),
)
MOMENTS = 8  # of the ride that is asked about
ROWS = 20  # of the table
MEGABYTE = 1e6


@dataclass(frozen=True)
class Sample:
    """The memory after some turns."""

    turns: int
    sessions: int  # in memory
    megabytes: float  # resident
    tracked: int  # objects that a garbage collection would visit


def measure(turns: int, each: int) -> Iterator[Sample]:
    """Let a service answer; yield its memory from time to time.

    Args:
        turns: how many.
        each: turns of a passenger.
    """
    with TemporaryDirectory() as folder:
        hub, log = MemoryHub(), TurnLog(Retention(Path(folder) / "dialogue.sqlite3", days=1))
        service = Service(hub.connect(), make_pipeline(), log)
        service.rest = Sweeper().sweep
        service.open()
        warm(service, hub)
        keys, bus = Keys(), hub.connect()
        times = _drive(service, bus, keys)
        yield _sample(service, 0)
        for number in range(turns):
            passenger, asked = divmod(number, each)
            wanted = AskRequest(
                request=f"q{number}",
                session=f"passenger-{passenger}",
                text=QUESTIONS[(passenger + asked) % len(QUESTIONS)],
                at=times[passenger % len(times)],
            )
            bus.request(keys.of("@rpc/ask"), pack(wanted), 5.0, lambda _: None)
            service.work()
            if (number + 1) % max(turns // ROWS, 1) == 0:
                yield _sample(service, number + 1)
        log.close()


def _drive(service: Service, bus: Bus, keys: Keys) -> list[float]:
    """Report a ride; return some of the times [s] of its decisions."""
    ride = recording(RIDE)
    bus.appear(keys.of("alive/car"))
    reporter = Reporter(bus, keys, "s2", 2)
    service.work()
    before = float("-inf")
    for trace in ride.traces:
        scene, now = Scene(trace.sim_time, dict(trace.scene)), trace.sim_time
        events = tuple(one for one in ride.events if before < one.sim_time <= now)
        reporter.record(Moment(scene, (), trace, events))
        service.work()
        before = now
    reporter.show(Moment(scene, (), None, ()), "driving", 0.0)
    service.work()
    return [trace.sim_time for trace in ride.traces[-MOMENTS:]]


def _sample(service: Service, turns: int) -> Sample:
    sessions = sum(len(one.past) for one in service.handler.all_vehicles())
    tracked = gc.get_freeze_count() + len(gc.get_objects())
    return Sample(turns, sessions, round(resident_bytes() / MEGABYTE, 1), tracked)


def main() -> int:
    """Run the command."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.service.memory")
    parser.add_argument("--turns", type=int, default=100_000)
    parser.add_argument("--each", type=int, default=10, help="turns of a passenger")
    asked = parser.parse_args()
    rows = [("turns", "sessions in memory", "MB", "objects")]
    for one in measure(asked.turns, asked.each):
        rows.append((str(one.turns), str(one.sessions), f"{one.megabytes:.1f}", str(one.tracked)))
        sys.stderr.write(f"{' '.join(rows[-1])}\n")
    sys.stdout.write(f"{in_columns(rows)}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
