"""Hiding: somebody unknown who is behind something, or comes out from behind it."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.terms import (
    Described,
    Event,
    Everyone,
    Exists,
    Feature,
    Nobody,
    Pronoun,
    Related,
    Thing,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.context import Grounder
from xavi_dialogue.nlu.grounding.salience import vehicles_of

#: Kinds that are as a rule so tall that they hide others.
TALL: Final = frozenset(("bus", "truck", "van", "tram"))
COMING: Final = frozenset(("come", "appear", "pull-out", "cross"))
LAST: Final = 0.3  # salience from which a vehicle was spoken of lately
BLIND: Final = Feature("blind")  # whatever it is that hides the road


def past_hider(spoken: Related, g: Grounder) -> Related:
    """Take "it" in "see past it" and "comes from behind it" for what hides the road."""
    if spoken.relation == "sees-past" and isinstance(spoken.to, Pronoun):
        return replace(spoken, to=BLIND)
    if spoken.relation in ("behind", "from") and _unknown(spoken.thing):
        return replace(spoken, to=_hider(spoken.to, g))
    return spoken


def somebody_behind(spoken: Related, g: Grounder) -> Exists | None:
    """Ask whether anybody is there in the place of whether somebody unknown is behind it."""
    thing = spoken.thing
    if spoken.relation != "behind" or not isinstance(thing, Described) or not _unknown(thing):
        return None
    to = _hider(spoken.to, g)
    if not isinstance(to, Described | Vehicle | Feature):
        return None
    described = replace(thing, bearing="behind", of=to)
    there = Nobody(described=described) if isinstance(to, Feature) else described
    return Exists(there, time=spoken.time, tense=spoken.tense)


def behind_hider(spoken: Exists, g: Grounder) -> Exists:
    """Take "it" in "there is nobody behind it" for what hides the road."""
    thing = spoken.thing
    described = thing.described if isinstance(thing, Nobody) else thing
    if not isinstance(described, Described) or described.bearing != "behind":
        return spoken
    if not isinstance(described.of, Pronoun | Feature) or described.definite:
        return spoken
    found = replace(described, of=_hider(described.of, g))
    if isinstance(found.of, Feature):
        return replace(spoken, thing=Nobody(described=found))
    return replace(spoken, thing=replace(thing, described=found) if thing != described else found)


def out_of(spoken: Event, g: Grounder) -> Event:
    """Take "it" in "somebody comes out from behind it" for what hides the road."""
    if spoken.action in COMING and isinstance(spoken.object, Pronoun) and _unknown(spoken.actor):
        return replace(spoken, object=_hider(spoken.object, g))
    return spoken


def _unknown(thing: Thing) -> bool:
    """Tell whether nobody in particular is meant."""
    if isinstance(thing, Nobody | Everyone):
        return True
    return isinstance(thing, Described) and not thing.definite and thing.doing is None


def _hider(thing: Thing, g: Grounder) -> Thing:
    """Give what "it" is: who is tall and was spoken of last, else whatever hides the road."""
    if not isinstance(thing, Pronoun):
        return thing
    spoken = [v for v, salience in vehicles_of(g.context.discourse.mentions) if salience >= LAST]
    looks = ((v, g.context.look(v, g.context.now)) for v in spoken)
    return next((Vehicle(v) for v, look in looks if _tall(look)), BLIND)


def _tall(look: Look | None) -> bool:
    return look is not None and look.kind in TALL
