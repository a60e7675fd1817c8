"""What is asked of a few vehicles named together is asked of each of them."""

from typing import Any

import pytest

from xavi_dialogue.dialogue.severally import listed, severally, whys
from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.meaning import Ask, Doing, Listing, Whether, Which, Whither, Why
from xavi_dialogue.domain.terms import At, Ego, Event, Happens, Vehicle, Vehicles, Wanted

BOTH = Vehicles((1, 2))


def asked(make: Any, whom: Any) -> GroundedAct:
    return GroundedAct(Ask(make(whom)))


@pytest.mark.parametrize(
    "make",
    [
        lambda who: Why(Happens(Event("stop", who))),
        lambda who: Whether(Happens(Event("turn", who))),
        lambda who: Which(Wanted(), Happens(Event("wait", who, Wanted()))),
        lambda who: Whither(who),
        lambda who: Doing(who),
    ],
)
def test_a_question_of_two_is_asked_of_each(make: Any) -> None:
    found = severally(asked(make, BOTH))
    assert found == (asked(make, Vehicle(1)), asked(make, Vehicle(2)))


@pytest.mark.parametrize(
    "act",
    [
        asked(lambda who: Why(Happens(Event("go", who, manner=("first",)))), BOTH),
        asked(lambda who: Whether(Happens(Event("wait", who, Ego()))), BOTH),
        asked(lambda who: Whether(Happens(Event("turn", who, modal="must"))), BOTH),
        asked(Doing, Vehicles((1, 2, 3, 4))),
        asked(Doing, Vehicle(1)),
    ],
)
def test_what_is_told_of_all_at_once_stays_one_question(act: GroundedAct) -> None:
    assert severally(act) == (act,)


def test_the_reason_of_each_occasion_is_asked_at_its_time() -> None:
    asking = GroundedAct(Ask(Listing("reasons", event=Event("brake"))))
    events = listed(asking)
    assert events is not None
    assert events.act == Ask(Listing("events", event=Event("brake")))
    deeds = (Episode(Ego(), "brake", 3.0, 5.0), Episode(Ego(), "brake", 9.0, None))
    first, second = whys(asking, deeds, now=11.0)
    assert first.act == Ask(Why(Happens(Event("brake", time=At(3.0)))))
    assert (first.span, second.span) == (Span(3.0, 5.0, said=True), Span(9.0, 11.0, said=True))
    assert whys(asking, (), now=11.0) == ()
    assert listed(GroundedAct(Ask(Listing("reasons")))) is None
