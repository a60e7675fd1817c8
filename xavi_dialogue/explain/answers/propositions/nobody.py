"""Nobody: who does what nobody of a kind does, and who is about to cross where nobody does yet."""

from dataclasses import replace

from msgspec import structs

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.facts import Episode, Fact
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Nobody,
    Proposition,
    Vehicle,
)
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.ride.walking import about_to_cross

NAMED = 2  # number of people about to cross who are named


def of_nobody(that: Proposition, found: Finding, asked: Asked) -> tuple[Proposition, Finding]:
    """Name who does what a question asks of anybody; else who is about to cross."""
    match that, found.facts:
        case Happens(Event(actor=Nobody()) as event), (Episode(actor=Vehicle() as who), *_) if (
            found.holds
        ):
            return Happens(structs.replace(event, actor=who)), found
    coming = _coming(that, asked) if found.holds is False else ()
    return that, replace(found, facts=coming) if coming else found


def _coming(that: Proposition, asked: Asked) -> tuple[Fact, ...]:
    """Return who is about to cross where nobody does yet: whom we let go, else what is expected."""
    match that:
        case Happens(event=Event("cross", Nobody(described=Described() as who), tense="present")):
            pass
        case Exists(
            thing=Nobody(described=Described(doing=Event("cross", tense="present")) as who)
        ):
            pass
        case _:
            return ()
    plain = who.kind in ("vehicle", *ON_FOOT) and (who.colour, who.size) == (None, None)
    those = [v for v in asked.world.in_view(asked.now) if plain and about_to_cross(asked, v)]
    now = asked.now
    found: list[Fact | None] = []
    for v in those[:NAMED]:
        given = asked.world.episodes(Ego(), ("give-way",), now, now, object=Vehicle(v))
        found.append(next((e for e in given if e.end is None), asked.world.belief(v, now)))
    return tuple(fact for fact in found if fact is not None)
