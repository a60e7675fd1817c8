"""Readings as query fields: what has no sense here is declined, as grounding declines it."""

from collections.abc import Sequence

from xavi_dialogue.domain.meaning import Act, Beyond, Reading, Social
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import Unknown
from xavi_dialogue.nlu.grammar.lexicon import lexicon
from xavi_dialogue.nlu.grounding.doubts import judge
from xavi_dialogue.nlu.grounding.ground import DEAF, READINGS
from xavi_dialogue.nlu.projection.fields import QueryFields
from xavi_dialogue.nlu.projection.follow_ups import AMBIGUOUS, project
from xavi_dialogue.nlu.projection.polar import declined

_PLACES = frozenset(("here", "there"))


def project_readings(
    readings: Sequence[Reading], previous: QueryFields | None = None
) -> QueryFields:
    """Project the likeliest reading onto the query fields; acts in unknown words do not count.

    Args:
        readings: the readings of a text, likeliest first.
        previous: the question before, for follow-ups that are not completed yet.
    """
    tried = [(reading, _understood(reading)) for reading in readings[:READINGS]]
    best, acts = min(tried, key=lambda one: one[0].cost + DEAF * (len(one[0].acts) - len(one[1])))
    if acts:
        return project(acts, previous)
    known = lexicon().vocabulary.words
    ranks = [known.get(word.lower()) for word in best.unknown if not word.isdigit()]
    if not best.acts and all(rank is None for rank in ranks):  # no word of any vocabulary
        return AMBIGUOUS
    foreign = best.acts or any(rank != 0 for rank in ranks)
    return declined("off-topic") if foreign else AMBIGUOUS


def _understood(reading: Reading) -> tuple[Act, ...]:
    """Leave out the acts in which a main word has no sense."""
    doubts = judge(reading)
    return tuple(
        act
        for index, act in enumerate(reading.acts)
        if isinstance(act, Beyond | Social) or not (doubts.kills(index) or _is_foreign(act))
    )


def _is_foreign(act: Act) -> bool:
    return any(thing.words not in _PLACES for thing in parts(act, Unknown))
