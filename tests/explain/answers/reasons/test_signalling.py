"""Our own indicator; plans given up for their risk; whom an option would have struck."""

from itertools import pairwise
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.events import Event as Recorded
from planner.record.trace import HeldUp
from tests.explain.answers.given import NOW, Given, Told, deed, option, plan, refused
from tests.explain.answers.imagined import Drive, decided
from xavi_dialogue.domain.answers import DidNotHappen, Evidence, Options, OwnSignal
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.journeys import AbandonedPlan
from xavi_dialogue.domain.meaning import Doing, WhatIf, Which, Why
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Not,
    Vehicle,
    Wanted,
)
from xavi_dialogue.explain.answers import abandoned_plans
from xavi_dialogue.explain.answers.propositions import reasons
from xavi_dialogue.explain.answers.reasons import signalling
from xavi_dialogue.explain.answers.suppositions import risks, supposing

LEFT, RIGHT = (
    deed("signal", 5.0, 9.0, side="left"),
    deed("signal", 14.0, 17.0, side="right"),
)


def why_signal(side: Any = None, *, past: bool = True, span: Any = None, **more: Any) -> Any:
    given = {"deeds": (LEFT, RIGHT)} | more
    return signalling.why_signal(side, Given(**given).asked(span), past=past)


def test_the_indicator_asked_about_is_that_of_its_side_and_time() -> None:
    assert why_signal().shown == RIGHT
    assert why_signal("left").shown == LEFT
    assert why_signal(span=Span(6.0, 7.0, said=True)).shown == LEFT
    assert refused(why_signal, "right", deeds=(LEFT,)) == DidNotHappen(
        Event("signal", side="right")
    )
    assert refused(why_signal, deeds=()) == DidNotHappen(Event("signal"))


@pytest.mark.parametrize(("end", "on"), [(None, True), (19.0, True), (18.9, False)])
def test_what_is_on_now_went_out_no_more_than_a_second_ago(end: Any, on: bool) -> None:
    lit = deed("signal", 14.0, end, side="right")
    if on:
        assert why_signal(past=False, deeds=(lit,)).shown == lit
    else:
        never = DidNotHappen(Event("signal", tense="present"))
        assert refused(why_signal, past=False, deeds=(lit,)) == never


@pytest.mark.parametrize(
    ("plans", "aim"),
    [
        (((13.0, "change-left"),), None),
        (((13.0, "change-right"),), "change-right"),
        (((15.0, "continue", "exit-right"),), "exit-right"),
        (((17.0, "exit-right"),), "exit-right"),
        (((17.1, "exit-right"),), None),
        (((12.9, "exit-right"),), None),
        (((14.0, "continue"), (15.0, "exit-right"), (16.0, "change-right")), "exit-right"),
    ],
)
def test_an_indicator_announces_what_was_planned_to_its_side(plans: Any, aim: Any) -> None:
    found = why_signal("right", traces=tuple(plan(*one) for one in plans))
    assert (found.aim, found.past) == (aim, True)
    assert found.came is (None if aim is None else False)


def test_what_is_under_way_is_announced_before_what_is_planned() -> None:
    trace = plan(15.0, "exit-right", under_way="change-right")
    assert why_signal("right", traces=(trace,)).aim == "change-right"
    left = why_signal("left", traces=(plan(6.0, "exit-left"),))
    assert left.aim == "exit-left"
    on = deed("signal", 14.0, side="right")
    late = (plan(NOW, "exit-right"),)
    assert why_signal("right", past=False, deeds=(on,), traces=late).aim == "exit-right"


def did(begin: float, end: float | None = None, action: Any = "exit-right") -> Any:
    started = Recorded("action-started", begin, action, 1)
    ends = () if end is None else (Recorded("action-ended", end, action),)
    committed = () if end is None else (Recorded("action-committed", begin + 0.1, action),)
    return {"events": (started, *committed, *ends), "traces": (plan(15.0, "exit-right"),)}


def test_what_was_announced_came_where_it_was_done_then() -> None:
    assert why_signal("right", **did(16.0, 19.0)).came is True
    assert why_signal("right", **did(18.0, 19.0)).came is True
    assert why_signal("right", **did(18.1, 19.0)).came is False
    assert why_signal("right", **did(12.0, 14.0)).came is True
    assert why_signal("right", **did(12.0, 13.9)).came is False
    assert why_signal("right", **did(16.0, 19.0, "exit-left")).came is False


def test_what_is_announced_now_may_still_come() -> None:
    on = deed("signal", 14.0, side="right")
    found = why_signal("right", past=False, deeds=(on,), **did(1.0, 2.0))
    assert found == OwnSignal(on, "exit-right", None, past=False)
    just = deed("signal", 14.0, 19.1, side="right")
    assert why_signal("right", deeds=(just,), **did(1.0, 2.0)).came is None
    over = deed("signal", 14.0, 19.0, side="right")
    assert why_signal("right", deeds=(over,), **did(1.0, 2.0)).came is False


