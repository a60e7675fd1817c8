"""Decide: which of the candidates is meant, if any.

A candidate's score is its cost by the grammar plus what the judge has against its kind. It wins
where it is the lowest of all, and lower than the price of declining and that of asking back.
"""

import math

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language import topics
from xavi_dialogue.language.candidates import Candidate
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.followup import answerable
from xavi_dialogue.language.kinds import reason_in
from xavi_dialogue.language.lattice import Lattice
from xavi_dialogue.language.malformed import lacking
from xavi_dialogue.language.report import Cause, NotUnderstood, Scored
from xavi_dialogue.language.tokens import Token

_UNCLEAR = "ambiguous"
_FOREIGN = "non-english"
_SENTENCE = 3  # words in no list that make a sentence of another language, and not a slip
_CAUSES: dict[str | None, Cause] = {
    "no-action": "no-action",
    "no-condition": "no-condition",
    "no-alternative": "no-alternative",
}


def weigh(candidates: list[Candidate], judged: dict[str, float]) -> tuple[Scored, ...]:
    """The candidates with their scores, likeliest first, each query once."""
    scored: dict[Query, Scored] = {}
    for one in candidates:
        score = one.cost + _against(one.kind, judged)
        known = scored.get(one.query)
        if known is None or score < known.score:
            score = round(score, 4)
            scored[one.query] = Scored(one.rule, one.query, score, one.cost, one.loose, one.tree)
    return tuple(sorted(scored.values(), key=lambda s: (s.score, s.rule)))


def decide(
    readings: tuple[Scored, ...], judged: dict[str, float], topic: str | None, lattice: Lattice
) -> Query | NotUnderstood:
    """The query that is meant, or why none is.

    Args:
        readings: what the text may mean, likeliest first.
        judged: log probability of every kind.
        topic: a reason to decline that its words show.
        lattice: the text.
    """
    tokens = tuple(edge.token for _, edge in lattice.main())
    if topic == _FOREIGN:
        return _declined(topic, tokens)
    weighing = costs().weighing
    out, likeliest = _declining(judged)
    declined = weighing.judge * -out + (weighing.topic if topic else weighing.talk)
    unclear = weighing.unclear + _against(_UNCLEAR, judged)
    price = readings[0].score if readings else math.inf
    if price <= min(declined, unclear):
        return _best(readings)
    reason = topic or likeliest
    if declined > unclear or (reason == _FOREIGN and _unknown(tokens) < _SENTENCE):
        return _unclear(readings, lattice, tokens)
    return _declined(reason, tokens)


def _against(kind: str, judged: dict[str, float]) -> float:
    """What the judge has against a kind."""
    return -costs().weighing.judge * judged.get(kind, min(judged.values()))


def _declining(judged: dict[str, float]) -> tuple[float, str]:
    """The log probability that there is no answer, and the likeliest reason."""
    reasons = {reason: log for kind, log in judged.items() if (reason := reason_in(kind))}
    total = math.log(sum(math.exp(log) for log in reasons.values()))
    return total, min(reasons, key=lambda reason: (-reasons[reason], reason))


def _best(readings: tuple[Scored, ...]) -> Query | NotUnderstood:
    """The likeliest reading, unless others as likely mean something else."""
    limits = costs().limits
    best = readings[0]
    close = [r for r in readings[1:] if r.score - best.score <= limits.margin]
    rivals = [r.query for r in close if _rival(best.query, r.query)]
    if rivals:
        return NotUnderstood("ambiguous", (best.query, *rivals)[: limits.readings])
    return best.query


def _rival(best: Query, other: Query) -> bool:
    """Whether it would be answered about another vehicle, or with the opposite."""
    if not (answerable(best) and answerable(other)) or other.type != best.type:
        return False
    return other.actor != best.actor or other.negated != best.negated


def _declined(reason: str, tokens: tuple[Token, ...]) -> Query:
    deed = _deed(tokens) if reason == "not-an-action" else None
    return Query(type="out_of_scope", reason=reason, tense="present", event=deed)


def _deed(tokens: tuple[Token, ...]) -> str | None:
    """What the car cannot do, as "I cannot ..." takes it."""
    deeds = (t for t in tokens if t.terminal == "NOTACTION" and t.form == "base")
    return next((t.text for t in deeds), None)


def _unclear(
    readings: tuple[Scored, ...], lattice: Lattice, tokens: tuple[Token, ...]
) -> NotUnderstood:
    """What the text lacks, and what it may have been meant to be."""
    hints = tuple(t.text for t in tokens if t.terminal == "UNKNOWN")
    if topics.is_gibberish(tokens):
        return NotUnderstood("gibberish", hints=hints)
    limits = costs().limits
    likely = [r.query for r in readings if r.score <= limits.offer and answerable(r.query)]
    cause = _CAUSES.get(lacking(lattice), "no-question")
    return NotUnderstood(cause, tuple(likely[: limits.readings]), hints)


def _unknown(tokens: tuple[Token, ...]) -> int:
    return sum(t.terminal == "UNKNOWN" for t in tokens)
