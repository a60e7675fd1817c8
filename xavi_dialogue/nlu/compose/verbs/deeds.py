"""Deeds: "do", "happen", "change", "begin" and "get wrong" as propositions."""

from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Caused,
    Compares,
    Described,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Passenger,
    Pronoun,
    Proposition,
    Quantity,
    Thing,
    Unknown,
    Unsaid,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.compose.clauses.adoption import exceeding, with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, as_speed, as_thing
from xavi_dialogue.nlu.compose.verbs.events import when
from xavi_dialogue.nlu.compose.verbs.taking import is_gap
from xavi_dialogue.nlu.compose.verbs.trends import trend


def time_of(special: Special) -> Any:
    """Find the time that is spoken of."""
    return when(special.clause, special.match)


def tense_of(special: Special) -> Any:
    """Find the tense of the clause."""
    return special.clause.tense


def event_of(special: Special, action: str, thing: Thing | None, **more: Any) -> Event:
    """Build the event that an action and its object make of the clause."""
    return Event(
        cast(Any, action), special.subject, thing, cast(Any, special.clause.side),
        tuple(special.clause.manner), time_of(special), tense_of(special),
        cast(Any, special.clause.modal), **more,
    )  # fmt: skip


def deed_named(special: Special) -> Proposition:
    """Read "do a turn", "make a stop": the deed that is named."""
    sem = special.object
    if isinstance(sem, Event) and not isinstance(sem.actor, Ego):
        return made(special, Happens(sem))
    if isinstance(sem, Event):
        return Happens(event_of(special, sem.action, sem.object))
    if sem is None and special.content is not None:
        return special.content  # "why do you make brake"
    return Happens(event_of(special, "do", as_thing(sem)))


def broken(special: Special) -> Proposition:
    """Read "we broke down" and "a tyre bursts", which is of whose it is."""
    part = special.clause.subject
    whose = part.of.thing if isinstance(part, Measure) else special.subject
    event = part if isinstance(part, Event) else None
    thing = whose if event is None else None
    return Is("faulty", thing, event, time=time_of(special), tense=tense_of(special))


def measured(special: Special) -> Proposition:
    """Read "take the gap" as going; what else is done to a measure is unknown."""
    if is_gap(special.object) and cast(Any, special.clause.verb).key != "measure":
        return Happens(event_of(special, "go", None))
    verb = cast(Any, special.clause.verb).key
    return Happens(event_of(special, "do", as_thing(special.object) or Unknown(verb)))


_HALTS = frozenset({"wait", "stop", "stand", "give-way"})


def made(special: Special, effect: Proposition) -> Proposition:
    """Read "we made the bus wait": the bus waits for us; else that we are why it does so."""
    agent = next((p.sem for p in special.clause.complements if p.key == "by"), None)
    named = as_thing(agent) if special.clause.passive and agent is not None else None
    match effect:
        case Happens(event=event) if named is not None:
            return Caused(named, Happens(with_fields(event, tense=tense_of(special))))
        case Happens(event=event) if not isinstance(event.actor, Ego):
            other = cast(Event, with_fields(event, tense=tense_of(special)))
            if isinstance(special.subject, Ego) and event.action in ("wait", "stand"):
                for_us = {"action": "wait", "object": special.subject, "time": time_of(special)}
                return Happens(cast(Event, with_fields(other, **for_us)))
            return Caused(special.subject, Happens(other))
        case Happens(event=event) if event.action in _HALTS and tense_of(special) == "future":
            return Happens(Event("give-way", Ego(), special.subject, tense="future"))
    return Caused(named or special.subject, effect)


def happen(special: Special) -> Proposition:
    """Read "what happened to the bus", "how come we stopped"."""
    about = next((as_thing(s) for s in special.match.phrases.values()), None)
    if special.content is not None:
        return special.content
    match special.subject:
        case Described(such=Is(state=state, thing=Wanted())):  # "did anything dangerous happen"
            return Is(state, Described(definite=False), time=time_of(special),
                      tense=tense_of(special))  # fmt: skip
    return Happens(Event("happen", about or special.subject, time=time_of(special),
                         tense=tense_of(special)))  # fmt: skip