# --- abandoned plans ---------------------------------------------------------------------------

PIPELINE = Event("change-plan")


def wavered(
    patch: pytest.MonkeyPatch, *plans: tuple[float, Any], risk: Any = 0.2, time: Any = None,
    others: Any = (), now: float = NOW,
) -> Any:  # fmt: skip
    """Why we changed our mind, where each option had a risk of a collision with vehicle 3."""

    def options(ride: Any, trace: Any) -> Any:
        risky = risk if isinstance(risk, float) else risk[trace.sim_time]
        return (option("stop"), option("exit-right", collision=risky, collided_with=3), *others)

    patch.setattr(abandoned_plans, "of_trace", options)
    patch.setattr(reasons, "why", lambda question, asked: Told("why"))
    patch.setattr(abandoned_plans, "last_change", lambda asked, since: None)
    event = PIPELINE if time is None else replace(PIPELINE, time=time)
    traces = tuple(plan(t, *((one,) if one else ())) for t, one in plans)
    changes = tuple(
        deed("change-plan", b, b) for (_, old), (b, new) in pairwise(plans) if old != new
    )
    given = Given(traces=traces, now=now, deeds=changes)
    return abandoned_plans.wavered(Why(Happens(event)), given.asked())


TURN: Any = "exit-right"
STOP: Any = "stop"


