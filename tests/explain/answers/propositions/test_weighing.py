"""What propositions come to, of one part or of several, where each part is given."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.given import NOW, Given, Told, expects, look
from xavi_dialogue.domain.answers import Bound, Located, Measures, PlanAhead, Priority, Verdict
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure, Relating
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import (
    At,
    Both,
    Caused,
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Measured,
    Nobody,
    Not,
    Quantity,
    Related,
    That,
    Vehicle,
)
from xavi_dialogue.explain.answers.propositions import alternatives, weighing
from xavi_dialogue.explain.answers.reference.findings import Finding

ONE, TWO = Vehicle(1), Vehicle(2)
ONE_LOOK, TWO_LOOK = look(1, distance=12.0), look(2, distance=30.0)
SPEED = Measure("speed", Ego(), NOW, value=9.0)


class Parts:
    """What each proposition comes to by itself."""

    def __init__(self, patch: pytest.MonkeyPatch) -> None:
        self.known: dict[Any, Any] = {}
        for name in ("related", "condition", "has", "compares", "exists", "happens"):
            patch.setattr(weighing, name, self._told)
        patch.setattr(weighing, "duty", lambda asked, event: self.known.get(("duty", event)))
        patch.setattr(weighing, "conduct", lambda asked, event: self.known.get(("conduct", event)))
        patch.setattr(weighing, "stop_or_go", lambda of, asked: self.known.get("stop or go"))
        patch.setattr(weighing, "of_order", lambda of: self.known.get("order"))
        patch.setattr(weighing, "who_first", lambda asked, first: first)
        patch.setattr(weighing, "is_owed", lambda part: part == self.known.get("owed"))
        patch.setattr(weighing, "handed", lambda why, asked: self.known.get(why))

    def _told(self, of: Any, asked: Any) -> Finding:
        found: Finding = self.known.get(of, Finding(False))
        return found


@pytest.fixture
def parts(monkeypatch: pytest.MonkeyPatch) -> Parts:
    return Parts(monkeypatch)


def weigh(of: Any, span: Span | None = None, **more: Any) -> Any:
    return weighing.weigh(of, Given(**more).asked(span))


A, B, C = Happens(Event("brake")), Happens(Event("stop")), Exists(ONE)
YES, NO, OPEN = Finding(True, (ONE_LOOK,)), Finding(False, (SPEED,)), Finding(None, (), "hidden")


# --- one ----------------------------------------------------------------------------------------


def test_an_event_is_a_duty_or_a_conduct_or_happens(parts: Parts) -> None:
    parts.known = {A: NO}
    assert weigh(A) is NO
    parts.known["conduct", A.event] = YES
    assert weigh(A) is YES
    parts.known["duty", A.event] = OPEN
    assert weigh(A) is OPEN


def test_each_kind_of_proposition_is_weighed(parts: Parts) -> None:
    for of in (Related("near", ONE), Is("safe"), Has("lane", "left"), C,
               Compares(Measured("speed"), "more")):  # fmt: skip
        parts.known[of] = YES
        assert weigh(of) is YES
        assert weigh(Not(of)) == Finding(False, (ONE_LOOK,))
    assert weigh(That()).gap == "not-recorded"
    told = Finding(None, answer=SPEED)  # type: ignore[arg-type]
    parts.known[C] = told
    assert weigh(Not(C)) is told
    parts.known[C] = OPEN
    assert weigh(Not(C)).gap == "hidden"


def test_nobody_stands_so_where_nobody_in_view_does(parts: Parts) -> None:
    nobody = Related("behind", Nobody())
    looks = {1: ONE_LOOK, 2: TWO_LOOK, 3: look(3, in_view=False)}
    assert weigh(nobody, looks=looks).holds is True
    parts.known = {
        Related("behind", TWO): Finding(
            True, (Relating("behind", TWO, Ego(), NOW, True), TWO_LOOK)
        ),
        Related("behind", Vehicle(3)): YES,
    }
    found = weigh(nobody, looks=looks)
    denied = Not(Related("behind", TWO))
    assert found.answer == Verdict(denied, False, (TWO_LOOK,), claim=True)
    assert found.holds is False
    parts.known[Related("behind", ONE)] = YES
    assert weigh(nobody, looks=looks).answer.facts == (ONE_LOOK,)
    at = weigh(replace(nobody, time=At(5.0)), looks={1: lambda t: ONE_LOOK if t > 9 else None})
    assert at.holds is True


# --- several ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "other", "both"),
    [(True, True, True), (True, False, False), (False, False, False), (None, True, None),
     (None, False, False)],
)  # fmt: skip
def test_several_hold_together_where_all_hold(
    one: Any, other: Any, both: Any, parts: Parts
) -> None:
    parts.known = {A: Finding(one), C: Finding(other)}
    assert weigh(Both((A, C))).holds is both


def test_what_alone_makes_it_false_is_told(parts: Parts) -> None:
    parts.known = {A: YES, C: NO}
    found = weigh(Both((A, C)))
    assert (found.facts, found.answer) == ((SPEED,), Verdict(C, False, (SPEED,)))
    own = Verdict(C, False)
    parts.known[C] = Finding(False, answer=own)
    assert weigh(Both((A, C))).answer is own


def test_facts_gaps_and_beliefs_are_told_together(parts: Parts) -> None:
    belief = expects(1, (("stop",), 0.9))
    parts.known = {A: Finding(True, (ONE_LOOK,), believed=(belief,), mistaken=True), C: YES}
    found = weigh(Both((A, C)))
    assert found == Finding(True, (ONE_LOOK,), None, (belief,), True)
    parts.known[C] = OPEN
    assert weigh(Both((A, C))).gap == "hidden"
    assert weigh(Both((A, C))).facts == (ONE_LOOK,)
    parts.known = {A: NO, B: NO, C: NO}
    assert weigh(Both((A, B))).facts == ()  # deeds that were not done
    assert weigh(Both((A, C))).facts == (SPEED,)


def test_the_same_twice_is_weighed_once(parts: Parts) -> None:
    parts.known = {A: NO}
    assert weigh(Both((A, A))) is NO


def test_a_vehicle_has_its_place_told_once() -> None:
    far = Measure("distance", Ego(), NOW, value=9.0)
    gap = Measure("gap", Ego(), NOW, value=9.0)
    held = Relating("near", ONE, Ego(), NOW, True)
    denied = replace(held, holds=False)
    told = weighing._told_once((denied, ONE_LOOK, far, gap, SPEED, held, TWO_LOOK, SPEED))
    assert told == (ONE_LOOK, SPEED, held)


def either(*of: Any, span: Span | None = None, **more: Any) -> Any:
    return weigh(Both(of, "or"), span, **more)


def test_of_several_the_one_that_holds_is_told(parts: Parts) -> None:
    parts.known = {A: NO, C: YES}
    found = either(A, C)
    assert (found.holds, found.facts) == (True, (ONE_LOOK,))
    assert found.answer == Verdict(C, True, (ONE_LOOK,), either=True)
    own = Verdict(A, True)
    parts.known[C] = Finding(True, answer=own)
    assert either(A, C).answer is own


def test_where_none_holds_all_are_denied(parts: Parts) -> None:
    parts.known = {A: NO, C: NO}
    assert (either(A, C).holds, either(A, C).facts) == (False, (SPEED,))
    parts.known[C] = OPEN
    assert (either(A, C).holds, either(A, C).gap) == (None, "hidden")
    parts.known = {A: NO, B: NO}
    assert either(A, B).facts == ()


def test_where_all_hold_they_are_told_together(parts: Parts) -> None:
    left = Happens(Event("turn", object=ONE))
    right = Happens(Event("turn", object=TWO))
    parts.known = {left: YES, right: YES}
    found = either(left, right)
    assert found.answer == Verdict(Both((left, right), "and"), True, either=True)
    parts.known = {A: YES, B: YES}
    mixed = either(A, B)
    assert mixed.answer == Verdict(Both((A, B), "and"), True, either=True)


def test_a_growing_or_a_shrinking_that_is_neither_is_the_same(parts: Parts) -> None:
    more = Compares(Measured("gap"), "more", Quantity(3.0))
    less = Compares(Measured("gap"), "less", Quantity(3.0))
    parts.known = {more: NO}
    found = either(more, less)
    assert found.answer == Verdict(replace(more, comparator="same"), True, (SPEED,), either=True)
    parts.known[less] = YES
    assert either(more, less).answer.that == less


def test_where_somebody_is_is_told_as_a_place(parts: Parts) -> None:
    ahead, behind = Related("ahead-of", ONE), Related("behind", ONE)
    looks = {1: ONE_LOOK}
    assert either(ahead, behind, looks=looks).answer == Located(ONE, (ONE_LOOK,))
    parts.known = {behind: YES}
    for other in (Related("near", ONE), Related("behind", TWO), A):
        assert not isinstance(either(ahead, other, looks=looks).answer, Located)
    past = replace(ahead, tense="past"), replace(behind, tense="past")
    assert not isinstance(either(*past, looks=looks).answer, Located)


def test_which_value_it_has_is_told_as_a_measure(
    parts: Parts, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(weighing, "values", lambda asked, of: (of,))
    left, right = Has("lane", "left", ONE, At(5.0), "past"), Has("lane", "right", ONE)
    wanted = Measured("lane", ONE, time=At(5.0), tense="past")
    assert either(left, right).answer == Measures((wanted,))  # type: ignore[arg-type]
    parts.known = {left: YES}
    for other in (Has("lane", "right", TWO), Has("indicator", "right", ONE), C):
        assert not isinstance(either(left, other).answer, Measures)


def test_which_way_another_goes_is_told_where_none_is_sure(parts: Parts) -> None:
    left = Happens(Event("exit-left", ONE, tense="future"))
    right = Happens(Event("exit-right", ONE, tense="present"))
    known: dict[str, Any] = {"looks": {1: ONE_LOOK}}
    assert either(left, right, **known).answer == Bound(ONE)
    past = Happens(Event("exit-right", ONE, tense="past"))
    ours = Happens(Event("exit-right", tense="future"))
    theirs = Happens(Event("exit-right", TWO, tense="future"))
    for other in (past, ours, theirs, C):
        assert either(left, other, **known).answer is None
    sides = either(ours, replace(ours, event=replace(ours.event, side="left")))
    assert isinstance(sides.answer, PlanAhead)
    said = Span(3.0, 5.0, said=True)
    assert either(left, right, span=said, **known).answer is None


def test_who_goes_first_and_whether_we_stop_is_told_by_the_rule(parts: Parts) -> None:
    rule = Priority(NOW, "give-way", 1, holds=True)
    parts.known = {"order": rule}
    assert either(A, C).answer == replace(rule, holds=None)
    parts.known = {"order": Priority(NOW, "none", 1, holds=True)}
    assert either(A, C).answer.rule == "none"
    parts.known = {"order": Priority(NOW, "none", holds=True), A: YES}
    assert either(A, C).answer.that == A
    parts.known = {"stop or go": OPEN}
    assert either(A, C) is OPEN
    assert weigh(Both((A, C))) is not OPEN


def test_what_is_owed_decides_over_what_goes_with_it(parts: Parts) -> None:
    rule = Finding(True, answer=Priority(NOW, "give-way", 1, holds=True))
    parts.known = {"owed": C, C: rule, A: NO}
    assert weigh(Both((A, C))) is rule
    assert either(A, C).answer == Priority(NOW, "give-way", 1)
    assert either(A, C).holds is None
    parts.known[C] = YES
    assert either(A, C) is YES


# --- causes -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("cause", "suspect"),
    [
        (ONE, ONE),
        (Happens(Event("stop", TWO)), TWO),
        (Related("near", ONE), ONE),
        (Is("slow", ONE), ONE),
        (Exists(ONE), ONE),
        (Has("colour", "red", ONE), ONE),
        (Compares(Measured("speed", TWO), "less"), TWO),
        (Not(Exists(ONE)), None),
        (That(), None),
    ],
)
def test_a_cause_is_asked_of_the_reasons(cause: Any, suspect: Any, parts: Parts) -> None:
    why: Any = Why(A, suspect=suspect)
    parts.known = {why: Told("why")}
    assert weigh(Caused(cause, A)).answer == Told("why")
    assert weigh(Caused(cause)).gap == "not-recorded"
    parts.known = {Why(That(), suspect=suspect): Told("that")}
    assert weigh(Caused(cause)).answer == Told("that")


def test_of_stopping_for_us_or_coming_out_the_stop_is_weighed(parts: Parts) -> None:
    comes = Happens(Event("pull-out", ONE, tense="present"))
    stops = Happens(Event("stop", ONE, tense="future"))
    for_us = Happens(Event("stop", ONE, Ego(), tense="future"))
    parts.known = {for_us: YES, comes: NO}
    assert weigh(Both((stops, comes), "or")) is YES
    parts.known = {for_us: NO, stops: YES, comes: YES}
    assert weigh(Both((stops, comes), "and")).holds is True  # both are said


def test_of_a_collision_beside_what_comes_before_it_the_collision_is_asked() -> None:
    crash = Happens(Event("collide", Ego(), ONE, tense="future", modal="will"))
    goes = Happens(Event("move", ONE, tense="future", modal="will"))
    assert alternatives.feared(Both((goes, crash)), Given().asked()) == crash
    past = Happens(Event("collide", Ego(), ONE, tense="past"))
    assert alternatives.feared(Both((goes, past)), Given().asked()) is None
    assert alternatives.feared(Both((goes,)), Given().asked()) is None


def test_the_collision_is_weighed_and_not_what_comes_before_it(parts: Parts) -> None:
    crash = Happens(Event("collide", Ego(), ONE, tense="future", modal="will"))
    goes = Happens(Event("move", ONE, tense="future", modal="will"))
    parts.known[crash], parts.known[goes] = Finding(False, probability=0.01), Finding(True)
    assert weigh(Both((goes, crash))).probability == 0.01


def test_whether_another_stops_for_us_also_tells_the_risk(parts: Parts) -> None:
    crash = Happens(Event("collide", Ego(), ONE, tense="future", modal="will"))
    waits = Happens(Event("give-way", ONE, Ego(), tense="present"))
    parts.known[crash], parts.known[waits] = Finding(False, probability=0.01), Finding(True)
    assert weigh(Both((waits, crash), "or")).holds is True
