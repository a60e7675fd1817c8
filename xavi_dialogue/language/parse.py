"""Parse: text -> Query | NotUnderstood.

Normalise, correct the spelling, cut the words into phrases in every way. Then two opinions: what
the grammar makes of them, and of which kind the judge thinks them. The query that is cheapest
by both wins. Where two that mean different things lie within the margin, or none makes sense,
the text is not understood; the parser rather asks than guesses. Pure and deterministic.
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language import topics
from xavi_dialogue.language.beam import Budget
from xavi_dialogue.language.candidates import loosely, strict
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.features import features
from xavi_dialogue.language.followup import answerable
from xavi_dialogue.language.judge import Judge, judge
from xavi_dialogue.language.kinds import reason_in
from xavi_dialogue.language.lattice import Lattice, build
from xavi_dialogue.language.normalise import MAX_INPUT, normalise
from xavi_dialogue.language.tokens import Token
from xavi_dialogue.language.words import hear

MAX_CONTEXT = 6  # earlier turns looked at
_UNCLEAR = "ambiguous"
_TALK = frozenset({"smalltalk", "help"})

Cause = Literal["empty", "too-long", "gibberish", "ambiguous", "no-question"]


@dataclass(frozen=True, slots=True)
class NotUnderstood:
    """A text without a query."""

    cause: Cause
    readings: tuple[Query, ...] = ()  # with "ambiguous": what it may mean, likeliest first
    hints: tuple[str, ...] = ()  # words that were not known


@dataclass(frozen=True, slots=True)
class Scored:
    """A reading resolved against the conversation."""

    rule: str
    query: Query
    score: float  # cost by grammar and judge together: the lower, the likelier
    cost: float = 0.0  # by the grammar: 0 is a perfect fit
    loose: bool = False  # only its clauses were read by the grammar


@dataclass(frozen=True, slots=True)
class ParseReport:
    """Why the parser understood what it did."""

    tokens: tuple[Token, ...]
    corrections: tuple[tuple[str, str], ...]
    shortened: bool
    readings: tuple[Scored, ...]  # likeliest first
    result: Query | NotUnderstood


class Parser:
    """Understands passengers. Stateless: the conversation comes with each call."""

    def __init__(self, opinion: Judge | None = None) -> None:
        """With another judge than the one that ships with the grammar, to try it."""
        self._opinion = opinion
        self.explain("why did yuo stop?")  # build all tables before the first answer

    def parse(
        self,
        text: str,
        *,
        vehicles: frozenset[int] = frozenset(range(6)),
        context: tuple[str, ...] = (),
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
        self,
        text: str,
        *,
        vehicles: frozenset[int] = frozenset(range(6)),
        context: tuple[str, ...] = (),
    ) -> ParseReport:
        """The same, with tokens, corrections and the readings behind the result."""
        previous = self.question_before(context, vehicles)
        return _explain(text, previous, vehicles, self._opinion)

    def question_before(
        self, context: tuple[str, ...], vehicles: frozenset[int] = frozenset(range(6))
    ) -> Query | None:
        """The last answerable query among the earlier turns, each resolved against those before."""
        previous: Query | None = None
        for turn in context[-MAX_CONTEXT:]:
            result = _explain(turn, previous, vehicles, self._opinion).result
            if isinstance(result, Query) and answerable(result):
                previous = result
        return previous


def as_query(result: Query | NotUnderstood) -> Query:
    """A query in any case: what was not understood is an ambiguous one."""
    return result if isinstance(result, Query) else Query(type="ambiguous", tense="present")


@lru_cache(maxsize=512)  # the turns of a conversation are read again with each new one
def _explain(
    text: str, previous: Query | None, vehicles: frozenset[int], opinion: Judge | None = None
) -> ParseReport:
    if len(text) > MAX_INPUT:
        return ParseReport((), (), True, (), NotUnderstood("too-long"))
    normalised = normalise(text)
    if not normalised.words:
        return ParseReport((), (), False, (), NotUnderstood("empty"))
    heard = hear(normalised, vehicles)
    lattice = build(heard.words)
    tokens = tuple(edge.token for _, edge in lattice.main())
    reason = topics.reason_for(tokens, normalised.words)
    seen = features(lattice, heard, follows=previous is not None)
    likely = opinion or judge()
    judged = likely.log_probabilities(seen)
    readings = _readings(lattice, judged, previous)
    result = _decide(readings, judged, reason, tokens)
    return ParseReport(tokens, heard.corrections, normalised.shortened, readings, result)


def _readings(
    lattice: Lattice, judged: dict[str, float], previous: Query | None
) -> tuple[Scored, ...]:
    """All readings, likeliest first: the grammar's, and loose ones of the likeliest kinds."""
    budget = Budget(costs().limits.steps)
    likely = sorted(judged, key=lambda kind: (-judged[kind], kind))[: costs().weighing.kinds]
    candidates = [
        *strict(lattice, previous, budget),
        *loosely(lattice, tuple(likely), previous, budget),
    ]
    scored: dict[Query, Scored] = {}
    for one in candidates:
        score = one.cost + _against(one.kind, judged)
        known = scored.get(one.query)
        if known is None or score < known.score:
            scored[one.query] = Scored(one.rule, one.query, round(score, 4), one.cost, one.loose)
    return tuple(sorted(scored.values(), key=lambda s: (s.score, s.rule)))


