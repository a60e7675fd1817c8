"""Which explainer is asked, and for what, where it is asked why something is so."""

from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, Told, deed, look, plan, refused, stand_in
from xavi_dialogue.domain.answers import (
    ChoiceReason,
    Contrast,
    Evidence,
    NoSuchVehicle,
    NotRecorded,
    Priority,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import (
    Believed,
    Both,
    Caused,
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Lane,
    Measured,
    Not,
    Related,
    That,
    Vehicle,
)
from xavi_dialogue.explain.answers.propositions import reasons
from xavi_dialogue.explain.answers.reasons import choices, others, refraining
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.ride import onward

ONE, TWO = Vehicle(1), Vehicle(2)
RULES = {"rule": "give-way"}


def raising(result: Any) -> Any:
    def explain(*args: Any, **more: Any) -> Any:
        raise Unanswered(result)

    return explain


@pytest.fixture(autouse=True)
def explainers(monkeypatch: pytest.MonkeyPatch) -> None:
    stand_in(
        monkeypatch,
        *(f"choices.{name}" for name in ("why", "why_not", "in_lane", "straight", "needed")),
        *(f"motions.{name}" for name in ("slow", "fast", "motion", "standing_or_slow")),
        *(f"others.{name}" for name in ("why", "believed", "slowly")),
        *(f"standings.{name}" for name in ("related", "fact", "signalling")),
        *("going.went", "deciding.how_avoid", "signalling.why_signal", "refraining.refrained"),
        "reasons.priority_at",
    )
    monkeypatch.setattr(refraining, "not_passed", lambda event, scene: None)
    monkeypatch.setattr(onward, "stays_on", lambda scene, event: None)


def told(question: Why, span: Span | None = None, **more: Any) -> Any:
    given = {"looks": {1: look(1), 2: look(2)}, "traces": (plan(NOW),)} | more
    return reasons.why(question, Given(**given).asked(span))


def asks(of: Any, span: Span | None = None, **more: Any) -> str:
    """Who is asked why something is so."""
    found = told(Why(of), span, **more)
    return str(found.by)


def did(action: Any, actor: Any = None, **more: Any) -> Happens:
    return Happens(Event(action, actor or Ego(), **more))


@pytest.mark.parametrize(
    ("of", "by"),
    [
        (did("go", ONE, manner=("first",)), "reasons.priority_at"),
        (did("go", ONE), "others.why"),
        (did("brake", ONE, manner=("first",)), "others.why"),
        (did("go", manner=("first",)), "going.went"),
        (Not(did("go", ONE, manner=("first",))), "others.why"),
        (Related("has-priority-over", ONE), "reasons.priority_at"),
        (Related("has-priority-over", Ego(), ONE), "standings.related"),
        (Related("behind", ONE), "standings.related"),
        (did("brake", ONE), "others.why"),
        (did("brake"), "motions.motion"),
        (Compares(Measured("speed"), "less", Measured("limit")), "motions.slow"),
        (Compares(Measured("speed"), "more", Measured("speed", ONE)), "motions.fast"),
        (Compares(Measured("speed"), "less", Measured("speed", ONE)), "motions.slow"),
        (Compares(Measured("speed", ONE), "less", Measured("speed")), "others.slowly"),
        (Compares(Measured("speed", ONE), "more", Measured("speed")), "motions.slow"),
        (Compares(Measured("delay"), "more"), "motions.motion"),
        (Compares(Measured("duration"), "more"), "motions.motion"),
        (Compares(Measured("waiting-time"), "more"), "motions.motion"),
        (Compares(Measured("duration", ONE), "more"), "choices.why"),
        (Compares(Measured("gap", to=ONE), "more"), "motions.slow"),
        (Compares(Measured("headway", to=ONE), "more"), "motions.slow"),
        (Compares(Measured("distance", to=ONE), "more"), "motions.slow"),
        (Compares(Measured("cost"), "more"), "choices.why"),
        (Has("lane", "left"), "choices.in_lane"),
        (Has("lane", "left", ONE), "choices.why"),
        (Has("indicator", "left", ONE), "standings.signalling"),
        (Has("brake-lights", "on"), "standings.signalling"),
        (Believed(did("stop", ONE)), "others.believed"),
        (Exists(ONE), "standings.fact"),
        (That(), "choices.why"),
        (Both(()), "choices.why"),
    ],
)
def test_each_kind_of_fact_has_its_explainer(of: Any, by: str) -> None:
    assert asks(of) == by


def test_what_explainers_are_asked_for() -> None:
    first = told(Why(did("go", ONE, manner=("first",))))
    assert first.args[1:] == (1, Window(NOW, NOW))
    past = told(Why(Related("has-priority-over", TWO)), Span(3.0, 5.0, said=True))
    assert past.args[1:] == (2, Window(3.0, 5.0))
    early = told(Why(did("go", ONE, manner=("first",))), Span(3.0, 5.0, said=True))
    assert early.args[1:] == (1, Window(3.0, 5.0))
    other = told(Why(Not(did("turn", ONE, tense="present"))))
    assert (other.events, other.more) == (
        (Event("turn", ONE, tense="present"),), {"negated": True},
    )  # fmt: skip
    plain = told(Why(did("brake", ONE)))
    assert plain.more == {"negated": False}
    waits = told(Why(Compares(Measured("delay", tense="past"), "more")))
    assert waits.events == (Event("wait", tense="past"),)
    assert told(Why(Compares(Measured("gap", to=ONE), "more"))).args[1] == "close"
    assert told(Why(Believed(did("stop", ONE)))).args[0] == did("stop", ONE)


@pytest.mark.parametrize(
    ("rule", "action", "told_by_rule"),
    [
        ("give-way", "stop", True),
        ("give-way", "let-go", True),
        ("priority", "stop", False),
        ("give-way", "turn", False),
    ],
)
def test_who_goes_first_need_not_stop(
    rule: Any, action: Any, told_by_rule: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[Any] = []

    def read(scene: Any, vehicle: int, about: Window) -> Priority:
        seen.append((vehicle, about))
        return Priority(NOW, rule, vehicle)

    monkeypatch.setattr(reasons, "priority_at", read)
    found = told(Why(Not(did(action, ONE, tense="present"))))
    assert (found == Priority(NOW, rule, 1)) is told_by_rule
    assert seen == ([] if action == "turn" else [(1, Window(NOW, NOW))])
    told(Why(Not(did("stop", ONE))), Span(3.0, 5.0, said=True))
    assert seen[-1] == (1, Window(3.0, 5.0))
    monkeypatch.setattr(reasons, "priority_at", raising(NotRecorded("not-recorded")))
    assert asks(Not(did("stop", ONE))) == "others.why"
    assert asks(Not(did("stop"))) == "refraining.refrained"


# --- states -------------------------------------------------------------------------------------

ASKED = Event("stop", tense="present")
DONE = Event("stop", tense="past")


@pytest.mark.parametrize(
    ("of", "by", "args"),
    [
        (Is("necessary", event=ASKED), "choices.needed", (ASKED,)),
        (Is("worth-it", event=DONE), "choices.needed", (DONE,)),
        (Is("better", event=ASKED), "choices.needed", (ASKED,)),
        (Is("right", event=ASKED), "choices.needed", (ASKED,)),
        (Is("safe", event=DONE), "motions.motion", (DONE,)),
        (Not(Is("moving")), "motions.standing_or_slow", (Event("move", tense="present"),)),
        (Not(Is("fast")), "motions.standing_or_slow", (Event("move", tense="present"),)),
        (Is("moving"), "standings.fact", (Is("moving"),)),
        (Is("stationary", ONE), "others.why", (Event("stand", ONE, tense="present"),)),
        (Is("stuck", ONE), "others.why", (Event("stand", ONE, tense="present"),)),
        (Not(Is("moving", ONE)), "others.why", (Event("stand", ONE, tense="present"),)),
        (Is("moving", ONE), "others.why", (Event("slow-down", ONE, tense="present"),)),
        (Is("fast", ONE), "others.why", (Event("slow-down", ONE, tense="present"),)),
        (Is("late", ONE), "others.why", (Event("slow-down", ONE, tense="present"),)),
        (Is("safe", ONE), "standings.fact", (Is("safe", ONE),)),
        (Is("slow"), "motions.standing_or_slow", (Event("move", tense="present"),)),
        (Is("stuck"), "motions.standing_or_slow", (Event("move", tense="present"),)),
        (Is("late", tense="past"), "motions.standing_or_slow", (Event("move", tense="past"),)),
        (Is("slow", Lane("left")), "standings.fact", (Is("slow", Lane("left")),)),
        (Is("fast"), "motions.fast", ()),
        (Is("fast", Lane("left")), "standings.fact", (Is("fast", Lane("left")),)),
        (Is("close", ONE), "motions.slow", ("close",)),
        (Is("far", ONE), "motions.slow", ("far",)),
        (Is("busy"), "standings.fact", (Is("busy"),)),
    ],
)
def test_each_state_has_its_explainer(of: Any, by: str, args: Any) -> None:
    found = told(Why(of))
    asked = tuple(one for one in found.args if not hasattr(one, "world"))
    assert (found.by, asked) == (by, args)
    if by == "others.why":
        assert found.more == {"negated": False}


@pytest.mark.parametrize(
    ("slows", "span", "by"),
    [
        (False, None, "others.slowly"),
        (True, None, "others.why"),
        (False, Span(3.0, 5.0, said=True), "others.why"),
    ],
)
def test_who_drives_slowly_without_slowing_down_is_asked_why_it_is_slow(
    slows: bool, span: Any, by: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(others, "slows", lambda scene, vehicle: slows and vehicle == 1)
    assert asks(Is("slow", ONE), span) == by


@pytest.mark.parametrize(("tense", "slowing"), [("present", True), ("past", False)])
def test_slowness_of_now_is_slowing_down_while_we_do(tense: Any, slowing: bool) -> None:
    braking = (deed("slow-down", 18.0),)
    found = told(Why(Is("slow", tense=tense)), deeds=braking)
    wanted = Event("slow-down", tense="present") if slowing else Event("move", tense=tense)
    assert found.by == ("motions.motion" if slowing else "motions.standing_or_slow")
    assert found.events == (wanted,)


# --- who is suspected ---------------------------------------------------------------------------

NOTHING = Contrast((), (), None, (), (), Evidence(), NOW)


def test_who_is_taken_for_the_cause_is_told_of(monkeypatch: pytest.MonkeyPatch) -> None:
    reason = ChoiceReason("why", None, NOTHING)
    monkeypatch.setattr(choices, "why", lambda *args: reason)
    change = did("change-left")
    assert told(Why(change)) == reason
    blamed = told(Why(change, suspect=ONE))
    assert (blamed.of_causes, blamed.suspect, blamed.suspected) == (True, 1, "none")
    of_two = told(Why(change, suspect=ONE, rival=TWO))
    assert of_two.suspected == "neither"
    caused = told(Why(Caused(TWO, change)))
    assert (caused.of_causes, caused.suspect) == (True, 2)
    both = told(Why(Caused(TWO, change), suspect=ONE))
    assert both.suspect == 1
    of_what = told(Why(Caused(TWO)))
    assert (of_what.of_causes, of_what.suspect) == (True, 2)
    motion = told(Why(Caused(TWO, Not(did("brake")))))
    assert isinstance(motion, Told)
    assert motion.by == "refraining.refrained"
    for question in (Why(change, suspect=Vehicle(7)), Why(Caused(Vehicle(7), change))):
        found = refused(told, question)
        assert isinstance(found, NoSuchVehicle)
        assert found.thing == Vehicle(7)
    assert refused(told, Why(change, suspect=ONE, rival=Vehicle(7))).thing == Vehicle(7)
