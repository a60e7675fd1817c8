"""Talk: replies to feelings, requests and social moves."""

from xavi_dialogue.domain.answers import (
    Acknowledged,
    Again,
    Closeness,
    Comfort,
    Comforting,
    Helpful,
    Sociable,
)
from xavi_dialogue.nlg.content.plan import Plan
from xavi_dialogue.nlg.content.safety import braked_message, calming
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import message


def plan_comforting(answer: Comforting, context: SpeechContext) -> Plan:
    """Plan a human sentence for a feeling, and a fact that bears on it."""
    first = message("FEELING", feeling=answer.feel.feeling)
    if isinstance(answer.fact, Closeness):
        return Plan((first, *calming(answer.fact, context)))
    if isinstance(answer.fact, Comfort):
        return Plan((first, braked_message(answer.fact, context)))
    if answer.fact is not None:
        return Plan((first, answer.fact))
    worried = answer.feel.feeling in ("afraid", "nervous", "distrustful", "startled")
    return Plan((first,), (message("OFFER_WHY"),) if worried else ())


def plan_sociable(answer: Sociable, context: SpeechContext) -> Plan:
    """Plan the reply to a social move."""
    return Plan((message("SOCIAL", kind=answer.kind),))


def plan_helpful(answer: Helpful, context: SpeechContext) -> Plan:
    """Plan what can be asked."""
    return Plan((message("HELP"),), (message("HELP_EXAMPLES"),))


def plan_acknowledged(answer: Acknowledged, context: SpeechContext) -> Plan:
    """Plan the reply to "never mind" and the like."""
    return Plan((message("ACKNOWLEDGED", kind=answer.kind),))


def plan_again(answer: Again, context: SpeechContext) -> Plan:
    """Plan the last answer once more; `say` has set how much of it is wanted."""
    if answer.answer is None:
        return Plan((message("NOTHING_SAID"),))
    return Plan((answer.answer,))
