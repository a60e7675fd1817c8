"""Prefetching of plans: the service requests while idle what the next "why?" is likely to need.

To name a vehicle as a cause, the decision is planned again without it. This takes longer than
any other step of an answer. Passengers ask most about a manoeuvre that has just begun, so in a
ride at about real time the plans for an answer about it are made at once.
"""

from dataclasses import dataclass

from planner.record.trace import PlanTrace
from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.dialogue.manager import MAX_ROUNDS
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.dialogue.state.state import Dialogue
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import Ask, Reading, Why
from xavi_dialogue.domain.terms import Event, Happens

AHEAD = 5.0  # [s] deadline of such a plan
FASTEST = 2.0  # simulated seconds per second, beyond which decisions come faster than plans
#: "Why did you do that?", about the latest action.
WHY = Reading(acts=(Ask(Why(Happens(Event("do")))),), shares=())


@dataclass
class Prefetch:
    """The number of plans that were prefetched for the latest event of a ride."""

    events: int = -1  # number of the ride's events at the latest call
    rounds: int = 0  # rounds of planning since the latest event

    def need(
        self, pipeline: Pipeline, dialogue: Dialogue, scene: SceneReport
    ) -> NeedRollout | None:
        """Return what to plan next; None if nothing is needed or the ride is too fast."""
        lively = scene.state == "driving" and 0.0 < scene.speed_factor <= FASTEST
        if not lively or not dialogue.traces or not dialogue.events:
            return None
        if self.events != scene.events:
            self.events, self.rounds = scene.events, 0
        if self.rounds >= MAX_ROUNDS:
            return None
        self.rounds += 1
        found = _wanted(pipeline, dialogue, scene.sim_time)
        if found is None:
            self.rounds = MAX_ROUNDS
        return found


def _wanted(pipeline: Pipeline, dialogue: Dialogue, at: float) -> NeedRollout | None:
    """Return the plan that an answer to "why?" still lacks; None if it lacks none."""
    grounding = pipeline.ground((WHY,), dialogue.record(at), Discourse())
    if not grounding.acts:
        return None
    extra: tuple[PlanTrace, ...] = ()
    for _ in range(MAX_ROUNDS):
        found = pipeline.explain(grounding.acts[0], dialogue.record(at, extra))
        if not isinstance(found, NeedRollout):
            return None
        known = dialogue.planned.get(found)
        if known is None:
            return found
        extra = (*extra, known)
    return None
