"""Shares: what each word of a text contributes to a reading."""

from typing import Literal

from xavi_dialogue.domain.meaning import TokenShare
from xavi_dialogue.nlu.compose.tree import leaves_of
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf, lexicon
from xavi_dialogue.nlu.text.lattice import Lattice

Share = Literal["meaning", "grammar", "politeness", "hedge", "address", "unknown"]

_GRAMMAR = frozenset(
    [
        "BE",
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
_RANK = {"unknown": 5, "meaning": 4, "politeness": 3, "address": 2, "hedge": 1, "grammar": 0}


def _share(leaf: Leaf) -> Share:
    if leaf.category in _GRAMMAR:
        return "grammar"
    return _SHARES.get(leaf.category, "meaning")


def shares_of(
    units: tuple[Node, ...], owners: list[int | None], unknown: list[Leaf], lattice: Lattice
) -> tuple[TokenShare, ...]:
    """Account for every token; `owners` gives the first act of each unit."""
    lost = {id(leaf) for leaf in unknown}
    found: dict[int, TokenShare] = {}
    for unit, owner in zip(units, owners, strict=True):
        for leaf in leaves_of(unit):
            share = _share(leaf)
            understood = owner is not None or share not in ("meaning",)
            if (id(leaf) in lost and share == "meaning") or not understood:
                share = "unknown"
            for token in leaf.tokens:
                _merge(found, token, leaf, share, owner, lattice)
    return tuple(found.get(i) or _missing(i, lattice) for i in range(len(lattice.tokens)))


def is_unknown(unit: Node, unknown: list[Leaf]) -> bool:
    """Say whether no word of a unit is known."""
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
    found[token] = TokenShare(lattice.tokens[token], read, share, part, owner)


def _missing(token: int, lattice: Lattice) -> TokenShare:
    return TokenShare(lattice.tokens[token], lattice.tokens[token], "unknown")


def unknown_shares(lattice: Lattice) -> tuple[TokenShare, ...]:
    """Account for the tokens of a text that could not be read."""
    fillers = lexicon().fillers
    return tuple(
        TokenShare(word, word, "grammar" if word in fillers else "unknown")
        for word in lattice.tokens
    )
