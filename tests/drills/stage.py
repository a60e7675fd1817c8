"""What most drills begin with: a service, a car, and somebody on the bus."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass

from tests.drills.bus_clients import Listener, Passenger, on_bus
from tests.drills.processes import Crew, Process, free_endpoint, until
from xavi_dialogue.bus.interface import Bus

HALT = 8.0  # [s] by then the car of s1 has changed lanes, and has more of its way before it
WHY = "Why did you change lanes?"  # has the planner plan again, without the vehicle to blame
WHERE = "Where are you going?"  # needs nothing but the record


@dataclass(frozen=True)
class Stage:
    """A service and a car that are up."""

    crew: Crew
    endpoint: str
    service: Process
    car: Process
    bus: Bus
    listener: Listener

    def passenger(self, session: str) -> Passenger:
        return Passenger(self.bus, session)

    def planners(self) -> list[int]:
        """The processes in which the car plans again."""
        return self.crew.pids("xavi_dialogue.vehicle.replan_worker")

    def ready(self) -> bool:
        """Whether the car has a planner that waits for work."""
        return until(lambda: self.listener.fares()["workers_idle"] >= 1.0)


@contextmanager
def staged(
    crew: Crew,
    *,
    at: float | None = HALT,
    serve: tuple[str, ...] = ("--keep-days", "0"),
    drive: tuple[str, ...] = ("--scenario", "s1"),
    extra: Mapping[str, str] | None = None,
) -> Iterator[Stage]:
    """A service and a car that has halted at a moment [s]; None: that has not set off.

    Their environment is the crew's, with what is extra.
    """
    endpoint = free_endpoint()
    service = crew.serve(endpoint, *serve, extra=extra)
    car = crew.drive(endpoint, *drive, "--control", extra=extra)
    with on_bus(endpoint) as bus:
        stage = Stage(crew, endpoint, service, car, bus, Listener(bus))
        assert until(lambda: bool(stage.listener.scenes) or car.popen.poll() is not None), car.said
        assert car.popen.poll() is None, car.said
        if at is not None:
            car.order(f"until {at}")
            assert stage.listener.halted(at), car.said
        yield stage
