"""Prefetching of plans: what the next "why?" is likely to need is planned while idle.

To name a vehicle as a cause, the decision is planned again without it. This takes longer than
anything else in an answer. Passengers ask most about a manoeuvre that has just begun, so in a
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
FASTEST = 2.0  # simulated seconds per second; beyond it decisions come faster than plans
#: "Why did you do that?", of what was done last.
WHY = Reading(acts=(Ask(Why(Happens(Event("do")))),), shares=())


@dataclass
class Prefetch:
    """How many plans were prefetched for the latest event of a ride."""

    events: int = -1  # of the ride, when that was
    rounds: int = 0  # of planning since then

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
    """Return what an answer to "why?" lacks beyond all earlier plans."""
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
