"""Spans, needs and what is allowed: each is read as what it asks for."""

import pytest

from xavi_dialogue.domain.meaning import Act, Ask, HowLong, HowMuch, WhatIf, Whether, Why
from xavi_dialogue.domain.terms import Compares, Ego, Event, Happens, Measured, WholeRide
from xavi_dialogue.nlu.parse import Parser


def first(text: str) -> Act:
    return Parser().read(text)[0].acts[0]


@pytest.mark.parametrize("words", ["From when until when", "From when to when"])
def test_a_span_that_is_asked_for_is_how_long(words: str) -> None:
    match first(f"{words} did we stand at the lights?"):
        case Ask(question=HowLong(of=Event(action="stand", actor=Ego()))):
            return
    pytest.fail(words)


@pytest.mark.parametrize("need", ["if you had to", "if you must"])
def test_a_need_that_is_supposed_changes_no_world(need: str) -> None:
    match first(f"Could you stop in time {need}?"):
        case Ask(question=Whether(that=Happens(event=Event(action="stop")))):
            return
    pytest.fail(need)


def test_what_we_are_allowed_to_do_is_the_limit() -> None:
    match first("What are we allowed to do here?"):
        case Ask(question=HowMuch(of=Measured(attribute="limit", thing=Ego()))):
            return
    pytest.fail("the limit")


def test_more_time_or_less_asks_how_much() -> None:
    match first("If you had waited, would we have lost more time or less?"):
        case Ask(question=WhatIf(then=HowMuch(of=Measured(attribute="delay")))):
            return
    pytest.fail("the delay")


@pytest.mark.parametrize("named", ["it all", "this trip", "the ride"])
def test_why_a_ride_took_long_is_asked_of_all_of_it(named: str) -> None:
    match first(f"Why did {named} take so long?"):
        case Ask(
            question=Why(
                of=Compares(left=Measured(attribute="duration", thing=Ego(), time=WholeRide()))
            )
        ):
            return
    pytest.fail(named)


def test_somebody_who_stays_ahead_of_us_does_not_stand() -> None:
    match first("If he stays in front of us, how much later do I get there?"):
        case Ask(
            question=WhatIf(
                supposed=Happens(event=Event(action="continue", object=Ego())),
                then=HowMuch(of=Measured(attribute="delay")),
            )
        ):
            return
    pytest.fail("continue")


def test_right_at_the_start_is_no_side() -> None:
    match first("What if you had moved over right at the start?"):
        case Ask(question=WhatIf(supposed=Happens(event=Event(action="change-lane", side=None)))):
            return
    pytest.fail("no side")
