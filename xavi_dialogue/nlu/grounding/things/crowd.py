"""Crowd: the several of whom one is meant, or who are counted, where they were spoken of."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.terms import Described, Is, Pronoun, Related, Vehicle, Vehicles, Wanted
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.events.generic import across
from xavi_dialogue.nlu.grounding.things.scene import on_foot

_COUNTED: Final = Described(plural=True, definite=False)  # "how many?"

_THOSE: Final = (Pronoun("this"), Pronoun("that"), Pronoun("they"), Pronoun("it"))


def spoken_of(context: Context) -> tuple[int, ...]:
    """Give those who were spoken of together in this turn or the last, or whom one of them is with.

    Of people on foot who cross our way, all who do are meant, whoever of them was named.
    """
    discourse = context.discourse
    fresh = [m.thing for m in discourse.mentions if m.turn >= discourse.turn - 1]
    met = on_foot(context, context.now)
    groups = (t.numbers for t in fresh if isinstance(t, Vehicles) and len(t.numbers) > 1)
    named = next(groups, None) or tuple(t.number for t in fresh if isinstance(t, Vehicle))[:1]
    if len(met) > 1 and named and {*named} <= {*met}:
        return met
    return named if len(named) > 1 else ()


def of_them(thing: Described, context: Context) -> Described:
    """Take "the last one", "the nearest one" for one of those who were spoken of."""
    if (thing.rank is None and thing.extreme is None) or not thing.definite:
        return thing
    plain = Described(rank=thing.rank, extreme=thing.extreme, definite=True)
    numbers = spoken_of(context) if thing == plain else ()
    return replace(thing, among=Vehicles(numbers)) if numbers else thing


def counted(of: Described, context: Context) -> Described:
    """Give whom a count is of: by a bare "how many", "how many are there" who were spoken of."""
    of = replace(across(of), plural=True, definite=False)
    such = of.such
    there = such is None or (isinstance(such, Is) and such.state == "present")
    there = there and (such is None or getattr(such, "thing", None) == Wanted())
    those = isinstance(such, Related) and such.relation == "same-as" and such.to in _THOSE
    if those and replace(of, such=None, kind="vehicle") == _COUNTED:  # "how many people is this?"
        met = spoken_of(context) or on_foot(context, context.now)
        return replace(of, such=None, among=Vehicles(met)) if met else of
    if replace(of, such=None) != _COUNTED or not there:
        return of
    numbers = spoken_of(context)
    return replace(of, such=None, among=Vehicles(numbers)) if numbers else of
