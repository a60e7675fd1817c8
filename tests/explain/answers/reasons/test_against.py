"""What was decided beside what is asked about: at which decision, and whether we did it."""

from typing import Any

import pytest

from tests.explain.answers.chosen import EVENTS, LEFT, RIGHT, STAY, STOP, TURN, chosen, deeds
from tests.explain.answers.stated import decision, result
from tests.traces import End
from xavi_dialogue.domain.answers import CannotSay, ChoiceReason, DidNotHappen, NotApplicable
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.reasons import Performed
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.explain.answers.reasons import against as module
from xavi_dialogue.explain.answers.reasons.against import Against, against
from xavi_dialogue.explain.answers.reasons.choices import why_not
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.reference.foils import Did
from xavi_dialogue.explain.answers.suppositions.own_suppositions import of_us

AHEAD: Any = ("continue", "exit-right", "continue")
LATE = End(time=30.0)
#: We are to turn right at the next junction; from 6 s on we are in front of it.
COMING = [
    decision(2.0, AHEAD, ends={STOP: LATE, ("continue", "exit-left"): LATE}),
    decision(6.0, ("exit-right",), ends={STOP: LATE, STAY: End(time=25.0),
                                         ("exit-left",): LATE}),
]  # fmt: skip
DRIVING = deeds(("continue", 0.0, 0.0, None))
TURNED = deeds(("continue", 0.0, 0.0, 6.0), ("exit-right", 6.0, 8.0, 10.0),
               ("continue", 10.0, 10.0, None))  # fmt: skip


def tried(event: Event, span: Any = None, **facts: Any) -> Any:
    return against(event, chosen(span, **facts))


def did(event: Event, span: Any = None, **facts: Any) -> Performed:
    with pytest.raises(Did) as found:
        tried(event, span, **facts)
    return found.value.performed


def decided(event: Event, **facts: Any) -> tuple[float, Any]:
    found = tried(event, **facts)
    assert isinstance(found, Against)
    return found.contrast.decided, found.foil


# --- which decision -----------------------------------------------------------------------------


@pytest.mark.parametrize("tense", ["past", "perfect", "present", "future"])
def test_another_way_is_asked_of_the_turn_that_is_planned(tense: Any) -> None:
    facts: dict[str, Any] = {"events": DRIVING, "traces": COMING}
    straight = Event("exit-straight", tense=tense)
    assert decided(straight, **facts) == (6.0, ("continue",))
    left = Event("exit-left", tense=tense)
    found = tried(left, traces=COMING[:1], events=DRIVING, now=3.0)
    assert (found.contrast.decided, found.found.node) == (2.0, ("continue",))
    assert found.contrast.foil == ("continue", "exit-left")


def test_another_way_is_asked_of_the_turn_that_was_made() -> None:
    later = decision(12.0, STAY, ends={STOP: LATE})
    facts: dict[str, Any] = {"traces": [*COMING, later], "events": TURNED}
    for tense in ("past", "perfect"):
        assert decided(Event("exit-straight", tense=tense), **facts) == (6.0, ("continue",))  # type: ignore[arg-type]
    assert did(Event("exit-straight", tense="present"), **facts).when == "doing"


@pytest.mark.parametrize(
    ("event", "span"),
    [
        (Event("exit-straight", tense="perfect"), None),
        (Event("exit-left"), None),
        (Event("stop", tense="present"), None),
        (Event("stop"), Span(2.0, 3.0, said=True)),
    ],
)
def test_why_not_and_what_if_are_of_one_decision(event: Event, span: Any) -> None:
    facts: dict[str, Any] = {"events": DRIVING, "traces": COMING}
    reason = result(why_not, event, chosen(span, **facts))
    supposed = result(of_us, event, chosen(span, **facts))
    assert isinstance(reason, ChoiceReason)
    assert reason.contrast == supposed.contrast
    assert (reason.past, reason.later) == (supposed.past, supposed.later)


# --- what was done ------------------------------------------------------------------------------


def test_what_was_done_is_done_or_planned_in_its_tense() -> None:
    left = Event("change-left", tense="perfect")
    assert did(left) == Performed("change-left", "did", 6.5)
    assert did(left, events=EVENTS[:4]) == Performed("change-left", "doing", 6.5)
    now = Event("change-left", tense="present")
    assert did(now, events=EVENTS[:4]) == Performed("change-left", "doing", 6.5)
    facts: dict[str, Any] = {"events": DRIVING, "traces": COMING}
    for tense in ("past", "perfect", "present", "future"):
        coming = did(Event("exit-right", tense=tense), **facts)  # type: ignore[arg-type]
        assert coming == Performed("exit-right", "will")