def _against(kind: str, judged: dict[str, float]) -> float:
    """What the judge has against a kind."""
    return -costs().weighing.judge * judged.get(kind, min(judged.values()))


def _decide(
    readings: tuple[Scored, ...],
    judged: dict[str, float],
    reason: str | None,
    tokens: tuple[Token, ...],
) -> Query | NotUnderstood:
    if reason == "non-english":
        return Query(type="out_of_scope", reason=reason, tense="present")
    weighing = costs().weighing
    best = readings[0] if readings else None
    price = best.score if best else math.inf
    out, likeliest = _declining(judged)
    declined = weighing.judge * -out + (weighing.topic if reason else weighing.talk)
    unclear = weighing.unclear + _against(_UNCLEAR, judged)
    if best is None or min(declined, unclear) < price:
        if declined <= unclear:
            return _declined(reason or likeliest, tokens)
        return _unclear(tokens)
    close = [r for r in readings if r.score - best.score <= costs().limits.margin]
    rivals = _distinct(close)
    if len(rivals) > 1:
        shown = rivals[: costs().limits.readings]
        return NotUnderstood("ambiguous", tuple(r.query for r in shown))
    return best.query


def _declining(judged: dict[str, float]) -> tuple[float, str]:
    """The log probability that there is no answer, and the likeliest reason."""
    reasons = {reason: log for kind, log in judged.items() if (reason := reason_in(kind))}
    if not reasons:
        return -math.inf, "off-topic"
    total = math.log(sum(math.exp(log) for log in reasons.values()))
    return total, min(reasons, key=lambda reason: (-reasons[reason], reason))


def _distinct(close: list[Scored]) -> list[Scored]:
    """Close readings that would be answered about another vehicle, or with the opposite."""
    best = close[0].query
    different = [
        r
        for r in close[1:]
        if answerable(r.query)
        and answerable(best)
        and (r.query.actor != best.actor or r.query.negated != best.negated)
        and r.query.type == best.type
    ]
    return [close[0], *different]


def _deed(tokens: tuple[Token, ...]) -> str | None:
    """What the car cannot do, as "I cannot ..." takes it."""
    deeds = (t for t in tokens if t.terminal == "NOTACTION" and t.form == "base")
    return next((t.text for t in deeds), None)


def _declined(reason: str, tokens: tuple[Token, ...]) -> Query:
    deed = _deed(tokens) if reason == "not-an-action" else None
    return Query(type="out_of_scope", reason=reason, tense="present", event=deed)


def _unclear(tokens: tuple[Token, ...]) -> NotUnderstood:
    unknown = tuple(t.text for t in tokens if t.terminal == "UNKNOWN")
    return NotUnderstood("gibberish" if topics.is_gibberish(tokens) else "no-question", (), unknown)
