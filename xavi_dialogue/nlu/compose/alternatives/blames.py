"""Blames: questions that suspect a cause, such as "was that braking because of the lorry"."""

import re

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Act, Ask, Question, Whether, Why
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Junction,
    Nobody,
    Pronoun,
    Proposition,
    Related,
    That,
    Thing,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.clause import Clause, wanted_pronoun
from xavi_dialogue.nlu.compose.clauses.sem import (
    ALTERNATIVES,
    Group,
    Notes,
    Sem,
    Specified,
    as_thing,
)

_TURNS = frozenset({"turn", "exit-left", "exit-right", "take-turn"})
_HINDERING = frozenset({"bend", "light", "crossing", "queue", "obstacle"})
_HELD = frozenset({"brake", "slow-down", "stop", "wait", "give-way", "let-go"})
#: Words for "nobody else"; "just" and "only just" may refer to time, "not only" denies it.
_ALONE = re.compile(
    r"(?<!not )\bonly\b(?! just)|\balone\b|\b(?:solely|purely|merely|exclusively)\b"
    r"|\bjust (?:because|due|for|down to|thanks to|the|that|this|vehicle|him|her|them)\b"
    r"|\b(?:nobody|no one|noone|nothing) else\b|\bby (?:itself|himself|herself)\b"
)


def blamed(clause: Clause) -> Thing | None:
    """Read the cause in "was it for the bus", "was that braking because of him"."""
    plain = clause.verb is None and not (clause.complements or clause.objects)
    if isinstance(clause.subject, Event) and plain and not isinstance(clause.because, Clause):
        return as_thing(clause.because)
    it = isinstance(clause.subject, Pronoun) and clause.subject.form in ("it", "that", "this")
    if not it or clause.verb is not None or len(clause.complements) != 1 or clause.objects:
        return None
    if clause.adjectives or clause.manner or clause.comparisons:
        return None  # "was it too fast for this bend?"
    graded = clause.adjectives or clause.manner or clause.comparisons  # "too fast for this bend"
    phrase = clause.complements[0]
    return cause_of(phrase.sem) if phrase.key == "for" and not graded else None


def cause_of(sem: Sem | None) -> Thing | None:
    """Return what may hinder us: a road user, a junction or bend, or the junction of a turn."""
    if isinstance(sem, Event):
        return Junction() if sem.action in _TURNS else None
    thing = as_thing(sem)
    match thing:
        case Described() | Vehicle() | Junction() | Ego():
            return thing
        case Feature(kind=kind) if kind in _HINDERING:
            return thing
        case Pronoun(form="he" | "she" | "they" | "them-all"):
            return thing
    return None


def causes_of(sem: Sem | None) -> tuple[Thing, ...] | None:
    """Give the causes that are joined by "or"; None for all else."""
    if not isinstance(sem, Group) or sem.join != "or":
        return None
    things = tuple(thing for one in sem.members if (thing := cause_of(one)) is not None)
    told = any(thing != Described(definite=False) for thing in things)  # not "a man or a lady"
    return things if told and len(things) == len(sem.members) else None


def causes_named(clause: Clause) -> tuple[Thing, ...] | None:
    """Read "..., for the bus or for the turn?", "because of the light or the people?"."""
    first = clause.because or next((c.sem for c in clause.complements if c.key == "for"), None)
    if isinstance(first, Clause):
        return None
    if (listed := causes_of(first)) is not None:
        return listed
    more = [c.sem for join, one in clause.chained if join == "or" for c in one.complements]
    things = [cause_of(sem) for sem in (first, *more)]
    named = tuple(thing for thing in things if thing is not None)
    return named if len(named) == len(things) >= ALTERNATIVES else None


def causes_taken(clause: Clause, notes: Notes) -> tuple[Thing, ...]:
    """Take "for the bus or for the turn" out of the clause whose reason it is."""
    causes = causes_named(clause)
    if causes is None:
        return ()
    clause.because = None
    clause.complements = [phrase for phrase in clause.complements if phrase.key != "for"]
    notes.taken.update(id(other) for _, other in clause.chained)
    clause.chained = []
    return causes


def blaming(question: Question, causes: tuple[Thing, ...]) -> Question:
    """Put the causes of which one is asked for into a question for a reason."""
    if not isinstance(question, Why) or len(causes) != ALTERNATIVES or question.suspect is not None:
        return question
    return replace(question, suspect=causes[0], rival=causes[1])


