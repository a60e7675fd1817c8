"""Pointing: questions for what stands out: "where did you brake hardest", "which came closest"."""

from xavi_dialogue.domain.meaning import Question, Why
from xavi_dialogue.domain.terms import That
from xavi_dialogue.nlu.compose.alternatives.nearness import is_choice, rivals
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.peaks import nearest_of, peak_of
from xavi_dialogue.nlu.compose.clauses.sem import Noun
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh, is_that

_POINTING = frozenset({"where", "when", "what", "who", "which", "count"})


def pointed(wh: Wh, clause: Clause) -> Question | None:
    """Ask for what stands out, "where did you brake hardest?"; or "who was that for?"."""
    if wh.kind == "when" and (nearest := nearest_of(clause)) is not None:
        return nearest
    most = peak_of(clause)
    if most is not None and any(map(is_choice, (wh.of, wh.sem, clause.subject))):
        return rivals(clause)  # "which of the other options came closest"
    named = isinstance(clause.subject, Noun)  # "how hard was the hardest braking"
    if most is not None and (named or wh.kind in _POINTING):
        return most
    whom = any(phrase.key == "for" and phrase.sem is None for phrase in clause.complements)
    ours = wh.kind == "who" and whom and clause.verb is None and is_that(clause.subject)
    return Why(That()) if ours else None
