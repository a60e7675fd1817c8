"""Nominal questions: what a noun phrase asks for after "what is", "list" or "tell me"."""

from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Doing,
    Fault,
    HowDecide,
    HowKnow,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Peak,
    Question,
    Summarise,
    WhatIf,
    WhatWouldChange,
    When,
    Where,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    Both,
    Caused,
    Described,
    Destination,
    Ego,
    Event,
    Everyone,
    Exit,
    Happens,
    Is,
    Lane,
    Measured,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Quantity,
    Rank,
    Record,
    Relative,
    Road,
    That,
    Thing,
    Time,
    Together,
    Unknown,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.adoption import as_of, of_numbers
from xavi_dialogue.nlu.compose.clauses.peaks import peak_named
from xavi_dialogue.nlu.compose.clauses.risks import risk_asked
from xavi_dialogue.nlu.compose.clauses.sem import (
    Group,
    Measure,
    Moment,
    Noun,
    Sem,
    SideOf,
    as_thing,
)

_LISTED = {"option": "options", "rival": "rivals", "event": "events", "prediction": "beliefs",
           "wrong-prediction": "wrong-predictions", "factor": "causes", "stop": "stops",
           "decision": "decisions", "capability": "capabilities"}  # fmt: skip


def event_in(sem: Sem | None) -> Event | None:
    """Find the event in "the lorry turning right"."""
    if isinstance(sem, Event):
        return sem
    if not isinstance(sem, Described) or sem.doing is None:
        return None
    inner = sem.doing
    if not isinstance(inner.actor, Wanted):
        return None
    return structs.replace(inner, actor=structs.replace(sem, doing=None))


def deed_of(sem: Sem | None) -> Event | None:
    """Return the action that a phrase names, ours by default: "the stop", "all that braking"."""
    event = event_in(sem)
    alone = event is not None and event.actor in (Described(), Described(plural=True))
    return structs.replace(event, actor=Ego()) if alone and event is not None else event


def done_by(event: Event, *named: Sem | None) -> Event:
    """Make a named vehicle the actor: "vehicle 1 at 90 percent for turning"."""
    things = (as_thing(sem) for sem in named if not isinstance(sem, Event))
    whom = next((t for t in things if isinstance(t, Vehicle | Described | Pronoun)), None)
    if whom is None or not isinstance(event.actor, Ego):
        return event
    return structs.replace(event, actor=whom)


#: By measure: the action that it measures.
_CHANGES: dict[str, Any] = {"deceleration": "slow-down", "acceleration": "speed-up"}


def propose(sem: Sem | None) -> Proposition | None:
    """Turn a noun phrase into a proposition: an event happened, or `That` for "that"."""
    if isinstance(sem, Event):
        return Happens(sem)
    if isinstance(sem, Pronoun):
        return That()
    if isinstance(sem, Measure) and sem.of.attribute in _CHANGES:
        whose = sem.of.thing
        actor = Ego() if isinstance(whose, Unknown) else whose
        return Happens(Event(_CHANGES[sem.of.attribute], actor, time=sem.of.time))
    return None


def asked_of(sem: Sem, time: Time, tense: str = "present") -> Question | None:
    """Return the question for what a noun phrase names; None if there is nothing to ask."""
    match sem:
        case Measure():
            return _measure(sem, time, tense)
        case Noun():
            return _noun(sem, time, tense)
        case Event():
            return Summarise(sem, time)
        case Quantity() | Moment() | SideOf():
            return None
        case Group(members=members) if not isinstance(as_thing(sem), Together):
            return asked_of(members[0], time, tense)
        case Everyone(kind=kind):
            return Listing("vehicles", None if kind == "vehicle" else cast(Any, sem), time)
        case Destination():
            return Where(sem, time)
        case Record():
            return Summarise(None, time)
        case Ego() | Passenger():
            return Summarise(Ego(), time)
        case Exit():
            return HowMuch(Measured("exit-number", time=time))
        case Pronoun(form="it" | "that") as it if tense == "past" and not isinstance(time, Unsaid):
            return HowMuch(Measured("value", it, time=time, tense="past"))  # "what was it then?"
        case Lane() | Road():
            return Where(sem, time)
        case _:
            thing = as_thing(sem)
            if isinstance(thing, Described) and isinstance(thing.such, Caused):
                return WhatWouldChange(thing.such.effect, most=True)
            match thing:
                case Described(kind="vehicle", such=Is("wrong", Wanted())):
                    return Listing("wrong-predictions", time=time)  # "one thing you got wrong"
            placed = getattr(thing, "bearing", None) is not None
            if getattr(thing, "plural", False) and not (getattr(thing, "number", None) or placed):
                return Listing("vehicles", thing, time)
            return Identify(thing) if thing is not None else None


def _measure(sem: Measure, time: Time, tense: str) -> Question:
    measured = sem.of
    if not isinstance(time, Unsaid) or tense != "present":
        said = measured.time if isinstance(time, Unsaid) else time  # "the speed after the turn"
        measured = structs.replace(measured, time=said, tense=tense)
    if measured.attribute == "heading":
        return Whither(measured.thing, time)
    held = measured.about or measured.event
    open_ = isinstance(measured.thing, Pronoun) and measured.thing.form in ("it", "that", "this")
    of_other = not held and not open_ and not isinstance(measured.thing, Ego)
    if measured.attribute == "probability" and of_other:
        return Listing("beliefs", measured.thing, time)
    if (risk := risk_asked(measured, cast(Any, tense))) is not None:
        return risk
    if measured.attribute == "probability":
        struck = measured.event is not None and measured.event.action == "collide"
        if struck and sem.extreme == "highest":
            return Peak("risk", time)
        return HowSure(
            measured.about or (Happens(measured.event) if measured.event else None), time
        )
    return HowMuch(of_numbers(measured), sem.extreme)


