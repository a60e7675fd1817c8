"""Cars of a fleet, as light as can be: they report a made-up ride, and halt.

    python -m tests.drills.cars HUBS NAMES

Each has a connection of its own, to the hubs in turn. They report as the product's cars do, and
plan nothing again. They stay until the end of the input.
"""

import sys
import threading
from contextlib import ExitStack

from tests.fakes import s1_moments
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Bus, Call, Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import Failure, pack
from xavi_dialogue.bus.zenoh_bus import join
from xavi_dialogue.vehicle.episode import Moment
from xavi_dialogue.vehicle.node import COUNTERS, serve
from xavi_dialogue.vehicle.telemetry import Reporter

HALT = 6.0  # [s] of the ride
EVERY = 0.5  # [s] between scenes of cars that stand
READY = "ready"


class StandIn:
    """A car that drives a ride at once, and stands."""

    def __init__(self, bus: Bus, vehicle: str) -> None:
        keys, alive = Keys(vehicle), HealthReporter("car", COUNTERS)
        self._reporter = Reporter(bus, keys, "s1", 0, alive)
        self._last: Moment | None = None
        serve(bus, keys, _plan_nothing, alive)

    def drive(self) -> None:
        """Report the ride."""
        for moment in s1_moments():
            if moment.scene.time > HALT:
                break
            self._reporter.record(moment)
            self._last = moment
        self.stand()

    def stand(self) -> None:
        """Report where it has halted."""
        assert self._last is not None
        self._reporter.show(self._last, "paused", 0.0)


def _plan_nothing(call: Call) -> None:
    call.refuse(pack(Failure(reason="planner-failed", detail="it plans nothing")))


def main() -> None:
    hubs, names = (text.split(",") for text in sys.argv[1:])
    over = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), over.set()), daemon=True).start()
    with ExitStack() as stack:
        cars = []
        for number, name in enumerate(names):
            bus = stack.enter_context(join(Link.to_hub(hubs[number % len(hubs)])))
            cars.append(StandIn(bus, name))
        for car in cars:
            car.drive()
        sys.stdout.write(f"{READY}\n")
        sys.stdout.flush()
        while not over.wait(EVERY):
            for car in cars:
                car.stand()


if __name__ == "__main__":
    main()
