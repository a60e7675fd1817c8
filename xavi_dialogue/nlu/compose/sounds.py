"""Sounds: what passengers hear, which the car does not; it tells what it sees there."""

from typing import Final

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    HowMuch,
    Identify,
    Listing,
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

SOUND: Final = Ask(HowMuch(Measured("sound")))
SIRENS: Final = frozenset(("siren", "sirens", "ambulance"))
#: By where a sound comes from: words that say so.
_PLACES: Final[dict[Bearing, frozenset[str]]] = {
    "right": frozenset(("right",)), "left": frozenset(("left",)),
    "behind": frozenset(("behind", "back", "rear")), "ahead": frozenset(("ahead", "front")),
}  # fmt: skip
_IT: Final = Claim(Exists(Pronoun("that")))
_EMERGENCY: Final = Ask(Whether(Exists(Described(kind="emergency", definite=False))))


def heard(clause: Clause, value: object) -> tuple[Act, ...]:
    """Read "I hear brakes on my right": the question for that sound; () otherwise."""
    if not isinstance(value, Special) or value.name != "hear" or clause.that is not None:
        return ()
    named = bool(clause.objects or clause.bearings)
    if not isinstance(clause.subject, Passenger) or clause.negated or not named:
        return ()
    return (SOUND,)


def of_sounds(acts: tuple[Act, ...], words: str) -> tuple[Act, ...]:
    """Read what is said or asked of a sound of others as asked for it, and for who is there."""
    said = {*words.split()}
    if _IT in acts and SIRENS & said:
        return SOUND, _EMERGENCY  # "there is a siren somewhere"
    found = tuple(_of_sound(act) for act in acts)
    if found != (SOUND,):
        return found
    if SIRENS & said:
        return SOUND, _EMERGENCY
    return found if (there := _there(said)) is None else (SOUND, there)


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


def _there(said: set[str]) -> Ask | None:
    """Return the question for who is at the place that is named."""
    bearing = next((found for found, names in _PLACES.items() if said & names), None)
    if bearing is None:
        return None
    return Ask(Listing("vehicles", Described(bearing=bearing, plural=True, definite=False)))


def _of_sound(act: Act) -> Act:
    match act:
        case Ask(question=HowMuch(of=Measured("sound", Ego(), Described()))):
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
