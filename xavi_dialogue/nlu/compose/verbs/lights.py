"""Traffic lights: "the red light", "it turned green", "on red", "run the light", "have green"."""

from collections.abc import Iterable
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Feature,
    Happens,
    Has,
    Measured,
    Passenger,
    Pronoun,
    Proposition,
    Thing,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import Bearing
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Complement
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Sem, Specified, as_thing
from xavi_dialogue.nlu.compose.clauses.traits import Traits
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.compose.verbs.deeds import event_of, tense_of, time_of
from xavi_dialogue.nlu.grammar.chart import Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

#: What a traffic light may show, as it is said.
LIT: Final = frozenset({"red", "green", "amber", "yellow", "orange"})
#: By what a light is passed or waited at: "through red", "at red", "on amber".
BY: Final = frozenset({"on", "at", "over", "for", "in", "during", "past"})
_THERE: Final = frozenset({"there", "ahead", "here"})
_OURS: Final = (Ego, Passenger, Wanted)


def colour_of(sem: object) -> str | None:
    """Tell the colour of a noun phrase that is a colour of lights: "on red", "on red here"."""
    if not isinstance(sem, Described) or sem.colour not in LIT:
        return None
    here: Bearing | None = "here" if sem.bearing == "here" else None
    plain = Described(colour=sem.colour, definite=sem.definite, bearing=here)
    return sem.colour if sem == plain else None


def is_colour(said: tuple[Sem, Part]) -> bool:
    """Tell whether a noun phrase names a colour alone, or where it shows: "red up there"."""
    sem, part = said
    if not isinstance(sem, Described):
        return False
    plain = Described(colour=sem.colour, definite=sem.definite)
    there = sem.colour in LIT and sem.bearing in _THERE
    noun = any(leaf.category == "KIND" for leaf in leaves_of(part))
    return sem == plain or (there and not noun and sem == replace(plain, bearing=sem.bearing))


def on_light(key: str, sem: Sem | None, leaves: Iterable[Leaf]) -> Sem | None:
    """Take "red" in "on red" or "at a red" for a light that shows it, but not "the red one"."""
    noun = any(leaf.category == "KIND" for leaf in leaves)
    colour = colour_of(sem) if key in BY and not noun else None
    return sem if colour is None else Feature("light", colour=colour)


def light_of(head: Leaf, traits: Traits, owner: Thing | None) -> Sem:
    """Read a noun phrase with a traffic light as its head."""
    several = head.form == "plural"
    if owner is not None and not isinstance(owner, Ego) and several:
        return Measure(Measured("indicator", owner))
    colour = traits.fields.get("colour")
    rank = 1 if traits.following else traits.ordinal
    of = None if isinstance(owner, Ego) else owner
    light = Feature("light", colour=colour if colour in LIT else None, rank=rank, of=of)
    return light if traits.clause is None else Specified(light, traits.clause)


def coloured(special: Special) -> Proposition:
    """Read "it turned green", "the light changed to red", "when do we get green"."""
    return Happens(_shows(special, "turn-colour"))


def stays(special: Special) -> Proposition:
    """Read "the light stayed red"."""
    return Happens(_shows(special, "show"))


def _shows(special: Special, action: str) -> Event:
    colour = colour_of(special.object) or getattr(special.object, "colour", None)
    event = event_of(special, action, Feature("light", colour=colour))
    verb = special.clause.verb
    return _of_light(event, gets=verb is not None and verb.key == "get")


def _of_light(event: Event, *, gets: bool) -> Event:
    """Give what is said of who faces a light to the light: "we got green".

    Lights themselves turn, change or go to a colour; people get one.
    """
    who = event.actor
    if isinstance(who, Feature) or (isinstance(who, Pronoun) and not (gets and who.form != "it")):
        return event
    of = None if isinstance(who, _OURS) else who
    return replace(event, actor=Feature("light", of=of))


def faced_by(colour: str, thing: Thing, complements: Iterable[Complement]) -> Thing:
    """Take "it" in "it is red for the others" for the light that they face."""
    if colour not in LIT or not isinstance(thing, Feature | Pronoun):
        return thing
    who = next((as_thing(c.sem) for c in complements if c.key == "for"), None)
    if who is None:
        return thing
    return _faced(who)


def ran(special: Special) -> Proposition:
    """Read "you ran the light", "jumped a red": it was red, where nothing else is said."""
    sem = on_light("on", special.object, ())
    light = as_thing(sem)
    if not isinstance(light, Feature) or light.kind != "light":
        return Happens(event_of(special, "cross", as_thing(special.object)))
    red = Feature("light", colour=light.colour or "red", rank=light.rank, of=light.of)
    return Happens(event_of(special, "pass", red))


def made(special: Special) -> Proposition:
    """Read "will we make the light", "catch the green": whether it lets us through."""
    thing = as_thing(on_light("on", special.object, ()))
    light = isinstance(thing, Feature) and thing.kind == "light"
    return Happens(event_of(special, "pass" if light else "do", thing))


def had_light(special: Special) -> Proposition | None:
    """Read "we had green", "he has a red light"; None where nothing of the kind is said."""
    sem = special.object
    colour = colour_of(sem)
    if colour is None and isinstance(sem, Feature) and sem.kind == "light":
        colour = sem.colour
    if colour is None:
        return None
    who = special.subject
    return Has("colour", colour, _faced(who), time_of(special), tense_of(special))


def _faced(who: Thing) -> Feature:
    """Give the light that somebody faces: anybody's is that of all others."""
    if isinstance(who, Ego | Passenger):
        return Feature("light")
    anybody = isinstance(who, Described) and who == Described(definite=False, other=who.other)
    return Feature("light", of=Everyone() if anybody else who)


def shining(of: Proposition | None) -> Event | None:
    """Take "when it was red" for the time over which the light showed that."""
    if not isinstance(of, Has) or of.attribute != "colour" or of.value not in LIT:
        return None
    if not isinstance(of.thing, Feature | Pronoun):
        return None
    what = Feature("light", colour=of.value)
    return Event("show", of.thing, what, time=of.time, tense=of.tense)
