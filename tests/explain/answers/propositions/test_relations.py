"""Whether two things stand, or stood, in a relation, and what shows it."""

from typing import Any

import pytest

from tests.explain.answers.given import NOW, Given, look, plan, their
from xavi_dialogue.domain.answers import Priority, Verdict
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Measure, Relating
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Ego,
    Event,
    Everyone,
    Exists,
    Happens,
    Related,
    Road,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.propositions import relations
from xavi_dialogue.explain.answers.reference.findings import Finding
from xavi_dialogue.explain.answers.reference.moments import Window

ONE, TWO = Vehicle(1), Vehicle(2)


def related(of: Related, span: Span | None = None, **more: Any) -> Any:
    given = {"looks": {1: look(1), 2: look(2, bearing="behind", ahead=-20.0)}} | more
    return relations.related(of, Given(**given).asked(span))


def held(relation: Any, thing: Any, to: Any, value: Any = True) -> Any:
    return {(relation, thing, to): value}


def test_a_relation_is_told_with_where_both_are() -> None:
    found = related(Related("left-of", ONE), relations=held("left-of", ONE, Ego()))
    assert found.holds is True
    assert found.facts == (Relating("left-of", ONE, Ego(), NOW, True), look(1))
    of_two = related(Related("left-of", ONE, TWO))
    assert of_two.holds is False
    assert [one.vehicle for one in of_two.facts[1:]] == [1, 2]
    unknown = related(Related("left-of", ONE), relations=held("left-of", ONE, Ego(), None))
    assert (unknown.holds, unknown.gap) == (None, "not-recorded")
    gone = {1: look(1, in_view=False, seen=3.0)}
    lost = related(Related("left-of", ONE), relations=held("left-of", ONE, Ego(), None), looks=gone)
    assert (lost.holds, lost.gap) == (None, "out-of-view")
    gone[2] = look(2)
    one = related(
        Related("left-of", TWO, ONE), relations=held("left-of", TWO, ONE, None), looks=gone
    )
    assert one.gap == "out-of-view"


def test_of_several_one_that_stands_so_is_enough() -> None:
    of = Related("near", Everyone(), Ego())
    assert related(of, relations=held("near", TWO, Ego())).holds is True
    assert related(of).holds is False
    mixed = held("near", ONE, Ego(), False) | held("near", TWO, Ego(), None)
    assert related(of, relations=mixed).holds is None
    assert related(of, looks={}).holds is False


def test_ahead_and_behind_are_also_told_by_the_bearing() -> None:
    assert related(Related("ahead-of", ONE)).holds is True  # its bearing is "ahead"
    assert related(Related("behind", ONE)).holds is False
    assert related(Related("behind", TWO)).holds is True
    assert related(Related("ahead-of", TWO)).holds is False
    assert related(Related("left-of", ONE)).holds is False
    assert related(Related("ahead-of", ONE, TWO)).holds is False
    assert related(Related("behind", Road("own"))).holds is False


SPEEDS = {("speed", ONE): 12.0, ("speed", Ego()): 10.0, ("distance", Ego(), ONE): 15.5}


def test_what_is_compared_is_told_by_its_values() -> None:
    faster = related(
        Related("faster-than", ONE), relations=held("faster-than", ONE, Ego()), measures=SPEEDS
    )
    assert [fact.value for fact in faster.facts[1:]] == [12.0, 10.0]
    for name in ("near", "closer-than"):
        near = related(Related(name, ONE), measures=SPEEDS)
        assert [getattr(fact, "value", None) for fact in near.facts[1:]] == [None, 15.5]
    of_us = related(Related("near", Ego(), Ego()), measures=SPEEDS)
    assert of_us.facts[1:] == ()


def test_a_relation_of_the_past_held_at_any_time_of_its_stretch() -> None:
    for_a_while = held("left-of", ONE, Ego(), lambda t: 3.0 <= t <= 4.0)
    past = Related("left-of", ONE, tense="past")
    found = related(past, Span(2.0, 6.0, said=True), relations=for_a_while)
    assert (found.holds, found.facts[0].time) == (True, 4.0)
    assert related(past, Span(5.0, 9.0, said=True), relations=for_a_while).holds is False
    assert related(Related("left-of", ONE), relations=for_a_while).holds is False
    assert related(past, relations=for_a_while).holds is True  # the ride so far
    at = Related("left-of", ONE, time=At(3.5), tense="past")
    assert related(at, relations=for_a_while).facts[0].time == 3.5


