"""Lattice: every way to cut a text into words and phrases.

The longest phrase at a place is the likeliest; shorter ones are kept beside it at a price, so
that "what is stopping" may be a question word, or a question about stopping.
"""

from dataclasses import dataclass

from xavi_dialogue.language.normalise import BREAK, is_clock
from xavi_dialogue.language.tokens import WEAK, Token
from xavi_dialogue.language.wordlists import vocabulary
from xavi_dialogue.language.words import is_number, vehicle_nouns

CLOCK = "#:"  # how the word lists write any time of the ride
COUNT = "#"  # and any number, which may be part of what a phrase stands for


@dataclass(frozen=True, slots=True)
class Edge:
    """A word or phrase at its place."""

    end: int  # position of the word behind it
    token: Token
    longest: bool  # no phrase that begins here is likelier

    @property
    def is_noise(self) -> bool:
        """Whether it means nothing and may be dropped for nothing."""
        return self.token.terminal == "NOISE" and not self.token.others


Cuts = tuple[tuple[int, Edge], ...]  # edges in a row, each with its position
Ways = tuple[tuple[str, ...], ...]  # the words of a text, as the lists may have them


@dataclass(frozen=True, slots=True)
class Lattice:
    """All words and phrases of a text, by the position of their first word."""

    edges: tuple[tuple[Edge, ...], ...]  # the longest first; none is empty

    def main(self) -> Cuts:
        """The likeliest cut: the longest phrases from the left, each with its position."""
        path: list[tuple[int, Edge]] = []
        position = 0
        while position < len(self.edges):
            edge = self.edges[position][0]
            path.append((position, edge))
            position = edge.end
        return tuple(path)

    def cuts(self) -> Cuts:
        """The likeliest cut without the noise."""
        return tuple((at, edge) for at, edge in self.main() if not edge.is_noise)


def build(words: tuple[str, ...]) -> Lattice:
    """The lattice of a text whose spelling is corrected."""
    listed = tuple(CLOCK if is_clock(word) else word for word in words)
    counted = tuple(COUNT if is_number(word) else word for word in listed)
    ways = (listed,) if listed == counted else (listed, counted)
    return Lattice(tuple(_edges(words, ways, start) for start in range(len(words))))


def _edges(words: tuple[str, ...], ways: Ways, start: int) -> tuple[Edge, ...]:
    """What begins at a word; `ways` are the words as the lists may have them."""
    word = words[start]
    if word == BREAK:
        return (Edge(start + 1, Token("BREAK", word, word), True),)
    phrases = vocabulary().phrases
    if is_number(word) and start and words[start - 1] in vehicle_nouns():
        ways = ways[:1]  # "vehicle 2 seconds after that": a name
    found = [match for listed in ways for match in phrases.all_from(listed, start)]
    found = [match for k, match in enumerate(found) if match not in found[:k]]
    found.sort(key=lambda match: (_splits_a_name(words, start, match[0]), -match[0]))
    if not found:
        kind = "NUMBER" if is_number(word) else "UNKNOWN"
        return (Edge(start + 1, Token(kind, word, word), True),)
    edges: list[Edge] = []
    forms = vocabulary().forms
    for end, (sense, *others) in found:
        text = words[start:end]
        form = next((forms[w] for w in text if w in forms), "")
        kept = tuple(o for o in others if o.terminal not in WEAK)
        value = sense.value.replace(COUNT, next(filter(is_number, text), COUNT))
        token = Token(sense.terminal, value, " ".join(text), form, kept)
        edges.append(Edge(end, token, not edges))
    return tuple(edges)


def _splits_a_name(words: tuple[str, ...], start: int, end: int) -> bool:
    """Whether a phrase parts a vehicle from its number: "what vehicle | 3 did"."""
    follows = words[end : end + 1]
    return (
        end - start > 1
        and words[end - 1] in vehicle_nouns()
        and follows[:1] != ()
        and (is_number(follows[0]))
    )
