"""Not going: why we did not go, drive on, or come in among others."""

import dataclasses

from msgspec import structs

from xavi_dialogue.causal.model import Actions
from xavi_dialogue.domain.answers import Answer, DidNotHappen, NotApplicable, Verdict
from xavi_dialogue.domain.terms import Ego, Event, Exit, Is, Junction
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reasons import choices, motions
from xavi_dialogue.explain.answers.reasons.premises import CREEPING
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.reading import is_past
from xavi_dialogue.explain.history.nearing import speed_at
from xavi_dialogue.explain.history.ride import planned

#: Names for going somewhere; with a place or side, the question is about the way.
WAY = frozenset[ActionName](("go", "move", "head", "come", "pass"))
STANDING = 0.3  # [m/s] below which we stand
AGO = 2.0  # [s] after giving way in which it still keeps us from going


def not_joining(event: Event, scene: Asked, instead: Event | None) -> Answer:
    """Explain why we did not join others: by changing lanes, or by going into a junction."""
    lane = event
    if event.action == "enter" and not isinstance(event.object, Junction | Exit):
        lane = structs.replace(event, action="merge", object=None)
    spoken = scene.past is not None and scene.past.said
    for setting in (scene,) if spoken else (scene, dataclasses.replace(scene, span=None)):
        try:
            return choices.why_not(lane, setting, instead)
        except Unanswered as unanswered:
            if not isinstance(unanswered.result, NotApplicable):
                raise
    return not_going(structs.replace(event, action="go", object=None, where=None), scene)


def not_going(event: Event, scene: Asked) -> Answer:
    """Explain why we did not go: for whom we stood or slowed; else why we chose otherwise."""
    speed = speed_at(scene.ride, scene.moment)
    if not is_past(scene, event) and (speed is None or speed < STANDING):
        return motions.motion(Event("stand", tense="present"), scene)
    if event.action in WAY and tells_way(event):
        return choices.why_not(event, scene)
    asked = Event("give-way", tense=event.tense, object=event.object)
    past = scene.past
    begin, end = (scene.now - AGO, scene.now) if past is None else (past.begin, past.end)
    if is_past(scene, event) or scene.world.holds(asked, begin, end):
        try:
            return motions.motion(asked, scene, asked="wait")
        except Unanswered as unanswered:
            if not isinstance(unanswered.result, DidNotHappen):
                raise
    if event.action in ("go", "move"):
        if not is_past(scene, event) and _first(scene) == ("stop",):
            return motions.motion(Event("stop", tense="present"), scene)
        plain = event.tense == "present" and event.where is None and not event.manner
        going_on = event.action == "move" or _first(scene) == ("continue",)
        moving = moving_on(scene, event.object) if plain and going_on else None
        return motions.slow(scene) if moving is None else moving
    return choices.why_not(event, scene)


def tells_way(event: Event) -> bool:
    """Check whether the event is about a way to go: at a junction or exit, or to a side."""
    return isinstance(event.object, Junction | Exit) or bool(event.side or event.where)


def _first(scene: Asked) -> Actions:
    """Return what the plan in force begins with: a stop, or driving on as a matter of speed."""
    trace = scene.ride.at(scene.now)
    return () if trace is None else planned(trace)[:1]


def moving_on(scene: Asked, where: object = None) -> Answer | None:
    """Return that we are moving, for a question that presupposes that we stand; None if we do."""
    speed = scene.world.measure("speed", Ego(), scene.now)
    if where is not None or scene.past is not None or (speed.value or 0.0) < CREEPING:
        return None
    return Verdict(Is("stationary", Ego(), tense="present"), False, (speed,), claim=True)
