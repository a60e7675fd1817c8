"""Followers: what comes after the head of a noun phrase, such as clauses, places and owners."""

from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Happens,
    Has,
    Is,
    Lane,
    Not,
    Passenger,
    Related,
    Thing,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.extents import extreme_of
from xavi_dialogue.nlu.compose.clauses.sem import Group, Measure, Sem, as_thing
from xavi_dialogue.nlu.compose.clauses.traits import Traits
from xavi_dialogue.nlu.compose.clauses.tree import is_negated, leaves_of
from xavi_dialogue.nlu.grammar.chart import Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_RELATIONS = {
    "ahead": "ahead-of",
    "behind": "behind",
    "left": "left-of",
    "right": "right-of",
    "beside": "beside",
    "oncoming": "oncoming-to",
    "around": "near",
    "in-way": "in-the-way-of",
    "here": "near",
    "there": "near",
    "far": "near",
}


#: Verbs that say no more than that somebody is there, or on the move.
_MOVING = frozenset(("go", "drive", "do", "move", "travel", "ride", "come", "stand", "wait", "sit"))

#: Deeds that lead nowhere, so that a place beside them is where their actor is.
_STAYING = frozenset(("stand", "wait", "move", "brake", "slow-down", "speed-up", "signal"))


class Followers:
    """Notes what comes after a head; `clauses` reads the clauses."""

    def __init__(self, clauses: Any) -> None:
        self.clauses = clauses

    def read(self, node: Node) -> Sem:
        """Read a noun phrase."""
        raise NotImplementedError

    def modify(self, part: Part, traits: Traits) -> None:
        """Note a part that can also come before the head."""
        raise NotImplementedError

    def follow(self, part: Part, traits: Traits) -> None:
        """Note a part that comes after the head."""
        if isinstance(part, Leaf):
            self.modify(part, traits)
            return
        match part.name:
            case "of":
                traits.of = self.clauses.inner(part.parts[1])
            case "at_bearing":
                leaf = cast(Leaf, part.parts[0])
                seen = self.read(cast(Node, part.parts[1]))
                if isinstance(seen, Group) and isinstance(seen.members[-1], Measure):
                    traits.beside = seen.members[1:]  # "the bus behind us and the speed"
                of = as_thing(seen)
                traits.fields["bearing"] = "ahead" if leaf.key == "in-way" else leaf.key
                traits.fields["of"] = None if isinstance(of, (Ego, Passenger)) else of
            case "relative" | "contact" | "participle" | "extent":
                self._clause_behind(part, traits)
            case "attached":
                key = cast(Leaf, part.parts[0]).key
                sem = self.clauses.inner(part.parts[1])
                traits.about.append((key, sem))
                if isinstance(sem, Lane) and key in ("in", "on"):
                    traits.fields["such"] = Related("on", Wanted(), sem)  # "the one in our lane"
                gerund = part.parts[1]
                if isinstance(sem, Event) and isinstance(gerund, Node) and is_negated(gerund):
                    traits.clause = Not(Happens(sem))  # "the reason for not stopping"

    def _clause_behind(self, part: Node, traits: Traits) -> None:
        traits.gerund = part
        if (most := self._most(part)) is not None:
            traits.fields |= {"extreme": most, "definite": True}  # "the one who is nearest"
            return
        if traits.reason and part.name in ("contact", "relative"):
            found = self.clauses.noun_clause(part)  # "the reason you stopped"
        else:
            found = self.clauses.relative_proposition(part)
            self._place(part, found, traits)
        traits.clause = found
        match found:
            case Happens(event=event):
                event = self._placed(event, traits)
                traits.fields["doing"] = event
                traits.event = event
            case Related(relation=relation, thing=Wanted(), to=to):
                bearing = next((b for b, r in _RELATIONS.items() if r == relation), None)
                if isinstance(to, Lane):
                    traits.fields["such"] = found
                if bearing is not None:
                    traits.fields["bearing"] = bearing
                    traits.fields["of"] = None if isinstance(to, Ego) else to
            case None:
                pass
            case _:
                traits.fields["such"] = found

    def _place(self, part: Part, found: Any, traits: Traits) -> None:
        """Note a place that a clause names and its meaning leaves out: "racing on the right"."""
        match found:
            case Happens(event=Event(action=action, where=None)) if action in _STAYING:
                pass
            case Is() | Has():
                pass
            case _:
                return
        there = [key for key, _ in self.clauses.relative_clause(part).bearings if key != "there"]
        if there:
            traits.fields.setdefault("bearing", there[0])

    def _most(self, part: Node) -> str | None:
        """Return by what somebody stands out of whom a relative clause says no more than that."""
        if part.name != "relative" or not any(x.key == "superlative" for x in leaves_of(part)):
            return None
        clause = self.clauses.relative_clause(part)
        return extreme_of(clause) if clause.verb is None and not clause.objects else None

    def _placed(self, event: Event, traits: Traits) -> Event:
        """Turn "standing on the right" into the bearing of the road user."""
        where = event.where
        if where is None or where.thing != Wanted() or not isinstance(where.to, Ego):
            return event
        bearing = next((b for b, r in _RELATIONS.items() if r == where.relation), None)
        if bearing is None or "bearing" in traits.fields:
            return event
        traits.fields["bearing"] = bearing
        return structs.replace(event, where=None)


def doing(thing: Thing, event: Event | None) -> Sem:
    """Read "vehicle 1 entering our lane" as an event."""
    if event is None:
        return thing
    return structs.replace(event, actor=thing) if isinstance(event.actor, Wanted) else event


def relation_of(bearing: str) -> str:
    """Return the relation for a bearing: "ahead-of" for "ahead"."""
    return _RELATIONS.get(bearing.split("-")[0], "near")


def place_subject(clause: Clause) -> None:
    """Make "behind us" a part of the subject: "how fast is the car behind us", "driving ..."."""
    subject = clause.subject
    if not isinstance(subject, Described) or subject.bearing is not None or clause.objects:
        return
    if not clause.has("be") if clause.verb is None else clause.verb.key not in _MOVING:
        return
    if (placed := _there(subject, clause)) is not None:
        clause.subject, clause.the_car = placed, False


def _there(subject: Described, clause: Clause) -> Described | None:
    """Return a road user with a place that its clause names, which is taken from the clause."""
    if clause.origin is not None and subject.origin is None:
        origin, clause.origin = clause.origin, None
        return structs.replace(subject, origin=cast(Any, origin))
    for one in clause.complements:
        bearing = one.key.removeprefix("bearing-")
        there = one.key in ("in", "on") and isinstance(one.sem, Lane) and subject.such is None
        seen = isinstance(one.sem, Ego | Passenger) and bearing != one.key
        if there or seen:
            clause.complements = [c for c in clause.complements if c is not one]
            if seen:
                return structs.replace(subject, bearing=cast(Any, bearing))
            on = Related("on", Wanted(), cast(Lane, one.sem))  # "the car in the middle lane"
            return structs.replace(subject, such=on)
    if not clause.bearings or clause.bearings[0][0] == "there":
        return None
    bearing, _ = clause.bearings.pop(0)
    return structs.replace(subject, bearing=cast(Any, bearing))
