"""Near misses: when another vehicle and the ego almost touched."""

import numpy as np

from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.explain.facts.actions import named
from xavi_dialogue.explain.facts.approach import closest
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.thresholds import CLOSE, MOVING


def misses(states: States, vehicle: int) -> list[Episode]:
    """Return when a vehicle came closer to the ego than CLOSE, with one of them in motion.

    Standing in a queue, or driving beside each other in parallel, is no near miss.
    """
    pair = states.pair(EGO, vehicle)
    if pair is None:
        return []
    found = closest(states, EGO, vehicle, float(pair.time[0]), float(pair.time[-1]))
    if found is None or found.distance > CLOSE:
        return []
    k = int(np.argmin(np.abs(pair.time - found.time)))
    parallel = abs(pair.left[k]) > 2.0 and abs(np.sin(pair.turn[k])) < 0.3
    if parallel or max(pair.speed[k], pair.eye_speed[k]) < MOVING:
        return []
    return [Episode(named(EGO), "nearly-collide", found.time, found.time, named(vehicle))]
