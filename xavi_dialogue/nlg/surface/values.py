"""Values: contents of the slots of a grammar, which morphology puts into words.

| value | forms |
|---|---|
| Who | plain (subject), object, possessive, full (never "it"), we (of us: "we"), us |
| Clause | plain, short ("it did"), question, gerund, base, participle, past |
| Quantity | plain, about, number |
| Chance | adverb, modal, would, verdict, percent, words |
| Moment | plain ("at 0:12", "5 seconds ago"), clock, bare, since |
| Owned | plain |
| Number | plain ("two cars"), word, noun |
| tuple | the values as a list; or with form "or" |
| str | plain, quoted, clause |
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from xavi_dialogue.domain.terms import Described, Ego, Thing

Tense: TypeAlias = Literal[
    "past", "present", "future", "perfect", "conditional", "conditional-perfect", "past-perfect"
]
Unit: TypeAlias = Literal["m/s", "m", "s", "m/s2", "m/s3", "%", "count", "clock"]


EGO = Ego()


@dataclass(frozen=True, slots=True)
class Who:
    """A road user or thing to be referred to, as it was at a time."""

    thing: Thing = EGO
    time: float | None = None  # [s] None: now
    placed: bool = True  # False: the description must not contain the place
    coloured: bool = True
    kinded: bool = True
    ride: bool = False  # of the ego: "we" rather than "I"
    indefinite: bool = False  # "a blue car on our left (vehicle 1)"


@dataclass(frozen=True, slots=True)
class Quantity:
    """A number in SI units, to be rounded and put into words."""

    value: float
    unit: Unit


@dataclass(frozen=True, slots=True)
class Range:
    """A range between two quantities of the same unit: "from 47 to 20 km/h"."""

    low: Quantity
    high: Quantity


@dataclass(frozen=True, slots=True)
class Chance:
    """A probability."""

    value: float


@dataclass(frozen=True, slots=True)
class Moment:
    """A time of the ride."""

    time: float  # [s]


@dataclass(frozen=True, slots=True)
class Number:
    """A number of things: "two cars", "no vehicle"."""

    count: int
    noun: str  # singular


@dataclass(frozen=True, slots=True)
class Owned:
    """A noun with its owner: "our speed", "the speed of the blue car", "its lane"."""

    owner: Who
    noun: str


@dataclass(frozen=True, slots=True)
class Without:
    """Nobody who fits a description: "no blue car behind us"."""

    described: Described


@dataclass(frozen=True, slots=True)
class Clause:
    """A subject and a verb phrase, to be conjugated.

    The first word of `verb` is conjugated: "give way to". `rest` contains what follows, such as
    objects. "be" takes no "do" in negations and questions.
    """

    subject: "Who | Owned | Clause | str"
    verb: str
    rest: tuple[object, ...] = ()
    tense: Tense = "past"
    progressive: bool = False
    negated: bool = False
    modal: str | None = None  # "can", "should", "might"; "will" and "would" are tenses
    adverb: str | Chance = ""  # after the first auxiliary: "will probably turn"
    lead: str = ""  # before the subject: "that" in a relative clause
    plural: bool = False  # the subject is plural words


@dataclass(frozen=True, slots=True)
class Bare:
    """The verb phrase of a clause that shares subject and auxiliary with the one before."""

    clause: Clause
