"""Fitting: whether an answer tells what was asked, and what is asked instead if it does not. Pure.

A reason has to name a reason, a supposition is not answered by the world as it is, and who is named
in a question of right of way has to be in the answer. What is asked instead is the general question
of the same kind, about the same vehicle and time: why we drive as we do, what a vehicle does.
"""

from collections.abc import Iterator
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.answers import (
    Activity,
    Answer,
    Beliefs,
    Closeness,
    Counted,
    DidNotHappen,
    Located,
    MotionReason,
    OtherReason,
    Priority,
    Reaction,
    Refusal,
    TooLittle,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Ask, Doing, Question, WhatIf, Whether, Why
from xavi_dialogue.domain.rewriting import first, parts
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Happens,
    Is,
    Not,
    Proposition,
    Tense,
    Vehicle,
    Vehicles,
)

Result = Answer | Refusal

#: Answers that name no reason.
UNREASONED: Final = (Activity, Beliefs, Counted, Located)
#: How we react to somebody who is in our way.
REACTING: Final = frozenset(("room", "short", "first", "joins"))
GOING: Final = frozenset(("go", "move", "take", "do"))


def fits(act: GroundedAct, results: tuple[Result, ...]) -> bool:
    """Tell whether one of the answers to an act tells what it asks."""
    match act.act:
        case Ask(question=question):
            return any(_tells(question, one) for one in results)
    return True


def _tells(question: Question, result: Result) -> bool:
    match question, result:
        case Why(), OtherReason():
            return bool(result.causes) or result.goal is not None or result.ours is not None
        case Why(of=Not(content=Happens(event=Event(action=action)))), DidNotHappen():
            return action not in GOING or result.answer is not None
        case Why(suspect=suspect), MotionReason():
            return suspect is None or result.suspected is not None
        case Why(), _:
            return not isinstance(result, UNREASONED)
        case WhatIf(), Reaction(kind=kind):
            return kind in REACTING
        case WhatIf(), _:
            return not isinstance(result, Closeness)
        case Whether(), Priority(vehicle=None, others=()):
            return first(question, (Vehicle, Vehicles)) is None
    return True


def instead(act: GroundedAct) -> Iterator[GroundedAct]:
    """Give what is asked instead, the closest first."""
    match act.act:
        case Ask(question=question):
            for one in _general(question):
                if one != question:
                    yield replace(act, act=Ask(one), doubts=(), strange=())


def untried(act: GroundedAct) -> TooLittle | None:
    """Own up that something which we are supposed to have done was not tried; None of others."""
    match act.act:
        case Ask(question=WhatIf(supposed=Happens(event=Event(actor=Ego(), tense="past")))):
            return TooLittle("too-little-evidence")
    return None


def _general(question: Question) -> Iterator[Question]:
    match question:
        case Why(of=of):
            vehicle = _of_one(of)
            tense = _tense(of)
            if vehicle is None:
                yield Why(Happens(Event("do", tense=tense)))
            elif question.suspect or question.rival:
                yield replace(question, of=Is("slow", Ego(), tense=tense))
        case WhatIf(supposed=Happens(event=Event(actor=Vehicle() as vehicle, object=whom))):
            if whom != Ego():
                yield WhatIf(Happens(Event("stop", vehicle)))  # whatever stops it
        case _:
            vehicle = None if isinstance(question, WhatIf) else _of_one(question)
            if vehicle is not None:
                yield Doing(vehicle)


def _of_one(value: Question | Proposition) -> Vehicle | None:
    """Give the one vehicle that a term is about; None: of none, or of several."""
    found = set(parts(value, Vehicle))
    several = first(value, Vehicles) is not None
    return next(iter(found)) if len(found) == 1 and not several else None


def _tense(of: Proposition) -> Tense:
    event = first(of, Event)
    return "present" if event is None else event.tense
