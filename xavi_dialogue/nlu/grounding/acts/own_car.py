"""Own car: "the car" beside others is ours, as long as no other car was spoken of."""

from typing import Any, Final

from msgspec.structs import replace

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.meaning import Act, Ask, Doing, WhatIf, Whether
from xavi_dialogue.domain.rewriting import rewrite
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Happens,
    Is,
    Measured,
    Nobody,
    Not,
    Pronoun,
    Proposition,
    Thing,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.nlu.grounding.context import Grounder
from xavi_dialogue.nlu.grounding.salience import vehicles_of

PLAIN: Final = (Described(kind="car"), Described(kind="vehicle"))
SPOKEN: Final = 0.2  # salience from which a car is spoken of
_PAST: Final = ("past", "perfect")  # as those ask who look back on a ride
_MEETING: Final = frozenset(
    ("collide", "nearly-collide", "give-way", "let-go", "approach", "avoid")
)


def own_car(spoken: Act, g: Grounder) -> Act:
    """Take "the car" for ours where it meets others: "how close did the car come to him?"."""
    kinds = _spoken_of(g)
    match spoken:
        case Ask(
            question=WhatIf(supposed, Whether(Happens(Event(actor=Ego()))) | Doing() as then)
        ) if not kinds:
            return Ask(WhatIf(_ours(supposed), then))
    found = spoken if "car" in kinds else rewrite(spoken, _meant)
    return found if found == spoken else rewrite(found, _likewise)


def _meant(part: Any) -> Any:
    match part:
        case Event(actor=actor, action=action, object=other) if actor in PLAIN:
            meets = action in _MEETING and _others(other)
            told = part.tense in _PAST and not isinstance(other, Ego)
            return replace(part, actor=Ego()) if meets or told else part
        case Event(actor=actor, object=other) if other in PLAIN and _others(actor):
            return replace(part, object=Ego())
        case Is(thing=thing, tense=tense) if thing in PLAIN and tense in _PAST:
            return replace(part, thing=Ego())
        case Measured(thing=thing, to=to) if thing in PLAIN and _others(to):
            return replace(part, thing=Ego())
        case Measured(thing=thing, to=to) if to in PLAIN and _others(thing):
            return replace(part, to=Ego())
    return part


def _likewise(part: Any) -> Any:
    """Take "the car" for ours in the rest of an act, too: "while turning right"."""
    match part:
        case Event(actor=actor) if actor in PLAIN:
            return replace(part, actor=Ego())
    return part


def _ours(supposed: Proposition) -> Proposition:
    """Take "it" for our car where what we would have done then is asked."""
    match supposed:
        case Not(content=content):
            return replace(supposed, content=_ours(content))
        case Happens(event=Event(actor=Pronoun("it"), object=None) as event):
            return Happens(replace(event, actor=Ego()))
    return supposed


def _others(thing: Thing | None) -> bool:
    """Check whether a thing is somebody else, and more than a bare "the car"."""
    if isinstance(thing, Described):
        return thing not in PLAIN
    return isinstance(thing, Everyone | Nobody | Vehicle | Vehicles)


def _spoken_of(g: Grounder) -> tuple[str, ...]:
    """List the kinds of those who drive and were spoken of; who is not known counts as a car."""
    spoken = (v for v, salience in vehicles_of(g.context.discourse.mentions) if salience > SPOKEN)
    looks = (g.context.look(v, g.context.now) for v in spoken)
    kinds = ("car" if look is None else look.kind for look in looks)
    return tuple(kind for kind in kinds if kind not in ON_FOOT)
