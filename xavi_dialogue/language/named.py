"""Named first: "the truck, where is that off to?" names its vehicle before the question begins."""

from dataclasses import replace

import msgspec

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.beam import Budget, Prices, search
from xavi_dialogue.language.lattice import Cuts, Lattice
from xavi_dialogue.language.readings import Reading, read

_LEADING = frozenset({"AND", "OR", "ABOUT", "CONJ", "SMALL"})
_NOUNS = frozenset({"CAR", "KIND", "NUMBER", "OTHER"})
_NAMING = _NOUNS | {"THAT", "COLOUR", "PLACE", "ONLEFT", "ONRIGHT"}
_PRONOUNS = frozenset({"vehicle:it", "vehicle:that"})
_STEPS = 100  # a name is short


def named_first(lattice: Lattice, cuts: Cuts) -> str | None:
    """The vehicle named first and by itself: "the truck, where is that off to?"."""
    marks = [index for index, (_, edge) in enumerate(cuts) if edge.token.terminal == "BREAK"]
    if not marks:
        return None
    begin = next((i for i, (_, e) in enumerate(cuts) if e.token.terminal not in _LEADING), 0)
    named = {edge.token.terminal for _, edge in cuts[begin : marks[0]]}
    if not named & _NOUNS or not named <= _NAMING:
        return None
    prices = Prices({}, None, 0.5)
    span = cuts[begin][0], cuts[marks[0]][0]
    found = search("replace", lattice, span[0], frozenset(span[1:]), prices, Budget(_STEPS))
    reading = read(found[0].parse(), ()) if found else None
    return reading.query.actor if reading else None


def about_named(topic: str | None, reading: Reading | None) -> Reading | None:
    """The reading with the vehicle named first in the place of a pronoun."""
    if reading is None or topic is None or reading.query.actor not in _PRONOUNS:
        return reading
    query = msgspec.structs.replace(reading.query, actor=topic)
    return replace(reading, query=query, named_actor=True)


def of_named(query: Query, reading: Reading, topic: str | None) -> Query:
    """A bare "why not?" behind a vehicle named first asks about that vehicle."""
    if topic is None or reading.rule != "again":
        return query
    return msgspec.structs.replace(query, actor=topic)
