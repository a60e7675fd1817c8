"""Going: why we went when we did, and what can be said of not having slowed down."""

from msgspec import structs

from xavi_dialogue.domain.answers import (
    Answer,
    Contrast,
    DidNotHappen,
    GoReason,
    MotionReason,
    NotApplicable,
    Unslowed,
)
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers import choices, motions
from xavi_dialogue.explain.answers.asked import LEEWAY, Asked, Unanswered
from xavi_dialogue.explain.answers.reading import is_past, manner_of
from xavi_dialogue.explain.causes.actions import NO_SPEED
from xavi_dialogue.explain.causes.contrast import contrast
from xavi_dialogue.explain.causes.going import bystanders
from xavi_dialogue.explain.causes.going import unslowed as crossing_at
from xavi_dialogue.explain.causes.premise import Premise, Subject, is_open, premise
from xavi_dialogue.explain.history.deeds import Deed
from xavi_dialogue.explain.history.ride import ROUNDING, planned

CROSSING = frozenset[ActionName](("exit-left", "exit-right", "exit-straight", "continue-next-exit"))
BEGUN = 0.5  # [s] since when what was begun is told as past
LATELY = 10.0  # [s] since when a junction that was crossed may be meant
SOON = 4.0  # [s] before we went within which waiting was the other choice


def went(event: Event, scene: Asked) -> Answer:
    """Tell why we went when we did: who had right of way, and what waiting would have cost.

    Raises:
        Unanswered: the record lacks it; or rollouts are needed.
    """
    past = is_past(scene, event)
    found = premise(scene.ride, Subject(event, (), past, scene.span))
    if found.deed is None or found.deed.action not in CROSSING:
        found = Premise(found.trace, _crossed(scene))
    begun = scene.moment if found.deed is None else found.deed.time
    against = _waiting(scene, begun)
    others = bystanders(scene.ride, scene.world, begun)
    trace = scene.ride.at(begun)
    unknown = trace is None or trace.road is None  # who has right of way
    if not others and (found.deed is None or unknown):
        return choices.why(None, scene)
    past = past or (found.deed is not None and begun < scene.now - BEGUN)
    return GoReason(choices.deed_of(scene, found), others, against, past=past)


def _crossed(scene: Asked) -> Deed | None:
    """The last junction that we went into up to the moment asked about."""
    before = [
        deed
        for deed in scene.ride.deeds
        if deed.action in CROSSING and deed.time <= scene.moment + LEEWAY
    ]
    inside = [deed for deed in before if deed.ended is None or deed.ended >= scene.moment - LATELY]
    return inside[-1] if inside else None


def _waiting(scene: Asked, time: float) -> Contrast | None:
    """The last decision up to a time [s] that could have stopped and did not, against stopping."""
    open_ = [
        trace
        for trace in scene.ride.traces
        if time - SOON <= trace.sim_time <= time + ROUNDING
        and is_open(scene.ride, trace, ("stop",))
        and planned(trace)[:1] != ("stop",)
    ]
    return contrast(scene.ride, open_[-1], ("stop",)) if open_ else None


def unslowed(event: Event, scene: Asked) -> Answer:
    """What can be said of not having slowed down: who was in the way, and how close it was.

    Raises:
        Unanswered: we did not slow down or wait; or rollouts are needed.
    """
    name: ActionName = event.action if event.action in motions.KINDS else "slow-down"
    asked = structs.replace(event, action=name, object=None, manner=(), tense="past")
    try:
        found = motions.motion(asked, scene)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, DidNotHappen):
            raise Unanswered(NotApplicable((), NO_SPEED, scene.moment)) from None
        raise
    if not isinstance(found, MotionReason):
        return found
    cause = next(iter(found.causes), None)
    crossing = None
    if cause is not None and cause.vehicle and cause.kind == "right-of-way":
        crossing = crossing_at(scene.ride, cause.vehicle, found.deed)
    return Unslowed(
        found.deed,
        cause,
        ours=None if crossing is None else crossing.ours,
        theirs=None if crossing is None else crossing.theirs,
        going=manner_of(event, "fast", "slowly") is None,
    )