def do(special: Special) -> Proposition:
    """Read "what did he do", "are we doing fifty"."""
    sem = special.object
    above = exceeding(special.clause, event_of(special, "do", None))
    if above is not None:
        return above
    if isinstance(sem, Event):
        return Happens(sem)
    thing = as_thing(sem)
    if isinstance(sem, Quantity):
        sem = as_speed(sem)
        able = special.clause.modal in ("can", "could", "might", "should")
        if (able and tense_of(special) == "present") or "semi-allowed" in special.clause.aux:
            return Compares(Measured("limit"), "at-least", sem)  # "may we do 70?"
        return Compares(Measured("speed", special.subject, tense=tense_of(special)), "same", sem)
    if isinstance(sem, Measure) and sem.of.attribute in ("speed", "limit"):
        return _paced(special, sem)
    return Happens(event_of(special, "do", thing))


def _paced(special: Special, sem: Measure) -> Proposition:
    """Read "are we doing the limit", "is he going the same speed as us"."""
    speed = Measured("speed", special.subject, time=time_of(special), tense=tense_of(special))
    other: Measured = sem.of
    if other.attribute == "speed":
        than = None if isinstance(special.clause.than, Clause) else as_thing(special.clause.than)
        it = Pronoun("it") if isinstance(special.subject, Ego) else Ego()
        other = with_fields(other, thing=than or it)
    return Compares(speed, "same", other)


def changed(special: Special) -> Proposition:
    """Read "the gap is shrinking"; what changes otherwise is the plan."""
    found = trend(special.clause)
    return found or Happens(event_of(special, "change-plan", None))


def begun(special: Special) -> Proposition:
    """Read "you started braking", "you began the lane change": the deed itself."""
    if special.content is not None:
        return special.content
    sem = special.object
    if isinstance(sem, Event):
        event = event_of(special, sem.action, sem.object)
        return Happens(cast(Event, with_fields(event, side=sem.side)))
    thing = as_thing(sem)
    if isinstance(thing, Pronoun):  # "when you started it"
        return Happens(event_of(special, "do", thing))
    return Happens(event_of(special, "go", None))


def had_wrong(special: Special) -> Proposition:
    """Read "you had that wrong", "did you get him wrong": of whom was spoken."""
    who = as_thing(special.object)
    whom = Pronoun("he") if who is None or isinstance(who, Pronoun) else who
    return Is("wrong", whom, time=time_of(special), tense="past")


def admits(special: Special) -> bool:
    """Check whether it is said that somebody "made a mistake"."""
    sem = special.object
    made_one = special.name in ("decide", "do", "mistake") and isinstance(sem, Noun)
    return made_one and cast(Noun, sem).key == "wrong-prediction"


def mistaken(special: Special) -> Proposition:
    """Read "you misjudged the van", "you made a mistake": wrong about somebody, or at all."""
    whom = None if isinstance(special.object, Noun) else as_thing(special.object)
    thing = special.subject if whom is None or isinstance(whom, Unknown) else whom
    return Is("wrong", thing, time=time_of(special), tense=tense_of(special))


def missed(special: Special) -> Proposition:
    """Read "you missed your chance to overtake": that we could have done so."""
    content = special.content
    event = content.event if isinstance(content, Happens) else Event("go", tense="past")
    return Happens(with_fields(event, actor=special.subject, tense="past", modal="could"))


def make_do(special: Special) -> Proposition:
    """Read "you made him stop", "what made you do that": that something has an effect."""
    effect = special.content
    if effect is None:
        thing = as_thing(special.object) or Ego()
        effect = Happens(Event("do", thing, Pronoun("that"), tense=tense_of(special)))
    return made(special, effect)


def neared(special: Special) -> Proposition:
    """Read "did we come too close to them" as how close that was; else as coming closer."""
    whom, tense = as_thing(special.match.phrases.get("bearing-beside")), tense_of(special)
    other = whom if isinstance(special.subject, Ego | Passenger) else special.subject
    if other is None or tense not in ("past", "perfect"):
        return Happens(event_of(special, "approach", whom))
    time, anybody = time_of(special), other == Described(definite=False)
    if anybody and isinstance(time, Unsaid):
        time = WholeRide()  # "did anyone come near us?"
    too = "too" in special.clause.focus
    return Is("close", None if anybody else other, too=too, time=time, tense=tense)
