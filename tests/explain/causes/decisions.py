"""Decisions made by hand whose drives have lines, and rides of them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from dataclasses import replace as dataclass_replace
from typing import Any

from msgspec.structs import replace

from planner.record.events import Event
from planner.record.places import RoadFacts
from planner.record.trace import HeldUp, HoldUp, PlannedAction, PlanTrace, Rollout
from tests.explain.facts.scenes import Actor, made
from tests.traces import Actions, Aim, Chosen, End, Way, World, trace_of
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride

GOES_ON = {1: (Aim("continue", 1.0, (Way(("continue",)),)),)}
Ends = Callable[[Actions, Chosen], End]
Line = tuple[tuple[tuple[float, float], ...], tuple[float, ...]]  # path and speeds, at 5 Hz


def decided(
    ends: Ends | Mapping[str, End],
    aims: Mapping[int, tuple[Aim, ...]] | None = None,
    plans: Sequence[Actions] = (("continue",), ("change-left", "continue"), ("stop", "continue")),
    *,
    plan: Actions = (),
    lines: Mapping[str, Line] | None = None,
    time: float = 4.0,
    **fields: Any,
) -> PlanTrace:
    """A decision of which each plan was tried once in every situation.

    `ends` and `lines` tell what comes of a plan by its first action, and how it is driven.
    """
    how = ends if callable(ends) else lambda done, _: ends[done[0]]
    world = World(
        GOES_ON if aims is None else aims,
        tuple(plans),
        lambda done, chosen: (how(done, chosen), len(done)),
        plan=plan,
    )
    trace = trace_of(world, time=time, decision=int(time))
    rows = tuple(_driven(row, lines or {}) for row in trace.rollouts)
    return replace(trace, rollouts=rows, **fields)


def _driven(row: Rollout, lines: Mapping[str, Line]) -> Rollout:
    path, speed = lines.get(row.actions[0].action, (row.path, row.speed))
    return replace(row, path=path, speed=speed)


def steady(*speeds: float) -> Line:
    """East from the origin at such speeds, each for a fifth of a second."""
    x, path = 0.0, []
    for speed in speeds:
        path.append((x, 0.0))
        x = round(x + 0.2 * speed, 6)
    return tuple(path), speeds


def ride(*traces: PlanTrace, now: float | None = None, **fields: Any) -> Ride:
    """A ride of some decisions; it is the time of the last one unless said."""
    return Ride(Record(traces[-1].sim_time if now is None else now, traces, **fields))


@dataclass(frozen=True)
class Driven:
    """A ride with a decision each second, of which none can be planned again."""

    actors: Mapping[int, Actor]
    until: float
    held: Callable[[float], Sequence[HeldUp]] = lambda _: ()  # who is in the way, by decision [s]
    plan: Callable[[float], Actions] = lambda _: ("continue",)
    roads: Callable[[float], RoadFacts | None] = lambda _: None
    events: Sequence[Event] = ()

    def ride(self) -> Ride:
        """The ride."""
        plain = made(self.actors, self.until, events=self.events, roads=self.roads)
        traces = tuple(self._told(trace) for trace in plain.record.traces)
        others = [v for v in self.actors if v != 0]
        refused = tuple(NeedRollout(trace_id=t.trace_id, removed=v) for t in traces for v in others)
        pairs = tuple(
            NeedRollout(trace_id=t.trace_id, removed=tuple(sorted(others)))
            for t in traces
            if len(others) > 1
        )
        return Ride(dataclass_replace(plain.record, traces=traces, refused=(*refused, *pairs)))

    def _told(self, trace: PlanTrace) -> PlanTrace:
        by = tuple(self.held(trace.sim_time))
        rows = tuple(replace(r, held_up=by) for r in trace.rollouts)
        steps = tuple(PlannedAction(a, 0.0, 1) for a in self.plan(trace.sim_time))
        return replace(trace, rollouts=rows, plan=steps)


def in_the_way(by: int, since: float, until: float, how: HoldUp = "leader") -> HeldUp:
    """A stretch in which somebody holds us up."""
    return HeldUp(by, since, until, how, 5.0, 2.0)
