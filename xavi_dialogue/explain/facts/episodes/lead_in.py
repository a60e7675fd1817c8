"""Lead-ins: the slowing down and waiting before a junction that passengers count as part of it."""

from collections.abc import Iterable

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.vocabulary import ActionName

HELD: tuple[ActionName, ...] = ("brake", "wait", "stop", "stand")
JOINED = 3.0  # [s] between slowing down and the way through that belong together
PAUSE = 4.0  # [s] between two halts before one junction


def held_since(episodes: Iterable[Episode], begin: float) -> float:
    """Tell since when [s] somebody had slowed down and waited before a junction.

    Args:
        episodes: of him; those that are no slowing down or waiting do not count.
        begin: when [s] he entered the junction.
    """
    slow = [e for e in episodes if e.action in HELD and e.begin < begin]
    since, gap = begin, JOINED
    for one in sorted(slow, key=lambda e: -e.begin):
        if one.end is None or one.end >= since - gap:
            since, gap = one.begin, PAUSE
    return since
