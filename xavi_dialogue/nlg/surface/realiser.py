"""Realiser: a message as a sentence, by the grammars of the passenger's style."""

from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.generator import fill
from xavi_dialogue.nlg.surface.message import Message
from xavi_dialogue.nlg.surface.morphology import inflect
from xavi_dialogue.nlg.surface.orthography import capitalise, join, sentence
from xavi_dialogue.nlg.surface.referring import ReferringContext
from xavi_dialogue.nlg.surface.rules import Grammar, load_grammars

#: The grammars of the passenger's style; their rules may call each other.
GRAMMARS = ("answer_common", "answer_facts", "answer_measures", "answer_talk", "answer_causes",
            "answer_refusals", "answer_questions", "answer_journeys", "answer_lights",
            "answer_dangers", "answer_hidden")  # fmt: skip


def grammar() -> Grammar:
    """Return the grammar of answers to passengers."""
    return load_grammars(*GRAMMARS)


def realised(said: Message, context: SpeechContext, speaker: ReferringContext) -> str:
    """Return a message as a sentence with its capital and its full stop."""
    words, _ = inflect(fill(grammar(), said), context, speaker)
    return capitalise(sentence(join(words)))
