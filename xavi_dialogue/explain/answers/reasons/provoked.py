"""Provoked: whether another vehicle brakes because of us, or of somebody else who is named."""

from collections.abc import Callable
from typing import Any

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.answers import Answer, MotionCause, NeedRollout, OtherReason
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Question, Whether, Why
from xavi_dialogue.domain.terms import Ego, Event, Happens, Proposition, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reasons import others
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.reading import event_of, unwrapped

#: Actions by which we move in ahead of somebody.
ENTRIES = frozenset[ActionName](
    ("change-left", "change-right", "merge", "enter", "pull-out", "exit-left", "exit-right")
)
BEFORE = 4.0  # [s] for which we count as having just moved in ahead of somebody
WAITING = frozenset[ActionName](("wait", "give-way", "let-go"))
SOON = 2.0  # [s] after a braking begins, up to which our moving in is looked at
REACH = 60.0  # [m] maximum distance of a vehicle that brakes for us


def explainer(question: Question) -> Callable[[Any, Asked], Answer] | None:
    """Find the explainer of whether another vehicle had to brake for us; None: something else."""
    match question:
        case Whether(that=Happens(Event("brake" | "slow-down", Vehicle(), Ego()) as event)) if (
            event.tense in ("past", "perfect")
        ):
            return braked_for_us
    return None


def braked_for_us(question: Whether, scene: Asked) -> Answer:
    """Return whether another vehicle braked for us, with its reason as far as it is known.

    Raises:
        Unanswered: it did not brake, or was never seen.
    """
    event = event_of(question.that)
    assert event is not None
    plain = Happens(replace(event, object=None, modal=None))
    return because_of_us(Why(plain, suspect=Ego()), scene)


def because_of_us(question: Why, scene: Asked) -> Answer:
    """Return whether another vehicle braked or stopped because of us, or else why.

    Raises:
        Unanswered: it did not brake, or was never seen.
    """
    of, negated = unwrapped(question.of)
    assert isinstance(of, Happens)
    past = of.event.tense in ("past", "perfect")
    plain = replace(of.event, modal=None)
    found = others.why(plain, scene, negated=negated)
    if not isinstance(found, OtherReason) or found.deed is None:
        return found
    if found.asked is not None and not any(cause.vehicle == EGO for cause in found.causes):
        return found
    deed: Episode = found.deed
    if past and deed.end is None:
        deed = replace(deed, end=scene.now)
    found = replace(found, deed=deed, asked=None)
    if any(cause.vehicle == EGO for cause in found.causes):
        ranked = sorted(found.causes, key=lambda cause: cause.vehicle != EGO)
        return replace(found, causes=tuple(ranked), ours=True)
    if _came_in(scene, found.vehicle, deed):
        return replace(found, causes=(MotionCause("cut-in", EGO),), goal=None, ours=True)
    return replace(found, ours=False)


def _came_in(scene: Asked, vehicle: int, deed: Episode) -> bool:
    """Check whether a vehicle began to brake while or just after we moved in ahead of it."""
    world, begin = scene.world, deed.begin
    entries = world.episodes(Ego(), ENTRIES, begin - BEFORE, begin + SOON)
    if not any(entry.begin <= begin for entry in entries):
        return False
    for time in (begin, min(begin + SOON, scene.now)):
        look = world.look(vehicle, time)
        near = look is not None and look.in_view and look.distance <= REACH and look.ahead < 0.0
        if near and world.relation("ahead-of", Ego(), Vehicle(vehicle), time):
            return True
    return False


def brakes_for(of: Proposition | None, scene: Asked) -> Answer | None:
    """Return why another brakes, for a question if it waits for who makes it brake; else None.

    Raises:
        Unanswered: rollouts are needed.
    """
    match of:
        case Happens(event=Event(actor=Vehicle(), object=Vehicle() | Ego(), modal=None) as event):
            waits = event.action in WAITING and event.tense == "present"
        case _:
            return None
    assert isinstance(event.actor, Vehicle)
    motion = scene.ride.motion(event.actor.number).until(scene.now)
    if not waits or motion.trend != "slowing":
        return None
    slows = Event("slow-down", event.actor, tense="present")
    try:
        found = others.why(slows, scene, negated=False)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return None
    whom = event.object.number if isinstance(event.object, Vehicle) else EGO
    causes = found.causes if isinstance(found, OtherReason) else ()
    return found if any(cause.vehicle == whom for cause in causes) else None
