"""Question words, and what questions of all kinds look at."""

from dataclasses import dataclass
from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    Doing,
    HowLong,
    HowSure,
    Question,
    When,
    Where,
    Whether,
    Whither,
)
from xavi_dialogue.domain.terms import (
    Back,
    Believed,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Not,
    Pronoun,
    Proposition,
    Related,
    Relative,
    Thing,
    Unknown,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.extents import extreme_of
from xavi_dialogue.nlu.compose.clauses.nominal import done_by, event_in, propose
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Sem, as_thing
from xavi_dialogue.nlu.compose.propositions.specials import proposition_of

NEXT = Described(rank=1)  # "next" by itself


@dataclass(frozen=True, slots=True)
class Wh:
    """A question word: its kind, and what stands with it."""

    kind: str  # why, what, who, where, when, how, evidence, grade, count, which, whose
    key: str = ""  # of the adjective after "how"; "whence", "whither"
    words: tuple[str, ...] = ()
    sem: Sem | None = None
    preposition: str = ""
    besides: bool = False
    of: Sem | None = None  # those of whom one is asked for: "which of them"


def fact(value: Proposition | Special) -> Proposition:
    """Take a reading of a clause for a proposition."""
    return proposition_of(value) if isinstance(value, Special) else value


def content_of(clause: Clause, value: Any) -> Proposition | None:
    """Find what a belief is of: "that he would turn", "to vehicle 1 entering our lane"."""
    if isinstance(value, Special):
        if value.content is not None:
            return _of_whom(value.content, value)
        for sem in (*value.match.phrases.values(), value.object):
            about = sem.of.to if isinstance(sem, Measure) else sem
            event = sem.of.event if isinstance(sem, Measure) else event_in(about)
            if event is not None:
                return Happens(done_by(event, value.match.second, value.object))
        found = proposition_of(value)
        return found if isinstance(found, Related) else None
    match value:
        case Believed(content=content):
            return content
        case Is(
            state="present", time=Relative(relation="during", anchor=Event(tense=tense) as event)
        ):
            # "how do you know when it turns green?" asks of its turning, not of that time.
            foreseen = "future" if tense == "present" else tense
            return Happens(with_fields(event, tense=foreseen))
    return value if isinstance(value, (Happens, Not, Related, Is, Exists)) else None


def answer_to(question: Question) -> Proposition | None:
    """Return what is known by somebody who knows the answer: "how do you know where he goes?".

    None if it cannot be put as a proposition.
    """
    match question:
        case Whether(that=of) | When(of=of) | HowLong(of=of) | Where(of=Event() as of):
            return propose(of) if isinstance(of, Event) else of
        case Doing(actor=actor, tense=tense) if actor is not None:
            return Happens(Event("do", actor=actor, tense=tense))
        case Whither(actor=actor):
            return Happens(Event("go", actor=actor, tense="future"))
    return None


def held_then(clause: Clause, content: Proposition | None) -> Proposition | None:
    """Take for foreseen what was asked of then: "what chance did you give it stopping?".

    A decision that would be taken is one that is supposed.
    """
    event = content.event if isinstance(content, Happens) else None
    if event is not None and event.action == "do" and clause.modal == "would":
        return Happens(with_fields(event, modal="would"))
    if event is None or clause.tense != "past" or event.actor == Ego():
        return content
    open_ = event.tense == "present" and event.modal is None and event.time == Unsaid()
    return Happens(with_fields(event, modal="would")) if open_ else content


def sureness(clause: Clause, content: Proposition | None) -> HowSure:
    """Ask how sure we are; in the past, and undated, at the time of the deed spoken of."""
    undated = isinstance(clause.time, Unsaid) and clause.tense == "past"
    event = content.event if isinstance(content, Happens) else None
    if event is not None:
        to_come = event.modal == "would" and not isinstance(event.actor, Ego)
        undated &= to_come and isinstance(event.time, Unsaid) and event.action != "do"
    open_ = undated and (event is not None or content is None)
    return HowSure(content, Back() if open_ else clause.time)


def _of_whom(content: Proposition, value: Special) -> Proposition:
    """Put in whom a belief is of: "what did you assign to it going straight on?"."""
    if not isinstance(content, Happens) or content.event.actor != Pronoun("that"):
        return content
    things = (as_thing(sem) for sem in value.match.phrases.values())
    whom = next((t for t in things if isinstance(t, Vehicle | Described | Pronoun)), None)
    return content if whom is None else Happens(with_fields(content.event, actor=whom))


def is_that(sem: object) -> bool:
    """Say whether a meaning is "that", "it" or "this"."""
    return isinstance(sem, Pronoun) and sem.form in ("that", "it", "this")


def actor_of(value: Any, actor: Thing | None) -> Thing:
    """Tell who acts in a reading of a clause."""
    if isinstance(value, Happens):
        return value.event.actor
    return actor or Ego()


def time_of(clause: Clause, value: Any) -> Any:
    """Tell the time of a reading of a clause."""
    if isinstance(value, Happens):
        return value.event.time
    return clause.time


def deed_of(event: Event) -> Sem | None:
    """Give what is avoided."""
    thing = event.object
    return None if isinstance(thing, (Pronoun, Unknown)) else cast("Sem | None", thing)


def pointed_at(clause: Clause) -> Thing:
    """Return what "who is that?" and "who is closest now?" ask for."""
    most = extreme_of(clause)
    if most is None and clause.origin is not None:
        return Described(origin=cast(Any, clause.origin))  # "who is coming from the left?"
    if most is None:
        return Pronoun("that")
    return Described(extreme=cast(Any, most), definite=True)
