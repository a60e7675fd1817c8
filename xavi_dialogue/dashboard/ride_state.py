"""What a dashboard has heard of a car's ride, put in order, as browsers get it.

No bus and no clock: reports are given, messages for browsers are returned.
"""

from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass, field

from planner.record.events import Event
from planner.record.trace import PlanTrace
from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.dashboard.scene_history import Moments
from xavi_dialogue.dashboard.trace_cache import Shelf
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
from xavi_dialogue.service.reorder_buffer import Heard
from xavi_dialogue.service.ride_tracker import Rides

MAX_DECISIONS = 10_000  # that are told of in short
MAX_EVENTS = 10_000


@dataclass
class Record:
    """The present ride of one car."""

    rides: Rides = field(default_factory=Rides)
    shelf: Shelf = field(default_factory=Shelf)
    moments: Moments = field(default_factory=Moments)
    decisions: list[Decision] = field(default_factory=list)
    happened: list[Happened] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    last: PlanTrace | None = None  # the latest decision
    roads: str | None = None  # hash of the network, once it is known

    @property
    def scene(self) -> SceneReport | None:
        """The latest scene."""
        return None if self.rides.ledger is None else self.rides.ledger.scene

    @property
    def ride(self) -> Ride | None:
        """The ride; None before one was seen."""
        ledger = self.rides.ledger
        if ledger is None or ledger.scene is None:
            return None
        return Ride(
            ride=ledger.ride,
            scenario=ledger.scene.scenario,
            seed=ledger.scene.seed,
            roads=self.roads,
        )

    def hear(self, report: Heard) -> tuple[bool, list[Outgoing]]:
        """Take down a report; whether another ride begins, and what there is to tell.

        Nothing is told of a ride before a scene of it has come.
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
        """Give up what has been missing for too long; what there is to tell then.

        Args:
            now: [s] on the shell's clock.
        """
        ledger = self.rides.ledger
        return [] if ledger is None else self._take(ledger.wait(now))

    def all(self) -> list[Outgoing]:
        """All that a browser is told that has just come."""
        ride, latest = self.ride, self.scene
        if ride is None:
            return []
        told: list[Outgoing] = [ride, Decisions(decisions=tuple(self.decisions))]
        told.append(Events(events=tuple(self.happened)))
        return told if latest is None else [*told, scene(latest)]

    def up_to(self, time: float) -> PlanTrace | None:
        """The decision in force at a time [s]; None: there is none."""
        index = bisect_right(self.decisions, time + EPSILON, key=lambda one: one.t) - 1
        return None if index < 0 else self.shelf.get(self.decisions[index].id)

    def past(self) -> bytes:
        """All moments so far: `documents.Past` as JSON."""
        ledger = self.rides.ledger
        return self.moments.document("" if ledger is None else ledger.ride)

    def _take(self, inputs: Iterable[Input]) -> list[Outgoing]:
        decisions: list[Decision] = []
        events: list[Happened] = []
        for one in inputs:
            match one:
                case TraceRecorded(trace=trace):
                    decisions.append(self._decide(trace))
                case EventRecorded(event=event):
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
        self.shelf.put(trace)
        self.moments.learn(trace)
        decision = in_short(trace, self.last)
        self.last = trace
        return decision

    def _begin_anew(self) -> None:
        self.shelf, self.moments = Shelf(), Moments()
        self.decisions, self.happened, self.events = [], [], []
        self.last = self.roads = None


def happened(event: Event) -> Happened:
    """An event as browsers get it."""
    return Happened(
        t=event.sim_time,
        kind=event.kind,
        action=event.action,
        vehicle=event.vehicle,
        words=event_words(event),
    )
