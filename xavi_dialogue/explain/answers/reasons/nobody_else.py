"""Nobody else: whether vehicles other than the causes that were stated mattered for an action.

All others that were seen at the decision that explains the action are removed together, and the
decision is made again. If something else is done then, the nearest are tried one by one.
"""

import math
from typing import Final

from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer, ChoiceReason, MotionReason, NobodyElse, TooLittle
from xavi_dialogue.explain.answers.reasons.suspects import blamed, causation_of
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons
from xavi_dialogue.explain.causes.driving.suppositions import happens_without, planned_without

TRIED: Final = 3  # others that are tried one by one, the nearest first, if they matter together


def mattered(scene: Asked, found: Answer) -> Answer:
    """Return whether vehicles other than the causes mattered; a reason without causes stays.

    Raises:
        Unanswered: the decision must be planned again first.
    """
    if not isinstance(found, ChoiceReason | MotionReason):
        return found
    causation = causation_of(found)
    tried = () if causation is None else causation.vehicles
    named = tuple(dict.fromkeys((*blamed(found), *tried)))
    evidence = found.contrast.evidence if isinstance(found, ChoiceReason) else found.evidence
    trace = _decision(scene, evidence.traces)
    if not named or trace is None:
        return found
    others = tuple(v for v in trace.scene if v not in (EGO, *named))
    matter = _matter(scene, found, trace, others) if others else False
    if matter:
        nearest = sorted(others, key=lambda vehicle: _away(trace, vehicle))[:TRIED]
        needed = [
            one for one in nearest if len(others) > 1 and _matter(scene, found, trace, (one,))
        ]
        others = tuple(needed) or others
    past = found.past or trace is not scene.ride.latest
    return NobodyElse(named, others, matter, trace.sim_time, past)


def _away(trace: PlanTrace, vehicle: int) -> float:
    """Return how far [m] away a vehicle was."""
    return math.dist(trace.scene[vehicle].position, trace.scene[EGO].position)


def _decision(scene: Asked, names: tuple[str, ...]) -> PlanTrace | None:
    """Return the recorded decision that a reason rests on."""
    return next((t for t in scene.ride.traces if t.trace_id in names), None)


def _matter(
    scene: Asked, found: ChoiceReason | MotionReason, trace: PlanTrace, others: tuple[int, ...]
) -> bool | None:
    """Check whether something else is done without the others; None if that is not known."""
    try:
        if isinstance(found, ChoiceReason):
            return not planned_without(scene.ride, trace, others).same
        reasons = Reasons(found.causes, found.causation, found.evidence, trace)
        same = happens_without(scene.ride, reasons, others)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, TooLittle):
            return None
        raise
    return None if same is None else not same
