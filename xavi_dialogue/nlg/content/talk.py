"""Talk: replies to feelings, requests and social moves."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import (
    Acknowledged,
    Again,
    Closeness,
    Comfort,
    Comforting,
    Declined,
    Helpful,
    Sociable,
)
from xavi_dialogue.domain.vocabulary import BEYOND
from xavi_dialogue.nlg.content.clauses import event_clause
from xavi_dialogue.nlg.content.joint_measures import measure_messages
from xavi_dialogue.nlg.content.measures import SOON
from xavi_dialogue.nlg.content.plan import Part, Plan
from xavi_dialogue.nlg.content.safety import braked_message, calming
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import message
from xavi_dialogue.nlg.surface.values import Clause, Quantity

#: Requests that slowing down complies with.
SLOWING = frozenset(("slow-down", "brake", "stop", "give-way", "wait", "let-go", "stand"))


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


def plan_declined(answer: Declined, context: SpeechContext) -> Plan:
    """Plan how a request is declined, and what the car is about to do anyway."""
    event = answer.request.event
    anyway: tuple[Part, ...] = tuple(p for p in (answer.ahead, answer.doing) if p is not None)
    if answer.already:
        slower = answer.doing is not None and answer.doing.trend == "slowing"
        if slower and event.action not in SLOWING:
            return Plan((message("KEEP_GOING"), *anyway[:1]))
        return Plan((message("ALREADY"), *anyway[-1:]))
    clause = event_clause(replace(event, manner=()), context.now, tense="present")
    verb = Clause(clause.subject, clause.verb, clause.rest)
    if answer.soon is not None:
        left = Quantity(max(answer.soon - context.now, 0.0), "s")
        return Plan((message("ABOUT_TO", verb=verb, left=left, at_once=left.value < SOON),))
    if answer.facts:
        anyway = tuple(measure_messages(answer.facts, context))
    unable = not answer.able or event.action in BEYOND
    first = message("UNABLE" if unable else "DECLINED_VERB", verb=verb)
    if event.action in ("do", "happen"):
        first = message("DECLINED")
    reason = (message("CANNOT", reason=answer.cannot),) if answer.cannot else ()
    return Plan((first, *anyway[:1]), reason)


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
