"""Lattice: the words that a text may consist of, between numbered nodes.

A token may have been meant as several words, and as several different ones; each alternative is
a path from the node before the token to the node behind it, at a cost.
"""

import re
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import product

from xavi_dialogue.nlu.text.spelling import Vocabulary, corrections
from xavi_dialogue.nlu.text.tables import apart, homophones, load
from xavi_dialogue.nlu.text.tokens import Typed

HOMOPHONE = 0.6
HEARD = 0.3  # the same, where words are read by ear
CONFUSED = 0.2  # of words often mistaken for each other, the one typed being rare
PHONE = 0.15
LATER = 0.1  # cost of each further expansion of a contraction
PLURAL_GENITIVE = 0.45  # "the blue cars fault"
APART = 0.3  # a word typed as two that are words: "over take"
TORN = 0.1  # ... of which one at least is none: "st opping"
_NUMBER = re.compile(r"\d+(?:[.,]\d+)?")
_CLOCK = re.compile(r"\d{1,3}:\d{2}")
_SUFFIXES: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("n't", ("not",)),
    ("'re", ("are",)),
    ("'ve", ("have",)),
    ("'ll", ("will",)),
    ("'m", ("am",)),
    ("'s", ("is", "'s", "has")),
    ("'d", ("had", "would")),
)
_DID_HEADS = frozenset({"why", "how", "where", "what", "when"})

_PREFIXES = ("un", "in", "im", "dis", "re", "over", "under", "mis", "non", "pre", "out")
_ENDINGS = ("s", "es", "ed", "d", "ing", "er", "ers", "est", "ly", "able", "ible", "ness", "ment",
            "ful", "less", "ish", "y", "ity", "ion", "ation")  # fmt: skip

#: Words that "to" and a verb often follow, so that "too" and "two" behind them are misspelt.
_GOVERNING = frozenset(
    ("going", "want", "wanted", "need", "needed", "have", "had", "has", "trying", "supposed",
     "about", "able", "allowed", "got", "used", "ready", "meant")
)  # fmt: skip
_TO = frozenset(("too", "two"))
_EXITS = frozenset({"out", "exit", "off", "ramp"})
TYPED_NUMBER = 0.05  # cost of "#2" as the number alone: "car #2"
SHORTEST = 4  # letters of a word that may have been typed as two
_DRAWN = re.compile(r"([a-z])\1\1+")

Alternative = tuple[tuple[str, ...], float]


@dataclass(frozen=True, slots=True)
class Edge:
    """A word that may stand between two nodes."""

    end: int
    word: str
    cost: float
    tokens: tuple[int, ...]


@dataclass(slots=True)
class Lattice:
    """Word edges by the node where they start; `marks` are clause marks by node."""

    edges: list[list[Edge]] = field(default_factory=list)
    marks: dict[int, str] = field(default_factory=dict)  # node before the mark -> "," "." "?"
    tokens: tuple[str, ...] = ()
    end_mark: str = ""
    misspelling: float = 0.0  # what every way to read the text costs for its spelling

    @property
    def size(self) -> int:
        """The number of the last node."""
        return len(self.edges) - 1


def build(
    typed: Typed, vocabulary: Vocabulary, nouns: frozenset[str], *, by_ear: bool = False
) -> Lattice:
    """Lay out the alternatives of every token; by ear, words that sound alike are cheap."""
    lattice = Lattice(edges=[[]], tokens=tuple(t.text for t in typed.tokens), end_mark=typed.end)
    before = 0
    for index, token in enumerate(typed.tokens):
        if token.mark and index:
            lattice.marks[len(lattice.edges) - 1] = token.mark
            lattice.edges.append([])
        start = len(lattice.edges) - 1
        found = alternatives(token.text, vocabulary, nouns)
        if index and token.text in _TO and typed.tokens[index - 1].text in _GOVERNING:
            found = tuple((w, PHONE if w == ("to",) else cost) for w, cost in found)
        if by_ear:
            found = _by_ear(token.text, found)
        end = start + max(len(words) for words, _ in found)
        lattice.edges.extend([] for _ in range(end - start))
        for words, cost in found:
            _lay(lattice, start, end, words, cost, (index,))
        if index and not token.mark:
            for words, cost in _in_one(typed.tokens[index - 1].text, token.text, vocabulary):
                _lay(lattice, before, end, words, cost, (index - 1, index))
        lattice.misspelling += _least(found, vocabulary)
        before = start
    return lattice


