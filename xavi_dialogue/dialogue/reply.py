"""Reply: one turn of the car, the object that `xavi ask --json` prints."""

from typing import Any, Literal

import msgspec

from xavi_dialogue.dialogue.standing import Kind
from xavi_dialogue.domain.answers import Reason
from xavi_dialogue.nlu.projection import QueryFields


class Reply(msgspec.Struct, frozen=True, kw_only=True):
    """What the car says, and what it rests on. All keys are always there."""

    schema: Literal["xavi.reply/2"] = "xavi.reply/2"
    text: str
    kind: Kind
    reason: Reason | None = None  # null if it is an answer
    query: QueryFields | None = None  # of the first act; null if nothing was understood
    explanation: dict[str, Any] | None = None  # null unless kind is answer
    acts: tuple[dict[str, Any], ...] = ()  # meanings, grounded, in the order of the text
    answers: tuple[dict[str, Any], ...] = ()  # the results, distinguished by `is`
    choices: tuple[str, ...] = ()  # of a clarification, numbered from 1
    suggestions: tuple[str, ...] = ()  # what can be asked next
    trace_id: str | None = None  # of the decision explained
    sim_time: float  # [s] at which the question was asked
    timing_ms: float | None = None  # the time the answer took, measured by the shell


def encode(reply: Reply) -> str:
    """Encode a reply as one line of JSON: the same reply gives the same text."""
    return msgspec.json.encode(reply).decode()
