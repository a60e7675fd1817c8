"""Crossing: who crosses our way at a time, has just done so, or is expected to."""

from sim.scene import EGO
from xavi_dialogue.explain.facts.actions import somebody
from xavi_dialogue.explain.facts.episodes import happening
from xavi_dialogue.explain.facts.states import States

LATELY = 8.0  # [s] after which somebody who crossed, or was let go first, is no longer meant
EXPECTED = 0.4  # chance of crossing from which somebody counts as about to
DEEDS: happening.Names = frozenset(("cross", "give-way"))


def crossing(states: States, t: float) -> tuple[int, ...]:
    """Return who crosses our way at a time [s], crossed it lately or is about to, by number."""
    found: set[int] = set()
    for episode in happening.happening(states, None, DEEDS):
        until = states.ride.now if episode.end is None else episode.end
        who, whom = somebody(episode.actor) or frozenset(), somebody(episode.object) or frozenset()
        if not t - LATELY <= until or episode.begin > t:
            continue
        found |= who if EGO in whom and episode.action == "cross" else frozenset()
        found |= whom if EGO in who and episode.action == "give-way" else frozenset()
    trace = states.trace(t)
    for known in () if trace is None else trace.predictions:
        chance = sum(goal.probability for goal in known.goals if goal.kind == "cross")
        found |= {known.vehicle} if chance >= EXPECTED else frozenset()
    return tuple(sorted(found - {EGO}))
