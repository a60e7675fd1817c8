"""Tight turns: which of our turns was the tightest."""

import numpy as np

from sim.scene import EGO
from xavi_dialogue.domain.answers import PeakMoment
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.occasions import did_not_happen, occasions, overlaps

STRETCH = 5.0  # [m] of our way over which a curvature is taken


def tightest(kind: Event, asked: Asked, about: Window) -> PeakMoment:
    """Return our tightest turn of a kind.

    Raises:
        Unanswered: we have made no such turn.
    """
    found = [e for e in occasions(asked, kind) if overlaps(asked, e, about)]
    if not found:
        raise did_not_happen(asked, kind)
    most = max(found, key=lambda e: (_curvature(asked, e), -e.begin))
    slow = asked.world.extreme("speed", Ego(), "lowest", most.begin, _end(asked, most))
    return PeakMoment("tightness", most.begin, (most,), slow, kind=kind)


def _end(asked: Asked, deed: Episode) -> float:
    return asked.now if deed.end is None else deed.end


def _curvature(asked: Asked, deed: Episode) -> float:
    """Return the highest curvature [1/m] of our way during a deed."""
    motion = asked.ride.motion(EGO)
    time, _, _, heading, _ = motion.arrays
    arc = np.array(motion.arc)
    inside = (time >= deed.begin) & (time <= _end(asked, deed))
    first = np.maximum(np.searchsorted(arc, arc - STRETCH, side="right") - 1, 0)
    turned = np.abs(heading - heading[first])
    bent = np.where(inside, turned / np.maximum(arc - arc[first], STRETCH), 0.0)
    return float(bent.max(initial=0.0))
