"""Trees: small looks at a parse."""

from collections.abc import Sequence

from xavi_dialogue.nlu.grammar.chart import Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf
from xavi_dialogue.nlu.text.tables import load

MOST = 1e9  # numbers are cut off there


def leaves_of(part: Part) -> tuple[Leaf, ...]:
    """Give all leaves, in order."""
    return (part,) if isinstance(part, Leaf) else part.leaves


def leaf_of(node: Node, category: str) -> Leaf | None:
    """Find the first direct leaf of a word class."""
    for part in node.parts:
        if isinstance(part, Leaf) and part.category == category:
            return part
    return None


def nodes_of(node: Node, *names: str) -> list[Node]:
    """List the direct phrases of some names."""
    return [part for part in node.parts if isinstance(part, Node) and part.name in names]


def node_of(node: Node, *names: str) -> Node | None:
    """Find the first direct phrase of some names."""
    found = nodes_of(node, *names)
    return found[0] if found else None


def words_of(part: Part) -> str:
    """Join the words of a stretch."""
    return " ".join(word for leaf in leaves_of(part) for word in leaf.words)


def number_of(node: Node) -> float:
    """Read a number: digits, or words such as "forty two"."""
    total = 0.0
    for leaf in leaves_of(node):
        if leaf.category not in ("NUM", "HUNDRED"):
            continue
        value = value_of(leaf)
        total = total * value if value == 100 and total else total + value
    return min(total, MOST)


def value_of(leaf: Leaf) -> float:
    """Read one word of a number."""
    names = load("nlu_text.toml")["numbers"]
    word = leaf.key.replace(",", ".")
    return float(names[word]) if word in names else _digits(word)


def _digits(word: str) -> float:
    """Read a number in decimal digits; 0 for other signs that look like digits."""
    plain = word.isascii() and word.replace(".", "", 1).isdecimal()
    return float(word) if plain else 0.0


def lifted(parts: Sequence[Part]) -> list[Part]:
    """Put what is supposed at the end of a deed behind all: "the risk of hitting him if ...".

    It is supposed of all that is asked, not of that deed.
    """
    if not parts or not isinstance(last := parts[-1], Node):
        return list(parts)
    inner = lifted(last.parts)
    ends = inner[-1] if last.name in ("gerund", "infinitive") or inner != list(last.parts) else None
    if not isinstance(ends, Node) or ends.name != "if_clause" or len(inner) < 2:
        return list(parts)
    kept = Node(last.name, tuple(inner[:-1]), last.start, ends.start, last.cost)
    return [*parts[:-1], kept, ends]


def is_negated(node: Node) -> bool:
    """Say whether a gerund is negated: "for not stopping"."""
    inner = (node, *(p for p in node.parts if isinstance(p, Node)))
    return node.name == "gerund" and any(leaf_of(part, "NOT") is not None for part in inner)


def is_possessed(part: Part) -> bool:
    """Say whether a phrase names somebody by no more than whose it is: "its green"."""
    headless = isinstance(part, Node) and part.name == "headless"
    return headless and any(leaf.category == "POSS" for leaf in leaves_of(part))


def is_not(part: Part) -> bool:
    """Say whether a part is "not"."""
    late = isinstance(part, Node) and part.name == "late_not"
    return late or (isinstance(part, Leaf) and part.category == "NOT")
