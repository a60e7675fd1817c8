"""Counts: "how many cars and bicycles" asks for two numbers."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from xavi_dialogue.domain.meaning import Act, Ask, Question
from xavi_dialogue.nlu.compose.clauses.sem import Group
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh

Asked = Sequence[tuple[Question, float]]


def counted_each(wh: Wh, ask: Callable[[Wh], Asked]) -> list[tuple[tuple[Act, ...], float]]:
    """Count each of those that "and" joins; empty for all else."""
    sem = wh.sem if wh.kind == "count" else None
    if not isinstance(sem, Group) or sem.join != "and":
        return []
    found = [ask(replace(wh, sem=one))[:1] for one in sem.members]
    if not all(found):
        return []
    asked = tuple(Ask(question) for row in found for question, _ in row)
    return [(asked, max(cost for row in found for _, cost in row))]
