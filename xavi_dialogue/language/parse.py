"""Parse: text -> Query | NotUnderstood.

Normalise, tokenise, let every start rule of the grammar read the tokens, rank the readings by
what they had to leave out, resolve the best against the conversation. Where two readings that
mean different things lie within the margin, or none makes sense, the text is not understood;
the parser rather asks than guesses. Pure and deterministic.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language import topics
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.followup import answerable, resolve
from xavi_dialogue.language.grammar import STARTS, Parse, parses
from xavi_dialogue.language.normalise import MAX_INPUT, Normalised, normalise
from xavi_dialogue.language.readings import Reading, is_compound, read
from xavi_dialogue.language.tokens import Token, Tokenised, tokenise

MAX_CONTEXT = 6  # earlier turns looked at
_MAX_BEGINNINGS = 5
_WEIGHTLESS = frozenset({"BREAK", "CONJ", "AND", "TIME", "SMALL", "THAT", "IT", "RUDE", "JUNCTION"})

_HELD = frozenset({"NOT", "IF"})

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
    score: float  # cost: 0 is a perfect fit


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

    def __init__(self) -> None:
        _explain("why did yuo stop?", None, frozenset())  # build all tables before the first answer

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
        return _explain(text, _last_question(context[-MAX_CONTEXT:], vehicles), vehicles)


def as_query(result: Query | NotUnderstood) -> Query:
    """A query in any case: what was not understood is an ambiguous one."""
    return result if isinstance(result, Query) else Query(type="ambiguous", tense="present")


def _last_question(context: tuple[str, ...], vehicles: frozenset[int]) -> Query | None:
    """The last answerable query among the earlier turns, each resolved against those before."""
    previous: Query | None = None
    for turn in context:
        result = _explain(turn, previous, vehicles).result
        if isinstance(result, Query) and answerable(result):
            previous = result
    return previous


@lru_cache(maxsize=512)  # the turns of a conversation are read again with each new one
def _explain(text: str, previous: Query | None, vehicles: frozenset[int]) -> ParseReport:
    if len(text) > MAX_INPUT:
        return ParseReport((), (), True, (), NotUnderstood("too-long"))
    normalised = normalise(text)
    tokenised = tokenise(normalised, vehicles)
    if not normalised.words:
        return ParseReport((), (), False, (), NotUnderstood("empty"))
    readings = _readings(tokenised.heard, previous)
    result = _decide(readings, normalised, tokenised)
    return ParseReport(
        tokenised.tokens, tokenised.corrections, normalised.shortened, readings, result
    )


def _readings(tokens: tuple[Token, ...], previous: Query | None) -> tuple[Scored, ...]:
    """All readings within the cost limit, likeliest first."""
    scored: dict[tuple[str, Query], Scored] = {}
    limit, base = costs().limits.cost, costs().base
    for begin in _beginnings(tokens):
        ends = frozenset(_ends(tokens, begin))
        for rule in STARTS:
            for found in parses(rule, tokens, begin, ends):
                reading = read(found, tokens)
                query = resolve(reading, previous) if reading else None
                if reading is None or query is None:
                    continue
                cost = reading.cost + base.get(rule, 0.0) + _outside(found, tokens)
                cost += _doubt(reading)
                known = scored.get((rule, query))
                if cost <= limit and (known is None or cost < known.score):
                    scored[rule, query] = Scored(rule, query, round(cost, 4))
    order = {rule: index for index, rule in enumerate(STARTS)}
    return tuple(sorted(scored.values(), key=lambda s: (s.score, order[s.rule])))


def _doubt(reading: Reading) -> float:
    """Readings that say little need more to be believed."""
    return 0.3 if reading.query.actor == "vehicle:that" and not reading.named_actor else 0.0


def _beginnings(tokens: tuple[Token, ...]) -> list[int]:
    after, at = costs().boundary.begin_after, costs().boundary.begin_at
    found = [
        index
        for index, token in enumerate(tokens)
        if index == 0 or tokens[index - 1].terminal in after or token.terminal in at
    ]
    return found if len(found) <= _MAX_BEGINNINGS else [0, *found[1 - _MAX_BEGINNINGS :]]


def _ends(tokens: tuple[Token, ...], begin: int) -> list[int]:
    before = costs().boundary.end_before
    return [i for i in range(begin + 1, len(tokens)) if tokens[i].terminal in before]


def _outside(found: Parse, tokens: tuple[Token, ...]) -> float:
    """What the words before and behind the question cost."""
    prices = costs().outside
    before = sum(t.terminal not in _WEIGHTLESS for t in tokens[: found.begin])
    after = sum(t.terminal not in _WEIGHTLESS for t in tokens[found.end :])
    behind = min(after * prices.after, prices.after_limit)
    if found.end < len(tokens) and "SUBORD" in tokens[found.end].terminals:
        behind = prices.subordinate
    if is_compound(found.end, tokens):
        behind = prices.compound
    else:
        behind += prices.held * sum(t.terminal in _HELD for t in tokens[found.end :])
    follows = costs().boundary.begin_after
    midway = found.begin > 0 and not follows & set(tokens[found.begin - 1].terminals)
    return (
        min(before * prices.before, prices.before_limit)
        + behind
        + (prices.midway if midway else 0.0)
    )


def _decide(
    readings: tuple[Scored, ...], normalised: Normalised, tokenised: Tokenised
) -> Query | NotUnderstood:
    reason = topics.reason_for(tokenised.tokens, normalised.words)
    if reason == "non-english":
        return Query(type="out_of_scope", reason=reason, tense="present")
    best = readings[0] if readings else None
    if best is None or (reason is not None and best.score > costs().limits.decline):
        return _decline(reason, tokenised)
    close = [r for r in readings if r.score - best.score <= costs().limits.margin]
    rivals = _distinct(close)
    if len(rivals) > 1:
        shown = rivals[: costs().limits.readings]
        return NotUnderstood("ambiguous", tuple(r.query for r in shown))
    return best.query


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


def _deed(tokenised: Tokenised) -> str | None:
    """What the car cannot do, as "I cannot ..." takes it."""
    deeds = (t for t in tokenised.tokens if t.terminal == "NOTACTION" and t.form == "base")
    return next((t.text for t in deeds), None)


def _decline(reason: str | None, tokenised: Tokenised) -> Query | NotUnderstood:
    if reason is not None:
        deed = _deed(tokenised) if reason == "not-an-action" else None
        return Query(type="out_of_scope", reason=reason, tense="present", event=deed)
    unknown = tuple(t.text for t in tokenised.tokens if t.terminal == "UNKNOWN")
    if topics.is_gibberish(tokenised.tokens):
        return NotUnderstood("gibberish", hints=unknown)
    if topics.is_elsewhere(tokenised.tokens):
        return Query(type="out_of_scope", reason="off-topic", tense="present")
    return NotUnderstood("no-question", hints=unknown)
