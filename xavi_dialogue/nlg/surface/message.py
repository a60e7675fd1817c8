"""Messages: content before it is worded, as a rule of a grammar and values for its slots.

By convention a rule for messages has one parameter, the message: `SPEED[m] -> {m.who} ...`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Message:
    """A sentence or clause to be generated."""

    rule: str
    slots: Mapping[str, object] = field(default_factory=dict)


def message(rule: str, /, **slots: object) -> Message:
    """Return a message with a rule and the values of its slots."""
    return Message(rule, slots)
