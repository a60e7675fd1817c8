"""Towards: the thing up to which something is measured."""

from xavi_dialogue.domain.terms import Ego, Event, Feature, Junction, Passenger, Road, Thing
from xavi_dialogue.nlu.compose.clauses.adoption import next_to_us
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Group, Sem, as_thing


def reference(clause: Clause) -> Thing | None:
    """Find the thing up to which it is measured."""
    for phrase in clause.complements:
        thing = _reached(phrase.sem)
        near = next_to_us(phrase.key, thing)
        if near is not None and (clause.there or isinstance(clause.subject, Ego | None)):
            return near  # "what gap do we have behind us", but "how far behind us is it"
        inside = phrase.key in ("in", "on") and isinstance(thing, Feature | Junction | Road)
        if thing is not None and phrase.key not in ("at", "by") and not inside:
            return thing
    for sem, _ in clause.objects:
        thing = _reached(sem)
        if thing is not None:
            return thing
    if isinstance(clause.than, Clause) or clause.than is None:
        return None
    return as_thing(clause.than)


def _reached(sem: Sem | None) -> Thing | None:
    """Take "the next turn" for the place where it is."""
    if isinstance(sem, Event) and sem.action in ("turn", "exit-left", "exit-right"):
        return Junction("junction", 1)
    if isinstance(sem, Group):  # "between you and the bus"
        things = [as_thing(member) for member in sem.members]
        return next((t for t in things if t not in (None, Ego(), Passenger())), None)
    return as_thing(sem)
