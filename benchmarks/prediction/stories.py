"""The two stories in which the ego's choice depends on where vehicle 1 goes."""

from collections.abc import Sequence
from dataclasses import dataclass

import msgspec

from benchmarks.prediction.ride_scenes import Recording
from planner.prediction.recognise import Belief
from planner.record.events import Event
from planner.record.trace import Action

SURE = 0.8  # probability that counts as knowing


@dataclass(frozen=True, slots=True)
class Plot:
    """The goal of a vehicle that is to be known, and what the ego does when it knows it."""

    vehicle: int
    kind: Action
    ego: Action


PLOTS = {"s1": Plot(1, "exit-right", "change-left"), "s2": Plot(1, "exit-left", "exit-right")}


class Story(msgspec.Struct, frozen=True):
    """The times [s] of one ride; null if never."""

    scenario: str
    seed: int
    vehicle: int
    kind: Action
    known: float | None  # first moment at which the goal's probability is at least SURE
    started: float | None  # beginning of the ego's manoeuvre, if it carries it out
    committed: float | None  # when the ego can no longer give it up
    before: bool  # whether it was known before the ego was committed


def tell(name: str, seed: int, recording: Recording) -> Story | None:
    """Return the story of a ride; None if the scenario has none."""
    plot = PLOTS.get(name)
    if plot is None:
        return None
    started, committed = manoeuvre(recording.events, plot.ego)
    known = _known(recording, plot)
    before = known is not None and committed is not None and known <= committed
    return Story(name, seed, plot.vehicle, plot.kind, known, started, committed, before)


def manoeuvre(events: Sequence[Event], action: Action) -> tuple[float | None, float | None]:
    """Return when [s] the ego began the first manoeuvre that it carried out, and committed to it.

    None and None if it carried out no such manoeuvre.
    """
    started: float | None = None
    for event in events:
        if event.kind == "action-started" and event.action == action:
            started = event.sim_time
        elif event.kind == "action-committed" and event.action == action:
            return started, event.sim_time
    return None, None


def likely(beliefs: Sequence[Belief], kind: Action) -> float:
    """Return the probability of the goals of a kind."""
    return sum(belief.probability for belief in beliefs if belief.goal.kind == kind)


def _known(recording: Recording, plot: Plot) -> float | None:
    """Return when [s] the ego first knew, if it did before the vehicle went out of view."""
    for sample, scene in enumerate(recording.scenes):
        seen = plot.vehicle in scene.vehicles
        if seen and likely(recording.beliefs(sample)[plot.vehicle], plot.kind) >= SURE:
            return round(scene.time, 3)
    return None
