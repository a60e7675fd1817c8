"""Present: which of what was done still goes on, is over, or is yet to come."""

from typing import Final

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.nlu.grounding.context import Grounder, Window
from xavi_dialogue.nlu.grounding.events.fitting import JUST, LATELY
from xavi_dialogue.nlu.grounding.kin import like

HALTS: Final = frozenset(("stand", "stop", "wait"))


def halts_again(found: Event, last: Episode, g: Grounder) -> bool:
    """Tell whether our halt is over, and we do not drive off: then the next one is meant."""
    if not isinstance(found.actor, Ego) or found.action not in HALTS:
        return False
    if found.tense != "present" or not is_over(last, g):
        return False
    now = g.context.now
    return all(
        e.end is not None or e.action not in ("go", "speed-up")
        for e in g.context.deeds(Ego(), now, now)
    )


def is_over(episode: Episode, g: Grounder) -> bool:
    """Tell whether an episode ended before now."""
    return episode.end is not None and episode.end < g.context.now - JUST


def going_on(found: Event, g: Grounder) -> tuple[Episode, ...]:
    """Return what goes on now and may be meant by an event; else that event, which is over."""
    now = g.context.now
    near = like(g.context, found, now - JUST, now) if found.tense == "present" else ()
    return near or g.context.holds(found, now - LATELY, now)


def is_next(found: Event, g: Grounder) -> bool:
    """Tell whether an event is the next turn of our own way: "why turn left?" is asked of it.

    So is that a light changes, of which nothing else is to come.
    """
    if found.action == "turn-colour" and found.tense in ("present", "future"):
        return True
    road = g.context.world.road(g.context.now)
    route = () if road is None or found.tense != "present" else road.route
    return isinstance(found.actor, Ego) and bool(route) and route[0].turn == found.action


def is_present(window: Window) -> bool:
    """Tell whether a window is the present moment."""
    return not window.ahead and window.end - window.begin < 0.1
