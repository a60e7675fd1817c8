"""Talk: replies to feelings, requests and social moves."""

from xavi_dialogue.domain.answers import (
    Acknowledged,
    Again,
    Answer,
    Closeness,
    Comfort,
    Comforting,
    Helpful,
    Sociable,
)
from xavi_dialogue.nlg.content.clauses.plan import Part, Plan
from xavi_dialogue.nlg.content.observed.safety import braked_message, calming
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import message


def plan_comforting(answer: Comforting, context: SpeechContext) -> Plan:
    """Plan a personal sentence for a feeling, and a fact that bears on it."""
    first = message("FEELING", feeling=answer.feel.feeling)
    if answer.fact is not None:
        return Plan((first, *_bearing(answer.fact, context)))
    worried = answer.feel.feeling in ("afraid", "nervous", "distrustful", "startled")
    return Plan((first,), (message("OFFER_WHY"),) if worried else ())


def _bearing(fact: Answer, context: SpeechContext) -> tuple[Part, ...]:
    """Plan a fact that bears on a feeling, as a plain statement."""
    if isinstance(fact, Closeness):
        return calming(fact, context)
    if isinstance(fact, Comfort):
        return (braked_message(fact, context),)
    return (fact,)


def plan_sociable(answer: Sociable, context: SpeechContext) -> Plan:
    """Plan the reply to a social move, with a fact that bears on it."""
    first = message("SOCIAL", kind=answer.kind, told=answer.fact is not None)
    if answer.fact is None:
        return Plan((first,))
    return Plan((first, *_bearing(answer.fact, context)))


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