def _deed_of(about: Proposition | None) -> Event | None:
    """Give the deed whose reasons are listed; of "you slowed or stopped", the slowing."""
    match about:
        case Happens(event=event):
            return event
        case Both(contents=contents) if deeds := [one for one in map(_deed_of, contents) if one]:
            times = (deed.time for deed in deeds if not isinstance(deed.time, Unsaid))
            slowed = [deed for deed in deeds if deed.action in ("slow-down", "brake")]
            return structs.replace([*slowed, *deeds][0], time=next(times, Unsaid()))
        case Is(state="stationary", thing=Ego(), time=time, tense="past"):
            return Event("stop", time=time)
    return None


def _noun(sem: Noun, time: Time, tense: str) -> Question | None:
    about = propose(sem.about) or propose(sem.of) or sem.clause
    about = sem.clause if isinstance(sem.clause, Not) else about
    about = about if about is None else as_of(about, tense)
    thing = as_thing(sem.about) or as_thing(sem.of) or as_thing(sem.owner)
    if about is None and sem.key in ("reason", "factor") and isinstance(time, Relative):
        about = Happens(time.anchor) if isinstance(time.anchor, Event) else None
    if sem.key in ("reason", "factor") and not sem.plural:
        if sem.extreme or sem.key == "factor":
            return WhatWouldChange(about, most=True)
        return Why(about or That())
    if sem.key == "reason":
        each = _deed_of(about)
        return Listing("reasons", None if each else thing, time, each)
    if sem.key in _LISTED:
        return _list_of(sem, about, thing, time)
    match sem.key:
        case "deed":
            return Doing(Ego(), Rank(-1 if sem.quality == "last" else 1), "past")
        case "peak":
            return peak_named(sem, time)
        case "plan":
            actor = as_thing(sem.owner) or as_thing(sem.of) or Ego()
            return Doing(actor, time, "future")
        case "fault":
            return Fault(about, _other_than_ego(thing))
        case "order" if isinstance(sem.of, Noun) and sem.of.key in _LISTED:
            return _noun(sem.of, time, tense)  # "the sequence of your decisions"
        case "order":
            whose = None if isinstance(sem.of, Event | Noun) else _other_than_ego(thing)
            return Listing("events", whose, time)
        case "evidence":
            return HowKnow(about)
        case "ride" if isinstance(sem.clause, Happens) and isinstance(time, Unsaid):
            return Summarise(None, sem.clause.event.time)  # "everything that happened since"
        case "summary" | "ride":
            of = None if isinstance(thing, Unknown) else _other_than_ego(thing)
            return Summarise(of, time)
        case "hold-up":
            held = Event("block", Wanted(), Ego(), time=time, tense=cast(Any, tense))
            return Which(Wanted(), Happens(held))
        case "problem":
            return Why(That())
        case "danger":
            return Whether(Is("dangerous", Ego(), time=time, tense=cast(Any, tense)))
        case "difference" if isinstance(about, Happens):
            return WhatIf(about)
        case "difference":
            return Summarise(None, time)
        case "time" if isinstance(sem.of, Measure) and sem.of.extreme is not None:
            return HowMuch(sem.of.of, sem.of.extreme)  # "the time of the closest approach"
        case "time":
            return _clock(about, time)
        case "moment":
            return When(about or That())
        case "way":
            return HowMuch(Measured("route", time=time))
    return None


def _list_of(sem: Noun, about: Proposition | None, thing: Thing | None, time: Time) -> Question:
    """Ask for a list of what a noun names: of options, those beside a deed that is named."""
    if sem.key == "decision" and not (sem.plural or sem.word.endswith("s")):
        return HowDecide(about)
    of: Any = _LISTED[sem.key]
    if sem.key in ("option", "rival") and isinstance(about, Happens):
        return Listing(of, time=time, event=about.event)
    return Listing(of, _other_than_ego(thing), time)


def _clock(about: Proposition | None, time: Time) -> Question:
    return When(about) if about is not None else HowMuch(Measured("time", time=time))


def _other_than_ego(thing: Thing | None) -> Thing | None:
    return None if isinstance(thing, (Ego, Passenger)) else thing


def counted(sem: Sem) -> Question | None:
    """Return the question how many there are; None for what cannot be counted."""
    match sem:
        case Event():
            return HowMany(sem)
        case Lane():
            return HowMuch(Measured("lane-count"))
        case Noun(key="rollout"):
            return HowMuch(Measured("simulations", tense="past"))
        case Noun(key="option"):
            return HowMuch(Measured("options", tense="past"))
        case Noun() | Measure() | Moment() | Quantity() | SideOf():
            return None
        case Group(members=members):
            return counted(members[0])
        case _:
            thing = as_thing(sem)
            return HowMany(thing) if thing is not None else None
