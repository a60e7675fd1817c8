"""Patterns: what may occur with a verb in each of its senses, from nlu_verbs.toml."""

from dataclasses import dataclass
from functools import cache

from xavi_dialogue.nlu.text.tables import load

FLAGS = frozenset(
    {
        "inf",
        "ger",
        "bare",
        "that",
        "wh",
        "adj",
        "ved",
        "because",
        "bearing",
        "origin",
        "until",
        "go",
        "alight",
        "q",
        "close",
        "long",
        "again",
        "whole",
        "out",
    }
)
#: Prepositions that stand for a particle: by particle.
STRANDED = {"past": "over", "around": "bearing-around", "in": "in", "on": "on", "off": "from",
             "through": "over", "over": "over", "out": "from", "up": "over", "by": "by",
             "along": "over", "down": "over", "back": "bearing-behind"}  # fmt: skip
WORDED = frozenset({"first", "there", "still", "put", "going", "moving", "faster", "waiting"})
_NO_WORDS = frozenset({"o", "o2", "s", "one", "side"})  # roles that neither kind of word fills


@dataclass(frozen=True, slots=True)
class Role:
    """One thing that occurs with a verb: its kind, its types, and whether it is optional."""

    kind: str  # "o", "o2", "s", "one", a preposition, "+up", "side", or a flag such as "inf"
    types: str = "*"
    optional: bool = False


@dataclass(frozen=True, slots=True)
class Sense:
    """One sense of a verb."""

    head: str  # an action, or "@" and a predicate
    roles: tuple[Role, ...] = ()
    manner: str | None = None
    cost: float = 0.0
    calls: tuple[frozenset[str], ...] = ()  # a clause must contain a word of each set


@cache
def senses(lemma: str) -> tuple[Sense, ...]:
    """Return the senses of a verb."""
    return tuple(_sense(text) for text in load("nlu_verbs.toml")["senses"][lemma])


def _sense(text: str) -> Sense:
    head, *rest = text.split()
    roles: list[Role] = []
    manner: str | None = None
    cost = 0.0
    for item in rest:
        if "$" in item:
            item, _, price = item.partition("$")
            cost = float(price)
            if not item:
                continue
        if item.startswith("="):
            manner = item[1:] or None
            continue
        optional = item.endswith("?") or "?:" in item
        kind, _, kinds = item.replace("?", "").partition(":")
        roles.append(Role(kind, kinds or "*", optional))
    calls = tuple(one for role in roles if (one := _called(role)))
    return Sense(head, tuple(roles), manner, cost, calls)


def _called(role: Role) -> frozenset[str]:
    """List the words, one of which a role demands; none if it demands no word."""
    kind = role.kind
    if role.optional or kind in FLAGS or kind in _NO_WORDS or kind[1:] in WORDED:
        return frozenset()
    if not kind.startswith("+"):
        return frozenset({kind})
    return frozenset({kind, STRANDED.get(kind[1:], kind)})
