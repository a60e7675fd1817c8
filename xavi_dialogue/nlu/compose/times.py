"""Times: phrases that say when."""

from typing import Any

from xavi_dialogue.domain.terms import (
    Ago,
    At,
    AtDecision,
    Back,
    Between,
    Junction,
    Next,
    Now,
    Rank,
    Relative,
    Start,
    Time,
    Unsaid,
    WholeRide,
    Within,
)
from xavi_dialogue.nlu.compose.tree import leaf_of, leaves_of, nodes_of, number_of
from xavi_dialogue.nlu.grammar.chart import Node

SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0}
FEW = 5.0  # [s] "a few seconds"
_ADVERBS: dict[str, Time] = {
    "now": Now(),
    "recent": Ago(None),
    "past": Back("before"),
    "then": Back("during"),
    "before-that": Back("before"),
    "after-that": Back("after"),
    "start": Start(),
    "whole": WholeRide(),
    "next": Next(),
    "soon": Within(None),
    "last-time": Rank(-1),
    "end": Rank(-1),
}


def clock(word: str) -> float:
    """Read a time of the ride: "1:05" is 65 s."""
    minutes, _, seconds = word.partition(":")
    return int(minutes) * 60.0 + int(seconds)


def time_of(node: Node) -> Time:
    """Read a phrase that says when."""
    if node.name == "time_adverb":
        leaf = leaf_of(node, "TIMEADV")
        return _ADVERBS[leaf.key] if leaf else Unsaid()
    clocks = [clock(leaf.key) for leaf in leaves_of(node) if leaf.category == "CLOCK"]
    if node.name == "time_between" and len(clocks) > 1:
        return Between(min(clocks), max(clocks))
    if clocks:
        return _placed(node, clocks[0])
    if node.name == "time_since":
        adverbs = [leaf.key for leaf in leaves_of(node) if leaf.category == "TIMEADV"]
        return Back("after") if "now" in adverbs else Unsaid()
    if node.name == "time_rank":
        return Rank(_rank(node))
    if node.name in ("time_decision", "time_decisions"):
        ranks = [int(number_of(part)) for part in nodes_of(node, "num")]
        return AtDecision(min(ranks), max(ranks) if len(ranks) > 1 else None)
    if node.name == "time_between":
        numbers = [number_of(part) for part in nodes_of(node, "num")]
        return Between(min(numbers), max(numbers))
    return _amount(node)


def _rank(node: Node) -> int:
    leaf = leaf_of(node, "ORD")
    return int(leaf.key) if leaf and leaf.key not in ("next",) else 1


def _placed(node: Node, at: float) -> Time:
    key = _preposition(node)
    if key == "before" or key == "until":
        return Between(0.0, at)
    return At(at)


def _preposition(node: Node) -> str:
    first = node.parts[0]
    if isinstance(first, Node) or first.category not in ("P", "SUBORD", "BEARP"):
        return ""
    return first.key


def seconds_of(node: Node) -> float | None:
    """Read a stretch of time in seconds; None where it is not said how many."""
    unit = leaf_of(node, "TUNIT")
    scale = SECONDS.get(unit.key, 1.0) if unit else 1.0
    numbers = nodes_of(node, "num")
    if numbers:
        return number_of(numbers[0]) * scale
    determiner = leaf_of(node, "DET")
    if determiner is not None and determiner.key == "many":
        return FEW * scale
    return scale if determiner is not None and determiner.words[0] in ("a", "one") else None


def _amount(node: Node) -> Time:
    """Read an amount of time, or after "at" a bare number of seconds."""
    if node.name == "time_bare":
        return At(number_of(nodes_of(node, "num")[0]))
    amount = seconds_of(node)
    key = _preposition(node)
    adverb = leaf_of(node, "TIMEADV")
    if node.name == "time_ago":
        later = adverb is not None and adverb.key in ("next", "after-that", "now")
        return Within(amount) if later else Ago(amount)
    if node.name == "time_span":
        order = leaf_of(node, "ORD")
        unit = leaf_of(node, "TUNIT")
        some = SECONDS.get(unit.key, 1.0) if unit and unit.key != "s" else FEW
        span = amount if amount is not None else some
        if order is not None and order.key == "next":
            return Within(span)
        return Ago(span, span=True)
    if key in ("in", "after") and amount is not None:
        return Within(amount)
    if key in ("for", "over", "during"):
        return Unsaid()
    return At(amount) if amount is not None else Unsaid()


def relative(relation: str, anchor: object) -> Time:
    """Build a time before, after or during something."""
    names = {"before": "before", "after": "after", "until": "until", "since": "since"}
    return Relative(names.get(relation, "during"), anchor)  # type: ignore[arg-type]


def place_time(key: str, sem: object) -> Time | None:
    """Turn "at the junction" into a time; None where it is no such place."""
    if not isinstance(sem, Junction):
        return None
    relation: Any = key if key in ("before", "after", "until", "since") else "during"
    return Relative(relation, sem)
