"""Doings: questions for what somebody does, did or could have done, and for what happens."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import Doing, HowAvoid, Listing, Question, Summarise, Where, Why
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Feature,
    Happens,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Quantity,
    That,
    Thing,
    Time,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause, wanted_pronoun
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, as_thing
from xavi_dialogue.nlu.compose.clauses.traits import LIGHTS
from xavi_dialogue.nlu.compose.verbs.others import is_vehicle
from xavi_dialogue.nlu.compose.wh_questions.lasting import measured
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh

_TO_COME = frozenset({"would", "could", "should", "might"})


def has_gone(clause: Clause) -> bool:
    """Tell whether a clause is about how the ride goes or went: "how did it go"."""
    subject = clause.subject
    if isinstance(subject, Noun) and subject.key == "ride":
        return clause.tense != "future"
    gone = clause.verb is not None and clause.verb.key == "go" and clause.tense == "past"
    return gone and wanted_pronoun(subject) and not (clause.objects or clause.complements)


def doing(wh: Wh, clause: Clause, value: Special) -> Question:
    """Ask what somebody does, how fast, or what could have been done instead."""
    measures = (sem for sem, _ in clause.objects if isinstance(sem, Measure))
    speed = next((m for m in measures if m.of.attribute == "speed"), None)
    said = (*(sem for sem, _ in clause.objects), *(p.sem for p in clause.complements))
    about = any(isinstance(sem, Quantity) for sem in said)
    subject = None if isinstance(clause.subject, Wanted) else as_thing(clause.subject)
    if about and not isinstance(clause.subject, Wanted):  # "what's he doing, about fifty?"
        return measured("speed", clause, subject)
    if speed is not None:  # "what is he doing, speed-wise?"
        return measured("speed", clause, as_thing(clause.subject))
    lit = next((p.sem.of.attribute for p in clause.complements if p.key == "with"
                and isinstance(p.sem, Measure) and p.sem.of.attribute in LIGHTS), None)  # fmt: skip
    if lit is not None and subject is not None:  # "what's he doing with that blinker?"
        return Why(Happens(Event(LIGHTS[lit], subject, tense=_tense(clause))))
    undone = clause.modal == "could" and clause.tense == "past"
    if (undone or clause.modal == "should") and not isinstance(clause.subject, Wanted):
        return _instead(clause, clause.subject, value.content)
    actor = Ego() if subject is None or isinstance(subject, Passenger) else subject
    if "semi-allowed" in clause.aux and actor == Ego():  # "what are we allowed to do here?"
        return measured("limit", clause, actor)
    besides = That() if wh.besides or clause.else_ else None
    tense: Any = "past" if clause.tense == "perfect" else _tense(clause)
    if clause.modal in _TO_COME and clause.tense != "past":
        tense = "future"
    return Doing(actor, clause.time, tense, besides)


def deed_asked(clause: Clause, value: Proposition) -> Question | None:
    """Ask what somebody does of whom nothing but "do" is said."""
    if not isinstance(value, Happens) or value.event.action != "do":
        return None
    event = value.event
    if event.object is not None and not isinstance(event.object, (Wanted, Pronoun)):
        return None
    if event.modal in ("could", "should") and event.tense == "past":
        return _instead(clause, event.actor, None)
    if "semi-allowed" in clause.aux and event.actor == Ego():
        return measured("limit", clause, event.actor)
    if clause.verb is not None and clause.verb.key == "show" and isinstance(event.actor, Pronoun):
        return measured("colour", clause, Feature("light"))  # "what's it showing?"
    return Doing(event.actor, clause.time, _tense(clause))


def happened(clause: Clause, value: Special) -> Question:
    """Ask what happened, where somebody went, or what became of a thing."""
    about = next((as_thing(s) for s in value.match.phrases.values()), None)
    if is_vehicle(about or Ego()) and clause.tense in ("past", "perfect"):
        return Where(Event("go", cast(Thing, about), time=clause.time))
    if about is not None and not isinstance(about, Pronoun):
        return Summarise(about, clause.time)
    tense = clause.tense if clause.tense != "perfect" else "past"
    thing: Thing | None = about
    if thing is None and isinstance(clause.subject, Described):
        thing = clause.subject
    return Doing(thing, clause.time, cast(Any, tense))


def _instead(clause: Clause, actor: object, content: Proposition | None) -> Question:
    """Ask what else could have been done, or how what was done could have been avoided."""
    avoiding = clause.infinitive is not None or "differently" in clause.focus
    ours = clause.modal == "could" and isinstance(actor, Ego) and content is None
    if ours and clause.tense == "past" and not avoiding:
        return Listing("options", time=clause.time)
    return HowAvoid(content.content if isinstance(content, Not) else content)


def _tense(clause: Clause) -> Any:
    """Give the tense of a question for a deed: "what do you mean to do?" asks what comes."""
    meant = "semi-want" in clause.aux and clause.tense == "present"
    return "future" if meant else clause.tense


def up_with(thing: Thing, time: Time) -> Question:
    """Ask "what is up with that van": what it does; "with the slowing down": why we do it."""
    match thing:
        case Described(doing=Event() as deed) if thing == Described(doing=deed):
            return Why(Happens(with_fields(deed, actor=Ego())))
    return Doing(thing, time, "present")


def comes_up(wh: Wh, clause: Clause) -> bool:
    """Tell whether it is asked what comes up on our way, and not who comes from somewhere."""
    return (
        wh.kind == "what"
        and "up" in {leaf.key for leaf in clause.particles}
        and not clause.bearings
    )
