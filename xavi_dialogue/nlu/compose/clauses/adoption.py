"""Adoption: phrases that belong to a noun of the clause rather than to its verb."""

from dataclasses import replace
from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.terms import (
    AtDecision,
    Believed,
    Both,
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Exit,
    Feature,
    Happens,
    Is,
    Junction,
    Measured,
    Not,
    Passenger,
    Proposition,
    Quantity,
    Related,
    Relative,
    Road,
    Thing,
    Time,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.clause import Clause, Complement
from xavi_dialogue.nlu.compose.clauses.sem import (
    Group,
    Measure,
    Moment,
    Noun,
    Sem,
    as_speed,
    as_thing,
    between,
)
from xavi_dialogue.nlu.compose.clauses.senses import LEFT_OTHER, Match
from xavi_dialogue.nlu.compose.clauses.tree import is_negated, words_of
from xavi_dialogue.nlu.grammar.chart import Node

CROSSINGS = frozenset({"crossing", "crosswalk", "zebra"})
_OF = frozenset({"for", "of", "about", "into", "over", "with", "from", "between", "on", "in"})
_COMPARED = {"fast": ("speed", "more"), "slow": ("speed", "less"), "close": ("distance", "less"),
             "far": ("distance", "more")}  # fmt: skip


def adopt(match: Match) -> None:
    """Attach phrases that the verb has no role for to its object."""
    for phrase in list(match.left):
        if phrase.sem is None:
            continue
        taken = None if _of_measure(phrase) else adopted(match.object, phrase)
        second = adopted(match.second, phrase) if isinstance(match.second, Measure) else None
        if taken is not None:
            match.object = taken
        elif second is not None:
            match.second = second
        elif not _of_measure(phrase):
            continue
        match.left.remove(phrase)
        match.cost -= LEFT_OTHER


def _of_measure(phrase: Complement) -> bool:
    """Check whether a phrase asks for units or times: "in metres", "with timestamps"."""
    sems = phrase.sem.members if isinstance(phrase.sem, Group) else (phrase.sem,)
    return phrase.key in ("in", "with") and all(
        isinstance(s, Moment) or (isinstance(s, Noun) and s.key == "time") for s in sems
    )


def adopted(sem: Sem | None, phrase: Complement) -> Sem | None:
    """Attach a phrase to a noun; return None if they do not go together."""
    other = phrase.sem
    if isinstance(sem, Noun) and phrase.key in _OF and sem.about is None:
        inner = phrase.node.parts[-1] if isinstance(phrase.node, Node) else None
        if isinstance(other, Event) and isinstance(inner, Node) and is_negated(inner):
            return replace(sem, about=other, clause=Not(Happens(other)))
        return replace(sem, about=other)
    if isinstance(sem, Measure) and other is not None:
        return _measured(sem, phrase.key, other)
    if isinstance(sem, Described) and sem.such is None and phrase.key in ("on", "in", "at"):
        thing = as_thing(other)
        ridden = isinstance(thing, Described) and (sem.kind != "vehicle" or phrase.key == "at")
        if thing is not None and not ridden:
            return cast(Sem, placed_on(sem, phrase, thing))
    if isinstance(sem, Event) and phrase.key in ("for", "with", "of") and sem.object is None:
        thing = as_thing(other)
        if thing is not None:
            return cast(Sem, with_fields(sem, object=thing))
    return None


def placed_on(thing: Described, phrase: Complement, place: Thing) -> Described:
    """Describe a road user by a place: "on the crossing" means that the road user crosses our way.

    "On a bicycle" or "in a van" becomes part of the description itself.
    """
    if isinstance(place, Described) and thing.kind == "vehicle" and phrase.key in ("on", "in"):
        return structs.replace(thing, **ridden(thing, place))
    if phrase.key == "at" and thing.kind == "pedestrian" and isinstance(place, Junction | Feature):
        return thing  # "the lady at the crossing": whoever is there
    if is_crossing(phrase, place) and thing.doing is None:
        return structs.replace(thing, doing=Event("cross", Wanted(), Ego(), tense="present"))
    return structs.replace(thing, such=Related("on", Wanted(), place))


def ridden(rider: Described, vehicle: Described) -> dict[str, Any]:
    """Return the fields that a rider's description takes over from the vehicle."""
    said = {name: getattr(vehicle, name) for name in _OF_RIDDEN if getattr(rider, name) is None}
    return {**said, "kind": vehicle.kind}


_OF_RIDDEN = ("colour", "size", "bearing", "origin", "of", "doing")


def is_crossing(phrase: Complement, place: Thing) -> bool:
    """Check whether a phrase is "on the crossing", where people cross the road."""
    next_one = place in (Junction(), Junction(rank=1))
    if phrase.key != "on" or not (next_one or place == Feature("crossing")):
        return False
    return not next_one or not CROSSINGS.isdisjoint(words_of(phrase.node).split())


def also_named(first: Sem, second: Sem) -> Sem:
    """Merge two names of one thing: "v16, the red one", "the bus, a white one"."""
    if not isinstance(first, Described) or not isinstance(second, Described):
        return second if isinstance(second, Vehicle) else first
    fields = {
        name: value
        for name in second.__struct_fields__
        if (value := getattr(second, name)) != getattr(Described(), name)
        and getattr(first, name) == getattr(Described(), name)
    }
    return cast(Sem, with_fields(first, **{**fields, "definite": True}))


def _measured(sem: Measure, key: str, other: Sem) -> Measure | None:
    measured = sem.of
    if isinstance(other, Junction):
        return replace(sem, of=with_fields(measured, time=Relative("during", other)))
    if key == "between" and isinstance(other, Group) and len(other.members) == 2:
        first, second = (as_thing(m) for m in other.members)
        return replace(sem, of=with_fields(measured, thing=first, to=second))
    if key in ("during", "before", "after", "since", "until"):
        anchor = other if isinstance(other, Event) else as_thing(other)
        if anchor is None:
            return None
        return replace(sem, of=with_fields(measured, time=Relative(cast(Any, key), anchor)))
    if isinstance(other, Event) and key in ("of", "for", "in", "on", "about"):
        return replace(sem, of=with_fields(measured, event=other))
    if key == "between" and (pair := between(other)) is not None:
        return replace(sem, of=with_fields(measured, thing=pair[0], to=pair[1]))
    if (near := next_to_us(key, as_thing(other))) is not None:
        return replace(sem, of=with_fields(measured, to=near))
    thing = as_thing(other)
    several = isinstance(other, Group) and not isinstance(other.members[-1], Measure)
    if thing is None or key not in _OF or several:
        return None
    if key == "of" or (measured.attribute == "probability" and isinstance(measured.thing, Ego)):
        return replace(sem, of=with_fields(measured, thing=thing))
    return replace(sem, of=with_fields(measured, to=thing))


def next_to_us(key: str, thing: Thing | None) -> Described | None:
    """Return the road user meant by "in front of us", "behind us", as the end of a distance."""
    bearing: Any = key.removeprefix("bearing-")
    if bearing not in ("ahead", "behind") or not isinstance(thing, Ego | Passenger):
        return None
    return Described(bearing=bearing, extreme="nearest")


def of_numbers(of: Measured) -> Measured:
    """Read "the distance between 2 and 4" as that of two vehicles, not of two decisions."""
    time = of.time
    if of.attribute not in ("distance", "gap") or not isinstance(time, AtDecision) or of.to:
        return of
    if time.last is None or not isinstance(of.thing, Ego):
        return of
    one, other = Vehicle(time.number), Vehicle(time.last)
    return structs.replace(of, thing=one, to=other, time=Unsaid())


def with_fields(value: Any, **fields: Any) -> Any:
    """Copy a term with other values for some fields."""
    return structs.replace(value, **fields)


_AMOUNTS = {"high": "more", "low": "less", "fast": "more", "slow": "less"}


def exceeding(clause: Clause, event: Event) -> Proposition | None:
    """Read "we are doing more than forty" as a comparison of the speed."""
    key = clause.comparisons[0][0] if clause.comparisons else ""
    than = clause.than
    if isinstance(than, Described) and than.number is not None and than.kind == "vehicle":
        than = Quantity(float(than.number))  # "a hundred and ten"
    if key not in _AMOUNTS or not isinstance(than, Quantity):
        return None
    speed = Measured("speed", event.actor, time=event.time, tense=event.tense)
    than = as_speed(than)
    if event.modal in ("can", "could", "might") and event.tense == "present":
        return Compares(with_fields(speed, attribute="limit"), cast(Any, _AMOUNTS[key]), than)
    return Compares(speed, cast(Any, _AMOUNTS[key]), than)


def _paced(clause: Clause, event: Event) -> Proposition | None:
    """Read "we are going too fast" as a state, not as an action."""
    state = "fast" if "fast" in event.manner else "slow" if "slowly" in event.manner else None
    if state is None or clause.subject is None or clause.comparisons or event.modal is not None:
        return None
    time = event.time
    whole = event.object is None and event.where is None and event.side is None
    if _takes_place(event):  # "aren't we coming up to that crossing rather fast?"
        deed = cast(Event, with_fields(event, manner=()))
        past = event.tense in ("past", "perfect") and isinstance(time, Unsaid)
        time = Relative("during", deed) if past else time
    elif event.action not in ("go", "move") or not whole:
        return None
    return Is(cast(Any, state), event.actor, too="too" in clause.focus, time=time,
              tense=event.tense)  # fmt: skip


def _takes_place(event: Event) -> bool:
    """Check whether somebody drives up to a place or through it, or comes towards us."""
    placed = isinstance(event.object, Junction | Feature | Road | Exit | Destination)
    coming = event.action in ("approach", "come") and event.tense == "present"
    return (event.action in _REACHING and placed) or (coming and event.actor != Ego())


_REACHING = frozenset({"enter", "approach", "come", "head", "go", "move", "cross", "turn"})


def _nears(event: Event) -> Proposition | None:
    """Read "did he come close" as a state, not as an action."""
    other = event.actor if not isinstance(event.actor, Ego) else event.object
    near = "close" in event.manner and event.action in ("come", "approach", "go")
    if not near or other is None or event.modal is not None or event.tense == "future":
        return None
    return Is("close", other, time=event.time, tense=event.tense)


#: By action: the attribute that "harder than two metres per second squared" compares.
_RATES: dict[str, Any] = {"brake": "deceleration", "slow-down": "deceleration",
                          "speed-up": "acceleration"}  # fmt: skip
_HARDER: dict[str, Any] = {"hard": "more", "fast": "more", "gentle": "less"}


def compared(clause: Clause, event: Event) -> Proposition | None:
    """Read "he goes faster than us" as a comparison."""
    paced = _paced(clause, event) or _nears(event)
    if paced is not None or not clause.comparisons:
        return paced
    key = clause.comparisons[0][0]
    if key in _COMPARED and not isinstance(clause.than_time, Unsaid):
        return compared_times(clause, *_COMPARED[key], event.actor)
    if isinstance(clause.than, Clause) and key == "fast" and _is_allowed(clause.than):
        speed = Measured("speed", event.actor, time=event.time, tense=event.tense)
        return Compares(speed, "more", Measured("limit"))
    if clause.than is None or isinstance(clause.than, Clause):
        return None
    if key in ("close", "far") and isinstance(clause.than, Quantity) and clause.than.unit == "m":
        near = Measured("distance", event.actor, event.object or Ego(), time=event.time,
                        tense=event.tense)  # fmt: skip
        return Compares(near, "less" if key == "close" else "more", clause.than)
    if event.action in _RATES and key in _HARDER and isinstance(clause.than, Quantity):
        rate = Measured(_RATES[event.action], event.actor, time=event.time, tense=event.tense)
        return Compares(rate, _HARDER[key], Quantity(clause.than.value, "m/s2"))
    if event.action in ("move", "go") and (found := exceeding(clause, event)) is not None:
        return found
    thing = as_thing(clause.than)
    if key not in _COMPARED or thing is None:
        return None
    attribute, direction = _COMPARED[key]
    direction = "same" if clause.comparisons[0][1] == "as" else direction
    right: Thing = Ego() if isinstance(thing, Passenger) else thing
    return Compares(
        Measured(cast(Any, attribute), event.actor, time=event.time, tense=event.tense),
        cast(Any, direction), Measured(cast(Any, attribute), right, tense=event.tense),
    )  # fmt: skip


def _is_allowed(than: Clause) -> bool:
    """Check whether a comparison is with what is allowed: "faster than you are allowed to"."""
    allowed = any(key == "allowed" for key, _ in than.adjectives) or "semi-allowed" in than.aux
    return allowed or (than.verb is not None and than.verb.key in ("allow", "permit"))


def compared_times(clause: Clause, attribute: str, direction: str, thing: Thing) -> Proposition:
    """Read "we are faster than when we came in" as a comparison with another time."""
    left = Measured(cast(Any, attribute), thing, time=clause.time, tense=cast(Any, clause.tense))
    return Compares(
        left, cast(Any, direction), with_fields(left, time=clause.than_time, tense="past")
    )


def timed(of: Proposition, time: Time) -> Proposition:
    """Put a time into an event that has none."""
    match of:
        case Happens(event=Event(time=Unsaid()) as event) if not isinstance(time, Unsaid):
            return Happens(with_fields(event, time=time))
        case Not(content=content):
            return Not(timed(content, time))
    return of


def as_of(of: Proposition, tense: str) -> Proposition:
    """Give a tenseless clause the tense of the clause that governs it: "made you stop"."""
    past = tense in ("past", "perfect")
    match of:
        case Not(content=content):
            return Not(as_of(content, tense))
        case Both(contents=contents, join=join):
            return Both(tuple(as_of(one, tense) for one in contents), join)
        case Believed(content=content, time=time, tense="present") if past:
            return Believed(content, time, cast(Any, tense))
        case Happens(event=event) if past:
            return Happens(_event_as_of(event, tense))
    return of


def _event_as_of(event: Event, tense: str) -> Event:
    then = event.then if event.then is None else _event_as_of(event.then, tense)
    own = tense if event.tense == "present" else event.tense
    return cast(Event, with_fields(event, tense=own, then=then))