def test_a_plan_was_given_up_for_a_stop_each_time_for_its_risk(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    plans = ((10.0, TURN), (11.0, STOP), (12.0, TURN), (13.0, STOP), (14.0, STOP))
    found = wavered(monkeypatch, *plans)
    assert found.plan == TURN
    assert found.turns == (AbandonedPlan(11.0, 0.2, 3), AbandonedPlan(13.0, 0.2, 3))
    assert found.resumed is False
    assert wavered(monkeypatch, *plans, (15.0, TURN)).resumed is True
    assert wavered(monkeypatch, *plans[:3]).resumed is True


def test_only_a_plan_given_up_for_a_stop_and_its_risk_counts(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    given_up = ((10.0, TURN), (11.0, STOP))
    assert wavered(monkeypatch, *given_up, risk=0.05).turns[0].risk == 0.05
    assert wavered(monkeypatch, *given_up, risk=0.04) == Told("why")
    unchanged = refused(wavered, monkeypatch, (10.0, STOP), (11.0, STOP))
    assert isinstance(unchanged, DidNotHappen)
    assert wavered(monkeypatch, (10.0, TURN), (11.0, "continue")) == Told("why")
    assert wavered(monkeypatch, (10.0, None), (11.0, STOP)) == Told("why")
    assert wavered(monkeypatch, (10.0, "change-left"), (11.0, STOP)) == Told("why")
    twice = ((10.0, TURN), (11.0, STOP), (12.0, TURN), (13.0, STOP))
    risk = {11.0: 0.01, 13.0: 0.3}
    assert wavered(monkeypatch, *twice, risk=risk).turns == (AbandonedPlan(13.0, 0.3, 3),)


def test_the_plan_given_up_last_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    plans = ((10.0, TURN), (11.0, STOP), (12.0, "change-left"), (13.0, STOP))
    left = option("change-left", collision=0.4, collided_with=2)
    found = wavered(monkeypatch, *plans, others=(left,))
    assert (found.plan, found.turns) == ("change-left", (AbandonedPlan(13.0, 0.4, 2),))


def test_each_time_reaches_back_twenty_seconds(monkeypatch: pytest.MonkeyPatch) -> None:
    plans = ((29.0, TURN), (30.0, TURN), (31.0, STOP), (40.0, TURN), (41.0, STOP))
    assert len(wavered(monkeypatch, *plans, now=50.0).turns) == 2
    assert len(wavered(monkeypatch, *plans, now=50.1).turns) == 1
    part = wavered(monkeypatch, *plans, now=60.0, time=Between(29.0, 35.0))
    assert [turn.time for turn in part.turns] == [31.0]
    up_to_now = wavered(monkeypatch, *plans, now=50.0, time=Between(39.0, 49.5))
    assert len(up_to_now.turns) == 2
    moment = wavered(monkeypatch, *plans, now=50.0, time=At(41.0))
    assert len(moment.turns) == 2


# --- whom an option would have struck -----------------------------------------------------------

COLLIDES = Which(Wanted(), Happens(Event("collide", object=Wanted())))


def what_if(
    patch: pytest.MonkeyPatch, action: Any = TURN, then: Any = COLLIDES, *,
    struck: Any = (3, 2, 2, None), known: Any = None, **more: Any,
) -> Any:  # fmt: skip
    """What is told of an option of which drives were imagined that struck these vehicles."""
    shares = [0.25] * len(struck)
    trace = decided((TURN, "continue"), *(Drive(p) for p in shares))
    rollouts = tuple(
        replace(r, collided_with=struck[r.samples[0].goal]) for r in trace.rollouts
    )  # fmt: skip
    again = rollouts[:1]  # one of them was drawn twice
    trace = replace(trace, rollouts=(*rollouts, *again))
    options = (option("continue"), option(TURN, collided_with=known), option("exit-straight"))
    patch.setattr(risks, "of_trace", lambda ride, found: options if found is trace else ())
    patch.setattr(risks, "situations", lambda found: Evidence(rollouts=7))
    patch.setattr(supposing, "what_if", lambda question, asked: Told("supposed"))
    given = {"traces": (trace,)} | more
    event = Event(action, tense="present")
    return risks.what_if(WhatIf(Happens(event), then), Given(**given).asked())


def test_whom_an_option_would_have_struck_is_counted_in_its_drives(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    found = what_if(monkeypatch)
    wanted = option(TURN, collided_with=2)
    assert found == Options((wanted,), NOW, Evidence(rollouts=7), risk=True, hits=3, drives=4)
    assert what_if(monkeypatch, known=3).options[0].collided_with == 3
    none = what_if(monkeypatch, struck=(None,))
    assert (none.options[0].collided_with, none.hits, none.drives) == (None, 0, 1)
    straight = what_if(monkeypatch, "continue")
    assert (straight.options[0].action, straight.hits, straight.drives) == ("continue", 0, 0)
    assert what_if(monkeypatch, "exit-straight").options[0].action == "continue"


def test_whom_we_may_hit_is_asked_of_the_plan_then_of_the_riskiest_option(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    trace = decided((TURN, "continue"), *(Drive(0.5) for _ in range(2)))
    struck = tuple(replace(r, collided_with=2) for r in trace.rollouts)
    rows = [option(TURN, chosen=True), option("continue", collision=0.3, collided_with=4)]
    monkeypatch.setattr(risks, "of_trace", lambda ride, found: rows)
    monkeypatch.setattr(risks, "situations", lambda found: Evidence(rollouts=7))
    monkeypatch.setattr(risks, "closeness", lambda *args, **more: Told("near"))

    def who(**more: Any) -> Any:
        given = Given(traces=(replace(trace, **more),)).asked()
        return risks.who(Which(Wanted(), Is("dangerous", Wanted())), given)

    assert who(rollouts=struck).options[0].action == TURN
    assert who().options[0].collided_with == 4
    rows.pop()
    assert who() == Told("near")


def test_who_would_be_in_our_way_holds_an_option_up_longest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    held = (HeldUp(4, 0.0, 1.0, "leader", 9.0, 8.0), HeldUp(6, 1.0, 9.0, "leader", 9.0, 8.0))
    trace = decided((TURN,), Drive(1.0))
    told = tuple(replace(r, held_up=held, weight=1.0) for r in trace.rollouts)
    monkeypatch.setattr(risks, "of_trace", lambda ride, found: (option(TURN),))
    monkeypatch.setattr(risks, "situations", lambda found: Evidence(rollouts=7))
    monkeypatch.setattr(risks, "first_look", lambda asked, vehicle, at: vehicle)
    given = Given(traces=(replace(trace, rollouts=told),)).asked()
    block = Which(Wanted(), Happens(Event("block", Wanted(), Ego(), modal="would")))
    found: Any = risks.what_if(WhatIf(Happens(Event(TURN, tense="present")), block), given)
    assert (found.looks, found.none) == ((6,), False)
    free: Any = Given(traces=(trace,)).asked()
    found = risks.what_if(WhatIf(Happens(Event(TURN, tense="present")), block), free)
    assert (found.looks, found.none) == ((), True)


def test_what_is_not_asked_or_not_known_is_supposed_as_ever(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    supposed = Told("supposed")
    assert what_if(monkeypatch, then=Doing()) == supposed
    assert what_if(monkeypatch, then=None) == supposed
    other = Which(Wanted(), Happens(Event("collide", Vehicle(1))))
    assert what_if(monkeypatch, then=other) == supposed
    assert what_if(monkeypatch, "change-left") == supposed
    assert what_if(monkeypatch, traces=()) == supposed
    asked = Given().asked()
    theirs = WhatIf(Happens(Event(TURN, Vehicle(1))), COLLIDES)
    for question in (theirs, WhatIf(Not(Exists(Vehicle(1))), COLLIDES)):
        answer: Any = risks.what_if(question, asked)
        assert answer == supposed
