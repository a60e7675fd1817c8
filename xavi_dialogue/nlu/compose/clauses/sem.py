"""Meanings under way: what phrases stand for before they are part of a proposition."""

from dataclasses import dataclass, field
from typing import TypeAlias, cast

from xavi_dialogue.domain.terms import (
    Described,
    Destination,
    Ego,
    Event,
    Everyone,
    Exit,
    Feature,
    Junction,
    Lane,
    Measured,
    Nobody,
    Passenger,
    Pronoun,
    Proposition,
    Quantity,
    Record,
    Road,
    Thing,
    Together,
    Unknown,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import Extreme
from xavi_dialogue.nlu.grammar.lexicon import Leaf


@dataclass(frozen=True, slots=True)
class Noun:
    """An abstract noun: "reason", "plan", "fault"; `of` is what it is said to be of."""

    key: str
    of: "Sem | None" = None
    owner: "Sem | None" = None
    about: "Sem | None" = None  # "for the lane change", "over vehicle 2"
    plural: bool = False
    other: bool = False
    negative: bool = False
    extreme: Extreme | None = None
    word: str = ""
    clause: Proposition | None = None
    quality: str = ""  # of a moment: what was at its most then, as `Peak.of`
    number: int = 1  # how many such moments


@dataclass(frozen=True, slots=True)
class SideOf:
    """A side as a noun: "the left"."""

    side: str


@dataclass(frozen=True, slots=True)
class Group:
    """Several joined by "and" or "or"."""

    members: tuple["Sem", ...]
    join: str = "and"


@dataclass(frozen=True, slots=True)
class Measure:
    """A measure as a noun, with what was said of it: "the highest speed"."""

    of: Measured
    extreme: Extreme | None = None
    several: bool = False
    ours: bool = False  # said to be: "our speed"


@dataclass(frozen=True, slots=True)
class Moment:
    """A stretch of time as a noun: "seconds", "the first time"."""

    unit: str
    rank: int | None = None
    amount: float | None = None


@dataclass(frozen=True, slots=True)
class Specified:
    """A named thing with a relative clause: "vehicle 1 that made you brake"."""

    thing: Thing
    clause: Proposition


Sem: TypeAlias = Specified | Thing | Event | Quantity | Noun | SideOf | Group | Measure | Moment
THINGS = (
    Ego, Vehicle, Vehicles, Together, Nobody, Described, Pronoun, Wanted, Everyone, Destination,
    Junction, Exit, Lane, Road, Feature, Passenger, Record, Unknown,
)  # fmt: skip
ALTERNATIVES = 2  # things of which one is meant
_NUMBERS = 20  # numbers of vehicles are below
_OPEN = frozenset({"it", "that", "this", "they"})


#: Nobody of those who were spoken of: "neither of them".
NONE_OF_THEM = Nobody(Described(plural=True))


def is_thing(sem: object) -> bool:
    """Say whether a meaning is a thing of the domain."""
    return isinstance(sem, THINGS)


_LETTERS: dict[type, str] = {
    Ego: "ve", Passenger: "mv", Wanted: "vanjlfrpxdtq", Junction: "jp", Exit: "xj", Lane: "l",
    Road: "dj", Destination: "p", Record: "r", Measure: "n", Quantity: "q", Moment: "q",
    Noun: "a", SideOf: "s", Unknown: "u",
}  # fmt: skip


def types(sem: Sem) -> str:
    """Give the type letters of a meaning, the first its own; see nlu_verbs.toml."""
    match sem:
        case Pronoun(form=form):
            return "vantjlfrpxd" if form in _OPEN else "v"
        case Feature(kind=kind):
            return "fd" if kind in ("way", "light") else "fp" if kind == "queue" else "f"
        case Described(colour=colour, definite=definite) if colour and sem == Described(
            colour=colour, definite=definite
        ):
            return "vc"  # "red", "a red"
        case Event(action=action):
            return "tb" if action == "brake" else "t"
        case Group(members=members):
            return types(members[0])
        case Specified(thing=thing):
            return types(thing)
    return _LETTERS.get(type(sem), "v")


@dataclass(slots=True)
class Notes:
    """What composition finds out beside meanings, such as words without a part."""

    unknown: list[Leaf] = field(default_factory=list)
    inner: dict[int, float] = field(default_factory=dict)  # cost of clauses inside, by verb
    chained: list[object] = field(default_factory=list)  # clauses behind "and" and "or"
    taken: set[int] = field(default_factory=set)  # ids of those of which something was made


def as_lane(sem: "Sem | None") -> Lane | None:
    """Give the lane that is named by its side alone: "the left is free", "and the right?"."""
    match sem:
        case SideOf(side="left" | "right" as side):
            return Lane(side)
    return None


def as_thing(sem: "Sem | None") -> Thing | None:
    """Give the thing that a meaning is, or can be taken for."""
    if sem is None:
        return None
    if isinstance(sem, THINGS):
        return sem
    if isinstance(sem, Specified):
        return sem.thing
    if isinstance(sem, Group):
        return _together(sem) or as_thing(sem.members[0])
    if isinstance(sem, Noun) and sem.key == "end":  # "the bus's bumper"
        return as_thing(sem.owner) or as_thing(sem.of) or Pronoun("it")
    if isinstance(sem, Noun):
        return Pronoun("that") if sem.key == "event" else Unknown(sem.word or sem.key)
    if isinstance(sem, (Event, Measure)):
        return Pronoun("that")
    if isinstance(sem, Quantity) and sem.unit == "count" and sem.value in range(1, _NUMBERS):
        return Vehicle(int(sem.value))  # "the gap to 2"
    return None


def _together(group: Group) -> Together | None:
    """Give the vehicles that are joined by "and"; None for all else."""
    numbered = any(isinstance(m, Vehicle) for m in group.members)
    named = (as_thing(m) if numbered and isinstance(m, Quantity) else m for m in group.members)
    things = tuple(m for m in named if isinstance(m, Described | Vehicle))  # "vehicles 1 and 5"
    joined = group.join == "and" and len(things) == len(group.members)
    return Together(things) if joined else None


def between(sem: "Sem | None") -> tuple[Thing, Thing] | None:
    """Give the two sides of what is between others: "the bus and the van", "the two trucks"."""
    if not isinstance(sem, Group):
        return each_other(as_thing(sem))
    things = [None if isinstance(one, Event) else as_thing(one) for one in sem.members]
    one, other = things[0], things[-1]
    if len(things) != ALTERNATIVES or not (_is_other(one) and _is_other(other)):
        return None
    return cast(Thing, one), cast(Thing, other)


def each_other(thing: Thing | None) -> tuple[Thing, Thing] | None:
    """Put several things on both sides of a relation; None where one thing is meant."""
    if isinstance(thing, Pronoun) and thing.form in ("they", "them-all"):
        return Pronoun("them-all"), Pronoun("them-all")
    several = isinstance(thing, Together) or (isinstance(thing, Described) and thing.plural)
    return (thing, thing) if several and thing is not None else None


def _is_other(thing: Thing | None) -> bool:
    return isinstance(thing, Vehicle | Described | Pronoun)


def members_of(sem: "Sem | None") -> tuple["Sem", ...]:
    """List what is joined by "and" or "or"; a meaning that is no group is the only one."""
    if sem is None:
        return ()
    return sem.members if isinstance(sem, Group) else (sem,)


def alternative(sem: object) -> Thing | None:
    """Give the second of two things of which one is meant: "the bus or the lorry"."""
    pair = isinstance(sem, Group) and sem.join == "or" and len(sem.members) == ALTERNATIVES
    return as_thing(sem.members[1]) if pair and isinstance(sem, Group) else None


def as_speed(said: Quantity) -> Quantity:
    """Take a number without a unit for kilometres per hour, as people say it."""
    return Quantity(round(said.value / 3.6, 6), "m/s") if said.unit == "count" else said


def is_named(sem: Sem) -> bool:
    """Check whether a meaning is one specific vehicle: "the bus", "vehicle 7"."""
    one = isinstance(sem, Described) and sem.definite and not sem.plural
    return isinstance(sem, Vehicle) or one
