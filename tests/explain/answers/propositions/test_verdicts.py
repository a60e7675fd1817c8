"""What a yes or no question is taken for, where it is given what propositions come to."""

from typing import Any

import pytest

from tests.explain.answers.given import Told, deed, look, refused
from tests.explain.answers.yes_or_no import ONE, SPEED, A, B, Setting, claim, whether
from xavi_dialogue.domain.answers import (
    Course,
    DidNotHappen,
    NeedRollout,
    Staying,
    Verdict,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Ego,
    Event,
    Happens,
    Is,
    Not,
    Now,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.reference.findings import Finding


@pytest.fixture
def setting(monkeypatch: pytest.MonkeyPatch) -> Setting:
    return Setting(monkeypatch)


# --- what a question is taken for ---------------------------------------------------------------


def test_our_own_way_is_answered_first(setting: Setting) -> None:
    setting.ours = Course("way", ())
    assert whether(A) == Course("way", ())
    assert setting.weighed == []


def possible(action: Any, modal: Any) -> Happens:
    return Happens(Event(action, ONE, tense="present", modal=modal))


def to_come(action: Any) -> Happens:
    return Happens(Event(action, ONE, tense="future"))


@pytest.mark.parametrize(
    ("that", "weighed"),
    [
        (A, A),
        (Not(A), A),
        (Not(Not(A)), A),
        (Not(B, lexical=True), Not(B, lexical=True)),
        (Believed(A, tense="present"), A),
        (Believed(A, Now(), "present"), A),
        (Believed(Not(A), tense="present"), A),
        (Believed(A), Believed(A)),
        (Believed(A, At(3.0), "present"), Believed(A, At(3.0), "present")),
        (Happens(Event("go", ONE, manner=("fast",))), Is("fast", ONE, tense="past")),
        (Happens(Event("move", manner=("fast",), tense="present")), Is("fast", Ego())),
        (Happens(Event("go", ONE, manner=("slowly",))), Is("slow", ONE, tense="past")),
        (Happens(Event("turn", ONE, manner=("fast",))),) * 2,
        (Happens(Event("go", ONE, manner=("fast",), modal="will")),) * 2,
        (Happens(Event("go", ONE, manner=("early",))),) * 2,
        (possible("pull-out", "can"), to_come("pull-out")),
        (possible("turn", "might"), to_come("turn")),
        (possible("turn", "can"),) * 2,
        (possible("honk", "could"),) * 2,
    ],
)
def test_the_fact_itself_is_weighed(that: Any, weighed: Any, setting: Setting) -> None:
    found = whether(that)
    assert setting.weighed == [weighed]
    assert found == Verdict(weighed, False)


def test_a_statement_is_taken_as_it_was_said(setting: Setting) -> None:
    slowly = Happens(Event("go", manner=("slowly",)))
    fast = Not(Happens(Event("go", ONE, manner=("fast",))))
    assert claim(fast).that == Not(Is("fast", ONE, tense="past"))
    setting.handed = {slowly: Told("why")}
    assert claim(slowly) == Told("why")


def test_a_denial_that_is_put_as_a_statement_is_answered_as_one(setting: Setting) -> None:
    setting.known = {A: Finding(True, (SPEED,))}
    found = whether(Not(A), None, True)
    assert found == Verdict(Not(A), False, (SPEED,), claim=True)
    assert whether(Not(A)) == Verdict(A, True, (SPEED,))
    assert whether(A, None, True) == Verdict(A, True, (SPEED,))
    setting.known = {A: Finding(False, (SPEED,))}
    assert whether(Not(A), None, True) == Verdict(A, False, (SPEED,))
    told = Verdict(B, True)
    setting.known = {A: Finding(True, answer=told)}
    assert whether(Not(A), None, True) is told
    blocked = Not(Is("free"), lexical=True)  # a word of its own, and no denial
    setting.known = {blocked: Finding(True, (SPEED,))}
    assert whether(blocked, None, True) == Verdict(blocked, True, (SPEED,))


def test_what_was_not_done_at_all_was_not_done_safely_either(setting: Setting) -> None:
    safely = Happens(Event("stop", manner=("safely",)))
    assert whether(safely).that == Happens(Event("stop"))
    setting.known = {safely: Finding(True)}
    assert whether(safely).that == safely


def test_passing_who_stood_is_no_overtaking(setting: Setting) -> None:
    overtook = Happens(Event("overtake", object=ONE))
    passed = Happens(Event("pass", object=ONE))
    assert whether(overtook).that == overtook
    assert whether(overtook, deeds=(deed("pass", 5.0, 7.0, to=1),)).that == passed
    assert whether(overtook, deeds=(deed("overtake", 5.0, 7.0, to=1),)).that == overtook
    assert whether(passed, deeds=(deed("pass", 5.0, 7.0, to=1),)).that == passed
    assert whether(B).that == B


# --- staying behind -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("more", "seen", "stays"),
    [
        ({"tense": "future"}, {}, True),
        ({"tense": "future", "modal": "will"}, {}, True),
        ({"tense": "future", "modal": "want"}, {}, True),
        ({"tense": "future", "modal": "must"}, {}, False),
        ({"tense": "present", "manner": ("long",)}, {}, True),
        ({"tense": "present", "time": WholeRide()}, {}, True),
        ({"tense": "present"}, {}, False),
        ({"tense": "past", "manner": ("long",)}, {}, False),
        ({"tense": "future"}, {"ahead": -1.0}, False),
        ({"tense": "future"}, {"oncoming": True}, False),
        ({"tense": "future"}, {"in_view": False}, False),
    ],
)
def test_whether_we_are_to_stay_behind_somebody(
    more: Any, seen: Any, stays: bool, setting: Setting
) -> None:
    follow = Happens(Event("follow", object=ONE, **more))
    found = whether(follow, looks={1: look(1, **seen)})
    assert (found == Staying(ONE)) is stays
    assert not isinstance(whether(follow, looks={1: None}), Staying)


def test_what_is_long_over_is_no_staying(setting: Setting) -> None:
    then = Span(3.0, 5.0, said=True)
    present = Happens(Event("follow", object=ONE, tense="present", manner=("long",)))
    assert not isinstance(whether(present, then), Staying)
    future = Happens(Event("follow", object=ONE, tense="future"))
    assert whether(future, then) == Staying(ONE)
    ours = Happens(Event("follow", ONE, Vehicle(2), tense="future"))
    assert not isinstance(whether(ours), Staying)


def test_not_overtaking_is_told_with_its_reason(setting: Setting) -> None:
    overtake = Happens(Event("overtake", object=ONE, tense="future", modal="will"))
    plain = Not(Happens(Event("overtake", object=ONE, tense="present", time=Now())))
    setting.handed = {plain: Told("why not")}
    assert whether(overtake) == Told("why not")
    setting.known = {overtake: Finding(False, (SPEED,))}
    assert whether(overtake) == Verdict(overtake, False, (SPEED,))
    setting.known = {overtake: Finding(True)}
    assert whether(overtake) == Verdict(overtake, True)
    setting.known = {}
    setting.handed = {plain: Unanswered(DidNotHappen(Event("overtake")))}
    assert whether(overtake) == Verdict(overtake, False)
    setting.handed = {plain: Unanswered(NeedRollout("trace"))}
    assert refused(whether, overtake) == NeedRollout("trace")
    past = Happens(Event("overtake", object=ONE))
    assert whether(past) == Verdict(past, False)
