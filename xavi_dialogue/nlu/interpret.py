"""Interpretation: a text becomes readings, by the grammar and by what such texts usually ask."""

from functools import lru_cache
from typing import Final

from xavi_dialogue.domain.meaning import Reading
from xavi_dialogue.nlu.intents.ranking import ranked
from xavi_dialogue.nlu.parse import Parser

CACHED: Final = 512


@lru_cache(maxsize=CACHED)
def interpret(text: str) -> tuple[Reading, ...]:
    """Return the readings of a text, likeliest first; never empty."""
    return ranked(text, Parser().read(text))
