"""The two stories in which the ego's choice hangs on where vehicle 1 goes, and when it is known."""

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
    """What is to be known of a vehicle, and what the ego does knowing it."""

    vehicle: int
    kind: Action
    ego: Action


PLOTS = {"s1": Plot(1, "exit-right", "change-left"), "s2": Plot(1, "exit-left", "exit-right")}


class Story(msgspec.Struct, frozen=True):
    """How one ride went; times in seconds, null where it never was."""

    scenario: str
    seed: int
    vehicle: int
    kind: Action
    known: float | None  # first moment at which its probability is at least SURE
    started: float | None  # the ego begins its manoeuvre, where it carries it out
    committed: float | None  # and cannot give it up any more
    before: bool  # known before the ego was committed


def tell(name: str, seed: int, recording: Recording) -> Story | None:
    """Return the story of a ride; None where the scenario has none."""
    plot = PLOTS.get(name)
    if plot is None:
        return None
    started, committed = manoeuvre(recording.events, plot.ego)
    known = _known(recording, plot)
    before = known is not None and committed is not None and known <= committed
    return Story(name, seed, plot.vehicle, plot.kind, known, started, committed, before)


def manoeuvre(events: Sequence[Event], action: Action) -> tuple[float | None, float | None]:
    """When [s] the ego began the first such manoeuvre that it carried out, and was committed."""
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
