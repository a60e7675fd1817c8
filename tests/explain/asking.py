"""Asking where the planner cannot be asked to make sure of a cause."""

from dataclasses import replace

from xavi_dialogue.explain.engine import explain
from xavi_dialogue.explain.explanation import Explanation, NeedRollout, NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record


def told(query: Query, record: Record) -> Explanation | NoExplanation | NeedRollout:
    """What is said from the record as it is; NeedRollout only where nothing can be said."""
    found = explain(query, record)
    while isinstance(found, NeedRollout) and found not in record.refused:
        record = replace(record, refused=(*record.refused, found))
        found = explain(query, record)
    return found
