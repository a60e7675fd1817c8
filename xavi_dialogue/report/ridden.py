"""The ride that a report is made of, and its record with plans made again."""

from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

from planner.counterfactuals.whatif import WhatIfError
from planner.record.trace import PlanTrace, VehiclePrediction
from sim.roads.network import Network
from sim.scene import Scene
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.motion import EPSILON
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride, Unanswered
from xavi_dialogue.service.in_process import NoPlan, Replan
from xavi_dialogue.storage.ride_file import RecordedRide

Found = TypeVar("Found")


@dataclass(frozen=True, eq=False)
class Ridden:
    """A ride as it was recorded, and what plans it again."""

    record: RecordedRide
    scenes: tuple[Scene, ...]  # in order of time
    again: Replan
    network: Network | None = None  # None: its roads are not known
    file: str | None = None  # SHA-256 of the file that it was read from
    gaps: tuple[tuple[float, float], ...] = ()  # [s] begin and end of what was lost

    @property
    def end(self) -> float:
        """The time [s] up to which it is recorded."""
        times = [trace.sim_time for trace in self.record.traces[-1:]]
        times += [scene.time for scene in self.scenes[-1:]]
        times += [event.sim_time for event in self.record.events[-1:]]
        return max(times)

    @property
    def begin(self) -> float:
        """The time [s] of its first decision or scene."""
        first = self.record.traces[0].sim_time
        return min(first, self.scenes[0].time) if self.scenes else first

    def decision_at(self, time: float) -> PlanTrace | None:
        """Return the last decision up to a time [s]."""
        k = bisect_right([t.sim_time for t in self.record.traces], time + EPSILON) - 1
        return self.record.traces[k] if k >= 0 else None

    def between(self, since: float, until: float) -> list[PlanTrace]:
        """Return the decisions of an interval [s]."""
        return [
            trace
            for trace in self.record.traces
            if since - EPSILON <= trace.sim_time <= until + EPSILON
        ]

    def as_known(self, now: float) -> Record:
        """Return the record up to a time [s], as answers rest on it."""
        seen = [scene for scene in self.scenes if scene.time <= now + EPSILON]
        return Record(
            now=now,
            traces=tuple(self.record.traces),
            events=tuple(self.record.events),
            ended=self.record.ended is not None and self.record.ended <= now + EPSILON,
            gaps=self.gaps,
            scene=seen[-1] if seen else None,
        )


class Inquiry:
    """The record of a ride up to the end of a report, to which plans made again are added."""

    def __init__(self, ridden: Ridden, until: float) -> None:
        """Begin with the record alone.

        Args:
            ridden: the ride.
            until: [s] up to which it is used.
        """
        self.ridden = ridden
        self.until = until
        self.reasons: dict[NeedRollout, str] = {}  # why a plan could not be made again
        self._record = ridden.as_known(until)
        self._ride = Ride(self._record)

    @cached_property
    def world(self) -> World:
        """The facts that the record shows."""
        return World(Ride(self.ridden.as_known(self.until)))

    @property
    def ride(self) -> Ride:
        """The record with all that was planned again so far."""
        return self._ride

    def find(self, work: Callable[[Ride], Found]) -> Found | None:
        """Return what some work on the record finds, planning again what it lacks.

        None: the record does not bear it.
        """
        while True:
            try:
                return work(self._ride)
            except Unanswered as unanswered:
                if not isinstance(unanswered.result, NeedRollout):
                    return None
                self.plan(unanswered.result)

    def plan(self, need: NeedRollout) -> PlanTrace | None:
        """Plan a decision again; None if that cannot be done, with the reason in `reasons`."""
        trace = next(t for t in self._record.traces if t.trace_id == need.trace_id)
        made: PlanTrace | None = None
        record = self._record
        if need in self.reasons:
            return None
        try:
            made = self.ridden.again(trace, need)
        except (WhatIfError, NoPlan) as error:
            self.reasons[need] = str(error)
        if made is None:
            self._record = replace(record, refused=(*record.refused, need))
        elif not any(one is made for one in record.extra):
            self._record = replace(record, extra=(*record.extra, made))
        self._ride = Ride(self._record)
        return made


def predicted(trace: PlanTrace, vehicle: int) -> tuple[int, VehiclePrediction] | None:
    """Return the prediction of a road user as it is recorded, with its index in the trace."""
    known = enumerate(trace.predictions)
    return next(((k, one) for k, one in known if one.vehicle == vehicle), None)
