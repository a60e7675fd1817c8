"""Plans: the messages of an answer, by importance."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

from xavi_dialogue.domain.answers import Answer, Refusal
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message

#: A message, or an answer within the answer, which `say` plans too.
Part: TypeAlias = Message | Answer | Refusal


@dataclass(frozen=True, slots=True)
class Plan:
    """The messages of an answer; each of them becomes a sentence."""

    core: tuple[Part, ...]  # always
    details: tuple[Message, ...] = ()  # unless little is wanted
    more: tuple[Message, ...] = ()  # if the passenger wants more
    choices: tuple[Message, ...] = ()  # of a clarification
    suggestions: tuple[str, ...] = ()


Planner: TypeAlias = Callable[[Any, SpeechContext], Plan]
