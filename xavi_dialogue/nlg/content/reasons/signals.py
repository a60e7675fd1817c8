"""Signals: why our own indicator is or was on."""

from xavi_dialogue.domain.answers import OwnSignal
from xavi_dialogue.nlg.content.clauses.manoeuvres import own_verbs
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import message


def plan_own_signal(answer: OwnSignal, context: SpeechContext) -> Plan:
    """Plan what our indicator announces or announced, and whether we did so."""
    del context
    past = answer.past or answer.shown.end is not None
    aim = None if answer.aim is None else own_verbs((answer.aim,), ())
    slots = {"side": answer.shown.side, "past": past, "dropped": answer.came is False}
    return Plan((message("OWN_SIGNAL", aim=aim, done=answer.came is True, **slots),))
