"""Which option was better, whether it was needed, and what would change it."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.chosen import LEFT, STAY, STOP, TRACES, chosen
from tests.explain.answers.stated import aim, decision, did, look, result
from tests.traces import End
from xavi_dialogue.domain.answers import (
    Cause,
    ChoiceReason,
    Compared,
    Contrast,
    DecisiveFactor,
    DidNotHappen,
    Evidence,
    Measures,
    MotionCause,
    MotionReason,
    NeedRollout,
    Options,
    SupposedOfUs,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import Compare, HowDecide, Listing, WhatWouldChange, Whether
from xavi_dialogue.domain.terms import At, Event, Happens, Is, Not, Vehicle
from xavi_dialogue.explain.answers.reasons import choices
from xavi_dialogue.explain.answers.reasons import motions as driving
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.suppositions.deciding import (
    compared,
    listed,
    needed,
    what_would_change,
)
from xavi_dialogue.explain.answers.suppositions.listing import how_decide

KEEP, CHANGE = Event("keep-lane", tense="present"), Event("change-left", tense="present")


def told(explainer: Any, question: Any, span: Any = None, **facts: Any) -> Any:
    return result(explainer, question, chosen(span, **facts))


# --- comparing ----------------------------------------------------------------------------------


def held(by: Any, end: Any, *events: Event, fact: Any = None, **facts: Any) -> Any:
    """Keeping the lane, as decided, against a change of lanes that ends otherwise."""
    ends = {LEFT: end, STOP: End(time=30.0)} | ({} if fact is None else {STAY: fact})
    traces = [decision(12.0, STAY, ends=ends, **facts)]
    given: dict[str, Any] = {"traces": traces, "events": (), "again": False}
    options = tuple(Happens(event) for event in events or (KEEP, CHANGE))
    return told(compared, Compare(options, by), **given)


@pytest.mark.parametrize(
    ("by", "end", "better"),
    [
        ("time", End(time=10.3), "first"),
        ("time", End(time=10.2), "same"),
        ("time", End(time=9.8), "same"),
        ("time", End(time=9.7), "second"),
        ("speed", End(time=9.7), "second"),
        ("time", End("dead"), "first"),
        ("best", End(time=12.0), "first"),
        ("best", End(time=8.0), "second"),
        ("best", End(time=10.2), "same"),
        ("comfort", End(time=12.0, jerk=0.4), "second"),
        ("comfort", End(time=8.0, jerk=0.6), "first"),
        ("comfort", End(time=8.0, jerk=0.4, angular=0.2), "first"),
        ("comfort", End("dead"), "unknown"),
    ],
)
def test_which_of_two_is_better(by: Any, end: End, better: str) -> None:
    found = held(by, end)
    assert isinstance(found, Compared)
    assert (found.by, found.first, found.second, found.better) == (
        by, Happens(KEEP), Happens(CHANGE), better,
    )  # fmt: skip
    swapped = held(by, end, CHANGE, KEEP)
    other = {"first": "second", "second": "first"}
    assert (swapped.first, swapped.better) == (Happens(CHANGE), other.get(better, better))


def crash(share: float) -> Any:
    return lambda chosen: (
        End("collision", collided_with=1) if chosen[1][0] == "exit-left" else End(time=10.0)
    )


@pytest.mark.parametrize(("risk", "better"), [(0.3, "first"), (0.011, "first"), (0.0, "same")])
def test_the_safer_one_has_the_lower_risk(risk: float, better: str) -> None:
    aims = {1: (aim("exit-left", risk), aim("continue", 1.0 - risk))}
    assert held("safety", crash(risk), aims=aims).better == better
    if risk == 0.3:
        assert held("safety", End(), fact=crash(risk), aims=aims).better == "second"


def test_one_option_alone_is_supposed_or_held_against_what_was_decided() -> None:
    for by, form in (("time", "quicker"), ("speed", "quicker"), ("best", "better"),
                     ("safety", "safer")):  # fmt: skip
        found = held(by, End(time=12.0), CHANGE)
        assert isinstance(found, SupposedOfUs)
        assert (found.form, found.past, found.contrast.foil) == (form, True, ("change-left",))
    later = [decision(12.0, ("continue", "exit-right"), ends={("exit-right",): End("dead")})]
    turn = Compare((Happens(Event("exit-right", tense="present")),), "time")
    assert isinstance(told(compared, turn, traces=later, events=()), SupposedOfUs)
    found = held("comfort", End(time=12.0), CHANGE)
    assert isinstance(found, Compared)
    assert (found.first, found.second) == (Happens(CHANGE), Happens(Event("continue")))


def test_what_is_no_option_of_ours_is_left_out() -> None:
    with_other = Compare((Vehicle(1), Happens(KEEP), Happens(CHANGE)), "time")
    traces = [decision(12.0, STAY, ends={LEFT: End(time=12.0)})]
    assert told(compared, with_other, traces=traces, events=()).better == "first"
    neither = Compare((Vehicle(1), Vehicle(2)), "time")
    assert isinstance(told(compared, neither), Options)


def test_two_that_were_not_done_are_of_the_latest_decision() -> None:
    right = Event("change-right", tense="present")
    question = Compare((Happens(CHANGE), Happens(right)), "time")
    found = told(compared, question, events=())
    assert found.contrast.decided == 12.0
    assert found.contrast.foil == ("change-right",)
    past = Compare((Happens(Event("change-left")), Happens(Event("keep-lane"))), "time")
    found = told(compared, past)
    assert (found.contrast.decided, found.better) == (6.0, "first")


def test_options_are_listed_of_the_decision_that_was_free() -> None:
    found = told(listed, Listing("options"))
    assert [(o.action, o.time, o.chosen) for o in found.options] == [
        ("continue", 10.0, True), ("change-left", 11.0, False), ("change-right", 12.0, False),
        ("stop", 20.0, False),
    ]  # fmt: skip
    assert (found.decided, found.evidence.traces) == (12.0, (TRACES[3].trace_id,))
    during = told(listed, Listing("options"), now=8.0, traces=TRACES[:3])
    assert during.decided == 6.0
    then = told(listed, Listing("options"), Span(2.0, 3.0, said=True))
    assert then.decided == 2.0


@pytest.mark.parametrize(
    ("one", "other", "decided", "pair"),
    [
        (Event("stop"), Event("go"), 12.0, ("continue", "stop")),  # going on is what was chosen
        (Event("keep-lane"), Event("change-left"), 12.0, ("continue", "change-left")),
        (Event("change-left"), Event("stop"), 6.0, ("change-left", "stop")),
        (Event("continue", time=At(2.0)), Event("stop", time=At(2.0)), 2.0, ("continue", "stop")),
    ],
)
def test_how_close_two_options_were_is_of_the_last_decision_between_them(
    one: Event, other: Event, decided: float, pair: tuple[str, str]
) -> None:
    found = told(compared, Compare((Happens(one), Happens(other)), "margin"))
    assert (found.decided, found.named) == (decided, True)
    assert tuple(o.action for o in found.options) == pair


def test_how_it_was_decided_not_to_do_something_is_of_the_decision_against_it() -> None:
    found = told(how_decide, HowDecide(Not(Happens(Event("change-left", time=At(2.0))))), now=5.0)
    assert found.decided == 2.0
    assert {"continue", "change-left"} <= {option.action for option in found.options}


# --- what was needed ----------------------------------------------------------------------------


@pytest.fixture
def motions(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """What is asked about our driving, by event and span; the answers are taken from the front."""
    asked: list[Any] = []
    answers: list[Any] = []

    def motion(event: Any, scene: Any, **_: Any) -> Any:
        asked.append((event, scene.span))
        found = answers.pop(0) if answers else BRAKED
        if isinstance(found, Unanswered):
            raise found
        return found

    monkeypatch.setattr(driving, "motion", motion)
    asked.append(answers)
    return asked


BRAKED = MotionReason(did("brake", 3.0, 5.0), ())


def test_a_choice_is_needed_by_its_best_alternative() -> None:
    for state, form in (("necessary", "necessary"), ("worth-it", "worth-it"),
                        ("better", "worth-it"), ("wrong", "mistaken")):  # fmt: skip
        for that in (Is(state, event=CHANGE), Not(Is(state, event=CHANGE))):  # type: ignore[arg-type]
            found = told(needed, Whether(that))
            assert isinstance(found, ChoiceReason)
            assert (found.form, found.contrast.decided) == (form, 6.0)
    found = told(needed, Whether(Is("necessary")))
    assert found.contrast.decided == 6.0
    found = told(needed, Whether(Happens(Event("change-left"))))
    assert found.form == "necessary"


def test_a_way_of_driving_is_needed_by_its_reason(motions: list[Any]) -> None:
    brake = Event("brake", tense="present")
    found = told(needed, Whether(Is("worth-it", event=brake, tense="past")))
    assert isinstance(found, MotionReason)
    assert (found.form, found.deed) == ("necessary", BRAKED.deed)
    assert motions[1] == (Event("brake"), None)
    told(needed, Whether(Is("necessary", event=brake)))
    assert motions[2] == (brake, None)
    motions[0].append(Measures(()))
    assert told(needed, Whether(Is("necessary", event=brake))) == Measures(())


def test_where_no_time_was_said_it_may_have_been_at_any(motions: list[Any]) -> None:
    question = Whether(Is("necessary", event=Event("brake")))
    missing = Unanswered(DidNotHappen(Event("brake")))
    motions[0][:] = [missing]
    found = told(needed, question, Span(8.0, 9.0))
    assert isinstance(found, MotionReason)
    assert [span for _, span in motions[1:]] == [Span(8.0, 9.0), None]
    motions[0][:] = [missing]
    assert isinstance(told(needed, question, Span(8.0, 9.0, said=True)), DidNotHappen)
    motions[0][:] = [Unanswered(NeedRollout(trace_id="x"))]
    assert isinstance(told(needed, question, Span(8.0, 9.0)), NeedRollout)


# --- what would change it -----------------------------------------------------------------------


def pivoted(of: Any, *, most: bool = False, **facts: Any) -> Any:
    return told(what_would_change, WhatWouldChange(of, most), **facts)


def test_what_would_have_made_the_best_alternative_the_choice() -> None:
    found = pivoted(Happens(Event("change-left")))
    assert (found.kind, found.contrast.decided, found.contrast.foil) == ("none", 6.0, STAY)
    lonely = [decision(6.0, LEFT)]
    assert pivoted(Happens(Event("change-left")), traces=lonely) == DecisiveFactor("none", None)


def test_what_would_have_made_what_was_not_done_the_choice() -> None:
    for of in (Not(Happens(Event("stop"))), Happens(Event("change-right"))):
        found = pivoted(of)
        foil = "stop" if isinstance(of, Not) else "change-right"
        assert found.contrast.foil == (foil,)
    assert pivoted(Not(Happens(Event("stop")))).contrast.decided == 12.0
    #: Had it turned left, the lane change would have been the better choice.
    aims = {1: (aim("exit-left", 0.3), aim("continue", 0.7))}

    def slow(chosen: Any) -> Any:
        return End(time=5.0 if chosen[1][0] == "exit-left" else 30.0)

    traces = [decision(12.0, STAY, aims=aims, ends={LEFT: slow})]
    found = pivoted(Not(Happens(CHANGE)), traces=traces, events=(), looks={1: look(1)})
    assert (found.kind, found.vehicle, found.actions) == ("conduct", 1, ("exit-left",))
    assert found.probability == pytest.approx(0.3)


def motive(*causes: MotionCause) -> MotionReason:
    return MotionReason(did("brake", 3.0, 5.0), causes)


LEADER = MotionCause("leader", 1, ("continue",), 0.7)


def test_a_way_of_driving_hangs_on_whom_it_was_for(motions: list[Any]) -> None:
    brake = Happens(Event("brake"))
    for most, kind in ((False, "removal"), (True, "factor")):
        expected = DecisiveFactor(kind, None, 1, ("continue",), 0.7, most, "brake")  # type: ignore[arg-type]
        for causes in ((LEADER,), (replace(LEADER, necessary=True), MotionCause("limit"))):
            motions[0][:] = [motive(*causes)]
            assert pivoted(brake, most=most) == expected
    for found in (
        motive(MotionCause("limit")),
        motive(MotionCause("light"), LEADER),
        motive(LEADER, MotionCause("limit")),
        motive(MotionCause("leader", 1, necessary=False)),
        Measures(()),
    ):
        motions[0][:] = [found]
        assert pivoted(brake) == found
    assert not isinstance(pivoted(Not(brake)), MotionReason)


def test_a_way_of_driving_that_came_of_a_choice_hangs_on_what_the_choice_did(
    motions: list[Any],
) -> None:
    motions[0][:] = [of_choice()]
    assert pivoted(Happens(Event("brake"))) == pivoted(None)


def test_with_no_deed_named_it_is_of_the_decision_in_force() -> None:
    found = pivoted(None)
    assert (found.contrast.decided, found.contrast.foil) == (12.0, ("change-left",))


def of_choice(*causes: Cause) -> ChoiceReason:
    against = Contrast(LEFT, STAY, None, (), causes, Evidence(), 6.0)
    return ChoiceReason("why", None, against)


def test_what_mattered_most_is_the_weightiest_cause(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []

    def told_by(way: str) -> Any:
        def explain(event: Any, _: Any) -> ChoiceReason:
            asked.append((way, event))
            return found

        return explain

    found = of_choice(Cause(1, ("continue",), 0.5, influence=0.1),
                      Cause(2, ("exit-left",), 0.6, influence=0.3))  # fmt: skip
    monkeypatch.setattr(choices, "why", told_by("why"))
    monkeypatch.setattr(choices, "why_not", told_by("why-not"))
    against = found.contrast
    told_ = DecisiveFactor("factor", against, 2, ("exit-left",), 0.6, most=True)
    assert pivoted(None, most=True) == told_
    for event, way in (
        (Event("change-left"), "why"),
        (Event("change-right"), "why-not"),
        (Event("stop"), "why-not"),
    ):
        assert pivoted(Happens(event), most=True) == told_
        assert asked[-1] == (way, event)
    pivoted(Not(Happens(Event("change-left"))), most=True)
    assert asked[-1] == ("why-not", Event("change-left"))


def test_without_a_cause_it_is_what_the_choice_turned_on() -> None:
    found = pivoted(Happens(Event("change-left")), most=True)
    assert (found.kind, found.vehicle, found.most) == ("factor", None, True)
    assert found.contrast.decided == 6.0


def test_options_are_those_of_the_moment_that_is_said() -> None:
    for said, decided in ((Span(2.0, 2.0, said=True), 2.0), (Span(14.0, 14.0, said=True), 12.0)):
        found = listed(Listing("options"), chosen(said))
        assert isinstance(found, Options)
        assert found.decided == decided
    over = listed(Listing("options"), chosen(Span(1.0, 8.0, said=True)))
    assert isinstance(over, Options)
    assert over.decided == 6.0  # of what was done then
