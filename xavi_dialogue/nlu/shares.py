"""Shares: what each word of a text contributes to a reading."""

from collections.abc import Sequence
from typing import Literal

from xavi_dialogue.domain.meaning import TokenShare, Unread
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf, lexicon
from xavi_dialogue.nlu.text.lattice import Lattice, is_strange

Share = Literal["meaning", "grammar", "politeness", "hedge", "address", "idle", "unknown"]

_GRAMMAR = frozenset(
    [
        "BE",
        "FELT",
        "GOT",
        "DO",
        "HAVE",
        "HAD",
        "MODAL",
        "TO",
        "DET",
        "POSS",
        "AND",
        "OR",
        "BUT",
        "SO",
        "THAN",
        "AS",
        "COMP",
        "REL",
        "GEN",
        "FILLER",
        "P",
        "OF",
        "BEARP",
        "PART",
        "THERE",
        "FOCUS",
        "FULL",
        "DEG",
        "IF",
        "SUBORD",
        "WHETHER",
        "BECAUSE",
        "TAGWORD",
        "BETWEEN",
    ]
)
_SHARES: dict[str, Share] = {
    "PLEASE": "politeness", "HEDGE": "hedge", "INTERJ": "hedge", "ADDRESS": "address",
    "SKIP": "unknown", "UNK": "unknown",
}  # fmt: skip
_ASKING = ("ask", "polar", "about", "supposed")  # how the names of units that ask begin
_RANK = {
    "unknown": 6,
    "idle": 5,
    "meaning": 4,
    "politeness": 3,
    "address": 2,
    "hedge": 1,
    "grammar": 0,
}


def _share(leaf: Leaf) -> Share:
    if leaf.category in _GRAMMAR:
        return "grammar"
    return _SHARES.get(leaf.category, "meaning")


def shares_of(
    units: tuple[Node, ...], owners: list[int | None], unknown: Sequence[Leaf], lattice: Lattice,
    idle: Sequence[Leaf] = (),
) -> tuple[TokenShare, ...]:  # fmt: skip
    """Account for every token; `owners` gives the first act of each unit."""
    inert = {id(leaf) for leaf in idle}
    lost = {id(leaf) for leaf in unknown}
    found: dict[int, TokenShare] = {}
    for unit, owner in zip(units, owners, strict=True):
        for leaf in leaves_of(unit):
            share = _share(leaf)
            understood = owner is not None or share not in ("meaning",)
            if (id(leaf) in lost and share == "meaning") or not understood:
                share = "unknown"
            elif id(leaf) in inert:
                share = "idle"
            for token in leaf.tokens:
                _merge(found, token, leaf, share, owner, lattice)
    return tuple(found.get(i) or _missing(i, lattice) for i in range(len(lattice.tokens)))


def is_unknown(unit: Node, unknown: list[Leaf]) -> bool:
    """Check whether a unit has unknown words and no known ones."""
    lost = {id(leaf) for leaf in unknown}
    shares = [_share(leaf) for leaf in leaves_of(unit) if id(leaf) not in lost]
    return "unknown" in (*shares, *("unknown" for _ in lost)) and not any(
        share in ("meaning", "grammar") for share in shares
    )


def _merge(
    found: dict[int, TokenShare], token: int, leaf: Leaf, share: Share, owner: int | None,
    lattice: Lattice,
) -> None:  # fmt: skip
    read = " ".join(leaf.words)
    part = f"{leaf.category.lower()}:{leaf.key}"
    before = found.get(token)
    if before is not None:
        read = f"{before.read} {read}"
        part = f"{before.part} {part}"
        if _RANK[before.share] > _RANK[share]:
            share = before.share
    text = lattice.tokens[token]
    strange = share == "unknown" and is_strange(text, lexicon().vocabulary)
    found[token] = TokenShare(text, read, share, part, owner, strange)


def _missing(token: int, lattice: Lattice) -> TokenShare:
    return unknown_shares(lattice.tokens[token : token + 1])[0]


def unknown_shares(tokens: tuple[str, ...]) -> tuple[TokenShare, ...]:
    """Account for the tokens of a text that could not be read."""
    known = lexicon()
    return tuple(
        TokenShare(word, word, "grammar")
        if word in known.fillers
        else TokenShare(word, word, "unknown", strange=is_strange(word, known.vocabulary))
        for word in tokens
    )


def unread_of(
    units: tuple[Node, ...], owners: list[int | None], shares: tuple[TokenShare, ...]
) -> tuple[Unread, ...]:
    """List the units that have unknown words and no act."""
    found: list[Unread] = []
    for unit, owner in zip(units, owners, strict=True):
        tokens = _tokens_of(unit)
        if owner is None and any(shares[token].share == "unknown" for token in tokens):
            words = tuple(shares[token].text for token in tokens)
            found.append(Unread(words, unit.name.startswith(_ASKING)))
    return tuple(found)


def words_in(phrase: Node, lattice: Lattice) -> tuple[str, ...]:
    """List the words of a phrase as typed."""
    return tuple(lattice.tokens[token] for token in _tokens_of(phrase))


def _tokens_of(phrase: Node) -> list[int]:
    return sorted({token for leaf in leaves_of(phrase) for token in leaf.tokens})
