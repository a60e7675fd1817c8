"""The state of a car's ride as a dashboard shows it, from reports in order.

No bus and no clock: reports are arguments, messages for browsers are returned.
"""

from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass, field

from planner.record.events import Event
from planner.record.trace import PlanTrace
from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.dashboard.scene_history import SceneHistory
from xavi_dialogue.dashboard.trace_cache import TraceCache
from xavi_dialogue.dashboard.views.decision import in_short
from xavi_dialogue.dashboard.views.labels import event_words
from xavi_dialogue.dashboard.views.map import scene
from xavi_dialogue.dashboard.web.websocket_messages import (
    Decision,
    Decisions,
    Events,
    Happened,
    Outgoing,
    Ride,
)
from xavi_dialogue.dialogue.state.events import EventRecorded, Input, TraceRecorded
from xavi_dialogue.dialogue.state.state import EPSILON
from xavi_dialogue.service.reorder_buffer import ReportOfRide
from xavi_dialogue.service.ride_tracker import RideTracker

MAX_DECISIONS = 10_000  # decisions that are sent in short form
MAX_EVENTS = 10_000


@dataclass
class RideState:
    """The present ride of one car."""

    rides: RideTracker = field(default_factory=RideTracker)
    trace_cache: TraceCache = field(default_factory=TraceCache)
    moments: SceneHistory = field(default_factory=SceneHistory)
    decisions: list[Decision] = field(default_factory=list)
    happened: list[Happened] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    last: PlanTrace | None = None  # the latest decision
    roads: str | None = None  # hash of the network, once it is known

    @property
    def scene(self) -> SceneReport | None:
        """The latest scene."""
        return None if self.rides.reports is None else self.rides.reports.scene

    @property
    def ride(self) -> Ride | None:
        """The ride; None before one was seen."""
        reports = self.rides.reports
        if reports is None or reports.scene is None:
            return None
        return Ride(
            ride=reports.ride,
            scenario=reports.scene.scenario,
            seed=reports.scene.seed,
            roads=self.roads,
        )

    def hear(self, report: ReportOfRide) -> tuple[bool, list[Outgoing]]:
        """Record a report; return whether another ride begins, and the messages to send.

        Nothing is sent about a ride before its first scene.
        """
        known = self.ride
        begun, inputs = self.rides.hear(report)
        if begun:
            self._begin_anew()
        told = self._take(inputs)
        if isinstance(report, SceneReport) and self.scene is report:
            self.moments.see(report.scene())
            told.append(scene(report))
        if self.ride is None:
            return begun, []
        return begun, self.all() if begun or known is None else told

    def wait(self, now: float) -> list[Outgoing]:
        """Give up reports that have been missing too long; return the messages to send.

        Args:
            now: [s] on the shell's clock.
        """
        reports = self.rides.reports
        return [] if reports is None else self._take(reports.wait(now))

    def all(self) -> list[Outgoing]:
        """Return all messages for a browser that has just connected."""
        ride, latest = self.ride, self.scene
        if ride is None:
            return []
        told: list[Outgoing] = [ride, Decisions(decisions=tuple(self.decisions))]
        told.append(Events(events=tuple(self.happened)))
        return told if latest is None else [*told, scene(latest)]

    def up_to(self, time: float) -> PlanTrace | None:
        """Return the decision in force at a time [s]; None without one."""
        index = bisect_right(self.decisions, time + EPSILON, key=lambda one: one.t) - 1
        return None if index < 0 else self.trace_cache.get(self.decisions[index].id)

    def past(self) -> bytes:
        """Return all moments so far: `documents.Past` as JSON."""
        reports = self.rides.reports
        return self.moments.document("" if reports is None else reports.ride)

    def _take(self, inputs: Iterable[Input]) -> list[Outgoing]:
        decisions: list[Decision] = []
        events: list[Happened] = []
        for one in inputs:
            match one:
                case TraceRecorded(trace=trace):
                    decisions.append(self._decide(trace))
                case EventRecorded(event=event) if event.kind != "restrained":
                    self.events.append(event)
                    events.append(happened(event))
        self.decisions += decisions
        del self.decisions[:-MAX_DECISIONS]
        self.happened += events
        del self.events[:-MAX_EVENTS], self.happened[:-MAX_EVENTS]
        told: list[Outgoing] = []
        if decisions:
            told.append(Decisions(decisions=tuple(decisions)))
        if events:
            told.append(Events(events=tuple(events)))
        return told

    def _decide(self, trace: PlanTrace) -> Decision:
        self.trace_cache.put(trace)
        self.moments.learn(trace)
        decision = in_short(trace, self.last)
        self.last = trace
        return decision

    def _begin_anew(self) -> None:
        self.trace_cache, self.moments = TraceCache(), SceneHistory()
        self.decisions, self.happened, self.events = [], [], []
        self.last = self.roads = None


def happened(event: Event) -> Happened:
    """Convert an event for browsers."""
    return Happened(
        t=event.sim_time,
        kind=event.kind,
        action=event.action,
        vehicle=event.vehicle,
        words=event_words(event),
    )
