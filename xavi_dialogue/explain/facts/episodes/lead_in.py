"""Lead-ins: the slowing down and waiting before a junction that passengers count as part of it."""

from collections.abc import Iterable

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.vocabulary import ActionName

HELD: tuple[ActionName, ...] = ("brake", "wait", "stop", "stand")
JOINED = 3.0  # [s] maximum time between slowing down and entering the junction
PAUSE = 4.0  # [s] maximum time between two halts before one junction


def held_since(episodes: Iterable[Episode], begin: float) -> float:
    """Return since when [s] a road user had slowed down and waited before a junction.

    Args:
        episodes: episodes of the road user; only slowing down and waiting count.
        begin: [s] when the road user entered the junction.
    """
    slow = [e for e in episodes if e.action in HELD and e.begin < begin]
    since, gap = begin, JOINED
    for one in sorted(slow, key=lambda e: -e.begin):
        if one.end is None or one.end >= since - gap:
            since, gap = one.begin, PAUSE
    return since
