"""Segments: an utterance cut into units, each a clause, a fragment or a social move."""

from dataclasses import dataclass

from xavi_dialogue.nlu.grammar.chart import Chart, Entry, Node, tree
from xavi_dialogue.nlu.grammar.lexicon import Leaf
from xavi_dialogue.nlu.text.lattice import Lattice

CLAUSES = (
    "ask_inverted",
    "ask_extracted",
    "ask_subject",
    "ask_measure",
    "polar",
    "declarative",
    "imperative",
    "about",
    "supposed",
    "talk",
)
RARE = (
    "adverbial",
    "ask_lacking",
    "ask_declarative",
    "ask_in_place",
    "ask_bare",
    "polar_short",
    "fragment",
    "had_supposed",
)
UNIT = 0.25  # cost of a unit
AT_STOP = 0.0  # cost of a border between units, by the mark there
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
    ]
)


_JOINING = frozenset({"AND", "BUT", "SO", "OR"})


@dataclass(frozen=True, slots=True)
class Path:
    """A row of units that together read a text."""

    units: tuple[Node, ...] = ()
    cost: float = 0.0


_Row = tuple[float, tuple[Entry, ...]]  # cost, entries of the units


def segment(
    chart: Chart, lattice: Lattice, leaves: list[dict[str, list[Leaf]]], names: tuple[str, ...]
) -> list[Path]:
    """Find the cheapest rows of units of some names from the first node to the last."""
    last = lattice.size
    table: list[list[_Row]] = [[] for _ in range(last + 1)]
    table[0] = [(0.0, ())]
    for node in range(last):
        rows = sorted(table[node], key=_cost)[:_KEPT]
        if not rows:
            continue
        start, border = _border(node, lattice, leaves)
        if border is None:
            continue
        for name in names:
            for end, entry in chart.read(name, start).items():
                for cost, entries in rows:
                    total = cost + entry[0] + UNIT + (border if entries else 0.0)
                    table[end].append((total, (*entries, entry)))
    built: dict[int, Node] = {}
    found: list[Path] = []
    for cost, entries in sorted(table[last], key=_cost)[:_FINAL]:
        for entry in entries:
            if id(entry) not in built:
                built[id(entry)] = tree(entry)
        found.append(Path(tuple(built[id(entry)] for entry in entries), cost))
    return found


def _cost(row: _Row) -> float:
    return row[0]


def _border(
    node: int, lattice: Lattice, leaves: list[dict[str, list[Leaf]]]
) -> tuple[int, float | None]:
    """Say where a unit may begin at a node, and what a border there costs."""
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