def _least(found: tuple[Alternative, ...], vocabulary: Vocabulary) -> float:
    """Say what the cheapest row of words with a sense costs for spelling."""
    costs = [cost for words, cost in found if all(vocabulary.words.get(w, 1) == 0 for w in words)]
    return min(costs, default=0.0)


def _in_one(first: str, second: str, vocabulary: Vocabulary) -> list[Alternative]:
    """List what two tokens are in one, where a space was typed within a word."""
    word = first + second
    if len(word) < SHORTEST or not word.isalpha():
        return []
    known = all(part in vocabulary.words for part in (first, second))
    if vocabulary.words.get(word) == 0:
        return [((word,), (APART if known else TORN) + vocabulary.rarity(word))]
    return [] if known else _listed("contractions", word, TORN)


def _by_ear(token: str, found: tuple[Alternative, ...]) -> tuple[Alternative, ...]:
    """Make words that sound like a token cheap, those behind an unwritten apostrophe too."""
    if token in load("nlu_text.toml")["numbers"]:
        return found
    unwritten = [(words, HEARD) for words in apart().get(token, ())]
    return (*((words, min(cost, HEARD)) for words, cost in found), *unwritten)


def _lay(
    lattice: Lattice,
    start: int,
    end: int,
    words: tuple[str, ...],
    cost: float,
    tokens: tuple[int, ...],
) -> None:
    for step, word in enumerate(words):
        last = step == len(words) - 1
        target = end if last else start + step + 1
        edges = lattice.edges[start + step]
        edge = Edge(target, word, cost if step == 0 else 0.0, tokens)
        if not any(e.end == target and e.word == word and e.cost <= edge.cost for e in edges):
            edges.append(edge)


@lru_cache(maxsize=8192)
def alternatives(
    token: str, vocabulary: Vocabulary, nouns: frozenset[str]
) -> tuple[Alternative, ...]:
    """List the word rows that a token may have been meant as; never empty."""
    if _NUMBER.fullmatch(token) or _CLOCK.fullmatch(token):
        plain: list[Alternative] = [((token,), 0.0)]
        return tuple(plain + _sounding(token))
    if token.startswith("#"):
        return ((("number", token[1:]), 0.0), ((token[1:],), TYPED_NUMBER))
    known = vocabulary.words
    if "_" in token:
        return (((_named(token, vocabulary),), 0.0),)
    token = _drawn_out(token, vocabulary)
    found: list[Alternative] = []
    found += _listed("contractions", token, 0.0)
    found += _listed("phone", token, PHONE)
    if token in known:
        rare = token in load("nlu_text.toml")["confused"]
        found.append(((token,), CONFUSED if rare else 0.0))
        found += _sounding(token)
    elif "'" in token:
        found += _contracted(token, vocabulary, nouns)
    elif "-" in token:
        found += _hyphened(token, vocabulary)
    if token.endswith("ies") and token[:-3] + "y" in nouns:
        found.append(((token[:-3] + "y", "'s"), PLURAL_GENITIVE))
    if token.endswith("s") and token[:-1] in nouns:
        found.append(((token[:-1], "'s"), PLURAL_GENITIVE))
    if not found:
        found = [(words, PHONE) for words, _ in _sounding(token)]
    if not found:
        found = _corrected(token, vocabulary)
    if not any(words == (token,) for words, _ in found):
        found.append(((token,), 0.0 if token not in known else HOMOPHONE))
    return tuple(found)


def is_strange(token: str, vocabulary: Vocabulary) -> bool:
    """Say whether a token is no word that is known, nor a misspelt one, nor made of one."""
    return not _is_derived(token, vocabulary) and not any(
        all(word in vocabulary.words or word[0].isdigit() or word[0] == "'" for word in words)
        for words, _ in alternatives(token, vocabulary, frozenset())
    )


