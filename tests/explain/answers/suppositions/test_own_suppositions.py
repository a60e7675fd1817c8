"""What would have come of it, had we done otherwise: what is asked of that."""

from typing import Any

import pytest

from tests.explain.answers.chosen import chosen
from tests.explain.answers.given import NOW
from xavi_dialogue.domain.answers import (
    Contrast,
    Evidence,
    Measures,
    SupposedOfUs,
    Verdict,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Compare, Doing, HowMuch, When, Where, Whether, Which
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Now,
    Quantity,
    Vehicle,
    Wanted,
)
from xavi_dialogue.explain.answers.suppositions import own_suppositions as own
from xavi_dialogue.explain.answers.suppositions import supposed_when, undone

ONE = Vehicle(1)
SPEED = Measured("speed")
NOTHING = Contrast((), (), None, (), (), Evidence(), NOW)


def whether(action: Any, actor: Any = None, **more: Any) -> Whether:
    return Whether(Happens(Event(action, actor or Ego(), **more)))


# --- what is asked ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("then", "form"),
    [
        (None, "what-if"),
        (Doing(), "what-if"),
        (whether("collide"), "crash"),
        (Which(Wanted(), Happens(Event("collide", Wanted(), Ego()))), "chance"),
        (whether("go", manner=("first",)), "quicker"),
        (whether("arrive", manner=("early",)), "quicker"),
        (whether("enter", manner=("fast",)), "quicker"),
        (whether("turn", manner=("fast",)), "what-if"),
        (whether("turn", manner=("early",)), "quicker"),
        (Where(Ego()), "arrival"),
        (Whether(Happens(Event("arrive", Ego(), time=Now()))), "arrival"),
        (whether("go", manner=("slowly",)), "what-if"),
        (Compare((), "safety"), "safer"),
        (Compare((), "safety", least=True), "riskier"),
        (Whether(Is("dangerous", Ego())), "dangerous"),
        (Whether(Is("safe", Ego())), "safe"),
        (Whether(Is("dangerous", ONE)), "what-if"),
        (Compare((), "time"), "quicker"),
        (Compare((), "speed"), "quicker"),
        (Compare((), "comfort"), "what-if"),
        (Whether(Is("possible")), "could"),
        (Whether(Is("possible", event=Event("stop"))), "what-if"),
        (whether("go"), "could"),
        (whether("enter"), "could"),
        (whether("arrive"), "could"),
        (whether("go", ONE), "what-if"),
        (whether("turn"), "what-if"),
        (When(Happens(Event("arrive"))), "arrival"),
        (When(Is("over", Ego())), "arrival"),
        (When(Happens(Event("pass"))), "arrival"),
        (When(Happens(Event("stop"))), "what-if"),
        (HowMuch(Measured("arrival-time")), "arrival"),
        (HowMuch(Measured("time-to-go")), "arrival"),
        (HowMuch(Measured("delay")), "arrival"),
        (HowMuch(Measured("time")), "arrival"),
        (HowMuch(SPEED), "what-if"),
    ],
)
def test_what_is_asked_of_a_supposed_world(then: Any, form: str) -> None:
    assert own.form_of(then) == form


def test_who_would_have_been_struck_is_named() -> None:
    assert own.struck_in(whether("collide", object=ONE)) == 1
    assert own.struck_in(whether("collide", ONE)) == 1
    assert own.struck_in(whether("nearly-collide", ONE, object=Vehicle(2))) == 2
    assert own.struck_in(whether("stop", object=ONE)) is None
    assert own.struck_in(Doing()) is None
    assert own.struck_in(None) is None


def test_a_gain_that_is_claimed_is_held_against_what_it_would_be() -> None:
    delay = Compares(Measured("delay"), "more", Quantity(3.0, "s"))
    assert own.claimed_in(delay) == 3.0
    assert own.claimed_in(Compares(Measured("delay"), "more", Quantity(3.0, "m"))) is None
    assert own.claimed_in(Compares(SPEED, "more", Quantity(3.0, "s"))) is None
    assert own.claimed_in(None) is None
    found = SupposedOfUs(NOTHING)
    assert own.claimed(found, delay) == SupposedOfUs(NOTHING, claimed=3.0, form="quicker")
    assert own.claimed(found, None) is found
    other = Measures(())
    assert own.claimed(other, delay) is other


@pytest.mark.parametrize(("cost", "holds"), [(1.0, False), (2.5, True), (4.0, True), (9.0, None)])
def test_a_delay_is_held_against_what_it_is_said_to_be(cost: float, holds: bool | None) -> None:
    said = Compares(Measured("delay"), "same", Quantity(3.0, "s"))
    told = Measures((Measure("delay", Ego(), 0.0, value=cost),))
    found = own.claimed(told, said)
    if holds is None:
        assert found is told
    else:
        assert found == Verdict(said, holds, told.measures)


@pytest.mark.parametrize(
    ("of", "event"),
    [
        (Compares(SPEED, "more"), Event("go", manner=("fast",), tense="present")),
        (Compares(SPEED, "less"), Event("slow-down", manner=("slowly",), tense="present")),
        (Compares(Measured("speed", ONE), "more"), None),
        (Compares(Measured("delay"), "more"), None),
        (Is("fast", tense="past"), Event("go", manner=("fast",), tense="past")),
        (Is("slow", Ego()), Event("slow-down", manner=("slowly",), tense="present")),
        (Is("fast", ONE), None),
        (Is("safe"), None),
        (None, None),
    ],
)
def test_being_faster_is_read_as_driving_so(of: Any, event: Any) -> None:
    assert undone.paced(of) == event


@pytest.mark.parametrize(
    ("then", "of_now"),
    [
        (Doing(tense="present"), True),
        (Doing(tense="future"), True),
        (Doing(tense="past"), False),
        (Whether(Happens(Event("arrive", tense="present", modal="would"))), True),
        (Whether(Happens(Event("arrive", tense="past", modal="would"))), False),
        (None, False),
    ],
)
def test_a_supposition_in_the_past_tense_is_of_now_where_the_rest_is(
    then: Any, of_now: bool
) -> None:
    turned = Event("change-left", tense="past")
    asked = chosen(Span(3.0, 5.0))
    event, scene = supposed_when.imagined(turned, then, asked)
    assert event.tense == ("present" if of_now else "past")
    assert (scene.span is None) is of_now
    said = chosen(Span(3.0, 5.0, said=True))
    assert supposed_when.imagined(turned, then, said) == (turned, said)
