"""Clarifications: questions what was meant, and statements of unknown words."""

from xavi_dialogue.domain.answers import TakenAs, Unfamiliar, WhichOne
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.talk.questions import Asking, meant
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.realiser import realised
from xavi_dialogue.nlg.surface.referring import ReferringContext
from xavi_dialogue.nlg.surface.values import Who


def plan_which_one(answer: WhichOne, context: SpeechContext) -> Plan:
    """Plan a question what was meant, with numbered choices, of which no two look alike."""
    if answer.between == "vehicles":
        choices = tuple(_vehicle(one, answer) for one in answer.readings)
        items = choices
    else:
        items, choices = _told_apart(meant(answer, context.now), context)
    numbered = tuple(
        message("NUMBERED", number=f"({k})", it=item) for k, item in enumerate(items, 1)
    )
    return Plan((message("WHICH_ONE", items=numbered or None),), (), (), choices)


def _vehicle(one: object, answer: WhichOne) -> Message:
    """Return a vehicle as it looked when it was mentioned."""
    look = next((k for k in answer.looks if one == Vehicle(k.vehicle)), None)
    who = Who(one, None if look is None else look.time, ride=True)  # type: ignore[arg-type]
    return message("MEANT", kind="thing", who=who)


def _told_apart(
    askings: tuple[Asking, ...], context: SpeechContext
) -> tuple[tuple[Message, ...], tuple[Message, ...]]:
    """Return the choices as indirect and as direct questions, with times if they need them.

    Both are empty if even times do not distinguish them.
    """
    for timed in (False, True):
        items = tuple(one.message("MEANT", timed=timed) for one in askings)
        said = {realised(item, context, ReferringContext(context)) for item in items}
        if len(said) == len(items):
            return items, tuple(one.message("ASKED", timed=timed) for one in askings)
    return (), ()


def plan_taken_as(answer: TakenAs, context: SpeechContext) -> Plan:
    """Plan how an unclear question was understood."""
    return Plan((message("TAKEN_AS", question=answer.question),))


def plan_unfamiliar(answer: Unfamiliar, context: SpeechContext) -> Plan:
    """Plan the words that were not understood, before the answer to the rest."""
    words = tuple(f'"{one}"' for one in answer.words)
    slots = {"words": words, "many": len(words) > 1, "known": answer.known}
    return Plan((Message("UNFAMILIAR", slots),))
