"""Pacing: how fast somebody is said to go, beside a number or the limit."""

from typing import Any

from xavi_dialogue.domain.terms import Compares, Measured, Proposition, Quantity
from xavi_dialogue.nlu.compose.candidates import Special
from xavi_dialogue.nlu.compose.deeds import tense_of, time_of
from xavi_dialogue.nlu.compose.tree import words_of

_ABOVE = frozenset({"over", "above", "more", "beyond"})
_BELOW = frozenset({"under", "below", "less", "down", "down to"})


def exceed(special: Special) -> Proposition:
    """Read "do sixty", "drive over the limit": our speed beside a number, or the limit."""
    speed = Measured("speed", special.subject, time=time_of(special), tense=tense_of(special))
    limit = Measured("limit", special.subject)
    beside = next((special.match.phrases[key] for key in ("over", "into", "bearing-behind")
                   if key in special.match.phrases), None)  # fmt: skip
    said = beside if isinstance(beside, Quantity) else special.object
    if isinstance(said, Quantity):
        if said.unit == "count":
            said = Quantity(round(said.value / 3.6, 6), "m/s")  # nobody says "km/h"
        nodes = [node for _, node in special.clause.objects]
        nodes += [phrase.node for phrase in special.clause.complements if phrase.sem == beside]
        words = {word for node in nodes for word in words_of(node).split()}
        more = special.clause.verb is None or special.clause.verb.key not in ("do", "go", "drive")
        more = more or bool(words & _ABOVE)
        less: Any = "less" if words & _BELOW else "same"
        return Compares(speed, "more" if more else less, said)
    return Compares(speed, "more", limit)
