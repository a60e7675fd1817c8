"""Holding: who or what holds us up, as "it" behind a question for that."""

from typing import Final

from xavi_dialogue.domain.meaning import Question, Whether, Which
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Ego,
    Event,
    Feature,
    Happens,
    Measured,
    Thing,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.things.scene import nearest

HOLDING: Final = frozenset[ActionName](("give-way", "wait", "follow"))
SINCE: Final = 1.0  # [s] since its end for which somebody still holds us up
_OPEN: Final = (Wanted(), Described(definite=False))


def holder(question: Question, context: Context) -> Thing | None:
    """Give what holds us up now, where a question asks for it: a road user or a red light."""
    of = question.such if isinstance(question, Which) else None
    of = question.that if isinstance(question, Whether) else of
    match of:
        case Compares(left=Measured("delay", thing, tense="present")) if thing in _OPEN:
            pass
        case Happens(event=Event("block", actor, Ego(), tense="present")) if actor in _OPEN:
            pass
        case _:
            return None
    now = context.now
    on = [
        deed
        for deed in context.deeds(Ego(), max(context.begin, now - SINCE), now)
        if deed.action in HOLDING and (deed.end is None or deed.end >= now)
    ]
    numbers = [deed.object.number for deed in on if isinstance(deed.object, Vehicle)]
    near = nearest(context, numbers, now)
    if near:
        return Vehicle(near[0].vehicle)
    light = Feature("light")
    red = Event("show", light, Feature("light", colour="red"))
    shown = context.world.holds(red, now, now)
    return light if any(one.end is None or one.end >= now for one in shown) else None
