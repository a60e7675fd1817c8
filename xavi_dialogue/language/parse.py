"""Parse: text -> Query | NotUnderstood.

Normalise, correct the spelling, cut the words into phrases in every way. Then two opinions: what
the grammar makes of them, and of which kind the judge thinks them. The query that is cheapest
by both wins. Where two that mean different things lie within the margin, or none makes sense,
the text is not understood; the parser rather asks than guesses. Pure and deterministic.
"""

import math
from dataclasses import replace
from functools import lru_cache

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language import topics
from xavi_dialogue.language.aspects import with_aspect
from xavi_dialogue.language.beam import Budget
from xavi_dialogue.language.candidates import loosely, strict
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.decide import decide, weigh
from xavi_dialogue.language.features import features
from xavi_dialogue.language.followup import answerable
from xavi_dialogue.language.judge import Judge, judge
from xavi_dialogue.language.lattice import build
from xavi_dialogue.language.normalise import MAX_INPUT, normalise
from xavi_dialogue.language.repairs import repaired
from xavi_dialogue.language.report import Kind, NotUnderstood, ParseReport, as_query
from xavi_dialogue.language.rewording import declined, reworded
from xavi_dialogue.language.words import hear

__all__ = ["NotUnderstood", "ParseReport", "Parser", "as_query", "explained"]

MAX_CONTEXT = 6  # earlier turns looked at
VEHICLES = frozenset(range(6))
_SHOWN_KINDS = 3


class Parser:
    """Understands passengers. Stateless: the conversation comes with each call."""

    def __init__(self, opinion: Judge | None = None) -> None:
        """With another judge than the one that ships with the grammar, to try it."""
        self._opinion = opinion
        self.explain("why did yuo stop?")  # build all tables before the first answer

    def parse(
        self, text: str, *, vehicles: frozenset[int] = VEHICLES, context: tuple[str, ...] = ()
    ) -> Query | NotUnderstood:
        """The query that a text means.

        Args:
            text: what was typed; of more than 256 characters or 48 words only the end is read.
            vehicles: names of the vehicles there are. Other numbers stand, for the answer to
                decline; but only these are heard in "vehicle to" and the like.
            context: the passenger's earlier turns, oldest first.
        """
        return self.explain(text, vehicles=vehicles, context=context).result

    def explain(
        self, text: str, *, vehicles: frozenset[int] = VEHICLES, context: tuple[str, ...] = ()
    ) -> ParseReport:
        """The same, with tokens, corrections and the readings behind the result."""
        previous = self.question_before(context, vehicles)
        return _remembered(text, previous, vehicles, self._opinion)

    def follow(
        self, text: str, previous: Query | None, vehicles: frozenset[int] = VEHICLES
    ) -> Query | NotUnderstood:
        """The query that a text means after an earlier question, as that was answered."""
        return _remembered(text, previous, vehicles, self._opinion).result

    def question_before(
        self, context: tuple[str, ...], vehicles: frozenset[int] = VEHICLES
    ) -> Query | None:
        """The last answerable query among the earlier turns, each resolved against those before."""
        previous: Query | None = None
        for turn in context[-MAX_CONTEXT:]:
            result = _remembered(turn, previous, vehicles, self._opinion).result
            if isinstance(result, Query) and answerable(result):
                previous = result
        return previous


def explained(
    text: str,
    previous: Query | None = None,
    vehicles: frozenset[int] = VEHICLES,
    opinion: Judge | None = None,
) -> ParseReport:
    """What a text means after an earlier question, worked out anew.

    Args:
        text: what was typed.
        previous: the question before it.
        vehicles: names of the vehicles there are.
        opinion: another judge than ours.
    """
    report, words = _read(text, previous, vehicles, opinion)
    result = _asked(report.result, words)
    if (other := reworded(result, words, previous)) is not None:
        meant, others = _read(other, previous, vehicles, opinion)
        result = _asked(meant.result, others)
        as_typed = _asked(result, words)
        result = as_typed if isinstance(as_typed, Query) and as_typed.event else result
    return replace(report, result=declined(words) or result)


def _asked(result: Query | NotUnderstood, words: tuple[str, ...]) -> Query | NotUnderstood:
    """The same with what its words ask for beyond its type."""
    return with_aspect(result, words) if isinstance(result, Query) else result


def _read(
    text: str, previous: Query | None, vehicles: frozenset[int], opinion: Judge | None
) -> tuple[ParseReport, tuple[str, ...]]:
    """What a text means as it stands, and its words."""
    if len(text) > MAX_INPUT:
        return ParseReport((), (), True, (), NotUnderstood("too-long")), ()
    normalised = normalise(text)
    if not normalised.words:
        return ParseReport((), (), False, (), NotUnderstood("empty")), ()
    heard = hear(normalised, vehicles)
    heard = replace(heard, words=repaired(heard.words))
    lattice = build(heard.words)
    tokens = tuple(edge.token for _, edge in lattice.main())
    seen = features(lattice, heard, follows=previous is not None)
    judging = opinion or judge()
    judged = judging.log_probabilities(seen)
    likely = tuple(sorted(judged, key=lambda kind: (-judged[kind], kind)))
    budget = Budget(costs().limits.steps)
    candidates = strict(lattice, previous, budget)
    candidates += loosely(lattice, likely[: costs().weighing.kinds], previous, budget)
    readings = weigh(candidates, judged)
    topic = topics.reason_for(tokens, normalised.words)
    result = decide(readings, judged, topic, lattice)
    kinds = tuple(
        Kind(name, round(math.exp(judged[name]), 4), judging.telling(seen, name))
        for name in likely[:_SHOWN_KINDS]
    )
    short = normalised.shortened
    report = ParseReport(tokens, heard.corrections, short, readings, result, kinds)
    return report, heard.words


_remembered = lru_cache(maxsize=512)(explained)  # turns are read again with each new one