@pytest.mark.parametrize(
    ("begin", "end", "holds", "at"),
    [
        (2.0, 8.0, True, 4.5),
        (4.5, 8.0, True, 4.5),
        (5.0, 8.0, False, 8.0),
        (4.4, 4.6, True, 4.5),  # so short that its middle counts
        (3.0, 4.6, False, 4.6),  # tried at 4.6, 4.1, 3.6 and 3.1 s
    ],
)
def test_a_stretch_is_searched_from_its_end_to_its_begin(
    begin: float, end: float, holds: bool, at: float
) -> None:
    asked = Given(relations=held("near", ONE, Ego(), lambda t: t == 4.5)).asked()
    found = relations.holds_over(asked, "near", ONE, Ego(), Window(begin, end))
    assert found == (holds, at)


def test_what_is_known_at_no_time_of_a_stretch_is_not_known() -> None:
    asked = Given(relations=held("near", ONE, Ego(), None)).asked()
    assert relations.holds_over(asked, "near", ONE, Ego(), Window(2.0, 8.0)) == (None, 8.0)
    once = Given(relations=held("near", ONE, Ego(), lambda t: None if t > 3.0 else False))
    found = relations.holds_over(once.asked(), "near", ONE, Ego(), Window(2.0, 8.0))
    assert found == (False, 8.0)


@pytest.mark.parametrize(
    ("made", "planned", "with_us"),
    [
        ("exit-right", ("exit-right",), True),
        ("exit-right", ("continue", "exit-right"), True),
        ("exit-left", ("exit-right",), False),
        ("exit-right", ("continue",), False),
    ],
)
def test_who_made_the_turn_that_we_make_comes_with_us(
    made: Any, planned: Any, with_us: bool
) -> None:
    given: dict[str, Any] = {
        "deeds": (their(1, made, 12.0, 14.0),),
        "traces": (plan(NOW, *planned),),
    }
    assert related(Related("with", ONE), **given).holds is with_us


def test_a_turn_of_long_ago_or_of_us_leads_nobody_along() -> None:
    given: dict[str, Any] = {"traces": (plan(NOW, "exit-right"),)}
    late = (their(1, "exit-right", 7.0, 9.9),)
    assert related(Related("with", ONE), deeds=late, **given).holds is False
    just = (their(1, "exit-right", 7.0, 10.0),)
    assert related(Related("with", ONE), deeds=just, **given).holds is True
    assert related(Related("with", ONE, TWO), deeds=just, **given).holds is False
    assert related(Related("with", Road("own")), deeds=just, **given).holds is False


def test_who_came_with_us_is_asked_of_now() -> None:
    now = held("with", ONE, Ego(), lambda t: t >= NOW)
    assert related(Related("with", ONE, tense="past"), relations=now).holds is True
    early = Related("with", ONE, time=Between(2.0, 5.0), tense="past")
    assert related(early, relations=now, traces=(plan(NOW),)).holds is False


# --- seeing, being the same ---------------------------------------------------------------------


@pytest.fixture
def asks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(relations, "happens", lambda of, asked: of)
    monkeypatch.setattr(relations, "others_mind", lambda asked, vehicle: ("mind", vehicle))


@pytest.mark.usefixtures("asks")
def test_seeing_is_an_event_of_ours_and_a_thought_of_others() -> None:
    assert related(Related("can-see", ONE)) == ("mind", 1)
    assert related(Related("can-see", Ego(), ONE)) == Happens(
        Event("see", Ego(), ONE, tense="present")
    )
    both = related(Related("can-see", Ego(), Vehicles((1, 2))))
    seen = (look(1), look(2, bearing="behind", ahead=-20.0))
    assert both.answer == Verdict(Exists(Vehicles((1, 2))), True, seen)
    assert both.holds is True
    hidden = {1: look(1), 2: look(2, in_view=False)}
    assert related(Related("can-see", Ego(), Vehicles((1, 2))), looks=hidden).answer is None


def test_two_names_may_be_of_one_vehicle() -> None:
    same = related(Related("same-as", ONE, ONE))
    assert (same.holds, same.facts) == (True, (look(1),))
    other = related(Related("same-as", ONE, TWO))
    assert (other.holds, [one.vehicle for one in other.facts]) == (False, [1, 2])


# --- right of way -------------------------------------------------------------------------------


@pytest.fixture
def rules(monkeypatch: pytest.MonkeyPatch) -> None:
    def read(asked: Any, thing: Any, to: Any, about: Any) -> Priority:
        return Priority(about.end, "none" if thing == TWO else "give-way", 1, waited=None)

    monkeypatch.setattr(relations, "right_of_way", read)
    monkeypatch.setattr(
        relations, "where_rule_holds", lambda asked, about: Window(about.end - 1.0, 7.0)
    )


