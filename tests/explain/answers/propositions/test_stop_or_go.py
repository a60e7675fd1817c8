"""Whether we stop or go where both are asked about, and for whom a vehicle waited; at 20 s."""

from typing import Any

import pytest

from tests.explain.answers.stated import did, look, result, scene, they
from xavi_dialogue.domain.answers import PlanAhead, Verdict
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Doing, HowMuch, Whether, Why
from xavi_dialogue.domain.terms import (
    At,
    Both,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Next,
    Now,
    Related,
    Vehicle,
)
from xavi_dialogue.explain.answers.propositions import halting, reasons
from xavi_dialogue.explain.answers.reasons import others
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.suppositions import freed
from xavi_dialogue.explain.causes.vehicles.course import Expected

LATER = Expected(0.8, 24.0, 22.0, 26.0)
PLAN = PlanAhead((("continue", 20.0),))
IT = Vehicle(1)


class Plan:
    """What is foreseen of us, by action; what is asked after is kept."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.foreseen: dict[str, Expected] = {}
        self.steps: tuple[tuple[str, float], ...] = ()
        self.asked: list[Event] = []
        monkeypatch.setattr(halting, "foreseen", self._foreseen)
        monkeypatch.setattr(halting, "steps", lambda _: self.steps)
        monkeypatch.setattr(halting, "plan_ahead", lambda _: PLAN)
        monkeypatch.setattr(reasons, "why", lambda question, _: question)

    def _foreseen(self, _: Any, event: Event) -> Expected | None:
        self.asked.append(event)
        return self.foreseen.get(event.action)


@pytest.fixture
def plan(monkeypatch: pytest.MonkeyPatch) -> Plan:
    return Plan(monkeypatch)


def comes(action: Any, **more: Any) -> Event:
    return Event(action, **({"tense": "future"} | more))


def either(*events: Event) -> Both:
    return Both(tuple(map(Happens, events)), "or")


def told(of: Both, **more: Any) -> Any:
    looks = {1: look(1), 2: look(2)}
    found = halting.stop_or_go(of, scene(more.pop("span", None), looks=looks, **more))
    assert found is None or found.holds is None
    return None if found is None else found.answer


def ahead(action: Any, found: Expected = LATER, share: float = 0.8, **more: Any) -> Verdict:
    time = Measure("time", Ego(), 20.0, value=found.moment, low=found.low, high=found.high)
    return Verdict(
        Happens(Event(action, tense="future", **more)), True, (time,), probability=share,
        either=True,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("found", "verdict"),
    [
        (LATER, ahead("stop")),
        (Expected(0.5, 24.0, 22.0, 26.0), ahead("stop", share=0.5)),
        (Expected(0.4, 24.0, 22.0, 26.0), None),
        (None, None),
        (Expected(0.8, 19.0, 18.0, 19.5), ahead("stop", Expected(0.8, 20.0, 20.0, 20.0))),
        (Expected(0.8, 23.0, 18.0, 26.0), ahead("stop", Expected(0.8, 23.0, 20.0, 26.0))),
    ],
)
def test_what_we_do_by_our_plan_lies_ahead(plan: Plan, found: Any, verdict: Any) -> None:
    if found is not None:
        plan.foreseen["stop"] = found
    event = Event("stop", tense="present", modal="must", time=At(25.0), manner=("hard",))
    assert halting.to_come(scene(), event) == verdict
    assert plan.asked == [event]


def test_we_stop_where_we_do_soon(plan: Plan) -> None:
    plan.foreseen |= {"stop": LATER, "brake": LATER, "go": LATER}
    assert told(either(comes("wait", object=IT), comes("go"))) == ahead("stop")
    assert told(either(comes("brake"), comes("wait"))) == ahead("stop")


def test_else_we_slow_down_or_go(plan: Plan) -> None:
    plan.foreseen |= {"slow-down": LATER, "go": LATER}
    three = (comes("stop"), comes("go"), comes("slow-down"))
    assert told(either(*three)) == ahead("slow-down")
    assert told(either(*three[:2])) == ahead("go")
    plan.foreseen["turn"] = LATER
    assert told(either(comes("stop"), comes("turn"), comes("go"))) == ahead("turn")
    del plan.foreseen["slow-down"]
    assert told(either(*three)) == ahead("go")
    del plan.foreseen["go"]
    assert told(either(*three)) is None


def test_what_we_are_about_is_told_as_such(plan: Plan) -> None:
    plan.foreseen["turn"] = LATER
    turns = did("exit-right", 18.0, side="right")
    found = told(either(comes("stop"), comes("turn")), episodes=(turns,))
    that = Happens(Event("turn", tense="present"))
    assert found == Verdict(that, True, (turns,), either=True)


@pytest.mark.parametrize(
    ("events", "held", "why"),
    [
        (("stop", "stop"), None, "stop"),
        (("brake", "brake"), None, "brake"),
        (("stop", "go"), did("wait", 12.0), "wait"),
        (("stop", "go"), did("brake", 12.0), None),
        (("stop", "go"), did("brake", 12.0, 19.8), None),
        (("brake", "go"), did("brake", 12.0), None),
        (("go", "go"), did("brake", 12.0), None),
    ],
)
def test_who_halts_is_told_why(plan: Plan, events: Any, held: Any, why: str | None) -> None:
    parts = tuple(comes(a, object=Vehicle(k + 1)) for k, a in enumerate(events))
    found = told(either(*parts), episodes=() if held is None else (held,))
    if why is None:
        assert not isinstance(found, Why)
    else:
        assert found == Why(Happens(Event(why, tense="present")))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "of",
    [
        Both((Happens(comes("stop")), Is("fast", Ego())), "or"),
        either(comes("stop"), comes("go", actor=IT)),
        either(comes("stop"), comes("go", tense="past")),
        either(comes("stop"), comes("go"), comes("overtake")),
        either(comes("stop"), comes("go", time=At(5.0))),
    ],
)
def test_of_others_and_of_the_past_it_is_another_question(plan: Plan, of: Both) -> None:
    plan.foreseen["stop"] = LATER
    assert told(of) is None


def test_a_time_that_was_said_is_another_question(plan: Plan) -> None:
    plan.foreseen["stop"] = LATER
    of = either(comes("stop", time=Now()), comes("go", tense="present", time=Next()))
    assert told(of) == ahead("stop")
    assert told(of, span=Span(4.0, 6.0)) == ahead("stop")
    assert told(of, span=Span(4.0, 6.0, said=True)) is None


NEAR = Related("ahead-of", Ego(), IT)


@pytest.mark.parametrize(
    ("events", "answer"),
    [
        ((comes("pull-out", where=NEAR), comes("merge")), ahead("change-left")),
        ((comes("enter", object=IT), comes("merge")), ahead("change-left")),
        ((comes("enter"), comes("merge")), None),
        ((comes("enter", object=IT), comes("brake")), None),
    ],
)
def test_before_or_behind_whom_we_move_in_is_when(plan: Plan, events: Any, answer: Any) -> None:
    plan.foreseen |= {"continue": LATER, "change-left": LATER}
    plan.steps = (("continue", 20.0), ("change-left", 24.0))
    assert told(either(*events)) == answer


def test_where_we_do_not_move_the_plan_is_told(plan: Plan) -> None:
    plan.foreseen["continue"] = LATER
    plan.steps = (("continue", 20.0), ("change-left", 24.0))
    assert told(either(comes("pull-out", where=NEAR), comes("merge"))) == PLAN


# What would be without a vehicle ----------------------------------------------------------------


def waits(action: Any, actor: Any = IT) -> Whether:
    return Whether(Happens(Event(action, actor, tense="present")))


@pytest.mark.parametrize(
    ("then", "without", "episode", "tense"),
    [
        (waits("wait"), 2, they(1, "give-way", 5.0, object=Vehicle(2)), "present"),
        (waits("brake"), 2, they(1, "give-way", 5.0, 9.0, object=Vehicle(2)), "past"),
        (waits("wait"), 3, they(1, "give-way", 5.0, object=Vehicle(2)), None),
        (waits("wait", Vehicle(2)), 2, they(1, "give-way", 5.0, object=Vehicle(2)), None),
        (waits("go"), 2, they(1, "give-way", 5.0, object=Vehicle(2)), None),
        (waits("wait"), None, they(1, "give-way", 5.0, object=Vehicle(2)), None),
        (Doing(IT), 2, they(1, "give-way", 5.0, object=Vehicle(2)), None),
        (Whether(Is("stationary", IT)), 2, they(1, "give-way", 5.0, object=Vehicle(2)), None),
    ],
)
def test_who_waits_for_the_one_supposed_away_is_told_why(
    monkeypatch: pytest.MonkeyPatch, then: Any, without: Any, episode: Any, tense: Any
) -> None:
    monkeypatch.setattr(others, "why", lambda event, _, negated: (event, negated))
    asked = scene(looks={1: look(1), 2: look(2)}, episodes=(episode,))
    expected = None if tense is None else (Event("give-way", IT, tense=tense), False)
    assert result(freed.freed, then, without, asked) == expected


def test_the_last_wait_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(others, "why", lambda event, _, negated: event.tense)
    both = (they(1, "wait", 3.0, 5.0, object=Vehicle(2)), they(1, "wait", 9.0, object=Vehicle(2)))
    asked = scene(looks={1: look(1), 2: look(2)}, episodes=both)
    assert result(freed.freed, waits("wait"), 2, asked) == "present"


@pytest.mark.parametrize(
    ("event", "pace"),
    [
        (Event("go", modal="could"), True),
        (Event("move", modal="could"), True),
        (Event("go", modal="would"), False),
        (Event("stop", modal="could"), False),
        (None, False),
    ],
)
def test_how_much_faster_we_could_go_is_of_our_pace(event: Any, pace: bool) -> None:
    assert freed.asks_pace(HowMuch(Measured("speed", event=event))) is pace
    assert not freed.asks_pace(waits("go", Ego()))
    assert not freed.asks_pace(None)


def test_a_finding_is_of_no_yes_or_no(plan: Plan) -> None:
    plan.foreseen["stop"] = LATER
    found = halting.stop_or_go(either(comes("stop"), comes("go")), scene())
    assert found == Finding(None, answer=ahead("stop"))
