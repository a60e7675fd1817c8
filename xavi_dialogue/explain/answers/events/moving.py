"""Moving: whether somebody was in motion at a time, or at any time of the ride."""

from typing import Final

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Event, Vehicle
from xavi_dialogue.explain.answers.reference import naming
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import was_said, window
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.history.thresholds import MOVING, STANDING

FRESH: Final = 5.0  # [s] since when somebody who set off is setting off
SLACK: Final = 0.5  # [s] between the end of a wait and setting off


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


def sets_off(asked: Asked, event: Event) -> Finding | None:
    """Check whether somebody who let others go first has just set off, as "he is pulling out".

    None if nobody has, or for other events: then it is what is expected that counts.
    """
    now = event.tense == "present" and event.modal is None and asked.past is None
    if event.action != "pull-out" or not now or not isinstance(event.actor, Vehicle):
        return None
    begun = asked.world.episodes(event.actor, ("go",), begin=asked.now - FRESH)
    waited = asked.world.episodes(event.actor, ("give-way", "wait"))
    found = [
        one
        for one in begun
        if one.begin >= asked.now - FRESH and any(_until(w, one) for w in waited)
    ]
    return Finding(True, (found[-1],)) if found else None


def _until(waited: Episode, begun: Episode) -> bool:
    """Check whether a wait ended when somebody set off."""
    return waited.end is not None and abs(waited.end - begun.begin) <= SLACK