@pytest.mark.usefixtures("rules")
@pytest.mark.parametrize(
    ("relation", "thing", "to", "holds"),
    [
        ("has-priority-over", Ego(), ONE, False),  # we give way to 1
        ("has-priority-over", ONE, Ego(), True),
        ("must-yield-to", Ego(), ONE, True),
        ("must-yield-to", ONE, Ego(), False),
        ("on", ONE, Road("main"), True),
        ("from", ONE, Road("main"), True),
        ("on", ONE, Road("side"), False),
        ("from", ONE, Road("side"), False),
    ],
)
def test_who_goes_first_is_told_by_the_rule_whichever_way_round(
    relation: Any, thing: Any, to: Any, holds: bool
) -> None:
    found = related(Related(relation, thing, to))
    assert found.holds is holds
    assert (found.answer.time, found.answer.holds) == (NOW, holds)
    past = related(Related(relation, thing, to, tense="past"))
    assert past.answer.time == 7.0


@pytest.mark.usefixtures("rules")
def test_where_no_rule_is_between_us_nobody_has_to_yield() -> None:
    open_ = related(Related("must-yield-to", TWO))
    assert (open_.holds, open_.answer.holds) == (None, None)  # "do we fit in before it?"
    denied = related(Related("has-priority-over", TWO))
    assert (denied.holds, denied.answer.holds) == (None, False)


@pytest.mark.usefixtures("rules")
def test_our_own_road_is_no_matter_of_right_of_way() -> None:
    assert not isinstance(related(Related("on", ONE, Road("own"))).answer, Priority)
    assert not isinstance(related(Related("to", ONE, Road("main"))).answer, Priority)


# --- waiting ------------------------------------------------------------------------------------

WAITS = Related("waiting-for", ONE)


def waiting(found: Finding, patch: Any, of: Related = WAITS, **more: Any) -> Any:
    patch.setattr(relations, "happens", lambda that, asked: found)
    return related(of, **more)


def test_who_waits_is_told_by_the_wait_or_else_by_the_relation(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    wait = their(1, "wait", 18.0, to=Ego())
    told = Finding(True, (wait,))
    assert waiting(told, monkeypatch) is told
    denied = Finding(False, (wait, look(1)))
    assert waiting(denied, monkeypatch, Related("waiting-for", Ego(), ONE)) is denied
    stands = Measure("speed", ONE, NOW, value=0.0)
    known = {("speed", ONE): stands}
    now = held("waiting-for", ONE, Ego(), lambda t: t == NOW)
    found = waiting(denied, monkeypatch, relations=now, measures=known)
    assert (found.holds, found.facts, found.gap) == (True, (stands, wait), None)
    past = Related("waiting-for", ONE, time=At(5.0), tense="past")
    assert waiting(denied, monkeypatch, past, relations=now, measures=known).holds is False
    late = Related("waiting-for", ONE, time=At(19.0), tense="past")
    assert waiting(denied, monkeypatch, late, relations=now, measures=known).holds is True


def test_what_is_not_known_of_a_wait_stays_open(monkeypatch: pytest.MonkeyPatch) -> None:
    denied = Finding(None, (), "hidden")
    none = held("waiting-for", ONE, Ego(), None)
    assert waiting(denied, monkeypatch, relations=none) is denied
    moving = {("speed", ONE): 5.0}
    found = waiting(denied, monkeypatch, relations=none, measures=moving)
    assert (found.holds, found.gap, len(found.facts)) == (False, "hidden", 1)


@pytest.mark.parametrize(
    ("near", "far", "holds"), [(10.0, 10.0, True), (10.0, 15.0, False), (30.0, 5.0, False)]
)
def test_who_is_between_two_is_no_detour_from_one_to_the_other(
    near: float, far: float, holds: bool
) -> None:
    third = Vehicle(3)
    gaps = {("distance", ONE, third): near, ("distance", third, TWO): far}
    known = {**gaps, ("distance", ONE, TWO): 25.0}
    of = Related("between", third, Vehicles((1, 2)))
    found = related(of, measures=known, looks={n: look(n) for n in (1, 2, 3)})
    assert found.holds is holds
    assert [one.vehicle for one in found.facts] == [3]
    assert related(of, measures=gaps).gap == "out-of-view"
    assert related(Related("between", ONE, Vehicles((1, 2))), measures=known).holds is False
