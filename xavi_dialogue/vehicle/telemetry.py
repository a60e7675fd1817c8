"""Reports on the bus about the moments of a ride."""

import logging
from collections import deque
from collections.abc import Callable
from typing import Protocol

from planner.record.trace import PlanTrace
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Keys, Publisher
from xavi_dialogue.bus.messages import CarState, EventReport, SceneReport, TraceReport, pack
from xavi_dialogue.runtime import system
from xavi_dialogue.vehicle.episode import Moment, clock

KEPT_TRACES = 300  # for late joiners
KEPT_EVENTS = 1000
LATELY = 5.0  # [s] over which the speed of the simulation is measured

_LOG = logging.getLogger(__name__)


class ReportSink(Protocol):
    """The receiver of reports: a bus, or an outbox in front of it."""

    def publisher(self, key: str, keep: int = 0) -> Publisher: ...


class RateMeter:
    """A meter of the recent speed of the simulation."""

    def __init__(self, clock: Callable[[], float] = system.monotonic) -> None:
        self._clock = clock
        self._marks: deque[tuple[float, float]] = deque()  # [s] of the clock, of the simulation

    def note(self, sim_time: float) -> None:
        """Add a simulation time [s] that is reached now."""
        now = self._clock()
        self._marks.append((now, sim_time))
        while self._marks[0][0] < now - LATELY:
            self._marks.popleft()

    def read(self) -> float:
        """Return the simulated seconds per second; thread-safe."""
        now, marks = self._clock(), tuple(self._marks)
        recent = [mark for mark in marks if mark[0] >= now - LATELY]
        if not recent or recent[0][0] == now:
            return 0.0
        return round((recent[-1][1] - recent[0][1]) / (now - recent[0][0]), 3)


class Reporter:
    """A publisher of what the car sees, decides and does."""

    def __init__(
        self,
        bus: ReportSink,
        keys: Keys,
        scenario: str | None = None,
        seed: int | None = None,
        alive: HealthReporter | None = None,
    ) -> None:
        """Begin to report a ride.

        Args:
            bus: to report on.
            keys: of the car.
            scenario: name or folder, and
            seed: of the ride, so that it can be repeated.
            alive: counts what is reported.
        """
        self._scenario, self._seed = scenario, seed
        self._alive = HealthReporter("car") if alive is None else alive
        self._speedometer = RateMeter()
        self._alive.gauge("speed", self._speedometer.read)
        self._ride = system.token(4)
        self._scene = bus.publisher(keys.of("scene"))
        self._trace = bus.publisher(keys.of("trace"), keep=KEPT_TRACES)
        self._event = bus.publisher(keys.of("event"), keep=KEPT_EVENTS)
        self._scenes = self._traces = self._events = 0
        self._first: str | None = None  # id of the ride's first trace
        self._published = 0.0  # [s] on the monotonic clock

    def record(self, moment: Moment) -> None:
        """Publish the decision and the events of a step."""
        self._alive.at(clock(moment))
        self._speedometer.note(moment.scene.time)
        if moment.trace is not None:
            self._publish_trace(moment.trace)
        for event in moment.events:
            report = EventReport(
                ride=self._ride,
                seq=self._events,
                sim_time=event.sim_time,
                wall_time=system.wall(),
                event=event,
            )
            self._event.put(pack(report))
            self._events += 1
            self._alive.count("events")

    def idle_time(self) -> float:
        """Return the age [s] of the latest published scene."""
        return system.monotonic() - self._published

    def show(
        self,
        moment: Moment,
        state: CarState,
        speed_factor: float,
        orders: int = 0,
    ) -> None:
        """Publish the scene, with the numbers of the latest reports."""
        report = SceneReport(
            ride=self._ride,
            seq=self._scenes,
            sim_time=clock(moment),
            wall_time=system.wall(),
            vehicles=dict(moment.scene.vehicles),
            lights=moment.scene.lights,
            people=dict(moment.scene.people),
            unseen=moment.scene.unseen,
            state=state,
            speed_factor=speed_factor,
            plan=moment.plan,
            traces=self._traces,
            events=self._events,
            orders=orders,
            scenario=self._scenario,
            seed=self._seed,
        )
        self._scene.put(pack(report))
        self._scenes += 1
        self._alive.count("scenes")
        self._published = system.monotonic()

    def _publish_trace(self, trace: PlanTrace) -> None:
        self._first = self._first or trace.trace_id
        report = TraceReport(
            ride=self._ride,
            seq=self._traces,
            sim_time=trace.sim_time,
            wall_time=system.wall(),
            trace=trace,
            first=self._first,
        )
        payload = pack(report)
        if len(payload) > TraceReport.LIMIT:
            _LOG.warning("a decision is too large to be read", extra={"bytes": len(payload)})
        self._trace.put(payload)
        self._traces += 1
        self._alive.count("decisions")