def either_cause(clause: Clause) -> Why | None:
    """Read "was it the light or the bus" as for which of them it was; of two vehicles, None."""
    it = isinstance(clause.subject, Pronoun) and clause.subject.form in ("it", "that", "this")
    named = clause.objects[0][0] if len(clause.objects) == 1 else None
    if not it or clause.verb is not None or clause.complements or clause.adjectives:
        return None
    if not isinstance(named, Group) or named.join != "or":
        return None
    things = [cause_of(member) for member in named.members]
    roadside = any(isinstance(thing, Feature) for thing in things)
    cleft = any(isinstance(t, Described) and (t.doing or t.such) for t in things)
    if len(things) != ALTERNATIVES or None in things or not roadside or cleft:
        return None  # "the bus or the light that held us up?"
    return Why(That(), suspect=things[0], rival=things[1])


def cleft_cause(clause: Clause) -> tuple[Thing, Proposition | Clause] | None:
    """Read "was it because of the bus that you braked": the cause, and what it caused."""
    if clause.verb is not None or not wanted_pronoun(clause.subject):
        return None
    named = [c.sem for c in clause.complements if c.key == "for"]
    sem = named[0] if named else clause.because
    if isinstance(sem, Clause) or clause.adjectives:
        return None
    thing = as_thing(sem)
    if thing is not None and clause.that is not None:
        return thing, clause.that
    match sem:
        case Specified(thing=thing, clause=Happens(event=Event(object=Wanted()) as event)):
            return thing, _whole(event)
        case Described(doing=Event(object=Wanted() | None, actor=actor) as event) if (
            actor != Wanted()
        ):
            return replace(sem, doing=None), _whole(event)
    return None


def blamed_for(clause: Clause) -> Why | None:
    """Read "is the bus why you braked"."""
    if clause.question is None or clause.verb is not None or not clause.has("be"):
        return None
    wh, questions = clause.question
    thing = as_thing(clause.subject)
    if wh is None or wh.kind != "why" or thing is None or not questions:
        return None
    asked = questions[0]
    return replace(asked, suspect=thing) if isinstance(asked, Why) else None


def _whole(event: Event) -> Proposition:
    """Return the event without its object, so that it is not about anybody in particular."""
    action = "stop" if event.action == "block" else event.action  # "that you stopped"
    return Happens(replace(event, action=action, object=None))


def of_one_alone(act: Act, words: str) -> Act:
    """Mark "only because of him", "was it him alone?": it asks whether he is the only cause.

    "Did you stop only for the bus?" asks the same.
    """
    if not isinstance(act, Ask) or not _ALONE.search(words):
        return act
    match act.question:
        case Why(suspect=Nobody(described=Described(other=True) as thing)) as why:
            return Ask(replace(why, suspect=thing))
        case Why(suspect=thing, rival=None) as why if thing is not None:
            return Ask(replace(why, alone=True))
        case Whether(
            that=Happens(event=Event(actor=Ego(), object=Vehicle() | Described() as whom) as event)
        ) if event.action in _HELD and event.modal is None:
            return Ask(Why(Happens(replace(event, object=None)), suspect=whom, alone=True))
    return act


def rival(clause: Clause) -> Thing | None:
    """Return the second of two suspected causes: "was it for the bus or for the lorry?"."""
    sem = clause.complements[0].sem if clause.complements else clause.because
    members = sem.members[1:] if isinstance(sem, Group) and sem.join == "or" else ()
    return next((one for one in map(cause_of, members) if one is not None), None)


def whom_of(of: Proposition) -> Thing | None:
    """Give whom a cause that is told as a clause is of: "because someone was crossing"."""
    match of:
        case Happens(event=Event(action="cross", actor=Described("vehicle", definite=False))):
            return Described("pedestrian", plural=True)  # "someone was crossing"
        case Happens(event=Event(actor=Described(definite=False) as who) as event):
            return replace(who, doing=replace(event, actor=Wanted()))
        case Happens(event=event):
            return _named(event.actor)
        case Is(thing=thing) | Has(thing=thing) | Related(thing=thing) | Exists(thing=thing):
            return _named(thing)
    return None


def _named(thing: Thing | None) -> Thing | None:
    vague = isinstance(thing, Pronoun) and thing.form in ("it", "that", "this")
    return None if vague or isinstance(thing, Nobody) else thing
