"""Lexicon: words and phrases with their word classes and senses, found in a lattice.

Word classes are the terminals of the grammar. A phrase of several words is one leaf.
"""

import re
from collections import Counter
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from xavi_dialogue.nlu.grammar.inflect import past_forms, plural, verb_forms
from xavi_dialogue.nlu.text.lattice import Edge, Lattice
from xavi_dialogue.nlu.text.spelling import Vocabulary
from xavi_dialogue.nlu.text.tables import english, load, phrases

_NUMBER = re.compile(r"[0-9]+(?:[.,:][0-9]+)?")
NOUNS = frozenset({"KIND", "PLACEN", "MEAS", "EVN", "ABS", "UNIT", "TUNIT", "RIDE", "TIMES"})
VERB_CLASSES = {"base": "V", "third": "V", "past": "VPAST", "part": "VED", "ing": "VING"}
LATER_SENSE = 0.15  # cost of a phrase marked "*"
UNKNOWN = 1.0  # cost of a word without a sense
SKIPPED = 1.6  # cost of a word with senses of which none is taken
AUXILIARY = 0.03  # what "want to" is cheaper by than the verb and its infinitive
LONGER = 0.15  # what a kind in several words is cheaper by than the words apart
FILLER = 0.35  # cost of a function word that is read past
AUXILIARIES = {"do": 0.1, "have": 0.2}  # cost as verbs in their own right
ADJECTIVAL = 0.06  # cost of a verb form that is an adjective too
MEASURED = 0.2  # cost of a bare verb that is the name of a measure too: "speed"
OWNERS = ("my", "our", "your", "his", "her", "its", "their", "the")
HEARD = 0.14  # cost of a number that sounds like another word: "two"
DEEDS = 0.05  # cost of "decisions" as a deed rather than as what is listed
PHRASE = 0.02  # what a phrase is cheaper by for each word after its first


@dataclass(frozen=True, slots=True, eq=False)
class Leaf:
    """A word or phrase in one word class, between two nodes of the lattice."""

    category: str
    key: str
    form: str
    words: tuple[str, ...]
    tokens: tuple[int, ...]
    start: int
    end: int
    cost: float


@dataclass(frozen=True, slots=True)
class Entry:
    """What a phrase may be: its word class, its key there, its form."""

    category: str
    key: str
    form: str = ""
    cost: float = 0.0


@dataclass(slots=True)
class Trie:
    """Phrases by their words."""

    following: dict[str, "Trie"] = field(default_factory=dict)
    entries: list[Entry] = field(default_factory=list)

    def add(self, words: tuple[str, ...], entry: Entry) -> None:
        """Add a phrase; the same sense twice is kept once."""
        here = self
        for word in words:
            here = here.following.setdefault(word, Trie())
        if not any((e.category, e.key, e.form) == (entry.category, entry.key, entry.form)
                   for e in here.entries):  # fmt: skip
            here.entries.append(entry)


@dataclass(frozen=True, slots=True)
class Lexicon:
    """All phrases, the words in them, and the nouns that a genitive may be made of."""

    trie: Trie
    vocabulary: Vocabulary
    nouns: frozenset[str]
    fillers: frozenset[str]


@cache
def lexicon() -> Lexicon:
    """Read the word lists."""
    trie = Trie()
    nouns: set[str] = set()
    for category, table in load("nlu_words.toml").items():
        if category == "FILL":
            continue
        for key, listed in table.items():
            _add_class(trie, category, key, listed, nouns)
    _add_verbs(trie)
    uses = _words_of(trie)
    words = dict.fromkeys(uses, 0)
    plain = load("nlu_plain.toml")
    for word in plain["words"].split():
        words.setdefault(word, 1)
    for verb in plain["verbs"].split():
        for _, form in past_forms(verb, plain["irregular"].get(verb)):
            words.setdefault(form, 1)
    for word in english():
        words.setdefault(word, 2)
    text = load("nlu_text.toml")
    for word in text["numbers"]:
        words.setdefault(word, 0)
    fillers = frozenset(word for (word,) in phrases(load("nlu_words.toml")["FILL"]["fill"]))
    shortened = tuple(text["contractions"])
    return Lexicon(trie, Vocabulary.of(words, uses, shortened), frozenset(nouns), fillers)


def _add_class(trie: Trie, category: str, key: str, listed: str, nouns: set[str]) -> None:
    for phrase in phrases(listed):
        cost = LATER_SENSE if phrase[0].startswith("*") else 0.0
        words = (phrase[0].lstrip("*"), *phrase[1:])
        longer = category == "KIND" and len(words) > 1  # "man on foot" is no "man"
        cost -= AUXILIARY if category == "SEMI" else 0.0
        cost -= LONGER if longer else 0.0
        trie.add(words, Entry(category, key, "", cost))
        if category in NOUNS:
            several = cost + DEEDS * (category == "EVN" and key == "do")
            trie.add((*words[:-1], plural(words[-1])), Entry(category, key, "plural", several))
        if category == "KIND" and len(words) == 1:
            nouns.add(words[0])


