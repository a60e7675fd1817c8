"""Towards: how far it is to something, and up to what something is measured."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import HowMuch, Listing, Question, When
from xavi_dialogue.domain.terms import (
    Destination,
    Ego,
    Event,
    Feature,
    Happens,
    Junction,
    Measured,
    Next,
    Passenger,
    Pronoun,
    Relative,
    Road,
    Thing,
    Unsaid,
)
from xavi_dialogue.nlu.compose.clauses.adoption import next_to_us, with_fields
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Group, Measure, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.wh_questions.lasting import measured

#: Turns at a junction, and going straight on there.
WAYS = frozenset({"turn", "exit-left", "exit-right", "exit-straight"})


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


def far_to(
    clause: Clause, event: Event | None, value: Any, actor: Thing | None,
    words: tuple[str, ...] = (),
) -> Question:  # fmt: skip
    """Ask how far it is to something; what is left is to the destination."""
    if clause.side == "left" and not clause.objects:
        return HowMuch(Measured("distance-to-go"))
    if clause.verb is not None and clause.verb.key == "see" and not clause.objects:
        return Listing("hidden", time=clause.time)  # "how far can you see": what ends our sight
    if any(
        isinstance(p.sem, Measure) and p.sem.of.attribute == "limit" for p in clause.complements
    ):
        return measured("excess", clause, actor)  # "how far over the limit are we"
    turn = _next_turn(clause)
    if turn is not None and not remaining(clause, actor):
        return HowMuch(Measured("turn", event=turn))
    to = reference(clause)
    if to is None and remaining(clause, actor):
        return measured("distance-to-go", clause, Ego())
    goal = clause.time.anchor if isinstance(clause.time, Relative) else None
    arriving = any(isinstance(e, Event) and e.action == "arrive" for e in (event, goal))
    if arriving or isinstance(to, Destination) or isinstance(goal, Destination):
        return measured("distance-to-go", clause, Ego())
    if event is not None and isinstance(actor, Ego) and to is None and event.tense != "present":
        return measured("distance-driven", clause, Ego())
    if to is None and _is_trip(clause, event):
        return measured("distance-to-go", clause, Ego(), time=Unsaid())
    if isinstance(actor, Pronoun | None) and to is None and _onward(clause, words):
        off = {"off", "away"} & {*words} and isinstance(actor, Pronoun)  # of it, if it is known
        whose = actor if off and actor is not None else Ego()
        return measured("distance-to-go", clause, whose, time=Unsaid())
    if isinstance(actor, Pronoun) and actor.form == "it" and event is None:
        return measured("distance", clause, actor if to is None else Ego(), to=to)
    if isinstance(actor, Destination):
        return measured("distance-to-go", clause, Ego())
    return measured("distance", clause, actor, to=to)


def _is_trip(clause: Clause, event: Event | None) -> bool:
    """Say whether a length is that of our trip: "how far are we going today?"."""
    subject = clause.subject
    if isinstance(subject, Noun):
        return subject.key in ("trip", "ride")
    going = event is not None and event.action in ("go", "move") and not clause.bearings
    return going and isinstance(subject, Ego | Passenger)


def _onward(clause: Clause, words: tuple[str, ...]) -> bool:
    """Say whether it is asked how far it is still: "how far is it still", "how far to go"."""
    if {"ahead", "behind", "back", "front"} & {*words}:
        return False
    still = clause.still or bool(clause.focus & {"yet", "still"}) or isinstance(clause.time, Next)
    inner = clause.infinitive
    going = inner is not None and inner.verb is not None and inner.verb.key in ("go", "drive")
    return (still or going) and not clause.bearings


def _next_turn(clause: Clause) -> Event | None:
    """Find the turn of ours to which it is asked how far it is."""
    return _turn_among(clause, [clause.subject, *_up_to(clause), *(s for s, _ in clause.objects)])


def until_turn(clause: Clause) -> When | None:
    """Ask when our next turn is: "how long is it to the turn", "how many seconds until it"."""
    turn = None if clause.verb is not None else _turn_among(clause, _up_to(clause))
    return None if turn is None else When(Happens(turn))


def _up_to(clause: Clause) -> list[Any]:
    """List up to what it is measured: "how far is it till the turn"."""
    named: list[Any] = [phrase.sem for phrase in clause.complements]
    if isinstance(clause.time, Relative) and clause.time.relation in ("until", "before"):
        named.append(clause.time.anchor)
    return named


def _turn_among(clause: Clause, named: list[Any]) -> Event | None:
    turns = (sem for sem in named if isinstance(sem, Event) and sem.action in WAYS)
    found = next(turns, None)
    if found is None or clause.tense not in ("present", "future"):
        return None
    return cast(Event, with_fields(found, tense="future"))


def remaining(clause: Clause, actor: Thing | None) -> bool:
    """Say whether "left" asks for what remains: "how far is left", "how much distance is left"."""
    subject = clause.subject
    if isinstance(subject, Event) and subject.action == "exit-left":
        return True
    if not isinstance(actor, (Pronoun, type(None))):
        return False
    leaving = clause.verb is not None and clause.verb.key == "leave"
    bare = clause.verb is None and isinstance(subject, (Measure, type(None)))
    leaving |= bare and clause.side == "left"
    named = [getattr(node, "words", ()) for bearing, node in clause.bearings if bearing == "left"]
    return leaving or ("left",) in named
