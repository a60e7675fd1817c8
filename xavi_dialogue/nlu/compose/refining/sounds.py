"""Sounds: what passengers hear, which the car does not; it tells what it sees there."""

from typing import Final

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    HowMuch,
    Identify,
    Listing,
    Question,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Measured,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    That,
)
from xavi_dialogue.domain.vocabulary import Bearing
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.grammar.chart import Node

_SOUND: Final = HowMuch(Measured("sound"))
SOUND: Final = Ask(_SOUND)
#: Sides that a sound comes from, by the word classes that name them.
_PLACED: Final = ("BEARING", "BEARP", "FROM")
_SIDES: Final[tuple[Bearing, ...]] = ("left", "right", "behind", "ahead")
_EMERGENCY: Final = Ask(Whether(Exists(Described(kind="emergency", definite=False))))


def heard(clause: Clause, value: object) -> tuple[Act, ...]:
    """Read "I hear brakes on my right", "there is a siren" as asking for that sound; else ()."""
    if clause.there and (sound := sound_of(*_named(clause))) is not None:
        return (Ask(HowMuch(sound)),)
    if not isinstance(value, Special) or value.name != "hear" or clause.that is not None:
        return ()
    named = bool(clause.objects or clause.bearings)
    if not isinstance(clause.subject, Passenger) or clause.negated or not named:
        return ()
    sems = _named(clause)
    if any(isinstance(sem, Described) and sem.kind == "emergency" for sem in sems):
        return SOUND, _EMERGENCY
    return (Ask(HowMuch(sound_of(*sems) or _SOUND.of)),)


def sound_asked(clause: Clause, question: Question) -> HowMuch | None:
    """Read "are there sirens?", "where is that noise from?" as asking for the sound."""
    match question:
        case HowMuch(Measured("origin" | "sound")):
            sound = sound_of(clause.subject, *_named(clause))
        case Whether(Exists() | Not(Exists())) if clause.there:
            sound = sound_of(*_named(clause))
        case _:
            return None
    return None if sound is None else HowMuch(sound)


def sound_of(*sems: object) -> Measured | None:
    """Return the sound that is named, if one is."""
    measures = (sem.of for sem in sems if isinstance(sem, Measure))
    return next((of for of in measures if of.attribute == "sound"), None)


def _named(clause: Clause) -> tuple[object, ...]:
    return tuple(sem for sem, _ in clause.objects)


def of_sounds(acts: tuple[Act, ...], unit: Node) -> tuple[Act, ...]:
    """Read what is said or asked of a sound of others as asked for it, and for who is there."""
    found = tuple(_of_sound(act) for act in acts)
    if found != (SOUND,):
        return found
    if any(map(_is_siren, acts)):
        return SOUND, _EMERGENCY
    there = _there(unit)
    return found if there is None else (SOUND, there)


def of_one_sound(before: Act, later: Act) -> Act | None:
    """Read "what is that?" and "was that for us?" behind a sound as asked of the sound."""
    sound = before in (SOUND, _EMERGENCY) or _is_of_place(before)
    match later:
        case Ask(question=Identify(Pronoun("that" | "it")) | Why(That(), suspect=Ego())) if sound:
            return before
        case Ask(question=Whether(That())) if sound:
            return before
    return None


def _is_of_place(act: Act) -> bool:
    """Check whether an act asks who is at a place."""
    match act:
        case Ask(question=Listing("vehicles", Described(bearing=bearing, plural=True))):
            return bearing is not None
    return False


def _there(unit: Node) -> Ask | None:
    """Return the question for who is at the place that is named."""
    said = [leaf.key for leaf in leaves_of(unit) if leaf.category in _PLACED]
    bearing = next((side for side in _SIDES if side in said), None)
    if bearing is None:
        return None
    return Ask(Listing("vehicles", Described(bearing=bearing, plural=True, definite=False)))


def _is_siren(act: Act) -> bool:
    """Check whether the sound that is spoken of is that of an emergency vehicle."""
    match act:
        case Ask(question=HowMuch(of=Measured("sound", Described(kind="emergency")))):
            return True
        case Ask(question=Whether(that=of)) | Claim(that=of):
            of = of.content if isinstance(of, Not) else of
            sides = (of.left, of.right) if isinstance(of, Compares) else ()
            things = (side.thing for side in sides if isinstance(side, Measured))
            return any(isinstance(one, Described) and one.kind == "emergency" for one in things)
    return False


def _of_sound(act: Act) -> Act:
    match act:
        case Ask(question=HowMuch(of=Measured("sound", Ego(), Described()))):
            return SOUND
        case Ask(question=HowMuch(of=Measured("sound", Described(kind="emergency")))):
            return SOUND
        case Claim(that=that):
            return SOUND if _sounds(that) else act
        case Ask(question=Whether(that=of) | Which(such=of)):
            return SOUND if _sounds(of) else act
    return act


def _sounds(of: Proposition | None) -> bool:
    """Check whether a proposition is that somebody else makes a sound, or what a sound is."""
    match of:
        case Not(content=content):
            return _sounds(content)
        case Happens(event=Event(action="honk", actor=actor, modal=None)):
            return not isinstance(actor, Ego)
        case Compares(left=Measured("sound"), right=Measured("sound")):
            return True
    return False