def test_the_same_is_refused_where_it_is_asked_why_not() -> None:
    planned = result(why_not, Event("exit-right"), chosen(events=DRIVING, traces=COMING))
    assert planned == DidNotHappen(Event("exit-right"), planned=6.0)
    done = result(why_not, Event("change-left"), chosen())
    assert [(e.action, e.begin) for e in done.instead] == [("change-left", 6.5)]


def test_what_was_given_up_is_compared_where_it_was_given_up() -> None:
    traces = [decision(2.0, LEFT, ends={STAY: End(time=9.0)}),
              decision(4.0, STAY, ends={LEFT: End(time=14.0)}),
              decision(8.0, STAY, ends={LEFT: End(time=13.0)})]  # fmt: skip
    facts: dict[str, Any] = {"events": DRIVING, "traces": traces}
    said = Span(2.0, 2.5, said=True)
    assert tried(Event("change-left"), said, **facts).contrast.decided == 4.0


def test_what_was_compared_and_done_later_is_told_so() -> None:
    early = Span(2.0, 3.0, said=True)
    found = tried(Event("change-left"), early)
    assert (found.contrast.decided, found.later) == (2.0, Performed("change-left", "did", 6.5))
    assert tried(Event("change-right"), Span(12.5, 14.0, said=True)).later is None
    soon = [decision(2.0, ("continue", "change-right"), ends={RIGHT: End(time=9.0), STOP: LATE})]
    now = Event("change-right", tense="present")
    found = tried(now, events=DRIVING, traces=soon, now=3.0)
    assert found.later == Performed("change-right", "will")


# --- sooner and later ---------------------------------------------------------------------------


def test_doing_sooner_what_was_done_is_compared_before() -> None:
    sooner = Event("change-left", tense="perfect", manner=("early",))
    found = tried(sooner)
    assert (found.contrast.decided, found.earlier) == (2.0, True)
    assert found.later == Performed("change-left", "did", 6.5)
    later = Event("change-left", tense="perfect", manner=("late",))
    assert result(against, later, chosen()) == CannotSay("unsupported-condition")


def refuse_at(time: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Make it too late for any foil at the decision of a time [s]."""
    compared = module.contrast

    def refusing(ride: Any, trace: Any, foil: Any, node: Any = ()) -> Any:
        if trace.sim_time == time:
            raise Unanswered(NotApplicable(foil, "it is too late"))
        return compared(ride, trace, foil, node)

    monkeypatch.setattr(module, "contrast", refusing)


def test_what_comes_too_late_is_compared_where_it_was_open_last(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ends: Any = {TURN: End(time=12.0), STOP: LATE}
    shut = decision(12.0, STAY, ends={STOP: LATE})
    open_ = [decision(t, STAY, ends=ends) for t in (2.0, 6.0, 8.0)]
    busy = decision(9.0, STAY, ends=ends, under_way="continue")
    facts: dict[str, Any] = {"events": DRIVING, "traces": [*open_, busy, shut]}
    turn = Event("exit-right", tense="present")
    refuse_at(12.0, monkeypatch)
    found = tried(turn, **facts)
    assert (found.contrast.decided, found.earlier) == (8.0, True)
    facts["traces"] = [open_[0], shut]  # 10 s before
    assert result(against, turn, chosen(**facts)) == NotApplicable(TURN, "it is too late")


def test_why_not_now_is_not_answered_by_a_decision_before(monkeypatch: pytest.MonkeyPatch) -> None:
    ends: Any = {TURN: End(time=12.0), STOP: LATE}
    shut = decision(12.0, STAY, ends={STOP: LATE})
    facts: dict[str, Any] = {"events": DRIVING, "traces": [decision(8.0, STAY, ends=ends), shut]}
    turn = Event("exit-right", tense="present")
    refuse_at(12.0, monkeypatch)
    assert against(turn, chosen(**facts)).contrast.decided == 8.0
    found = result(lambda event, scene: against(event, scene, before=False), turn, chosen(**facts))
    assert found == NotApplicable(TURN, "it is too late")
