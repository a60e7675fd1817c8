"""Consequences: what follows for our plan, and what makes a lane the better one, by how much."""

from typing import Any, Final, cast

from xavi_dialogue.domain.meaning import Doing, Question, Why
from xavi_dialogue.domain.terms import Compares, Ego, Lane, Measured, Pronoun
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Noun
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.compose.verbs.expecting import hindsight
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh, is_that

_FOLLOWING: Final = frozenset({"follow", "mean", "conclude", "make", "change", "do"})
_FROM: Final = ("from", "of", "with")
_FOR: Final = ("for", "in", "about")


def drawn(wh: Wh, clause: Clause) -> Question | None:
    """Ask what we are going to do where it is asked what follows for that; None for all else."""
    if (lane := _better_lane(wh, clause)) is not None:
        of = Measured("value", lane, tense=cast(Any, clause.tense))
        return Why(Compares(of, "more"))
    if wh.kind != "what":
        return None
    if (amiss := hindsight(clause)) is not None:
        return amiss
    if clause.verb is None or clause.verb.key not in _FOLLOWING or clause.objects:
        return None
    known = isinstance(clause.subject, Pronoun) and is_that(clause.subject)
    named = any(c.key in _FROM and is_that(c.sem) for c in clause.complements)
    asked = [] if clause.question is None else clause.question[1]
    ours = any(isinstance(one, Doing) and one.actor == Ego() for one in asked)
    ours = ours or any(c.key in _FOR and _is_our_plan(c.sem) for c in clause.complements)
    if clause.verb.key in ("make", "do") and not named:
        return None
    return Doing(Ego(), tense="future") if (known or named) and ours else None


def _better_lane(wh: Wh, clause: Clause) -> Lane | None:
    """Return the lane of "what made the left lane better", "by how much is it better?"."""
    made = wh.kind == "what" and clause.verb is not None and clause.verb.key == "make"
    amount = wh.kind == "grade" and wh.key in ("much", "worse") and clause.verb is None
    amount |= wh.kind == "count" and clause.verb is None
    named = [clause.subject] if amount else [sem for sem, _ in clause.objects] if made else []
    lane = next((sem for sem in named if isinstance(sem, Lane)), None)
    nodes = (leaf for _, node in clause.objects for leaf in leaves_of(node))
    better = "better" in wh.words or any(key == "better" for key, _ in clause.comparisons)
    return lane if better or any(leaf.key == "better" for leaf in nodes) else None


def _is_our_plan(sem: object) -> bool:
    return isinstance(sem, Ego) or (isinstance(sem, Noun) and sem.key == "plan")
