"""Every question of every kind has an answer or a refusal, on any ride, that can be stored."""

from collections.abc import Iterator
from functools import cache
from typing import Any, get_args

import msgspec
import pytest

from tests.explain.answers.asked_facts import told
from tests.explain.facts.scenes import Actor, made, recorded, straight
from tests.explain.facts.test_measures import roads
from xavi_dialogue.domain.answers import Answer, NeedRollout, Refusal
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import (
    Claim,
    Doing,
    Fault,
    Feel,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Request,
    Summarise,
    When,
    Where,
    Whether,
    Which,
    Whither,
)
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Between,
    Both,
    Compares,
    Destination,
    Ego,
    Event,
    Everyone,
    Exists,
    Exit,
    Happens,
    Has,
    Is,
    Junction,
    Lane,
    Measured,
    Next,
    Nobody,
    Not,
    Proposition,
    Related,
    Thing,
    Unsaid,
    Vehicle,
    Vehicles,
    Wanted,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import (
    ActionName,
    Attribute,
    Extreme,
    FeelingKind,
    Relation,
    State,
)

THINGS: tuple[Thing, ...] = (
    Ego(), Vehicle(1), Vehicle(99), Vehicles((1, 2)), Nobody(), Everyone(), Destination(),
    Junction(rank=1), Exit(), Lane("left"),
)  # fmt: skip
TIMES = (Unsaid(), At(3.0), Between(1.0, 4.0), WholeRide())


def rides() -> Iterator[Any]:
    two = {0: Actor(straight(0.0, 0.0, 12.0)), 1: Actor(straight(40.0, 3.5, 9.0), colour="red")}
    yield made(two, 6.0, roads=roads)
    yield made({0: Actor(straight(0.0, 0.0, 0.0))}, 1.0)
    yield made(two, 6.0, gaps=((2.0, 4.0),), ended=True)
    yield recorded("s3-0", 12.0)
    yield recorded("s4-0", 22.0)
    yield recorded("town-0", 30.0)


def propositions() -> Iterator[Proposition]:
    for action in get_args(ActionName):
        yield Happens(Event(action, Vehicle(1), Ego(), tense="past"))
        yield Happens(Event(action, Ego(), Vehicle(1), tense="future", time=Next()))
        yield Happens(Event(action, Vehicle(2), tense="present"))
        yield Happens(Event(action, tense="past", time=Between(1.0, 4.0)))
    for state in get_args(State):
        for thing in (None, *THINGS):
            yield Is(state, thing)
        yield Is(state, None, Event("slow-down"), tense="past", time=WholeRide())
    for relation in get_args(Relation):
        yield Related(relation, Vehicle(1), Ego())
        yield Related(relation, Ego(), Everyone(), tense="past", time=WholeRide())
        yield Related(relation, Vehicle(1), Vehicle(2), time=At(3.0))
    for attribute in get_args(Attribute):
        yield Has(attribute, "left", Vehicle(1))
        yield Compares(Measured(attribute), "more", Measured(attribute, Vehicle(1)))
        yield Compares(Measured(attribute, Vehicle(1)), "too-much")
    for thing in THINGS:
        yield Exists(thing)
    yield Both((Exists(Vehicle(1)), Not(Is("fast", Ego()))), "or")


def questions() -> Iterator[Any]:
    for of in propositions():
        yield Whether(of)
        yield Claim(of, challenge=True)
        yield Whether(Not(Believed(of)))
        yield HowSure(of)
        yield When(of)
    for action in get_args(ActionName):
        event = Event(action, Wanted(), Ego())
        yield Which(Wanted(), Happens(event))
        yield Which(Wanted("car"), Happens(Event(action, Ego(), Wanted("car"))))
        yield from (HowLong(Event(action)), HowMany(Event(action, Vehicle(1))))
        yield from (Where(Event(action)), Summarise(Event(action)), Fault(Happens(Event(action))))
        yield Request(Event(action, side="left", tense="future"))
    for relation in get_args(Relation):
        yield Which(Wanted("truck"), Related(relation, Wanted(), Ego()))
    for attribute in get_args(Attribute):
        for thing in THINGS:
            for time in TIMES:
                yield HowMuch(Measured(attribute, thing, time=time))
        yield HowMuch(Measured(attribute, Vehicle(1), event=Event("slow-down"), tense="past"))
        for which in get_args(Extreme):
            yield HowMuch(Measured(attribute, Ego(), Vehicle(1), tense="past"), which)
    for thing in THINGS:
        for time in TIMES:
            yield from (Where(thing, time), Whither(thing, time), Doing(thing, time, "past"))
            yield Summarise(thing, time)
        yield from (Identify(thing), HowMany(thing), Doing(thing, tense="future"), Which(thing))
        for feeling in get_args(FeelingKind):
            yield Feel(feeling, thing)
    for of in ("events", "vehicles", "beliefs", "stops", "decisions", "wrong-predictions"):
        for time in TIMES:
            yield Listing(of, Vehicle(1), time)
            yield Listing(of, None, time)
    yield from (Doing(None, tense="past"), Feel("nervous"), HowSure(), Fault())


def kind_of(asked: Any) -> str:
    """What sort of question it is: its type, and that of what it is about."""
    inner = asked
    for name in ("that", "of", "thing"):
        inner = getattr(inner, name, None) or inner
    return f"{type(asked).__name__} {type(inner).__name__}"


EVERY = tuple(questions())
RIDES = cache(lambda: tuple(rides()))


@pytest.mark.parametrize("span", [None, Span(2.0, 4.0), Span(3.0, 3.0, said=True)])
@pytest.mark.parametrize("kind", sorted(set(map(kind_of, EVERY))))
def test_every_question_has_an_answer_or_a_refusal(span: Span | None, kind: str) -> None:
    kinds = (*get_args(Answer), *get_args(Refusal), NeedRollout)
    for k, ride in enumerate(RIDES()):
        for asked in EVERY[k :: 1 if span is None and k == 0 else 9]:
            if kind_of(asked) != kind:
                continue
            found = told(ride, asked, span)
            assert isinstance(found, kinds), asked
            stored = msgspec.json.encode(found)
            assert msgspec.json.decode(stored, type=Answer | Refusal | NeedRollout) == found
