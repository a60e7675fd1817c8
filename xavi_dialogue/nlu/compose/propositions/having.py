"""Having: what "we have priority", "he has his indicator on", "you have a lorry behind" say."""

from msgspec.structs import replace

from xavi_dialogue.domain.terms import (
    Both,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Nobody,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Related,
    Road,
    Tense,
    Unknown,
    Unsaid,
)
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Group, Measure, Noun, as_thing
from xavi_dialogue.nlu.compose.states.rooms import roomy
from xavi_dialogue.nlu.compose.verbs.deeds import tense_of, time_of
from xavi_dialogue.nlu.compose.verbs.lights import had_light
from xavi_dialogue.nlu.compose.verbs.others import is_other


def had(special: Special) -> Proposition:
    """Read what the subject has: a right, a signal, room, a choice or somebody near."""
    sem = special.object
    lit = had_light(special)
    if lit is not None:
        return lit
    over = next((as_thing(s) for k, s in special.match.phrases.items() if k in
                 ("over", "bearing-ahead", "with")), None)  # fmt: skip
    if over is None and not isinstance(special.clause.than, Clause):
        over = as_thing(special.clause.than)
    if isinstance(sem, Group) and (rivals := _rivals(special, sem)) is not None:
        return rivals
    if isinstance(sem, Measure) and sem.of.attribute == "right-of-way":
        other = over or sem.of.to or Everyone()
        time = time_of(special) if isinstance(sem.of.time, Unsaid) else sem.of.time
        return Related("has-priority-over", special.subject, other, time, _tense(special))
    if isinstance(sem, Measure) and sem.of.attribute in ("indicator", "brake-lights"):
        value = special.clause.side or "on"
        return Has(sem.of.attribute, value, special.subject, time_of(special), tense_of(special))
    if isinstance(sem, Measure):
        return Happens(Event("do", special.subject, Unknown("have")))
    if isinstance(sem, Feature) and sem.kind == "space":
        return roomy(special.clause, time_of(special))
    if isinstance(sem, Road) and sem.which == "main":
        return Related("has-priority-over", special.subject, over or Everyone(), time_of(special),
                       tense_of(special))  # fmt: skip
    if isinstance(sem, Feature):
        return Exists(sem, time_of(special), tense_of(special))
    if isinstance(sem, Noun):
        return _have_noun(special, sem)
    thing = as_thing(sem)
    if thing is None and special.content is None and not isinstance(sem, Event):
        return Happens(Event("do", special.subject, Unknown("have")))
    thing = thing or Pronoun("that")
    if isinstance(sem, Event):
        return Happens(Event(sem.action, special.subject, sem.object, sem.side, sem.manner,
                             time_of(special), tense_of(special)))  # fmt: skip
    if special.content is not None:
        return special.content
    if isinstance(thing, Described | Nobody) and isinstance(special.subject, Ego | Passenger):
        return Exists(thing, time_of(special), tense_of(special))  # "you've a lorry on the left"
    return Related("with", special.subject, thing, time_of(special), tense_of(special))


def _rivals(special: Special, sem: Group) -> Proposition | None:
    """Read "do we have right of way or him" as which of the two has it over the other."""
    first, *others = sem.members
    right = isinstance(first, Measure) and first.of.attribute == "right-of-way"
    if sem.join != "or" or not right or len(others) != 1:
        return None
    other = as_thing(others[0])
    if other is None:
        return None
    ours = Related("has-priority-over", special.subject, other, time_of(special), _tense(special))
    return Both((ours, replace(ours, thing=other, to=special.subject)), "or")


def _tense(special: Special) -> Tense:
    """Take "we have got right of way" for the present that it is."""
    tense = tense_of(special)
    verb = special.clause.verb
    got = verb is not None and verb.words[-1:] == ("got",)
    return "present" if got and tense == "perfect" else tense


def _have_noun(special: Special, sem: Noun) -> Proposition:
    if sem.key == "problem" and is_other(special.subject):
        return Is("faulty", special.subject, time=time_of(special))
    if sem.key == "problem":
        return Is("wrong", special.subject, time=time_of(special), tense=tense_of(special))
    if sem.key in ("option", "plan", "reason"):
        found: Proposition = Is("possible", time=time_of(special), tense=tense_of(special))
        return Not(found) if sem.negative else found
    return Related("with", special.subject, Unknown(sem.word), time_of(special), tense_of(special))
