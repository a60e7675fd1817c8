"""Whatever is asked of the causal explainers has a result that can be said, the same each time."""

import random
from itertools import product
from typing import get_args

import msgspec
import pytest

from tests.explain.causes.rides import recorded, story, told
from xavi_dialogue.domain.answers import Answer, NeedRollout, Refusal
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import (
    Compare,
    Fault,
    HowAvoid,
    HowDecide,
    HowKnow,
    HowSure,
    Listing,
    Question,
    WhatIf,
    WhatWouldChange,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    Believed,
    Caused,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Not,
    Proposition,
    Related,
    Thing,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import ActionName, State
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.say import say

ACTIONS = get_args(ActionName)
STATES = get_args(State)
RESULTS = (*get_args(Answer), *get_args(Refusal), NeedRollout)
RIDES = ("s1-0", "s2-0", "s3-0", "motorway-0", "braking", "waiting", "crash", "nobody")


def somebody(dice: random.Random) -> Thing:
    return dice.choice((Ego(), Ego(), Vehicle(1), Vehicle(2), Vehicle(99)))


def event(dice: random.Random) -> Event:
    return Event(
        dice.choice(ACTIONS),
        somebody(dice),
        dice.choice((None, None, Vehicle(1))),
        dice.choice((None, "left", "right", "straight")),
        dice.choice(((), (), ("slowly",), ("fast",), ("hard",))),
        tense=dice.choice(("past", "present", "future", "perfect")),
    )


def proposition(dice: random.Random) -> Proposition:
    kind = dice.randrange(8)
    if kind == 0:
        return Is(dice.choice(STATES), somebody(dice), tense="present")
    if kind == 1:
        return Exists(Vehicle(1))
    if kind == 2:
        return Related(dice.choice(("behind", "near", "waiting-for")), Ego(), Vehicle(1))
    if kind == 3:
        return Believed(Happens(event(dice)))
    found = Happens(event(dice))
    return Not(found) if kind == 4 else found


def question(dice: random.Random) -> Question:
    of = proposition(dice)
    return dice.choice(
        (
            Why(of),
            Why(of, suspect=Vehicle(1)),
            Why(Happens(event(dice)), instead=Happens(event(dice))),
            WhatIf(of),
            WhatIf(Not(of), Whether(Happens(event(dice)))),
            Whether(Caused(Vehicle(1), of)),
            Whether(Is("necessary", event=event(dice))),
            HowKnow(of),
            HowSure(of),
            HowSure(),
            HowDecide(of),
            WhatWouldChange(of),
            WhatWouldChange(of, most=True),
            HowAvoid(of),
            Fault(of, Vehicle(1)),
            Compare((Happens(event(dice)), Happens(event(dice))), "time"),
            Listing("options"),
        )
    )


@pytest.mark.parametrize("name", RIDES)
def test_every_question_has_a_result(name: str) -> None:
    ride = recorded(name) if "-" in name else story(name)
    dice = random.Random(name)
    last = ride.traces[-1].sim_time
    for _ in range(60):
        asked, now = question(dice), dice.uniform(0.0, last)
        span = dice.choice((None, Span(now / 2.0, now / 2.0, said=True), Span(0.0, now)))
        found = told(ride, asked, now, span)
        assert isinstance(found, RESULTS), asked
        assert msgspec.json.encode(found)
        if not isinstance(found, NeedRollout):
            assert say(found, SpeechContext(now=now, looks={})).text, asked


@pytest.mark.parametrize("name", RIDES)
def test_how_we_know_that_a_vehicle_does_something_can_be_said(name: str) -> None:
    ride = recorded(name) if "-" in name else story(name)
    moments = (ride.traces[0].sim_time, ride.traces[-1].sim_time)
    for action, now in product(ACTIONS, moments):
        asked = HowKnow(Happens(Event(action, Vehicle(1), tense="future")))
        assert say(told(ride, asked, now), SpeechContext(now=now, looks={})).text, action
