"""Moving: whether somebody was in motion at a time, or at any time of the ride."""

from xavi_dialogue.domain.terms import Event
from xavi_dialogue.explain.answers.reference import naming
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import was_said, window
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.history.thresholds import MOVING, STANDING


def moved(asked: Asked, event: Event) -> Finding | None:
    """Return that somebody went who was in motion then, or is out of view; else None."""
    if naming.number(event.actor) is None and not naming.is_us(event.actor):
        return None
    about = window(asked, event.time, event.tense)
    then = asked.world.measure("speed", event.actor, min(about.middle, asked.now))
    said = about.instant and was_said(asked, event.time) and then.value is not None
    said = said and event.action == "move" and event.tense == "past"
    if said and (then.value or 0.0) < STANDING:
        return Finding(False, (then,))
    if occasion(asked, event) is not None:
        return None
    if said:
        return Finding(True, (then,))
    look = naming.look_of(asked, event.actor, asked.now)
    if look is not None and not look.in_view:
        return Finding(True, (look,))
    at = asked.now if event.tense == "perfect" else window(asked, event.time, event.tense).end
    speed = asked.world.measure("speed", event.actor, min(at, asked.now))
    return Finding(True, (speed,)) if (speed.value or 0.0) >= MOVING else None
