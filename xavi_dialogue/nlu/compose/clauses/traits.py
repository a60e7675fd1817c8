"""Traits: what stands before and behind the head of a noun phrase, and whom it describes."""

from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.terms import (
    Described,
    Event,
    Happens,
    Junction,
    Pronoun,
    Proposition,
    Related,
    Thing,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Sem
from xavi_dialogue.nlu.grammar.chart import Node

#: What a vehicle does whose lights are on.
LIGHTS: dict[str, ActionName] = {"indicator": "signal", "brake-lights": "brake"}


class Traits:
    """What stands before and behind the head of a noun phrase."""

    def __init__(self) -> None:
        self.fields: dict[str, Any] = {}
        self.determiner = ""
        self.owner: Sem | None = None
        self.side: str | None = None
        self.ordinal: int | None = None
        self.one_of = False  # "the first of" those named behind it
        self.following = False  # "next"
        self.extreme: str | None = None
        self.adjectives: list[str] = []
        self.unknown: list[str] = []
        self.kind: str | None = None
        self.of: Sem | None = None
        self.about: list[tuple[str, Sem]] = []
        self.beside: tuple[Sem, ...] = ()  # joined by "and" to the whole of it
        self.event: Event | None = None
        self.place: Thing | None = None  # "the roundabout business"
        self.deed: str | None = None  # "standstill duration"
        self.other = False
        self.gerund: Node | None = None
        self.clause: Proposition | None = None
        self.reason = False  # the head is a word for a reason


def described(kind: str, traits: Traits, *, plural: bool = False) -> Described:
    """Describe a road user by what is said of it."""
    fields = {k: v for k, v in traits.fields.items() if k in Described.__struct_fields__}
    if traits.side and "bearing" not in fields:
        fields["bearing"] = traits.side
    if traits.ordinal is not None:
        fields["rank"] = traits.ordinal
    if traits.extreme in ("nearest", "farthest", "fastest", "slowest", "biggest"):
        fields["extreme"] = traits.extreme
        if fields.get("bearing") in ("here", "around"):
            del fields["bearing"]  # "the fastest car here" is that of all that we see
    elif traits.extreme == "smallest":
        fields["size"] = "small"
    if isinstance(traits.of, Pronoun) and (traits.extreme or traits.ordinal is not None):
        fields["among"] = traits.of  # "the nearest of them"
    for key, value in (("far", ("bearing", "far")), ("big", ("size", "big"))):
        if key in traits.adjectives:
            fields.setdefault(*value)
    for key, sem in traits.about:
        if key in ("in", "on") and isinstance(sem, Described) and kind == "vehicle":
            kind = sem.kind  # "the one on the motorbike", "somebody in a blue car"
            for name in ("colour", "size", "bearing", "origin", "of", "doing"):
                if getattr(sem, name) is not None:
                    fields.setdefault(name, getattr(sem, name))
        elif key == "with" and isinstance(sem, Measure) and sem.of.attribute in LIGHTS:
            lit = LIGHTS[sem.of.attribute]  # "the one with the blinker on"
            fields.setdefault("doing", Event(lit, Wanted(), tense="present"))
        elif key == "at" and isinstance(sem, Junction) and sem.rank is not None:
            fields.setdefault("such", Related("on", Wanted(cast(Any, kind)), sem))
    standing = {"stationary": "stand", "moving": "move", "stuck": "stand"}
    for adjective in traits.adjectives:
        if adjective in standing:
            fields.setdefault("doing", Event(cast(Any, standing[adjective]), Wanted()))
    indefinite = traits.determiner in ("indef", "many", "no", "") and not fields.get("rank")
    fields["definite"] = not indefinite or (traits.determiner == "" and not plural)
    if traits.determiner == "indef" and traits.other:
        fields["definite"] = False
    many = traits.fields.get("number", 1) > 1
    return Described(
        kind=cast(Any, kind), plural=not traits.one_of and (plural or many),
        other=traits.other, **fields,
    )  # fmt: skip


def crossing(kind: str, traits: Traits) -> Described:
    """Describe "people crossing", in which no crossing is meant."""
    event = Event("cross", Wanted(), tense="present")
    return structs.replace(described(kind, traits, plural=True), doing=event)


def still_due(clause: Proposition | None) -> bool:
    """Say whether a relative clause is of what is to come: "the turns we still have to make"."""
    event = clause.event if isinstance(clause, Happens) else None
    return event is not None and (event.tense == "future" or event.modal == "must")
