"""What would have come of it, had we done otherwise: what is asked of that."""

from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, plan, refused
from xavi_dialogue.domain.answers import (
    Contrast,
    Evidence,
    Measures,
    NeedRollout,
    NotApplicable,
    SupposedOfUs,
)
from xavi_dialogue.domain.meaning import Compare, Doing, HowMuch, When, Whether
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Quantity,
    Vehicle,
)
from xavi_dialogue.explain.answers import own_suppositions as own
from xavi_dialogue.explain.answers.asked import Unanswered
from xavi_dialogue.explain.causes.premise import Premise

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
        (whether("go", manner=("first",)), "quicker"),
        (whether("arrive", manner=("early",)), "quicker"),
        (whether("enter", manner=("fast",)), "quicker"),
        (whether("turn", manner=("fast",)), "what-if"),
        (whether("go", manner=("slowly",)), "what-if"),
        (Compare((), "safety"), "safer"),
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
    assert own.claimed(found, 3.0) == SupposedOfUs(NOTHING, claimed=3.0, form="quicker")
    assert own.claimed(found, None) is found
    other = Measures(())
    assert own.claimed(other, 3.0) is other


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
    assert own.paced(of) == event


# --- where it could have been begun -------------------------------------------------------------

TURN = Event("exit-right", tense="present")


class Tries:
    """A foil that is compared at the decisions of some times [s] alone."""

    def __init__(self, patch: pytest.MonkeyPatch, at: Any, node: Any = (), why: Any = None) -> None:
        self.at, self.why = at, why or NotApplicable(("exit-right",), "it is too late")
        last = plan(18.0)
        patch.setattr(own, "foil_at", lambda *_: (Premise(last, None, node), ("exit-right",)))
        patch.setattr(own, "contrast", self.contrast)
        patch.setattr(own, "is_open", lambda ride, trace, foil: trace.sim_time != 16.0)
        patch.setattr(own, "on_way", lambda trace, found, node: (trace.sim_time, found, node))

    def contrast(self, ride: Any, trace: Any, foil: Any, node: Any = ()) -> Any:
        assert foil == ("exit-right",)
        if trace.sim_time not in self.at:
            raise Unanswered(self.why)
        return "compared", trace.sim_time, node


TIMES = (9.0, 10.0, 14.0, 15.0, 16.0, 18.0)


def against(*turning: float) -> Any:
    plans = (plan(t, *(("exit-right",) if t in turning else ("continue",))) for t in TIMES)
    return own._against(TURN, Given(traces=tuple(plans)).asked())


def test_a_foil_is_tried_at_its_decision(monkeypatch: pytest.MonkeyPatch) -> None:
    Tries(monkeypatch, at=(18.0,), node=("stop",))
    assert against() == (18.0, ("compared", 18.0, ("stop",)), ("stop",))


def test_what_came_too_late_is_tried_where_it_could_be_begun_last(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    Tries(monkeypatch, at=TIMES[:-1])
    assert against() == (15.0, ("compared", 15.0, ()), ())  # at 16 s it was not open
    assert against(15.0) == (14.0, ("compared", 14.0, ()), ())  # there it was planned
    assert against(14.0, 15.0) == (10.0, ("compared", 10.0, ()), ())  # 8 s before
    nothing = refused(against, 10.0, 14.0, 15.0)
    assert nothing == NotApplicable(("exit-right",), "it is too late")


def test_only_what_did_not_apply_is_tried_earlier(monkeypatch: pytest.MonkeyPatch) -> None:
    Tries(monkeypatch, at=TIMES[:-1], node=("stop",))
    assert isinstance(refused(against), NotApplicable)
    Tries(monkeypatch, at=TIMES[:-1], why=NeedRollout("trace"))
    assert refused(against) == NeedRollout("trace")
