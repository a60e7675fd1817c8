"""Candidates: the queries that a text may mean, each with what speaks against it.

Strict ones come from the grammar of questions; loose ones from the clauses alone, for each kind
of question that the judge thinks likely.
"""

from dataclasses import dataclass, field, replace

import lark

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.beam import Budget, Found, Prices, search
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.followup import resolve
from xavi_dialogue.language.grammar import STARTS, Tree
from xavi_dialogue.language.kinds import LEAN, WHICH, kind_of
from xavi_dialogue.language.lattice import Cuts, Lattice
from xavi_dialogue.language.loose import as_question, clauses
from xavi_dialogue.language.named import about_named, named_first, of_named
from xavi_dialogue.language.readings import Reading, is_compound, read
from xavi_dialogue.language.tokens import Token

_MAX_BEGINNINGS = 5
_WEIGHTLESS = frozenset({"BREAK", "CONJ", "AND", "TIME", "SMALL", "THAT", "IT", "RUDE", "JUNCTION"})
_HELD = frozenset({"NOT", "IF"})
_RULES = {LEAN: "replace", WHICH: "what"}  # start rules of the kinds that are not named after one

_BARE = frozenset({"why", "why_not"})


@dataclass(frozen=True, slots=True)
class Candidate:
    """A query, resolved against the conversation."""

    rule: str
    query: Query
    kind: str
    cost: float  # 0 is a perfect fit
    loose: bool = False
    tree: Tree | None = field(default=None, compare=False, repr=False)  # what the grammar read


def strict(lattice: Lattice, previous: Query | None, budget: Budget) -> list[Candidate]:
    """What the grammar of questions makes of a text, within the cost limit."""
    base, limit = costs().base, costs().limits.cost
    cuts = lattice.cuts()
    topic = named_first(lattice, cuts)
    found: dict[tuple[str, Query], Candidate] = {}
    whole: dict[tuple[str, Query], Candidate] = {}
    for extra, one in _found(lattice, cuts, budget):
        parse = one.parse()
        after = tuple(edge.token for at, edge in cuts if at >= parse.end)
        reading = about_named(topic, read(parse, after))
        query = resolve(reading, previous) if reading else None
        if reading is None or query is None:
            continue
        query = of_named(query, reading, topic)
        cost = reading.cost + base.get(parse.rule, 0.0) + extra + _doubt(reading)
        known = found.get((parse.rule, query))
        if cost <= limit and (known is None or cost < known.cost):
            kind = kind_of(query, previous)
            leans = kind == LEAN and parse.rule == query.type
            if leans and _says_nothing(reading):
                kind = query.type  # it is worded as such, whatever was asked before
            new = Candidate(parse.rule, query, kind, cost, tree=parse.tree)
            found[parse.rule, query] = new
            if leans and _is_whole(reading):
                whole[parse.rule, query] = replace(new, kind=query.type)
    return [*found.values(), *whole.values()]


def _is_whole(reading: Reading) -> bool:
    """Whether it says who did what, or lays it to somebody: "why did it stop?" is a question.

    That it is like the one before, "why did vehicle 1 slow down?", makes it no mere follow-up. And
    "what is it doing?" asks all there is to ask.
    """
    query = reading.query
    told = query.factual or query.counterfactual or query.type == "what"
    return reading.laid if query.hypothesised_cause else bool(told and reading.named_actor)


def loosely(
    lattice: Lattice, kinds: tuple[str, ...], previous: Query | None, budget: Budget
) -> list[Candidate]:
    """What the clauses of a text ask, if it is a question of one of these kinds."""
    cuts = lattice.cuts()
    tokens = tuple(edge.token for _, edge in cuts)
    spoken_of = previous is not None and previous.actor != "ego"
    parse = clauses(lattice, budget, spoken_of=spoken_of)
    parsed = parse.tree if parse is not None else None
    topic = named_first(lattice, cuts)
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
        reading = about_named(topic, read(shaped, (), checked=False))
        if reading is None:
            continue
        if previous and kind in _BARE and _says_nothing(reading):
            reading = replace(reading, rule="again")  # "why?": leans on the question before
        query = resolve(reading, previous)
        if query is not None and _fits(kind, query, reading, previous):
            cost = costs().loose.base + reading.cost
            found.append(Candidate(rule, query, kind, cost, loose=True, tree=parsed))
    return found


def _says_nothing(reading: Reading) -> bool:
    """Whether it names no vehicle, no action and no cause."""
    query = reading.query
    named = reading.named_actor or query.hypothesised_cause
    return not (named or query.factual or query.counterfactual)


def _fits(kind: str, query: Query, reading: Reading, previous: Query | None) -> bool:
    """Whether a query is of the kind it was read as; what leans is of another one, too."""
    leans = kind == LEAN or reading.rule == "again"
    return leans or kind_of(query, previous) == kind


def _doubt(reading: Reading) -> float:
    """Readings that say little need more to be believed."""
    return 0.3 if reading.query.actor == "vehicle:that" and not reading.named_actor else 0.0


def _found(lattice: Lattice, cuts: Cuts, budget: Budget) -> list[tuple[float, Found]]:
    """The cheapest ways to read a text, each with what the words around the question cost."""
    limits = costs().limits
    all_found: list[tuple[float, Found]] = []
    for index in _beginnings(tuple(edge.token for _, edge in cuts)):
        begin = cuts[index][0]
        laid = index > 0 and cuts[index - 1][1].token.terminal == "BECAUSE"
        ends = frozenset({*_ends(cuts, index), len(lattice.edges)})
        before = _before(cuts, index)
        prices = Prices(costs().skip, None, limits.cost - before)
        for rule in STARTS:
            if laid and rule == "replace":
                continue  # "because of vehicle 2?" puts no vehicle into the question before
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
