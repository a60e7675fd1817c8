"""Check an answer sentence by sentence; say what no pattern covers."""

import re

from tests.truth import chances, conduct, deeds, motion
from tests.truth.context import RULES, Fault, Said
from tests.truth.mentions import mentions
from tests.truth.ridden import Ridden

__all__ = ["chances", "checked", "conduct", "deeds", "motion"]
SENTENCE = re.compile(r"(?<=[.!?;]) ")
PLACES_ONLY = motion.place_of


def checked(
    ride: Ridden, now: float, question: str, answer: str
) -> tuple[list[Fault], list[tuple[str, bool]]]:
    """What an answer tells wrongly, and its sentences, each with whether a pattern covers it."""
    text, found = mentions(answer, ride, now)
    faults: list[Fault] = []
    covered: list[tuple[str, bool]] = []
    before = ""
    for sentence in SENTENCE.split(text):
        said = Said(ride, now, question, sentence, tuple(found), before)
        met = False
        for pattern, check in RULES:
            for match in pattern.finditer(sentence):
                met = met or check is not PLACES_ONLY
                faults.extend(check(said, match))
        covered.append((sentence, met))
        before += sentence + " "
    unique = {(fault.kind, fault.detail): fault for fault in faults}
    return list(unique.values()), covered
