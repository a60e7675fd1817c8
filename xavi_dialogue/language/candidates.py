"""Candidates: the queries that a text may mean, each with what speaks against it.

Strict ones come from the grammar of questions; loose ones from the clauses alone, for each kind
of question that the judge thinks likely.
"""

from dataclasses import dataclass, replace

import lark
import msgspec

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.beam import Budget, Found, Prices, search
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.followup import resolve
from xavi_dialogue.language.grammar import STARTS
from xavi_dialogue.language.kinds import LEAN, WHICH, kind_of
from xavi_dialogue.language.lattice import Edge, Lattice
from xavi_dialogue.language.loose import as_question, clauses
from xavi_dialogue.language.readings import Reading, is_compound, read
from xavi_dialogue.language.tokens import Token

_MAX_BEGINNINGS = 5
_WEIGHTLESS = frozenset({"BREAK", "CONJ", "AND", "TIME", "SMALL", "THAT", "IT", "RUDE", "JUNCTION"})
_HELD = frozenset({"NOT", "IF"})
_RULES = {LEAN: "replace", WHICH: "what"}  # start rules of the kinds that are not named after one

_LEADING = frozenset({"AND", "OR", "ABOUT", "CONJ", "SMALL"})
_NOUNS = frozenset({"CAR", "KIND", "NUMBER", "OTHER"})
_NAMING = _NOUNS | {"THAT", "COLOUR", "PLACE", "ONLEFT", "ONRIGHT"}
_BARE = frozenset({"why", "why_not"})
_PRONOUNS = frozenset({"vehicle:it", "vehicle:that"})

Cuts = tuple[tuple[int, Edge], ...]


@dataclass(frozen=True, slots=True)
class Candidate:
    """A query, resolved against the conversation."""

    rule: str
    query: Query
    kind: str
    cost: float  # 0 is a perfect fit
    loose: bool = False


def strict(lattice: Lattice, previous: Query | None, budget: Budget) -> list[Candidate]:
    """What the grammar of questions makes of a text, within the cost limit."""
    base, limit = costs().base, costs().limits.cost
    cuts = tuple((at, edge) for at, edge in lattice.main() if not edge.is_noise)
    topic = _topic(lattice, cuts)
    found: dict[tuple[str, Query], Candidate] = {}
    for extra, one in _found(lattice, cuts, budget):
        parse = one.parse()
        after = tuple(edge.token for at, edge in cuts if at >= parse.end)
        reading = _about(topic, read(parse, after))
        query = resolve(reading, previous) if reading else None
        if reading is None or query is None:
            continue
        query = _of_topic(query, reading, topic)
        cost = reading.cost + base.get(parse.rule, 0.0) + extra + _doubt(reading)
        known = found.get((parse.rule, query))
        if cost <= limit and (known is None or cost < known.cost):
            kind = kind_of(query, previous)
            found[parse.rule, query] = Candidate(parse.rule, query, kind, cost)
    return list(found.values())


def loosely(
    lattice: Lattice, kinds: tuple[str, ...], previous: Query | None, budget: Budget
) -> list[Candidate]:
    """What the clauses of a text ask, if it is a question of one of these kinds."""
    tokens = tuple(edge.token for _, edge in lattice.main() if not edge.is_noise)
    spoken_of = previous is not None and previous.actor != "ego"
    parse = clauses(lattice, budget, spoken_of=spoken_of)
    topic = _topic(lattice, tuple((at, e) for at, e in lattice.main() if not e.is_noise))
    found: list[Candidate] = []
    for kind in kinds:
        rule = _RULES.get(kind, kind)
        if rule not in STARTS:
            continue
        shaped = as_question(rule, None if kind == WHICH else parse, tokens)
        if shaped is None:
            continue
        if kind == WHICH:
            shaped.tree.children.append(lark.Token("WHICHCAR", "unknown"))
        reading = _about(topic, read(shaped, (), checked=False))
        if reading and previous and kind in _BARE and _says_nothing(reading):
            reading = replace(reading, rule="again")  # "why?": leans on the question before
        query = resolve(reading, previous) if reading else None
        if query is None or not _fits(kind, query, reading, previous):
            continue
        cost = costs().loose.base + (reading.cost if reading else 0.0)
        found.append(Candidate(rule, query, kind, cost, loose=True))
    return found


def _says_nothing(reading: Reading) -> bool:
    """Whether it names no vehicle, no action and no cause."""
    query = reading.query
    named = reading.named_actor or query.hypothesised_cause
    return not (named or query.factual or query.counterfactual)


