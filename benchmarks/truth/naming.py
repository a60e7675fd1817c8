"""The foil that a statement is about, and the format of figures in reports."""

import re

from benchmarks.truth.context import Said
from benchmarks.truth.decision import Decision
from benchmarks.truth.reckoning import Actions

#: Begins the part of a phrase that is about other vehicles.
OF_OTHERS = re.compile(r"\b(?:expect|chance|possible|(?<!now )think|thought|might)\w*\b")
PERCENT = r"(?P<chance>(?:under |over )?\d+ %)"


def foil_of(said: Said, match: re.Match[str]) -> tuple[Decision, Actions] | None:
    """Find the decision and the foil that a statement is about: the last one named before it."""
    if said.decision is None:
        return None
    clause = re.split(r"[;:] ", said.text[: match.start()])[-1]
    head, _, reason = clause.rpartition("because ")
    earlier = said.before + said.text[: match.start()]
    sentence = re.split(r"(?<=[.!?]) ", earlier)[-1]
    for phrase in (reason, head, *(re.split(r",? because ", x)[0] for x in (sentence, earlier))):
        found = said.decision.foil_of(OF_OTHERS.split(phrase)[0])
        if found is not None:
            return said.decision, found
    return (said.decision, said.decision.asked) if said.decision.asked else None


def seconds(values: list[float]) -> str:
    """Return the range of values [s] as text for the report."""
    return f"{min(values):+.2f}..{max(values):+.2f} s" if values else "none"


def percents(values: list[float]) -> str:
    """Return the range of probabilities as text for the report."""
    return f"{100 * min(values):.1f}..{100 * max(values):.1f} %" if values else "none"
