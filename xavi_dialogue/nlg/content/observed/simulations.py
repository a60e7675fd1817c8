"""Simulations: messages of how many a decision ran, and how they ended."""

from planner.record.trace import OUTCOMES
from xavi_dialogue.domain.answers import Simulations
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.manoeuvres import own_verbs
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Moment, Who

STRUCK = 3  # maximum of vehicles named with which simulations collided


def plan_simulations(answer: Simulations, context: SpeechContext) -> Plan:
    """Plan how many simulations there were, and how many of them ended in which way."""
    del context
    counts = dict(answer.ends)
    said = {
        "when": Moment(answer.decided),
        "runs": str(answer.runs),
        "none": not answer.runs,
        "of": own_verbs((answer.of,)) if answer.of is not None else None,
        "options": str(answer.options) if answer.options > 1 else None,
    }
    ends = _ends(answer) if counts.get(answer.asked or "done") != answer.runs else ()
    others = bool(answer.asked and counts.get(answer.asked))
    rest = (message("SIMULATED_ENDS", ends=ends, others=others),) if ends and answer.runs else ()
    if answer.apart:
        return Plan((message("SIMULATED_APART", **said), *rest))
    if answer.asked is None:
        return Plan((message("SIMULATED", **said), *rest))
    hits = counts.get(answer.asked, 0)
    struck = _struck(answer) if answer.asked == "collision" else ()
    first = message(
        "SIMULATED_SO", **said, hits=str(hits), never=not hits, all=hits == answer.runs,
        end=answer.asked, struck=struck or None,
    )  # fmt: skip
    return Plan((first,), rest)


def _ends(answer: Simulations) -> tuple[Message, ...]:
    """Return how many ended in each other way; a collision also where there was none."""
    counts = dict(answer.ends)
    return tuple(
        message("SIMULATED_END", number=str(counts[end]) if counts.get(end) else None, end=end)
        for end in OUTCOMES
        if end != answer.asked and (counts.get(end) or end == "collision")
    )


def _struck(answer: Simulations) -> tuple[Message, ...]:
    named = answer.struck[:STRUCK]
    return tuple(
        message("SIMULATED_WITH", number=str(n), who=Who(Vehicle(vehicle))) for vehicle, n in named
    )
