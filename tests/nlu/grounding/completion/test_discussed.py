"""What "that", "it" and an omitted clause stand for."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.fakes import Car, FakeWorld, did, talk
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import (
    Ask,
    Claim,
    Compare,
    Doing,
    HowLong,
    HowMany,
    HowMuch,
    Identify,
    Listing,
    Question,
    Request,
    WhatIf,
    Where,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Measured,
    Not,
    Now,
    Related,
    That,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.grounding.completion.discussion import (
    affirmed,
    asserted,
    beside_road,
    discussed,
    hindrance,
    interval,
    last_deed,
    proposition_of,
    questioned,
)
from xavi_dialogue.nlu.grounding.completion.ellipsis import under_discussion
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

SLOWED = Event("slow-down", time=Between(14.0, 16.0))
BRAKED = Event("brake", Vehicle(3), time=At(12.0))
DEEDS = (
    did("give-way", 4.0, 6.0, whom=1),
    did("see", 7.0, 8.0),
    did("brake", 12.0, 13.0, who=3),
    did("slow-down", 14.0, 16.0),
    did("change-left", 17.0, 18.0),
)


def grounder(discourse: Discourse | None = None, *happened: Any) -> TermGrounder:
    cars = {1: Car(20.0, kind="bus", colour="yellow"), 2: Car(-10.0), 3: Car(30.0, 3.5)}
    world = FakeWorld(cars, happened or DEEDS, now=20.0)
    return TermGrounder(Context(world, discourse or Discourse()))


def context(discourse: Discourse | None = None, *happened: Any) -> Context:
    return grounder(discourse, *happened).context


@pytest.mark.parametrize(
    ("question", "found"),
    [
        (None, None),
        (HowMany(SLOWED), Happens(SLOWED)),
        (HowMany(Described()), None),
        (Compare((Vehicle(1), Vehicle(2)), by="speed"), None),
        (HowLong(SLOWED), Happens(SLOWED)),
        (HowLong(Is("fast", Ego())), Is("fast", Ego())),
        (Where(SLOWED), Happens(SLOWED)),
        (Where(Vehicle(1)), None),
        (Doing(Vehicle(1)), Happens(Event("do", Vehicle(1), tense="present"))),
        (Whither(Vehicle(1)), Happens(Event("do", Vehicle(1), tense="present"))),
        (Listing("beliefs", Vehicle(1)), Happens(Event("do", Vehicle(1), tense="present"))),
        (Listing("events", Vehicle(1)), None),
        (Doing(Vehicle(1), besides=Happens(SLOWED)), Happens(SLOWED)),
        (Doing(), None),
        (Why(Happens(SLOWED)), Happens(SLOWED)),
        (Whether(Happens(SLOWED)), Happens(SLOWED)),
        (WhatIf(Not(Happens(SLOWED))), Not(Happens(SLOWED))),
        (Which(Wanted(), Happens(SLOWED)), Happens(SLOWED)),
        (Whether(That()), None),
        (HowMuch(Measured("speed")), None),
    ],
)
def test_what_a_question_is_about(question: Question | None, found: Any) -> None:
    assert proposition_of(question) == found


def test_what_was_said_or_asked_last_and_else_what_we_did() -> None:
    said = Happens(BRAKED)
    asked = talk(question=Why(Happens(SLOWED)), propositions=(That(), said))
    assert asserted(context(asked)) == said
    assert questioned(context(asked)) == Happens(SLOWED)
    plain = talk(question=Identify(Vehicle(1)), propositions=(That(), said))
    assert questioned(context(plain)) == said
    changed = Event("change-left", time=Between(17.0, 18.0))
    assert asserted(context()) == questioned(context()) == Happens(changed)
    assert last_deed(context()) == changed
    assert questioned(context(None, did("see", 3.0))) is None
    assert affirmed(Not(said)) == affirmed(said) == said


def test_what_somebody_did_last_is_that_in_focus() -> None:
    focus = talk(episode=(5.0, 6.0))
    assert last_deed(context(focus)) == Event("give-way", object=Vehicle(1), time=Between(4.0, 6.0))
    assert last_deed(context(talk(episode=(6.1, 7.0)))) == Event(
        "change-left", time=Between(17.0, 18.0)
    )
    going_on = (did("stop", 10.0, going_on=True), did("change-left", 17.0, 18.0))
    assert last_deed(context(talk(episode=(12.0, 13.0)), *going_on)) == Event(
        "stop", time=Between(10.0, 20.0)
    )


def test_the_event_under_discussion_is_that_of_the_question_then_of_what_was_said() -> None:
    told = talk(question=Why(Happens(SLOWED)), propositions=(Happens(BRAKED),))
    assert discussed(context(told)) == SLOWED
    assert discussed(context(told), Vehicle(3)) == BRAKED
    assert discussed(context(told), Vehicle(2)) is None
    third = Event("brake", Vehicle(3), time=Between(12.0, 13.0))
    assert discussed(context(), Vehicle(3)) == third
    assert discussed(context(), Ego()) == discussed(context())
    assert discussed(context(), Described()) is None
    for act in (Ask(Why(Happens(BRAKED))), Claim(Happens(BRAKED)), Request(BRAKED)):
        assert discussed(context(Discourse(last_acts=(act,)))) == BRAKED


@pytest.mark.parametrize(
    ("event", "when"),
    [(SLOWED, (14.0, 16.0)), (BRAKED, (12.0, 12.0)), (replace(SLOWED, time=Now()), None)],
)
def test_when_a_grounded_event_was(event: Event, when: Any) -> None:
    assert interval(event) == when


def test_what_hindered_us() -> None:
    slowed = SLOWED
    assert hindrance(context()) == slowed
    gave = Event("give-way", object=Vehicle(1), time=Between(4.0, 6.0))
    assert hindrance(context(talk(episode=(5.0, 6.0)))) == gave
    assert hindrance(context(talk(episode=(9.0, 10.0)))) == slowed
    told = Event("wait", time=At(3.0))
    assert hindrance(context(talk(propositions=(Happens(told),)))) == told
    for other in (replace(told, time=Unsaid()), replace(told, actor=Vehicle(1)), Event("turn")):
        assert hindrance(context(talk(propositions=(Happens(other),)))) == slowed
    assert hindrance(context(None, did("see", 3.0))) is None


def test_what_that_was_for_beside_how_the_road_is() -> None:
    free = talk(propositions=(That(), Is("free", Ego())), asked_at=10.0)
    assert beside_road(context(free)) == SLOWED
    assert beside_road(context(replace(free, asked_at=15.0))) == SLOWED  # the last at all
    for told in (Exists(Vehicle(1)), Related("behind", Vehicle(1), Ego())):
        assert beside_road(context(talk(propositions=(told,)))) == SLOWED
    assert beside_road(context(talk(propositions=(Is("fast", Ego()),)))) is None
    assert beside_road(context()) is None
    later = (did("brake", 5.0, 6.0), did("wait", 12.0, 13.0))
    assert beside_road(context(free, *later)) == Event("wait", time=Between(12.0, 13.0))


def test_a_claim_or_request_is_under_discussion_where_no_question_is() -> None:
    why = Why(Happens(SLOWED))
    assert under_discussion(grounder(talk(question=why))) == why
    for act, found in (
        (Ask(why), why),
        (Claim(Happens(SLOWED)), Whether(Happens(SLOWED))),
        (Request(SLOWED), Whether(Happens(SLOWED))),
    ):
        assert under_discussion(grounder(Discourse(last_acts=(act,)))) == found
    assert under_discussion(grounder()) is None