def _is_derived(token: str, vocabulary: Vocabulary) -> bool:
    """Say whether a word is made of one that is known: "unloading", "acceptable"."""
    stems = {token, *(token.removeprefix(prefix) for prefix in _PREFIXES)}
    for stem in tuple(stems):
        for ending in _ENDINGS:
            if stem.endswith(ending) and len(stem) > len(ending) + 2:
                bare = stem.removesuffix(ending)
                stems |= {bare, bare + "e", bare[:-1] if bare[-1] == bare[-2] else bare}
                stems.add(bare[:-1] + "y" if bare[-1] == "i" else bare)
    return any(stem in vocabulary.words for stem in stems if len(stem) > 2)


def _named(token: str, vocabulary: Vocabulary) -> str:
    """Read the name of an edge of the map, "south_out", as the exit or road that it is."""
    parts = token.split("_")
    if any(part in _EXITS for part in parts):
        return "exit"
    return next((part for part in parts if vocabulary.words.get(part) == 0), token)


def _drawn_out(token: str, vocabulary: Vocabulary) -> str:
    """Write a letter once or twice that was typed more often: "sooo", "heyyy"."""
    if token in vocabulary.words or _DRAWN.search(token) is None:
        return token
    shorter = (_DRAWN.sub(r"\1\1", token), _DRAWN.sub(r"\1", token))
    return next((word for word in shorter if word in vocabulary.words), token)


def _listed(table: str, token: str, cost: float) -> list[Alternative]:
    listed = load("nlu_text.toml")[table].get(token)
    if listed is None:
        return []
    return [
        (tuple(full.split()), cost + LATER * rank) for rank, full in enumerate(listed.split("|"))
    ]


def _corrected(token: str, vocabulary: Vocabulary) -> list[Alternative]:
    """List what a word that is none may have been; "dotn" as what "dont" is short for."""
    found: list[Alternative] = []
    for words, guessed in corrections(token, vocabulary):
        for row in product(*map(_meant, words)):
            full = tuple(word for part, _ in row for word in part)
            found.append((full, guessed + sum(cost for _, cost in row)))
    return found


def _meant(word: str) -> list[Alternative]:
    """List what a guessed word stands for: itself, one that sounds alike, or several."""
    return _listed("contractions", word, 0.0) or [((word,), 0.0), *_sounding(word)[:1]]


def _sounding(token: str) -> list[Alternative]:
    found = _listed("confused", token, CONFUSED) + _listed("homophones", token, HOMOPHONE)
    return found or [((meant,), CONFUSED) for meant in homophones().get(token, ())]


def _contracted(token: str, vocabulary: Vocabulary, nouns: frozenset[str]) -> list[Alternative]:
    for suffix, full in _SUFFIXES:
        if not token.endswith(suffix) or len(token) == len(suffix):
            continue
        head = token.removesuffix(suffix)
        if suffix == "'d" and head in _DID_HEADS:
            full = ("did", "would", "had")
        heads = alternatives(head, vocabulary, nouns)[:2]
        return [
            ((*words, short), cost + LATER * rank)
            for words, cost in heads
            for rank, short in enumerate(full)
        ]
    joined = token.replace("'", "")
    if joined in vocabulary.words:
        return [((joined,), 0.0)]
    listed = _listed("contractions", joined, 0.0)
    return listed or [(tuple(part for part in token.split("'") if part) or (token,), 0.3)]


def _hyphened(token: str, vocabulary: Vocabulary) -> list[Alternative]:
    parts = tuple(part for part in token.split("-") if part)
    joined = "".join(parts)
    if joined in vocabulary.words:
        return [((joined,), 0.0), (parts, 0.05)]
    words: list[str] = []
    for part in parts:
        if part in vocabulary.words or not (near := corrections(part, vocabulary)):
            words.append(part)
        else:
            words.extend(near[0][0])
    return [(tuple(words) or (token,), 0.0)]
