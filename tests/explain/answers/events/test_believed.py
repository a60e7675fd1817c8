"""Whether we believed, meant or knew something at a time."""

from types import SimpleNamespace
from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, deed, expects, look, plan, their
from xavi_dialogue.domain.answers import Beliefs
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Belief
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Not,
    Vehicle,
)
from xavi_dialogue.explain.answers.events import beliefs
from xavi_dialogue.explain.answers.propositions import weighing
from xavi_dialogue.explain.answers.reference.findings import Finding

ONE = Vehicle(1)
TURNS = Happens(Event("exit-right", ONE))
BELIEF = expects(1, (("exit-right",), 0.7), (("exit-left",), 0.3))
LONG_AGO = Span(3.0, 5.0, said=True)


def believed(of: Any, span: Span | None = None, **more: Any) -> Any:
    return weighing.weigh(of, Given(**more).asked(span))


def chance_of(*shares: tuple[float, float | None]) -> Any:
    """The probability of what is asked about: each from a time [s] on."""

    def chance(asked: Any, event: Event, at: float) -> float | None:
        known = [share for time, share in shares if time <= at + 1e-6]
        return known[-1] if known else None

    return chance


@pytest.fixture(autouse=True)
def chances(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(beliefs, "chance", chance_of((0.0, 0.3), (8.0, 0.7)))


GIVEN: dict[str, Any] = {"looks": {1: look(1)}, "beliefs": {1: BELIEF}}


def test_what_was_believed_of_another_is_its_probability() -> None:
    found = believed(Believed(TURNS), **GIVEN)
    assert (found.holds, found.probability, found.believed) == (True, 0.7, (BELIEF,))
    told = found.answer
    assert isinstance(told, Beliefs)
    assert (told.vehicle, told.of, told.probability, told.time) == (1, TURNS.event, 0.7, NOW)
    assert [one.actions for one in told.besides] == [("exit-left",)]
    early = believed(Believed(TURNS, At(5.0)), **GIVEN)
    assert (early.holds, early.probability, early.answer.time) == (False, 0.3, 5.0)
    said = believed(Believed(TURNS), LONG_AGO, **GIVEN)
    assert (said.probability, said.answer.time) == (0.3, 4.0)


def test_doubt_and_denial_turn_it_round() -> None:
    denied = believed(Believed(Not(TURNS)), **GIVEN)
    assert (denied.holds, denied.probability) == (False, pytest.approx(0.3))
    twice = believed(Believed(Not(Not(TURNS))), **GIVEN)
    assert (twice.holds, twice.probability) == (True, 0.7)


def test_what_came_was_believed_before_it_came() -> None:
    turned = their(1, "exit-right", 8.1, 10.0)
    found = believed(Believed(TURNS), deeds=(turned,), **GIVEN)
    assert (found.probability, found.facts, found.answer.came) == (0.3, (turned,), turned)
    assert (found.answer.knew, found.answer.time) == (True, pytest.approx(7.9))
    late = their(1, "exit-right", 12.0, 14.0)
    assert believed(Believed(TURNS), deeds=(late,), **GIVEN).probability == 0.7
    then = believed(Believed(TURNS, At(9.0)), deeds=(turned,), **GIVEN)
    assert then.probability == 0.3
    soon = believed(Believed(TURNS, At(7.9)), deeds=(their(1, "exit-right", 9.4),), **GIVEN)
    assert soon.probability == 0.3
    after = believed(Believed(TURNS, At(10.0)), deeds=(their(1, "exit-right", 15.0),), **GIVEN)
    assert (after.probability, after.answer.came.begin) == (0.7, 15.0)


def test_since_when_it_was_likely_without_a_break(monkeypatch: pytest.MonkeyPatch) -> None:
    rows = tuple(Belief(1, time, BELIEF.expectations) for time in (2.0, 4.0, 6.0, 8.0))
    world = SimpleNamespace(begin=0.0, beliefs=lambda *args: rows)
    asked: Any = SimpleNamespace(world=world)
    for shares, held in (
        ((0.2, 0.6, 0.7, 0.9), (4.0, 0.2)),
        ((0.6, 0.2, 0.4, 0.9), (8.0, 0.4)),
        ((0.6, 0.7, 0.7, 0.9), (None, None)),
        ((0.2, 0.7, 0.7, 0.3), (None, None)),
    ):
        row = tuple(zip((2.0, 4.0, 6.0, 8.0), shares, strict=True))
        monkeypatch.setattr(beliefs, "chance", chance_of(*row))
        assert beliefs.held_since(asked, TURNS.event, 8.0) == held


def test_even_odds_count_as_expected(monkeypatch: pytest.MonkeyPatch) -> None:
    for share, holds in ((0.5, True), (0.49, False)):
        monkeypatch.setattr(beliefs, "chance", chance_of((0.0, share)))
        assert believed(Believed(TURNS), **GIVEN).holds is holds


def test_what_nobody_reckoned_with_is_not_recorded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(beliefs, "chance", lambda *args: None)
    turned = their(1, "exit-right", 12.0, 14.0)
    found = believed(Believed(TURNS), deeds=(turned,), **GIVEN)
    assert (found.holds, found.gap) == (None, "not-recorded")
    assert (found.facts, found.believed) == ((turned, look(1)), (BELIEF,))
    alone = believed(Believed(TURNS), looks={1: lambda t: None if t >= 11.8 else look(1)},
                     deeds=(turned,))  # fmt: skip
    assert (alone.facts, alone.believed) == ((turned,), ())
    assert believed(Believed(TURNS), looks={1: look(1)}).facts == (look(1),)


# --- of us --------------------------------------------------------------------------------------

OURS = Happens(Event("exit-right"))
PLANS = (plan(3.0, "continue", "exit-right"), plan(10.0, "stop"))


def test_what_we_meant_is_what_was_planned() -> None:
    turned = deed("exit-right", 12.0, 14.0)
    then = believed(Believed(OURS, At(5.0)), traces=PLANS, deeds=(turned,))
    assert (then.holds, then.facts) == (True, (turned,))
    late = believed(Believed(OURS, At(11.0)), traces=PLANS)
    assert (late.holds, late.facts) == (False, ())
    before = believed(Believed(OURS, At(1.0)), traces=PLANS)
    assert (before.holds, before.gap) == (None, "before-record")
    content = Happens(Event("exit-right", time=At(5.0)))
    assert believed(Believed(content), traces=PLANS).holds is True


def test_what_is_no_plan_of_ours_is_weighed_as_such(monkeypatch: pytest.MonkeyPatch) -> None:
    told = Finding(True)
    for name in ("happens", "condition", "exists", "has"):
        monkeypatch.setattr(weighing, name, lambda of, asked: told)
    monkeypatch.setattr(weighing, "duty", lambda *args: None)
    monkeypatch.setattr(weighing, "conduct", lambda *args: None)
    for of in (Happens(Event("brake")), Happens(Event("see", ONE, Ego())), Is("safe", ONE),
               Exists(Ego()), Has("lane", "left")):  # fmt: skip
        assert believed(Believed(of), looks={1: look(1)}) is told


# --- knowing of a vehicle -----------------------------------------------------------------------


@pytest.mark.parametrize("of", [Exists(ONE), Is("present", ONE), Is("visible", ONE)])
def test_we_knew_of_a_vehicle_from_when_we_first_saw_it(of: Any) -> None:
    def seen(time: float) -> Any:
        return look(1, time=time) if time >= 6.0 else None

    given: dict[str, Any] = {"looks": {1: seen}, "traces": (plan(3.0), plan(7.0), plan(9.0))}
    found = believed(Believed(of, At(8.0)), **given)
    assert (found.holds, found.facts) == (True, (look(1, time=7.0),))
    assert believed(Believed(of, At(7.0)), **given).holds is True
    assert believed(Believed(of, At(5.0)), **given).holds is False
    assert believed(Believed(of), **given).holds is True
    never = believed(Believed(of), looks={1: None})
    assert (never.holds, never.facts) == (False, ())
