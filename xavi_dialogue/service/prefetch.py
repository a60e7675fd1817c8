"""What the next passenger who asks why will need: planned while nobody asks.

To blame a vehicle, the decision is planned again without it, which takes longer than anything
else in an answer. A manoeuvre that has just begun is what is asked about most; so in a ride at
the pace of life, what an answer about it needs is planned at once.
"""

from dataclasses import dataclass

from planner.record.trace import PlanTrace
from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.dialogue.manager import MAX_ROUNDS
from xavi_dialogue.dialogue.mind import Mind
from xavi_dialogue.dialogue.state.state import Dialogue
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import Ask, Reading, Why
from xavi_dialogue.domain.terms import Event, Happens

AHEAD = 5.0  # [s] that such a plan may take
FASTEST = 2.0  # simulated seconds per second; beyond it decisions come faster than plans
#: "Why did you do that?", of what was done last.
WHY = Reading(acts=(Ask(Why(Happens(Event("do")))),), shares=())


@dataclass
class Foreseen:
    """How far has been looked ahead in a ride."""

    events: int = -1  # of the ride, when that was
    rounds: int = 0  # of planning since then

    def need(self, mind: Mind, dialogue: Dialogue, scene: SceneReport) -> NeedRollout | None:
        """What is to be planned next; None where nothing is, or the ride is too fast."""
        lively = scene.state == "driving" and 0.0 < scene.speed_factor <= FASTEST
        if not lively or not dialogue.traces or not dialogue.events:
            return None
        if self.events != scene.events:
            self.events, self.rounds = scene.events, 0
        if self.rounds >= MAX_ROUNDS:
            return None
        self.rounds += 1
        found = _wanted(mind, dialogue, scene.sim_time)
        if found is None:
            self.rounds = MAX_ROUNDS
        return found


def _wanted(mind: Mind, dialogue: Dialogue, at: float) -> NeedRollout | None:
    """What an answer lacks beyond all that was planned before."""
    grounding = mind.ground((WHY,), dialogue.record(at), Discourse())
    if not grounding.acts:
        return None
    extra: tuple[PlanTrace, ...] = ()
    for _ in range(MAX_ROUNDS):
        found = mind.explain(grounding.acts[0], dialogue.record(at, extra))
        if not isinstance(found, NeedRollout):
            return None
        known = dialogue.planned.get(found)
        if known is None:
            return found
        extra = (*extra, known)
    return None
