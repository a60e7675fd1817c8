"""Reply: one turn of the car, the object that `xavi ask --json` prints."""

from typing import Literal

import msgspec

from xavi_dialogue.explain.explanation import Explanation, Reason
from xavi_dialogue.explain.query import Query

Kind = Literal["answer", "refusal", "clarification"]


class Reply(msgspec.Struct, frozen=True, kw_only=True):
    """What the car says, and what it rests on. All keys are always there."""

    text: str
    kind: Kind
    reason: Reason | None = None  # null of an answer
    query: Query | None = None  # null where nothing was understood
    explanation: Explanation | None = None  # null unless kind is answer
    choices: tuple[str, ...] = ()  # of a clarification, numbered from 1
    suggestions: tuple[str, ...] = ()  # what can be asked next
    trace_id: str | None = None  # of the decision explained
    sim_time: float  # [s] at which the question was asked
    timing_ms: float | None = None  # taken to answer; the shell measures it


def encode(reply: Reply) -> str:
    """One line of JSON: the same reply gives the same text."""
    return msgspec.json.encode(reply).decode()
