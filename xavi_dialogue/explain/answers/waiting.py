"""Waiting: for what or whom we wait, slow down or give way."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Identified, MotionCause, MotionReason
from xavi_dialogue.domain.meaning import Which, Why
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Happens,
    Is,
    Not,
    Now,
    Proposition,
    Wanted,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.propositions import reasons
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import unwrapped
from xavi_dialogue.explain.answers.ride.delays import let_past
from xavi_dialogue.explain.facts.looks import STILL
from xavi_dialogue.explain.facts.world import LETTING_GO

#: What of the road makes us slow down, as kinds of reasons.
ROADS: Final = ("turn", "bend", "roundabout", "give-way-line", "hidden", "lane-end", "limit")
STANDING: Final = frozenset[ActionName](("stop", "stand", "wait"))


def what_for(question: Which, scene: Asked) -> Answer:
    """Return for what or whom we wait or slow down, as the reason; or that we wait for nobody.

    Raises:
        Unanswered: we did not, or rollouts are needed.
    """
    event = _deed(question.such)
    several = let_past(event, scene)
    least = 1 if event.action in LETTING_GO and event.tense != "present" else 2
    if len(several) >= least:
        return Identified(several, question.such)
    if event.action in LETTING_GO and event.time == WholeRide() and event.modal is None:
        return Identified((), question.such, none=True)
    alone = replace(event, object=None)
    if event.action not in STANDING or event.tense != "present":
        return reasons.why(Why(Happens(alone)), scene)
    moves = _moves(scene)
    held = Is("slow", Ego(), time=Now(), tense="present")
    found = reasons.why(Why(held if moves else Not(Happens(Event("go", tense="present")))), scene)
    freely = isinstance(found, MotionReason) and not any(map(_holds, found.causes))
    if moves and freely and not (_slows(question.such) and _by_road(found)):
        waits = Event("wait", Ego(), Wanted(), tense="present")
        speed = scene.world.measure("speed", Ego(), scene.now)
        return Identified((), Happens(waits), (speed,), none=True)
    return found


def _holds(cause: MotionCause) -> bool:
    """Check whether a reason is somebody, or a traffic light."""
    return cause.vehicle is not None or cause.shown is not None


def _slows(such: Proposition | None) -> bool:
    """Check whether it is asked what slows us or holds us back, and not whom we wait for."""
    of, _ = unwrapped(such)
    return isinstance(of, Compares) or (isinstance(of, Happens) and of.event.action == "block")


def _by_road(found: Answer) -> bool:
    """Check whether the road makes us slow."""
    return isinstance(found, MotionReason) and any(one.kind in ROADS for one in found.causes)


def _deed(such: Proposition | None) -> Event:
    """Return what we do, or did, because of whom or what is asked for."""
    of, _ = unwrapped(such)
    event = of.event if isinstance(of, Happens) else Event("block")
    if isinstance(of, Compares):
        event = replace(event, tense=of.left.tense, time=of.left.time)
    if isinstance(of, Is):
        event = Event("stand", tense=of.tense, time=of.time)
    return replace(event, action="wait", actor=Ego()) if event.action == "block" else event


def _moves(scene: Asked) -> bool:
    """Check whether we drive, if slowly."""
    speed = scene.world.measure("speed", Ego(), scene.now).value
    return speed is not None and speed > STILL