def _fits(kind: str, query: Query, reading: Reading | None, previous: Query | None) -> bool:
    """Whether a query is of the kind it was read as; what leans is of another one, too."""
    leans = kind == LEAN or (reading is not None and reading.rule == "again")
    return leans or kind_of(query, previous) == kind


def _topic(lattice: Lattice, cuts: Cuts) -> str | None:
    """The vehicle named first and by itself: "the truck, where is that off to?"."""
    marks = [index for index, (_, edge) in enumerate(cuts) if edge.token.terminal == "BREAK"]
    if not marks:
        return None
    begin = next((i for i, (_, e) in enumerate(cuts) if e.token.terminal not in _LEADING), 0)
    named = {edge.token.terminal for _, edge in cuts[begin : marks[0]]}
    if not named & _NOUNS or not named <= _NAMING:
        return None
    prices = Prices({}, None, 0.5)
    span = cuts[begin][0], cuts[marks[0]][0]
    found = search("replace", lattice, span[0], frozenset(span[1:]), prices, Budget(100))
    reading = read(found[0].parse(), ()) if found else None
    return reading.query.actor if reading else None


def _of_topic(query: Query, reading: Reading, topic: str | None) -> Query:
    """A bare "why not?" behind a vehicle named first asks about that vehicle."""
    if topic is None or reading.rule != "again":
        return query
    return msgspec.structs.replace(query, actor=topic)


def _about(topic: str | None, reading: Reading | None) -> Reading | None:
    """The reading with the vehicle named first in the place of a pronoun."""
    if reading is None or topic is None or reading.query.actor not in _PRONOUNS:
        return reading
    query = msgspec.structs.replace(reading.query, actor=topic)
    return replace(reading, query=query, named_actor=True)


def _doubt(reading: Reading) -> float:
    """Readings that say little need more to be believed."""
    return 0.3 if reading.query.actor == "vehicle:that" and not reading.named_actor else 0.0


def _found(lattice: Lattice, cuts: Cuts, budget: Budget) -> list[tuple[float, Found]]:
    """The cheapest ways to read a text, each with what the words around the question cost."""
    limits = costs().limits
    all_found: list[tuple[float, Found]] = []
    for index in _beginnings(tuple(edge.token for _, edge in cuts)):
        begin = cuts[index][0]
        ends = frozenset({*_ends(cuts, index), len(lattice.edges)})
        before = _before(cuts, index)
        prices = Prices(costs().skip, None, limits.cost - before)
        for rule in STARTS:
            for found in search(rule, lattice, begin, ends, prices, budget):
                extra = before + _behind(tuple(e.token for at, e in cuts if at >= found.end))
                if found.cost + extra <= limits.cost:
                    all_found.append((extra, found))
    all_found.sort(key=lambda one: one[0] + one[1].cost)
    return all_found[: limits.found]


def _beginnings(tokens: tuple[Token, ...]) -> list[int]:
    after, at = costs().boundary.begin_after, costs().boundary.begin_at
    found = [
        index
        for index, token in enumerate(tokens)
        if index == 0 or tokens[index - 1].terminal in after or token.terminal in at
    ]
    return found if len(found) <= _MAX_BEGINNINGS else [0, *found[1 - _MAX_BEGINNINGS :]]


def _ends(cuts: Cuts, begin: int) -> list[int]:
    before = costs().boundary.end_before
    return [at for at, edge in cuts[begin + 1 :] if edge.token.terminal in before]


def _before(cuts: Cuts, begin: int) -> float:
    """What the words before the question cost."""
    prices = costs().outside
    words = sum(edge.token.terminal not in _WEIGHTLESS for _, edge in cuts[:begin])
    follows = costs().boundary.begin_after
    midway = begin > 0 and not follows & set(cuts[begin - 1][1].token.terminals)
    return min(words * prices.before, prices.before_limit) + (prices.midway if midway else 0.0)


def _behind(after: tuple[Token, ...]) -> float:
    """What the words behind the question cost."""
    prices = costs().outside
    if is_compound(after):
        return prices.compound
    held = prices.held * sum(t.terminal in _HELD for t in after)
    if after and "SUBORD" in after[0].terminals:
        return prices.subordinate + held
    words = sum(t.terminal not in _WEIGHTLESS for t in after)
    return min(words * prices.after, prices.after_limit) + held
