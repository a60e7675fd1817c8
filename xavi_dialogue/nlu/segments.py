"""Segments: an utterance cut into units, each a clause, a fragment or a social move."""

from dataclasses import dataclass

from xavi_dialogue.nlu.grammar.chart import Chart, Entry, Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf
from xavi_dialogue.nlu.text.lattice import Lattice

CLAUSES = (
    "adverbial",
    "ask_declarative",
    "ask_inverted",
    "ask_extracted",
    "ask_subject",
    "ask_measure",
    "ask_evidence",
    "polar",
    "declarative",
    "imperative",
    "about",
    "supposed",
    "talk",
    "topic",
    "apposed",
)
RARE = (
    "ask_lacking",
    "ask_in_place",
    "ask_bare",
    "polar_short",
    "fragment",
    "had_supposed",
)
UNIT = 0.25  # cost of a unit
AT_STOP = 0.0  # cost of a border between units at a full stop or another strong mark
AT_COMMA = 0.15
JOINED = 0.3  # before "and", "but", "so"
UNMARKED = 0.75
DICTATED = 0.5  # in a text without any mark
_KEPT = 4
_FINAL = 8
_STARTERS = frozenset(
    [
        "WHY",
        "WHAT",
        "WHO",
        "WHICH",
        "WHERE",
        "WHEN",
        "HOW",
        "WHATIF",
        "ABOUT",
        "IF",
        "AND",
        "BUT",
        "SO",
        "INTERJ",
        "TALK",
        "I",
        "YOU",
        "WE",
        "BE",
        "DO",
        "MODAL",
        "PRON",
        "ANY",
        "REPAIR",
        "YES",
        "NO",
        "HOWKNOW",
        "PLEASE",
        "HEDGE",
        "OR",
        "DET",
        "HAVE",
        "HAD",
        "V",
        "THERE",
    ]
)


_JOINING = frozenset({"AND", "BUT", "SO", "OR"})


@dataclass(frozen=True, slots=True)
class Path:
    """A row of units that together read a text."""

    units: tuple[Node, ...] = ()
    cost: float = 0.0


_Row = tuple[float, tuple[Entry, ...], int]  # cost, entries of the units, start of the last


def segment(
    chart: Chart, lattice: Lattice, leaves: list[dict[str, list[Leaf]]], names: tuple[str, ...]
) -> list[Path]:
    """Find the cheapest rows of units of some names from the first node to the last."""
    last = lattice.size
    table: list[list[_Row]] = [[] for _ in range(last + 1)]
    table[0] = [(0.0, (), 0)]
    for node in range(last):
        rows = _best(table[node], _KEPT, 2)
        if not rows:
            continue
        start, border = _border(node, lattice, leaves)
        if border is None:
            continue
        opens = node == 0 or node in lattice.marks  # topics stand at the front
        for name in names:
            if name == "topic" and not opens:
                continue
            if name == "apposed" and node not in lattice.marks:
                continue
            for end, entry in chart.read(name, start).items():
                if (end == last and name == "topic") or (end != last and name == "apposed"):
                    continue
                for cost, entries, _ in rows:
                    if name == "apposed" and (not entries or entries[-1][1] == "talk"):
                        continue
                    total = cost + entry[0] + UNIT + (border if entries else 0.0)
                    table[end].append((total, (*entries, entry), node))
    return [
        Path(tuple(map(chart.tree, entries)), cost)
        for cost, entries, _ in _best(table[last], _FINAL, 5)
    ]


def _cost(row: _Row) -> float:
    return row[0]


def _best(rows: list[_Row], most: int, alike: int) -> list[_Row]:
    """Keep the cheapest rows, and only a few whose last units begin at the same node."""
    kept: list[_Row] = []
    counts: dict[int, int] = {}
    for row in sorted(rows, key=_cost):
        if counts.get(row[2], 0) < alike:
            counts[row[2]] = counts.get(row[2], 0) + 1
            kept.append(row)
            if len(kept) == most:
                break
    return kept


def _border(
    node: int, lattice: Lattice, leaves: list[dict[str, list[Leaf]]]
) -> tuple[int, float | None]:
    """Return where the next unit begins, and the cost of a border there; None: no border."""
    mark = lattice.marks.get(node)
    if mark is not None:
        return node + 1, AT_COMMA if mark == "," else AT_STOP
    if node == 0:
        return 0, 0.0
    if _STARTERS.isdisjoint(leaves[node]):
        return node, None
    joined = not _JOINING.isdisjoint(leaves[node])
    unmarked = UNMARKED if lattice.marks else DICTATED
    return node, JOINED if joined else unmarked
