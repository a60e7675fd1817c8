"""Trajectories of our own car behind an answer: the plan, and what would have been driven."""

from collections.abc import Iterable
from dataclasses import dataclass, field

from planner.record.trace import OUTCOMES, Outcome, PlanTrace
from sim.scene import Point
from xavi_dialogue.causal.mixtures import Mixture
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.dashboard.typed_answer import told_of
from xavi_dialogue.dashboard.views.contrast import sides
from xavi_dialogue.dashboard.views.decision import chosen_plan
from xavi_dialogue.dashboard.views.trajectories import likeliest
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.library.arguments import real


@dataclass(frozen=True, slots=True)
class Trajectory:
    """A trajectory that was simulated while a decision was made: its likeliest one."""

    start: float  # [s] time of the first point
    period: float  # [s] between points
    points: tuple[Point, ...] = field(repr=False)  # [m] of the front bumper
    speeds: tuple[float, ...] = field(repr=False)  # [m/s] at each point
    outcome: Outcome  # how it ends
    probability: float  # of this trajectory among those of the plan

    @property
    def end(self) -> float:
        """The time [s] of its last point."""
        return self.start + self.period * (len(self.points) - 1)

    def at(self, time: float) -> Point | None:
        """Return where [m] it is at a time [s]; None before and after it.

        Raises:
            XaviError: it is no time.
        """
        place = (real(time, "time", "a time [s]") - self.start) / self.period
        if not 0.0 <= place <= len(self.points) - 1:
            return None
        index = int(place)
        here, there = self.points[index], self.points[min(index + 1, len(self.points) - 1)]
        share = place - index
        return (
            here[0] + share * (there[0] - here[0]),
            here[1] + share * (there[1] - here[1]),
        )


@dataclass(frozen=True, slots=True)
class Compared:
    """The two sides of an answer."""

    planned: Trajectory | None = None  # that the car set out on
    ghost: Trajectory | None = None  # that it would have driven otherwise


def compared(reply: Reply, traces: Iterable[PlanTrace]) -> Compared:
    """Return the trajectories that an answer compares, where the record holds them.

    Args:
        reply: the answer.
        traces: the decisions of the ride, and those that were planned again.
    """
    told = told_of(reply)
    if told is None or not told.said.evidence.traces:
        return Compared()
    named = {trace.trace_id: trace for trace in traces}
    known = [named[name] for name in told.said.evidence.traces if name in named]
    here, there = sides(told, known)
    return Compared(*(None if x is None else _likeliest(x.trace, x.plan) for x in (here, there)))


def planned(trace: PlanTrace) -> Trajectory | None:
    """Return the trajectory that a decision set out on; None if there is none in the record."""
    plan = chosen_plan(CausalModel(trace))
    return None if plan is None else _likeliest(trace, plan)


def _likeliest(trace: PlanTrace, plan: Mixture) -> Trajectory | None:
    for drive in likeliest(trace, plan):
        points = tuple(zip(drive.path[0::2], drive.path[1::2], strict=True))
        outcome = next(one for one in OUTCOMES if one == drive.outcome)
        return Trajectory(drive.t, drive.dt, points, drive.speed, outcome, drive.probability)
    return None
