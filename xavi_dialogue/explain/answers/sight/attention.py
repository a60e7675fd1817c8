"""Attention: that we look to all sides at all times, and whom we saw near us."""

from typing import Final

from xavi_dialogue.domain.hidden_areas import AllRound
from xavi_dialogue.domain.terms import Ego, Is
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import SHORT, instant, is_past
from xavi_dialogue.explain.answers.reference.naming import looks

NEAR: Final = 25.0  # [m] up to which somebody is near us
TOLD: Final = 3  # maximum of those who are named
#: Deeds before which a driver looks around.
CHECKED: Final[tuple[ActionName, ...]] = (
    "exit-left", "exit-right", "exit-straight", "change-left", "change-right", "go",
)  # fmt: skip


def attending(of: Is, asked: Asked) -> AllRound:
    """Return whom we saw near us at the time in question."""
    at = _moment(of, asked)
    seen = looks(asked, asked.world.in_view(at), at)
    near = sorted((x for x in seen if x.distance <= NEAR), key=lambda x: (x.distance, x.vehicle))
    return AllRound(tuple(near[:TOLD]), at, past=at < asked.now - SHORT)


def _moment(of: Is, asked: Asked) -> float:
    """Return the time asked about; of the past without a time, when we began our last deed."""
    at = instant(asked, of.time, of.tense)
    if at < asked.now - SHORT or not is_past(asked, of.time, of.tense):
        return at
    done = asked.world.episodes(actor=Ego(), actions=CHECKED)
    return max((e.begin for e in done if e.begin <= asked.now), default=at)
