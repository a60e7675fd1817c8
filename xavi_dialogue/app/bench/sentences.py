"""Sentences drawn from the question grammar: its rules, and phrases of the word lists."""

from functools import cache
from random import Random

from lark.grammar import Rule, Symbol

from xavi_dialogue.language.grammar import CLAUSES, STARTS, grammar
from xavi_dialogue.language.wordlists import vocabulary

DEEPEST = 12  # rules within rules; below, the shortest expansion is taken
_BUILTIN: dict[str, tuple[str, ...]] = {
    "BREAK": (",",),
    "NUMBER": (*"01234579", "12", "42"),
    "UNKNOWN": ("zorp",),
}
_GO_ON = 0.5  # probability of a longer phrase, where one ends already


def sentence(rng: Random) -> str:
    """A sentence of one of the start rules, drawn at random."""
    start = rng.choice((*STARTS, CLAUSES))
    return " ".join(phrase(rng, terminal) for terminal in _terminals(rng, start, 0))


def phrase(rng: Random, terminal: str) -> str:
    """A phrase that stands for a terminal, drawn from the word lists from its end on."""
    if terminal in _BUILTIN:
        return rng.choice(_BUILTIN[terminal])
    phrases = vocabulary().phrases
    position = rng.choice(_last()[terminal])
    words: list[str] = []
    while True:
        words.append(rng.choice(_words()[position]))
        before = _before()[position]
        begins = position in _first()
        if not before or (begins and rng.random() > _GO_ON) or len(words) > len(phrases.accepts):
            return " ".join(reversed(words))
        position = rng.choice(before)


def _terminals(rng: Random, name: str, depth: int) -> list[str]:
    """The terminals of a random expansion of a rule."""
    rules = _rules()[name]
    if depth >= DEEPEST:
        rules = rules[:1]
    found: list[str] = []
    for symbol in rng.choice(rules).expansion:
        if symbol.is_term:
            found.append(symbol.name)
        else:
            found += _terminals(rng, symbol.name, depth + 1)
    return found


@cache
def _rules() -> dict[str, list[Rule]]:
    """The expansions of each rule, the one that ends soonest first."""
    rules: dict[str, list[Rule]] = {}
    for rule in grammar().rules:
        rules.setdefault(rule.origin.name, []).append(rule)
    height: dict[str, int] = {}  # rules within rules, at least

    def height_of(rule: Rule) -> int | None:
        below = [_height(symbol, height) for symbol in rule.expansion]
        return None if None in below else 1 + max((h for h in below if h is not None), default=0)

    while len(height) < len(rules):
        for name, expansions in rules.items():
            known = [h for h in map(height_of, expansions) if h is not None]
            if name not in height and known:
                height[name] = min(known)
    for expansions in rules.values():
        expansions.sort(key=lambda rule: height_of(rule) or 0)
    return rules


def _height(symbol: Symbol, height: dict[str, int]) -> int | None:
    return 0 if symbol.is_term else height.get(symbol.name)


@cache
def _last() -> dict[str, list[int]]:
    """The positions at which phrases of a terminal end."""
    ends: dict[str, list[int]] = {}
    for position, (_, sense) in sorted(vocabulary().phrases.ends.items()):
        ends.setdefault(sense.terminal, []).append(position)
    return ends


@cache
def _before() -> list[list[int]]:
    """The positions that may stand before each."""
    follow = vocabulary().phrases.follow
    before: list[list[int]] = [[] for _ in follow]
    for position, behind in enumerate(follow):
        for one in sorted(behind):
            before[one].append(position)
    return before


@cache
def _first() -> frozenset[int]:
    """The positions at which phrases begin."""
    return frozenset().union(*vocabulary().phrases.first.values())


@cache
def _words() -> list[list[str]]:
    """The words of each position."""
    return [sorted(words) for words in vocabulary().phrases.accepts]
