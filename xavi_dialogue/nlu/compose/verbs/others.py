"""Others: whom a question about another road user is of, and what its lights are asked to mean."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import Question, Why
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Everyone,
    Happens,
    Lane,
    Passenger,
    Pronoun,
    Related,
    Thing,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure, as_thing


def is_idle(event: Event) -> bool:
    """Say whether nothing is said of what somebody else is made to do."""
    return (
        event.action == "do"
        and (event.object is None or isinstance(event.object, Pronoun))
        and isinstance(event.actor, Described | Vehicle)
    )


def expected_of(value: Special) -> Thing | None:
    """Find of whom something was expected: "what did you expect of it"."""
    phrases = value.match.phrases
    found = (as_thing(phrases.get(key)) for key in ("of", "from", "about", "for"))
    return next((thing for thing in found if thing is not None), None)


def shown(clause: Clause) -> Question | None:
    """Ask "what does his blinker mean": why he indicates."""
    bare = clause.bare.verb if clause.bare is not None else None
    if "mean" not in {leaf.key for leaf in (clause.verb, bare) if leaf is not None}:
        return None
    sem = clause.subject
    if not isinstance(sem, Measure) or sem.of.attribute not in ("indicator", "brake-lights"):
        return None
    action: Any = "signal" if sem.of.attribute == "indicator" else "brake"
    return Why(Happens(Event(action, sem.of.thing, tense="present")))


def with_whom(clause: Clause) -> Thing | None:
    """Find who is meant by "what is wrong with him"."""
    found = (as_thing(p.sem) for p in clause.complements if p.key == "with")
    return next((thing for thing in found if thing is not None and is_vehicle(thing)), None)


def with_lane(clause: Clause) -> Lane | None:
    """Find which lane is meant by "what is wrong with this lane"."""
    found = (as_thing(p.sem) for p in clause.complements if p.key == "with")
    return next((thing for thing in found if isinstance(thing, Lane)), None)


def is_vehicle(thing: Thing) -> bool:
    """Say whether a thing is or stands for a road user other than us."""
    return isinstance(thing, Described | Vehicle | Pronoun)


def is_other(thing: Thing) -> bool:
    """Say whether a thing is somebody else on the road, of whom we cannot tell what he thinks."""
    return is_person(thing) or isinstance(thing, Described | Vehicle)


def is_of_us(special: Special) -> bool:
    """Say whether "it" that knows something of us is somebody else: "does it know we turn?"."""
    of = special.content
    ours = isinstance(of, Happens) and isinstance(of.event.actor, Ego)
    return ours and special.subject == Pronoun("it")


def is_person(thing: Thing | None) -> bool:
    """Say whether a thing is a pronoun for somebody on the road."""
    return isinstance(thing, Pronoun) and thing.form in ("he", "she", "they")


def placed(relation: str, thing: Thing, to: Thing) -> Thing:
    """Add to a description where the thing is."""
    bearings: dict[str, Any] = {
        "ahead-of": "ahead", "behind": "behind", "left-of": "left", "right-of": "right",
        "beside": "beside", "oncoming-to": "oncoming", "near": "around",
    }  # fmt: skip
    of = None if isinstance(to, (Ego, Passenger)) else to
    if relation == "near" and isinstance(thing, Pronoun) and isinstance(to, Described):
        return to  # "that on the motorbike", "this in green"
    if isinstance(thing, Pronoun) and thing.form in ("that", "this"):
        thing = Described()
    if isinstance(thing, Everyone):
        thing = Described(thing.kind, plural=True)
    if isinstance(thing, Described) and thing.bearing is None and relation in bearings:
        return cast(Thing, with_fields(thing, bearing=bearings[relation], of=of))
    return thing


def nearest(value: Related, wanted: Thing) -> Thing:
    """Describe the vehicle nearest to us in a direction."""
    kind = getattr(wanted, "kind", "vehicle")
    return placed(value.relation, Described(cast(Any, kind), extreme="nearest"), value.to)


def pointed_out(clause: Clause, event: Event) -> Thing | None:
    """Describe whom "who is that waiting on the right" points at; None of anybody else."""
    that = isinstance(event.actor, Pronoun) and event.actor.form in ("that", "this")
    stranded = any(phrase.sem is None for phrase in clause.complements)
    if not that or stranded or not isinstance(event.object, Wanted):
        return None
    where = event.where.relation if event.where is not None else None
    place = next((b for b, _ in clause.bearings), event.side)
    place = {"left-of": "left", "right-of": "right", "behind": "behind"}.get(where or "", place)
    deed = with_fields(event, actor=Wanted(), object=None, side=None, where=None)
    bearing = None if place in ("there", "here", "straight") else place
    return Described(doing=deed, bearing=cast(Any, bearing))