def _add_verbs(trie: Trie) -> None:
    table: dict[str, Any] = load("nlu_verbs.toml")
    for lemma in table["senses"]:
        listed = [tuple(lemma.split()), *phrases(table["variants"].get(lemma, ""))]
        for words in [owned for spelt in listed for owned in _owned(spelt)]:
            forms = table["forms"]
            irregular = forms.get(" ".join(words)) or forms.get(words[0])
            for form, word in verb_forms(words[0], irregular):
                cost = AUXILIARIES.get(lemma, 0.0)
                cost = (
                    LATER_SENSE
                    if word in ("left", "saw", "thought", "found", "past") and form != "base"
                    else cost
                )
                if form in ("part", "base") and not words[1:]:
                    cost += ADJECTIVAL * _is_a(trie, word, ("ADJ", "FEELADJ"))
                if form == "base" and not words[1:]:
                    cost += MEASURED * _is_a(trie, word, ("MEAS",))
                category = "GOING" if word == "going" else VERB_CLASSES[form]  # "going to"
                trie.add((word, *words[1:]), Entry(category, lemma, form, cost))


def _owned(words: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Put each owner in place of "one's"; a phrase without it is left as it is."""
    if "one's" not in words:
        return [words]
    at = words.index("one's")
    return [(*words[:at], owner, *words[at + 1 :]) for owner in OWNERS]


def _is_a(trie: Trie, word: str, categories: tuple[str, ...]) -> bool:
    known = trie.following.get(word)
    return known is not None and any(entry.category in categories for entry in known.entries)


def _words_of(trie: Trie) -> Counter[str]:
    """Count in how many senses each word is, alone or in a phrase."""
    found: Counter[str] = Counter()
    pending: list[tuple[Trie, tuple[str, ...]]] = [(trie, ())]
    while pending:
        here, words = pending.pop()
        for word in words:
            found[word] += len(here.entries)
        pending.extend((after, (*words, word)) for word, after in here.following.items())
    return found


def leaves(lattice: Lattice) -> list[dict[str, list[Leaf]]]:
    """Find every leaf of a lattice, by its first node and its word class."""
    known = lexicon()
    found: list[dict[str, list[Leaf]]] = [{} for _ in lattice.edges]
    for node, mark in lattice.marks.items():
        name = "COMMA" if mark == "," else "STOP"
        _put(found, Leaf(name, mark, "", (), (), node, node + 1, 0.0))
    for start, edges in enumerate(lattice.edges):
        for edge in edges:
            _single(found, known, start, edge)
            if (trie := known.trie.following.get(edge.word)) is not None:
                _walk(found, lattice, trie, start, (edge,))
    return found


def _walk(
    found: list[dict[str, list[Leaf]]], lattice: Lattice, trie: Trie, start: int,
    path: tuple[Edge, ...],
) -> None:  # fmt: skip
    end = path[-1].end
    if trie.entries:
        words = tuple(edge.word for edge in path)
        tokens = tuple(dict.fromkeys(token for edge in path for token in edge.tokens))
        cost = sum(edge.cost for edge in path) - PHRASE * (len(path) - 1)
        for e in trie.entries:
            _put(found, Leaf(e.category, e.key, e.form, words, tokens, start, end, cost + e.cost))
    if trie.following:
        for edge in lattice.edges[end]:
            if (after := trie.following.get(edge.word)) is not None:
                _walk(found, lattice, after, start, (*path, edge))


def _single(found: list[dict[str, list[Leaf]]], known: Lexicon, start: int, edge: Edge) -> None:
    word = edge.word
    is_number = _NUMBER.fullmatch(word) is not None
    if is_number or word in load("nlu_text.toml")["numbers"]:
        name = "CLOCK" if ":" in word else "NUM"
        heard = HEARD if word in load("nlu_text.toml")["homophones"] else 0.0
        _put(found, Leaf(name, word, "", (word,), edge.tokens, start, edge.end,
                         edge.cost + heard))  # fmt: skip
    if word == "hundred":
        _put(found, Leaf("HUNDRED", word, "", (word,), edge.tokens, start, edge.end, edge.cost))
    has_sense = known.vocabulary.words.get(word) == 0 or is_number
    if word in known.fillers:
        _put(found, Leaf("FILLER", word, "", (word,), edge.tokens, start, edge.end,
                         FILLER + edge.cost))  # fmt: skip
    elif not has_sense:
        _put(found, Leaf("UNK", word, "", (word,), edge.tokens, start, edge.end,
                         UNKNOWN + edge.cost))  # fmt: skip
    if len(edge.tokens) > 1:
        return
    cost = (SKIPPED if has_sense else UNKNOWN) + edge.cost
    _put(found, Leaf("SKIP", word, "", (word,), edge.tokens, start, edge.end, cost))


def _put(found: list[dict[str, list[Leaf]]], leaf: Leaf) -> None:
    row = found[leaf.start].setdefault(leaf.category, [])
    for index, other in enumerate(row):
        if other.end == leaf.end and other.key == leaf.key:
            if leaf.cost < other.cost:
                row[index] = leaf
            return
    row.append(leaf)


def without_skips(found: list[dict[str, list[Leaf]]]) -> list[dict[str, list[Leaf]]]:
    """Leave out that words are read past; those without a sense still are."""
    return [
        {
            name: row
            for name, row in at.items()
            if name != "FILLER" and (name != "SKIP" or "UNK" in at)
        }
        for at in found
    ]
