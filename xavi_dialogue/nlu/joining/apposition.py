"""Apposition: "what is he doing, the red one?", "who is that waiting for, us?".

What is named last tells who the words before it mean, or is put forward as the answer.
"""

from typing import Any

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Doing,
    Elliptic,
    HowMuch,
    Question,
    Repair,
    Whether,
    Which,
)
from xavi_dialogue.domain.rewriting import substitute
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Ego,
    Feature,
    Happens,
    Measured,
    Pronoun,
    Quantity,
    Thing,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.sem import as_speed

BRISK = 20  # [km/h] from which on "what is it doing, 90?" puts a speed forward
_FORMS = frozenset({"it", "he", "she", "that", "this", "one"})


def apposed(act: Act, later: Act) -> Act | None:
    """Put what is named behind a question into it; None where it does not belong there."""
    if isinstance(later, Repair) and later.pick is not None:
        return guessed(act.question, later.pick) if isinstance(act, Ask) else None
    if not isinstance(act, Ask | Claim) or not isinstance(later, Elliptic):
        return None
    thing = later.thing
    if later != Elliptic(thing) or not isinstance(thing, Described | Vehicle | Ego | Feature):
        return None
    vague = _vague(act)
    if isinstance(thing, Feature):  # "is it still red, the light?", "it is broken, this light?"
        return substitute(act, vague, thing) if isinstance(vague, Pronoun) else None
    if isinstance(act, Claim):
        return _named(act, thing)
    question = act.question
    if isinstance(question, Which) and question.such is not None and not question.among:
        such = substitute(question.such, Wanted(), thing)
        if question.thing == Wanted() and such is not question.such:
            return Ask(Whether(such))  # "who is it waiting for, us?"
    if isinstance(thing, Ego):
        return None
    if vague is None or _elsewhere(vague, thing):
        return None
    return substitute(act, vague, _merged(vague, thing))


def guessed(asked: Question | None, number: int) -> Ask | None:
    """Put a mere number behind a question about a speed forward as that speed in km/h."""
    match asked:
        case HowMuch(of=Measured(attribute="speed" | "limit") as of):
            return Ask(Whether(Compares(of, "same", _pace(number))))
        case Whether(that=Compares(left=Measured(attribute="speed" | "limit"))):
            return Ask(Whether(structs.replace(asked.that, right=_pace(number))))
        case Doing(actor=thing, tense="present") if thing is not None and number >= BRISK:
            of = Measured("speed", thing, time=asked.time)
            return Ask(Whether(Compares(of, "same", _pace(number))))
    return None


def _pace(number: int) -> Quantity:
    return as_speed(Quantity(float(number), "count"))


def _elsewhere(vague: Pronoun | Described, thing: Described | Vehicle) -> bool:
    """Say whether somebody in another place is named: "the gap ahead? And behind?"."""
    places = getattr(vague, "bearing", None), getattr(thing, "bearing", None)
    return None not in places and places[0] != places[1]


def _named(act: Claim, thing: Thing) -> Act | None:
    """Put who is named into "he brakes hard, this black one"."""
    event = act.that.event if isinstance(act.that, Happens) else None
    if event is None or not isinstance(event.actor, Pronoun) or event.actor.form not in _FORMS:
        return None
    if isinstance(thing, Ego) or (isinstance(thing, Described) and not thing.definite):
        return None
    return Claim(Happens(structs.replace(event, actor=thing)))


def _vague(value: Any) -> Pronoun | Described | None:
    """Find a pronoun, or a description that tells no more than where somebody is."""
    if isinstance(value, Pronoun):
        return value if value.form in _FORMS else None
    if isinstance(value, Described):
        plain = Described(bearing=value.bearing, origin=value.origin, other=value.other)
        named = structs.replace(plain, kind=value.kind, definite=value.definite)
        return value if value == plain or (value.other and value == named) else None
    if isinstance(value, tuple):
        return next((v for part in value if (v := _vague(part)) is not None), None)
    names = getattr(value, "__struct_fields__", ())
    return next((v for n in names if (v := _vague(getattr(value, n))) is not None), None)


def _merged(vague: Pronoun | Described, thing: Described | Vehicle) -> Thing:
    """Give the thing that is named, with the place that was stated before."""
    if isinstance(vague, Pronoun) or isinstance(thing, Vehicle):
        return structs.replace(thing, definite=True) if isinstance(thing, Described) else thing
    return structs.replace(
        thing,
        bearing=thing.bearing or vague.bearing,
        origin=thing.origin or vague.origin,
        kind=vague.kind if thing.kind == "vehicle" else thing.kind,
        definite=True,
    )
