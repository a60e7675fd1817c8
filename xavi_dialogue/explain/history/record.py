"""Record: everything of a ride that explanations may draw on."""

from dataclasses import dataclass

from planner.record.events import Event
from planner.record.trace import PlanTrace
from sim.scene import Scene
from xavi_dialogue.domain.answers import NeedRollout


@dataclass(frozen=True, slots=True)
class Record:
    """The ride so far, oldest first; pure data, live or replayed."""

    now: float  # [s] simulation time at which the question is asked
    traces: tuple[PlanTrace, ...] = ()
    events: tuple[Event, ...] = ()
    ended: bool = False
    extra: tuple[PlanTrace, ...] = ()  # plans made again for NeedRollout requests
    refused: tuple[NeedRollout, ...] = ()  # requests that could not be met
    gaps: tuple[tuple[float, float], ...] = ()  # [s] begin and end of what was lost
    scene: Scene | None = None  # the newest scene up to `now`; None: that of the last decision
