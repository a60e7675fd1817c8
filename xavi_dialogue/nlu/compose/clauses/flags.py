"""Flags: what a sense of a verb demands of a clause besides objects and phrases."""

from typing import Final

from xavi_dialogue.domain.terms import WholeRide
from xavi_dialogue.nlu.compose.clauses.clause import Clause

GOING: Final = frozenset(("go", "pass", "cross", "proceed"))  # what somebody is let do
ALIGHTING: Final = frozenset(("get", "hop", "climb", "step", "jump"))
_OUT: Final = frozenset(("out", "off"))


def flag(kind: str, wanted: str, clause: Clause) -> bool:
    """Check whether a clause has what a sense demands besides objects and phrases."""
    match kind:
        case "inf":
            return clause.infinitive is not None
        case "ger":
            return clause.gerund is not None
        case "bare":
            return clause.bare is not None
        case "that":
            return clause.that is not None
        case "wh":
            return clause.question is not None
        case "adj":
            listed = bool(clause.adjectives or clause.feelings or clause.comparisons)
            return listed and (wanted == "*" or any(k == wanted for k, _ in clause.adjectives)
                               or any(k == wanted for k, _ in clause.comparisons)
                               or wanted in clause.manner)  # fmt: skip
        case "bearing":
            return bool(clause.bearings)
        case "origin":
            return clause.origin is not None
        case "because":
            return clause.because is not None
        case "go":
            inner = clause.bare.verb if clause.bare is not None else None
            return inner is not None and inner.key in GOING
        case "alight":  # "let me get out"
            verb = clause.bare.verb if clause.bare is not None else None
            said = [] if clause.bare is None else clause.bare.particles
            off = any(leaf.key in _OUT for leaf in (*said, *clause.particles))
            return off and verb is not None and verb.key in ALIGHTING
        case "close" | "long" | "again":
            return kind in clause.manner
        case "whole":
            return isinstance(clause.time, WholeRide)
        case _:
            return False
