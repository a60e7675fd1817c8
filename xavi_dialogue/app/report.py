"""Moments of a ride as reports on the bus."""

import secrets
import time

from planner.trace import PlanTrace
from xavi_dialogue.app.ride import Moment, clock
from xavi_dialogue.transports.bus import Bus, Keys
from xavi_dialogue.transports.messages import (
    CarState,
    EventReport,
    SceneReport,
    TraceReport,
    pack,
)

KEPT_TRACES = 300  # for late joiners
KEPT_EVENTS = 1000


class Reporter:
    """Publishes what the car sees, decides and does."""

    def __init__(
        self, bus: Bus, keys: Keys, scenario: str | None = None, seed: int | None = None
    ) -> None:
        """Begin to report a ride.

        Args:
            bus: to report on.
            keys: of the car.
            scenario: name or folder, and
            seed: so that others can have the ride driven again.
        """
        self._scenario, self._seed = scenario, seed
        self._ride = secrets.token_hex(4)
        self._scene = bus.publisher(keys.of("scene"))
        self._trace = bus.publisher(keys.of("trace"), keep=KEPT_TRACES)
        self._event = bus.publisher(keys.of("event"), keep=KEPT_EVENTS)
        self._scenes = self._traces = self._events = 0
        self._published = 0.0  # [s] on the monotonic clock

    def record(self, moment: Moment) -> None:
        """Publish what was decided and what happened."""
        if moment.trace is not None:
            self._publish_trace(moment.trace)
        for event in moment.events:
            report = EventReport(
                ride=self._ride,
                seq=self._events,
                sim_time=event.sim_time,
                wall_time=time.time(),
                event=event,
            )
            self._event.put(pack(report))
            self._events += 1

    def idle_time(self) -> float:
        """How long ago [s] the scene was published."""
        return time.monotonic() - self._published

    def show(
        self,
        moment: Moment,
        state: CarState,
        speed_factor: float,
        orders: int = 0,
    ) -> None:
        """Publish the scene, and how far the record goes."""
        report = SceneReport(
            ride=self._ride,
            seq=self._scenes,
            sim_time=clock(moment),
            wall_time=time.time(),
            vehicles=dict(moment.scene.vehicles),
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
        self._published = time.monotonic()

    def _publish_trace(self, trace: PlanTrace) -> None:
        report = TraceReport(
            ride=self._ride,
            seq=self._traces,
            sim_time=trace.sim_time,
            wall_time=time.time(),
            trace=trace,
        )
        self._trace.put(pack(report))
        self._traces += 1
